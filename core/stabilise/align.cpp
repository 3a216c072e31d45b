// SPDX-License-Identifier: Apache-2.0
#include "core/stabilise/align.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr int kArea = Align::kSide * Align::kSide;
constexpr int kMostIterations = 8;
constexpr int kRounds = 3;             // of reweighting in an iteration
constexpr float kAgreement = 0.2f;     // small pixels
constexpr float kLeastSpread = 0.03f;  // small pixels: the noise of a block's displacement
// A block's gradients must add up to this, in both directions: one grey level a pixel, in squared sixteenths.
constexpr float kTexture = 256.0f * kArea;
constexpr float kOne = 65536.0f;
constexpr int kReach = 10;  // small pixels that a jolt may shift the picture
constexpr int kEvery = 3;   // of rows and columns that are compared in a search

// Gaussian elimination of four equations; the matrix is symmetric and, with a few blocks, positive definite.
bool solve4(double m[4][5], double out[4]) {
  for (int k = 0; k < 4; ++k) {
    if (!(m[k][k] > 1e-9)) return false;
    for (int i = k + 1; i < 4; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (int j = k; j < 5; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  for (int k = 3; k >= 0; --k) {
    double v = m[k][4];
    for (int j = k + 1; j < 4; ++j) v -= m[k][j] * out[j];
    out[k] = v / m[k][k];
  }
  return true;
}

float median(std::span<float> values) {
  const std::size_t half = values.size() / 2;
  std::size_t low = 0, high = values.size() - 1;
  while (low < high) {  // Hoare's selection
    const float pivot = values[(low + high) / 2];
    std::size_t i = low, j = high;
    while (true) {
      while (values[i] < pivot) ++i;
      while (values[j] > pivot) --j;
      if (i >= j) break;
      const float v = values[i];
      values[i++] = values[j], values[j--] = v;
    }
    if (half <= j) high = j;
    else low = j + 1;
  }
  return values[half];
}

}  // namespace

Align* Align::create(Arena& arena, int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const int across = max_int((width - 2) / kSide, 0), down = max_int((height - 2) / kSide, 0);
  const std::size_t count = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
  auto self = arena.take<Align>(1);
  auto reference = arena.take<uint16_t>(pixels);
  auto gradient_x = arena.take<int16_t>(count * kArea), gradient_y = arena.take<int16_t>(count * kArea);
  auto blocks = arena.take<Block>(count);
  auto sorted = arena.take<float>(count);
  if (self.empty() || (sorted.empty() && count > 0)) return nullptr;
  Align& align = self[0];
  align.width_ = width, align.height_ = height;
  align.blocks_x_ = across, align.blocks_y_ = down;
  align.first_x_ = 1 + (width - 2) % kSide / 2, align.first_y_ = 1 + (height - 2) % kSide / 2;
  align.reference_ = reference;
  align.gradient_x_ = gradient_x, align.gradient_y_ = gradient_y;
  align.blocks_ = blocks, align.sorted_ = sorted;
  return &align;
}

int Align::corner(int index, bool vertical) const {
  return vertical ? first_y_ + index / blocks_x_ * kSide : first_x_ + index % blocks_x_ * kSide;
}

void Align::set_reference(SmallView picture) {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) reference_[static_cast<std::size_t>(y * width_ + x)] = picture.row(y)[x];
  textured_ = 0;
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    Block& block = blocks_[n];
    block = {};
    const int x0 = corner(static_cast<int>(n), false), y0 = corner(static_cast<int>(n), true);
    block.x = static_cast<float>(x0) + 0.5f * (kSide - 1) - 0.5f * static_cast<float>(width_ - 1);
    block.y = static_cast<float>(y0) + 0.5f * (kSide - 1) - 0.5f * static_cast<float>(height_ - 1);
    int16_t* gx = gradient_x_.data() + n * kArea;
    int16_t* gy = gradient_y_.data() + n * kArea;
    int sum_x = 0, sum_y = 0;
    for (int i = 0; i < kArea; ++i) {
      const uint16_t* at = reference_.data() + (y0 + i / kSide) * width_ + x0 + i % kSide;
      gx[i] = static_cast<int16_t>((at[1] - at[-1]) / 2), gy[i] = static_cast<int16_t>((at[width_] - at[-width_]) / 2);
      sum_x += gx[i], sum_y += gy[i];
    }
    for (int i = 0; i < kArea; ++i) {
      gx[i] = static_cast<int16_t>(gx[i] - sum_x / kArea), gy[i] = static_cast<int16_t>(gy[i] - sum_y / kArea);
      block.xx += static_cast<float>(gx[i] * gx[i]);
      block.xy += static_cast<float>(gx[i] * gy[i]);
      block.yy += static_cast<float>(gy[i] * gy[i]);
    }
    block.textured = block.xx > kTexture && block.yy > kTexture;
    textured_ += block.textured;
  }
}

