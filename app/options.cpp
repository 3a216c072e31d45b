// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>

#include "app/camera_list.h"
#include "app/nearest_name.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr int kMostCorners = 256;

}  // namespace

BackgroundOption parse_background(const std::string& text) {
  using Kind = BackgroundOption::Kind;
  if (text == "auto") return {};
  if (text == "vibe") return {Kind::vibe, ""};
  if (text == "vibe-colour") return {Kind::vibe_colour, ""};
  if (text == "backlit") return {Kind::backlit, ""};
  if (text == "still") return {Kind::still, ""};
  if (text.starts_with("still:") && text.size() > 6) return {Kind::still, text.substr(6)};
  const std::vector<std::string> names = {"vibe", "vibe-colour", "still", "backlit", "auto"};
  throw UserError("--background: unknown model '" + text + "'; did you mean '" +
                      nearest_name(text.substr(0, text.find(':')), names) +
                      "'? (there are: vibe, vibe-colour, still[:PICTURE], backlit, auto)",
                  2);
}

namespace {

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return parts;
}

}  // namespace

RoiOption parse_roi(const std::string& text) {
  const std::vector<std::string> parts = parts_of(text);
  if (parts.size() != 4)
    throw UserError("--roi must be x,y,w,h in shares of the picture, 0 to 1, not '" + text + "'", 2);
  const auto share = [&](std::size_t i, const char* name, double most) {
    return parse_number(std::string("--roi ") + name, parts[i], 0, most);
  };
  RoiOption roi;
  roi.x = share(0, "x", 1), roi.y = share(1, "y", 1);
  roi.width = share(2, "w", 1), roi.height = share(3, "h", 1);
  constexpr double kRounding = 1e-6;
  if (roi.width <= 0 || roi.height <= 0 || roi.x + roi.width > 1 + kRounding || roi.y + roi.height > 1 + kRounding) {
    throw UserError(
        "--roi " + text + " does not lie inside the picture: x + w and y + h are at most 1, w and h above 0", 2);
  }
  return roi;
}

void parse_tank(const std::vector<std::string>& words, AreaOptions& area) {
  area.polygon.clear();
  area.picture.clear();
  if (words.size() == 1 && parts_of(words[0]).size() != 2) {
    area.picture = words[0];
    return;
  }
  for (const std::string& word : words) {
    const std::vector<std::string> parts = parts_of(word);
    if (parts.size() != 2) throw UserError("--tank: '" + word + "' is no corner X,Y in pixels of the source video", 2);
    area.polygon.push_back({static_cast<float>(parse_number("--tank X", parts[0], 0, 65535)),
                            static_cast<float>(parse_number("--tank Y", parts[1], 0, 65535))});
  }
  if (area.polygon.size() < 3) throw UserError("--tank needs three corners at least, X,Y X,Y X,Y, or a picture", 2);
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

Stabilise parse_stabilise(const std::string& text) {
  for (const Stabilise mode : {Stabilise::off, Stabilise::on, Stabilise::automatic})
    if (text == to_string(mode)) return mode;
  throw UserError("--stabilise must be off, on or auto, not '" + text + "'", 2);
}

const char* to_string(Stabilise mode) {
  constexpr const char* kNames[] = {"off", "on", "auto"};
  return kNames[static_cast<std::size_t>(mode)];
}

namespace {

void add_calibration_options(CLI::App& command, CaptureOptions& o) {
  const auto text = [&command](const char* name, auto&& take, const char* type, const char* help) {
    command.add_option_function<std::string>(name, take, help)->type_name(type)->option_text(type);
  };
  text(
      "--scale-points", [&o](const std::string& s) { o.scale_points = parse_scale_points(s); }, "X1,Y1,X2,Y2",
      "two points of the source video whose distance is known (--scale-mm): poses in millimetres too");
  text(
      "--scale-mm", [&o](const std::string& s) { o.scale_mm = parse_number("--scale-mm", s, 0.001, 1e6); }, "L",
      "how far these two points lie apart, millimetres; live lets you click them");
  text(
      "--marker-mm", [&o](const std::string& s) { o.marker_mm = parse_number("--marker-mm", s, 0.1, 1e5); }, "SIDE",
      "a printed AprilTag (family 36h11) lies in the picture: the side of its black square, millimetres");
  text(
      "--lens", [&o](const std::string& s) { o.lens = s; }, "FILE",
      "the lens' distortion, as OpenCV's calibration writes it or as lines `fx 900`: points are corrected, the picture "
      "is not");
}

}  // namespace

void add_capture_options(CLI::App& command, CaptureOptions& o) {
  // CLI11 would print a default through operator<<; these options show theirs in the text instead.
  const auto text = [&command](const char* name, auto&& take, const char* type, const char* help) {
    return command.add_option_function<std::string>(name, take, help)->type_name(type)->option_text(type);
  };
  text(
      "-c,--camera", [&o](const std::string& s) { o.camera = parse_camera_spec(s); }, "SPEC",
      "where frames come from: sim[:scene=NAME][,seed=N][,size=WxH][,fps=N][,frames=N] is the simulated tank, "
      "file:PATH (or just PATH) a video or image sequence, "
      "v4l2:/dev/videoN[,size=WxH][,fps=N][,format=NAME][,lock=on|off][,mains=50|60|off|auto][,wait=S] a camera, "
      "libcamera[:ID][,size=WxH][,fps=N][,lock=on|off] one of libcamera's (those on a ribbon cable)")
      ->required();
  add_list_cameras(command);
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
      "vibe (moving fish), vibe-colour (the same, and by colour; half as much again in time and memory), "
      "still[:PICTURE] (empty-tank picture, or the clip's median), backlit (fish on an even bright "
      "or dark field), auto (tests the clip and says why; default)");
  text(
      "--select", [&o](const std::string& s) { o.select = parse_select(s); }, "X,Y",
      "the fish nearest to this pixel of the source video, or auto: the one that moves and stays fish-shaped "
      "(default)");
  text(
      "--roi", [&o](const std::string& s) { o.area.roi = parse_roi(s); }, "X,Y,W,H",
      "look for fish in this part of the picture only, in shares of its width and height: 0.25,0,0.5,1 is the middle "
      "half");
  command
      .add_option_function<std::vector<std::string>>(
          "--tank", [&o](const std::vector<std::string>& words) { parse_tank(words, o.area); },
          "the tank's corners X,Y X,Y X,Y ... in pixels of the source video, or a picture that is black outside of it: "
          "nothing outside is a fish")
      ->type_name("CORNERS|FILE")
      ->option_text("CORNERS|FILE")
      ->expected(1, kMostCorners);
  text(
      "--min-size", [&o](const std::string& s) { o.area.min_size = parse_integer("--min-size", s, 1, 1'000'000'000); },
      "N", "fewer pixels of the source video than this are no fish (default: 1/4000 of the picture)");
  text(
      "--max-size", [&o](const std::string& s) { o.area.max_size = parse_integer("--max-size", s, 1, 1'000'000'000); },
      "N", "more pixels than this are no fish (default: no limit)");
  text(
      "--stabilise", [&o](const std::string& s) { o.stabilise = parse_stabilise(s); }, "MODE",
      "a camera held in the hand: on takes its motion out, off does not look, auto (default) looks and takes it out "
      "once the camera moves");
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
  add_calibration_options(command, o);
}

std::vector<std::string> inputs_of(const CaptureOptions& options) {
  return {options.camera.path, options.background.picture, options.area.picture, options.lens};
}

}  // namespace nt
