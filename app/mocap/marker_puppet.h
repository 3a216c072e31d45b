// SPDX-License-Identifier: Apache-2.0
// A mesh that follows markers: lattice, solver and embedding in one place.
//
// Input: a mesh, maybe a skeleton, a marker file and the frame in which the mesh's pose is the actor's. Then one frame after
// another: markers in, mesh vertices out, in the mesh's unit and axes. Memory is taken once; a frame takes none.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/author/lattice_builder.h"
#include "app/mocap/marker_file.h"
#include "app/mocap/registration.h"
#include "core/deform/embed.h"
#include "core/deform/lattice.h"

namespace nt {

struct PuppetOptions {
  LatticeOptions lattice;
  LatticeSettings solver;
  bool phong = true;
  std::vector<Quat> turns;  // to start the registration from; empty: all ways of laying axes on axes
};

class MarkerPuppet {
 public:
  // markers: which of the file's to use. Throws UserError.
  MarkerPuppet(const TriangleMesh& mesh, const SkeletonSpec& skeleton, const MarkerFile& file,
               const std::vector<std::size_t>& markers, std::size_t frame, const PuppetOptions& options);
  ~MarkerPuppet();

  LatticeReport step(std::span<const Vec3> file_frame);
  const std::vector<float>& places() const { return places_; }           // 3 a slot of the embedding
  const std::vector<uint32_t>& triangles() const { return triangles_; }  // of slots
  const std::vector<Vec3>& targets() const { return targets_; }          // this frame's markers, on the mesh
  const BuiltLattice& built() const { return built_; }
  const Lattice& lattice() const { return *lattice_; }
  const Registration& registration() const { return registration_; }
  Vec3 vertex(std::size_t mesh_vertex) const;
  double volume() const;  // of the mesh, by the divergence theorem
  // Of the last step; an average over the markers that are seen, in the mesh's unit.
  float marker_error() const;

 private:
  struct Memory;
  std::vector<std::size_t> used_;
  Registration registration_;
  BuiltLattice built_;
  std::unique_ptr<Memory> memory_;
  Lattice* lattice_ = nullptr;
  PhongEmbedding* phong_ = nullptr;
  std::vector<Vec3> targets_;
  std::vector<uint8_t> seen_;
  std::vector<float> places_;
  std::vector<uint32_t> triangles_;
};

}  // namespace nt
