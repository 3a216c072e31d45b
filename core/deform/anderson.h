// SPDX-License-Identifier: Apache-2.0
// Anderson mixing of a fixed-point iteration x <- x + f(x) that descends an energy, with bounded steps and a guard.
//
// Input, each iteration: x, the energy's negative gradient b and f = A^-1 b, `size` floats each (a multiple of 4, the tail 0),
// A positive definite and the same throughout. Output: the next x.
// Source: Anderson 1965, of the type I of Fang and Saad, "Two classes of multisecant methods for nonlinear acceleration", 2009: with the
// last m steps dX and what they changed, dB and dF, gamma solves dX^T (b - dB gamma) = 0, and x <- x + f - (dX + dF) gamma.
// On a quadratic energy that is the conjugate gradient method, preconditioned by A. The usual type II, which makes
// |f - dF gamma| least, is blind to what moves slowly: there f is a small part of what is still to go, and the whole error of a
// body is of that kind (measured: twice the distance from the converged pose, docs/PERFORMANCE.md).
// The small problem is solved by Cholesky in double, with a ridge of 1e-7 of each diagonal entry.
// Between two poses of least energy it is not positive, or asks for a step into the blue: then the last step is taken
// once more on top of f, which speeds up steadily where plain iterations crawl. So is a step of over kReach times the
// longest of those remembered.
// Guard (METHOD fact 6: noisy markers): if |f| after a mixed step is over kGrowth times what it was before it, the
// history is dropped and the step is taken back to the plain one of that time.
// Memory: 2 m + 1 vectors. Cost: m + 3 dot products and m + 2 additions of vectors an iteration.
#pragma once
#include <cstddef>
#include <span>

#include "core/base/arena.h"

namespace nt {

class Anderson {
 public:
  static constexpr int kWindow = 5;
  static constexpr double kReach = 2.0;
  static constexpr double kGrowth = 1.5;

  void create(Arena& arena, std::size_t size);
  // Forgets the history: another problem from here on.
  void restart();
  // Overwrites x with the next iterate. Returns |f|^2, by lanes, so the same everywhere.
  double mix(std::span<const float> b, std::span<const float> f, std::span<float> x);
  // x + f, and nothing is remembered. Returns |f|^2.
  double plain(std::span<const float> f, std::span<float> x);
  int guarded() const { return guarded_; }  // steps taken back since restart

 private:
  void take_back(std::span<float> x);
  void complete_pair(std::span<const float> b, std::span<const float> f);
  bool solve(double gamma[kWindow]) const;
  bool mixed_step(std::span<const float> f, std::span<float> step, double norm) const;

  std::span<float> delta_x_[kWindow], delta_f_[kWindow];
  std::span<float> last_f_;
  double gram_[kWindow][kWindow] = {};  // -dX^T dB
  double right_[kWindow] = {};          // -dX^T b
  double size_[kWindow] = {};           // |dx|^2
  int used_ = 0, newest_ = 0, guarded_ = 0;
  bool mixed_ = false;  // the last step was more than f
  double last_norm_ = 0.0;
};

}  // namespace nt
