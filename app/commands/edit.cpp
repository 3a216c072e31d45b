// SPDX-License-Identifier: Apache-2.0
// neontetra edit: the edit list of a take, from a text file. The recording beside it is never changed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/cli.h"
#include "app/take/edited.h"
#include "app/text_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

struct Options {
  std::string take, edits;
  bool list = false, clear = false;
};

std::vector<std::string> lines_of(const std::vector<Edit>& edits) {
  std::vector<std::string> lines;
  for (const Edit& edit : edits) lines.push_back(to_line(edit));
  return lines;
}

void edit(const Options& options) {
  if (static_cast<int>(options.list) + static_cast<int>(options.clear) + static_cast<int>(!options.edits.empty()) != 1)
    throw UserError("edit: say one of --edits FILE, --list, --clear", 2);
  if (options.list) {
    std::string text;
    for (const std::string& line : Take::open(options.take, Take::Access::read).edits()) text += line + "\n";
    write_text("-", text);
    return;
  }
  Take take = Take::open(options.take, Take::Access::edit);
  const std::vector<Edit> edits = options.clear ? std::vector<Edit>{} : read_edits(options.edits);
  Seam seam;
  std::size_t frames = 0;
  for (const int fish : take.fish()) {  // edits that do not fit are not kept
    std::vector<Motion> motions;
    for (const TakeFrame& frame : take.frames(fish)) motions.push_back(frame.motion);
    const Clip clip = apply_edits(std::move(motions), straight_motion(take.info().u_num, take.info().l_num), edits);
    seam = clip.seam, frames = clip.motions.size();
  }
  take.set_edits(lines_of(edits));
  take.close();
  std::fprintf(stderr, "%zu edits, %zu frames\n", edits.size(), frames);
  if (seam.angle_rad > 0)
    std::fprintf(stderr, "the loop's seam: %.1f degrees and %.1f pixels were bridged\n", seam.angle_rad * 57.2957795,
                 seam.drift_px);
}

}  // namespace

void add_edit(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("edit", "Fine-tune a take by a list of edits; the recording is kept");
  auto options = std::make_shared<Options>();
  command->add_option("take", options->take, "the take")->type_name("FILE.take")->required();
  command
      ->add_option("--edits", options->edits,
                   "a text file of edits, one a line (docs/FORMATS.md), in place of the list")
      ->type_name("FILE");
  command->add_flag("--list", options->list, "print the list");
  command->add_flag("--clear", options->clear, "back to the recording");
  command->footer("Example: neontetra edit noon.take --edits calmer.txt");
  command->callback([&action, options] { action = [options] { edit(*options); }; });
}

}  // namespace nt
