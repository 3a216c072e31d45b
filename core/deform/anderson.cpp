// SPDX-License-Identifier: Apache-2.0
#include "core/deform/anderson.h"

#include "core/base/float4.h"

namespace nt {
namespace {

// Two vectors of lanes, added in a fixed order at the end.
double dot_of(std::span<const float> a, std::span<const float> b) {
  Float4 even = splat4(0.0f), odd = splat4(0.0f);
  std::size_t i = 0;
  for (; i + 8 <= a.size(); i += 8) {
    even += load4(&a[i]) * load4(&b[i]);
    odd += load4(&a[i + 4]) * load4(&b[i + 4]);
  }
  if (i < a.size()) even += load4(&a[i]) * load4(&b[i]);
  const Float4 sum = even + odd;
  return (static_cast<double>(sum[0]) + sum[1]) + (static_cast<double>(sum[2]) + sum[3]);
}

}  // namespace

void Anderson::create(Arena& arena, std::size_t size) {
  for (int k = 0; k < kWindow; ++k) {
    delta_x_[k] = arena.take<float>(size);
    delta_f_[k] = arena.take<float>(size);
  }
  last_f_ = arena.take<float>(size);
}

void Anderson::restart() { used_ = guarded_ = 0, mixed_ = false; }

double Anderson::plain(std::span<const float> f, std::span<float> x) {
  restart();
  for (std::size_t i = 0; i < f.size(); i += 4) store4(&x[i], load4(&x[i]) + load4(&f[i]));
  return dot_of(f, f);
}

// To the plain iterate of one step ago.
void Anderson::take_back(std::span<float> x) {
  const std::span<const float> dx = delta_x_[newest_];
  for (std::size_t i = 0; i < x.size(); i += 4) store4(&x[i], load4(&x[i]) - load4(&dx[i]) + load4(&last_f_[i]));
  used_ = 0, mixed_ = false;
  ++guarded_;
}

// What the newest step changed is known now. -dX^T dB is the change of -dX^T b, so it costs nothing.
void Anderson::complete_pair(std::span<const float> b, std::span<const float> f) {
  const std::span<float> df = delta_f_[newest_];
  for (std::size_t i = 0; i < f.size(); i += 4) store4(&df[i], load4(&f[i]) - load4(&last_f_[i]));
  for (int k = 0; k < used_; ++k) {
    const double right = -dot_of(delta_x_[k], b);
    gram_[k][newest_] = gram_[newest_][k] = right - right_[k];
    right_[k] = right;
  }
}

// Cholesky of the ridged Gram matrix; false if it is singular all the same.
bool Anderson::solve(double gamma[kWindow]) const {
  double l[kWindow][kWindow];
  for (int i = 0; i < used_; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = gram_[i][j] + (i == j ? 1e-7 * gram_[i][i] : 0.0);
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j && !(sum > 0.0)) return false;
      l[i][j] = i == j ? det::sqrt(sum) : sum / l[j][j];
    }
  }
  for (int i = 0; i < used_; ++i) {
    double sum = right_[i];
    for (int k = 0; k < i; ++k) sum -= l[i][k] * gamma[k];
    gamma[i] = sum / l[i][i];
  }
  for (int i = used_; i-- > 0;) {
    double sum = gamma[i];
    for (int k = i + 1; k < used_; ++k) sum -= l[k][i] * gamma[k];
    gamma[i] = sum / l[i][i];
  }
  return true;
}

// False, and no matter what, where there is none within reach. `step` may be the oldest pair's.
bool Anderson::mixed_step(std::span<const float> f, std::span<float> step, double norm) const {
  double gamma[kWindow], longest = norm;
  if (!solve(gamma)) return false;
  Float4 weight[kWindow];
  for (int k = 0; k < used_; ++k) {
    weight[k] = splat4(static_cast<float>(gamma[k]));
    longest = longest < size_[k] ? size_[k] : longest;
  }
  for (std::size_t i = 0; i < f.size(); i += 4) {
    Float4 sum = load4(&f[i]);
    for (int k = 0; k < used_; ++k) sum -= weight[k] * (load4(&delta_x_[k][i]) + load4(&delta_f_[k][i]));
    store4(&step[i], sum);
  }
  return dot_of(step, step) <= kReach * kReach * longest;
}

double Anderson::mix(std::span<const float> b, std::span<const float> f, std::span<float> x) {
  const double norm = dot_of(f, f);
  if (mixed_ && !(norm <= kGrowth * kGrowth * last_norm_)) {
    take_back(x);
    return norm;
  }
  if (used_ > 0) complete_pair(b, f);
  const int last = newest_;
  newest_ = used_ == 0 ? 0 : (last + 1) % kWindow;
  const std::span<float> step = delta_x_[newest_];
  mixed_ = used_ > 0;
  if (!mixed_) {
    for (std::size_t i = 0; i < f.size(); i += 4) store4(&step[i], load4(&f[i]));
  } else if (!mixed_step(f, step, norm)) {
    for (std::size_t i = 0; i < f.size(); i += 4) store4(&step[i], load4(&f[i]) + load4(&delta_x_[last][i]));
  }
  for (std::size_t i = 0; i < f.size(); i += 4) {
    const Float4 from = load4(&x[i]), to = from + load4(&step[i]);
    store4(&step[i], to - from);  // as rounded
    store4(&x[i], to);
    store4(&last_f_[i], load4(&f[i]));
  }
  used_ += used_ < kWindow;
  right_[newest_] = -dot_of(step, b);
  size_[newest_] = dot_of(step, step);
  last_norm_ = norm;
  return norm;
}

}  // namespace nt
