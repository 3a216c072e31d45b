// SPDX-License-Identifier: Apache-2.0
#include "core/character/lattice_pose.h"

#include <algorithm>

namespace nt {
namespace {

Vec3 rest_place(const LatticeView& view, const MarkerBinding& m) {
  Vec3 sum;
  for (int k = 0; k < 4; ++k) sum += m.weight[k] * view.vertices[m.vertex[k]];
  return sum;
}

}  // namespace

bool LatticePose::fits(const Character& character, std::span<const Vec2> rest_handles) {
  constexpr float kOff = 0.1f;  // character units: pixels
  const CharacterLattice& l = character.lattice;
  if (!l.present() || l.drive != LatticeDrive::landmarks || l.view.markers.size() != rest_handles.size()) return false;
  for (std::size_t k = 0; k < rest_handles.size(); ++k) {
    const Vec3 p = rest_place(l.view, l.view.markers[k]);
    if (!(length(Vec2{p.x, p.y} - rest_handles[k]) < kOff)) return false;
  }
  return true;
}

LatticePose* LatticePose::create(Arena& arena, const Character& character) {
  const CharacterLattice& l = character.lattice;
  const std::span<LatticePose> self = arena.take<LatticePose>(1);
  const auto solver = arena.take<std::byte>(Lattice::bytes_needed(l.view));
  LatticePose p;
  p.character_ = character;
  p.embedding_ = PhongEmbedding::create(arena, l.embedding, l.view);
  p.markers_ = arena.take<Vec3>(l.view.markers.size());
  p.seen_ = arena.take<uint8_t>(l.view.markers.size());
  p.places_ = arena.take<float>(12 * l.embedding.blocks());
  if (arena.measuring() || arena.full()) return nullptr;
  Arena own(solver);
  const auto made = Lattice::create(own, l.view, LatticeSettings{});
  if (!made.ok()) return nullptr;
  p.lattice_ = made.value();
  for (std::size_t k = 0; k < p.markers_.size(); ++k) p.markers_[k] = rest_place(l.view, l.view.markers[k]);
  std::fill(p.seen_.begin(), p.seen_.end(), uint8_t{1});
  self[0] = p;
  return &self[0];
}

LatticeReport LatticePose::pose(std::span<const Vec2> handles, bool vertices) {
  for (std::size_t k = 0; k < markers_.size(); ++k) markers_[k].x = handles[k].x, markers_[k].y = handles[k].y;
  const LatticeReport report = lattice_->step(markers_, seen_);
  if (vertices) embedding_->embed(lattice_->vertices(), places_);
  return report;
}

Vec3 LatticePose::normal(std::size_t vertex) const {
  const CharacterLattice& l = character_.lattice;
  const uint32_t slot = l.slots[vertex];
  const float* b = &l.embedding.coordinates[12u * (slot / 4) + slot % 4];
  const float weight[4] = {1.0f - b[0] - b[4] - b[8], b[0], b[4], b[8]};
  const uint16_t* corner = &l.view.tetrahedra[4u * l.embedding.tetrahedron[slot / 4]];
  const std::span<const float> columns = lattice_->rotation_columns();
  const Vec3 n = character_.normals[vertex];
  Vec3 sum;
  for (int k = 0; k < 4; ++k) {
    const float* r = &columns[9u * corner[k]];
    sum += weight[k] * (n.x * Vec3{r[0], r[1], r[2]} + n.y * Vec3{r[3], r[4], r[5]} + n.z * Vec3{r[6], r[7], r[8]});
  }
  return sum;
}

}  // namespace nt
