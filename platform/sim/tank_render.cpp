// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_render.h"

#include <algorithm>

#include "core/base/det_math.h"

namespace nt::tank {
namespace {

constexpr int kNoiseCells = 1 << 16;
constexpr float kFinAlpha = 0.55f;
constexpr float kFarApart = 0.3f;  // BL along the midline: beyond the reach of a neighbouring segment's cross-lines

int16_t to_sixteenths(float luma) { return static_cast<int16_t>(luma * 16.0f + 0.5f); }

// Close to a gaussian of sd 1: twelve uniform numbers less six.
float gaussian(Random& random) {
  float sum = -6.0f;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum;
}

Box intersect(const Box& a, const Box& b) {
  return {max_int(a.x0, b.x0), max_int(a.y0, b.y0), min_int(a.x1, b.x1), min_int(a.y1, b.y1)};
}

// How far a point of the body's coordinates lies outside the body; negative inside.
float beyond_body(float s, float n) {
  const float past_end = det::max(det::max(s - 1.0f, -s), 0.0f);
  return det::abs(n) + past_end - (past_end > 0.0f ? 0.0f : body_half_width(s));
}

}  // namespace

Renderer::Renderer(const TankScene& scene, uint64_t seed, int width, int height)
    : scene_(scene),
      random_(seed ^ 0x4e4f4953ull),
      width_(width),
      height_(height),
      stride_((width + 31) / 32 * 32),
      margin_(Hand::margin_px(scene, width, height)),
      surface_(scene, seed, width),
      drifters_(scene, seed, width, height),
      wall_(scene, width),
      lamps_(scene) {
  const auto falloff = [&](int n) {  // both axes together lose `vignette` in the corners
    std::vector<float> v(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const float r = (static_cast<float>(2 * i) - static_cast<float>(n - 1)) / static_cast<float>(n);
      v[i] = 0.5f - 0.5f * scene.vignette * r * r;
    }
    return v;
  };
  light_x_ = falloff(width);
  light_y_ = falloff(height);
  const int wide = width + 2 * margin_, high = height + 2 * margin_;
  const std::vector<float> gravel = make_gravel(wide, high, scene.gravel_luma, scene.gravel_sd, seed);
  gravel_ = {wide, high, (wide + 31) / 32 * 32, {}};
  gravel_.light.assign(static_cast<std::size_t>(gravel_.stride) * high, 0);
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x)
      gravel_.row(y)[x] =
          to_sixteenths(det::clamp(gravel[static_cast<std::size_t>(y) * wide + x], 0.0f, 255.0f) *
                        light(clamp_int(x - margin_, 0, width - 1), clamp_int(y - margin_, 0, height - 1)));
  if (margin_ > 0) {
    gravel_pairs_.assign(gravel_.light.size(), 0);
    for (std::size_t i = 0, below = static_cast<std::size_t>(gravel_.stride); below < gravel_.light.size();
         ++i, ++below)
      gravel_pairs_[i] = static_cast<uint32_t>(gravel_.light[i]) | static_cast<uint32_t>(gravel_.light[below]) << 16;
  }
  work_ = {width, height, stride_, std::vector<int16_t>(static_cast<std::size_t>(stride_) * height)};
  noise_.resize(kNoiseCells + static_cast<std::size_t>(stride_));
  for (int i = 0; i < kNoiseCells; ++i) {
    const float v = gaussian(random_) * scene.noise_sd * 16.0f;
    noise_[i] = static_cast<int16_t>(v < 0 ? v - 0.5f : v + 0.5f);
  }
  std::copy_n(noise_.begin(), stride_, noise_.begin() + kNoiseCells);  // a row may start anywhere
  luma_.assign(work_.light.size(), 0);
  skin_ = make_skin(scene);
}

