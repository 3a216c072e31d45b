// SPDX-License-Identifier: Apache-2.0
// bench_take_editor [--frames N] [--character FILE] [--size WxH] [--json]
// The take editor on a long take, ten minutes at 30 frames a second unless told otherwise, at 800x480 on SDL's driver without a
// screen (SDL_VIDEODRIVER=x11: in a window): how long it takes to open and how much memory, and how long from a finger that
// moves to the picture that shows it, in the middle of the take, with everything drawn that the window shows at first.
// Times of pictures depend on the GL driver, which is named; each picture is waited for until its last pixel is there.
#include <GLES3/gl3.h>
#include <SDL2/SDL.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/ui/take_editor.h"
#include "platform/linux/process_memory.h"
#include "tests/app/swimming_motion.h"
#include "tests/support/temp_dir.h"

namespace {

using nt::Vec2;
using Clock = std::chrono::steady_clock;

constexpr nt::MotionProperty kTail{nt::MotionProperty::Kind::tail, 0};
constexpr int kPulls = 120;
constexpr double kDisplayFrame_ms = 1000.0 / 60;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

void record(const std::string& path, int frames) {
  nt::TakeInfo info;
  info.name = "bench", info.source_width = info.width = 960, info.source_height = info.height = 544, info.fps = 30;
  nt::Take take = nt::Take::create(path, info);
  std::vector<nt::TakeFrame> rows;
  for (const nt::Motion& motion : nt::swimming(frames)) {
    nt::TakeFrame& row = rows.emplace_back();
    row.frame = static_cast<int64_t>(rows.size()) - 1, row.init_len = 180;
    row.motion = motion;
    row.motion.centre = {480 + 200 * std::sin(motion.centre.x / 500), 272};
    row.pose.status = motion.status;
  }
  take.append(rows);
  take.close();
}

void finger(Uint32 type, Vec2 at, nt::DisplaySize size) {
  SDL_Event event{};
  event.type = type;
  event.tfinger.x = at.x / static_cast<float>(size.width), event.tfinger.y = at.y / static_cast<float>(size.height);
  SDL_PushEvent(&event);
}

// Of all threads; another program that runs meanwhile costs the clock on the wall more than this.
double processor_ms() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
}

struct Times {
  std::vector<double> still_ms, edited_ms, applied_ms;
  double edited_processor_ms = 0;  // mean
};

// Pictures with nothing to do, then pictures while a finger pulls the tail to and fro; and the edit without a picture.
Times measure(nt::TakeEditor& window, nt::Display& display, nt::ClipEditor& model, nt::Puppet& puppet) {
  Times times;
  const auto frame_ms = [&] {
    const auto start = Clock::now();
    window.frame(0);
    glFinish();
    return ms_since(start);
  };
  const nt::Area strip = window.strip();
  finger(SDL_FINGERDOWN, strip.centre(), display.size());
  for (int i = 0; i < 4; ++i) frame_ms();
  finger(SDL_FINGERUP, strip.centre(), display.size());
  for (int i = 0; i < 4; ++i) frame_ms();
  if (std::abs(window.editor().frame() - window.editor().frames() / 2) > 50)
    throw std::runtime_error("the finger has not reached the middle");
  for (int i = 0; i < kPulls; ++i) times.still_ms.push_back(frame_ms());
  const Vec2 tail = window.on_screen(kTail);
  finger(SDL_FINGERDOWN, tail, display.size());
  for (int i = 0; i < 4; ++i) frame_ms();
  const double used_ms = processor_ms();
  for (int i = 0; i < kPulls; ++i) {
    finger(SDL_FINGERMOTION, tail + Vec2{0, 30 * std::sin(0.3f * static_cast<float>(i))}, display.size());
    times.edited_ms.push_back(frame_ms());
  }
  times.edited_processor_ms = (processor_ms() - used_ms) / kPulls;
  finger(SDL_FINGERUP, tail, display.size());
  for (int i = 0; i < 4; ++i) frame_ms();
  if (window.editor().edits().empty()) throw std::runtime_error("the finger has pulled at nothing");
  // In the middle of the take: from where the handle is pulled to, by the number that brings it there, to the clip with it.
  model.go_to(model.frames() / 2);
  const nt::Motion held = model.motions()[static_cast<std::size_t>(model.frame())];
  const nt::FigureView view{1.2f, held.centre, {260, 180}, false};
  model.hold(kTail);
  for (int i = 0; i < kPulls; ++i) {
    const float x = 90 * std::cos(0.02f * static_cast<float>(i)), y = 60 * std::sin(0.3f * static_cast<float>(i));
    const auto start = Clock::now();
    const nt::ClipEditor::Setting setting{kTail, puppet.value_for(held, kTail, view.to - Vec2{x, y}, view)};
    model.drag_to({&setting, 1});
    times.applied_ms.push_back(ms_since(start));
  }
  model.release();
  return times;
}

