// SPDX-License-Identifier: Apache-2.0
#include "app/commands/character_corrections.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include <opencv2/core.hpp>

#include "app/author/character_file.h"
#include "app/author/preview.h"
#include "app/export/png.h"
#include "app/numbers.h"
#include "app/text_file.h"
#include "app/ui/character_editor.h"
#include "app/ui/window.h"
#include "platform/camera.h"

namespace nt {
namespace {

bool exists(const std::string& path) {
  std::error_code unused;
  return std::filesystem::exists(path, unused);
}

}  // namespace

void add_correction_options(CLI::App& command, CorrectionOptions& options) {
  // Ahead of what --set says: --fins 2 --set r_fin_2=none.
  const auto key = [&](const char* option, const std::string& name, const char* help, const char* type) {
    const auto take = [&options, name](const std::string& value) {
      options.set.insert(options.set.begin(), name + "=" + value);
    };
    command.add_option_function<std::string>(option, take, help)->type_name(type);
  };
  command
      .add_option("--corrections", options.file,
                  "what to change about the proposal (default: FILE.corrections.txt beside the character; 'none')")
      ->type_name("FILE.txt");
  command
      .add_option(
          "--set", options.set,
          "one such change, in pixels of the figure: head=900,300 l_fin=none midline='900,300 100,310'; repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  key("--u-num", "u_num", "axis points centre to head, 1 to 8 (default 3)", "N");
  key("--l-num", "l_num", "axis points centre to tail, 1 to 32 (default 15)", "N");
  key("--harmonics", "harmonics", "S, elliptic Fourier harmonics of the outline, 1 to 16 (default 5)", "N");
  key("--fins", "fins", "pairs of fins: 0, 1 or 2 (default: as found)", "N");
  key("--deformer", "deformer", "rigid, similarity or affine (default rigid)", "KIND");
  command.add_flag("--list", options.list, "print every control point and how sure it is (--json: for machines)");
  command.add_flag("--json", options.json, "--list as JSON");
  command.add_flag("--edit", options.edit, "open a window: drag points, draw the midline, place fins, test-swim, save");
  add_window_options(command, options.window_size, options.display);
}

Corrections corrections_for(const CorrectionOptions& options, const std::string& character_path) {
  Corrections corrections;
  if (!options.file.empty()) {
    if (options.file != "none") corrections = load_corrections(options.file);
  } else if (!character_path.empty()) {
    const std::string beside = corrections_path(character_path);
    if (exists(beside)) {
      corrections = load_corrections(beside);
      std::fprintf(stderr, "%s: taken up again ('--corrections none' goes without)\n", beside.c_str());
    }
  }
  for (const std::string& setting : options.set) set_correction(corrections, "--set", setting);
  return corrections;
}

std::string list_of_points(const Rig& rig, bool json) {
  std::string text;
  nlohmann::ordered_json out{{"format", 1},
                             {"u_num", rig.u_num},
                             {"l_num", rig.l_num},
                             {"harmonics", rig.harmonics},
                             {"tail_fin", rig.has_tail_fin},
                             {"flip", rig.flip},
                             {"deformer", to_string(rig.deformer)}};
  for (const PointId id : points_of(rig)) {
    const Vec2 at = tidy(point_at(rig, id));
    const float sure = point_confidence(rig, id);
    char line[80];
    std::snprintf(line, sizeof line, "%-12s %8.1f,%-8.1f %3.0f %%\n", point_name(id).c_str(), static_cast<double>(at.x),
                  static_cast<double>(at.y), static_cast<double>(100 * sure));
    text += line;
    const auto tenth = [](float v) { return std::round(static_cast<double>(v) * 10) / 10; };
    out["points"][point_name(id)] = {
        {"x", tenth(at.x)}, {"y", tenth(at.y)}, {"confidence", std::round(static_cast<double>(sure) * 1000) / 1000}};
  }
  return json ? out.dump(2) + "\n" : text;
}

void write_preview(const std::string& path, const Character& character) {
  const cv::Mat picture = draw_preview(character);
  Picture out;
  out.pixels = picture.data, out.width = picture.cols, out.height = picture.rows;
  out.stride = static_cast<int>(picture.step), out.format = PixelFormat::rgb8;
  write_png(path, out);
}

void save_character(const std::string& path, const Character& character, const Corrections& corrections) {
  const std::vector<std::byte> bytes = character_bytes(character);
  const LoadedCharacter checked(bytes, path, Limits{});  // the same checks as when it is used
  const std::string beside = corrections_path(path);
  // A file with the same content stays as it was written, comments and all.
  const bool as_before = exists(beside) && corrections_text(load_corrections(beside)) == corrections_text(corrections);
  write_character_file(path, bytes);
  if (as_before) return;
  // Somebody's work, with its comments: out of the way, not gone.
  if (exists(beside)) std::filesystem::rename(beside, beside + ".before");
  if (!corrections.empty()) save_corrections(beside, corrections);
}

void edit_character(const std::string& path, const Character& character, const Corrections& corrections,
                    const CorrectionOptions& options,
                    const std::function<void(const Character&, const Corrections&)>& save) {
  const Size size = parse_size("--window-size", options.window_size);
  const std::unique_ptr<Display> display = open_window("neontetra: " + std::filesystem::path(path).filename().string(),
                                                       size.width, size.height, options.display, WindowMode::large);
  CharacterEditor editor(*display, std::filesystem::path(path).filename().string(), character, corrections, save);
  run(editor);
}

}  // namespace nt
