// SPDX-License-Identifier: Apache-2.0
// neontetra live: a window with the camera's overlay beside (or behind) the character that swims like the fish.
//
// Camera, core and store have threads of their own (app/frame_loop); this one draws, and is the only one that asks for things.
// A camera is shown as its frames come. A file or the tank plays at its own frame rate; frames that come later than a
// camera's driver would keep them are skipped and counted as dropped.
// The character is drawn between the last two video frames, so it follows the fish by one video frame, never more.
// Layouts: the camera beside the character; the camera behind it; the character alone, on its backdrop.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/cast.h"
#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/pose_csv.h"
#include "app/export/recording.h"
#include "app/export/report.h"
#include "app/frame_loop/capture_loop.h"
#include "app/frame_loop/loop_watch.h"
#include "app/session.h"
#include "app/take/from_session.h"
#include "app/take/take_recording.h"
#include "app/ui/backdrop.h"
#include "app/ui/hud.h"
#include "app/ui/overlay.h"
#include "app/ui/window.h"
#include "platform/linux/clock.h"
#include "platform/linux/service_notice.h"

namespace nt {
namespace {

constexpr int64_t kSecond_ns = 1'000'000'000;
constexpr int64_t kDrawPeriod_ns = kSecond_ns / 60;
constexpr const char* kKeys =
    "click fish  space pause  b background  n next fish  c next character  i info  r record  q quit";

struct Options {
  CaptureOptions capture;
  CastOptions cast;
  BackdropOption backdrop;
  bool has_backdrop = false;
  std::string layout = "beside";
  std::string info_text = kDefaultInfo;
  std::string record_to = "neontetra";
  std::string take;
  double pre_record_s = 5;
  bool keep_video = false;
  std::string json;
  DisplayOptions display;
  ThreadPlan threads{};
};

// What is recorded, frame by frame on the store thread; recordings begin and end on the one that draws.
class LiveStore {
 public:
  LiveStore(const Options& options, const Session& session, const std::string& character)
      : fps_(session.info().fps),
        past_(static_cast<int>(options.pre_record_s * fps_) * session.capture().fish_count()) {
    if (options.take.empty()) return;
    TakeInfo info = take_info(session, std::filesystem::path(options.take).stem().string());
    info.character = character;
    take_.emplace(options.take, info, options.keep_video);
  }

  // The past is kept while nothing is recorded: what a recording holds already does not come into the next one.
  void write(const Observation& seen) {
    const std::lock_guard lock(mutex_);
    const std::span<const TakeFrame> rows = rows_.read(seen);
    if (take_) take_->add(seen, rows);
    if (recording_ != nullptr) {
      recording_->add(seen, rows);
      return;
    }
    for (const TakeFrame& row : rows) past_.add(row);
  }

  // For thumbnails and kept videos.
  bool wants_pictures() const { return take_.has_value() || recording_ != nullptr; }
  // Null while nothing is recorded. It is made and ended by the thread that draws, so that one may film without a lock.
  Recording* recording() { return recording_.get(); }

  void begin(const Recording::Settings& settings, const Session& session, const Scene& scene) {
    const std::lock_guard lock(mutex_);
    const std::vector<TakeFrame> past = past_.frames();
    const double past_s = past.empty() ? 0 : static_cast<double>(past.back().frame - past.front().frame + 1) / fps_;
    recording_ = std::make_unique<Recording>(settings, session, scene, past);
    past_.clear();
    std::fprintf(stderr, "recording %s.take (with the last %.1f s), .csv and .mp4\n", recording_->name().c_str(),
                 past_s);
  }

  void end() {
    std::unique_ptr<Recording> done;
    {
      const std::lock_guard lock(mutex_);
      done = std::move(recording_);
    }
    done->finish();  // takes its time; the store goes on meanwhile
    std::fprintf(stderr, "recorded %s\n", done->summary().c_str());
  }

  void finish() {
    if (recording_ != nullptr) end();
    if (take_) take_->finish(), std::fprintf(stderr, "%s\n", take_->summary().c_str());
  }

 private:
  double fps_;
  std::mutex mutex_;  // held while a frame is written
  FishRows rows_;
  PreRecord past_;
  std::optional<TakeRecording> take_;
  std::unique_ptr<Recording> recording_;
};

class Live {
 public:
  explicit Live(const Options& options)
      : options_(options),
        session_(options.capture),
        cast_(options.cast, session_),
        camera_pane_(pane_for(session_.info().width, session_.info().height)),
        actor_pane_(options.layout == "beside" ? beside(camera_pane_) : camera_pane_),
        overlay_(camera_pane_),
        backdrop_(options.backdrop, actor_pane_, session_),
        hud_(options.info_text),
        store_(options, session_, cast_.character_name()),
        display_(open_window("neontetra", static_cast<int>(actor_pane_.corner.x) + actor_pane_.width,
                             actor_pane_.height, options.display)),
        period_ns_(static_cast<double>(kSecond_ns) / session_.info().fps) {
    measuring_ = options.capture.scale_mm > 0 && !options.capture.scale_points;
  }

