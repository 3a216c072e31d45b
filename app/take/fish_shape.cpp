// SPDX-License-Identifier: Apache-2.0
#include "app/take/fish_shape.h"

#include <algorithm>
#include <functional>

#include "core/base/det_math.h"

namespace nt {
namespace {

float median_of(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Number = std::function<float(const FishPose&)>;
using Test = std::function<bool(const FishPose&)>;

// Over the frames with a pose that pass the test.
float median_of(std::span<const TakeFrame> frames, const Test& counts, const Number& number) {
  std::vector<float> values;
  for (const TakeFrame& frame : frames)
    if (frame.pose.ok() && counts(frame.pose)) values.push_back(number(frame.pose));
  return median_of(std::move(values));
}

Vec2 to_local(const FishPose& pose, Vec2 point) {
  const Vec2 v = point - pose.centre;
  return {dot(v, right_of(pose.dir)), dot(v, pose.dir)};
}

}  // namespace

float FishShape::axis_len() const {
  float sum = head_len + tail_len;
  for (int i = 0; i < u_num; ++i) sum += up_len[i];
  for (int i = 0; i < l_num; ++i) sum += low_len[i];
  return sum;
}

FishShape fish_shape(std::span<const TakeFrame> frames) {
  FishShape shape;
  if (frames.empty()) return shape;
  shape.u_num = frames.front().pose.u_num, shape.l_num = frames.front().pose.l_num;
  const Test any = [](const FishPose&) { return true; };
  const auto median = [&](const Number& number) { return median_of(frames, any, number); };
  for (int i = 0; i < shape.u_num; ++i)
    shape.up_len[i] =
        median([i](const FishPose& p) { return length(p.up_axis[i] - (i > 0 ? p.up_axis[i - 1] : p.centre)); });
  for (int i = 0; i < shape.l_num; ++i)
    shape.low_len[i] =
        median([i](const FishPose& p) { return length(p.low_axis[i] - (i > 0 ? p.low_axis[i - 1] : p.centre)); });
  shape.head_len = median([](const FishPose& p) { return length(p.head - p.up_axis[p.u_num - 1]); });
  shape.tail_len = median([](const FishPose& p) { return length(p.tail - p.low_axis[p.l_num - 1]); });
  const Test left = [](const FishPose& p) { return p.confidence.l_fin > 0; };
  const Test right = [](const FishPose& p) { return p.confidence.r_fin > 0; };
  const auto local = [&](const Test& seen, Vec2 FishPose::*point) {
    return Vec2{median_of(frames, seen, [point](const FishPose& p) { return to_local(p, p.*point).x; }),
                median_of(frames, seen, [point](const FishPose& p) { return to_local(p, p.*point).y; })};
  };
  shape.l_front = local(left, &FishPose::jun_tl), shape.l_back = local(left, &FishPose::jun_bl);
  shape.r_front = local(right, &FishPose::jun_tr), shape.r_back = local(right, &FishPose::jun_br);
  shape.l_fin_len = median_of(frames, left, [](const FishPose& p) { return length(p.l_fin - p.jun_tl); });
  shape.r_fin_len = median_of(frames, right, [](const FishPose& p) { return length(p.r_fin - p.jun_tr); });
  return shape;
}

FishPose pose_of(const Motion& motion, const FishShape& shape) {
  FishPose pose;
  pose.status = motion.status, pose.confidence = motion.confidence;
  pose.u_num = motion.u_num, pose.l_num = motion.l_num;
  pose.centre = motion.centre;
  const det::SinCos dir = det::sincos(motion.dir_rad);
  pose.dir = {dir.cos, dir.sin};
  const Vec2 right = right_of(pose.dir);
  const auto world = [&](Vec2 local) { return right * local.x + pose.dir * local.y; };
  const auto bone = [&](float angle, float len) {
    const det::SinCos a = det::sincos(angle);
    return world(Vec2{a.cos, a.sin} * len);
  };
  Vec2 joint = pose.centre;
  for (int i = 0; i < pose.u_num; ++i) joint = pose.up_axis[i] = joint + bone(motion.up_axis_angle[i], shape.up_len[i]);
  pose.head = joint + bone(motion.head_angle, shape.head_len);
  joint = pose.centre;
  for (int i = 0; i < pose.l_num; ++i)
    joint = pose.low_axis[i] = joint + bone(motion.low_axis_angle[i], shape.low_len[i]);
  pose.tail = joint + bone(motion.tail_angle, shape.tail_len);
  pose.jun_tl = pose.centre + world(shape.l_front), pose.jun_bl = pose.centre + world(shape.l_back);
  pose.jun_tr = pose.centre + world(shape.r_front), pose.jun_br = pose.centre + world(shape.r_back);
  pose.l_fin = pose.jun_tl + bone(motion.l_fin_angle, shape.l_fin_len);
  pose.r_fin = pose.jun_tr + bone(motion.r_fin_angle, shape.r_fin_len);
  pose.axis_len = shape.axis_len();
  return pose;
}

}  // namespace nt
