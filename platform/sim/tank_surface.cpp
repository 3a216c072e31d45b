// SPDX-License-Identifier: Apache-2.0
#include "core/base/det_math.h"
#include "platform/sim/tank_water.h"

namespace nt::tank {
namespace {

constexpr int kTile = 256;        // side of a tile, a power of two
constexpr float kCellPx = 46.0f;  // mesh of the network in a frame 960 wide
constexpr float kWavePx = 30.0f;  // length of a ripple there
constexpr int kOne = 1 << 14;

int wrap_tile(int v) { return v & (kTile - 1); }

// Distance from the edges of a Voronoi diagram of jittered points that repeats every `cells` cells.
std::vector<uint8_t> make_network(int cells, Random& random) {
  std::vector<Vec2> points;
  for (int i = 0; i < cells * cells; ++i) {
    const float x = random.unit();
    points.push_back({x, random.unit()});
  }
  std::vector<uint8_t> tile(static_cast<std::size_t>(kTile) * kTile);
  const float per_px = static_cast<float>(cells) / kTile;
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x) {
      const float fx = static_cast<float>(x) * per_px, fy = static_cast<float>(y) * per_px;
      const int cx = static_cast<int>(fx), cy = static_cast<int>(fy);
      float near_sq = 9.0f, next_sq = 9.0f;
      for (int j = cy - 1; j <= cy + 1; ++j)
        for (int i = cx - 1; i <= cx + 1; ++i) {
          const Vec2 p = points[static_cast<std::size_t>((j + cells) % cells) * cells + (i + cells) % cells];
          const float d = length_sq({static_cast<float>(i) + p.x - fx, static_cast<float>(j) + p.y - fy});
          if (d < near_sq) {
            next_sq = near_sq;
            near_sq = d;
          } else if (d < next_sq) {
            next_sq = d;
          }
        }
      const float edge = 1.0f - det::min(1.1f * (det::sqrt(next_sq) - det::sqrt(near_sq)), 1.0f);
      tile[static_cast<std::size_t>(y) * kTile + x] = static_cast<uint8_t>(255.0f * edge * edge + 0.5f);
    }
  return tile;
}

// Waves of nearly one length and direction, so that crests come in trains; about 128.
std::vector<uint8_t> make_ripples(int waves, Random& random) {
  struct Wave {
    float kx, ky, phase;
  } parts[4];
  for (int i = 0; i < 4; ++i)
    parts[i] = {static_cast<float>(max_int(waves - i / 2, 1)), static_cast<float>(waves / 2 + i - 1),
                det::kTwoPi * random.unit()};
  std::vector<uint8_t> tile(static_cast<std::size_t>(kTile) * kTile);
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x) {
      float sum = 0.0f;
      for (const Wave& wave : parts)
        sum += det::sin(det::kTwoPi / kTile * (wave.kx * static_cast<float>(x) + wave.ky * static_cast<float>(y)) +
                        wave.phase);
      tile[static_cast<std::size_t>(y) * kTile + x] = static_cast<uint8_t>(128.5f + 31.0f * sum);
    }
  return tile;
}

// How far a tile has slid, in whole pixels within the tile.
int slid(double t_s, float speed_px_s) {
  const double px = t_s * static_cast<double>(speed_px_s);
  return wrap_tile(static_cast<int>(static_cast<int64_t>(px < 0 ? px - 1 : px) & (kTile - 1)));
}

}  // namespace

const uint8_t* SurfaceLight::Tile::row(int y, double t_s) const {
  const int from = wrap_tile(y + slid(t_s, speed_px_s.y));
  return cells.data() + static_cast<std::size_t>(from) * stride + slid(t_s, speed_px_s.x);
}

