// SPDX-License-Identifier: Apache-2.0
#include "core/deform/mls.h"

#include <hwy/highway.h>

#include "core/base/det_math.h"

namespace nt {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct Point {
  double x = 0, y = 0;
};

// A vertex nearer to a control point than this share of the control points' extent lies on it: beyond it 1/d^2 in
// double still has 4 good digits of weight for every other control point.
constexpr double kOnPoint = 1e-6;
// Below this share of the squared extent the weighted spread of the control points is taken for none.
constexpr double kNoSpread = 1e-18;
// Roundness (ratio of the determinant to the squared trace of the spread matrix) up to which control points are collinear.
constexpr double kCollinear = 1e-9;

double extent_sq(std::span<const Vec2> points) {
  Vec2 lo = points[0], hi = points[0];
  for (const Vec2 p : points) {
    lo = {det::min(lo.x, p.x), det::min(lo.y, p.y)};
    hi = {det::max(hi.x, p.x), det::max(hi.y, p.y)};
  }
  const double w = static_cast<double>(hi.x) - lo.x, h = static_cast<double>(hi.y) - lo.y;
  return w * w + h * h;
}

double clamp_unit(double v) { return v < 0.0 ? 0.0 : (v > 1.0 ? 1.0 : v); }

double distance_sq(Vec2 p, Vec2 v) {
  const double dx = static_cast<double>(p.x) - v.x, dy = static_cast<double>(p.y) - v.y;
  return dx * dx + dy * dy;
}

// u_i: weights that add up to 1. `out` has one per control point.
void normalised_weights(Vec2 v, std::span<const Vec2> controls, double extent2, float alpha, std::span<double> out) {
  double nearest = distance_sq(controls[0], v);
  for (const Vec2 p : controls) {
    const double d = distance_sq(p, v);
    nearest = d < nearest ? d : nearest;
  }
  const double on_point = kOnPoint * kOnPoint * extent2;
  double sum = 0;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const double d = distance_sq(controls[i], v);
    if (nearest <= on_point) {
      out[i] = d <= on_point ? 1.0 : 0.0;
    } else {
      const double ratio = nearest / d;  // in (0, 1]: no overflow whatever the unit
      out[i] = alpha == 1.0f ? ratio : static_cast<double>(det::exp(alpha * det::log(static_cast<float>(ratio))));
    }
    sum += out[i];
  }
  for (double& u : out) u /= sum;
}

// Weighted mean and second moments of the control points about it.
struct Spread {
  Point mean;
  double xx = 0, xy = 0, yy = 0;
  double total() const { return xx + yy; }
};

Spread spread_of(std::span<const Vec2> controls, std::span<const double> u) {
  Spread s;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    s.mean.x += u[i] * static_cast<double>(controls[i].x);
    s.mean.y += u[i] * static_cast<double>(controls[i].y);
  }
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const double x = static_cast<double>(controls[i].x) - s.mean.x, y = static_cast<double>(controls[i].y) - s.mean.y;
    s.xx += u[i] * x * x, s.xy += u[i] * x * y, s.yy += u[i] * y * y;
  }
  return s;
}

}  // namespace

Mls* Mls::create(Arena& arena, std::span<const Vec2> vertices, std::span<const Vec2> controls, MlsKind kind,
                 float alpha, float thin) {
  const std::size_t blocks = (vertices.size() + kBlock - 1) / kBlock;
  Mls layout;
  layout.kind_ = kind;
  layout.thin_ = thin;
  layout.vertex_count_ = vertices.size();
  layout.control_count_ = controls.size();
  const std::span<Mls> self = arena.take<Mls>(1);
  layout.coefficients_ = arena.take<float>(blocks * controls.size() * layout.parts() * kBlock);
  layout.radius_ = arena.take<float>(blocks * kBlock);
  layout.shift_ = arena.take<Vec2>(blocks * kBlock);
  const std::span<double> weights = arena.take<double>(controls.size());
  if (arena.measuring() || arena.full() || controls.empty()) return nullptr;
  self[0] = layout;
  for (std::size_t v = 0; v < vertices.size(); ++v) self[0].precompute(v, vertices[v], controls, alpha, weights);
  return &self[0];
}

void Mls::store(std::size_t vertex, std::size_t control, double a, double b, double c) {
  const std::size_t block = vertex / kBlock, lane = vertex % kBlock;
  float* at = coefficients_.data() + (block * control_count_ + control) * parts() * kBlock + lane;
  at[0] = static_cast<float>(a);
  at[kBlock] = static_cast<float>(b);
  if (kind_ == MlsKind::rigid) at[2 * kBlock] = static_cast<float>(c);
}

