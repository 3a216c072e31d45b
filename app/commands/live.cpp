// SPDX-License-Identifier: Apache-2.0
// neontetra live: a window with the camera's overlay beside (or behind) the character that swims like the fish.
//
// A file or the tank plays at its own frame rate; frames that come too late are skipped and counted as dropped. A
// source that decodes slower than that plays as fast as it can (Pacer), and the window still answers.
// The character is drawn between the last two video frames, so it follows the fish by one video frame, never more.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "app/actor.h"
#include "app/cli.h"
#include "app/export/recording.h"
#include "app/export/report.h"
#include "app/pacer.h"
#include "app/session.h"
#include "app/ui/colours.h"
#include "app/ui/overlay.h"
#include "app/ui/window.h"
#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr int64_t kSecond_ns = 1'000'000'000;
constexpr int64_t kDrawPeriod_ns = kSecond_ns / 60;
constexpr int64_t kHudPeriod_ns = kSecond_ns / 2;
constexpr const char* kKeys = "click fish  space pause  b background  n next  r record  q quit";

struct Options {
  CaptureOptions capture;
  std::string character;
  std::string layout = "beside";
  std::string record_to = "neontetra";
  std::string json;
};

class Live {
 public:
  explicit Live(const Options& options)
      : options_(options),
        session_(options.capture),
        actor_(options.character),
        camera_pane_(pane_for(session_.info().width, session_.info().height)),
        actor_pane_(options.layout == "beside" ? beside(camera_pane_) : camera_pane_),
        overlay_(camera_pane_),
        hud_(kFirstTextPicture + 1),
        display_(
            open_window("neontetra", static_cast<int>(actor_pane_.corner.x) + actor_pane_.width, actor_pane_.height)),
        pacer_(static_cast<int64_t>(static_cast<double>(kSecond_ns) / session_.info().fps)) {}

  void run() {
    last_draw_ns_ = steady_now_ns();
    pacer_.start(last_draw_ns_);
    while (!quit_ && !interrupted()) {
      handle_events();
      if (!paused_ && pacer_.due(steady_now_ns()) && !next_frame()) break;
      draw();
      sleep_until_ns(last_draw_ns_ + kDrawPeriod_ns);
    }
    if (recording_ != nullptr) recording_->finish();
    expect_frames(session_);
    if (!options_.json.empty()) write_text(options_.json, pretty(report_json(session_)));
    std::fprintf(stderr, "%s; %lld dropped\n", summary_line(session_.statistics()).c_str(),
                 static_cast<long long>(session_.statistics().dropped));
  }

 private:
  void handle_events() {
    display_->poll(events_);
    for (const InputEvent& event : events_) {
      if (event.kind == InputEvent::Kind::quit) quit_ = true;
      if (event.kind == InputEvent::Kind::key) press(event.key);
      if (event.kind == InputEvent::Kind::click && camera_pane_.contains(event.at)) {
        session_.capture().select_at(camera_pane_.to_frame(event.at));
      }
    }
  }

  void press(int key) {
    switch (key) {
      case ' ':
        paused_ = !paused_;
        pacer_.start(steady_now_ns());
        break;
      case 'b':
        session_.capture().relearn();
        break;
      case 'n':
        session_.capture().select_next();
        break;
      case 'r':
        toggle_recording();
        break;
      case 'q':
      case 27:
        quit_ = true;
        break;
      default:
        break;
    }
    hud_due_ns_ = 0;
  }

  void toggle_recording() {
    if (recording_ != nullptr) {
      recording_->finish();
      recording_.reset();
    } else {
      recording_ = std::make_unique<Recording>(options_.record_to, session_, scene_);
    }
  }

  bool next_frame() {
    const int64_t now_ns = steady_now_ns();
    const int64_t due_ns =
        pacer_.due_ns() + pacer_.skips(now_ns) * pacer_.period_ns();  // of the frame that is not skipped
    for (int skips = pacer_.take(now_ns); skips > 0; --skips) {
      if (!session_.skip()) return false;
    }
    if (!session_.step(due_ns)) return false;
    frame_shown_ns_ = now_ns;
    actor_.see(session_);
    overlay_.update(session_, true);
    if (recording_ != nullptr) {
      compose();
      recording_->add(session_, scene_);
    }
    return true;
  }

