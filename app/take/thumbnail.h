// SPDX-License-Identifier: Apache-2.0
// Small pictures of a take: what a list of takes shows.
//
// Camera picture (luma8 or rgb8) -> an uncompressed BMP (24 bits), kThumbnailWidth pixels wide, each pixel the mean of those it covers. BMP, so
// that recording needs no picture library (50 MB of memory) and every viewer opens it: 28 kB for 16:9.
#pragma once
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace nt {

inline constexpr int kThumbnailWidth = 128;

struct Thumbnail {
  int64_t frame = 0;
  std::vector<uint8_t> bmp;
};

std::vector<uint8_t> thumbnail_bmp(const Picture& picture);

struct ThumbnailPixels {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;  // rows top down, packed
};
// Of what thumbnail_bmp has made; without pixels where it is anything else.
ThumbnailPixels thumbnail_pixels(const std::vector<uint8_t>& bmp);

}  // namespace nt
