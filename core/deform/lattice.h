// SPDX-License-Identifier: Apache-2.0
// The lattice solver of [L]: a few markers in, a whole control lattice out, each frame.
//
// Input: the view of a lattice at rest (core/deform/lattice_view.h), and each frame the positions of its markers with a
// flag for those that are there, in the mesh's unit. Output: the position of every lattice vertex and the rotation of
// every bone. Then core/deform/embed.h moves the detail mesh.
// Source: [L] Algorithm 1. With R_i the rotation of vertex i (Eq 5), e_ij = v_i - v_j, B the marker bindings, D the bone
// edges and Gamma their projected directions (core/deform/skeleton.h), each iteration solves for V'
//   arap     (w_l L + w_u^2 B^T B + w_d^2 D^T D) V' = w_l Delta + w_u^2 B^T U + w_d^2 D^T Gamma
//   stacked  the same with w_l^2 L^T L and w_l^2 L^T Delta: [L] Eq 11 as it stands
// where Delta_i = sum_j w_ij / 2 (R_i + R_j) e_ij.
// Differs from [L]: (1) the ARAP form is the default, because L^T L costs a factor of 3 in size and float its digits; (2)
// it solves for the change of V', so float errors are those of a small number, and a pose far from the origin loses
// nothing; (3) the iteration is mixed (core/deform/anderson.h), which needs the gradient too, and starts from an extrapolated pose: the
// markers' change since the last frame is known, so it is fitted by their two changes before, and the pose's two changes
// are mixed alike. That follows a sway, and cannot double noise; (4) bone lengths are made exact at the end and what this moves is spread over the neighbours; (5) markers come and go, see below.
// A marker that is lost drops out: over blend_frames its weight sinks to 0 while its target is where it is, so nothing snaps.
// One that returns starts with its target where the lattice has it and sheds that offset evenly over blend_frames.
// Without any marker the pose is held. When weights change the matrix is factorised again, in place.
// Memory: `bytes_needed`, 0.4 to 0.5 KB a vertex. Cost at 430 vertices: 25 us an iteration, 0.15 ms a factorisation.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/status.h"
#include "core/deform/anderson.h"
#include "core/deform/lattice_view.h"
#include "core/deform/rotations.h"
#include "core/deform/skeleton.h"
#include "core/deform/sparse_ldlt.h"

namespace nt {

struct LatticeSettings {
  float w_l = 1.0f;   // shape; weights are relative to the median cotangent weight
  float w_u = 10.0f;  // markers
  float w_d = 2.0f;   // bones: more keeps lengths sooner and everything else later, the exact pass does the rest
  int max_iterations = 10;
  float tolerance = 0.0f;  // stop when an iteration moves the lattice (rms) less than this times its diagonal
  bool accelerate = true;
  bool extrapolate = true;
  bool exact_bones = true;
  int untangle_sweeps = 400;  // at most, where tetrahedra are turned inside out (core/deform/untangle.h); 0: they stay
  int blend_frames = 24;      // over which a marker fades out or its offset in
};

struct LatticeReport {
  int iterations = 0;
  float residual = 0.0f;    // rms of what a plain iteration would still move at the last one's start, over the diagonal
  int markers = 0;          // that are there
  int guarded = 0;          // mixed steps taken back
  bool held = false;        // no marker: the pose of before
  bool factorised = false;  // the markers' weights changed
  int inverted = 0;         // tetrahedra that no sweep could turn back
  bool singular = false;    // a pivot was not positive: the pose of before; widen w_u or check the lattice
};

// How well a pose keeps the shape ([L] Table I).
struct LatticeQuality {
  float rrms = 0.0f;            // sqrt(sum w |e' - R e|^2 / sum w |e|^2)
  float bone_error_sum = 0.0f;  // E_ED: sum over bone edges of |d' - d| / d
  float bone_error_max = 0.0f;
  int bone_edges = 0;
  int inverted = 0;  // tetrahedra
};

class Lattice {
 public:
  // Exact for this view; what `create` takes.
  static std::size_t bytes_needed(const LatticeView& view);
  // The view must outlive the result, and be checked (`check_lattice`) if it came from a file.
  static Result<Lattice*> create(Arena& arena, const LatticeView& view, const LatticeSettings& settings);

  // markers and seen: one entry for each marker of the view. A position that is not finite counts as not seen.
  LatticeReport step(std::span<const Vec3> markers, std::span<const uint8_t> seen);
  // The next step starts from the rest pose laid rigidly on its markers.
  void reset();

  std::span<const Vec3> vertices() const { return pose_; }
  std::span<const Quat> bone_rotations() const { return skeleton_.rotations(); }
  // Of each vertex the columns of its rotation, nine floats, as of the last step's last iteration.
  std::span<const float> rotation_columns() const { return columns_; }
  const Skeleton& skeleton() const { return skeleton_; }
  const LatticeView& view() const { return view_; }
  LatticeQuality quality() const;
  LatticeSettings& settings() { return settings_; }

 private:
  struct Marker {
    Vec3 target, before, step, step_before;  // this frame's, the last one's, and the two changes before that
    Vec3 offset;                             // still to be shed after a return
    int to_shed = 0;                         // over so many frames
    float weight = 0.0f;
    bool seen = false;
  };
  struct Course {
    float last = 0.0f, before = 0.0f;
  };
  void lay_out(Arena& arena);
  bool read_markers(std::span<const Vec3> markers, std::span<const uint8_t> seen, LatticeReport& report);
  void shed_offsets();
  void lose(Marker& m, const MarkerBinding& b);
  Course course() const;
  void start_rigidly();
  void extrapolate();
  bool factorise();
  void add_shape();
  Matrix4x gather_block(std::size_t block);
  void turn_vertices();
  void sum_shape();
  void stack_shape();
  void add_constraints();
  double iterate();
  int finish();
  void spread_bone_shift();
  Vec3 at(std::size_t i) const { return {x_[3 * i], x_[3 * i + 1], x_[3 * i + 2]}; }
  Vec3 marker_place(const MarkerBinding& b) const;

  LatticeView view_;
  LatticeSettings settings_;
  SparseLdlt factor_;
  Anderson anderson_;
  Skeleton skeleton_;
  std::size_t n_ = 0;
  float diagonal_ = 1.0f;               // of the bounding box at rest
  std::span<float> x_, last_, before_;  // the iterate and the last two frames', 3 floats a vertex and a tail
  std::span<float> gradient_;           // of the energy, negative
  std::span<float> f_;                  // what a plain iteration would change
  std::span<Float4> b_, h_;             // right-hand side; h only in the stacked form
  std::span<float> columns_;            // of R, nine a vertex and a tail
  std::span<Quat4> q_;
  std::span<Float4> rest_;  // vertices at rest
  std::span<Marker> markers_;
  std::span<uint8_t> on_bone_;
  std::span<Vec3> pose_;
  bool started_ = false, factored_ = false, blending_ = false;
  int steady_frames_ = 0;  // with the same markers, all at their own place; 3 at most
};

}  // namespace nt
