// SPDX-License-Identifier: Apache-2.0
#include "core/base/det_math.h"

#include <bit>

namespace nt::det {
namespace {

// Round to nearest integer, as a double; |v| < 2^51.
double round_nearest(double v) { return static_cast<double>(static_cast<int64_t>(v < 0 ? v - 0.5 : v + 0.5)); }

// Taylor polynomials on [-pi/4, pi/4] in double: the remainder is below 1e-10 there, under float's own rounding.
double sin_small(double a) {
  const double s = a * a;
  return a * (1 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880)))));
}
double cos_small(double a) {
  const double s = a * a;
  return 1 + s * (-1.0 / 2 + s * (1.0 / 24 + s * (-1.0 / 720 + s * (1.0 / 40320 + s * (-1.0 / 3628800)))));
}

// atan on [0, tan(pi/8)], by its series to the 21st power: remainder below 1e-9.
double atan_small(double v) {
  const double s = v * v;
  double sum = 0;
  for (int k = 10; k >= 0; --k) sum = sum * -s + 1.0 / (2 * k + 1);
  return v * sum;
}

double atan_unit(double v) {  // v in [0, 1]
  constexpr double kTanPi8 = 0.41421356237309504880;
  constexpr double kPi4 = 0.78539816339744830962;
  return v > kTanPi8 ? kPi4 + atan_small((v - 1) / (v + 1)) : atan_small(v);
}

}  // namespace

SinCos sincos(float angle) {
  constexpr double kHalfPiD = 1.57079632679489661923;
  const double a = angle;
  const double n = round_nearest(a / kHalfPiD);
  const double r = a - n * kHalfPiD;
  const double s = sin_small(r), c = cos_small(r);
  switch (static_cast<int64_t>(n) & 3) {
    case 0:
      return {static_cast<float>(s), static_cast<float>(c)};
    case 1:
      return {static_cast<float>(c), static_cast<float>(-s)};
    case 2:
      return {static_cast<float>(-s), static_cast<float>(-c)};
    default:
      return {static_cast<float>(-c), static_cast<float>(s)};
  }
}

float atan2(float y, float x) {
  constexpr double kPiD = 3.14159265358979323846;
  const double ax = x < 0 ? -static_cast<double>(x) : x;
  const double ay = y < 0 ? -static_cast<double>(y) : y;
  if (ax == 0 && ay == 0) return 0.0f;
  double a = ax >= ay ? atan_unit(ay / ax) : kPiD / 2 - atan_unit(ax / ay);
  if (x < 0) a = kPiD - a;
  return static_cast<float>(y < 0 ? -a : a);
}

float exp(float value) {
  constexpr double kLn2 = 0.69314718055994530942;
  const double v = clamp(value, -80.0f, 80.0f);
  const double n = round_nearest(v / kLn2);
  const double r = v - n * kLn2;  // |r| <= ln2 / 2
  double sum = 1;
  for (int k = 9; k >= 1; --k) sum = 1 + sum * r / k;
  const int64_t bits = (static_cast<int64_t>(n) + 1023) << 52;
  return static_cast<float>(sum * std::bit_cast<double>(bits));
}

float log(float value) {
  constexpr double kLn2 = 0.69314718055994530942;
  const uint64_t bits = std::bit_cast<uint64_t>(static_cast<double>(value));
  const int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1023;
  const double m = std::bit_cast<double>((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);  // [1, 2)
  const double z = (m - 1.41421356237309504880) / (m + 1.41421356237309504880);                    // |z| < 0.172
  const double s = z * z;
  double sum = 0;
  for (int k = 5; k >= 0; --k) sum = sum * s + 1.0 / (2 * k + 1);
  return static_cast<float>((exponent + 0.5) * kLn2 + 2 * z * sum);
}

float wrap(float a) {
  const double n = round_nearest(static_cast<double>(a) / 6.28318530717958647692);
  const double r = static_cast<double>(a) - n * 6.28318530717958647692;
  return static_cast<float>(r <= -3.14159265358979323846 ? r + 6.28318530717958647692 : r);
}

float unwrap(float a, float near) { return near + wrap(a - near); }

}  // namespace nt::det
