// SPDX-License-Identifier: Apache-2.0
// Moving least squares deformation in the plane: moved control points -> moved vertices.
//
// Input, once: rest positions v of the vertices and p_i of the control points, same frame and unit. Input, each frame:
// the control points' new positions q_i. Output: f(v) per vertex. Any frame; the unit cancels.
// Source: Schaefer, McPhail, Warren, "Image deformation using moving least squares", 2006, Eqs 5-8, weights
// w_i = 1 / |p_i - v|^(2 alpha). With points as complex numbers, u_i = w_i / sum w, p* = sum u_i p_i, p^_i = p_i - p*:
//   rigid       f(v) = q* + |v - p*| F / |F|, F = sum c_i q_i, c_i = u_i conj(p^_i) (v - p*) up to a positive factor
//   similarity  f(v) = sum k_i q_i, k_i = u_i + u_i conj(p^_i) (v - p*) / sum u |p^|^2
//   affine      f(v) = sum k_i q_i, k_i = u_i + (v - p*) (sum u p^ p^T)^-1 u_i p^_i, real
// Differs from the paper: since sum u_i p^_i = 0, its q^_i = q_i - q* is replaced by q_i, so everything but q is known at
// rest: 3 floats per (vertex, control point) for rigid, 2 for similarity and affine, no matrices per frame.
// Degenerate rest poses: a vertex on a control point moves with it exactly; control points that coincide count as one
// that is moved to their mean; one control point (or all in one place) translates; collinear ones make affine singular,
// which then takes the similarity. If the moved points leave no direction (F = 0) the vertex goes to q*.
// Memory: 12 bytes per (vertex, control point) rigid, 8 otherwise, vertices padded to 8: 0.9 MB for 2,500 x 30.
// Cost: 8 flops per (vertex, control point) and a square root per vertex; bound by reading that memory.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/vec2.h"

namespace nt {

enum class MlsKind : uint8_t { rigid, similarity, affine };

class Mls {
 public:
  // Vertices a SIMD group works on; coefficients are stored in blocks of this many, so a block is one run of memory.
  static constexpr std::size_t kBlock = 8;

  // Precomputes for this rest pose. Null when the arena is measuring or full, or there are no control points. `thin`, for
  // affine only: where the roundness of the control points' weighted spread (determinant over squared trace: 0 collinear,
  // 1/4 round) is less, affine goes over into the similarity, and is it from an eighth of that on.
  static Mls* create(Arena& arena, std::span<const Vec2> vertices, std::span<const Vec2> controls, MlsKind kind,
                     float alpha, float thin = 0.0f);

  // controls.size() and out.size() are those of create.
  void deform(std::span<const Vec2> controls, std::span<Vec2> out) const;
  // The same without SIMD: what deform must match bit for bit.
  void deform_reference(std::span<const Vec2> controls, std::span<Vec2> out) const;

  std::size_t vertex_count() const { return vertex_count_; }
  std::size_t control_count() const { return control_count_; }

 private:
  // Sums over the control points, one lane per vertex of a block.
  struct Sums {
    float star_x[kBlock], star_y[kBlock];  // q* (rigid), or f(v) itself
    float turn_x[kBlock], turn_y[kBlock];  // F (rigid only)
  };
  std::size_t parts() const { return kind_ == MlsKind::rigid ? 3 : 2; }
  void precompute(std::size_t vertex, Vec2 v, std::span<const Vec2> controls, float alpha, std::span<double> weights);
  void store(std::size_t vertex, std::size_t control, double a, double b, double c);
  void sum_block(std::size_t block, std::span<const Vec2> controls, Sums& sums) const;
  void sum_block_reference(std::size_t block, std::span<const Vec2> controls, Sums& sums) const;
  void finish_block(std::size_t block, const Sums& sums, std::span<Vec2> out) const;

  MlsKind kind_ = MlsKind::rigid;
  float thin_ = 0.0f;
  std::size_t vertex_count_ = 0, control_count_ = 0;
  // [block][control][part][lane]; parts: u, Re c, Im c (rigid) or Re k, Im k.
  std::span<float> coefficients_;
  std::span<float> radius_;  // |v - p*|; rigid only
  std::span<Vec2> shift_;    // v - p* where the control points fix no rotation, else 0
};

}  // namespace nt
