// SPDX-License-Identifier: Apache-2.0
#include "app/export/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/temp_dir.h"

namespace nt {
namespace {

// Frame n is of one colour that tells n.
std::vector<uint8_t> flat_frame(int width, int height, int64_t n) {
  std::vector<uint8_t> rgb(static_cast<std::size_t>(width * height * 3));
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    rgb[i] = static_cast<uint8_t>(n % 256), rgb[i + 1] = static_cast<uint8_t>(n / 256), rgb[i + 2] = 77;
  }
  return rgb;
}

TEST(ContactSheet, ChoosesEvenlyWhateverTheLength) {
  for (const int64_t length : {1, 2, 11, 12, 13, 24, 25, 47, 100, 385, 2000}) {
    ContactSheet sheet(12);
    for (int64_t n = 0; n < length; ++n) sheet.add(flat_frame(4, 4, n), 4, 4);
    const std::vector<int64_t> chosen = sheet.chosen();
    ASSERT_EQ(static_cast<int64_t>(chosen.size()), std::min<int64_t>(length, 12)) << length;
    EXPECT_EQ(chosen.front(), 0);
    if (length == 1) continue;
    EXPECT_GE(chosen.back(), length - 1 - std::max<int64_t>(length / 12, 0)) << length;
    int64_t smallest = length, largest = 0;
    for (std::size_t i = 1; i < chosen.size(); ++i) {
      smallest = std::min(smallest, chosen[i] - chosen[i - 1]);
      largest = std::max(largest, chosen[i] - chosen[i - 1]);
    }
    EXPECT_GE(smallest, 1) << length;
    EXPECT_LE(largest, 2 * smallest) << length;
  }
}

TEST(ContactSheet, LaysTilesOutInOrder) {
  const TempDir dir;
  ContactSheet sheet(12);
  for (int64_t n = 0; n < 300; ++n) sheet.add(flat_frame(960, 540, n), 960, 540);
  sheet.write(dir / "sheet.png");
  const cv::Mat image = cv::imread(dir / "sheet.png");
  ASSERT_EQ(image.cols, 4 * 480 + 3 * 4);
  ASSERT_EQ(image.rows, 3 * 270 + 2 * 4);
  const std::vector<int64_t> chosen = sheet.chosen();
  for (int i = 0; i < 12; ++i) {
    const cv::Vec3b colour = image.at<cv::Vec3b>(i / 4 * 274 + 135, i % 4 * 484 + 240);
    EXPECT_EQ(colour[2] + 256 * colour[1], chosen[static_cast<std::size_t>(i)]) << i;
    EXPECT_EQ(colour[0], 77);
  }
}

TEST(ContactSheet, SmallFramesAreNotEnlarged) {
  const TempDir dir;
  ContactSheet sheet(4);
  for (int64_t n = 0; n < 3; ++n) sheet.add(flat_frame(100, 50, n), 100, 50);
  sheet.write(dir / "sheet.png");
  const cv::Mat image = cv::imread(dir / "sheet.png");
  EXPECT_EQ(image.size(), cv::Size(204, 104));
  EXPECT_EQ(image.at<cv::Vec3b>(80, 150), cv::Vec3b(255, 255, 255));  // the empty fourth place
}

TEST(ContactSheet, ErrorsAreOneLine) {
  const TempDir dir;
  ContactSheet sheet;
  EXPECT_EQ(user_error([&] { sheet.write(dir / "none.png"); }),
            "cannot write " + (dir / "none.png") + ": there was no frame to show");
  sheet.add(flat_frame(20, 20, 0), 20, 20);
  EXPECT_NE(user_error([&] { sheet.write(dir / "no/sheet.png"); }).find("there is no folder"), std::string::npos);
}

}  // namespace
}  // namespace nt
