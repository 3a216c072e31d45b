// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/drag.h"

#include <algorithm>

#include "platform/camera.h"

namespace nt {
namespace {

constexpr float kNear_px = 14;   // of a pin or a joint
constexpr float kReach_px = 40;  // of a vertex
constexpr float kFilled = 0.7f;  // of the picture, by the body at rest
constexpr Colour kJointColour{0.2f, 0.7f, 0.9f, 0.9f}, kPinColour{0.9f, 0.2f, 0.2f, 1};

// A joint's vertex alone.
MarkerBinding at_vertex(uint16_t v) {
  MarkerBinding b;
  for (uint16_t& corner : b.vertex) corner = v;
  return b;
}

}  // namespace

Drag::Drag(const Character& c, int width, int height)
    : character_(c), view_(c.lattice.view), width_(width), height_(height) {
  if (!c.lattice.present()) throw UserError("only a 3D character with a lattice can be pulled at");
  Vec2 low = c.vertices[0], high = low;
  for (const Vec2 p : c.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 size = high - low;
  zoom_ = kFilled * std::min(static_cast<float>(width) / std::max(size.x, 1e-6f),
                             static_cast<float>(height) / std::max(size.y, 1e-6f));
  const Vec2 middle = lerp(low, high, 0.5f);
  origin_ = {0.5f * static_cast<float>(width) - zoom_ * middle.x, 0.5f * static_cast<float>(height) + zoom_ * middle.y};
  bindings_.resize(kMostPins), targets_.resize(kMostPins), seen_.resize(kMostPins);
  view_.markers = bindings_;
  Arena measure;
  PhongEmbedding::create(measure, c.lattice.embedding, view_);
  memory_ = AlignedBlock(Lattice::bytes_needed(view_) + measure.used());
  Arena arena(memory_.bytes());
  lattice_ = Lattice::create(arena, view_, LatticeSettings{}).value();
  embedding_ = PhongEmbedding::create(arena, c.lattice.embedding, view_);
  places_.resize(12 * c.lattice.embedding.blocks());
  flat_.resize(c.vertices.size()), heights_.resize(c.vertices.size()), normals_.resize(c.vertices.size());
  embedding_->embed(lattice_->vertices(), places_);
}

Vec3 Drag::vertex(std::size_t v) const {
  const float* p = &places_[3u * character_.lattice.slots[v]];
  return {p[0], p[1], p[2]};
}

std::size_t Drag::pins() const { return static_cast<std::size_t>(std::count(seen_.begin(), seen_.end(), 1)); }

std::optional<std::size_t> Drag::pin_at(Vec2 p) const {
  for (const std::size_t k : order_) {
    if (length(to_scene(targets_[k]) - p) < kNear_px) return k;
  }
  return std::nullopt;
}

// The nearest joint where one is near, else the nearest vertex, of those at one place the highest.
std::optional<Drag::Grip> Drag::grip_at(Vec2 p) const {
  const CharacterLattice& l = character_.lattice;
  for (const uint16_t v : view_.skeleton.vertex) {
    const Vec3 at = lattice_->vertices()[v];
    if (length(to_scene(at) - p) < kNear_px) return Grip{at_vertex(v), at};
  }
  std::size_t best = character_.vertices.size();
  float least = kReach_px;
  for (std::size_t v = 0; v < character_.vertices.size(); ++v) {
    const Vec3 at = vertex(v);
    const float off = length(to_scene(at) - p);
    if (off > least || (off == least && best < v && at.z < vertex(best).z)) continue;
    least = off, best = v;
  }
  if (best == character_.vertices.size()) return std::nullopt;
  const uint32_t slot = l.slots[best];
  const float* b = &l.embedding.coordinates[12u * (slot / 4) + slot % 4];
  Grip grip{{}, vertex(best)};
  const float weight[4] = {1.0f - b[0] - b[4] - b[8], b[0], b[4], b[8]};
  for (std::size_t k = 0; k < 4; ++k) {
    grip.binding.vertex[k] = view_.tetrahedra[4u * l.embedding.tetrahedron[slot / 4] + k];
    grip.binding.weight[k] = weight[k];
  }
  return grip;
}

void Drag::press(Vec2 p) {
  held_ = pin_at(p);
  if (!held_) {
    const std::optional<Grip> grip = grip_at(p);
    const auto free = std::find(seen_.begin(), seen_.end(), uint8_t{0});
    if (!grip || free == seen_.end()) return;
    held_ = static_cast<std::size_t>(free - seen_.begin());
    bindings_[*held_] = grip->binding;
    targets_[*held_] = grip->at;
    seen_[*held_] = 1;
    order_.push_back(*held_);
  }
  const Vec3 pressed{(p.x - origin_.x) / zoom_, (origin_.y - p.y) / zoom_, 0};
  held_offset_ = targets_[*held_] - pressed;
}

void Drag::handle(const InputEvent& event) {
  if (event.kind == InputEvent::Kind::click) press(event.at);
  if (event.kind == InputEvent::Kind::move && held_) {
    const Vec3 pressed{(event.at.x - origin_.x) / zoom_, (origin_.y - event.at.y) / zoom_, 0};
    targets_[*held_] = pressed + held_offset_;
  }
  if (event.kind == InputEvent::Kind::release) held_.reset();
  if (event.kind != InputEvent::Kind::key || order_.empty()) return;
  if (event.key == 'u') seen_[order_.back()] = 0, order_.pop_back(), held_.reset();
  if (event.key == 'x') std::fill(seen_.begin(), seen_.end(), uint8_t{0}), order_.clear(), held_.reset();
}

LatticeReport Drag::step() {
  const LatticeReport report = lattice_->step(targets_, seen_);
  embedding_->embed(lattice_->vertices(), places_);
  return report;
}

// The normals of the triangles around each vertex, by their area; scene axes.
void Drag::turn_normals() {
  std::fill(normals_.begin(), normals_.end(), Vec3{});
  const auto& t = character_.triangles;
  for (std::size_t i = 0; i + 2 < t.size(); i += 3) {
    const Vec3 a = vertex(t[i]), n = cross(vertex(t[i + 1]) - a, vertex(t[i + 2]) - a);
    for (std::size_t k = 0; k < 3; ++k) normals_[t[i + k]] += Vec3{n.x, -n.y, n.z};
  }
}

void Drag::draw(Scene& scene) {
  scene.clear(width_, height_, {0.96f, 0.97f, 0.97f, 1});
  for (std::size_t v = 0; v < flat_.size(); ++v) {
    const Vec3 p = vertex(v);
    flat_[v] = to_scene(p), heights_[v] = zoom_ * p.z;
  }
  turn_normals();
  Picture texture = character_.texture;
  texture.id = 1;
  scene.solid(texture, flat_, heights_, normals_, character_.texcoords, character_.triangles);
  joints_.clear(), dots_.clear();
  for (const uint16_t v : view_.skeleton.vertex) joints_.push_back(to_scene(lattice_->vertices()[v]));
  for (const std::size_t k : order_) dots_.push_back(to_scene(targets_[k]));
  scene.points(joints_, kJointColour, 7);
  scene.points(dots_, kPinColour, 12);
}

}  // namespace nt
