// SPDX-License-Identifier: Apache-2.0
#include "app/take/recorder.h"

#include <algorithm>
#include <chrono>

#include "platform/camera.h"

namespace nt {

TakeRecorder::TakeRecorder(const std::string& path, const TakeInfo& info, int period_ms, std::vector<TakeFrame> past)
    : take_(Take::create(path, info)), ring_(kRingFrames), past_(std::move(past)), period_ms_(period_ms) {
  batch_.reserve(kRingFrames);
  thread_ = std::thread([this] { store(); });
}

TakeRecorder::~TakeRecorder() {
  try {
    finish();
  } catch (const UserError&) {
    // Whoever wanted to know has asked finish() itself.
  }
}

void TakeRecorder::add(const TakeFrame& frame) {
  const uint64_t written = written_.load(std::memory_order_relaxed);
  if (failed_.load(std::memory_order_relaxed) || written - stored_.load(std::memory_order_acquire) >= kRingFrames) {
    ++not_recorded_;
    return;
  }
  ring_[written % kRingFrames] = frame;
  written_.store(written + 1, std::memory_order_release);
  if (half_full()) wake_.notify_one();
}

bool TakeRecorder::half_full() const { return written_.load() - stored_.load() >= kRingFrames / 2; }

void TakeRecorder::add_thumbnail(Thumbnail thumbnail) {
  const std::lock_guard lock(mutex_);
  thumbnails_.push_back(std::move(thumbnail));
}

void TakeRecorder::commit() {
  std::vector<Thumbnail> thumbnails;
  {
    const std::lock_guard lock(mutex_);
    thumbnails.swap(thumbnails_);
  }
  const uint64_t written = written_.load(std::memory_order_acquire);
  uint64_t stored = stored_.load(std::memory_order_relaxed);
  batch_.clear();
  for (; stored < written; ++stored) batch_.push_back(ring_[stored % kRingFrames]);
  stored_.store(stored, std::memory_order_release);
  take_.append(batch_);
  take_.add_thumbnails(thumbnails);
}

void TakeRecorder::store() {
  try {
    using std::chrono::steady_clock;
    const std::chrono::milliseconds period(period_ms_);
    take_.append(past_);
    past_ = {};
    auto due = steady_clock::now() + period;
    for (bool last = false; !last;) {
      {
        std::unique_lock lock(mutex_);
        wake_.wait_until(lock, due, [this] { return stop_ || half_full(); });
        last = stop_;
      }
      due = steady_clock::now() + period;  // from one commit's beginning to the next one's
      commit();
    }
    take_.close();
  } catch (const UserError& error) {
    const std::lock_guard lock(mutex_);
    failure_ = error.what();
    failed_ = true;
  }
}

std::string TakeRecorder::failure() {
  if (!failed_.load()) return {};
  const std::lock_guard lock(mutex_);
  return failure_;
}

void TakeRecorder::finish() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (failed_) throw UserError(failure_);
}

void PreRecord::add(const TakeFrame& frame) {
  if (ring_.empty()) return;
  ring_[static_cast<std::size_t>(count_ % ring_.size())] = frame;
  ++count_;
}

std::vector<TakeFrame> PreRecord::frames() const {
  std::vector<TakeFrame> frames;
  const uint64_t held = std::min<uint64_t>(count_, ring_.size());
  for (uint64_t i = count_ - held; i < count_; ++i) frames.push_back(ring_[static_cast<std::size_t>(i % ring_.size())]);
  return frames;
}

}  // namespace nt
