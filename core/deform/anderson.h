// SPDX-License-Identifier: Apache-2.0
// Anderson mixing of a fixed-point iteration x <- g(x), with a guard on its residual.
//
// Input, each iteration: x and f = g(x) - x, `size` floats each (a multiple of 4, the tail 0). Output: the next x.
// Source: Anderson 1965 in the form of Walker and Ni, "Anderson acceleration for fixed-point iterations", 2011: with the
// last m differences dF, dG of f and g, gamma minimises |f - dF gamma|, and x <- g - dG gamma. The small problem goes
// through normal equations in double, each difference with a ridge of 1e-7 of its own square: one ridge for all would
// wipe out the late, small differences, which are the good ones.
// Guard (METHOD fact 6: noisy markers): if |f| after a mixed step is over kGrowth times what it was before it, the
// history is dropped and the step is taken back to the plain g of that time.
// Memory: 2 m + 2 vectors. Cost: m + 1 dot products and 2 m additions of vectors an iteration.
#pragma once
#include <cstddef>
#include <span>

#include "core/base/arena.h"

namespace nt {

class Anderson {
 public:
  static constexpr int kWindow = 5;
  static constexpr float kGrowth = 1.5f;

  void create(Arena& arena, std::size_t size);
  // Forgets the history: another problem from here on.
  void restart();
  // Overwrites x with the next iterate. Returns |f|^2, by lanes, so the same everywhere.
  double mix(std::span<const float> f, std::span<float> x);
  int guarded() const { return guarded_; }  // steps taken back since restart

 private:
  void remember(std::span<const float> f, std::span<const float> x);
  bool solve(double gamma[kWindow]) const;

  std::span<float> delta_f_[kWindow], delta_g_[kWindow];
  std::span<float> last_f_, last_g_;
  double gram_[kWindow][kWindow] = {};
  double right_[kWindow] = {};
  int used_ = 0, oldest_ = 0, guarded_ = 0;
  bool has_last_ = false, mixed_ = false;
  double last_norm_ = 0.0;
};

}  // namespace nt
