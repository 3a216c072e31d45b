// SPDX-License-Identifier: Apache-2.0
#include "app/calibration.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include <opencv2/core.hpp>

#include "app/nearest_name.h"
#include "app/numbers.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr int kMostRounds = 50;
constexpr double kStandsStill = 1e-9;       // of the focal length
constexpr double kMostSlant = 1.15;         // longest side of the marker over the shortest
constexpr float kLeastScalePoints_px = 10;  // apart: a pixel's error is then 10 %
const std::vector<std::string> kNames = {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"};

double* field(Lens& lens, const std::string& name) {
  double* const fields[] = {&lens.fx, &lens.fy, &lens.cx, &lens.cy, &lens.k1, &lens.k2, &lens.p1, &lens.p2, &lens.k3};
  const auto at = std::find(kNames.begin(), kNames.end(), name);
  return at == kNames.end() ? nullptr : fields[at - kNames.begin()];
}

Lens read_lines(const std::string& path, std::istream& file) {
  Lens lens;
  std::map<std::string, bool> seen;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    std::replace(line.begin(), line.end(), ':', ' ');
    std::replace(line.begin(), line.end(), '=', ' ');
    std::istringstream words(line);
    std::string name, value, more;
    if (!(words >> name)) continue;
    const std::string where = "--lens " + path + ", line " + std::to_string(number) + ": ";
    double* to = field(lens, name);
    if (to == nullptr)
      throw UserError(where + "unknown '" + name + "'; did you mean '" + nearest_name(name, kNames) + "'?");
    if (!(words >> value) || words >> more) throw UserError(where + "one number must follow " + name);
    try {
      *to = parse_number(name, value, -1e6, 1e6);
    } catch (const UserError&) {
      throw UserError(where + "'" + value + "' is no number that " + name + " can be");
    }
    seen[name] = true;
  }
  for (const char* needed : {"fx", "fy", "cx", "cy"})
    if (!seen[needed]) throw UserError("--lens " + path + ": " + needed + " is missing");
  return lens;
}

bool is_opencv(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && (text[first] == '%' || text[first] == '<' || text[first] == '{');
}

Lens read_opencv(const std::string& path, const std::string& text, int width, int height) {
  const std::string file = "--lens " + path + ": ";
  try {
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    cv::Mat camera, distortion;
    storage["camera_matrix"] >> camera;
    storage["distortion_coefficients"] >> distortion;
    if (camera.rows != 3 || camera.cols != 3) throw UserError(file + "there is no 3x3 camera_matrix in it");
    if (distortion.total() > 5)
      throw UserError(file + "it has " + std::to_string(distortion.total()) +
                      " distortion coefficients; calibrate for the five k1 k2 p1 p2 k3");
    const int of_width = static_cast<int>(storage["image_width"].real());
    const int of_height = static_cast<int>(storage["image_height"].real());
    if (!storage["image_width"].empty() && (of_width != width || of_height != height))
      throw UserError(file + "it holds for pictures of " + std::to_string(of_width) + "x" + std::to_string(of_height) +
                      ", the video is " + std::to_string(width) + "x" + std::to_string(height));
    camera.convertTo(camera, CV_64F);
    distortion.convertTo(distortion, CV_64F);
    Lens lens{camera.at<double>(0, 0), camera.at<double>(1, 1), camera.at<double>(0, 2), camera.at<double>(1, 2)};
    double* const k[] = {&lens.k1, &lens.k2, &lens.p1, &lens.p2, &lens.k3};
    for (std::size_t i = 0; i < distortion.total(); ++i) *k[i] = distortion.ptr<double>()[i];
    return lens;
  } catch (const cv::Exception&) {
    throw UserError(file + "not a calibration file that can be read; write it with OpenCV or as lines `fx 900`");
  }
}

void check(const Lens& lens, const std::string& path, int width, int height) {
  const std::string file = "--lens " + path + ": ";
  if (!(lens.fx > 1 && lens.fy > 1)) throw UserError(file + "fx and fy must be above 1 pixel");
  // Corners must come back to where they were, or the model folds over inside the picture.
  const auto right = static_cast<float>(width - 1), bottom = static_cast<float>(height - 1);
  for (const Vec2 p : {Vec2{0, 0}, Vec2{right, 0}, Vec2{0, bottom}, Vec2{right, bottom}}) {
    const Vec2 back = lens.distorted(lens.undistorted(p));
    if (!(length(back - p) < 0.1f))
      throw UserError(
          file +
          "so strong a distortion cannot be undone at the picture's corners; check the numbers, and that they "
          "are for pictures of this size");
  }
}

}  // namespace

Vec2 Lens::distorted(Vec2 ideal) const {
  const double x = (ideal.x - cx) / fx, y = (ideal.y - cy) / fy, r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {static_cast<float>(cx + fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x))),
          static_cast<float>(cy + fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y))};
}

Vec2 Lens::undistorted(Vec2 seen) const {
  const double x0 = (seen.x - cx) / fx, y0 = (seen.y - cy) / fy;
  double x = x0, y = y0;
  for (int n = 0; n < kMostRounds; ++n) {
    const double r2 = x * x + y * y, radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double next_x = (x0 - (2 * p1 * x * y + p2 * (r2 + 2 * x * x))) / radial;
    const double next_y = (y0 - (p1 * (r2 + 2 * y * y) + 2 * p2 * x * y)) / radial;
    const double moved = std::abs(next_x - x) + std::abs(next_y - y);
    x = next_x, y = next_y;
    if (moved < kStandsStill) break;
  }
  return {static_cast<float>(cx + fx * x), static_cast<float>(cy + fy * y)};
}

Lens read_lens(const std::string& path, int width, int height) {
  std::ifstream file(path);
  if (!file) throw UserError("--lens " + path + ": no such file, or it may not be read");
  std::stringstream text;
  text << file.rdbuf();
  const Lens lens = is_opencv(text.str()) ? read_opencv(path, text.str(), width, height) : read_lines(path, text);
  check(lens, path, width, height);
  return lens;
}

bool far_enough(const ScalePoints& points) { return length(points.a - points.b) >= kLeastScalePoints_px; }

ScalePoints parse_scale_points(const std::string& text) {
  std::istringstream parts(text);
  std::vector<float> values;
  for (std::string part; std::getline(parts, part, ',');)
    values.push_back(static_cast<float>(parse_number("--scale-points", part, 0, 65535)));
  if (values.size() != 4)
    throw UserError("--scale-points must be X1,Y1,X2,Y2 in pixels of the source video, not '" + text + "'", 2);
  const ScalePoints points{{values[0], values[1]}, {values[2], values[3]}};
  if (!far_enough(points)) throw UserError("--scale-points: the two points must lie at least 10 pixels apart", 2);
  return points;
}

void Calibration::set_scale(const ScalePoints& points, double length_mm) {
  px_per_mm = length(ideal(points.a) - ideal(points.b)) / length_mm;
  scale_from = "two points";
}

void Calibration::set_scale(const std::array<Vec2, 4>& corners, double side_mm) {
  double sum = 0, longest = 0, shortest = 1e9;
  for (std::size_t i = 0; i < 4; ++i) {
    const double side = length(ideal(corners[i]) - ideal(corners[(i + 1) % 4]));
    sum += side, longest = std::max(longest, side), shortest = std::min(shortest, side);
  }
  if (longest > kMostSlant * shortest)
    throw UserError(
        "--marker-mm: the marker is seen at a slant, so one scale cannot hold; lay it flat on the ground under the "
        "camera");
  px_per_mm = sum / 4 / side_mm;
  scale_from = "marker";
}

}  // namespace nt
