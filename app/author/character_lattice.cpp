// SPDX-License-Identifier: Apache-2.0
#include "app/author/character_lattice.h"

#include <algorithm>
#include <cmath>

#include "app/aligned_block.h"
#include "app/author/curve_skeleton.h"
#include "core/character/retarget.h"
#include "core/deform/lattice.h"
#include "platform/camera.h"

namespace nt {
namespace {

TriangleMesh mesh_of(const Character& c) {
  TriangleMesh mesh;
  for (std::size_t v = 0; v < c.vertices.size(); ++v) {
    mesh.positions.push_back({c.vertices[v].x, c.vertices[v].y, c.heights[v]});
  }
  mesh.triangles.assign(c.triangles.begin(), c.triangles.end());
  return mesh;
}

void add_name(std::vector<char>& names, const std::string& name) {
  names.insert(names.end(), name.begin(), std::find(name.begin(), name.end(), '\0'));
  names.push_back('\0');
}

// The middle between the highest and the lowest of the mesh at p; beside the mesh that of its nearest vertex.
float middle_height(const Character& c, Vec2 p) {
  float low = INFINITY, high = -INFINITY;
  for (std::size_t t = 0; t + 2 < c.triangles.size(); t += 3) {
    const Vec2 a = c.vertices[c.triangles[t]], b = c.vertices[c.triangles[t + 1]], d = c.vertices[c.triangles[t + 2]];
    const float area = cross(b - a, d - a);
    const float u = cross(p - a, d - a) / area, v = cross(b - a, p - a) / area;
    if (!(u >= 0.0f && v >= 0.0f && u + v <= 1.0f)) continue;
    const float za = c.heights[c.triangles[t]], zb = c.heights[c.triangles[t + 1]], zd = c.heights[c.triangles[t + 2]];
    const float z = za + u * (zb - za) + v * (zd - za);
    low = std::min(low, z), high = std::max(high, z);
  }
  if (low <= high) return 0.5f * (low + high);
  const auto nearest = std::min_element(c.vertices.begin(), c.vertices.end(),
                                        [&](Vec2 a, Vec2 b) { return length_sq(a - p) < length_sq(b - p); });
  return c.heights[static_cast<std::size_t>(nearest - c.vertices.begin())];
}

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

SkeletonSpec midline(const Character& c, float z) {
  SkeletonSpec out;
  const auto add = [&](const std::string& name, int parent, Vec2 p) {
    out.joints.push_back({name, parent, {p.x, p.y, z}, {}});
    return static_cast<int>(out.joints.size()) - 1;
  };
  const int centre = add("centre", -1, c.rest.centre);
  int last = centre;
  for (int i = 0; i < c.u_num; ++i) last = add("up_axis_" + std::to_string(i + 1), last, c.rest.up_axis[i]);
  add("head", last, c.rest.head);
  last = centre;
  for (int i = 0; i < c.l_num; ++i) last = add("low_axis_" + std::to_string(i + 1), last, c.rest.low_axis[i]);
  add("tail", last, c.rest.tail);
  return out;
}

// The control points that Retarget moves.
std::vector<Vec2> rest_handles(const Character& c) {
  Arena measuring;
  RetargetSettings settings;
  settings.deformer = Deformer::mls;
  (void)Retarget::create(measuring, c, settings);
  AlignedBlock memory(measuring.used());
  Arena arena(memory.bytes());
  const auto made = Retarget::create(arena, c, settings);
  if (!made.ok()) throw UserError(made.status().message);
  const auto handles = made.value()->rest_handles();
  return {handles.begin(), handles.end()};
}

}  // namespace

LatticeAsset::LatticeAsset(const Character& character, const SkeletonSpec& skeleton,
                           const std::vector<MarkerSpec>& markers, LatticeDrive drive, const LatticeOptions& options)
    : drive_(drive) {
  if (!character.solid()) throw UserError("--lattice is for 3D characters; this one is a flat drawing", 2);
  built_ = build_lattice(mesh_of(character), skeleton, markers, options);
  for (const MarkerSpec& m : markers) add_name(names_, m.name);
  for (const auto& joint : skeleton.joints) add_name(names_, joint.name);
}

CharacterLattice LatticeAsset::view() const {
  CharacterLattice l;
  l.drive = drive_;
  l.view = built_.data.view();
  l.embedding = {built_.embedding.coordinates, built_.embedding.tetrahedron};
  l.slots = built_.embedding.slot;
  l.names = names_;
  return l;
}

LatticeAsset fish_lattice(const Character& c, const LatticeOptions& options) {
  if (!c.solid()) throw UserError("--lattice is for 3D characters; this one is a flat drawing", 2);
  const std::vector<Vec2> handles = rest_handles(c);
  const std::size_t body = 3u + static_cast<std::size_t>(c.u_num + c.l_num);
  std::vector<float> heights;
  for (const Vec2 p : handles) heights.push_back(middle_height(c, p));
  const float z = median({heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(body)});
  std::vector<MarkerSpec> markers;
  for (std::size_t k = 0; k < handles.size(); ++k) {
    markers.push_back({"control_" + std::to_string(k), {handles[k].x, handles[k].y, k < body ? z : heights[k]}});
  }
  return LatticeAsset(c, midline(c, z), markers, LatticeDrive::landmarks, options);
}

LatticeAsset limbed_lattice(const Character& c, const LatticeOptions& options) {
  if (!c.solid()) throw UserError("only a 3D character can have a lattice; this one is a flat drawing", 2);
  return LatticeAsset(c, curve_skeleton(mesh_of(c)), {}, LatticeDrive::markers, options);
}

std::string describe(const LatticeAsset& asset) {
  const BuiltLattice& b = asset.built();
  return "lattice of " + std::to_string(b.data.vertices.size()) + " vertices and " +
         std::to_string(b.data.tetrahedra.size() / 4) + " tetrahedra, " + std::to_string(b.data.joint_vertex.size()) +
         " joints, " + std::to_string(b.data.markers.size()) + " markers, " +
         std::to_string(Lattice::bytes_needed(b.data.view())) + " bytes to solve it in";
}

}  // namespace nt
