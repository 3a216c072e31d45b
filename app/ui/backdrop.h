// SPDX-License-Identifier: Apache-2.0
// What lies behind the character: a flat colour (for keying, say), a picture, or the camera's picture without its fish.
//
// A picture is cut to the pane's shape and fills it. The camera's picture is painted over where the fish is
// (app/clean_plate.h); that needs update() after each step. No allocation after the constructor.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "app/clean_plate.h"
#include "app/observation.h"
#include "app/ui/colours.h"
#include "app/ui/pane.h"
#include "core/scene/scene.h"

namespace CLI {
class App;
}

namespace nt {

struct BackdropOption {
  enum class Kind : uint8_t { colour, picture, camera } kind = Kind::colour;
  Colour colour = kWater;
  std::string path;  // picture
};
// "#RRGGBB", "camera", or the path of a picture. Throws UserError (exit code 2).
BackdropOption parse_backdrop(const std::string& text);
void add_backdrop_option(CLI::App& command, const std::function<void(const BackdropOption&)>& take);

class Backdrop {
 public:
  // Before the session's first step: the camera kind looks ahead. Throws UserError for a picture that cannot be read.
  Backdrop(const BackdropOption& option, const Pane& pane, Session& session);
  // Where there is no camera: a colour or a picture.
  Backdrop(const BackdropOption& option, const Pane& pane);
  bool watches() const { return plate_.has_value(); }  // needs the camera's picture, and the masks
  Colour colour() const { return colour_; }            // of the canvas
  void update(const Observation& seen);                // of the session's next step
  void draw(Scene& scene) const;

 private:
  void show_picture(const BackdropOption& option);
  Pane pane_;
  Colour colour_;
  cv::Mat rgb_;
  Picture picture_;
  std::optional<CleanPlate> plate_;
};

}  // namespace nt
