// SPDX-License-Identifier: Apache-2.0
// neontetra edit: the edit list of a take, in a window or from a text file. The recording beside it is never changed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/cli.h"
#include "app/session.h"
#include "app/take/edited.h"
#include "app/text_file.h"
#include "app/ui/take_editor.h"
#include "app/ui/window.h"
#include "app/wardrobe.h"
#include "platform/camera.h"

namespace nt {
namespace {

struct Options {
  std::string take, edits, character;
  bool list = false, clear = false;
  int fish = -1;
  std::string window_size = "1280x720";
  DisplayOptions display;
};

std::vector<std::string> lines_of(const std::vector<Edit>& edits) {
  std::vector<std::string> lines;
  for (const Edit& edit : edits) lines.push_back(to_line(edit));
  return lines;
}

void print_list(const Options& options) {
  std::string text;
  for (const std::string& line : Take::open(options.take, Take::Access::read).edits()) text += line + "\n";
  write_text("-", text);
}

void replace_list(const Options& options) {
  Take take = Take::open(options.take, Take::Access::edit);
  const std::vector<Edit> edits = options.clear ? std::vector<Edit>{} : read_edits(options.edits);
  Seam seam;
  std::size_t frames = 0;
  for (const int fish : take.fish()) {  // edits that do not fit are not kept
    const Clip clip = apply_edits(recorded_motion(take, fish).motions,
                                  straight_motion(take.info().u_num, take.info().l_num), edits_for(edits, fish));
    seam = clip.seam, frames = clip.motions.size();
  }
  take.set_edits(lines_of(edits));
  take.close();
  std::fprintf(stderr, "%zu edits, %zu frames\n", edits.size(), frames);
  if (seam.angle_rad > 0)
    std::fprintf(stderr, "the loop's seam: %.1f degrees and %.1f pixels were bridged\n", seam.angle_rad * 57.2957795,
                 seam.drift_px);
}

void open_editor(const Options& options) {
  const Size size = parse_size("--window-size", options.window_size);
  Take take = Take::open(options.take, Take::Access::edit);
  EditedClip clip = load_clip(take, options.take, options.fish);
  const Wardrobe wardrobe({options.character}, std::nullopt);
  const std::unique_ptr<Display> display =
      open_window("neontetra: " + std::filesystem::path(options.take).filename().string(), size.width, size.height,
                  options.display, WindowMode::large);
  TakeEditor editor(*display, std::move(clip), wardrobe,
                    [&](const std::vector<Edit>& edits) { take.set_edits(lines_of(edits)); });
  run(editor);
  take.close();
}

void edit(const Options& options) {
  const int ways = static_cast<int>(options.list) + static_cast<int>(options.clear) +
                   static_cast<int>(!options.edits.empty()) + static_cast<int>(!options.character.empty());
  if (ways != 1)
    throw UserError("edit: say one of --character FILE, which opens the editor, --edits FILE, --list, --clear", 2);
  if (options.list) print_list(options);
  else if (!options.character.empty()) open_editor(options);
  else replace_list(options);
}

}  // namespace

void add_edit(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("edit", "Fine-tune a take, in a window or by a list of edits; the recording is kept");
  auto options = std::make_shared<Options>();
  command->add_option("take", options->take, "the take")->type_name("FILE.take")->required();
  command
      ->add_option("--edits", options->edits,
                   "a text file of edits, one a line (docs/FORMATS.md), in place of the list")
      ->type_name("FILE");
  command->add_option("-c,--character", options->character, "opens the editor: the take as swum by this character")
      ->type_name("FILE");
  command->add_option("--fish", options->fish, "which fish of the take the editor shows (default: the first)")
      ->type_name("N");
  add_window_options(*command, options->window_size, options->display);
  command->add_flag("--list", options->list, "print the list");
  command->add_flag("--clear", options->clear, "back to the recording");
  command->footer(
      "Example: neontetra edit noon.take --character carp.ntchar\n"
      "         neontetra edit noon.take --edits calmer.txt");
  command->callback([&action, options] { action = [options] { edit(*options); }; });
}

}  // namespace nt