// What the block sees at t: samples of the picture, bilinear in fixed point, against the reference.
void Align::measure(Block& block, SmallView picture, const Similarity& t) const {
  const auto n = static_cast<std::size_t>(&block - blocks_.data());
  const int x0 = corner(static_cast<int>(n), false), y0 = corner(static_cast<int>(n), true);
  const Vec2 first{block.x - 0.5f * (kSide - 1), block.y - 0.5f * (kSide - 1)};
  const Vec2 middle{0.5f * static_cast<float>(width_ - 1), 0.5f * static_cast<float>(height_ - 1)};
  const float last = kSide - 1;
  block.in_view = true;
  for (const Vec2 at : {first, first + Vec2{last, 0}, first + Vec2{0, last}, first + Vec2{last, last}}) {
    const Vec2 p = t(at) + middle;
    block.in_view &= p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(width_ - 1) - 0.01f &&
                     p.y < static_cast<float>(height_ - 1) - 0.01f;
  }
  if (!block.in_view) return;
  const int step_u = static_cast<int>(static_cast<float>(t.a) * kOne);
  const int step_v = static_cast<int>(static_cast<float>(t.b) * kOne);
  const int16_t* gx = gradient_x_.data() + n * kArea;
  const int16_t* gy = gradient_y_.data() + n * kArea;
  int bx = 0, by = 0, sum = 0;
  int64_t squares = 0;
  for (int j = 0; j < kSide; ++j) {
    const Vec2 p = t(first + Vec2{0, static_cast<float>(j)}) + middle;
    int u = static_cast<int>(p.x * kOne), v = static_cast<int>(p.y * kOne);
    const uint16_t* was = reference_.data() + (y0 + j) * width_ + x0;
    for (int i = 0; i < kSide; ++i, u += step_u, v += step_v) {
      const uint16_t* at = picture.row(v >> 16) + (u >> 16);
      const uint16_t* below = at + picture.stride;
      const int fu = u >> 8 & 255, fv = v >> 8 & 255;
      const int top = at[0] * 256 + (at[1] - at[0]) * fu, bottom = below[0] * 256 + (below[1] - below[0]) * fu;
      const int now =
          static_cast<int>((static_cast<int64_t>(top) * 256 + static_cast<int64_t>(bottom - top) * fv + 32768) >> 16);
      const int difference = now - was[i];
      bx += difference * *gx++, by += difference * *gy++;
      sum += difference;
      squares += difference * difference;
    }
  }
  block.bx = static_cast<float>(bx), block.by = static_cast<float>(by);
  block.difference = static_cast<float>(squares - static_cast<int64_t>(sum) * sum / kArea);
}

void Align::look(SmallView picture, const Similarity& t) {
  for (Block& block : blocks_) {
    if (!block.textured) continue;
    measure(block, picture, t);
    // The ridge keeps a block with stripes from running along them.
    const float ridge = 0.25f * kTexture, xx = block.xx + ridge, yy = block.yy + ridge;
    const float per = 1.0f / (xx * yy - block.xy * block.xy);
    block.dx = (yy * block.bx - block.xy * block.by) * per;
    block.dy = (xx * block.by - block.xy * block.bx) * per;
    block.weight = block.in_view ? 1.0f : 0.0f;
  }
}

void Align::start_from_median(double step[4]) {
  std::size_t n = 0;
  for (const Block& block : blocks_)
    if (block.textured && block.in_view) sorted_[n++] = block.dx;
  step[0] = median(sorted_.first(n));
  n = 0;
  for (const Block& block : blocks_)
    if (block.textured && block.in_view) sorted_[n++] = block.dy;
  step[1] = median(sorted_.first(n));
  step[2] = step[3] = 0;
}

// Weights from how far each block's displacement lies from the fit, the median distance being ordinary.
void Align::weigh(const double step[4]) {
  const auto distance = [step](const Block& b) {
    const Vec2 fitted{static_cast<float>(step[0] + step[2] * b.x - step[3] * b.y),
                      static_cast<float>(step[1] + step[3] * b.x + step[2] * b.y)};
    return length(Vec2{b.dx, b.dy} - fitted);
  };
  std::size_t n = 0;
  for (const Block& block : blocks_)
    if (block.textured && block.in_view) sorted_[n++] = distance(block);
  const float usual = det::max(2.0f * median(sorted_.first(n)), kLeastSpread);
  for (Block& block : blocks_) {
    if (!block.textured || !block.in_view) continue;
    const float far = distance(block) / usual, part = 1.0f / (1.0f + far * far);
    block.weight = part * part;
  }
}

