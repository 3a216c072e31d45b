// SPDX-License-Identifier: Apache-2.0
// A camera's raw picture, as it lies in the driver's memory -> luma and chroma for core, a colour picture for the window.
//
// NV12 and GREY of the working size are looked at where they lie; all else is copied once: YUYV is taken apart, limited
// range is spread, a larger picture is shrunk by area averaging. Chroma and colours are made only when they are asked for.
// Views hold until the next unpack() or until the bytes go. Nothing is allocated after the first picture.
// Cost at 960x544: NV12 nothing, YUYV 0.1 ms, MJPEG 3 ms; chroma 0.2 ms; the colour picture 0.5 ms.
#pragma once
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "core/frame/frame.h"
#include "core/scene/scene.h"
#include "platform/linux/jpeg_planes.h"
#include "platform/linux/v4l2_stream.h"

namespace nt {

class VideoPixels {
 public:
  VideoPixels(const VideoLayout& layout, int width, int height);  // the working size, at most the layout's

  // False when the bytes are no whole picture. Of `frame` the views are set.
  bool unpack(std::span<const uint8_t> bytes, bool with_chroma, Frame& frame);
  // Of the last bytes, or where they are gone the one that was made last; luma8 where there is no colour. In memory of its own.
  Picture picture() const;
  void forget() { bytes_ = {}; }  // the bytes of the last unpack() are gone
  // The mean of every 16th pixel in both directions of the last luma.
  double brightness() const;

 private:
  bool is_grey() const { return layout_.format == VideoFormat::grey || (jpeg_ != nullptr && jpeg_->cb().empty()); }
  void show() const;
  cv::Mat plane(std::span<const uint8_t> bytes, std::size_t offset, int columns, int rows, int type) const;
  void take_luma(const cv::Mat& luma, bool limited);
  void take_yuyv_luma(const cv::Mat& yuyv);
  void chroma_of_pairs(const cv::Mat& pairs, int first);
  void take_chroma(Frame& frame);
  bool shrinks() const { return width_ != layout_.width || height_ != layout_.height; }

  VideoLayout layout_;
  int width_, height_;
  std::unique_ptr<JpegPlanes> jpeg_;
  std::span<const uint8_t> bytes_;
  LumaView luma_;
  cv::Mat small_, own_luma_, half_, cb_, cr_;
  mutable cv::Mat rgb_, shown_;
  mutable uint64_t shown_revision_ = 0;
  uint64_t revision_ = 0;
};

}  // namespace nt
