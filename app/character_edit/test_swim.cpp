// SPDX-License-Identifier: Apache-2.0
#include "app/character_edit/test_swim.h"

#include <algorithm>

#include "core/motion/inbetween.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr float kFps = 30;
constexpr int kMostMotions = 15;  // a window that stood still for longer does not catch up

TankSettings tank_settings() {
  TankSettings settings;
  settings.scene = "turns";
  settings.width = 160, settings.height = 90;
  settings.fps = kFps;
  return settings;
}

}  // namespace

TestSwim::TestSwim() : tank_(tank_settings()) {
  next_motion();
  next_motion();
}

void TestSwim::next_motion() {
  (void)tank_.render_next();
  const FishPose& pose = tank_.truth().pose;
  const bool first = tank_.frame_index() == 0;
  const int64_t time_ns = static_cast<int64_t>(static_cast<float>(tank_.frame_index()) / kFps * 1e9f);
  previous_ = current_;
  current_ = motion_from_pose(pose, time_ns, first ? nullptr : &previous_);
  current_.centre = {};
}

void TestSwim::wear(const Character& character) {
  RetargetSettings settings;
  settings.mls = character.deformer;
  Arena measuring;
  (void)Retarget::create(measuring, character, settings);
  AlignedBlock memory(measuring.used());
  Arena arena(memory.bytes());
  const Result<Retarget*> made = Retarget::create(arena, character, settings);
  if (!made.ok()) throw UserError(made.status().message);
  memory_ = std::move(memory);
  retarget_ = made.value();
  retarget_->start(0);
}

void TestSwim::step(float dt_s, Vec2 centre, float length_px) {
  since_s_ += dt_s;
  for (int i = 0; i < kMostMotions && since_s_ >= 1 / kFps; ++i, since_s_ -= 1 / kFps) next_motion();
  since_s_ = std::min(since_s_, 1 / kFps);
  Placement placement;
  placement.offset = centre;
  placement.zoom = length_px / retarget_->lengths().body_len;
  retarget_->pose(in_between(previous_, current_, since_s_ * kFps), dt_s, placement);
}

}  // namespace nt
