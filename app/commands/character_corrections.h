// SPDX-License-Identifier: Apache-2.0
// The part of `neontetra character` that corrects control points: options -> corrections -> points, files, a window.
//
// A character keeps its corrections in a text file beside it (docs/FORMATS.md, "Corrections"). They are taken up again when
// the character is made anew under the same name, unless `--corrections` names other ones or `none`.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/author/rigged_figure.h"
#include "app/ui/window.h"

namespace CLI {
class App;
}

namespace nt {

struct CorrectionOptions {
  std::string file;              // --corrections; "none"
  std::vector<std::string> set;  // --set, and the options that say the same
  bool edit = false, list = false, json = false;
  std::string window_size = "1280x720";
  DisplayOptions display;
};

void add_correction_options(CLI::App& command, CorrectionOptions& options);

// From the file asked for, or the one beside `character_path` where there is one, then --set. Throws UserError.
Corrections corrections_for(const CorrectionOptions& options, const std::string& character_path);

// Every control point: name, x, y in figure pixels, how sure; as text or JSON.
std::string list_of_points(const Rig& rig, bool json);

// The picture of the figure with its mesh and control points.
void write_preview(const std::string& path, const Character& character);

// Writes the character; its corrections beside it where there are any, or were.
void save_character(const std::string& path, const Character& character, const Corrections& corrections);

// Opens the window and comes back when it is closed; `save` is called with what is to be saved. Throws UserError where there
// is no display.
void edit_character(const std::string& path, const Character& character, const Corrections& corrections,
                    const CorrectionOptions& options,
                    const std::function<void(const Character&, const Corrections&)>& save);

}  // namespace nt
