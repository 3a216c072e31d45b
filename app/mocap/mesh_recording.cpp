// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/mesh_recording.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/deform/rotations.h"

namespace nt {

MeshRecording::MeshRecording(const MarkerPuppet& puppet, const std::string& name, double rate_hz, bool lying)
    : rate_hz_(rate_hz), lying_(lying), diagonal_(puppet.diagonal()) {
  model_.name = name, model_.animation = name;
  model_.note = lying ? "Y up, the character looks along -Z; the unit is the character's" : "axes and unit of the mesh";
  model_.drawing = false;
  model_.joints.push_back({"lattice", -1, {}, {}, {}, {}});
  for (std::size_t i = 0; i < puppet.view().vertices.size(); ++i) {
    model_.joints.push_back({"v" + std::to_string(i), 0, upright(puppet.view().vertices[i]), {}, {}, {}});
  }
  const auto slots = puppet.slots();
  std::vector<uint32_t> vertex_of(4 * puppet.embedding().blocks());
  for (std::size_t v = 0; v < slots.size(); ++v) {
    vertex_of[slots[v]] = static_cast<uint32_t>(v);
    add_vertex(puppet, v);
  }
  for (const uint32_t slot : puppet.triangles()) model_.triangles.push_back(vertex_of[slot]);
  add_normals();
}

void MeshRecording::add_vertex(const MarkerPuppet& puppet, std::size_t vertex) {
  const std::size_t slot = puppet.slots()[vertex], block = slot / 4, lane = slot % 4;
  const float* b = &puppet.embedding().coordinates[12 * block + lane];
  const uint16_t* corner = &puppet.view().tetrahedra[4u * puppet.embedding().tetrahedron[block]];
  const std::array<double, 4> exact{
      1.0 - static_cast<double>(b[0]) - static_cast<double>(b[4]) - static_cast<double>(b[8]), b[0], b[4], b[8]};
  Vec3 at;
  double positive = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    at += static_cast<float>(exact[k]) * puppet.view().vertices[corner[k]];
    positive += std::max(exact[k], 0.0);
  }
  SkinVertex skin;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(exact[k] > 0.0)) continue;
    skin.joints[k] = static_cast<uint16_t>(corner[k] + 1);
    skin.weights[k] = static_cast<float>(exact[k] / positive);
  }
  model_.vertices.push_back(upright(at));
  model_.skin.push_back(skin);
}

// Of the rest pose, each the mean of its triangles' by their areas.
void MeshRecording::add_normals() {
  model_.normals.resize(model_.vertices.size());
  for (std::size_t t = 0; t < model_.triangles.size(); t += 3) {
    const uint32_t* corner = &model_.triangles[t];
    const Vec3 a = model_.vertices[corner[0]];
    const Vec3 n = cross(model_.vertices[corner[1]] - a, model_.vertices[corner[2]] - a);
    for (int k = 0; k < 3; ++k) model_.normals[corner[k]] += n;
  }
  for (Vec3& n : model_.normals) n = normalised(n, {0, 1, 0});
}

void MeshRecording::add(const MarkerPuppet& puppet) {
  model_.times_s.push_back(static_cast<float>(static_cast<double>(model_.times_s.size()) / rate_hz_));
  for (std::size_t i = 0; i < puppet.lattice().vertices().size(); ++i) {
    ModelJoint& joint = model_.joints[i + 1];
    joint.at.push_back(upright(puppet.lattice().vertices()[i]));
    // The matrix' columns are the rows of S = R^T, whose best rotation is R.
    const Quat q = best_rotation(&puppet.lattice().rotation_columns()[9 * i]);
    const Vec3 axis = upright(axis_part(q));
    const bool far = !joint.turn.empty() && dot(joint.turn.back(), Quat{q.w, axis.x, axis.y, axis.z}) < 0.0f;
    const float sign = far ? -1.0f : 1.0f;
    joint.turn.push_back({sign * q.w, sign * axis.x, sign * axis.y, sign * axis.z});
  }
  measure(puppet);
}

void MeshRecording::measure(const MarkerPuppet& puppet) {
  for (std::size_t v = 0; v < model_.vertices.size(); ++v) {
    Vec3 at;
    for (std::size_t k = 0; k < kInfluences; ++k) {
      const ModelJoint& joint = model_.joints[model_.skin[v].joints[k]];
      if (model_.skin[v].weights[k] == 0.0f) continue;
      at += model_.skin[v].weights[k] * (joint.at.back() + rotate(joint.turn.back(), model_.vertices[v] - joint.rest));
    }
    const double off = static_cast<double>(length(at - upright(puppet.vertex(v))) / diagonal_);
    squares_ += off * off, most_ = std::max(most_, off);
  }
}

MeshRecordingReport MeshRecording::write(const std::string& path) {
  write_model(path, model_);
  const auto count = static_cast<double>(model_.vertices.size() * std::max<std::size_t>(model_.times_s.size(), 1));
  return {model_.joints.size(), model_.times_s.size(), std::sqrt(squares_ / count), most_};
}

}  // namespace nt
