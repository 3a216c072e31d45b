// SPDX-License-Identifier: Apache-2.0
// A session being recorded into a take: all its fish, thumbnails, and the camera's pictures beside it if asked for; an observation
// without picture gives neither thumbnail nor picture.
//
// Once a step: add(). Frames are numbered by the camera's own count from the first one on, so a dropped frame leaves a gap and
// the take keeps the fish's own time. Frames of the past (PreRecord) come first; the video begins with the first step. It
// is FILE.take.mkv, in the working frame's size, one picture for each frame of the take (a dropped one shows the next).
// Cost: 0.1 ms a fish and step on the caller's thread, and the video's encoder.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/export/video_writer.h"
#include "app/observation.h"
#include "app/take/recorder.h"

namespace nt {

// What a step gave for a take: a row for the selected fish where one is followed, else for the first and every one that
// has had a pose so far. Frame numbers are the camera's count.
class FishRows {
 public:
  std::span<const TakeFrame> read(const Observation& seen);

 private:
  bool known_[kMostFish] = {};
  std::vector<TakeFrame> rows_;
};

class TakeRecording {
 public:
  // Throws UserError when a file cannot be made.
  TakeRecording(const std::string& path, TakeInfo info, bool keep_video, std::vector<TakeFrame> past = {});

  void add(const Observation& seen, std::span<const TakeFrame> frames);  // `frames`: what FishRows read in it
  void finish();                                                         // throws UserError, after all is closed
  int64_t frames() const { return last_ < first_ ? 0 : last_ - first_ + 1; }
  // "noon.take: 12.3 s, 369 frames, 2 fish, with noon.take.mkv"
  std::string summary() const;

 private:
  void add_thumbnail(const Observation& seen, int64_t number);
  void add_video(const Observation& seen);

  std::string path_, video_name_;
  double fps_;
  std::optional<int64_t> origin_;  // the camera's count of frame 0
  int64_t first_ = 0, last_ = -1;  // frames of the take
  int fish_ = 0;
  int64_t next_thumbnail_ = 0;
  int64_t next_picture_ = 0;  // the frame of the take that the video's next picture shows
  std::vector<uint8_t> rgb_;
  std::unique_ptr<VideoWriter> video_;
  std::unique_ptr<TakeRecorder> recorder_;
};

}  // namespace nt
