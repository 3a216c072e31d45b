// SPDX-License-Identifier: Apache-2.0
#include "app/clean_plate.h"

#include <algorithm>
#include <cstring>

#include <opencv2/core/mat.hpp>

#include "app/author/choose_background.h"
#include "app/picture_copy.h"
#include "core/segment/clean.h"

namespace nt {
namespace {

// Dilation steps, 7 pixels in all: a fish's rim, blurred by the lens, and its thin fins reach beyond the opened mask.
constexpr int kMargin[] = {1, 2, 4};
constexpr std::size_t kMostLearned = 15;

}  // namespace

CleanPlate::CleanPlate(int width, int height)
    : width_(width),
      height_(height),
      tank_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3),
      shown_(tank_.size()),
      known_(static_cast<std::size_t>(words_for(width)) * static_cast<std::size_t>(height)),
      hidden_(known_.size()),
      scratch_(known_.size()) {}

BitMask CleanPlate::view(std::vector<uint64_t>& words) { return {words.data(), width_, height_, words_for(width_)}; }

void CleanPlate::learn(Camera& camera) {
  std::vector<cv::Mat> pictures = spread_pictures(camera);
  if (pictures.size() < 3) return;
  const std::size_t count = std::min(pictures.size(), kMostLearned);
  for (std::size_t i = 0; i < count; ++i) pictures[i] = pictures[i * pictures.size() / count];
  channels_ = static_cast<std::size_t>(pictures[0].channels());
  uint8_t values[kMostLearned];
  for (int y = 0; y < height_; ++y) {
    const std::size_t row = static_cast<std::size_t>(width_) * channels_;
    for (std::size_t x = 0; x < row; ++x) {
      for (std::size_t i = 0; i < count; ++i) values[i] = pictures[i].ptr(y)[x];
      std::nth_element(values, values + count / 2, values + count);
      tank_[static_cast<std::size_t>(y) * row + x] = values[count / 2];
    }
  }
  std::fill(known_.begin(), known_.end(), ~uint64_t{0});
}

void CleanPlate::merge(const BitMask& first, const BitMask& second) {
  std::fill(hidden_.begin(), hidden_.end(), 0);
  for (const BitMask& mask : {first, second}) {
    if (mask.words == nullptr || mask.width != width_ || mask.height != height_) continue;
    for (int y = 0; y < height_; ++y) {
      for (int i = 0; i < mask.words_per_row; ++i) view(hidden_).row(y)[i] |= mask.row(y)[i];
    }
  }
  for (const int step : kMargin) {
    spread(view(hidden_), view(scratch_), step);
    hidden_.swap(scratch_);
  }
}

// 64 pixels of a row (fewer at its end): free ones are shown and learned, hidden ones show the tank.
void CleanPlate::take_word(const uint8_t* from, std::size_t at, int pixels, uint64_t hidden, uint64_t& known) {
  const std::size_t bytes = static_cast<std::size_t>(pixels) * channels_;
  uint8_t* tank = tank_.data() + at;
  uint8_t* shown = shown_.data() + at;
  if (hidden == 0 && known == ~uint64_t{0}) {
    for (std::size_t i = 0; i < bytes; ++i) tank[i] = static_cast<uint8_t>((3 * tank[i] + from[i] + 2) >> 2);
    std::memcpy(shown, from, bytes);
    return;
  }
  for (int x = 0; x < pixels; ++x) {
    const bool is_hidden = (hidden >> x & 1) != 0, is_known = (known >> x & 1) != 0;
    for (std::size_t i = static_cast<std::size_t>(x) * channels_; i < static_cast<std::size_t>(x + 1) * channels_;
         ++i) {
      if (!is_hidden) tank[i] = is_known ? static_cast<uint8_t>((3 * tank[i] + from[i] + 2) >> 2) : from[i];
      shown[i] = is_hidden ? tank[i] : from[i];
    }
  }
  known |= ~hidden;
}

// What was never free: blended between its neighbours in the row; a row without any takes the row above.
void CleanPlate::fill_unknown(int y) {
  const uint64_t* hidden = view(hidden_).row(y);
  const uint64_t* known = view(known_).row(y);
  const auto unknown = [&](int x) { return (hidden[x >> 6] & ~known[x >> 6]) >> (x & 63) & 1; };
  uint8_t* row = shown_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) * channels_;
  for (int x = 0; x < width_; ++x) {
    if ((x & 63) == 0 && (hidden[x >> 6] & ~known[x >> 6]) == 0) {
      x += 63;
      continue;
    }
    if (!unknown(x)) continue;
    int end = x + 1;
    while (end < width_ && unknown(end)) ++end;
    for (int at = x; at < end; ++at) {
      for (std::size_t c = 0; c < channels_; ++c) {
        const auto value = [&](int column) { return row[static_cast<std::size_t>(column) * channels_ + c]; };
        uint8_t& out = row[static_cast<std::size_t>(at) * channels_ + c];
        if (x == 0 && end == width_)
          out = y > 0 ? (&out)[-static_cast<std::ptrdiff_t>(channels_) * width_] : uint8_t{0};
        else if (x == 0) out = value(end);
        else if (end == width_) out = value(x - 1);
        else out = static_cast<uint8_t>((value(x - 1) * (end - at) + value(end) * (at - x + 1)) / (end - x + 1));
      }
    }
    x = end;
  }
}

void CleanPlate::update(const Picture& camera, const BitMask& first, const BitMask& second) {
  if (camera.width != width_ || camera.height != height_ || camera.format == PixelFormat::rgba8) return;
  if (const auto channels = static_cast<std::size_t>(channels_of(camera.format)); channels != channels_) {
    channels_ = channels;
    std::fill(known_.begin(), known_.end(), 0);
  }
  merge(first, second);
  for (int y = 0; y < height_; ++y) {
    const uint8_t* from = camera.pixels + static_cast<std::ptrdiff_t>(y) * camera.stride;
    for (int x = 0; x < width_; x += 64) {
      const std::size_t at =
          (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
      take_word(from + static_cast<std::size_t>(x) * channels_, at * channels_, std::min(64, width_ - x),
                view(hidden_).row(y)[x / 64], view(known_).row(y)[x / 64]);
    }
    fill_unknown(y);
  }
  picture_.pixels = shown_.data();
  picture_.width = width_, picture_.height = height_;
  picture_.stride = static_cast<int>(channels_) * width_;
  picture_.format = camera.format;
  ++picture_.revision;
}

}  // namespace nt
