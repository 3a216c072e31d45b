// SPDX-License-Identifier: Apache-2.0
// neontetra bench: how long each stage takes on this machine, filming the simulated tank on one thread.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/author/character_lattice.h"
#include "app/bench/lattice_table.h"
#include "app/cast.h"
#include "app/cli.h"
#include "app/export/report.h"
#include "app/session.h"
#include "app/text_file.h"
#include "core/base/simd_target.h"
#include "core/motion/inbetween.h"
#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr int64_t kTankFrames = 300;

struct Options {
  int64_t frames = 0;  // 0: 300 of the tank, all of a recording
  std::string size = "960x544";
  std::string background = "vibe";
  std::string character;
  bool json = false;
  bool lattice = false;
  std::string markers;  // a recording
  MarkerChoice choice;
};

CaptureOptions tank_options(const Options& options) {
  CaptureOptions capture;
  capture.camera = parse_camera_spec("sim:size=" + options.size);
  capture.work = parse_size("--work-size", options.size);  // timed as it is made, not shrunk
  capture.frames = options.frames > 0 ? options.frames : kTankFrames;
  capture.background = parse_background(options.background);
  return capture;
}

std::string row(const char* name, const TimeHistogram& times) {
  char text[80];
  std::snprintf(text, sizeof text, "%-12s %10.1f %10.1f\n", name, times.quantile_ns(0.5) * 1e-3,
                times.quantile_ns(0.99) * 1e-3);
  return text;
}

std::string table(Session& session, const TimeHistogram& retarget, const TimeHistogram& with_inbetweens, double fps) {
  const Statistics& statistics = session.statistics();
  const CameraInfo& info = session.info();
  std::string text = info.name + ", " + std::to_string(info.width) + "x" + std::to_string(info.height) + ", " +
                     std::to_string(statistics.frames) + " frames, background " + session.capture().background_name() +
                     ", " + simd_target() + ", one thread\n";
  text += "stage         median us     p99 us\n";
  for (std::size_t s = 0; s < kStages; ++s) text += row(kStageNames[s], statistics.stages[s]);
  text += row("capture", statistics.total);
  if (retarget.count() > 0) text += row("retarget", retarget) + row("with 5 more", with_inbetweens);
  char line[80];
  std::snprintf(line, sizeof line, "that is %.0f frames a second without camera and display\n", fps);
  return text + line;
}

// [L] Table I for one character, moved by a recording or swaying.
void bench_lattice(const Options& options) {
  const std::string path = options.character;
  if (path.empty()) throw UserError("bench: --lattice wants a 3D --character", 2);
  LoadedCharacter file = load_character(path);
  if (!file.character().lattice.present()) {
    const LatticeAsset made = fish_lattice(file.character(), {kFishLatticeVertices, LatticeForm::arap});
    Character character = file.character();
    character.lattice = made.view();
    file = LoadedCharacter(character_bytes(character), path, Limits{});
  }
  const Character& character = file.character();
  const MarkerFile recording =
      options.markers.empty() ? swaying_markers(character) : read_recording(options.markers, options.choice);
  const LatticeColumn column{
      std::filesystem::path(path).stem().string(),
      lattice_figures(character, recording, options.choice, options.frames > 0 ? options.frames : -1)};
  if (options.json) {
    write_text("-", pretty(lattice_json(column)));
    return;
  }
  write_text("-", std::string(simd_target()) + ", one thread; [L]: Table I, a Core2 Duo, other meshes and motions\n" +
                      lattice_table({column}, true));
}

void bench(const Options& options) {
  Session session(tank_options(options));
  std::optional<Wardrobe> wardrobe;
  std::optional<Actor> actor;
  if (!options.character.empty()) {
    wardrobe.emplace(std::vector<std::string>{options.character}, std::nullopt);
    actor.emplace(*wardrobe, 0);
  }
  const Pane pane = pane_for(session.info().width, session.info().height);
  const auto dt_s = static_cast<float>(1 / session.info().fps / (kInBetweens + 1));
  TimeHistogram retarget, with_inbetweens;
  Observer observer;
  while (session.step()) {
    if (!actor || session.report().status != PoseStatus::ok) continue;
    actor->see(sighting_of(observer.look(session).of_target()));
    const int64_t before_ns = steady_now_ns();
    for (int k = 0; k < kInBetweens; ++k) actor->pose(in_between_fraction(k), dt_s, pane);
    const int64_t last_ns = steady_now_ns();
    actor->pose(1, dt_s, pane);
    const int64_t after_ns = steady_now_ns();
    retarget.add(after_ns - last_ns);
    with_inbetweens.add(after_ns - before_ns);
  }
  const double frame_ns = session.statistics().total.quantile_ns(0.5) + retarget.quantile_ns(0.5);
  const double fps = frame_ns > 0 ? 1e9 / frame_ns : 0;
  if (!options.json) {
    write_text("-", table(session, retarget, with_inbetweens, fps));
    return;
  }
  Json json = report_json(session);
  json["retarget_us"] = retarget.count() > 0 ? Json(retarget.quantile_ns(0.5) * 1e-3) : Json(nullptr);
  json["retarget_with_inbetweens_us"] =
      retarget.count() > 0 ? Json(with_inbetweens.quantile_ns(0.5) * 1e-3) : Json(nullptr);
  json["frames_a_second"] = fps;
  write_text("-", pretty(json));
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("bench", "Time every stage on the simulated tank");
  auto options = std::make_shared<Options>();
  command->add_option("--frames", options->frames, "how many (default 300; with --lattice all of the recording)")
      ->type_name("N")
      ->check(CLI::Range(2, 1000000));
  command->add_option("--work-size", options->size, "frame size (default 960x544)")->type_name("WxH");
  command
      ->add_option("--background", options->background,
                   "vibe, vibe-colour, still[:PICTURE], backlit or auto (default vibe)")
      ->type_name("MODEL");
  command->add_option("--character", options->character, "also time how long it takes to pose this one")
      ->type_name("FILE");
  command->add_flag("--lattice", options->lattice,
                    "in place of the tank: what the character's lattice costs and keeps, beside Table I of its paper");
  command->add_option("--markers", options->markers, "a recording that moves the lattice (default: it sways)")
      ->type_name("FILE");
  add_marker_choice(*command, options->choice);
  command->add_flag("--json", options->json, "as JSON");
  command->footer("Example: neontetra bench --character carp.ntchar");
  command->callback(
      [&action, options] { action = [options] { options->lattice ? bench_lattice(*options) : bench(*options); }; });
}

}  // namespace nt
