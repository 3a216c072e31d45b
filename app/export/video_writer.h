// SPDX-License-Identifier: Apache-2.0
// Writes rgb frames as a video file that plays anywhere; every error is seen and is one line.
//
// rgb8 frames (rows top down, packed) -> .mp4, .mov, .mkv, .avi (H.264, or MPEG-4 where no H.264 encoder is installed) or
// .webm (VP9). 4:2:0 needs even sides: an odd last row or column is left out. Colours are BT.601, limited range, and say so.
// The frame rate is kept as a fraction (29.97 is 30000/1001). Written to the final name directly.
// A disk that fills up: space for the file's index is claimed ahead of every frame, so the file is still closed properly
// and plays up to the frame at which it was cut; add() then throws UserError.
// Cost: the encoder's, on two threads; no allocation of our own per frame.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "platform/codecs.h"

namespace nt {

class VideoWriter {
 public:
  // Throws UserError: unknown extension, no encoder, no folder, no permission, a size or rate that cannot be.
  VideoWriter(const std::string& path, int width, int height, double fps);

  void add(std::span<const uint8_t> rgb);  // width x height x 3 bytes
  // Writes what the encoder still holds, closes; again is harmless. Without it the destructor does so quietly.
  void finish();
  int64_t frames_written() const;  // that have reached the file
  const char* codec_name() const;  // "libx264"

 private:
  std::unique_ptr<VideoFile> file_;
};

}  // namespace nt