  void compose() {
    scene_.clear(static_cast<int>(actor_pane_.corner.x) + actor_pane_.width, actor_pane_.height, kWater);
    const bool behind = options_.layout == "behind";
    if (behind) overlay_.draw(scene_);
    actor_.draw(scene_);
    if (!behind) overlay_.draw(scene_);  // last: it hides what of the character leaves its own pane
  }

  void draw() {
    const int64_t now_ns = steady_now_ns();
    const auto part = static_cast<float>(now_ns - frame_shown_ns_) / static_cast<float>(pacer_.period_ns());
    if (!paused_) {
      actor_.pose(std::clamp(part, 0.01f, 1.0f), static_cast<float>(now_ns - last_draw_ns_) * 1e-9f, actor_pane_);
    }
    last_draw_ns_ = now_ns;
    compose();
    ++drawn_;
    update_hud(now_ns);
    hud_.draw(scene_, {8, static_cast<float>(scene_.height()) - 90});
    display_->draw(scene_);
  }

  void update_hud(int64_t now_ns) {
    if (now_ns < hud_due_ns_) return;
    const Statistics& statistics = session_.statistics();
    const double seconds = static_cast<double>(now_ns - hud_last_ns_) * 1e-9;
    char lines[400];
    int used =
        std::snprintf(lines, sizeof lines, "%.0f frames/s, %.0f drawn/s, %lld dropped%s%s\n",
                      static_cast<double>(statistics.frames - hud_frames_) / seconds,
                      static_cast<double>(drawn_ - hud_drawn_) / seconds, static_cast<long long>(statistics.dropped),
                      paused_ ? ", paused" : "", recording_ != nullptr ? ", recording" : "");
    used += std::snprintf(lines + used, sizeof lines - static_cast<std::size_t>(used),
                          "%.2f ms:", statistics.total.quantile_ns(0.5) * 1e-6);
    for (std::size_t s = 0; s < kStages; ++s) {
      used += std::snprintf(lines + used, sizeof lines - static_cast<std::size_t>(used), "%s %s %.2f",
                            s == kStages / 2 ? "\n" : "", kStageNames[s], statistics.stages[s].quantile_ns(0.5) * 1e-6);
    }
    hud_.set(std::string(lines) + "\n" + kKeys);
    hud_last_ns_ = now_ns, hud_frames_ = statistics.frames, hud_drawn_ = drawn_;
    hud_due_ns_ = now_ns + kHudPeriod_ns;
  }

  const Options& options_;
  Session session_;
  Actor actor_;
  Pane camera_pane_, actor_pane_;
  Overlay overlay_;
  Text hud_;
  std::unique_ptr<Display> display_;
  Pacer pacer_;
  std::vector<InputEvent> events_;
  Scene scene_;
  std::unique_ptr<Recording> recording_;
  bool paused_ = false, quit_ = false;
  int64_t frame_shown_ns_ = 0, last_draw_ns_ = 0;
  int64_t drawn_ = 0;
  int64_t hud_due_ns_ = 0, hud_last_ns_ = 0, hud_frames_ = 0, hud_drawn_ = 0;
};

}  // namespace

void add_live(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("live", "Open a window: the camera beside the character that swims like the fish");
  auto options = std::make_shared<Options>();
  add_capture_options(*command, options->capture);
  command->add_option("--character", options->character, "a character file, or a picture with a transparent ground")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--layout", options->layout,
                   "beside: camera left, character right; behind: character over the camera")
      ->type_name("beside|behind")
      ->check(CLI::IsMember({"beside", "behind"}));
  command->add_option("--record-to", options->record_to, "what r records: PREFIX-1.csv and PREFIX-1.mp4, then -2, ...")
      ->type_name("PREFIX");
  command->add_option("--json", options->json, "report of the run at its end ('-' = standard output)")
      ->type_name("FILE");
  command->footer(std::string("Keys: ") + kKeys + "\nExample: neontetra live -c sim --character carp.ntchar");
  command->callback([&action, options] { action = [options] { Live(*options).run(); }; });
}

}  // namespace nt
