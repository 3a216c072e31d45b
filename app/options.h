// SPDX-License-Identifier: Apache-2.0
// The options that live, capture, animate and bench share: which camera, how it is watched.
//
// Each is registered once, here, so that every sub-command spells and explains it the same way.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/camera_spec.h"
#include "app/numbers.h"
#include "core/base/vec2.h"

namespace CLI {
class App;
}

namespace nt {

struct BackgroundOption {
  enum class Kind : uint8_t { automatic, vibe, still, backlit } kind = Kind::automatic;
  std::string picture;  // still: a picture of the empty tank; "" = the median of the clip
};
BackgroundOption parse_background(const std::string& text);  // vibe | still[:PICTURE] | backlit | auto

struct SelectOption {
  bool automatic = true;
  Vec2 at;  // pixels of the source video
};
SelectOption parse_select(const std::string& text);  // auto | X,Y

struct CaptureOptions {
  CameraSpec camera;
  std::optional<Size> work;  // unset: 960x544
  double fps = 0;            // 0: the source's own
  int64_t frames = 0;        // 0: all
  BackgroundOption background;
  SelectOption select;
  int harmonics = 5;
  uint64_t seed = 1;
};
void add_capture_options(CLI::App& command, CaptureOptions& options);

// The files that the options name for reading.
std::vector<std::string> inputs_of(const CaptureOptions& options);

}  // namespace nt
