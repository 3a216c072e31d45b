// SPDX-License-Identifier: Apache-2.0
// neontetra export: a take, with its edits, for other programs.
//
// glb, bvh, csv, json and sprite hold one fish, mp4 and png all of the take.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/commands/take_options.h"
#include "app/export/bvh.h"
#include "app/export/film.h"
#include "app/export/glb.h"
#include "app/export/pose_json.h"
#include "app/export/pose_table.h"
#include "app/export/report.h"
#include "app/export/take_pictures.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/text_file.h"
#include "app/ui/backdrop.h"
#include "platform/camera.h"

namespace nt {
namespace {

struct Options {
  TakeOptions take;
  std::string to, out, json;
  std::optional<double> length;
  BackdropOption backdrop;
};

// What is being exported, and what is told of it.
struct Export {
  const Options& options;
  const std::vector<EditedTake>& fish;
  const std::vector<Performance>& performances;
  const Wardrobe* wardrobe;  // null where nobody is named
  Json report;

  const EditedTake& take() const { return fish.front(); }
  const Performance& shown() const { return performances.front(); }
  float scale() const { return static_cast<float>(take().info.source_width) / static_cast<float>(take().info.width); }
};

std::vector<Motion> motions_of(const Performance& performance) {
  std::vector<Motion> motions;
  for (const Sighting& sighting : performance.frames) motions.push_back(sighting.motion);
  return motions;
}

void to_bvh(Export& e) {
  write_text(e.options.out, bvh(motions_of(e.shown()), e.take().shape, e.shown().fps, e.options.length.value_or(1)));
}

void to_csv(Export& e) {
  std::vector<FishPose> poses;
  for (const Motion& motion : motions_of(e.shown())) poses.push_back(pose_of(motion, e.take().shape));
  write_text(e.options.out, pose_table(poses, e.scale()));
}

void to_json(Export& e) { write_text(e.options.out, pose_json(e.take(), e.shown(), e.wardrobe)); }

void to_glb(Export& e) {
  GlbOptions glb;
  glb.length = e.options.length.value_or(1), glb.source_scale = e.scale(), glb.name = e.take().info.name;
  const GlbReport made = write_glb(e.options.out, *e.wardrobe, e.shown(), glb);
  e.report["frame_of_reference"] = made.frame, e.report["deformer"] = made.deformer;
  e.report["vertices"] = made.vertices, e.report["joints"] = made.joints, e.report["keys"] = made.keys;
  e.report["skin_error_percent"] = {{"median", made.error_median}, {"p99", made.error_p99}, {"max", made.error_max}};
  std::fprintf(
      stderr,
      "skin: off our %s by %.2f %% of the body's length in the median, %.2f %% in 99 of 100, %.2f %% at most\n%s\n",
      made.deformer.c_str(), made.error_median, made.error_p99, made.error_max, made.frame.c_str());
}

void to_mp4(Export& e) {
  const Pane pane = take_pane(e.take().info, e.scale());
  const Backdrop backdrop(e.options.backdrop, pane);
  Troupe troupe(*e.wardrobe, e.performances, pane);
  Film film(e.options.out, "", pane.width, pane.height, troupe.fps());
  Progress progress(static_cast<int64_t>(troupe.frames()));
  Scene scene;
  std::size_t i = 0;
  for (; i < troupe.frames() && !interrupted(); ++i) {
    troupe.show(i, 1);
    scene.clear(pane.width, pane.height, backdrop.colour());
    backdrop.draw(scene);
    troupe.draw(scene);
    film.add(scene);
    progress.show(static_cast<int64_t>(i) + 1);
  }
  film.finish();
  e.report["frames"] = i;
  e.report["width"] = pane.width, e.report["height"] = pane.height;
}

void to_png(Export& e) {
  const Pane pane = take_pane(e.take().info, e.scale());
  Troupe troupe(*e.wardrobe, e.performances, pane);
  const PngSeries made = write_png_series(e.options.out, troupe, pane);
  e.report["first_file"] = made.first_file, e.report["frames"] = made.frames;
  e.report["width"] = pane.width, e.report["height"] = pane.height;
}

void to_sprite(Export& e) {
  const double filmed_px = static_cast<double>(e.take().init_len * e.scale());
  const SpriteSheet made =
      write_sprites(e.options.out, e.take(), e.shown(), *e.wardrobe, e.options.length.value_or(filmed_px));
  e.report["width"] = made.width, e.report["height"] = made.height;
  e.report["cell"] = {{"width", made.cell_width}, {"height", made.cell_height}, {"columns", made.columns}};
  e.report["description"] = made.json_path;
  std::fprintf(stderr, "%dx%d pixels, %d cells of %dx%d a row; %s has where they are\n", made.width, made.height,
               made.columns, made.cell_width, made.cell_height, made.json_path.c_str());
}

struct Format {
  const char* name;
  void (*write)(Export&);
  bool needs_character, frame_by_frame, is_text;  // frame by frame: of all fish
};
constexpr Format kFormats[] = {
    {"glb", to_glb, true, false, false},       {"bvh", to_bvh, false, false, true}, {"csv", to_csv, false, false, true},
    {"json", to_json, false, false, true},     {"mp4", to_mp4, true, true, false},  {"png", to_png, true, true, false},
    {"sprite", to_sprite, true, false, false},
};

const Format& format_of(const std::string& name) {
  for (const Format& format : kFormats)
    if (name == format.name) return format;
  throw UserError("--to: no such format: " + name, 2);
}

Json report_of(const Options& options, const EditedTake& take, const Performance& shown) {
  Json json = {{"format", kReportFormat}, {"program", "neontetra " NEONTETRA_VERSION},
               {"take", take.info.name},  {"to", options.to},
               {"file", options.out},     {"frames", shown.frames.size()},
               {"fps", shown.fps},        {"loop", nullptr}};
  if (shown.loop)
    json["loop"] = {{"seam_degrees", shown.seam.angle_rad * 57.29577951308232}, {"drift_px", shown.seam.drift_px}};
  return json;
}

void export_take(const Options& options) {
  const Format& format = format_of(options.to);
  if (format.needs_character && options.take.characters.empty())
    throw UserError("--to " + options.to + ": who swims it? name a character: --character FILE", 2);
  if (!format.is_text && options.out == "-")
    throw UserError("--to " + options.to + ": no standard output; name a file", 2);
  std::vector<std::string> inputs = options.take.characters;
  inputs.push_back(options.take.take), inputs.push_back(options.backdrop.path);
  check_outputs(inputs, {options.out, options.json});
  std::vector<EditedTake> fish = load_fish(options.take.take, options.take.fish, !options.take.recorded);
  if (!format.frame_by_frame) fish.resize(1);
  const std::vector<Performance> performances = performances_of(fish, options.take);
  std::optional<Wardrobe> wardrobe;
  if (!options.take.characters.empty())
    wardrobe.emplace(options.take.characters, options.take.mls, options.take.deformer);
  Export job{options, fish, performances, wardrobe ? &*wardrobe : nullptr,
             report_of(options, fish.front(), performances.front())};
  if (!format.frame_by_frame) die_of_interrupt();
  format.write(job);
  const Performance& shown = performances.front();
  const std::string file = job.report.value("first_file", options.out);  // of a series the first
  std::fprintf(stderr, "%s%s: %zu frames at %g a second\n", file.c_str(), file == options.out ? "" : " and so on",
               job.report["frames"].get<std::size_t>(), shown.fps);
  if (interrupted()) std::fprintf(stderr, "stopped before its end\n");
  if (shown.loop)
    std::fprintf(stderr, "the loop's seam: %.1f degrees and %.1f pixels were bridged\n",
                 shown.seam.angle_rad * 57.29577951308232, shown.seam.drift_px);
  if (!options.json.empty()) write_text(options.json, pretty(job.report));
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("export", "A take, with its edits, for other programs: glb, bvh, csv, json, mp4, png, sprite");
  auto options = std::make_shared<Options>();
  add_take_options(*command, options->take);
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format.name);
  command
      ->add_option("--to", options->to,
                   "glb: the character with skin, texture and animation; bvh: spine and fins for Blender; csv: points "
                   "for pose tools; json: points and angles; mp4: a video; png: pictures with alpha; sprite: a sheet "
                   "of pictures and its JSON")
      ->type_name("glb|bvh|csv|json|mp4|png|sprite")
      ->check(CLI::IsMember(names))
      ->required();
  command->add_option("-o,--out", options->out, "the file ('-' = standard output, for text)")
      ->type_name("FILE")
      ->required();
  command
      ->add_option_function<double>(
          "--length", [options](double length) { options->length = length; },
          "length of the fish: in a glb or bvh in the file's units, in a glb metres (default 1); in a sprite sheet in "
          "pixels (default as filmed)")
      ->type_name("L")
      ->check(CLI::Range(1e-6, 1e6));
  add_backdrop_option(*command, [options](const BackdropOption& backdrop) { options->backdrop = backdrop; });
  command->add_option("--json", options->json, "what was written and how exact it is ('-' = standard output)")
      ->type_name("FILE");
  command->footer("Example: neontetra export noon.take --character carp.ntchar --to glb --out noon.glb");
  command->callback([&action, options] { action = [options] { export_take(*options); }; });
}

}  // namespace nt
