// SPDX-License-Identifier: Apache-2.0
#include "core/base/det_math.h"
#include "platform/sim/tank_render.h"

namespace nt::tank {
namespace {

// Hash of a cell -> uniform [0, 1).
float cell_noise(int x, int y, uint32_t salt) {
  uint32_t v = static_cast<uint32_t>(x) * 0x9e3779b1u ^ static_cast<uint32_t>(y) * 0x85ebca6bu ^ salt;
  v = (v ^ (v >> 15)) * 0x2c1b3c6du;
  v = (v ^ (v >> 12)) * 0x297a2d39u;
  return static_cast<float>((v ^ (v >> 15)) >> 8) * (1.0f / 16777216.0f);
}

// One layer of pebbles: the nearest of jittered grid points gives the tone, its distance the shading of the stone.
void add_pebbles(std::vector<float>& out, int width, int height, float size_px, float weight, uint32_t salt) {
  for (int y = 0; y < height; ++y) {
    const float fy = static_cast<float>(y) / size_px;
    const int cy = static_cast<int>(fy);
    for (int x = 0; x < width; ++x) {
      const float fx = static_cast<float>(x) / size_px;
      const int cx = static_cast<int>(fx);
      float near_sq = 9.0f, next_sq = 9.0f, tone = 0.0f;
      for (int j = cy - 1; j <= cy + 1; ++j)
        for (int i = cx - 1; i <= cx + 1; ++i) {
          const float dx = static_cast<float>(i) + cell_noise(i, j, salt) - fx;
          const float dy = static_cast<float>(j) + cell_noise(i, j, salt + 1) - fy;
          const float d = dx * dx + dy * dy;
          if (d < near_sq) {
            next_sq = near_sq;
            near_sq = d;
            tone = cell_noise(i, j, salt + 2);
          } else if (d < next_sq) {
            next_sq = d;
          }
        }
      const float gap = det::min(2.5f * (det::sqrt(next_sq) - det::sqrt(near_sq)), 1.0f);  // 0 between two stones
      out[static_cast<std::size_t>(y) * width + x] += weight * (tone + 0.7f * gap);
    }
  }
}

}  // namespace

std::vector<float> make_gravel(int width, int height, float mean, float sd, uint64_t seed) {
  std::vector<float> gravel(static_cast<std::size_t>(width) * height, 0.0f);
  const float unit_px = static_cast<float>(width) / 960.0f;
  const auto salt = static_cast<uint32_t>(seed * 0x9e3779b97f4a7c15ull >> 32);
  add_pebbles(gravel, width, height, det::max(150.0f * unit_px, 4.0f), 0.8f, salt);
  add_pebbles(gravel, width, height, det::max(17.0f * unit_px, 2.5f), 1.0f, salt + 11);
  add_pebbles(gravel, width, height, det::max(6.0f * unit_px, 1.6f), 0.7f, salt + 29);
  double sum = 0, sum_sq = 0;
  for (float v : gravel) {
    sum += v;
    sum_sq += static_cast<double>(v) * v;
  }
  const double n = static_cast<double>(gravel.size()), m = sum / n;
  const auto scale = static_cast<float>(static_cast<double>(sd) / det::sqrt(sum_sq / n - m * m));
  for (float& v : gravel) v = mean + (v - static_cast<float>(m)) * scale;
  return gravel;
}

}  // namespace nt::tank
