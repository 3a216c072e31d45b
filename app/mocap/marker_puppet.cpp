// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/marker_puppet.h"

#include "app/aligned_block.h"
#include "platform/camera.h"

namespace nt {

struct MarkerPuppet::Memory {
  explicit Memory(std::size_t bytes) : block(bytes) {}
  AlignedBlock block;
};

MarkerPuppet::MarkerPuppet(const TriangleMesh& mesh, const SkeletonSpec& skeleton, const MarkerFile& file,
                           const std::vector<std::size_t>& markers, std::size_t frame, const PuppetOptions& options)
    : used_(markers), targets_(markers.size()), seen_(markers.size()) {
  std::vector<Vec3> chosen;
  for (const std::size_t m : used_) chosen.push_back(file.frame(frame)[m]);
  const TriangleMesh whole = cleaned(mesh);
  registration_ = register_markers(chosen, whole.positions, options.turns);
  std::vector<MarkerSpec> places;
  for (std::size_t k = 0; k < used_.size(); ++k) {
    if (!is_seen(chosen[k])) {
      throw UserError("marker '" + file.names[used_[k]] +
                      "' is not seen in the frame to register; choose another --frame or leave it out by --only");
    }
    places.push_back({file.names[used_[k]], registration_(chosen[k])});
  }
  built_ = build_lattice(mesh, skeleton, places, options.lattice);
  const LatticeView view = built_.data.view();
  const EmbeddingView embedding{built_.embedding.coordinates, built_.embedding.tetrahedron};
  Arena measure;
  if (options.phong) PhongEmbedding::create(measure, embedding, view);
  memory_ = std::make_unique<Memory>(Lattice::bytes_needed(view) + measure.used());
  Arena arena(memory_->block.bytes());
  const auto made = Lattice::create(arena, view, options.solver);
  if (!made.ok()) throw UserError(made.status().message);
  lattice_ = made.value();
  if (options.phong) phong_ = PhongEmbedding::create(arena, embedding, view);
  places_.resize(12 * embedding.blocks());
  for (const uint32_t i : whole.triangles) triangles_.push_back(built_.embedding.slot[i]);
}

MarkerPuppet::~MarkerPuppet() = default;

LatticeReport MarkerPuppet::step(std::span<const Vec3> file_frame) {
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const Vec3 p = file_frame[used_[k]];
    seen_[k] = is_seen(p);
    targets_[k] = seen_[k] ? registration_(p) : p;
  }
  const LatticeReport report = lattice_->step(targets_, seen_);
  if (phong_ != nullptr) {
    phong_->embed(lattice_->vertices(), places_);
  } else {
    embed_linear({built_.embedding.coordinates, built_.embedding.tetrahedron}, lattice_->view(), lattice_->vertices(),
                 places_);
  }
  return report;
}

Vec3 MarkerPuppet::vertex(std::size_t v) const {
  const std::size_t s = 3u * built_.embedding.slot[v];
  return {places_[s], places_[s + 1], places_[s + 2]};
}

double MarkerPuppet::volume() const {
  double sum = 0.0;
  const auto at = [&](uint32_t s) { return Vec3{places_[3 * s], places_[3 * s + 1], places_[3 * s + 2]}; };
  const Vec3 origin = at(triangles_[0]);
  for (std::size_t t = 0; t < triangles_.size(); t += 3) {
    sum += dot(at(triangles_[t]) - origin, cross(at(triangles_[t + 1]) - origin, at(triangles_[t + 2]) - origin));
  }
  return sum / 6.0;
}

float MarkerPuppet::marker_error() const {
  float sum = 0.0f, count = 0.0f;
  for (std::size_t k = 0; k < used_.size(); ++k) {
    if (!seen_[k]) continue;
    Vec3 at;
    const MarkerBinding& b = built_.data.markers[k];
    for (int c = 0; c < 4; ++c) at += b.weight[c] * lattice_->vertices()[b.vertex[c]];
    sum += length(at - targets_[k]), count += 1.0f;
  }
  return count > 0.0f ? sum / count : 0.0f;
}

}  // namespace nt
