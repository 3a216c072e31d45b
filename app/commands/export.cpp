// SPDX-License-Identifier: Apache-2.0
// neontetra export: a take, with its edits, for other programs.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/bvh.h"
#include "app/export/pose_table.h"
#include "app/take/edited.h"
#include "app/text_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

struct Options {
  std::string take, to, out;
  int fish = -1;
  bool recorded = false;
  double length = 1;
};

std::string table_of(const EditedTake& take) {
  std::vector<FishPose> poses;
  for (const Motion& motion : take.clip.motions) poses.push_back(pose_of(motion, take.shape));
  return pose_table(poses, static_cast<float>(take.info.source_width) / static_cast<float>(take.info.width));
}

void export_take(const Options& options) {
  check_outputs({options.take}, {options.out});
  const EditedTake take = load_take(options.take, options.fish, !options.recorded);
  if (take.shape.axis_len() <= 0) throw UserError(options.take + ": not one frame with a pose, nothing to export");
  const std::string text =
      options.to == "bvh" ? bvh(take.clip.motions, take.shape, take.info.fps, options.length) : table_of(take);
  write_text(options.out, text);
  std::fprintf(stderr, "%s: %zu frames at %g a second\n", options.out.c_str(), take.clip.motions.size(), take.info.fps);
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("export", "A take, with its edits, for other programs: bvh, csv");
  auto options = std::make_shared<Options>();
  command->add_option("take", options->take, "the take")->type_name("FILE.take")->required();
  command->add_option("--to", options->to, "bvh: spine and fins for Blender; csv: points for pose tools")
      ->type_name("bvh|csv")
      ->check(CLI::IsMember({"bvh", "csv"}))
      ->required();
  command->add_option("-o,--out", options->out, "the file ('-' = standard output)")->type_name("FILE")->required();
  command->add_option("--fish", options->fish, "which fish of the take (default: the first)")->type_name("N");
  command->add_flag("--recorded", options->recorded, "as it was recorded, without the edits");
  command->add_option("--length", options->length, "bvh: length of the fish in the file's units (default 1)")
      ->type_name("L")
      ->check(CLI::Range(1e-6, 1e6));
  command->footer("Example: neontetra export noon.take --to bvh --out noon.bvh");
  command->callback([&action, options] { action = [options] { export_take(*options); }; });
}

}  // namespace nt
