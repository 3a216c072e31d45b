// SPDX-License-Identifier: Apache-2.0
// A point or a direction in the plane, float.
#pragma once

namespace nt {

struct Vec2 {
  float x = 0.0f;
  float y = 0.0f;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }
inline Vec2 operator*(float s, Vec2 a) { return {a.x * s, a.y * s}; }
inline Vec2& operator+=(Vec2& a, Vec2 b) { return a = a + b; }
inline Vec2& operator-=(Vec2& a, Vec2 b) { return a = a - b; }
inline float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
// z of the cross product; with y down it is positive when b lies clockwise of a as seen on the screen.
inline float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline float length_sq(Vec2 a) { return dot(a, a); }
inline float length(Vec2 a) { return __builtin_sqrtf(dot(a, a)); }  // one instruction, correctly rounded everywhere
inline Vec2 lerp(Vec2 a, Vec2 b, float t) { return a + (b - a) * t; }
inline Vec2 normalised(Vec2 a) {
  const float n = length(a);
  return n > 0.0f ? a * (1.0f / n) : Vec2{1.0f, 0.0f};
}
// The fish's right, seen from above in image coordinates (y down), for a unit direction d towards its head.
inline Vec2 right_of(Vec2 d) { return {-d.y, d.x}; }

}  // namespace nt
