// SPDX-License-Identifier: Apache-2.0
#include "app/export/pose_table.h"

#include <cstdio>
#include <vector>

#include "app/export/pose_csv.h"

namespace nt {
namespace {

struct Point {
  std::string name;
  Vec2 at;
  float likelihood;
};

std::vector<Point> points_of(const FishPose& p) {
  const PoseConfidence c = p.ok() ? p.confidence : PoseConfidence{};
  std::vector<Point> points{{"head", p.head, c.head}};
  for (int i = p.u_num; i > 0; --i) points.push_back({"up_axis_" + std::to_string(i), p.up_axis[i - 1], c.axis});
  points.push_back({"centre", p.centre, c.centre});
  for (int i = 1; i <= p.l_num; ++i) points.push_back({"low_axis_" + std::to_string(i), p.low_axis[i - 1], c.axis});
  points.push_back({"tail", p.tail, c.tail});
  points.push_back({"l_fin", p.l_fin, c.l_fin});
  points.push_back({"r_fin", p.r_fin, c.r_fin});
  return points;
}

}  // namespace

std::string pose_table(std::span<const FishPose> poses, float scale) {
  std::string scorer = "scorer", parts = "bodyparts", coords = "coords", rows;
  for (const Point& point : points_of(poses.empty() ? FishPose{} : poses.front())) {
    scorer += ",neontetra,neontetra,neontetra";
    parts += "," + point.name + "," + point.name + "," + point.name;
    coords += ",x,y,likelihood";
  }
  int64_t number = 0;
  for (const FishPose& pose : poses) {
    rows += std::to_string(number++);
    for (const Point& point : points_of(pose)) {
      char cells[80];
      const Vec2 at = to_source(point.at, scale);
      if (point.likelihood > 0)
        std::snprintf(cells, sizeof cells, ",%.3f,%.3f,%.3f", static_cast<double>(at.x), static_cast<double>(at.y),
                      static_cast<double>(point.likelihood));
      else std::snprintf(cells, sizeof cells, ",,,0");
      rows += cells;
    }
    rows += '\n';
  }
  return scorer + "\n" + parts + "\n" + coords + "\n" + rows;
}

}  // namespace nt
