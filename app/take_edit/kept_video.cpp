// SPDX-License-Identifier: Apache-2.0
#include "app/take_edit/kept_video.h"

#include <exception>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace nt {
namespace {

constexpr int64_t kNearby = 30;  // pictures ahead: read on rather than seek

}  // namespace

KeptVideo::KeptVideo(std::string path, int64_t first)
    : path_(std::move(path)), first_(first), thread_([this] { work(); }) {}

KeptVideo::~KeptVideo() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void KeptVideo::want(int64_t frame) {
  {
    const std::lock_guard lock(mutex_);
    if (wanted_ == frame) return;
    wanted_ = frame;
  }
  wake_.notify_one();
}

Picture KeptVideo::picture() {
  {
    const std::lock_guard lock(mutex_);
    if (fresh_) {
      std::swap(front_, back_);
      shown_ = ready_, fresh_ = false;
      ++revision_;
    }
  }
  Picture picture;
  if (front_.empty()) return picture;
  picture.pixels = front_.data;
  picture.width = front_.cols, picture.height = front_.rows, picture.stride = static_cast<int>(front_.step);
  picture.format = PixelFormat::rgb8, picture.revision = revision_;
  return picture;
}

std::string KeptVideo::problem() {
  const std::lock_guard lock(mutex_);
  return done_ == wanted_ ? problem_ : "";
}

void KeptVideo::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || wanted_ != done_; });
    if (stop_) return;
    const int64_t frame = wanted_;
    lock.unlock();
    try {
      decode(frame);
    } catch (const std::exception&) {  // OpenCV's own, too
      source_.reset();
      tell(frame, std::filesystem::path(path_).filename().string() + " cannot be read: it is damaged or no video");
    }
    lock.lock();
  }
}

void KeptVideo::decode(int64_t frame) {
  const std::string name = std::filesystem::path(path_).filename().string();
  std::error_code unused;
  if (!std::filesystem::exists(path_, unused)) {
    source_.reset();
    return tell(frame, name + " is not there: put it beside the take again");
  }
  if (frame < first_) return tell(frame, name + " begins later");
  if (source_ == nullptr) source_ = open_frame_source(path_);
  if (!read_up_to(frame - first_)) return tell(frame, name + " has no picture of this frame");
  cv::Mat rgb;
  cv::cvtColor(bgr_, rgb, cv::COLOR_BGR2RGB);
  const std::lock_guard lock(mutex_);
  back_ = std::move(rgb);
  ready_ = done_ = frame, fresh_ = true;
  problem_.clear();
}

bool KeptVideo::read_up_to(int64_t index) {
  const int64_t ahead = index - source_->index();
  if ((ahead <= 0 || ahead > kNearby) && !source_->seek(index)) return false;
  while (source_->index() < index)
    if (!source_->read(bgr_)) return false;
  return source_->index() == index;
}

void KeptVideo::tell(int64_t frame, const std::string& problem) {
  const std::lock_guard lock(mutex_);
  done_ = frame, problem_ = problem;
}

}  // namespace nt
