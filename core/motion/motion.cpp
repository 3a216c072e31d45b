// SPDX-License-Identifier: Apache-2.0
#include "core/motion/motion.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

// Which turn an angle belongs to in the first frame: that of a straight fish.
constexpr float kStraightUp = det::kHalfPi;
constexpr float kStraightDown = -det::kHalfPi;

class LocalFrame {
 public:
  explicit LocalFrame(Vec2 dir) : dir_(dir), right_(right_of(dir)) {}
  // The angle of the bone from `from` to `to`, in the turn nearest to `near`. A bone without length keeps `near`.
  float angle(Vec2 from, Vec2 to, float near) const {
    const Vec2 v = to - from;
    const float x = dot(v, right_), y = dot(v, dir_);
    if (x == 0.0f && y == 0.0f) return near;
    return det::unwrap(det::atan2(y, x), near);
  }

 private:
  Vec2 dir_, right_;
};

}  // namespace

Motion motion_from_pose(const FishPose& pose, int64_t time_ns, const Motion* last) {
  Motion m;
  m.time_ns = time_ns;
  m.status = pose.status;
  m.u_num = pose.u_num;
  m.l_num = pose.l_num;
  m.centre = pose.centre;
  m.confidence = pose.confidence;
  const float dir_rad = det::atan2(pose.dir.y, pose.dir.x);
  m.dir_rad = last != nullptr ? det::unwrap(dir_rad, last->dir_rad) : dir_rad;

  const LocalFrame local(pose.dir);
  Vec2 joint = pose.centre;
  for (int i = 0; i < pose.u_num; ++i) {
    const bool known = last != nullptr && i < last->u_num;
    m.up_axis_angle[i] = local.angle(joint, pose.up_axis[i], known ? last->up_axis_angle[i] : kStraightUp);
    joint = pose.up_axis[i];
  }
  m.head_angle = local.angle(joint, pose.head, last != nullptr ? last->head_angle : kStraightUp);
  joint = pose.centre;
  for (int i = 0; i < pose.l_num; ++i) {
    const bool known = last != nullptr && i < last->l_num;
    m.low_axis_angle[i] = local.angle(joint, pose.low_axis[i], known ? last->low_axis_angle[i] : kStraightDown);
    joint = pose.low_axis[i];
  }
  m.tail_angle = local.angle(joint, pose.tail, last != nullptr ? last->tail_angle : kStraightDown);

  const float near_l = last != nullptr ? last->l_fin_angle : kFoldedLeftFin;
  const float near_r = last != nullptr ? last->r_fin_angle : kFoldedRightFin;
  m.l_fin_angle =
      pose.confidence.l_fin > 0.0f ? local.angle(pose.jun_tl, pose.l_fin, near_l) : det::unwrap(kFoldedLeftFin, near_l);
  m.r_fin_angle = pose.confidence.r_fin > 0.0f ? local.angle(pose.jun_tr, pose.r_fin, near_r)
                                               : det::unwrap(kFoldedRightFin, near_r);
  return m;
}

}  // namespace nt
