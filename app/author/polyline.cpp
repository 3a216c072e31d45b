// SPDX-License-Identifier: Apache-2.0
#include "app/author/polyline.h"

#include <algorithm>
#include <limits>

namespace nt {
namespace {

constexpr int kCurveSteps = 8;

// The segment that holds `along`, and how far into it; -1 on a line of one point.
struct Place {
  std::size_t segment = 0;
  float share = 0;
};

Place place_of(std::span<const Vec2> line, float along) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const float step = length(line[i + 1] - line[i]);
    const bool last = i + 2 == line.size();
    if (along <= step || last) return {i, step > 0 ? std::clamp(along / step, 0.0f, 1.0f) : 0.0f};
    along -= step;
  }
  return {};
}

}  // namespace

float line_length(std::span<const Vec2> line) {
  float sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += length(line[i] - line[i - 1]);
  return sum;
}

Vec2 along_line(std::span<const Vec2> line, float along) {
  if (line.size() < 2) return line.front();
  const Place p = place_of(line, along);
  return lerp(line[p.segment], line[p.segment + 1], p.share);
}

Vec2 direction_of_line(std::span<const Vec2> line, float along) {
  if (line.size() < 2) return {1, 0};
  const std::size_t i = place_of(line, along).segment;
  return normalised(line[i + 1] - line[i]);
}

OnLine nearest_on_line(std::span<const Vec2> line, Vec2 p, LineEnds ends) {
  OnLine best{line.front(), 0};
  float best_distance = std::numeric_limits<float>::max(), before = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 along = line[i + 1] - line[i];
    const float step = length(along);
    if (!(step > 0)) continue;
    float t = dot(p - line[i], along) / (step * step);
    if (!(ends == LineEnds::go_on && i == 0)) t = std::max(t, 0.0f);
    if (!(ends == LineEnds::go_on && i + 2 == line.size())) t = std::min(t, 1.0f);
    const Vec2 at = line[i] + along * t;
    if (const float distance = length_sq(p - at); distance < best_distance) {
      best_distance = distance;
      best = {at, before + t * step};
    }
    before += step;
  }
  return best;
}

std::vector<Vec2> rounded_line(std::span<const Vec2> line) {
  if (line.size() < 3) return {line.begin(), line.end()};
  std::vector<Vec2> out;
  const std::size_t last = line.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const Vec2 b = line[i], c = line[i + 1];
    const Vec2 a = i > 0 ? line[i - 1] : b + (b - c), d = i + 1 < last ? line[i + 2] : c + (c - b);
    for (int k = 0; k < kCurveSteps; ++k) {
      const float t = static_cast<float>(k) / kCurveSteps;
      const Vec2 linear = c - a, square = a * 2 - b * 5 + c * 4 - d, cube = (b - c) * 3 + d - a;
      out.push_back(b + (linear * t + square * (t * t) + cube * (t * t * t)) * 0.5f);
    }
  }
  out.push_back(line.back());
  return out;
}

std::vector<Vec2> evenly(std::span<const Vec2> line, int count) {
  const float whole = line_length(line);
  std::vector<Vec2> out;
  for (int i = 0; i < count; ++i) {
    out.push_back(along_line(line, whole * static_cast<float>(i) / static_cast<float>(count - 1)));
  }
  return out;
}

std::vector<Vec2> calmed(std::span<const Vec2> line, int rounds) {
  std::vector<Vec2> out(line.begin(), line.end()), before;
  for (int round = 0; round < rounds; ++round) {
    before = out;
    for (std::size_t i = 1; i + 1 < out.size(); ++i) {
      out[i] = before[i] * 0.5f + (before[i - 1] + before[i + 1]) * 0.25f;
    }
  }
  return out;
}

}  // namespace nt
