// SPDX-License-Identifier: Apache-2.0
// The few transcendental functions that core needs, the same bits on every target.
//
// Core calls no libm: glibc, musl and others differ in the last bit. These use only + - * / and sqrt, which IEEE 754
// fixes, and core is built with -ffp-contract=off. Errors are against a long double reference, shown by
// tests/unit/base/det_math_test.cpp.
#pragma once
#include <cstdint>

namespace nt::det {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kTwoPi = 6.28318530717958647692f;
inline constexpr float kHalfPi = 1.57079632679489661923f;

inline float sqrt(float v) { return __builtin_sqrtf(v); }
inline double sqrt(double v) { return __builtin_sqrt(v); }
inline float abs(float v) { return v < 0.0f ? -v : v; }
inline float min(float a, float b) { return b < a ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }
inline float clamp(float v, float lo, float hi) { return v < lo ? lo : (v > hi ? hi : v); }

struct SinCos {
  float sin, cos;
};
// |a| up to 1e4 rad; absolute error below 2e-7.
SinCos sincos(float a);
inline float sin(float a) { return sincos(a).sin; }
inline float cos(float a) { return sincos(a).cos; }
// (-pi, pi]; absolute error below 5e-7 rad; atan2(0, 0) = 0.
float atan2(float y, float x);
// Relative error below 3e-7 for -80 <= v <= 80; clamped outside.
float exp(float v);
// Natural logarithm, v > 0; absolute error below 1e-6 (1 + |log v|).
float log(float v);

// The angle a brought into (-pi, pi].
float wrap(float a);
// The angle equal to `a` modulo 2 pi that lies nearest to `near`: keeps a sequence of angles continuous.
float unwrap(float a, float near);

}  // namespace nt::det
