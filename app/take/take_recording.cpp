// SPDX-License-Identifier: Apache-2.0
#include "app/take/take_recording.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/picture_copy.h"
#include "app/take/from_session.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr const char* kVideoEnding = ".mkv";  // plays up to where it was cut off

// rgb, packed.
void copy_rgb(const Picture& picture, std::vector<uint8_t>& rgb) {
  const auto width = static_cast<std::size_t>(picture.width);
  const auto channels = static_cast<std::size_t>(channels_of(picture.format));
  rgb.resize(width * static_cast<std::size_t>(picture.height) * 3);
  uint8_t* out = rgb.data();
  for (int y = 0; y < picture.height; ++y) {
    const uint8_t* in = picture.pixels + static_cast<std::ptrdiff_t>(y) * picture.stride;
    for (std::size_t x = 0; x < width; ++x, in += channels) {
      for (std::size_t k = 0; k < 3; ++k) *out++ = in[channels == 1 ? 0 : k];
    }
  }
}

}  // namespace

std::span<const TakeFrame> FishRows::read(const Observation& seen) {
  rows_.clear();
  for (std::size_t fish = 0; fish < seen.fish.size(); ++fish) {
    bool& known = known_[fish];
    known = known || fish == 0 || seen.fish[fish].pose.ok();
    if (known) rows_.push_back(take_frame(seen, static_cast<int>(fish)));
  }
  return rows_;
}

TakeRecording::TakeRecording(const std::string& path, TakeInfo info, bool keep_video, std::vector<TakeFrame> past)
    : path_(path), fps_(info.fps) {
  if (std::filesystem::exists(path))
    throw UserError(path + ": exists; a take is never overwritten, choose another name");
  if (!past.empty()) origin_ = past.front().frame;
  for (TakeFrame& frame : past) {
    frame.frame -= *origin_;
    last_ = std::max(last_, frame.frame), fish_ = std::max(fish_, frame.fish + 1);
  }
  if (keep_video) {
    video_name_ = std::filesystem::path(path).filename().string() + kVideoEnding;
    next_picture_ = last_ + 1;
    info.video = video_name_, info.video_first = static_cast<int>(next_picture_);
    video_ = std::make_unique<VideoWriter>(path + kVideoEnding, info.width, info.height, info.fps);
  }
  recorder_ = std::make_unique<TakeRecorder>(path, info, TakeRecorder::kPeriod_ms, std::move(past));
}

void TakeRecording::add(const Observation& seen, std::span<const TakeFrame> frames) {
  if (frames.empty()) return;
  if (!origin_) origin_ = frames.front().frame;
  for (TakeFrame frame : frames) {
    frame.frame -= *origin_;
    last_ = frame.frame, fish_ = std::max(fish_, frame.fish + 1);
    recorder_->add(frame);
  }
  if (seen.picture.pixels == nullptr) return;
  add_thumbnail(seen, last_);
  add_video(seen);
}

// One from the beginning, then ever more seldom; of a frame with a pose where one comes soon.
void TakeRecording::add_thumbnail(const Observation& seen, int64_t number) {
  const bool posed = seen.pose().ok();
  if (number < next_thumbnail_ || (!posed && number < next_thumbnail_ + static_cast<int64_t>(2 * fps_))) return;
  recorder_->add_thumbnail({number, thumbnail_bmp(seen.picture)});
  next_thumbnail_ = number + std::max(number / 2, static_cast<int64_t>(fps_));
}

void TakeRecording::add_video(const Observation& seen) {
  if (video_ == nullptr) return;
  const auto count = static_cast<int64_t>(seen.frame.sequence);
  copy_rgb(seen.picture, rgb_);
  for (; next_picture_ <= count - *origin_; ++next_picture_) video_->add(rgb_);
}

void TakeRecording::finish() {
  std::string failure;
  try {
    recorder_->finish();
  } catch (const UserError& error) {
    failure = error.what();
  }
  if (video_ != nullptr) video_->finish();
  if (!failure.empty()) throw UserError(failure);
  if (recorder_->not_recorded() > 0)
    std::fprintf(stderr, "take: %lld frames are missing, the disk was too slow for them\n",
                 static_cast<long long>(recorder_->not_recorded()));
}

std::string TakeRecording::summary() const {
  char text[120];
  std::snprintf(text, sizeof text, ": %.1f s, %lld frames, %d fish", static_cast<double>(frames()) / fps_,
                static_cast<long long>(frames()), fish_);
  return path_ + text + (video_name_.empty() ? "" : ", with " + video_name_);
}

}  // namespace nt