LumaView Renderer::render(std::span<const FishShape> fish, double t_s, const Similarity& frame_from_tank) {
  lay_gravel(frame_from_tank);
  fish_alpha_.assign(work_.light.size(), 0);
  for (const FishShape& shape : fish) draw_shadow(shape);
  for (const FishShape& shape : fish) draw_fish(shape);
  surface_.apply(t_s, work_);
  wall_.apply(fish_alpha_, work_);
  drifters_.draw(t_s, work_);
  lamps_.apply(t_s, work_);
  add_noise();
  rgb_ready_ = false;
  return {luma_.data(), width_, height_, stride_};
}

// Bilinear, in sixteenths of a pixel, so that a pixel and the one below it are weighted in the halves of one word;
// coordinates run along the row in 16.16 fixed point.
void Renderer::lay_gravel(const Similarity& frame_from_tank) {
  if (margin_ == 0) {
    work_.light = gravel_.light;
    return;
  }
  constexpr float kOne = 65536.0f;
  const Similarity back = frame_from_tank.inverse();
  const Vec2 step = back.turned({1.0f, 0.0f});
  const int step_x = static_cast<int>(step.x * kOne), step_y = static_cast<int>(step.y * kOne);
  const auto margin = static_cast<float>(margin_);
  const uint32_t* pairs = gravel_pairs_.data();
  for (int y = 0; y < height_; ++y) {
    const Vec2 from = back({0.0f, static_cast<float>(y)}) + Vec2{margin, margin};
    int u = static_cast<int>(from.x * kOne), v = static_cast<int>(from.y * kOne);
    int16_t* work = work_.row(y);
    for (int x = 0; x < width_; ++x, u += step_x, v += step_y) {
      const uint32_t* pair = pairs + (v >> 16) * gravel_.stride + (u >> 16);
      const auto fu = static_cast<uint32_t>(u >> 12) & 15u, fv = static_cast<uint32_t>(v >> 12) & 15u;
      const uint32_t both = pair[0] * (16u - fu) + pair[1] * fu;
      work[x] = static_cast<int16_t>(((both & 0xffffu) * (16u - fv) + (both >> 16) * fv + 128u) >> 8);
    }
  }
}

// At half size: a soft edge needs no more.
void Renderer::draw_shadow(const FishShape& shape) {
  const Vec2 shift = Vec2{scene_.shadow_x_bl, scene_.shadow_y_bl} * shape.length_px;
  const float sd = 0.5f * scene_.shadow_soft_bl * shape.length_px;
  int radius = 0;
  while (static_cast<float>(radius * (radius + 1)) < sd * sd) ++radius;
  std::vector<Vec2> half;
  for (Vec2 p : shape.contour) half.push_back((p + shift) * 0.5f);
  const Box box = box_of(half, 3 * radius + 1);
  const Box seen = intersect({2 * box.x0, 2 * box.y0, 2 * box.x1, 2 * box.y1}, {0, 0, width_, height_});
  if (seen.empty() || scene_.shadow_strength <= 0) return;
  shadow_.start(box, 2.0f);
  shadow_.add(shape.contour, shift);
  shadow_.finish();
  shadow_.blur(radius);
  for (int y = seen.y0; y < seen.y1; ++y) {
    // Pixel 2i lies a quarter of a cell before the centre of cell i, pixel 2i + 1 a quarter after.
    const int cy = y >> 1, ny = clamp_int(cy + ((y & 1) != 0 ? 1 : -1), box.y0, box.y1 - 1);
    const float *near_row = shadow_.row(cy), *next_row = shadow_.row(ny);
    int16_t* work = work_.row(y);
    for (int x = seen.x0; x < seen.x1; ++x) {
      const int cx = (x >> 1) - box.x0, nx = clamp_int(cx + ((x & 1) != 0 ? 1 : -1), 0, box.width() - 1);
      const float a = 0.75f * near_row[cx] + 0.25f * near_row[nx];
      const float b = 0.75f * next_row[cx] + 0.25f * next_row[nx];
      if (a + b <= 0.0f) continue;
      const float lit = 1.0f - scene_.shadow_strength * (0.75f * a + 0.25f * b);
      work[x] = static_cast<int16_t>(static_cast<float>(work[x]) * lit + 0.5f);
    }
  }
}

