// SPDX-License-Identifier: Apache-2.0
#include "app/take/thumbnail.h"

#include <algorithm>
#include <cstring>

#include "app/picture_copy.h"

namespace nt {
namespace {

constexpr std::size_t kHeader = 54;

void put(std::vector<uint8_t>& bytes, std::size_t at, uint32_t value, int size) {
  for (int i = 0; i < size; ++i) bytes[at + static_cast<std::size_t>(i)] = static_cast<uint8_t>(value >> (8 * i));
}

uint32_t get(const std::vector<uint8_t>& bytes, std::size_t at) {
  uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

std::size_t row_bytes(int width) { return (static_cast<std::size_t>(width) * 3 + 3) / 4 * 4; }

// The mean of channel k over columns x0..x1 and rows y0..y1, ends outside.
uint8_t mean(const Picture& picture, int x0, int x1, int y0, int y1, int k) {
  const int channels = channels_of(picture.format);
  int64_t sum = 0;
  for (int y = y0; y < y1; ++y) {
    const uint8_t* row = picture.pixels + static_cast<std::ptrdiff_t>(y) * picture.stride;
    for (int x = x0; x < x1; ++x) sum += row[x * channels + (channels == 1 ? 0 : k)];
  }
  return static_cast<uint8_t>(sum / ((x1 - x0) * (y1 - y0)));
}

}  // namespace

std::vector<uint8_t> thumbnail_bmp(const Picture& picture) {
  const int width = std::min(kThumbnailWidth, picture.width);
  const int height = std::max(1, width * picture.height / picture.width);
  std::vector<uint8_t> bytes(kHeader + row_bytes(width) * static_cast<std::size_t>(height));
  bytes[0] = 'B', bytes[1] = 'M';
  put(bytes, 2, static_cast<uint32_t>(bytes.size()), 4);
  put(bytes, 10, kHeader, 4), put(bytes, 14, 40, 4);
  put(bytes, 18, static_cast<uint32_t>(width), 4), put(bytes, 22, static_cast<uint32_t>(height), 4);
  put(bytes, 26, 1, 2), put(bytes, 28, 24, 2);
  for (int y = 0; y < height; ++y) {
    uint8_t* out = &bytes[kHeader + row_bytes(width) * static_cast<std::size_t>(height - 1 - y)];  // bottom up
    const int y0 = y * picture.height / height, y1 = std::max(y0 + 1, (y + 1) * picture.height / height);
    for (int x = 0; x < width; ++x) {
      const int x0 = x * picture.width / width, x1 = std::max(x0 + 1, (x + 1) * picture.width / width);
      for (int k = 0; k < 3; ++k) *out++ = mean(picture, x0, x1, y0, y1, 2 - k);  // blue first
    }
  }
  return bytes;
}

ThumbnailPixels thumbnail_pixels(const std::vector<uint8_t>& bmp) {
  if (bmp.size() < kHeader || get(bmp, 10) != kHeader) return {};
  const uint32_t width = get(bmp, 18), height = get(bmp, 22);
  if (width < 1 || width > kThumbnailWidth || height < 1 || height > 100 * kThumbnailWidth) return {};
  const std::size_t row = row_bytes(static_cast<int>(width));
  if (bmp.size() != kHeader + row * height) return {};
  ThumbnailPixels pixels{static_cast<int>(width), static_cast<int>(height), {}};
  for (std::size_t y = height; y-- > 0;) {
    const uint8_t* in = &bmp[kHeader + row * y];
    for (std::size_t x = 0; x < width; ++x, in += 3) pixels.rgb.insert(pixels.rgb.end(), {in[2], in[1], in[0]});
  }
  return pixels;
}

}  // namespace nt
