// SPDX-License-Identifier: Apache-2.0
#include "app/marker.h"

#include <gtest/gtest.h>

#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace nt {
namespace {

cv::Mat tank_with_marker(double angle_deg, double side_px) {
  cv::Mat marker, picture(540, 960, CV_8U, cv::Scalar(120));
  cv::aruco::drawMarker(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11), 7, 200, marker, 1);
  cv::copyMakeBorder(marker, marker, 40, 40, 40, 40, cv::BORDER_CONSTANT, cv::Scalar(255));
  cv::Mat turn = cv::getRotationMatrix2D({139.5, 139.5}, angle_deg, side_px / 200);
  turn.at<double>(0, 2) += 300, turn.at<double>(1, 2) += 200;
  cv::warpAffine(marker, picture, turn, picture.size(), cv::INTER_AREA, cv::BORDER_TRANSPARENT);
  cv::Mat noise(picture.size(), CV_8U);
  cv::RNG(3).fill(noise, cv::RNG::NORMAL, 10, 3);
  return picture + noise - 10;
}

TEST(Marker, ItsSideIsRightToAHundredth) {
  for (const double side : {60.0, 130.0}) {
    for (const double angle : {0.0, 25.0}) {
      const cv::Mat picture = tank_with_marker(angle, side);
      const auto corners =
          find_marker({picture.data, picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step[0])});
      ASSERT_TRUE(corners.has_value()) << side << " " << angle;
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(length((*corners)[i] - (*corners)[(i + 1) % 4]), side, 0.01 * side + 0.5);
    }
  }
}

TEST(Marker, NoneIsNone) {
  const cv::Mat plain(300, 400, CV_8U, cv::Scalar(90));
  EXPECT_FALSE(
      find_marker({plain.data, plain.cols, plain.rows, static_cast<std::ptrdiff_t>(plain.step[0])}).has_value());
}

}  // namespace
}  // namespace nt