bool Align::solve(double step[4]) const {
  double m[4][5] = {};
  for (const Block& b : blocks_) {
    if (!b.textured || b.weight <= 0) continue;
    const double w = b.weight, x = b.x, y = b.y;
    // Displacement = J step, J = (1 0 x -y; 0 1 y x); the sum of J^T H J and of J^T b.
    const double rows[2][4] = {{1, 0, x, -y}, {0, 1, y, x}};
    const double h[2][2] = {{b.xx, b.xy}, {b.xy, b.yy}}, g[2] = {b.bx, b.by};
    for (int i = 0; i < 4; ++i) {
      const double left = w * (rows[0][i] * h[0][0] + rows[1][i] * h[1][0]);
      const double right = w * (rows[0][i] * h[0][1] + rows[1][i] * h[1][1]);
      for (int j = 0; j < 4; ++j) m[i][j] += left * rows[0][j] + right * rows[1][j];
      m[i][4] += w * (rows[0][i] * g[0] + rows[1][i] * g[1]);
    }
  }
  return solve4(m, step);
}

bool Align::fit(double step[4]) {
  start_from_median(step);
  for (int round = 0; round < kRounds; ++round) {
    weigh(step);
    if (!solve(step)) return false;
  }
  return true;
}

float Align::total_difference() const {
  float sum = 0;
  for (const Block& block : blocks_)
    if (block.textured && block.in_view) sum += block.weight * block.difference;
  return sum;
}

void Align::judge(Alignment& out) const {
  int agree = 0;
  for (const Block& block : blocks_)
    if (block.textured && block.in_view) agree += length_sq({block.dx, block.dy}) < kAgreement * kAgreement;
  out.agreeing = out.blocks > 0 ? static_cast<float>(agree) / static_cast<float>(out.blocks) : 0.0f;
}

Similarity Align::search(SmallView picture, const Similarity& start) const {
  const Vec2 middle{0.5f * static_cast<float>(width_ - 1), 0.5f * static_cast<float>(height_ - 1)};
  Similarity best = start;
  float least = 0;
  bool found = false;
  for (int dy = -kReach; dy <= kReach; ++dy)
    for (int dx = -kReach; dx <= kReach; ++dx) {
      Similarity t = start;
      t.x += dx, t.y += dy;
      // Differences of neighbours, so that light does not matter.
      int64_t sum = 0;
      int count = 0;
      for (int y = 1; y + 1 < height_; y += kEvery)
        for (int x = 1; x + 1 < width_; x += kEvery) {
          const Vec2 p = t(Vec2{static_cast<float>(x), static_cast<float>(y)} - middle) + middle;
          const int u = static_cast<int>(p.x + 0.5f), v = static_cast<int>(p.y + 0.5f);
          if (p.x < 0 || p.y < 0 || u + 1 >= width_ || v + 1 >= height_) continue;
          const uint16_t* was = reference_.data() + y * width_ + x;
          const uint16_t* now = picture.row(v) + u;
          const int across = (now[1] - now[0]) - (was[1] - was[0]);
          const int down = (now[picture.stride] - now[0]) - (was[width_] - was[0]);
          sum += (across < 0 ? -across : across) + (down < 0 ? -down : down);
          ++count;
        }
      const float mean = static_cast<float>(sum) / static_cast<float>(max_int(count, 1));
      if (count * kEvery * kEvery < width_ * height_ / 2 || (found && mean >= least)) continue;
      least = mean, best = t, found = true;
    }
  return best;
}

Alignment Align::find(SmallView picture, const Similarity& start, float close_enough) {
  Alignment out;
  out.seen_from_reference = start;
  const float reach_x = 0.5f * static_cast<float>(width_), reach_y = 0.5f * static_cast<float>(height_);
  float before = 0;
  for (int n = 0; n < kMostIterations; ++n) {
    look(picture, out.seen_from_reference);
    out.blocks = 0;
    for (const Block& block : blocks_) out.blocks += block.textured && block.in_view;
    double step[4];
    if (out.blocks < kFewestBlocks || !fit(step)) return out;
    if (n == 0) before = total_difference();
    out.left = before > 0 ? total_difference() / before : 1.0f;
    judge(out);
    const float turn = det::abs(static_cast<float>(step[2])) + det::abs(static_cast<float>(step[3]));
    const float moved =
        det::abs(static_cast<float>(step[0])) + det::abs(static_cast<float>(step[1])) + turn * (reach_x + reach_y);
    // The reference's point s is seen where s + J step was looked for.
    const Similarity moved_by{1.0 + step[2], step[3], step[0], step[1]};
    out.seen_from_reference = after(out.seen_from_reference, moved_by.inverse());
    if (moved < close_enough) break;
  }
  out.known = true;
  return out;
}

}  // namespace nt
