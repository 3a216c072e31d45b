// SPDX-License-Identifier: Apache-2.0
// Bit-packed morphology against cv::erode, cv::dilate, cv::morphologyEx.
#include "core/segment/clean.h"

#include <gtest/gtest.h>

#include "tests/oracle/masks.h"

namespace {

using nt::test::OwnedMask;

cv::Mat square(int side) { return cv::getStructuringElement(cv::MORPH_RECT, {side, side}); }

void expect_same(const OwnedMask& ours, const cv::Mat& theirs, const std::string& what) {
  EXPECT_EQ(cv::countNonZero(ours.pixels() != theirs), 0) << what << ", " << theirs.size();
  EXPECT_TRUE(ours.bits_past_the_width_are_clear()) << what << ", " << theirs.size();
}

void compare(const cv::Mat& mask) {
  const OwnedMask from(mask);
  OwnedMask to(mask.cols, mask.rows);
  cv::Mat want;
  nt::erode3(from.view(), to.view());
  cv::erode(mask, want, square(3));
  expect_same(to, want, "erode3");
  nt::dilate3(from.view(), to.view());
  cv::dilate(mask, want, square(3));
  expect_same(to, want, "dilate3");
  for (const int side : {1, 3, 5, 7}) {
    OwnedMask opened(mask.cols, mask.rows);
    nt::open_mask(from.view(), to.view(), opened.view(), side);
    cv::morphologyEx(mask, want, cv::MORPH_OPEN, square(side));
    expect_same(opened, want, "opening by " + std::to_string(side));
  }
  EXPECT_EQ(nt::count_bits(from.view()), cv::countNonZero(mask));
}

}  // namespace

TEST(CleanOracle, NoiseOfEveryDensity) {
  cv::RNG rng(1);
  for (const cv::Size size : nt::test::mask_sizes()) {
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) compare(nt::test::noise_mask(size, share, rng));
  }
}

TEST(CleanOracle, Blobs) {
  cv::RNG rng(2);
  for (const cv::Size size : nt::test::mask_sizes()) {
    for (int i = 0; i < 10; ++i) compare(nt::test::blob_mask(size, 6, rng));
  }
}
