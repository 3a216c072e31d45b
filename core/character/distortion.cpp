// SPDX-License-Identifier: Apache-2.0
#include "core/character/distortion.h"

#include "core/character/fin_region.h"

namespace nt {
namespace {

constexpr float kSeenShare = 1.0f / 3;  // of a 3D triangle's area
constexpr float kFinReach = 1.1f;  // of the tip's distance: the tip is a corner, the fin's rim may lie a little farther

// Twice the signed area.
float area2(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

float magnitude(float v) { return v < 0.0f ? -v : v; }

Vec2 middle(Vec2 a, Vec2 b, Vec2 c) { return (a + b + c) * (1.0f / 3.0f); }

}  // namespace

DistortionMeter* DistortionMeter::create(Arena& arena, const Character& character) {
  const std::size_t triangles = character.triangles.size() / 3;
  const std::span<DistortionMeter> self = arena.take<DistortionMeter>(1);
  const std::span<uint8_t> part = arena.take<uint8_t>(triangles);
  if (arena.measuring() || arena.full()) return nullptr;
  DistortionMeter& meter = self[0];
  meter.character_ = character;
  meter.part_ = part;
  for (std::size_t i = 0; i < triangles; ++i) {
    if (meter.steep(i)) part[i] = kPassedOver;
  }
  for (int i = 0; i < kMaxFins; ++i) {
    if (character.rest.fins[i].present) meter.mark_fin(i, character.rest.fins[i]);
  }
  return &meter;
}

bool DistortionMeter::steep(std::size_t triangle) const {
  const uint32_t* t = character_.triangles.data() + 3 * triangle;
  const Vec2 a = character_.vertices[t[0]];
  const Vec2 u = character_.vertices[t[1]] - a, v = character_.vertices[t[2]] - a;
  const float seen = cross(u, v);
  if (seen == 0.0f || !character_.solid()) return seen == 0.0f;
  const float h = character_.heights[t[0]], uz = character_.heights[t[1]] - h, vz = character_.heights[t[2]] - h;
  const float x = u.y * vz - uz * v.y, y = uz * v.x - u.x * vz;
  return seen * seen < kSeenShare * kSeenShare * (x * x + y * y + seen * seen);
}

void DistortionMeter::mark_fin(int index, const FinPoints& fin) {
  const FinRegion region(character_, fin, kFinReach);
  const std::span<const uint32_t> t = character_.triangles;
  const std::span<const Vec2> v = character_.vertices;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    if (part_[i] != 0) continue;
    const Vec2 a = v[t[3 * i]], b = v[t[3 * i + 1]], c = v[t[3 * i + 2]];
    if (!region.holds(middle(a, b, c))) continue;
    part_[i] = static_cast<uint8_t>(1 + index);
    rest_area_[1 + index] += magnitude(area2(a, b, c));
  }
}

Distortion DistortionMeter::measure(std::span<const Vec2> vertices, float scale, bool y_down) const {
  Distortion d;
  float area[1 + kMaxFins] = {}, farthest = 0.0f;
  const float sense = y_down ? -1.0f : 1.0f;
  const std::span<const uint32_t> t = character_.triangles;
  const std::span<const Vec2> v = character_.vertices;
  const float unit = scale * scale;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    if (part_[i] == kPassedOver) continue;
    const uint32_t a = t[3 * i], b = t[3 * i + 1], c = t[3 * i + 2];
    const float before = area2(v[a], v[b], v[c]);
    const float after = sense * area2(vertices[a], vertices[b], vertices[c]);
    // In the rest pose's sense: a 3D character's lower side runs the other way round.
    const float kept = before < 0.0f ? -after : after;
    area[part_[i]] += kept;
    const float ratio = kept / (magnitude(before) * unit);
    d.least = ratio < d.least ? ratio : d.least;
    if (kept >= 0.0f) continue;
    ++d.inverted;
    if (-kept <= farthest) continue;
    farthest = -kept;
    d.where = middle(vertices[a], vertices[b], vertices[c]);
  }
  for (int i = 0; i < kMaxFins; ++i) {
    if (rest_area_[1 + i] != 0.0f) d.fin_area[i] = area[1 + i] / (rest_area_[1 + i] * unit);
  }
  return d;
}

}  // namespace nt
