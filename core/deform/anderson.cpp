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
    delta_f_[k] = arena.take<float>(size);
    delta_g_[k] = arena.take<float>(size);
  }
  last_f_ = arena.take<float>(size);
  last_g_ = arena.take<float>(size);
}

void Anderson::restart() { used_ = oldest_ = guarded_ = 0, has_last_ = mixed_ = false; }

// Puts the newest differences into the oldest place and brings the Gram matrix up to date.
void Anderson::remember(std::span<const float> f, std::span<const float> x) {
  const int slot = used_ < kWindow ? used_++ : oldest_;
  oldest_ = (slot + 1) % kWindow;
  float* df = delta_f_[slot].data();
  float* dg = delta_g_[slot].data();
  for (std::size_t i = 0; i < f.size(); i += 4) {
    const Float4 now = load4(&f[i]), change = now - load4(&last_f_[i]);
    store4(df + i, change);
    store4(dg + i, load4(&x[i]) + now - load4(&last_g_[i]));
  }
  for (int k = 0; k < used_; ++k) gram_[k][slot] = gram_[slot][k] = dot_of(delta_f_[k], delta_f_[slot]);
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

double Anderson::mix(std::span<const float> f, std::span<float> x) {
  const double norm = dot_of(f, f);
  if (mixed_ && !(norm <= kGrowth * kGrowth * last_norm_)) {
    for (std::size_t i = 0; i < f.size(); i += 4) store4(&x[i], load4(&last_g_[i]));
    used_ = oldest_ = 0, has_last_ = mixed_ = false;
    ++guarded_;
    return norm;
  }
  if (has_last_) remember(f, x);
  for (std::size_t i = 0; i < f.size(); i += 4) {
    const Float4 now = load4(&f[i]);
    store4(&last_f_[i], now);
    store4(&last_g_[i], load4(&x[i]) + now);
  }
  last_norm_ = norm;
  has_last_ = true;
  for (int k = 0; k < used_; ++k) right_[k] = dot_of(delta_f_[k], f);
  double gamma[kWindow];
  mixed_ = used_ > 0 && solve(gamma);
  Float4 weight[kWindow];
  for (int k = 0; k < used_ && mixed_; ++k) weight[k] = splat4(static_cast<float>(gamma[k]));
  for (std::size_t i = 0; i < f.size(); i += 4) {
    Float4 next = load4(&last_g_[i]);
    for (int k = 0; k < used_ && mixed_; ++k) next -= weight[k] * load4(&delta_g_[k][i]);
    store4(&x[i], next);
  }
  return norm;
}

}  // namespace nt
