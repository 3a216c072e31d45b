// SPDX-License-Identifier: Apache-2.0
// What reads and writes video and picture files, loaded when it is first asked for.
//
// The libraries behind it (FFmpeg, OpenCV's videoio and imgcodecs with GDAL behind them) pull in some 240 others and cost
// 50 MB of resident memory by being loaded alone. A run that needs no file of that kind (a live camera, the tank, CSV)
// goes without: the code that calls them stands in one module, libneontetra_codecs.so, opened on first use.
// Path -> pictures and back. Throws UserError where the module is missing.
#pragma once
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "platform/sim/frame_source.h"

namespace nt {

// A video file that is being written; see app/export/video_writer.h for the promises.
class VideoFile {
 public:
  virtual ~VideoFile() = default;
  virtual void add(std::span<const uint8_t> rgb) = 0;
  virtual void finish() = 0;
  virtual int64_t frames_written() const = 0;
  virtual const char* codec_name() const = 0;
};

struct Codecs {
  std::unique_ptr<FrameSource> (*open_frame_source)(const std::string& path);
  std::unique_ptr<VideoFile> (*open_video_file)(const std::string& path, int width, int height, double fps);
  cv::Mat (*read_picture)(const std::string& path, int imread_flags);  // empty when it cannot be read
  bool (*encode_png)(const cv::Mat& bgr, std::vector<uint8_t>& bytes);
  const char* (*h264_encoder)();  // its name; null where there is none
  const char* (*ffmpeg_version)();
};

const Codecs& codecs();
// Another function of the module, by its C name: for what the app keeps there too.
void* codecs_function(const char* name);

}  // namespace nt