double time_of(const auto& action) {
  const auto start = Clock::now();
  action();
  return ms_since(start);
}

void run(int frames, const std::string& character, nt::DisplaySize size, bool json) {
  const nt::TempDir folder;
  const std::string path = folder / "long.take";
  record(path, frames);
  setenv("SDL_VIDEODRIVER", "offscreen", 0);
  const nt::Wardrobe wardrobe({character}, std::nullopt);
  const std::unique_ptr<nt::Display> display = nt::open_sdl_display("bench", size.width, size.height);
  nt::give_back_freed_memory();
  const int64_t before_bytes = nt::resident_bytes();
  const auto start = Clock::now();
  nt::Take take = nt::Take::open(path, nt::Take::Access::edit);
  nt::EditedClip clip = nt::load_clip(take, path, -1);
  nt::ClipEditor model(clip.recorded, clip.edits, clip.fps);
  const double read_ms = ms_since(start);
  nt::TakeEditor window(*display, std::move(clip), wardrobe,
                        [](const std::vector<nt::Edit>&) {});  // the take is read, not written
  window.frame(0);
  const double open_ms = ms_since(start);
  const int64_t open_bytes = nt::resident_bytes() - before_bytes;
  nt::Puppet puppet(wardrobe, 180);
  const Times times = measure(window, *display, model, puppet);
  const double smooth_ms = time_of([&] { model.smooth(); }), undo_ms = time_of([&] { model.undo(); });
  const double still = quantile(times.still_ms, 0.5), edited = quantile(times.edited_ms, 0.5);
  const nlohmann::ordered_json out{{"frames", frames},
                                   {"width", size.width},
                                   {"height", size.height},
                                   {"renderer", display->renderer()},
                                   {"read_ms", read_ms},
                                   {"open_ms", open_ms},
                                   {"open_bytes", open_bytes},
                                   {"process_bytes", nt::resident_bytes()},
                                   {"edit_applied_ms", quantile(times.applied_ms, 0.5)},
                                   {"edit_applied_p99_ms", quantile(times.applied_ms, 0.99)},
                                   {"picture_ms", still},
                                   {"picture_with_edit_ms", edited},
                                   {"picture_with_edit_p95_ms", quantile(times.edited_ms, 0.95)},
                                   {"picture_with_edit_processor_ms", times.edited_processor_ms},
                                   {"share_of_a_display_frame", edited / kDisplayFrame_ms},
                                   {"smooth_whole_ms", smooth_ms},
                                   {"undo_ms", undo_ms}};
  if (json) {
    std::printf("%s\n", out.dump(2).c_str());
    return;
  }
  for (const auto& [key, value] : out.items()) std::printf("%-36s %s\n", key.c_str(), value.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  int frames = 18'000;
  std::string character = NEONTETRA_ASSETS "/characters/carp.png";
  nt::DisplaySize size{800, 480};
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--json") json = true;
    else if (word == "--frames" && i + 1 < argc) frames = std::max(std::atoi(argv[++i]), 200);
    else if (word == "--character" && i + 1 < argc) character = argv[++i];
    else if (word == "--size" && i + 1 < argc && std::sscanf(argv[++i], "%dx%d", &size.width, &size.height) == 2)
      continue;
    else
      return std::fprintf(stderr, "usage: bench_take_editor [--frames N] [--character FILE] [--size WxH] [--json]\n"),
             2;
  }
  try {
    run(frames, character, size, json);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "bench_take_editor: %s\n", error.what()), 1;
  }
  return 0;
}