  void run() {
    loop_.emplace(session_, loop_settings(),
                  CaptureLoop::Store{[this](const Observation& seen) { store_.write(seen); }});
    loop_->store_pictures(store_.wants_pictures());
    take_place(options_.threads, LoopThread::display);  // threads begun after it would share its place
    last_draw_ns_ = steady_now_ns();
    while (!quit_ && !interrupted() && loop_->running()) {
      handle_events();
      while (const Observation* seen = loop_->next_seen()) show(*seen);
      draw();
      watch_.look();
      if (loop_->rounds() != rounds_) service_.alive(last_draw_ns_);  // both threads live
      rounds_ = loop_->rounds();
      sleep_until_ns(last_draw_ns_ + kDrawPeriod_ns);
    }
    loop_->finish();
    store_.finish();
    expect_frames(session_);
    if (!options_.json.empty()) write_report();
    std::fprintf(stderr, "%s; %lld dropped\n", summary_line(session_.statistics()).c_str(),
                 static_cast<long long>(session_.statistics().dropped));
    end_of_frames(session_);
  }

 private:
  void handle_events() {
    display_->poll(events_);
    for (const InputEvent& event : events_) {
      if (event.kind == InputEvent::Kind::quit) quit_ = true;
      if (event.kind == InputEvent::Kind::key) press(event.key);
      if (event.kind == InputEvent::Kind::click && camera_pane_.contains(event.at)) {
        click(camera_pane_.to_frame(event.at));
      }
    }
  }

  void click(Vec2 at) {
    if (measuring_) measure(to_source(at, session_.scale()));
    else loop_->ask([at](Session& session) { session.capture().select_at(at); });
  }

  // Two clicks on the ends of a known length: pixels to millimetres.
  void measure(Vec2 source) {
    hud_.renew();
    if (!first_end_) {
      first_end_ = source;
      return;
    }
    const ScalePoints ends{*first_end_, source};
    first_end_.reset();
    if (!far_enough(ends)) return;  // twice the same place: anew
    measuring_ = false;
    session_.set_scale(ends, options_.capture.scale_mm);
    std::fprintf(stderr,
                 "scale: %.3f pixels per millimetre; another time: --scale-points %.0f,%.0f,%.0f,%.0f --scale-mm %g\n",
                 session_.calibration().px_per_mm, static_cast<double>(ends.a.x), static_cast<double>(ends.a.y),
                 static_cast<double>(ends.b.x), static_cast<double>(ends.b.y), options_.capture.scale_mm);
  }

  std::string measuring_state() const {
    if (!measuring_) return "";
    return first_end_ ? ", click the other end" : ", click the two ends of a length of --scale-mm";
  }

