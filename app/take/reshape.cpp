// SPDX-License-Identifier: Apache-2.0
#include "app/take/reshape.h"

#include <algorithm>
#include <cmath>

#include "app/take/property_group.h"
#include "core/base/det_math.h"
#include "core/motion/inbetween.h"
#include "platform/camera.h"

namespace nt {
namespace {

// How much of a change to first..last frame i takes: 1 inside, fading where the stretch does not end with the sequence.
float share(std::size_t i, std::size_t first, std::size_t last, std::size_t frames) {
  float part = 1;
  if (first > 0) part = std::min(part, static_cast<float>(i - first + 1) / kFadeFrames);
  if (last + 1 < frames) part = std::min(part, static_cast<float>(last - i + 1) / kFadeFrames);
  return part;
}

std::vector<MotionProperty> all_properties(const Motion& m) {
  std::vector<MotionProperty> all;
  for (const char* group : {"body", "fins", "path"})
    for (const MotionProperty property : properties_of(group))
      if (has(m, property)) all.push_back(property);
  return all;
}

// min sum (x - y)^2 + lambda sum (second difference of x)^2; the half-power period is 2 pi lambda^(1/4) frames.
// The matrix has five diagonals: L D L^T with two below the main one, e and f, in one pass; y becomes x.
void whittaker(std::vector<double>& y, double frames) {
  const std::size_t n = y.size();
  const double lambda = std::pow(frames / (2 * 3.14159265358979), 4);
  if (n < 3 || lambda <= 0) return;
  std::vector<double> d(n, 1.0), e(n, 0.0), f(n, 0.0);
  for (std::size_t i = 0; i + 2 < n; ++i) {
    d[i] += lambda, d[i + 1] += 4 * lambda, d[i + 2] += lambda;
    e[i] -= 2 * lambda, e[i + 1] -= 2 * lambda;
    f[i] += lambda;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (i >= 1) d[i] -= e[i - 1] * e[i - 1] * d[i - 1], e[i] -= f[i - 1] * e[i - 1] * d[i - 1];
    if (i >= 2) d[i] -= f[i - 2] * f[i - 2] * d[i - 2];
    e[i] /= d[i], f[i] /= d[i];
    if (i >= 1) y[i] -= e[i - 1] * y[i - 1];
    if (i >= 2) y[i] -= f[i - 2] * y[i - 2];
  }
  for (std::size_t i = n; i-- > 0;) {
    y[i] /= d[i];
    if (i + 1 < n) y[i] -= e[i] * y[i + 1];
    if (i + 2 < n) y[i] -= f[i] * y[i + 2];
  }
}

bool is_good(const Motion& m, float confidence) {
  const PoseConfidence& c = m.confidence;
  return m.status == PoseStatus::ok && std::min({c.head, c.tail, c.axis}) >= confidence;
}

}  // namespace

void smooth(std::vector<Motion>& m, MotionProperty u, std::size_t first, std::size_t last, double frames) {
  std::vector<double> x;
  for (const Motion& motion : m) x.push_back(value_of(motion, u));
  whittaker(x, frames);
  for (std::size_t i = first; i <= last; ++i) {
    const double y = value_of(m[i], u), part = share(i, first, last, m.size());
    set_value(m[i], u, static_cast<float>(y + part * (x[i] - y)));
  }
}

void exaggerate(std::vector<Motion>& m, MotionProperty u, float rest, std::size_t first, std::size_t last,
                float factor) {
  for (std::size_t i = first; i <= last; ++i) {
    const float part = share(i, first, last, m.size());
    set_value(m[i], u, rest + (1 + part * (factor - 1)) * (value_of(m[i], u) - rest));
  }
}

void repair(std::vector<Motion>& m, std::size_t first, std::size_t last, float confidence) {
  const std::vector<MotionProperty> all = all_properties(m.front());
  std::vector<std::size_t> good;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (is_good(m[i], confidence)) good.push_back(i);
  if (good.empty()) throw UserError("repair: no frame is as sure as that; ask for less confidence");
  for (std::size_t i = first; i <= last; ++i) {
    if (is_good(m[i], confidence)) continue;
    const auto next = std::lower_bound(good.begin(), good.end(), i);
    const std::size_t after = next == good.end() ? good.back() : *next;
    const std::size_t before = next == good.begin() ? good.front() : *(next - 1);
    const float t = after > before ? static_cast<float>(i - before) / static_cast<float>(after - before) : 0.0f;
    for (const MotionProperty u : all) {
      const float a = value_of(m[before], u), b = value_of(m[after], u);
      set_value(m[i], u, a + t * (b - a));
    }
    m[i].confidence = m[before].confidence;
  }
  for (std::size_t i = first; i <= last; ++i) m[i].status = PoseStatus::ok;
}

Seam make_loop(std::vector<Motion>& m, std::size_t first, std::size_t last, std::size_t blend) {
  const Motion next = m[std::min(last + 1, m.size() - 1)];
  m = std::vector<Motion>(m.begin() + static_cast<std::ptrdiff_t>(first),
                          m.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  const std::size_t frames = m.size();
  Seam seam;
  seam.drift_px = length(m.front().centre - next.centre);
  for (const MotionProperty u : all_properties(m.front())) {
    float jump = value_of(m.front(), u) - value_of(next, u);
    if (u.kind == MotionProperty::Kind::dir) jump = det::wrap(jump);  // full turns are no drift
    if (!u.is_path()) seam.angle_rad = std::max(seam.angle_rad, std::abs(static_cast<double>(jump)));
    // 0 at `start`, the whole jump one frame after the last: that is the first again.
    const std::size_t start = u.is_path() || blend + 1 >= frames ? 0 : frames - 1 - blend;
    for (std::size_t i = start; i < frames; ++i) {
      const float part = static_cast<float>(i - start) / static_cast<float>(frames - start);
      set_value(m[i], u, value_of(m[i], u) + part * jump);
    }
  }
  return seam;
}

void retime(std::vector<Motion>& m, double speed) {
  const auto last = static_cast<double>(m.size() - 1);
  std::vector<Motion> out;
  for (double at = 0; at <= last; at += speed) {
    const auto i = static_cast<std::size_t>(at);
    const auto t = static_cast<float>(at - static_cast<double>(i));
    out.push_back(i + 1 < m.size() && t > 0 ? in_between(m[i], m[i + 1], t) : m[i]);
    const auto passed = static_cast<double>(out.back().time_ns - m.front().time_ns);
    out.back().time_ns = m.front().time_ns + static_cast<int64_t>(passed / speed);
  }
  m = std::move(out);
}

}  // namespace nt