void Mls::precompute(std::size_t vertex, Vec2 v, std::span<const Vec2> controls, float alpha,
                     std::span<double> weights) {
  const double extent2 = extent_sq(controls);
  normalised_weights(v, controls, extent2, alpha, weights);
  const Spread s = spread_of(controls, weights);
  const Point d{static_cast<double>(v.x) - s.mean.x, static_cast<double>(v.y) - s.mean.y};
  const double d_len = det::sqrt(d.x * d.x + d.y * d.y);
  const bool no_spread = s.total() <= kNoSpread * extent2 || d_len == 0.0;
  const double det_spread = s.xx * s.yy - s.xy * s.xy;
  const double roundness = kind_ == MlsKind::affine && !no_spread ? det_spread / (s.total() * s.total()) : 0.0;
  const double from = kCollinear + 0.125 * static_cast<double>(thin_), to = 2 * kCollinear + static_cast<double>(thin_);
  const double share = clamp_unit((roundness - from) / (to - from));  // of affine, against similarity
  // Rigid: scaled so that |F| = 1 at rest.
  const double scale = no_spread ? 0.0 : 1.0 / (s.total() * (kind_ == MlsKind::rigid ? d_len : 1.0));
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const double u = weights[i];
    const Point p{static_cast<double>(controls[i].x) - s.mean.x, static_cast<double>(controls[i].y) - s.mean.y};
    double re = u * scale * (p.x * d.x + p.y * d.y);
    double im = u * scale * (p.x * d.y - p.y * d.x);
    if (share > 0.0) {
      const double a = (d.x * (s.yy * p.x - s.xy * p.y) + d.y * (s.xx * p.y - s.xy * p.x)) * u / det_spread;
      re += share * (a - re), im -= share * im;
    }
    if (kind_ == MlsKind::rigid) {
      store(vertex, i, u, re, im);
    } else {
      store(vertex, i, u + re, im, 0.0);
    }
  }
  radius_[vertex] = no_spread ? 0.0f : static_cast<float>(d_len);
  if (no_spread) shift_[vertex] = {static_cast<float>(d.x), static_cast<float>(d.y)};
}

void Mls::sum_block(std::size_t block, std::span<const Vec2> controls, Sums& sums) const {
  const hn::CappedTag<float, kBlock> tag;
  const std::size_t lanes = hn::Lanes(tag);
  const std::size_t step = parts() * kBlock;
  const float* first = coefficients_.data() + block * control_count_ * step;
  for (std::size_t lane = 0; lane < kBlock; lane += lanes) {
    auto sx = hn::Zero(tag), sy = hn::Zero(tag), tx = hn::Zero(tag), ty = hn::Zero(tag);
    const float* at = first + lane;
    for (std::size_t i = 0; i < control_count_; ++i, at += step) {
      const auto qx = hn::Set(tag, controls[i].x), qy = hn::Set(tag, controls[i].y);
      const auto a = hn::Load(tag, at), b = hn::Load(tag, at + kBlock);
      if (kind_ == MlsKind::rigid) {
        const auto c = hn::Load(tag, at + 2 * kBlock);
        sx = hn::Add(sx, hn::Mul(a, qx));
        sy = hn::Add(sy, hn::Mul(a, qy));
        tx = hn::Add(tx, hn::Sub(hn::Mul(b, qx), hn::Mul(c, qy)));
        ty = hn::Add(ty, hn::Add(hn::Mul(b, qy), hn::Mul(c, qx)));
      } else {
        sx = hn::Add(sx, hn::Sub(hn::Mul(a, qx), hn::Mul(b, qy)));
        sy = hn::Add(sy, hn::Add(hn::Mul(a, qy), hn::Mul(b, qx)));
      }
    }
    hn::StoreU(sx, tag, sums.star_x + lane);
    hn::StoreU(sy, tag, sums.star_y + lane);
    hn::StoreU(tx, tag, sums.turn_x + lane);
    hn::StoreU(ty, tag, sums.turn_y + lane);
  }
}

void Mls::sum_block_reference(std::size_t block, std::span<const Vec2> controls, Sums& sums) const {
  const std::size_t step = parts() * kBlock;
  const float* first = coefficients_.data() + block * control_count_ * step;
  for (std::size_t lane = 0; lane < kBlock; ++lane) {
    float sx = 0, sy = 0, tx = 0, ty = 0;
    const float* at = first + lane;
    for (const Vec2 q : controls) {
      if (kind_ == MlsKind::rigid) {
        sx = sx + at[0] * q.x;
        sy = sy + at[0] * q.y;
        tx = tx + (at[kBlock] * q.x - at[2 * kBlock] * q.y);
        ty = ty + (at[kBlock] * q.y + at[2 * kBlock] * q.x);
      } else {
        sx = sx + (at[0] * q.x - at[kBlock] * q.y);
        sy = sy + (at[0] * q.y + at[kBlock] * q.x);
      }
      at += step;
    }
    sums.star_x[lane] = sx, sums.star_y[lane] = sy, sums.turn_x[lane] = tx, sums.turn_y[lane] = ty;
  }
}

// Plain in both versions: one root and one division per vertex, which 32-bit NEON cannot round correctly.
void Mls::finish_block(std::size_t block, const Sums& sums, std::span<Vec2> out) const {
  const std::size_t first = block * kBlock;
  const std::size_t count = vertex_count_ - first < kBlock ? vertex_count_ - first : kBlock;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t v = first + lane;
    Vec2 at{sums.star_x[lane] + shift_[v].x, sums.star_y[lane] + shift_[v].y};
    if (kind_ == MlsKind::rigid) {
      const float norm_sq = sums.turn_x[lane] * sums.turn_x[lane] + sums.turn_y[lane] * sums.turn_y[lane];
      const float factor = norm_sq > 0.0f ? radius_[v] / det::sqrt(norm_sq) : 0.0f;
      at = {at.x + factor * sums.turn_x[lane], at.y + factor * sums.turn_y[lane]};
    }
    out[v] = at;
  }
}

void Mls::deform(std::span<const Vec2> controls, std::span<Vec2> out) const {
  Sums sums;
  for (std::size_t block = 0; block * kBlock < vertex_count_; ++block) {
    sum_block(block, controls, sums);
    finish_block(block, sums, out);
  }
}

void Mls::deform_reference(std::span<const Vec2> controls, std::span<Vec2> out) const {
  Sums sums;
  for (std::size_t block = 0; block * kBlock < vertex_count_; ++block) {
    sum_block_reference(block, controls, sums);
    finish_block(block, sums, out);
  }
}

}  // namespace nt
