// SPDX-License-Identifier: Apache-2.0
// Small pictures and masks for tests of core's pixel stages, without OpenCV.
#pragma once
#include <cstdint>
#include <vector>

#include "core/base/arena.h"
#include "core/base/det_math.h"
#include "core/base/image_view.h"
#include "core/base/random.h"
#include "tests/support/block.h"

namespace nt::test {

class Picture {
 public:
  // Rows are exactly as long as `stride` says (0: the width), so that a sanitizer sees a read past the last pixel.
  Picture(int width, int height, int value = 0, int stride = 0)
      : width_(width),
        height_(height),
        stride_(stride > 0 ? stride : width),
        pixels_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height), static_cast<uint8_t>(value)) {}
  int width() const { return width_; }
  int height() const { return height_; }
  uint8_t& at(int x, int y) { return pixels_[static_cast<std::size_t>(y * stride_ + x)]; }
  uint8_t at(int x, int y) const { return pixels_[static_cast<std::size_t>(y * stride_ + x)]; }
  LumaView luma() const { return {pixels_.data(), width_, height_, stride_}; }
  ImageView<uint8_t> view() { return {pixels_.data(), width_, height_, stride_}; }

  // at(x, y) = f(x, y, at(x, y)), rounded and clamped.
  template <class F>
  Picture& each(F f) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        at(x, y) = static_cast<uint8_t>(det::clamp(static_cast<float>(f(x, y, at(x, y))) + 0.5f, 0.0f, 255.0f));
    return *this;
  }
  Picture& paint(const Box& box, int value) {
    return each(
        [&](int x, int y, int old) { return x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1 ? value : old; });
  }
  Picture& ellipse(float cx, float cy, float rx, float ry, int value) {
    return each([&](int x, int y, int old) {
      const float u = (static_cast<float>(x) - cx) / rx, v = (static_cast<float>(y) - cy) / ry;
      return u * u + v * v <= 1 ? value : old;
    });
  }
  // Nearly Gaussian: twelve uniform numbers a pixel.
  Picture& noise(Random& random, float sigma) {
    return each([&](int, int, int old) {
      float sum = -6;
      for (int i = 0; i < 12; ++i) sum += random.unit();
      return static_cast<float>(old) + sigma * sum;
    });
  }
  Picture& scatter(Random& random) {
    return each([&](int, int, int) { return static_cast<int>(random.below(256)); });
  }

 private:
  int width_, height_, stride_;
  std::vector<uint8_t> pixels_;
};

class Bits {
 public:
  Bits(int width, int height, bool all = false)
      : words_(static_cast<std::size_t>(words_for(width) * height)),
        mask_{words_.data(), width, height, words_for(width)} {
    if (all) paint({0, 0, width, height});
  }
  Bits(const Bits&) = delete;
  Bits& operator=(const Bits&) = delete;
  const BitMask& mask() const { return mask_; }
  Bits& paint(const Box& box) {
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x) mask_.set(x, y);
    return *this;
  }
  Bits& scatter(Random& random, uint32_t one_in) {
    for (int y = 0; y < mask_.height; ++y)
      for (int x = 0; x < mask_.width; ++x)
        if (random.below(one_in) == 0) mask_.set(x, y);
    return *this;
  }
  // Rubbish everywhere, past the width too: a stage must write whole words.
  Bits& soil() {
    for (uint64_t& w : words_) w = 0xdeadbeefdeadbeefull;
    return *this;
  }
  const std::vector<uint64_t>& words() const { return words_; }

 private:
  std::vector<uint64_t> words_;
  BitMask mask_;
};

inline int count_in(const BitMask& mask, const Box& box) {
  int n = 0;
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x) n += mask.at(x, y);
  return n;
}
inline int count_all(const BitMask& mask) { return count_in(mask, {0, 0, mask.width, mask.height}); }

inline bool clear_past_width(const BitMask& mask) {
  if (mask.width % 64 == 0) return true;
  for (int y = 0; y < mask.height; ++y)
    if (mask.row(y)[mask.words_per_row - 1] >> (mask.width % 64) != 0) return false;
  return true;
}

// Something that core cuts from an arena, with exactly the memory that it asked for. `make` takes an Arena&.
template <class Make>
class Made {
 public:
  explicit Made(Make make) : block_(measured(make)), arena_(block_.span()), made_(make(arena_)) {}
  auto* operator->() { return made_; }
  auto& operator*() { return *made_; }

 private:
  static std::size_t measured(Make& make) {
    Arena arena;
    (void)make(arena);
    return arena.used();
  }
  Block block_;
  Arena arena_;
  decltype(std::declval<Make&>()(std::declval<Arena&>())) made_;
};

}  // namespace nt::test
