// SPDX-License-Identifier: Apache-2.0
// Decoded pictures in order, whatever they come from: a video or a list of picture files. Used by file_camera, and by the take editor that shows the camera's pictures again.
//
// Path -> 8-bit BGR pictures of the source's size. Keeps OpenCV's and FFmpeg's own messages off the terminal, so that the
// user sees one line, ours.
#pragma once
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

namespace nt {

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  // The next picture that can be decoded; false at the end. Pictures that cannot be decoded are passed over and counted.
  virtual bool read(cv::Mat& bgr) = 0;
  virtual void rewind() = 0;
  // read() gives this picture next; false where the file cannot go there. A video decodes from the key frame before it.
  virtual bool seek(int64_t index) = 0;
  virtual double fps() const = 0;
  virtual int64_t frame_count() const = 0;  // that the file promises; -1 when it does not say
  int64_t index() const { return index_; }  // of the picture read last, passed-over ones counted; -1 before the first

 protected:
  int64_t index_ = -1;
};

// Throws UserError when the path is missing or holds neither a video nor pictures.
std::unique_ptr<FrameSource> open_frame_source(const std::string& path);

}  // namespace nt
