// SPDX-License-Identifier: Apache-2.0
#include "core/segment/backlit.h"

#include "core/base/det_math.h"
#include "core/segment/difference.h"
#include "core/segment/noise.h"

namespace nt {
namespace {

constexpr int kTerms = 6;

// 1, u, v, u^2, uv, v^2 at u, v in [-1, 1].
void basis(float u, float v, float* out) {
  out[0] = 1, out[1] = u, out[2] = v, out[3] = u * u, out[4] = u * v, out[5] = v * v;
}

float value_of(const float* coefficients, const float* terms) {
  float sum = 0;
  for (int i = 0; i < kTerms; ++i) sum += coefficients[i] * terms[i];
  return sum;
}

// Cholesky solve of the 6 x 6 normal equations; a small ridge keeps them definite whatever the weights.
void solve_normal(float (&a)[kTerms][kTerms], float (&b)[kTerms]) {
  for (int i = 0; i < kTerms; ++i) a[i][i] += 1e-3f;
  for (int j = 0; j < kTerms; ++j) {
    for (int k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
    a[j][j] = det::sqrt(det::max(a[j][j], 1e-9f));
    for (int i = j + 1; i < kTerms; ++i) {
      for (int k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
      a[i][j] /= a[j][j];
    }
  }
  for (int i = 0; i < kTerms; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (int i = kTerms - 1; i >= 0; --i) {
    for (int k = i + 1; k < kTerms; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
}

int percentile(const std::array<int, 256>& histogram, int total, float share) {
  int below = 0;
  for (int v = 0; v < 256; ++v) {
    below += histogram[static_cast<std::size_t>(v)];
    if (static_cast<float>(below) >= share * static_cast<float>(total)) return v;
  }
  return 255;
}

}  // namespace

Backlit* Backlit::create(Arena& arena, const BackgroundSettings& settings, int width, int height) {
  const std::size_t stride = align_up(static_cast<std::size_t>(width));
  auto self = arena.take<Backlit>(1);
  auto plane = arena.take_raw<uint8_t>(stride * static_cast<std::size_t>(height));
  if (self.empty() || plane.empty()) return nullptr;
  Backlit& backlit = self[0];
  backlit.settings_ = settings;
  backlit.width_ = width, backlit.height_ = height, backlit.stride_ = static_cast<std::ptrdiff_t>(stride);
  backlit.plane_ = plane;
  return &backlit;
}

void Backlit::cell_medians(LumaView luma) {
  for (int j = 0; j < kCellsY; ++j) {
    const int y0 = j * height_ / kCellsY, y1 = max_int((j + 1) * height_ / kCellsY, y0 + 1);
    for (int i = 0; i < kCellsX; ++i) {
      const int x0 = i * width_ / kCellsX, x1 = max_int((i + 1) * width_ / kCellsX, x0 + 1);
      std::array<int, 256> histogram{};
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) ++histogram[luma.row(y)[x]];
      cells_[static_cast<std::size_t>(j * kCellsX + i)] =
          static_cast<float>(percentile(histogram, (y1 - y0) * (x1 - x0), 0.5f));
    }
  }
}

void Backlit::fit(LumaView luma) {
  cell_medians(luma);
  std::array<int, 256> histogram{};
  for (float c : cells_) ++histogram[static_cast<std::size_t>(c)];
  float coefficients[kTerms] = {static_cast<float>(percentile(histogram, kCellsX * kCellsY, 0.5f)), 0, 0, 0, 0, 0};
  float terms[kTerms];
  for (float c = 64.0f; c > 4.0f; c *= 0.75f) {  // 10 rounds
    float a[kTerms][kTerms] = {}, b[kTerms] = {};
    for (int j = 0; j < kCellsY; ++j) {
      for (int i = 0; i < kCellsX; ++i) {
        basis((2.0f * static_cast<float>(i) + 1) / kCellsX - 1, (2.0f * static_cast<float>(j) + 1) / kCellsY - 1,
              terms);
        const float value = cells_[static_cast<std::size_t>(j * kCellsX + i)];
        const float r = (value - value_of(coefficients, terms)) / c;
        const float w = 1.0f / (1.0f + r * r);
        for (int m = 0; m < kTerms; ++m) {
          b[m] += w * terms[m] * value;
          for (int n = 0; n <= m; ++n) a[m][n] += w * terms[m] * terms[n];
        }
      }
    }
    solve_normal(a, b);
    for (int m = 0; m < kTerms; ++m) coefficients[m] = b[m];
  }
  for (int y = 0; y < height_; ++y) {
    uint8_t* row = plane_.data() + y * stride_;
    const float v = (2.0f * static_cast<float>(y) + 1) / static_cast<float>(height_) - 1;
    for (int x = 0; x < width_; ++x) {
      basis((2.0f * static_cast<float>(x) + 1) / static_cast<float>(width_) - 1, v, terms);
      row[x] = static_cast<uint8_t>(det::clamp(value_of(coefficients, terms) + 0.5f, 0.0f, 255.0f));
    }
  }
}

// Roughness of the field and the thresholds that follow from it, over a grid of pixels.
void Backlit::measure(LumaView luma) {
  std::array<int, 256> residuals{}, levels{};
  int total = 0;
  for (int y = height_ / 128; y < height_; y += max_int(height_ / 64, 1)) {
    for (int x = width_ / 128; x < width_; x += max_int(width_ / 64, 1)) {
      const int field = plane_[static_cast<std::size_t>(y * stride_ + x)];
      const int diff = luma.row(y)[x] - field;
      ++residuals[static_cast<std::size_t>(diff < 0 ? -diff : diff)];
      ++levels[static_cast<std::size_t>(field)];
      ++total;
    }
  }
  // Half a level, because the plane is rounded to whole ones.
  sigma_ = 0.5f + 1.4826f * static_cast<float>(percentile(residuals, total, 0.5f));
  polarity_ = percentile(levels, total, 0.5f) > 127 ? -1 : 1;
  int inside = 0;
  for (int v = 0; v <= weak_threshold(sigma_); ++v) inside += residuals[static_cast<std::size_t>(v)];
  smooth_share_ = static_cast<float>(inside) / static_cast<float>(total);
}

bool Backlit::apply(LumaView luma, const BitMask* keep, const BitMask& foreground) {
  if (!started_) {
    fit(luma);
    measure(luma);
    started_ = true;
  }
  const int strong = settings_.radius > 0 ? settings_.radius : clamp_int(5 * weak_threshold(sigma_) / 2, 20, 90);
  mask_of_difference(luma, estimate(), strong, polarity_, foreground);
  follow_background(luma, foreground, keep, follow_limits(frames_++, weak_threshold(sigma_)),
                    {plane_.data(), width_, height_, stride_});
  return true;
}

void Backlit::absorb(LumaView luma, std::span<const Run> runs, int label) {
  copy_runs(luma, runs, label, {plane_.data(), width_, height_, stride_});
}

}  // namespace nt
