// SPDX-License-Identifier: Apache-2.0
// A mesh that follows markers: lattice, solver and embedding in one place.
//
// Input: a mesh, maybe a skeleton, and a marker file with the frame in which the mesh's pose is the actor's; or a character file
// with a lattice in place of the first two. Then one frame after another: markers in, mesh vertices out, in the mesh's (the
// character's) unit and axes. Memory is taken once; a frame takes none.
// A character whose markers have the file's names is registered by them, and keeps where each sits on it. Those of an actor
// of other proportions stay with their tetrahedron, at the place where registration lays them, inside or out: that offset is what
// makes up for the proportions. Markers of other names are bound where registration lays them.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/author/lattice_builder.h"
#include "app/mocap/marker_file.h"
#include "app/mocap/registration.h"
#include "core/character/character.h"
#include "core/deform/embed.h"
#include "core/deform/lattice.h"

namespace nt {

enum class Embedding { linear, phong, green };

struct PuppetOptions {
  LatticeOptions lattice;
  LatticeSettings solver;
  Embedding embedding = Embedding::phong;
  std::vector<Quat> turns;  // to start the registration from; empty: all ways of laying axes on axes
};

class MarkerPuppet {
 public:
  // markers: which of the file's to use. Throws UserError.
  MarkerPuppet(const TriangleMesh& mesh, const SkeletonSpec& skeleton, const MarkerFile& file,
               const std::vector<std::size_t>& markers, std::size_t frame, const PuppetOptions& options);
  // The character's bytes must outlive it; `options.lattice` is not read.
  MarkerPuppet(const Character& character, const MarkerFile& file, const std::vector<std::size_t>& markers,
               std::size_t frame, const PuppetOptions& options);
  ~MarkerPuppet();

  LatticeReport step(std::span<const Vec3> file_frame);
  const std::vector<float>& places() const { return places_; }           // 3 a slot of the embedding
  const std::vector<uint32_t>& triangles() const { return triangles_; }  // of slots
  const std::vector<Vec3>& targets() const { return targets_; }          // this frame's markers, on the mesh
  const LatticeView& view() const { return view_; }
  const Lattice& lattice() const { return *lattice_; }
  const EmbeddingView& embedding() const { return embedding_; }
  std::span<const uint32_t> slots() const { return slots_; }  // of each mesh vertex, its slot in the embedding
  const Registration& registration() const { return registration_; }
  bool bound_by_name() const { return by_name_; }
  std::size_t mesh_vertices() const { return slots_.size(); }
  int mesh_vertices_outside() const { return built_.outside; }
  float diagonal() const { return diagonal_; }  // of the mesh
  Vec3 vertex(std::size_t mesh_vertex) const;
  double volume() const;  // of the mesh, by the divergence theorem
  // Of the last step; an average over the markers that are seen, in the mesh's unit.
  float marker_error() const;

 private:
  struct Memory;
  void choose(const MarkerFile& file, std::size_t frame);
  void bind_by_name(const Character& character, const MarkerFile& file);
  void bind_anew(const std::vector<Vec3>& mesh, const std::vector<Quat>& turns);
  void start(const std::vector<uint32_t>& mesh_triangles, const PuppetOptions& options);

  std::vector<std::size_t> used_;
  std::vector<Vec3> chosen_;  // where the used ones are in the frame to register
  Registration registration_;
  bool by_name_ = false;
  BuiltLattice built_;
  LatticeView view_;
  EmbeddingView embedding_;
  std::span<const uint32_t> slots_;
  std::vector<MarkerBinding> bindings_;
  float diagonal_ = 1.0f;
  std::unique_ptr<Memory> memory_;
  Lattice* lattice_ = nullptr;
  PhongEmbedding* phong_ = nullptr;
  std::vector<float> green_;  // coordinates, where that is the embedding
  std::vector<Vec3> targets_;
  std::vector<uint8_t> seen_;
  std::vector<float> places_;
  std::vector<uint32_t> triangles_;
};

}  // namespace nt
