// SPDX-License-Identifier: Apache-2.0
#include "app/frame_loop/camera_thread.h"

#include <algorithm>
#include <cstring>

#include "app/picture_copy.h"
#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr std::chrono::milliseconds kLook{100};  // between two looks at whether to end
constexpr int64_t kNap_ns = 20'000'000;
constexpr int64_t kDriverRing = 3;  // frames that wait for a thread that sleeps too long, as in V4l2Camera

void copy_plane(LumaView& plane, std::vector<uint8_t>& pixels) {
  const auto width = static_cast<std::size_t>(std::max(plane.width, 0));
  pixels.resize(width * static_cast<std::size_t>(std::max(plane.height, 0)));
  for (int y = 0; y < plane.height; ++y)
    std::memcpy(pixels.data() + width * static_cast<std::size_t>(y), plane.row(y), width);
  plane.data = pixels.data();
  plane.stride = plane.width;
}

}  // namespace

CameraThread::CameraThread(std::unique_ptr<Camera> camera, const Settings& settings)
    : camera_(std::move(camera)),
      info_(camera_->info()),
      settings_(settings),
      pacer_(static_cast<int64_t>(1e9 / info_.fps), kDriverRing),
      thread_([this] { film(); }) {}

CameraThread::~CameraThread() { stop(); }

void CameraThread::stop() {
  stop_ = true;
  ring_.close();
  if (thread_.joinable()) thread_.join();
}

void CameraThread::pause(bool on) { paused_ = on; }

std::optional<Frame> CameraThread::next() {
  if (held_ != nullptr) ring_.pop();
  held_ = nullptr;
  while (!stop_ && !ring_.wait_filled(kLook)) {
    if (ring_.closed()) break;
  }
  if (stop_) return std::nullopt;  // then the camera's thread may still be at work
  held_ = ring_.oldest();
  if (held_ != nullptr) return held_->frame;
  if (failed_) std::rethrow_exception(failed_);
  return std::nullopt;
}

bool CameraThread::ready() { return wait_ready(std::chrono::milliseconds(0)); }

bool CameraThread::wait_ready(std::chrono::milliseconds most) {
  return ring_.wait_filled(most, held_ != nullptr ? 2 : 1) || ring_.closed();
}

Picture CameraThread::picture() const { return held_ != nullptr ? held_->picture : Picture{}; }

int64_t CameraThread::epoch_ns() const {
  return held_ != nullptr && held_->had_ns != 0 ? held_->had_ns - held_->frame.timestamp_ns : 0;
}

const TankTruth* CameraThread::truth() { return held_ != nullptr && held_->truth ? &*held_->truth : nullptr; }

void CameraThread::film() {
  try {
    take_place(settings_.plan, LoopThread::camera);
    while (film_one()) {
    }
  } catch (...) {
    failed_ = std::current_exception();
  }
  ring_.close();
}

bool CameraThread::film_one() {
  Slot* slot = nullptr;
  if (settings_.pace == Pace::every) {
    while (!stop_ && !ring_.wait_free(kLook)) {
    }
  }
  if (!wait_until_due()) return false;
  const std::optional<Frame> frame = camera_->next();
  if (!frame || stop_) return false;
  slot = ring_.free_slot();
  if (slot == nullptr) return true;  // dropped
  fill(*slot, *frame);
  ring_.push();
  return true;
}

// A clip is late as a camera is: frames that its driver could not have kept are lost.
bool CameraThread::wait_until_due() {
  while (paused_ && !stop_) sleep_until_ns(steady_now_ns() + kNap_ns), was_paused_ = true;
  if (settings_.pace == Pace::every || info_.live) return !stop_;
  if (was_paused_) pacer_.start(steady_now_ns());
  was_paused_ = false;
  while (!stop_ && steady_now_ns() < pacer_.due_ns())
    sleep_until_ns(std::min(pacer_.due_ns(), steady_now_ns() + kNap_ns));
  const int64_t now_ns = steady_now_ns();
  due_ns_ = pacer_.due_ns() + pacer_.skips(now_ns) * pacer_.period_ns();
  return skip(pacer_.take(now_ns)) && !stop_;
}

bool CameraThread::skip(int frames) {
  for (; frames > 0; --frames) {
    if (!camera_->next()) return false;
  }
  return true;
}

void CameraThread::fill(Slot& slot, const Frame& frame) {
  slot.frame = frame;
  copy_plane(slot.frame.luma, slot.luma);
  copy_plane(slot.frame.cb, slot.cb);
  copy_plane(slot.frame.cr, slot.cr);
  if (info_.live) slot.had_ns = camera_->epoch_ns() + frame.timestamp_ns;
  else slot.had_ns = settings_.pace == Pace::clock ? due_ns_ : 0;
  if (settings_.pictures) slot.picture = copied(camera_->picture(), slot.rgb);
  slot.truth.reset();
  if (!settings_.truth) return;
  if (const TankTruth* truth = camera_->truth(); truth != nullptr) slot.truth = *truth;
}

}  // namespace nt