void Renderer::draw_fish(const FishShape& shape) {
  fish_box_ = box_of(shape.contour, 1);
  const Box seen = intersect(fish_box_, {0, 0, width_, height_});
  if (seen.empty()) return;
  for (int side : {kLeft, kRight}) {
    fins_[side].start(box_of(shape.fin[side].polygon, 1));
    fins_[side].add(shape.fin[side].polygon);
    fins_[side].finish();
  }
  body_.start(fish_box_);
  body_.add(shape.body);
  body_.finish();
  map_skin(shape);
  for (int y = seen.y0; y < seen.y1; ++y) blend_row(shape, y, seen.x0, seen.x1);
}

void Renderer::map_skin(const FishShape& shape) {
  const auto cells = static_cast<std::size_t>(fish_box_.width()) * fish_box_.height();
  map_.assign(cells, {});
  for (int step = 0; step + 1 < kSpinePoints; ++step) map_skin_segment(shape, step);
}

// Body coordinates of the pixels between the cross-lines of two spine points.
void Renderer::map_skin_segment(const FishShape& shape, int step) {
  const Vec2 a = shape.spine[step], b = shape.spine[step + 1], na = shape.normal[step], nb = shape.normal[step + 1];
  const float reach = kSkinHalfWidth * shape.length_px;
  const Vec2 corners[4] = {a - na * reach, a + na * reach, b + nb * reach, b - nb * reach};
  const Box box = intersect(box_of(corners, 0), fish_box_);
  const Vec2 middle = normalised(na + nb);
  const float per_px = 1.0f / shape.length_px;
  for (int y = box.y0; y < box.y1; ++y) {
    // The pixels of this row within the quadrilateral: from the least to the greatest crossing of its edges.
    float x_lo = 1e9f, x_hi = -1e9f;
    const float fy = static_cast<float>(y);
    for (int i = 0; i < 4; ++i) {
      const Vec2 p = corners[i], q = corners[(i + 1) & 3];
      const float y_lo = det::min(p.y, q.y) - 0.5f, y_hi = det::max(p.y, q.y) + 0.5f;
      if (fy < y_lo || fy > y_hi) continue;
      const float t = p.y == q.y ? 0.0f : det::clamp((fy - p.y) / (q.y - p.y), 0.0f, 1.0f);
      const float x = p.x + (q.x - p.x) * t;
      x_lo = det::min(x_lo, x);
      x_hi = det::max(x_hi, x);
    }
    if (x_lo > x_hi) continue;
    const int from = max_int(box.x0, static_cast<int>(det::max(x_lo, -30000.0f)) - 1);
    const int to = min_int(box.x1, static_cast<int>(det::min(x_hi, 30000.0f)) + 3);
    for (int x = from; x < to; ++x) {
      const Vec2 p{static_cast<float>(x), fy};
      const float past_a = cross(p - a, na), before_b = cross(nb, p - b);
      if (past_a * before_b < 0.0f) continue;
      const float whole = past_a + before_b;
      const float t = det::abs(whole) > 1e-6f ? past_a / whole : 0.0f;
      BodyPoint& cell = map_[static_cast<std::size_t>(y - fish_box_.y0) * fish_box_.width() + (x - fish_box_.x0)];
      const BodyPoint here{(static_cast<float>(step - kSpineBefore) + t) * (1.0f / kSpineSteps),
                           dot(p - lerp(a, b, t), middle) * per_px};
      // Of two far parts of a fish closed to a ring, the one in which it lies deeper.
      if (cell.mapped && here.s - cell.s > kFarApart && beyond_body(cell.s, cell.n) < beyond_body(here.s, here.n))
        continue;
      cell = here;
      cell.mapped = true;
    }
  }
}