  void press(int key) {
    switch (key) {
      case ' ':
        paused_ = !paused_;
        loop_->pause(paused_);
        break;
      case 'b':
        loop_->ask([](Session& session) { session.capture().relearn(); });
        break;
      case 'n':
        loop_->ask([](Session& session) { session.capture().select_next(); });
        break;
      case 'c':
        cast_.next_character();
        break;
      case 'i':
        hud_.toggle();
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
    hud_.renew();
  }

  void toggle_recording() {
    if (store_.recording() != nullptr) {
      store_.end();
    } else {
      compose();  // a recording has the size of what is shown
      store_.begin({options_.record_to, cast_.character_name(), options_.keep_video}, session_, scene_);
    }
    loop_->store_pictures(store_.wants_pictures());
  }

  CaptureLoop::Settings loop_settings() const {
    CaptureLoop::Settings settings;
    settings.pace = Pace::clock;
    settings.has_display = true;
    settings.display.contours = settings.display.blobs = settings.display.statistics = true;
    settings.display.picture = options_.layout != "alone" || backdrop_.watches();
    settings.display.masks = backdrop_.watches();
    settings.store.picture = true;  // for a take's thumbnails
    settings.plan = options_.threads;
    return settings;
  }

  void show(const Observation& seen) {
    shown_ = &seen;
    fresh_ = true;
    frame_shown_ns_ = steady_now_ns();
    cast_.see(seen);
    if (options_.layout != "alone") overlay_.update(seen, true);
    backdrop_.update(seen);
    if (store_.recording() == nullptr) return;
    compose();
    store_.recording()->film(seen, scene_);
  }

  void write_report() {
    Json json = report_json(session_);
    json["latency_to_picture"] = latency_json(to_picture_, session_.info().fps);
    json["loop"] = watch_.json(*loop_);
    write_text(options_.json, pretty(json));
  }

  void compose() {
    scene_.clear(static_cast<int>(actor_pane_.corner.x) + actor_pane_.width, actor_pane_.height, backdrop_.colour());
    const bool behind = options_.layout == "behind";
    if (behind) overlay_.draw(scene_);
    else backdrop_.draw(scene_);
    cast_.draw(scene_);
    if (options_.layout == "beside") overlay_.draw(scene_);  // last: it hides what of the character leaves its own pane
  }

  void draw() {
    const int64_t now_ns = steady_now_ns();
    const auto part = static_cast<float>(static_cast<double>(now_ns - frame_shown_ns_) / period_ns_);
    if (!paused_) {
      cast_.pose(std::clamp(part, 0.01f, 1.0f), static_cast<float>(now_ns - last_draw_ns_) * 1e-9f, actor_pane_);
    }
    last_draw_ns_ = now_ns;
    compose();
    hud_.drawn();
    if (hud_.due(now_ns) && shown_ != nullptr)
      hud_.update(now_ns, *shown_->statistics, {state(), cast_.character_name(), kKeys, &to_picture_});
    hud_.draw(scene_);
    display_->draw(scene_);
    if (fresh_ && shown_->had_ns != 0) to_picture_.add(steady_now_ns() - shown_->had_ns);
    fresh_ = false;
  }

  std::string state() {
    const Recording* recording = store_.recording();
    return std::string(paused_ ? ", paused" : "") + measuring_state() +
           (recording != nullptr ? ", recording " + recording->name() : "") +
           (watch_.machine().hot     ? ", slowed down by heat"
            : watch_.machine().power ? ", power supply too weak"
                                     : "");
  }

  const Options& options_;
  Session session_;
  Cast cast_;
  Pane camera_pane_, actor_pane_;
  Overlay overlay_;
  Backdrop backdrop_;
  Hud hud_;
  LiveStore store_;
  std::unique_ptr<Display> display_;
  double period_ns_;  // of the video's frames
  ServiceNotice service_;
  LoopWatch watch_;
  std::vector<InputEvent> events_;
  Scene scene_;
  const Observation* shown_ = nullptr;  // until the next one
  bool fresh_ = false;                  // and not drawn yet
  TimeHistogram to_picture_;            // from the camera's timestamp until its frame was drawn
  bool paused_ = false, quit_ = false;
  bool measuring_ = false;  // the next two clicks are the ends of --scale-mm
  std::optional<Vec2> first_end_;
  int64_t frame_shown_ns_ = 0, last_draw_ns_ = 0, rounds_ = -1;
  std::optional<CaptureLoop> loop_;  // ends before all that its threads write to
};

void check(const Options& options) {
  if (options.has_backdrop && options.layout == "behind") {
    throw UserError("--backdrop: with --layout behind the camera's picture is the backdrop; take beside or alone", 2);
  }
  std::vector<std::string> inputs = inputs_of(options.capture);
  inputs.insert(inputs.end(), options.cast.characters.begin(), options.cast.characters.end());
  inputs.push_back(options.backdrop.path);
  check_outputs(inputs, {options.json, options.take, options.record_to});
  const bool clicks = options.capture.scale_mm > 0 && !options.capture.scale_points;
  if (clicks && (options.layout == "alone" || !options.take.empty())) {
    throw UserError(
        "--scale-mm without --scale-points: its ends are clicked in the camera's picture, which --layout alone does "
        "not "
        "show, and a --take must know the scale before it starts; give --scale-points X1,Y1,X2,Y2",
        2);
  }
}

}  // namespace

void add_live(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("live", "Open a window: the camera beside the character that swims like the fish");
  auto options = std::make_shared<Options>();
  add_capture_options(*command, options->capture);
  options->capture.scale_by_clicks = true;
  add_cast_options(*command, options->cast, options->capture);
  options->cast.renderer_places = true;
  command
      ->add_option("--layout", options->layout,
                   "beside: camera left, character right; behind: character over the camera; alone: character only")
      ->type_name("beside|behind|alone")
      ->check(CLI::IsMember({"beside", "behind", "alone"}));
  add_backdrop_option(*command, [options](const BackdropOption& backdrop) {
    options->backdrop = backdrop;
    options->has_backdrop = true;
  });
  add_display_options(*command, options->display, true);
  add_thread_options(*command, options->threads, true);
  command
      ->add_option_function<std::string>(
          "--info-text",
          [options](const std::string& text) {
            check_info_text(text);
            options->info_text = text;
          },
          std::string("the lines in the window, '' for none; filled in: ") + kInfoNames)
      ->type_name("TEXT");
  command
      ->add_option("--record-to", options->record_to,
                   "what r records: PREFIX-1.take, PREFIX-1.csv and PREFIX-1.mp4, then -2, ...")
      ->type_name("PREFIX");
  command
      ->add_option("--pre-record", options->pre_record_s,
                   "seconds before r was pressed that are recorded too, in the take (default 5)")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 60.0));
  command->add_option("--take", options->take, "record all of the run in a take")->type_name("FILE.take");
  command->add_flag("--keep-video", options->keep_video, "keep the camera's pictures beside each take: FILE.take.mkv");
  command->add_option("--json", options->json, "report of the run at its end ('-' = standard output)")
      ->type_name("FILE");
  command->footer(std::string("Keys: ") + kKeys + "\nExample: neontetra live -c sim --character carp.ntchar");
  command->callback([&action, options] {
    action = [options] {
      check(*options);
      Live(*options).run();
    };
  });
}

}  // namespace nt
