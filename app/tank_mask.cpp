// SPDX-License-Identifier: Apache-2.0
#include "app/tank_mask.h"

#include <cmath>
#include <fstream>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "app/export/pose_csv.h"
#include "platform/codecs.h"

namespace nt {
namespace {

cv::Mat inside_picture(const std::string& path, const CameraInfo& info) {
  // Looked at first: OpenCV has its own lines for a file that is not there.
  const cv::Mat picture = std::ifstream(path) ? codecs().read_picture(path, cv::IMREAD_GRAYSCALE) : cv::Mat();
  if (picture.empty())
    throw UserError("--tank: cannot read the picture " + path +
                    "; give corners X,Y X,Y X,Y or a picture that is black "
                    "outside of the tank");
  cv::Mat fitted;
  cv::resize(picture, fitted, {info.width, info.height}, 0, 0, cv::INTER_AREA);
  return fitted > 127;
}

cv::Mat inside_polygon(const std::vector<Vec2>& corners, const CameraInfo& info) {
  const float scale = static_cast<float>(info.source_width) / static_cast<float>(info.width);
  std::vector<cv::Point> polygon;
  for (const Vec2 corner : corners) {
    if (corner.x > static_cast<float>(info.source_width) || corner.y > static_cast<float>(info.source_height)) {
      throw UserError("--tank: a corner lies outside of " + info.name + ", which is " +
                          std::to_string(info.source_width) + "x" + std::to_string(info.source_height),
                      2);
    }
    const Vec2 at = to_working(corner, scale);
    polygon.emplace_back(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
  }
  cv::Mat inside = cv::Mat::zeros(info.height, info.width, CV_8U);
  cv::fillPoly(inside, std::vector<std::vector<cv::Point>>{polygon}, 255);
  return inside;
}

cv::Mat inside_roi(const RoiOption& roi, const CameraInfo& info) {
  const auto at = [](double share, int size) { return static_cast<int>(std::lround(share * size)); };
  const int x = at(roi.x, info.width), y = at(roi.y, info.height);
  const cv::Rect rect(x, y, at(roi.x + roi.width, info.width) - x, at(roi.y + roi.height, info.height) - y);
  cv::Mat inside = cv::Mat::zeros(info.height, info.width, CV_8U);
  inside(rect & cv::Rect(0, 0, info.width, info.height)) = 255;
  return inside;
}

}  // namespace

cv::Mat tank_mask(const AreaOptions& area, const CameraInfo& info) {
  if (area.everywhere()) return {};
  cv::Mat inside(info.height, info.width, CV_8U, cv::Scalar(255));
  if (area.roi) inside &= inside_roi(*area.roi, info);
  if (!area.polygon.empty()) inside &= inside_polygon(area.polygon, info);
  if (!area.picture.empty()) inside &= inside_picture(area.picture, info);
  if (cv::countNonZero(inside) == 0) {
    throw UserError(std::string(area.roi ? "--roi" : "--tank") + ": no pixel is left in which a fish could be", 2);
  }
  return inside;
}

}  // namespace nt
