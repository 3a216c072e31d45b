// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/sim_camera.h"

#include <cmath>

namespace nt {
namespace {

constexpr int kSmallestSide = 16;
constexpr int kLargestSide = 8192;

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

void check(const TankSettings& settings) {
  if (find_tank_scene(settings.scene) == nullptr) {
    throw UserError("sim: no scene is called \"" + settings.scene + "\"; known: " + joined(tank_scene_names()), 2);
  }
  const auto bad_side = [](int side) { return side < kSmallestSide || side > kLargestSide; };
  if (bad_side(settings.width) || bad_side(settings.height)) {
    throw UserError("sim: size=" + std::to_string(settings.width) + "x" + std::to_string(settings.height) +
                        " cannot be; use 16x16 to 8192x8192 pixels", 2);
  }
  if (!(settings.fps > 0) || !std::isfinite(settings.fps)) throw UserError("sim: fps must be above 0", 2);
}

}  // namespace

SimCamera::SimCamera(const TankSettings& settings, int64_t frames) : settings_(settings) {
  check(settings);
  info_.name = "sim:scene=" + settings.scene;
  info_.source_width = info_.width = settings.width;
  info_.source_height = info_.height = settings.height;
  info_.fps = settings.fps;
  info_.frame_count = frames < 0 ? -1 : frames;
  tank_ = std::make_unique<Tank>(settings_);
}

std::optional<Frame> SimCamera::next() {
  const int64_t index = tank_->frame_index() + 1;
  if (info_.frame_count >= 0 && index >= info_.frame_count) return std::nullopt;
  Frame frame;
  frame.luma = tank_->render_next();
  frame.sequence = static_cast<uint64_t>(index);
  frame.timestamp_ns = std::llround(static_cast<double>(index) * 1e9 / info_.fps);
  return frame;
}

Picture SimCamera::picture() const {
  Picture picture;
  if (tank_->frame_index() < 0) return picture;
  picture.pixels = tank_->rgb().data();
  picture.width = info_.width;
  picture.height = info_.height;
  picture.stride = info_.width * 3;
  picture.format = PixelFormat::rgb8;
  picture.revision = static_cast<uint64_t>(tank_->frame_index()) + 1;
  return picture;
}

bool SimCamera::rewind() {
  tank_ = std::make_unique<Tank>(settings_);
  return true;
}

const TankTruth* SimCamera::truth(bool with_mask) {
  return tank_->frame_index() < 0 ? nullptr : &tank_->truth(with_mask);
}

std::unique_ptr<SimCamera> open_sim_camera(const TankSettings& settings, int64_t frames) {
  return std::make_unique<SimCamera>(settings, frames);
}

}  // namespace nt
