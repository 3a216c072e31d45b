// SPDX-License-Identifier: Apache-2.0
// A point or a direction in space and a rotation, float. Right-handed.
#pragma once
#include "core/base/det_math.h"

namespace nt {

struct Vec3 {
  float x = 0.0f;
  float y = 0.0f;
  float z = 0.0f;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(float s, Vec3 a) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
inline Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline float length_sq(Vec3 a) { return dot(a, a); }
inline float length(Vec3 a) { return det::sqrt(dot(a, a)); }
// `otherwise` where a has no direction.
inline Vec3 normalised(Vec3 a, Vec3 otherwise = {1.0f, 0.0f, 0.0f}) {
  const float n = length(a);
  return n > 0.0f ? a * (1.0f / n) : otherwise;
}
// Any unit vector at right angles to the unit vector a.
inline Vec3 perpendicular_to(Vec3 a) {
  const Vec3 other = det::abs(a.x) < 0.6f ? Vec3{1.0f, 0.0f, 0.0f} : Vec3{0.0f, 1.0f, 0.0f};
  return normalised(cross(a, other));
}

// w + xi + yj + zk, a rotation where its length is 1. q and -q are the same rotation.
struct Quat {
  float w = 1.0f;
  float x = 0.0f;
  float y = 0.0f;
  float z = 0.0f;
};

inline Vec3 axis_part(Quat q) { return {q.x, q.y, q.z}; }
inline Quat conjugate(Quat q) { return {q.w, -q.x, -q.y, -q.z}; }
inline float dot(Quat a, Quat b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }
// First b, then a.
inline Quat operator*(Quat a, Quat b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
inline Quat normalised(Quat q) {
  const float n = det::sqrt(dot(q, q));
  if (!(n > 0.0f)) return {};
  const float s = 1.0f / n;
  return {q.w * s, q.x * s, q.y * s, q.z * s};
}
inline Vec3 rotate(Quat q, Vec3 v) {
  const Vec3 u = axis_part(q);
  const Vec3 t = 2.0f * cross(u, v);
  return v + q.w * t + cross(u, t);
}

// The shortest rotation that takes the unit vector a to the unit vector b; half a turn about any axis if they oppose.
inline Quat shortest_arc(Vec3 a, Vec3 b) {
  const float w = 1.0f + dot(a, b);
  if (w < 1e-6f) {
    const Vec3 p = perpendicular_to(a);
    return {0.0f, p.x, p.y, p.z};
  }
  const Vec3 c = cross(a, b);
  return normalised(Quat{w, c.x, c.y, c.z});
}

// Axis times angle, the angle in [0, pi].
inline Vec3 rotation_vector(Quat q) {
  if (q.w < 0.0f) q = {-q.w, -q.x, -q.y, -q.z};
  const Vec3 u = axis_part(q);
  const float s = length(u);
  if (s < 1e-12f) return {};
  return u * (2.0f * det::atan2(s, q.w) / s);
}
inline Quat from_rotation_vector(Vec3 v) {
  const float angle = length(v);
  if (angle < 1e-12f) return {};
  const det::SinCos half = det::sincos(0.5f * angle);
  const Vec3 u = v * (half.sin / angle);
  return {half.cos, u.x, u.y, u.z};
}

}  // namespace nt
