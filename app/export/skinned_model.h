// SPDX-License-Identifier: Apache-2.0
// A skinned, animated mesh as plain numbers, and its bytes as a GLB file (glTF 2.0, binary).
//
// Frame of reference and unit: the file's own; the rest pose has no rotations. Joints come parents
// first, the first is the root; keys are linear, `times_s` are common to all. The material shows both sides; `drawing`:
// unlit and blended by its alpha. What does not move has no keys. Bytes are written by tinygltf, which is loaded late.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "app/export/skin_fit.h"
#include "core/base/vec3.h"

namespace nt {

struct ModelJoint {
  std::string name;
  int parent = -1;
  Vec3 rest;                    // in the whole model's frame
  std::vector<Vec3> at;         // a key each: in the parent's frame
  std::vector<float> turn_rad;  // a key each: against the parent, about `axis`
  std::vector<Quat> turn;       // or about any, one after the other on the short way
};

struct SkinnedModel {
  std::string name, animation;
  std::string note;  // units and axes, kept in the file
  bool drawing = true;
  Vec3 axis;                            // of all turns, unit
  std::vector<Vec3> vertices, normals;  // normals: of a solid
  std::vector<Vec2> texcoords;          // none without a picture
  std::vector<uint32_t> triangles;
  std::vector<SkinVertex> skin;
  std::vector<uint8_t> png;
  std::vector<ModelJoint> joints;
  std::vector<float> times_s;
};

std::vector<uint8_t> glb_bytes(const SkinnedModel& model);
// Throws UserError.
void write_model(const std::string& path, const SkinnedModel& model);

}  // namespace nt
