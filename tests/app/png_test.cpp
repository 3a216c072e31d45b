// SPDX-License-Identifier: Apache-2.0
#include "app/export/png.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/support/temp_dir.h"

namespace nt {
namespace {

TEST(Png, KeepsEveryFormatExactly) {
  const TempDir dir;
  const std::vector<uint8_t> bytes = {1, 2, 3, 4, 50, 60, 70, 80, 90, 100, 110, 120, 200, 210, 220, 230, 9, 9, 9, 9};
  const auto saved = [&](PixelFormat format, int width, int height, int stride) {
    Picture picture;
    picture.pixels = bytes.data();
    picture.width = width, picture.height = height, picture.stride = stride, picture.format = format;
    write_png(dir / "out.png", picture);
    return cv::imread(dir / "out.png", cv::IMREAD_UNCHANGED);
  };
  const cv::Mat grey = saved(PixelFormat::luma8, 3, 2, 10);
  ASSERT_EQ(grey.type(), CV_8UC1);
  EXPECT_EQ(grey.at<uint8_t>(1, 2), 200);
  const cv::Mat rgb = saved(PixelFormat::rgb8, 2, 2, 8);
  ASSERT_EQ(rgb.type(), CV_8UC3);
  EXPECT_EQ(rgb.at<cv::Vec3b>(1, 1), cv::Vec3b(210, 200, 120));
  const cv::Mat rgba = saved(PixelFormat::rgba8, 2, 2, 8);
  ASSERT_EQ(rgba.type(), CV_8UC4);
  EXPECT_EQ(rgba.at<cv::Vec4b>(0, 1), cv::Vec4b(70, 60, 50, 80));
}

TEST(Png, ErrorsAreOneLine) {
  const TempDir dir;
  const std::vector<uint8_t> grey(64 * 64, 8);
  Picture picture;
  EXPECT_NE(user_error([&] { write_png(dir / "out.png", picture); }).find("no picture"), std::string::npos);
  picture.pixels = grey.data();
  picture.width = picture.height = picture.stride = 64;
  EXPECT_NE(user_error([&] { write_png(dir / "no/out.png", picture); }).find("there is no folder"), std::string::npos);
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(user_error([&] { write_png("/dev/full", picture); }),
            "cannot write /dev/full: No space left on device; the picture is cut");
}

}  // namespace
}  // namespace nt
