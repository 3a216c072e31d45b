// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/marker_puppet.h"

#include <algorithm>

#include "app/aligned_block.h"
#include "app/author/green_coordinates.h"
#include "app/author/lattice_binding.h"
#include "core/deform/embed_green.h"
#include "platform/camera.h"

namespace nt {

namespace {

float diagonal_of(const std::vector<Vec3>& points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

Vec3 place_of(const MarkerBinding& b, std::span<const Vec3> vertices) {
  Vec3 sum;
  for (int k = 0; k < 4; ++k) sum += b.weight[k] * vertices[b.vertex[k]];
  return sum;
}

std::vector<std::string> marker_names(const CharacterLattice& l) {
  std::vector<std::string> out;
  for (const char* at = l.names.data(); out.size() < l.view.markers.size(); at += out.back().size() + 1) {
    out.emplace_back(at);
  }
  return out;
}

}  // namespace

struct MarkerPuppet::Memory {
  explicit Memory(std::size_t bytes) : block(bytes) {}
  AlignedBlock block;
};

MarkerPuppet::MarkerPuppet(const TriangleMesh& mesh, const SkeletonSpec& skeleton, const MarkerFile& file,
                           const std::vector<std::size_t>& markers, std::size_t frame, const PuppetOptions& options)
    : used_(markers) {
  choose(file, frame);
  const TriangleMesh whole = cleaned(mesh);
  diagonal_ = diagonal_of(whole.positions);
  registration_ = register_markers(chosen_, whole.positions, options.turns);
  std::vector<MarkerSpec> places;
  for (std::size_t k = 0; k < used_.size(); ++k) places.push_back({file.names[used_[k]], registration_(chosen_[k])});
  built_ = build_lattice(mesh, skeleton, places, options.lattice);
  view_ = built_.data.view();
  embedding_ = {built_.embedding.coordinates, built_.embedding.tetrahedron};
  slots_ = built_.embedding.slot;
  start(whole.triangles, options);
}

MarkerPuppet::MarkerPuppet(const Character& c, const MarkerFile& file, const std::vector<std::size_t>& markers,
                           std::size_t frame, const PuppetOptions& options)
    : used_(markers), view_(c.lattice.view), embedding_(c.lattice.embedding), slots_(c.lattice.slots) {
  if (!c.lattice.present()) {
    throw UserError("this character has no lattice; make it with `neontetra character MESH --lattice`");
  }
  choose(file, frame);
  std::vector<Vec3> mesh;
  for (std::size_t v = 0; v < c.vertices.size(); ++v) {
    mesh.push_back({c.vertices[v].x, c.vertices[v].y, c.heights[v]});
  }
  diagonal_ = diagonal_of(mesh);
  bind_by_name(c, file);
  if (!by_name_) bind_anew(mesh, options.turns);
  view_.markers = bindings_;
  start({c.triangles.begin(), c.triangles.end()}, options);
}

void MarkerPuppet::choose(const MarkerFile& file, std::size_t frame) {
  for (const std::size_t m : used_) {
    chosen_.push_back(file.frame(frame)[m]);
    if (is_seen(chosen_.back())) continue;
    throw UserError("marker '" + file.names[m] +
                    "' is not seen in the frame to register; choose another --frame or leave it out by --only");
  }
  targets_.resize(used_.size());
  seen_.resize(used_.size());
}

// Where every marker's name is one of the character's, and they lie as the character has them.
void MarkerPuppet::bind_by_name(const Character& c, const MarkerFile& file) {
  constexpr float kSameBody = 0.005f;  // of the diagonal, rms
  const std::vector<std::string> names = marker_names(c.lattice);
  std::vector<Vec3> places;
  for (const std::size_t m : used_) {
    const auto at = std::find(names.begin(), names.end(), file.names[m]);
    if (c.lattice.drive != LatticeDrive::markers || at == names.end()) return;
    bindings_.push_back(c.lattice.view.markers[static_cast<std::size_t>(at - names.begin())]);
    places.push_back(place_of(bindings_.back(), c.lattice.view.vertices));
  }
  registration_ = register_to_places(chosen_, places);
  by_name_ = true;
  if (registration_.rms < kSameBody * diagonal_) return;
  // Each keeps its tetrahedron: where registration lays it another finger may be nearer.
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    MarkerBinding& b = bindings_[k];
    const auto at = [&](int corner) { return view_.vertices[b.vertex[corner]]; };
    const auto w = barycentric({at(0), at(1), at(2), at(3)}, registration_(chosen_[k]));
    std::copy(w.begin(), w.end(), b.weight);
  }
}

void MarkerPuppet::bind_anew(const std::vector<Vec3>& mesh, const std::vector<Quat>& turns) {
  registration_ = register_markers(chosen_, mesh, turns);
  const Binder binder(view_.vertices, view_.tetrahedra);
  bindings_.clear();
  for (const Vec3 p : chosen_) bindings_.push_back(binder.marker(registration_(p)));
}

void MarkerPuppet::start(const std::vector<uint32_t>& mesh_triangles, const PuppetOptions& options) {
  Arena measure;
  const bool phong = options.embedding == Embedding::phong;
  if (phong) PhongEmbedding::create(measure, embedding_, view_);
  memory_ = std::make_unique<Memory>(Lattice::bytes_needed(view_) + measure.used());
  Arena arena(memory_->block.bytes());
  const auto made = Lattice::create(arena, view_, options.solver);
  if (!made.ok()) throw UserError(made.status().message);
  lattice_ = made.value();
  if (options.embedding == Embedding::green) green_ = green_embedding(embedding_, view_);
  if (phong) phong_ = PhongEmbedding::create(arena, embedding_, view_);
  places_.resize(12 * embedding_.blocks());
  for (const uint32_t i : mesh_triangles) triangles_.push_back(slots_[i]);
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
  } else if (!green_.empty()) {
    embed_green(embedding_, green_, view_, lattice_->vertices(), places_);
  } else {
    embed_linear(embedding_, view_, lattice_->vertices(), places_);
  }
  return report;
}

Vec3 MarkerPuppet::vertex(std::size_t v) const {
  const std::size_t s = 3u * slots_[v];
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
    sum += length(place_of(view_.markers[k], lattice_->vertices()) - targets_[k]), count += 1.0f;
  }
  return count > 0.0f ? sum / count : 0.0f;
}

}  // namespace nt
