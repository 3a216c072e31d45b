// SPDX-License-Identifier: Apache-2.0
// A mesh that markers move as a GLB file (glTF 2.0): skin and linear keys, one for each frame.
//
// Input: a puppet (marker_puppet.h) after each of its steps. Output: a model whose joints are the lattice's vertices, each with its
// place and rotation, and whose weights are the barycentric ones of the embedding, so nothing is fitted:
//   x' = sum b_i (x_i' + R_i (X - X_i)),
// which is the linear embedding bent by the lattice's own rotations; normals turn with it. Continuous across faces.
// Vertices outside of the lattice keep the corners whose weight is positive. Unit: the mesh's; a character, which lies
// on its belly, is stood up: Y up, it looks along -Z.
// Memory: 28 bytes a lattice vertex and frame, and so is the file.
#pragma once
#include <string>

#include "app/export/skinned_model.h"
#include "app/mocap/marker_puppet.h"

namespace nt {

struct MeshRecordingReport {
  std::size_t joints = 0, keys = 0;
  // Skinned vertices against the puppet's, over all frames, over the diagonal.
  double error_rms = 0, error_most = 0;
};

class MeshRecording {
 public:
  // `lying`: the puppet's axes are a character's.
  MeshRecording(const MarkerPuppet& puppet, const std::string& name, double rate_hz, bool lying);
  void add(const MarkerPuppet& puppet);
  // Throws UserError.
  MeshRecordingReport write(const std::string& path);

 private:
  Vec3 upright(Vec3 p) const { return lying_ ? Vec3{p.x, p.z, -p.y} : p; }
  void add_vertex(const MarkerPuppet& puppet, std::size_t vertex);
  void add_normals();
  void measure(const MarkerPuppet& puppet);

  double rate_hz_;
  bool lying_;
  SkinnedModel model_;
  double squares_ = 0.0, most_ = 0.0;
  float diagonal_;
};

}  // namespace nt
