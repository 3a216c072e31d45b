// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/jpeg_planes.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cstdlib>
#include <random>

namespace nt {
namespace {

constexpr int kWidth = 64, kHeight = 48;

std::vector<uint8_t> encoded(int subsampling) {
  std::vector<uint8_t> rgb(kWidth * kHeight * 3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      uint8_t* pixel = &rgb[static_cast<std::size_t>((y * kWidth + x) * 3)];
      pixel[0] = static_cast<uint8_t>(40 + 2 * x), pixel[1] = static_cast<uint8_t>(60 + 2 * y), pixel[2] = 90;
    }
  }
  const tjhandle coder = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  tjCompress2(coder, rgb.data(), kWidth, 0, kHeight, TJPF_RGB, &bytes, &size, subsampling, 95, 0);
  std::vector<uint8_t> jpeg(bytes, bytes + size);
  tjFree(bytes);
  tjDestroy(coder);
  return jpeg;
}

TEST(JpegPlanes, ReadsEverySubsamplingAsItIsCoded) {
  const struct {
    int subsampling, chroma_width, chroma_height;
  } cases[] = {{TJSAMP_420, 32, 24}, {TJSAMP_422, 32, 48}, {TJSAMP_444, 64, 48}, {TJSAMP_GRAY, 0, 0}};
  for (const auto& one : cases) {
    const std::unique_ptr<JpegPlanes> planes = open_jpeg_planes();
    ASSERT_TRUE(planes->decode(encoded(one.subsampling), kWidth, kHeight));
    EXPECT_EQ(planes->cb().width, one.chroma_width);
    EXPECT_EQ(planes->cr().height, one.chroma_height);
    for (int y = 0; y < kHeight; y += 7) {
      for (int x = 0; x < kWidth; x += 7) {
        const double exact = 0.299 * (40 + 2 * x) + 0.587 * (60 + 2 * y) + 0.114 * 90;
        EXPECT_NEAR(planes->luma().row(y)[x], exact, 4);
      }
    }
  }
}

TEST(JpegPlanes, ReadsPicturesWithoutHuffmanTables) {
  std::vector<uint8_t> jpeg = encoded(TJSAMP_422);
  for (std::size_t i = 2; i + 4 < jpeg.size() && jpeg[i + 1] != 0xda;) {  // up to the picture's own data
    const std::size_t length = 2 + (std::size_t{jpeg[i + 2]} << 8 | jpeg[i + 3]);
    if (jpeg[i + 1] == 0xc4)
      jpeg.erase(jpeg.begin() + static_cast<long>(i), jpeg.begin() + static_cast<long>(i + length));
    else i += length;
  }
  const std::unique_ptr<JpegPlanes> planes = open_jpeg_planes();
  EXPECT_TRUE(planes->decode(jpeg, kWidth, kHeight));
}

TEST(JpegPlanes, RefusesWhatIsDamagedAndReadsTheNextOne) {
  const std::vector<uint8_t> sound = encoded(TJSAMP_422);
  std::mt19937 random(1);
  const std::unique_ptr<JpegPlanes> planes = open_jpeg_planes();
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<uint8_t> bad = sound;
    if (i % 2 == 0) bad.resize(random() % sound.size());
    else
      for (int k = 0; k < 8; ++k) bad[random() % bad.size()] ^= static_cast<uint8_t>(1u << random() % 8);
    const bool read = planes->decode(bad, kWidth, kHeight);
    refused += !read;
    ASSERT_TRUE(planes->decode(sound, kWidth, kHeight)) << i;
  }
  EXPECT_GT(refused, 400);
  EXPECT_FALSE(planes->decode(sound, kWidth + 8, kHeight));
}

}  // namespace
}  // namespace nt
