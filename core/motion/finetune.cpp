// SPDX-License-Identifier: Apache-2.0
#include "core/motion/finetune.h"

#include "core/base/image_view.h"

namespace nt {
namespace {

// 1 - (r - i)^2 / (r - end)^2
float falloff(int i, int r, int end) {
  const float distance = static_cast<float>(r - i), reach = static_cast<float>(r - end);
  return 1.0f - distance * distance / (reach * reach);
}

}  // namespace

EditWindow edit_window(std::span<const Motion> sequence, MotionProperty u, float rest, int r, float edited) {
  const auto side_of = [&](int k) { return value_of(sequence[static_cast<std::size_t>(k)], u) - rest; };
  const float own = side_of(r) != 0.0f ? side_of(r) : edited - rest;
  if (own == 0.0f) return {r, r};
  // As far as it goes on that side; from the rest pose over what lies on it too, until it is left.
  const auto end_of_run = [&](int step) {
    bool resting = side_of(r) == 0.0f;
    int end = r;
    for (int k = r + step; k >= 0 && k < static_cast<int>(sequence.size()); end = k, k += step) {
      const float side = side_of(k);
      if (side == 0.0f ? !resting : (side > 0.0f) != (own > 0.0f)) break;
      resting = side == 0.0f;
    }
    return end;
  };
  return {end_of_run(-1), end_of_run(1)};
}

EditWindow path_window(int frames, int r, int radius) {
  return {max_int(r - radius, 0), min_int(r + radius, frames - 1)};
}

float influence(int i, int r, EditWindow window) {
  if (i == r) return 1.0f;
  if (i < window.p || i > window.q) return 0.0f;
  return falloff(i, r, i < r ? window.p : window.q);
}

void edit_angle(std::span<Motion> sequence, MotionProperty u, float rest, int r, float edited, EditWindow window) {
  const float before = value_of(sequence[static_cast<std::size_t>(r)], u) - rest;
  const bool reversed = before * (edited - rest) < 0.0f;
  for (int i = window.p; i <= window.q; ++i) {
    Motion& frame = sequence[static_cast<std::size_t>(i)];
    const float f = influence(i, r, window);
    const float kept = reversed ? 0.0f : (1.0f - f) * (value_of(frame, u) - rest);
    set_value(frame, u, rest + kept + f * (edited - rest));
  }
}

void edit_path(std::span<Motion> sequence, MotionProperty u, int r, float edited, EditWindow window) {
  const float moved = edited - value_of(sequence[static_cast<std::size_t>(r)], u);
  for (int i = window.p; i <= window.q; ++i) {
    Motion& frame = sequence[static_cast<std::size_t>(i)];
    set_value(frame, u, value_of(frame, u) + influence(i, r, window) * moved);
  }
}

}  // namespace nt