SurfaceLight::Tile SurfaceLight::repeated(const std::vector<uint8_t>& cells, Vec2 speed_px_s, int width) const {
  Tile tile;
  tile.speed_px_s = speed_px_s;
  tile.stride = kTile + (width + 31) / 32 * 32;
  tile.cells.reserve(static_cast<std::size_t>(kTile) * tile.stride);
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < tile.stride; ++x)
      tile.cells.push_back(cells[static_cast<std::size_t>(y) * kTile + wrap_tile(x)]);
  return tile;
}

SurfaceLight::SurfaceLight(const TankScene& scene, uint64_t seed, int width)
    : caustics_(scene.caustics), ripples_(scene.ripples) {
  if (caustics_ <= 0 && ripples_ <= 0) return;
  Random random(seed ^ 0x57415445ull);
  const float unit_px = static_cast<float>(width) / 960.0f;
  const int meshes = clamp_int(static_cast<int>(kTile / (kCellPx * unit_px) + 0.5f), 2, 32);
  const int waves = clamp_int(static_cast<int>(kTile / (kWavePx * unit_px) + 0.5f), 2, 64);
  const std::vector<uint8_t> first = make_network(meshes, random), second = make_network(meshes, random);
  int64_t sum = 0;
  for (std::size_t i = 0; i < first.size(); ++i) sum += min_int(first[i], second[i]);
  mean_ = static_cast<int>(sum / static_cast<int64_t>(first.size()));
  network_[0] = repeated(first, Vec2{19.0f, 7.0f} * unit_px, width);
  network_[1] = repeated(second, Vec2{-13.0f, 11.0f} * unit_px, width);
  ripple_ = repeated(make_ripples(waves, random), Vec2{-62.0f, -31.0f} * unit_px, width);
}

void SurfaceLight::apply(double t_s, Canvas& canvas) const {
  if (network_[0].cells.empty()) return;
  const int network = static_cast<int>(caustics_ * kOne / 255.0f + 0.5f);
  const int ripple = static_cast<int>(ripples_ * kOne / 127.0f + 0.5f);
  const int base = kOne - network * mean_ - ripple * 128;
  for (int y = 0; y < canvas.height; ++y) {
    const uint8_t *a = network_[0].row(y, t_s), *b = network_[1].row(y, t_s), *c = ripple_.row(y, t_s);
    int16_t* light = canvas.row(y);
    for (int x = 0; x < canvas.stride; ++x) {
      const int mesh = a[x] < b[x] ? a[x] : b[x];
      light[x] = static_cast<int16_t>((light[x] * (base + network * mesh + ripple * c[x])) >> 14);
    }
  }
}

WallMirror::WallMirror(const TankScene& scene, int width)
    : strength_(scene.wall_mirror), depth_px_(static_cast<int>(scene.wall_depth * static_cast<float>(width))) {}

void WallMirror::apply(const std::vector<uint8_t>& fish_alpha, Canvas& canvas) const {
  if (strength_ <= 0) return;
  const int depth = min_int(depth_px_, canvas.height / 4);
  for (int y = 0; y < depth; ++y) mirror_row(y, 2 * depth - y, fish_alpha, canvas);
  const int last = canvas.height - 1;
  for (int y = 0; y < depth; ++y) mirror_row(last - y, last - (2 * depth - y), fish_alpha, canvas);
}

void WallMirror::mirror_row(int y, int from, const std::vector<uint8_t>& fish_alpha, Canvas& canvas) const {
  constexpr float kGlass = 0.72f;  // of the light comes back from the pane itself
  const int16_t* tank = canvas.row(from);
  const uint8_t* fish = fish_alpha.data() + static_cast<std::size_t>(y) * canvas.stride;
  int16_t* light = canvas.row(y);
  for (int x = 0; x < canvas.width; ++x) {
    if (fish[x] > 0) continue;
    const float pane = kGlass * static_cast<float>(light[x]);
    light[x] = static_cast<int16_t>(pane + strength_ * (static_cast<float>(tank[x]) - pane) + 0.5f);
  }
}

}  // namespace nt::tank
