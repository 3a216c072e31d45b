// SPDX-License-Identifier: Apache-2.0
// neontetra play: a take, with its edits, swum by any character in a window or a video.
//
// Unless --rate says otherwise as many frames are drawn between two recorded ones as stay at or under 60 a second. A
// window that is too slow skips frames and keeps the take's own speed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/commands/take_options.h"
#include "app/export/film.h"
#include "app/pacer.h"
#include "app/progress.h"
#include "app/ui/backdrop.h"
#include "app/ui/text.h"
#include "app/ui/window.h"
#include "platform/camera.h"
#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr double kSmoothFps = 60;
constexpr const char* kKeys = "space pause  left right frame by frame  c next character  i info  q quit";

struct Options {
  TakeOptions take;
  BackdropOption backdrop;
  std::string out;
  DisplayOptions display;
};

class Player {
 public:
  Player(const TakeInfo& info, const Options& options, std::vector<Performance> performances)
      : wardrobe_(options.take.characters, options.take.mls, options.take.deformer),
        pane_(take_pane(info, std::max(1.0f, 640.0f / static_cast<float>(info.width)))),
        backdrop_(options.backdrop, pane_),
        troupe_(wardrobe_, std::move(performances), pane_),
        loop_(options.take.moments.loop) {}

  void film(const std::string& path) {
    Film film(path, "", pane_.width, pane_.height, troupe_.fps());
    Progress progress(static_cast<int64_t>(troupe_.frames()));
    for (; at_ < troupe_.frames() && !interrupted(); ++at_) {
      troupe_.show(at_, 1);
      compose();
      film.add(scene_);
      progress.show(static_cast<int64_t>(at_) + 1);
    }
    film.finish();
    std::fprintf(stderr, "%s: %lld drawn frames at %g a second\n", path.c_str(), static_cast<long long>(film.frames()),
                 troupe_.fps());
  }

  void window(const DisplayOptions& options) {
    display_ = open_window("neontetra", pane_.width, pane_.height, options);
    Pacer pacer(static_cast<int64_t>(1e9 / troupe_.fps()));
    pacer.start(steady_now_ns());
    troupe_.show(0, 1);
    while (!quit_ && !interrupted()) {
      handle_events(pacer);
      if (!paused_ && pacer.due(steady_now_ns()) && !advance(1 + pacer.take(steady_now_ns()))) break;
      compose();
      write_info();
      display_->draw(scene_);
      sleep_until_ns(paused_ ? steady_now_ns() + kPausedPeriod_ns : pacer.due_ns());
    }
  }

 private:
  static constexpr int64_t kPausedPeriod_ns = 16'000'000;

  // False at the end.
  bool advance(int frames) {
    const std::size_t next = at_ + static_cast<std::size_t>(frames);
    if (next >= troupe_.frames() && !loop_) return false;
    at_ = next % troupe_.frames();
    troupe_.show(at_, frames);
    return true;
  }

  void handle_events(Pacer& pacer) {
    display_->poll(events_);
    for (const InputEvent& event : events_) {
      if (event.kind == InputEvent::Kind::quit) quit_ = true;
      if (event.kind == InputEvent::Kind::key) press(event.key, pacer);
    }
  }

  void press(int key, Pacer& pacer) {
    switch (key) {
      case ' ':
        paused_ = !paused_;
        pacer.start(steady_now_ns());
        break;
      case kKeyRight:
      case kKeyLeft:
        paused_ = true;
        step(key == kKeyRight ? 1 : -1);
        break;
      case 'c':
        troupe_.next_character();
        troupe_.show(at_, 1);
        break;
      case 'i':
        info_ = !info_;
        break;
      case 'q':
      case 27:
        quit_ = true;
        break;
      default:
        break;
    }
  }

  // Stays inside unless it is a loop. A long time passes for the filters: they take the frame as it is.
  void step(int frames) {
    const auto count = static_cast<int>(troupe_.frames());
    const int next = static_cast<int>(at_) + frames;
    at_ = static_cast<std::size_t>(loop_ ? (next + count) % count : std::clamp(next, 0, count - 1));
    troupe_.show(at_, static_cast<int>(std::ceil(troupe_.fps())));
  }

  void compose() {
    scene_.clear(pane_.width, pane_.height, backdrop_.colour());
    backdrop_.draw(scene_);
    troupe_.draw(scene_);
  }

  void write_info() {
    if (!info_) return;
    char line[120];
    std::snprintf(line, sizeof line, "frame %zu of %zu, %.2f s%s\n", at_ + 1, troupe_.frames(),
                  static_cast<double>(at_) / troupe_.fps(), paused_ ? ", paused" : "");
    text_.set(line + wardrobe_.path(troupe_.costume()) + "\n" + kKeys);
    text_.draw(scene_, {8, static_cast<float>(pane_.height) - 64});
  }

  Wardrobe wardrobe_;
  Pane pane_;
  Backdrop backdrop_;
  Troupe troupe_;
  bool loop_;
  std::unique_ptr<Display> display_;
  std::vector<InputEvent> events_;
  Text text_{kFirstTextPicture};
  Scene scene_;
  std::size_t at_ = 0;
  bool paused_ = false, quit_ = false, info_ = true;
};

void play(Options options) {
  if (options.take.characters.empty()) throw UserError("play: who swims it? name a character: --character FILE", 2);
  std::vector<std::string> inputs = options.take.characters;
  inputs.push_back(options.take.take), inputs.push_back(options.backdrop.path);
  check_outputs(inputs, {options.out});
  const std::vector<EditedTake> fish = load_fish(options.take.take, options.take.fish, !options.take.recorded);
  Moments& moments = options.take.moments;
  const double fps = fish.front().info.fps;
  if (!moments.rate) moments.rate = fps * std::max(1.0, std::floor(kSmoothFps / fps + 0.01));
  Player player(fish.front().info, options, performances_of(fish, options.take));
  if (options.out.empty()) player.window(options.display);
  else player.film(options.out);
}

}  // namespace

void add_play(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("play", "A take swum by any character, in a window or a video");
  auto options = std::make_shared<Options>();
  add_take_options(*command, options->take);
  command->add_option("--speed", options->take.moments.speed, "so many times as fast (default 1)")
      ->type_name("X")
      ->check(CLI::Range(0.01, 100.0));
  command->add_option("-o,--out", options->out, "a video in place of the window")->type_name("FILE.mp4");
  add_backdrop_option(*command, [options](const BackdropOption& backdrop) { options->backdrop = backdrop; });
  add_display_options(*command, options->display, true);
  command->footer(std::string("Keys: ") + kKeys +
                  "\nExample: neontetra play noon.take --character carp.ntchar --speed 0.5 --loop");
  command->callback([&action, options] { action = [options] { play(*options); }; });
}

}  // namespace nt
