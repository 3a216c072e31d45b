// SPDX-License-Identifier: Apache-2.0
#include "core/segment/field.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr int kCellsX = 48, kCellsY = 32, kTerms = FieldSurface::kTerms;
using Cells = std::array<float, kCellsX * kCellsY>;

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

void cell_medians(LumaView luma, Cells& cells) {
  for (int j = 0; j < kCellsY; ++j) {
    const int y0 = j * luma.height / kCellsY, y1 = max_int((j + 1) * luma.height / kCellsY, y0 + 1);
    for (int i = 0; i < kCellsX; ++i) {
      const int x0 = i * luma.width / kCellsX, x1 = max_int((i + 1) * luma.width / kCellsX, x0 + 1);
      std::array<int, 256> histogram{};
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) ++histogram[luma.row(y)[x]];
      cells[static_cast<std::size_t>(j * kCellsX + i)] =
          static_cast<float>(percentile(histogram, (y1 - y0) * (x1 - x0), 0.5f));
    }
  }
}

}  // namespace

FieldSurface fit_field(LumaView luma) {
  Cells cells;
  cell_medians(luma, cells);
  std::array<int, 256> histogram{};
  for (float c : cells) ++histogram[static_cast<std::size_t>(c)];
  FieldSurface field;
  field.width = luma.width, field.height = luma.height;
  float(&coefficients)[kTerms] = field.coefficients;
  coefficients[0] = static_cast<float>(percentile(histogram, kCellsX * kCellsY, 0.5f));
  float terms[kTerms];
  for (float c = 64.0f; c > 4.0f; c *= 0.75f) {  // 10 rounds
    float a[kTerms][kTerms] = {}, b[kTerms] = {};
    for (int j = 0; j < kCellsY; ++j) {
      for (int i = 0; i < kCellsX; ++i) {
        basis((2.0f * static_cast<float>(i) + 1) / kCellsX - 1, (2.0f * static_cast<float>(j) + 1) / kCellsY - 1,
              terms);
        const float value = cells[static_cast<std::size_t>(j * kCellsX + i)];
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
  return field;
}

void FieldSurface::draw(int x0, int y, int count, uint8_t* out) const {
  const float v = (2.0f * static_cast<float>(y) + 1) / static_cast<float>(height) - 1;
  float terms[kTerms];
  for (int i = 0; i < count; ++i) {
    basis((2.0f * static_cast<float>(x0 + i) + 1) / static_cast<float>(width) - 1, v, terms);
    out[i] = static_cast<uint8_t>(det::clamp(value_of(coefficients, terms) + 0.5f, 0.0f, 255.0f));
  }
}

FieldResiduals measure_field(LumaView luma, const FieldSurface& surface) {
  FieldResiduals out;
  std::array<int, 256> levels{};
  for (int y = luma.height / 128; y < luma.height; y += max_int(luma.height / 64, 1)) {
    for (int x = luma.width / 128; x < luma.width; x += max_int(luma.width / 64, 1)) {
      uint8_t field = 0;
      surface.draw(x, y, 1, &field);
      const int diff = luma.row(y)[x] - field;
      ++out.residuals[static_cast<std::size_t>(diff < 0 ? -diff : diff)];
      ++levels[field];
      ++out.total;
    }
  }
  out.sigma = 0.5f + 1.4826f * static_cast<float>(percentile(out.residuals, out.total, 0.5f));
  out.median_level = percentile(levels, out.total, 0.5f);
  return out;
}

}  // namespace nt