void Renderer::blend_row(const FishShape& shape, int y, int x0, int x1) {
  int16_t* work = work_.row(y);
  const auto base = static_cast<std::size_t>(y - fish_box_.y0) * fish_box_.width();
  const float* body_row = body_.row(y);
  const Coverage &left = fins_[kLeft], &right = fins_[kRight];
  for (int x = x0; x < x1; ++x) {
    const std::size_t cell = base + (x - fish_box_.x0);
    const float body = body_row[x - fish_box_.x0];
    const float on_fin[2] = {left.at(x, y), right.at(x, y)};
    if (body + on_fin[kLeft] + on_fin[kRight] <= 0.0f) continue;
    float seen = static_cast<float>(work[x]);
    uint8_t& fish = fish_alpha_[static_cast<std::size_t>(y) * stride_ + x];
    float through = 1.0f - static_cast<float>(fish) / 255.0f;  // of the gravel
    const float bright = light(x, y) * 16.0f;
    for (int side : {kLeft, kRight}) {
      const float cover = on_fin[side];
      if (cover <= 0.0f) continue;
      const float ray = fin_ray(Vec2{static_cast<float>(x), static_cast<float>(y)} - shape.fin[side].root,
                                shape.fin[side].tip - shape.fin[side].root);
      const float alpha = cover * (kFinAlpha + 0.18f * ray);
      seen += alpha * (scene_.body_luma * (0.98f + 0.10f * ray) * bright - seen);
      through *= 1.0f - alpha;
    }
    if (body > 0.0f) {
      const Skin skin = skin_at(skin_, map_[cell].s, map_[cell].n);
      const float alpha = body * skin.alpha;
      seen += alpha * (skin.luma * bright - seen);
      through *= 1.0f - alpha;
    }
    work[x] = static_cast<int16_t>(seen + 0.5f);
    fish = static_cast<uint8_t>(255.0f * (1.0f - through) + 0.5f);
  }
}

void Renderer::add_noise() {
  constexpr int kBlock = 16;  // a fixed count, so that the compiler makes it one vector operation after another
  for (int y = 0; y < height_; ++y) {
    const int16_t* noise = noise_.data() + random_.below(kNoiseCells);
    const int16_t* work = work_.row(y);
    uint8_t* out = luma_.data() + static_cast<std::size_t>(y) * stride_;
    for (int x = 0; x < stride_; x += kBlock) {
      int16_t v[kBlock];
      for (int i = 0; i < kBlock; ++i) v[i] = static_cast<int16_t>((work[x + i] + noise[x + i] + 8) >> 4);
      for (int i = 0; i < kBlock; ++i) v[i] = std::min<int16_t>(std::max<int16_t>(v[i], 0), 255);
      for (int i = 0; i < kBlock; ++i) out[x + i] = static_cast<uint8_t>(v[i]);
    }
  }
}

std::span<const uint8_t> Renderer::rgb() {
  if (rgb_ready_) return rgb_;
  static const Tints gravel_tint(0.055f, -0.075f), fish_tint(0.36f, -0.52f);
  rgb_.resize(static_cast<std::size_t>(width_) * height_ * 3);
  uint8_t* out = rgb_.data();
  for (int y = 0; y < height_; ++y) {
    const uint8_t* luma = luma_.data() + static_cast<std::size_t>(y) * stride_;
    const uint8_t* fish = fish_alpha_.data() + static_cast<std::size_t>(y) * stride_;
    for (int x = 0; x < width_; ++x, out += 3) {
      const int alpha = fish[x];
      for (int c = 0; c < 3; ++c) {
        const int tint = (gravel_tint.offset(luma[x], c) * (255 - alpha) + fish_tint.offset(luma[x], c) * alpha) / 255;
        out[c] = static_cast<uint8_t>(clamp_int(luma[x] + tint, 0, 255));
      }
    }
  }
  rgb_ready_ = true;
  return rgb_;
}

}  // namespace nt::tank
