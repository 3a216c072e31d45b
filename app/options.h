// SPDX-License-Identifier: Apache-2.0
// The options that live, capture, animate and bench share: which camera, how it is watched.
//
// Each is registered once, here, so that every sub-command spells and explains it the same way.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/calibration.h"
#include "app/camera_spec.h"
#include "app/numbers.h"
#include "core/base/vec2.h"
#include "core/stabilise/stabiliser.h"

namespace CLI {
class App;
}

namespace nt {

struct BackgroundOption {
  enum class Kind : uint8_t { automatic, vibe, vibe_colour, still, backlit } kind = Kind::automatic;
  std::string picture;  // still: a picture of the empty tank; "" = the median of the clip
};
BackgroundOption parse_background(const std::string& text);  // vibe | vibe-colour | still[:PICTURE] | backlit | auto

struct SelectOption {
  bool automatic = true;
  Vec2 at;  // pixels of the source video
};
SelectOption parse_select(const std::string& text);  // auto | X,Y

// A part of the picture in shares of its width and height, as rpicam-apps have it.
struct RoiOption {
  double x = 0, y = 0, width = 1, height = 1;
};
RoiOption parse_roi(const std::string& text);  // x,y,w,h, each 0 to 1

// Where fish can be and how large they are.
struct AreaOptions {
  std::optional<RoiOption> roi;
  std::vector<Vec2> polygon;           // pixels of the source video; empty: everywhere
  std::string picture;                 // or a picture of the tank: black is outside
  int64_t min_size = 0, max_size = 0;  // pixels of the source video that a fish covers; 0: as core thinks fit, no limit
  bool everywhere() const { return !roi && polygon.empty() && picture.empty(); }
};
// Corners "x,y" in order, three at least, or the path of one picture.
void parse_tank(const std::vector<std::string>& words, AreaOptions& area);

Stabilise parse_stabilise(const std::string& text);  // off | on | auto
const char* to_string(Stabilise mode);

struct CaptureOptions {
  CameraSpec camera;
  std::optional<Size> work;  // unset: 960x544
  double fps = 0;            // 0: the source's own
  int64_t frames = 0;        // 0: all
  BackgroundOption background;
  SelectOption select;
  AreaOptions area;
  int max_fish = 1;
  Stabilise stabilise = Stabilise::automatic;
  int harmonics = 5;
  uint64_t seed = 1;
  std::string lens;  // a file; "" = none
  std::optional<ScalePoints> scale_points;
  double scale_mm = 0, marker_mm = 0;  // 0: not given
  bool scale_by_clicks = false;        // scale_mm without points: they are clicked in the window
};
void add_capture_options(CLI::App& command, CaptureOptions& options);

// The files that the options name for reading.
std::vector<std::string> inputs_of(const CaptureOptions& options);

}  // namespace nt
