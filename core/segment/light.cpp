// SPDX-License-Identifier: Apache-2.0
#include "core/segment/light.h"

#include <bit>

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr float kJump = 0.05f;        // of the light: the models follow less by themselves
constexpr float kStep = 0.02f;        // smaller steps would only round back and forth
constexpr float kFollow = 1.0f / 64;  // a frame: how fast the models follow slow light by themselves, about
constexpr int kLeastLuma = 12;        // darker pixels are noise and offset
constexpr int kBinsPerOne = 256;      // of the histogram of factors, which reaches up to 8

constexpr float kAgree = 0.7f;        // share of the grid about its median ...
constexpr float kAlike = 0.25f;       // ... that must lie within this share of it: one factor for all
constexpr float kSettle = 1.0f / 16;  // a frame: of the unrest, and of the light without its flicker
constexpr int kBins = 8 * kBinsPerOne;

using Histogram = std::array<uint16_t, kBins>;

// Interpolated inside its bin; bin i covers [i - 0.5, i + 0.5).
float quantile(const Histogram& histogram, int total, float share) {
  const float wanted = share * static_cast<float>(total);
  int below = 0, bin = 0;
  while (static_cast<float>(below + histogram[static_cast<std::size_t>(bin)]) < wanted)
    below += histogram[static_cast<std::size_t>(bin++)];
  const float inside =
      (wanted - static_cast<float>(below)) / static_cast<float>(max_int(histogram[static_cast<std::size_t>(bin)], 1));
  return (static_cast<float>(bin) - 0.5f + inside) * (1.0f / kBinsPerOne);
}

std::array<uint8_t, 256> table_of(float factor, float rounding) {
  std::array<uint8_t, 256> table{};
  for (int v = 0; v < 256; ++v)
    table[static_cast<std::size_t>(v)] =
        static_cast<uint8_t>(det::min(static_cast<float>(v) * factor + rounding, 255.0f));
  return table;
}

}  // namespace

void Light::start(LumaView luma) {
  for (int j = 0; j < kRows; ++j) {
    const uint8_t* row = luma.row((2 * j + 1) * luma.height / (2 * kRows));
    for (int i = 0; i < kColumns; ++i) {
      const int v = row[(2 * i + 1) * luma.width / (2 * kColumns)];
      per_first_[static_cast<std::size_t>(j * kColumns + i)] = v < kLeastLuma ? 0.0f : 1.0f / static_cast<float>(v);
    }
  }
  model_ = kept_ = steady_ = 1.0f;
}

float Light::level(LumaView luma, bool& agreed) {
  Histogram histogram{};
  int total = 0, sum = 0;
  for (int j = 0; j < kRows; ++j) {
    const uint8_t* row = luma.row((2 * j + 1) * luma.height / (2 * kRows));
    for (int i = 0; i < kColumns; ++i) {
      const float per_first = per_first_[static_cast<std::size_t>(j * kColumns + i)];
      if (per_first == 0.0f) continue;
      const int v = row[(2 * i + 1) * luma.width / (2 * kColumns)];
      const int bin = static_cast<int>(static_cast<float>(v * kBinsPerOne) * per_first + 0.5f);
      ++histogram[static_cast<std::size_t>(min_int(bin, kBins - 1))];
      ++total, sum += v;
    }
  }
  agreed = false;
  if (2 * total < kColumns * kRows) return model_;  // too dark to tell
  const float middle = det::max(quantile(histogram, total, 0.5f), 0.02f);
  // Quartiles of a normal distribution lie 1.349 sigma apart; a ratio of two lumas strays as both do.
  const float spread = (quantile(histogram, total, 0.75f) - quantile(histogram, total, 0.25f)) / (1.349f * 1.41421356f);
  const float strays = spread / middle * static_cast<float>(sum) / static_cast<float>(total);
  unrest_ += (strays - unrest_) * (unrest_ == 0.0f ? 1.0f : kSettle);
  const float low = quantile(histogram, total, 0.5f * (1.0f - kAgree));
  const float high = quantile(histogram, total, 0.5f * (1.0f + kAgree));
  agreed = high - middle < kAlike * middle && middle - low < kAlike * middle;
  return middle;
}

Relight Light::update(LumaView luma, bool keeps_pixels) {
  bool agreed = false;
  const float now = level(luma, agreed);
  Relight relight;
  if (!agreed) return relight;
  if (det::abs(now - model_) > kJump * model_) {
    relight.all = now / model_;
    kept_ *= relight.all;
    model_ = now;
  } else {
    model_ += kFollow * (now - model_);
  }
  // What is kept follows the light as what is learned around it does, not its flicker.
  steady_ += relight.all != 1.0f ? now - steady_ : kSettle * (now - steady_);
  if (!keeps_pixels) {
    kept_ = steady_;
  } else if (det::abs(steady_ - kept_) > kStep * kept_) {
    constexpr float kRounding[] = {0.125f, 0.625f, 0.375f, 0.875f};
    relight.kept = steady_ / kept_;
    relight.rounding = kRounding[steps_++ & 3];
    kept_ = steady_;
  }
  return relight;
}

void scale_pixels(float factor, std::span<uint8_t> pixels) {
  const std::array<uint8_t, 256> table = table_of(factor, 0.5f);
  for (uint8_t& v : pixels) v = table[v];
}

void scale_pixels(float factor, float rounding, const BitMask& where, ImageView<uint8_t> plane) {
  const std::array<uint8_t, 256> table = table_of(factor, rounding);
  for (int y = 0; y < where.height; ++y) {
    uint8_t* row = plane.row(y);
    for (int i = 0; i < where.words_per_row; ++i) {
      for (uint64_t word = where.row(y)[i]; word != 0; word &= word - 1) {
        uint8_t& v = row[64 * i + std::countr_zero(word)];
        v = table[v];
      }
    }
  }
}

}  // namespace nt
