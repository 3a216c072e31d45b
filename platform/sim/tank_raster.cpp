// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_raster.h"

#include <algorithm>
#include <utility>

#include "core/base/det_math.h"

namespace nt::tank {
namespace {

constexpr float kRounding = 1e-4f;  // what a row's sum may be off by; below it a pixel is clear

int floor_int(float v) {
  const int i = static_cast<int>(v);
  return static_cast<float>(i) > v ? i - 1 : i;
}

}  // namespace

void Coverage::start(const Box& box, float step) {
  box_ = box;
  step_ = step;
  stride_ = static_cast<std::size_t>(box.width()) + 2;  // an edge at the right border writes two cells past it
  cells_.assign(stride_ * static_cast<std::size_t>(box.height()), 0.0f);
}

void Coverage::add(std::span<const Vec2> polygon, Vec2 shift) {
  // From pixel centres at integers to pixel corners at integers.
  const float scale = 1.0f / step_;
  const Vec2 origin{static_cast<float>(box_.x0), static_cast<float>(box_.y0)};
  const auto local = [&](Vec2 p) { return (p + shift + Vec2{0.5f, 0.5f}) * scale - origin; };
  for (std::size_t i = 0; i < polygon.size(); ++i)
    add_edge(local(polygon[i]), local(polygon[i + 1 < polygon.size() ? i + 1 : 0]));
}

void Coverage::add_edge(Vec2 a, Vec2 b) {
  if (a.y == b.y) return;
  const float sign = a.y < b.y ? 1.0f : -1.0f;
  if (a.y > b.y) std::swap(a, b);
  const float slope = (b.x - a.x) / (b.y - a.y);
  const int first = max_int(floor_int(a.y), 0);
  const int last = min_int(box_.height() - 1, floor_int(b.y));
  const float width = static_cast<float>(box_.width());
  for (int y = first; y <= last; ++y) {
    const float y0 = det::max(a.y, static_cast<float>(y));
    const float y1 = det::min(b.y, static_cast<float>(y + 1));
    if (y1 <= y0) continue;
    const float x0 = det::clamp(a.x + (y0 - a.y) * slope, 0.0f, width);
    const float x1 = det::clamp(a.x + (y1 - a.y) * slope, 0.0f, width);
    add_edge_row(cells_.data() + static_cast<std::size_t>(y) * stride_, y1 - y0, sign, det::min(x0, x1),
                 det::max(x0, x1));
  }
}

// The part of an edge within one pixel row: it spans dy of the row's height and runs from x0 to x1 >= x0.
void Coverage::add_edge_row(float* cells, float dy, float sign, float x0, float x1) {
  const int i0 = floor_int(x0), i1 = floor_int(x1);
  const float d = sign * dy;
  if (i0 == i1) {
    const float mid = 0.5f * (x0 + x1) - static_cast<float>(i0);
    cells[i0] += d * (1.0f - mid);
    cells[i0 + 1] += d * mid;
    return;
  }
  // Each crossed pixel takes its share of the height; within it the edge's mean x splits that share.
  const float per_x = d / (x1 - x0);
  for (int i = i0; i <= i1; ++i) {
    const float l = det::max(x0, static_cast<float>(i)), r = det::min(x1, static_cast<float>(i + 1));
    const float share = per_x * (r - l);
    const float mid = 0.5f * (l + r) - static_cast<float>(i);
    cells[i] += share * (1.0f - mid);
    cells[i + 1] += share * mid;
  }
}

void Coverage::finish() {
  for (int y = 0; y < box_.height(); ++y) {
    float* cells = cells_.data() + static_cast<std::size_t>(y) * stride_;
    float sum = 0.0f;
    for (std::size_t x = 0; x < stride_; ++x) {
      sum += cells[x];
      const float area = det::abs(sum);
      cells[x] = area < kRounding ? 0.0f : det::min(area, 1.0f);
    }
  }
}

void Coverage::blur(int radius) {
  if (radius <= 0) return;
  for (int pass = 0; pass < 3; ++pass) {
    blur_rows(radius);
    blur_columns(radius);
  }
}

void Coverage::blur_rows(int radius) {
  const int width = box_.width();
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  copy_.resize(static_cast<std::size_t>(width + 2 * radius + 1));
  for (int y = 0; y < box_.height(); ++y) {
    float* cells = cells_.data() + static_cast<std::size_t>(y) * stride_;
    std::fill(copy_.begin(), copy_.end(), 0.0f);
    std::copy(cells, cells + width, copy_.begin() + radius);
    float sum = 0.0f;
    for (int x = 0; x < 2 * radius; ++x) sum += copy_[x];
    for (int x = 0; x < width; ++x) {
      sum += copy_[x + 2 * radius];
      cells[x] = det::max(sum * scale, 0.0f);
      sum -= copy_[x];
    }
  }
}

void Coverage::blur_columns(int radius) {
  const int height = box_.height();
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  copy_ = cells_;
  sums_.assign(stride_, 0.0f);
  const auto source = [&](int y) { return copy_.data() + static_cast<std::size_t>(y) * stride_; };
  for (int y = -radius; y < height; ++y) {
    if (y + radius < height)
      for (std::size_t x = 0; x < stride_; ++x) sums_[x] += source(y + radius)[x];
    if (y < 0) continue;
    float* out = cells_.data() + static_cast<std::size_t>(y) * stride_;
    for (std::size_t x = 0; x < stride_; ++x) out[x] = det::max(sums_[x] * scale, 0.0f);
    if (y - radius >= 0)
      for (std::size_t x = 0; x < stride_; ++x) sums_[x] -= source(y - radius)[x];
  }
}

Box box_of(std::span<const Vec2> points, int margin) {
  if (points.empty()) return {};
  Vec2 lo = points[0], hi = points[0];
  for (Vec2 p : points) {
    lo = {det::min(lo.x, p.x), det::min(lo.y, p.y)};
    hi = {det::max(hi.x, p.x), det::max(hi.y, p.y)};
  }
  return {floor_int(lo.x) - margin, floor_int(lo.y) - margin, floor_int(hi.x) + 2 + margin,
          floor_int(hi.y) + 2 + margin};
}

}  // namespace nt::tank
