// SPDX-License-Identifier: Apache-2.0
// The outline of a fish whose medial axis is a circular arc, with everything that landmarks must find known exactly.
// Contour: clockwise on the screen from the head, about one pixel a step, pixels, y down.
#pragma once
#include <vector>

#include "core/base/det_math.h"
#include "core/base/vec2.h"

namespace nt::test {

struct FishShape {
  float length = 240;    // of the axis, pixels
  float bend = 0.6f;     // radians that the axis turns from head to tail
  float heading = 0.3f;  // of the head, at the middle of the axis
  Vec2 middle{300, 250};
  bool left_fin = false, right_fin = false;
  float fin_bulge = 0.06f;  // of its edges, share of the length; 0: straight
  bool larva = false;       // eyes are its widest part, then the swim bladder; the tail is thin
  bool forked = false;      // the caudal fin has two tips, the axis ends in the notch between them
};

class FishOutline {
 public:
  explicit FishOutline(const FishShape& shape) : shape_(shape) {
    std::vector<Vec2> corners;
    for (int i = 0; i < kSteps; ++i) add(corners, i, 1, shape.right_fin);
    if (shape.forked) corners.push_back(at(kNotch, 0));
    for (int i = kSteps; i > 0; --i) add(corners, i, -1, shape.left_fin);
    for (std::size_t i = 0; i < corners.size(); ++i) step_along(corners[i], corners[(i + 1) % corners.size()]);
  }
  const std::vector<Vec2>& contour() const { return contour_; }
  float axis_length() const { return shape_.length * end(); }
  Vec2 head() const { return at(0, 0); }
  Vec2 tail() const { return at(end(), 0); }
  Vec2 fin_tip(float side) const {
    return at(kFinTip, side * (half_width(kFinTip) + kFinSpan * shape_.length));
  }  // +1 right
  Vec2 junction(float side, bool top) const { return flank(top ? kFinTop : kFinBottom, side); }

  // The point at share s of the arc, d pixels to the fish's right.
  Vec2 at(float s, float d) const {
    const float middle = shape_.heading + det::kPi, phi = middle + shape_.bend * (s - 0.5f);
    const det::SinCos a = det::sincos(phi), m = det::sincos(middle);
    Vec2 p = Vec2{m.cos, m.sin} * (s - 0.5f);
    if (shape_.bend != 0) p = Vec2{a.sin - m.sin, m.cos - a.cos} * (1 / shape_.bend);
    return shape_.middle + p * shape_.length + right_of(Vec2{-a.cos, -a.sin}) * d;
  }
  float half_width(float s) const {
    if (shape_.larva) {
      const auto bump = [s](float at, float wide) { return det::exp(-(s - at) * (s - at) / (2 * wide * wide)); };
      const float ends = det::sqrt(det::max(1 - (1 - s / 0.06f) * (1 - s / 0.06f), s < 0.06f ? 0.0f : 1.0f));
      const float body = 0.095f * bump(0.08f, 0.045f) + 0.062f * bump(0.27f, 0.035f) + 0.025f * (1 - s) + 0.008f;
      return shape_.length * body * (s < 0.06f ? ends : 1.0f);
    }
    if (s < 0.3f) return kWide * shape_.length * det::sqrt(det::max(1 - (0.3f - s) * (0.3f - s) / 0.09f, 0.0f));
    const float u = det::min((s - 0.3f) / 0.55f, 1.0f);
    float w = 0.22f + 0.78f * (0.5f + 0.5f * det::cos(det::kPi * u));
    const float v = det::max(s - 0.85f, 0.0f) / 0.15f;
    w = shape_.forked ? w + 0.7f * v : w * det::sqrt(det::max(1 - v * v, 0.0f));
    return kWide * shape_.length * w;
  }
  // Root mean square distance from the arc, as a share of the length.
  template <class Points>
  float rms_from_axis(const Points& points) const {
    float sum = 0;
    int count = 0;
    for (const Vec2 p : points) {
      float nearest = 1e30f;
      for (int i = 0; i <= 2000; ++i)
        nearest = det::min(nearest, length_sq(p - at(static_cast<float>(i) * end() / 2000, 0)));
      sum += nearest, ++count;
    }
    return det::sqrt(sum / static_cast<float>(count)) / shape_.length;
  }

 private:
  static constexpr int kSteps = 400;
  static constexpr float kWide = 0.1f, kNotch = 0.93f, kFinTop = 0.24f, kFinBottom = 0.36f, kFinTip = 0.33f,
                         kFinSpan = 0.15f;
  float end() const { return shape_.forked ? kNotch : 1.0f; }
  Vec2 flank(float s, float side) const { return at(s, side * half_width(s)); }
  void add(std::vector<Vec2>& corners, int i, float side, bool fin) const {
    const float s = static_cast<float>(i) / kSteps;
    corners.push_back(fin && s > kFinTop && s < kFinBottom ? fin_edge(s, side) : flank(s, side));
  }
  // On a straight edge every point has the largest angle of [F] section 4.4.
  Vec2 fin_edge(float s, float side) const {
    const float u = 2 * (s - kFinTop) / (kFinBottom - kFinTop), tip = half_width(kFinTip) + kFinSpan * shape_.length;
    const bool leading = u < 1;
    const float v = leading ? u : 2 - u, root = leading ? kFinTop : kFinBottom,
                bulge = (leading ? shape_.fin_bulge : -shape_.fin_bulge) * v * (1 - v);
    return at(root + (kFinTip - root) * v - bulge,
              side * (half_width(root) + (tip - half_width(root)) * v + bulge * shape_.length));
  }
  void step_along(Vec2 a, Vec2 b) {
    if (!contour_.empty() && length(a - contour_.back()) < 0.7f && length(b - a) < 1) return;  // no crowding
    const int n = static_cast<int>(length(b - a)) + 1;
    for (int k = 0; k < n; ++k) contour_.push_back(lerp(a, b, static_cast<float>(k) / static_cast<float>(n)));
  }

  FishShape shape_;
  std::vector<Vec2> contour_;
};

}  // namespace nt::test
