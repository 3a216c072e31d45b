// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/sim_camera.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "platform/sim/file_camera.h"

namespace nt {
namespace {

constexpr int kSmallestWorkSide = 16;  // as for files

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

void check(const TankSettings& settings) {
  if (find_tank_scene(settings.scene) == nullptr) {
    throw UserError("sim: no scene is called \"" + settings.scene + "\"; known: " + joined(tank_scene_names()), 2);
  }
  if (!Tank::size_fits(settings.width, settings.height)) {
    throw UserError("sim: size=" + size_text(settings.width, settings.height) + " cannot be; use " +
                        size_text(kTankLeastWidth, kTankLeastHeight) + " to " +
                        size_text(kTankMostWidth, kTankMostHeight) + " pixels",
                    2);
  }
  if (!(settings.fps > 0) || !std::isfinite(settings.fps)) throw UserError("sim: fps must be above 0", 2);
}

}  // namespace

SimCamera::SimCamera(const TankSettings& settings, int64_t frames, int work_width, int work_height)
    : settings_(settings) {
  check(settings);
  const WorkSize work = working_size(settings.width, settings.height, work_width, work_height);
  if (work.width < kSmallestWorkSide || work.height < kSmallestWorkSide) {
    throw UserError("sim: at the working size the tank is " + size_text(work.width, work.height) +
                    " pixels, too small to hold a fish; raise --work-size");
  }
  info_.name = "sim:scene=" + settings.scene;
  info_.source_width = settings.width;
  info_.source_height = settings.height;
  info_.width = work.width;
  info_.height = work.height;
  info_.fps = settings.fps;
  info_.frame_count = frames < 0 ? -1 : frames;
  tank_ = std::make_unique<Tank>(settings_);
}

std::optional<Frame> SimCamera::next() {
  const int64_t index = tank_->frame_index() + 1;
  if (info_.frame_count >= 0 && index >= info_.frame_count) return std::nullopt;
  Frame frame;
  frame.luma = shrunk(tank_->render_next());
  if (with_chroma_) {
    const Picture colour = picture();
    const cv::Mat rgb(info_.height, info_.width, CV_8UC3, const_cast<uint8_t*>(colour.pixels));
    chroma_.give(rgb, true, frame);
  }
  frame.sequence = static_cast<uint64_t>(index);
  frame.timestamp_ns = std::llround(static_cast<double>(index) * 1e9 / info_.fps);
  return frame;
}

LumaView SimCamera::shrunk(const LumaView& luma) {
  if (luma.width == info_.width && luma.height == info_.height) return luma;
  // OpenCV has no view of constant pixels; these are only read.
  const cv::Mat whole(luma.height, luma.width, CV_8UC1, const_cast<uint8_t*>(luma.data),
                      static_cast<std::size_t>(luma.stride));
  cv::resize(whole, luma_, {info_.width, info_.height}, 0, 0, cv::INTER_AREA);
  return {luma_.data, luma_.cols, luma_.rows, static_cast<std::ptrdiff_t>(luma_.step[0])};
}

Picture SimCamera::picture() const {
  Picture picture;
  if (tank_->frame_index() < 0) return picture;
  picture.pixels = tank_->rgb().data();
  if (info_.width != settings_.width || info_.height != settings_.height) {
    const cv::Mat whole(settings_.height, settings_.width, CV_8UC3, const_cast<uint8_t*>(picture.pixels));
    cv::resize(whole, rgb_, {info_.width, info_.height}, 0, 0, cv::INTER_AREA);
    picture.pixels = rgb_.data;
  }
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

const TankTruth* SimCamera::truth_with_mask(bool with_mask) {
  return tank_->frame_index() < 0 ? nullptr : &tank_->truth(with_mask);
}

std::unique_ptr<SimCamera> open_sim_camera(const TankSettings& settings, int64_t frames, int work_width,
                                           int work_height) {
  return std::make_unique<SimCamera>(settings, frames, work_width, work_height);
}

}  // namespace nt
