// SPDX-License-Identifier: Apache-2.0
// Markers that come and go (core/deform/lattice.h).
#include "core/deform/lattice.h"

namespace nt {
namespace {

bool finite(Vec3 p) {
  constexpr float kFar = 1e9f;
  return det::abs(p.x) < kFar && det::abs(p.y) < kFar && det::abs(p.z) < kFar;
}

}  // namespace

// Its weight sinks to 1e-4 over blend_frames, evenly in its logarithm, because what it resists is far weaker than w_u^2;
// its target is where it is, so it pulls nowhere.
void Lattice::lose(Marker& m, const MarkerBinding& b) {
  m.seen = false;
  m.offset = {};
  m.to_shed = 0;
  if (!started_) {
    m.weight = 0.0f;
    return;
  }
  m.target = marker_place(b);
  m.weight *= det::exp(-9.21f / static_cast<float>(settings_.blend_frames > 0 ? settings_.blend_frames : 1));
  if (m.weight < 1.05e-4f) m.weight = 0.0f;
}

// An offset shrinks evenly to nothing over blend_frames; markers that return together do so together and keep their shape.
void Lattice::shed_offsets() {
  blending_ = false;
  for (Marker& m : markers_) {
    if (m.to_shed == 0) continue;
    m.offset = (static_cast<float>(m.to_shed - 1) / static_cast<float>(m.to_shed)) * m.offset;
    --m.to_shed;
    blending_ = true;
  }
}

// Returns whether a weight changed.
bool Lattice::read_markers(std::span<const Vec3> markers, std::span<const uint8_t> seen, LatticeReport& report) {
  for (std::size_t m = 0; m < markers_.size(); ++m) report.markers += seen[m] && finite(markers[m]);
  if (report.markers == 0) {
    // Nothing pulls, so nothing fades either; whoever comes back is blended in.
    for (Marker& m : markers_) m.seen = false, m.offset = {}, m.to_shed = 0;
    steady_frames_ = 0;
    return false;
  }
  bool changed = false;
  shed_offsets();
  for (std::size_t k = 0; k < markers_.size(); ++k) {
    Marker& m = markers_[k];
    const float weight = m.weight;
    if (!(seen[k] && finite(markers[k]))) {
      lose(m, view_.markers[k]);
    } else {
      const bool returned = !m.seen;
      if (returned && started_) {
        m.offset = marker_place(view_.markers[k]) - markers[k];
        m.to_shed = settings_.blend_frames;
        blending_ = true;
      }
      m.step_before = m.step;
      m.step = m.target - m.before;
      m.before = m.target;
      m.target = markers[k] + m.offset;
      m.seen = true;
      m.weight = 1.0f;
    }
    changed = changed || m.weight != weight;
  }
  return changed;
}

}  // namespace nt
