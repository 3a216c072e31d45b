// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <CLI/CLI.hpp>
#include <limits>

#include "app/nearest_name.h"
#include "platform/camera.h"

namespace nt {

BackgroundOption parse_background(const std::string& text) {
  using Kind = BackgroundOption::Kind;
  if (text == "auto") return {};
  if (text == "vibe") return {Kind::vibe, ""};
  if (text == "backlit") return {Kind::backlit, ""};
  if (text == "still") return {Kind::still, ""};
  if (text.starts_with("still:") && text.size() > 6) return {Kind::still, text.substr(6)};
  const std::vector<std::string> names = {"vibe", "still", "backlit", "auto"};
  throw UserError("--background: unknown model '" + text + "'; did you mean '" +
                      nearest_name(text.substr(0, text.find(':')), names) +
                      "'? (there are: vibe, still[:PICTURE], backlit, auto)",
                  2);
}

SelectOption parse_select(const std::string& text) {
  if (text == "auto") return {};
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    throw UserError("--select must be auto or X,Y in pixels of the source video, not '" + text + "'", 2);
  }
  SelectOption select;
  select.automatic = false;
  select.at.x = static_cast<float>(parse_number("--select X", text.substr(0, comma), 0, 65535));
  select.at.y = static_cast<float>(parse_number("--select Y", text.substr(comma + 1), 0, 65535));
  return select;
}

void add_capture_options(CLI::App& command, CaptureOptions& o) {
  // CLI11 would print a default through operator<<; these options show theirs in the text instead.
  const auto text = [&command](const char* name, auto&& take, const char* type, const char* help) {
    return command.add_option_function<std::string>(name, take, help)->type_name(type)->option_text(type);
  };
  text(
      "-c,--camera", [&o](const std::string& s) { o.camera = parse_camera_spec(s); }, "SPEC",
      "where frames come from: sim[:scene=NAME][,seed=N][,size=WxH][,fps=N][,frames=N] is the simulated tank, "
      "file:PATH (or just PATH) a video or image sequence")
      ->required();
  text(
      "--work-size", [&o](const std::string& s) { o.work = parse_size("--work-size", s); }, "WxH",
      "largest frame to work on; never larger than the source (default: as many pixels as 960x544)");
  text(
      "--fps", [&o](const std::string& s) { o.fps = parse_number("--fps", s, 0.01, 100000); }, "N",
      "the true frame rate, where the file's own is wrong");
  text(
      "--frames", [&o](const std::string& s) { o.frames = parse_integer("--frames", s, 0, 1'000'000'000); }, "N",
      "stop after N frames (default 0: all)");
  text(
      "--background", [&o](const std::string& s) { o.background = parse_background(s); }, "MODEL",
      "vibe (moving fish), still[:PICTURE] (empty-tank picture, or the clip's median), backlit (fish on an even bright "
      "or dark field), auto (tests the clip and says why; default)");
  text(
      "--select", [&o](const std::string& s) { o.select = parse_select(s); }, "X,Y",
      "the fish nearest to this pixel of the source video, or auto: the one that moves and stays fish-shaped "
      "(default)");
  text(
      "--harmonics",
      [&o](const std::string& s) { o.harmonics = static_cast<int>(parse_integer("--harmonics", s, 1, 16)); }, "N",
      "elliptic Fourier harmonics of the outline (default 5)");
  text(
      "--seed",
      [&o](const std::string& s) {
        o.seed = static_cast<uint64_t>(parse_integer("--seed", s, 0, std::numeric_limits<int64_t>::max()));
      },
      "N", "of the background model's random choices; the same seed gives the same result (default 1)");
}

std::vector<std::string> inputs_of(const CaptureOptions& options) {
  return {options.camera.path, options.background.picture};
}

}  // namespace nt
