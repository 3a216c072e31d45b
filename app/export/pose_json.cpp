// SPDX-License-Identifier: Apache-2.0
#include "app/export/pose_json.h"

#include <cmath>

#include "app/export/pose_csv.h"
#include "app/export/report.h"
#include "app/export/rig_joints.h"

namespace nt {
namespace {

double rounded(float value, double steps) { return std::round(static_cast<double>(value) * steps) / steps; }

Json angles(const float* values, int count) {
  Json list = Json::array();
  for (int i = 0; i < count; ++i) list.push_back(rounded(values[i], 1e5));
  return list;
}

class Writer {
 public:
  Writer(const EditedTake& take, const Performance& performance)
      : take_(take),
        performance_(performance),
        scale_(static_cast<float>(take.info.source_width) / static_cast<float>(take.info.width)) {}

  std::string head() const {
    Json json = {{"format", kReportFormat},
                 {"program", "neontetra " NEONTETRA_VERSION},
                 {"take", take_.info.name},
                 {"fps", performance_.fps},
                 {"loop", performance_.loop},
                 {"source_size", {{"width", take_.info.source_width}, {"height", take_.info.source_height}}},
                 {"length_px", rounded(take_.init_len * scale_, 1e3)},
                 {"bones_px", rounded(take_.shape.axis_len() * scale_, 1e3)}};
    const std::string text = json.dump();
    return text.substr(0, text.size() - 1) + ",\"frames\":[\n";
  }

  Json frame(std::size_t i) const {
    const Sighting& sighting = performance_.frames[i];
    const Motion& m = sighting.motion;
    Json json = {{"frame", i},
                 {"t_s", std::round(static_cast<double>(i) / performance_.fps * 1e6) / 1e6},
                 {"status", to_string(m.status)},
                 {"dir_rad", rounded(m.dir_rad, 1e5)},
                 {"angles",
                  {{"head", rounded(m.head_angle, 1e5)},
                   {"tail", rounded(m.tail_angle, 1e5)},
                   {"l_fin", rounded(m.l_fin_angle, 1e5)},
                   {"r_fin", rounded(m.r_fin_angle, 1e5)},
                   {"up_axis", angles(m.up_axis_angle, m.u_num)},
                   {"low_axis", angles(m.low_axis_angle, m.l_num)}}},
                 {"points", points(pose_of(m, take_.shape))}};
    const PoseConfidence c = sighting.seen ? m.confidence : PoseConfidence{};
    json["confidence"] = {{"centre", rounded(c.centre, 1e3)}, {"head", rounded(c.head, 1e3)},
                          {"tail", rounded(c.tail, 1e3)},     {"l_fin", rounded(c.l_fin, 1e3)},
                          {"r_fin", rounded(c.r_fin, 1e3)},   {"axis", rounded(c.axis, 1e3)}};
    return json;
  }

  Json point(Vec2 p) const {
    const Vec2 at = to_source(p, scale_);
    return {rounded(at.x, 1e3), rounded(at.y, 1e3)};
  }

 private:
  Json points(const FishPose& p) const {
    Json json = {{"centre", point(p.centre)}, {"head", point(p.head)}, {"tail", point(p.tail)}};
    if (take_.shape.l_fin_len > 0) json["l_fin"] = point(p.l_fin);
    if (take_.shape.r_fin_len > 0) json["r_fin"] = point(p.r_fin);
    for (int i = 0; i < p.u_num; ++i) json["up_axis_" + std::to_string(i + 1)] = point(p.up_axis[i]);
    for (int i = 0; i < p.l_num; ++i) json["low_axis_" + std::to_string(i + 1)] = point(p.low_axis[i]);
    return json;
  }

  const EditedTake& take_;
  const Performance& performance_;
  float scale_;
};

}  // namespace

std::string pose_json(const EditedTake& take, const Performance& performance, const Wardrobe* wardrobe) {
  const Writer writer(take, performance);
  std::string text = writer.head();
  const auto add = [&](const Json& json, std::size_t i) {
    text += json.dump() + (i + 1 < performance.frames.size() ? ",\n" : "\n");
  };
  if (wardrobe == nullptr) {
    for (std::size_t i = 0; i < performance.frames.size(); ++i) add(writer.frame(i), i);
    return text + "]}\n";
  }
  Actor actor(*wardrobe, 0);
  const Rig rig(wardrobe->character(0));
  const Pane frame_pane{{-0.5f, -0.5f}, 1, 0, 0};
  perform(actor, performance, frame_pane, Before::first_pose, [&](std::size_t i) {
    Json json = writer.frame(i);
    const std::vector<Vec2> points = rig.scene_points(actor.retarget().control_points());
    for (std::size_t k = 0; k < points.size(); ++k) json["character"][rig.joints()[k].name] = writer.point(points[k]);
    add(json, i);
  });
  return text + "]}\n";
}

}  // namespace nt
