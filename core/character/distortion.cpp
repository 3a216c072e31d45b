// SPDX-License-Identifier: Apache-2.0
#include "core/character/distortion.h"

namespace nt {
namespace {

constexpr float kFinReach = 1.1f;  // of the tip's distance: the tip is a corner, the fin's rim may lie a little farther

// Twice the signed area.
float area2(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

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
  const ControlPoints& c = character.rest;
  if (character.has_l_fin) meter.mark_fin(1, c.jun_tl, c.jun_bl, c.l_fin);
  if (character.has_r_fin) meter.mark_fin(2, c.jun_tr, c.jun_br, c.r_fin);
  return &meter;
}

void DistortionMeter::mark_fin(uint8_t mark, Vec2 top, Vec2 bottom, Vec2 tip) {
  const Vec2 root = lerp(top, bottom, 0.5f);
  const float reach = kFinReach * kFinReach * length_sq(tip - root);
  const float side = cross(bottom - top, tip - top) < 0.0f ? -1.0f : 1.0f;
  const std::span<const uint32_t> t = character_.triangles;
  const std::span<const Vec2> v = character_.vertices;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const Vec2 a = v[t[3 * i]], b = v[t[3 * i + 1]], c = v[t[3 * i + 2]];
    const Vec2 at = middle(a, b, c);
    if (side * cross(bottom - top, at - top) <= 0.0f || length_sq(at - root) > reach) continue;
    part_[i] = mark;
    rest_area_[mark] += area2(a, b, c);
  }
}

Distortion DistortionMeter::measure(std::span<const Vec2> vertices, float scale, bool y_down) const {
  Distortion d;
  float area[3] = {}, farthest = 0.0f;
  const float sense = y_down ? -1.0f : 1.0f;
  const std::span<const uint32_t> t = character_.triangles;
  const std::span<const Vec2> v = character_.vertices;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const uint32_t a = t[3 * i], b = t[3 * i + 1], c = t[3 * i + 2];
    const float before = area2(v[a], v[b], v[c]);
    const float after = sense * area2(vertices[a], vertices[b], vertices[c]);
    area[part_[i]] += after;
    if (after * before >= 0.0f) continue;
    ++d.inverted;
    const float far = after < 0.0f ? -after : after;
    if (far <= farthest) continue;
    farthest = far;
    d.where = middle(vertices[a], vertices[b], vertices[c]);
  }
  const float unit = scale * scale;
  if (rest_area_[1] != 0.0f) d.l_fin_area = area[1] / (rest_area_[1] * unit);
  if (rest_area_[2] != 0.0f) d.r_fin_area = area[2] / (rest_area_[2] * unit);
  return d;
}

}  // namespace nt
