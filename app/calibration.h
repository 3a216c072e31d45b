// SPDX-License-Identifier: Apache-2.0
// From pixels of the source video to the ideal pinhole picture, and to millimetres.
//
// Only points are corrected, after capture; no image is resampled for it. Lens: the model of OpenCV's calibration (Brown
// 1966: k1, k2, k3 radial, p1, p2 tangential). Its inverse has no closed form: fixed-point iteration from the distorted
// point until it stands still, at most 50 rounds, far under 0.01 pixel for lenses that can be inverted at all; compared with
// cv::undistortPoints in tests/app.
// Frames of reference: in, pixels of the source video as filmed; out, pixels of the picture that a lens without
// distortion and the same fx, fy, cx, cy would have made. Scale: pixels of that picture per millimetre, in the plane in
// which the known length lay.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "core/base/vec2.h"

namespace nt {

struct Lens {
  double fx = 0, fy = 0, cx = 0, cy = 0;  // pixels of the source video
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  Vec2 distorted(Vec2 ideal) const;
  Vec2 undistorted(Vec2 seen) const;
};

// A text file: lines `name value` (or `name: value`) with fx fy cx cy and any of k1 k2 p1 p2 k3, `#` comments; or what
// OpenCV's calibration writes (YAML, XML, JSON with camera_matrix and distortion_coefficients). `width` x `height` is the source
// video's size: a file that says for which picture size it holds (image_width, image_height) must agree.
// Throws UserError.
Lens read_lens(const std::string& path, int width, int height);

struct ScalePoints {
  Vec2 a, b;  // pixels of the source video
};
ScalePoints parse_scale_points(const std::string& text);  // X1,Y1,X2,Y2; throws UserError
bool far_enough(const ScalePoints& points);               // apart, for a scale

struct Calibration {
  std::optional<Lens> lens;
  double px_per_mm = 0;    // 0: not known
  std::string scale_from;  // "two points", "marker"

  bool any() const { return lens.has_value() || px_per_mm > 0; }
  Vec2 ideal(Vec2 source) const { return lens ? lens->undistorted(source) : source; }
  // Both throw UserError where the points cannot give a scale.
  void set_scale(const ScalePoints& points, double length_mm);
  void set_scale(const std::array<Vec2, 4>& marker_corners, double side_mm);
};

}  // namespace nt
