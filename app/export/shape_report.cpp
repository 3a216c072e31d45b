// SPDX-License-Identifier: Apache-2.0
#include "app/export/shape_report.h"

#include <algorithm>
#include <cmath>

namespace nt {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFinNames[kMaxFins] = {"left", "right", "second_left", "second_right"};

double rounded(float v) { return std::round(static_cast<double>(v) * 1000) / 1000; }

}  // namespace

void ShapeReport::add(int64_t frame, const Distortion& distortion, Vec2 where_px) {
  ++poses_;
  turned_ += distortion.inverted;
  if (distortion.inverted > 0) ++poses_with_turned_;
  if (distortion.inverted > most_) most_ = distortion.inverted, most_frame_ = frame, most_where_px_ = where_px;
  for (int i = 0; i < kMaxFins; ++i) {
    least_area_[i] = std::min(least_area_[i], distortion.fin_area[i]);
    most_area_[i] = std::max(most_area_[i], distortion.fin_area[i]);
  }
}

Json ShapeReport::json(const Character& character) const {
  Json json;
  json["vertices"] = character.vertices.size();
  json["triangles"] = character.triangles.size() / 3;
  json["poses"] = poses_;
  json["poses_with_turned_triangles"] = poses_with_turned_;
  json["turned_triangles"] = turned_;
  json["most_turned"] = nullptr;
  if (most_ > 0) {
    json["most_turned"] = {
        {"frame", most_frame_}, {"count", most_}, {"x", rounded(most_where_px_.x)}, {"y", rounded(most_where_px_.y)}};
  }
  json["fin_area"] = Json::object();
  for (int i = 0; i < kMaxFins; ++i) {
    if (!character.rest.fins[i].present) continue;
    json["fin_area"][kFinNames[i]] = {{"least", rounded(least_area_[i])}, {"most", rounded(most_area_[i])}};
  }
  return json;
}

}  // namespace nt
