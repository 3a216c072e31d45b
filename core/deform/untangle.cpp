// SPDX-License-Identifier: Apache-2.0
#include "core/deform/untangle.h"

namespace nt {
namespace {

// Returns whether the tetrahedron had less than it must.
bool restore(const LatticeView& view, std::size_t t, std::span<const uint8_t> held, std::span<Vec3> x) {
  const uint16_t* v = &view.tetrahedra[4 * t];
  const Vec3 a = x[v[0]], b = x[v[1]], c = x[v[2]], d = x[v[3]];
  const std::span<const Vec3> r = view.vertices;
  const float rest = volume6(r[v[0]], r[v[1]], r[v[2]], r[v[3]]), now = volume6(a, b, c, d);
  if (now >= kLeastVolume * rest) return false;
  const Vec3 of_b = cross(c - a, d - a), of_c = cross(d - a, b - a), of_d = cross(b - a, c - a);
  const Vec3 gradient[4] = {Vec3{} - of_b - of_c - of_d, of_b, of_c, of_d};
  float squares = 0.0f;
  for (int k = 0; k < 4; ++k) squares += held[v[k]] != 0 ? 0.0f : length_sq(gradient[k]);
  if (!(squares > 0.0f)) return true;
  // A little farther than asked, or it ends a rounding error short.
  const float step = (1.5f * kLeastVolume * rest - now) / squares;
  for (int k = 0; k < 4; ++k) {
    if (held[v[k]] == 0) x[v[k]] += step * gradient[k];
  }
  return true;
}

}  // namespace

int untangle(const LatticeView& view, std::span<const uint8_t> held, int most_sweeps, std::span<Vec3> x) {
  const std::size_t tets = view.tetrahedra.size() / 4;
  bool any = true;
  for (int sweep = 0; sweep < most_sweeps && any; ++sweep) {
    any = false;
    for (std::size_t k = 0; k < tets; ++k) {
      any = restore(view, sweep % 2 == 0 ? k : tets - 1 - k, held, x) || any;
    }
  }
  int inverted = 0;
  for (std::size_t t = 0; any && t < tets; ++t) {
    const uint16_t* v = &view.tetrahedra[4 * t];
    inverted += !(volume6(x[v[0]], x[v[1]], x[v[2]], x[v[3]]) > 0.0f);
  }
  return inverted;
}

}  // namespace nt
