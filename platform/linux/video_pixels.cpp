// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/video_pixels.h"

#include <opencv2/imgproc.hpp>

#include "platform/late_module.h"
#include "platform/linux/luma_rows.h"

namespace nt {
namespace {

LumaView view_of(const cv::Mat& grey) {
  return {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step[0])};
}

// OpenCV has no view of constant pixels; these are only read.
cv::Mat mat_of(const LumaView& view) {
  return {view.height, view.width, CV_8UC1, const_cast<uint8_t*>(view.data), static_cast<std::size_t>(view.stride)};
}

}  // namespace

VideoPixels::VideoPixels(const VideoLayout& layout, int width, int height)
    : layout_(layout), width_(width), height_(height) {
  if (layout.format == VideoFormat::mjpeg) jpeg_ = open_jpeg_planes();
}

cv::Mat VideoPixels::plane(std::span<const uint8_t> bytes, std::size_t offset, int columns, int rows, int type) const {
  return {rows, columns, type, const_cast<uint8_t*>(bytes.data() + offset), static_cast<std::size_t>(layout_.stride)};
}

// Shrunk, spread, or as it is.
void VideoPixels::take_luma(const cv::Mat& luma, bool limited) {
  const cv::Mat* source = &luma;
  if (shrinks()) {
    cv::resize(luma, small_, {width_, height_}, 0, 0, cv::INTER_AREA);
    source = &small_;
  }
  if (limited) {
    own_luma_.create(height_, width_, CV_8UC1);
    for (int y = 0; y < height_; ++y) luma_from_limited(source->ptr(y), width_, own_luma_.ptr(y));
    source = &own_luma_;
  }
  luma_ = view_of(*source);
}

void VideoPixels::take_yuyv_luma(const cv::Mat& yuyv) {
  const cv::Mat* source = &yuyv;
  if (shrinks()) {  // the second channel, Cb and Cr mixed, is left unread
    cv::resize(yuyv, small_, {width_, height_}, 0, 0, cv::INTER_AREA);
    source = &small_;
  }
  own_luma_.create(height_, width_, CV_8UC1);
  for (int y = 0; y < height_; ++y) luma_from_yuyv(source->ptr(y), width_, layout_.limited, own_luma_.ptr(y));
  luma_ = view_of(own_luma_);
}

// Pixels of two or four channels, of which `first` and the next but one (or the next) are Cb and Cr.
void VideoPixels::chroma_of_pairs(const cv::Mat& pairs, int first) {
  cv::resize(pairs, half_, {(width_ + 1) / 2, (height_ + 1) / 2}, 0, 0, cv::INTER_AREA);
  cv::extractChannel(half_, cb_, first);
  cv::extractChannel(half_, cr_, pairs.channels() - 1);
}

void VideoPixels::take_chroma(Frame& frame) {
  const int pairs = layout_.width / 2;
  switch (layout_.format) {
    case VideoFormat::yuyv:
      chroma_of_pairs(plane(bytes_, 0, pairs, layout_.height, CV_8UC4), 1);
      break;
    case VideoFormat::nv12:
      chroma_of_pairs(plane(bytes_, static_cast<std::size_t>(layout_.stride) * static_cast<std::size_t>(layout_.height),
                            pairs, layout_.height / 2, CV_8UC2),
                      0);
      break;
    case VideoFormat::mjpeg: {
      if (jpeg_->cb().empty()) return;
      const cv::Size half((width_ + 1) / 2, (height_ + 1) / 2);
      cv::resize(mat_of(jpeg_->cb()), cb_, half, 0, 0, cv::INTER_AREA);
      cv::resize(mat_of(jpeg_->cr()), cr_, half, 0, 0, cv::INTER_AREA);
      break;
    }
    case VideoFormat::grey:
      return;
  }
  frame.cb = view_of(cb_), frame.cr = view_of(cr_);
}

bool VideoPixels::unpack(std::span<const uint8_t> bytes, bool with_chroma, Frame& frame) {
  if (bytes.size() < layout_.least_bytes()) return false;
  bytes_ = bytes;
  if (jpeg_ != nullptr) {
    if (!jpeg_->decode(bytes, layout_.width, layout_.height)) return false;
    take_luma(mat_of(jpeg_->luma()), false);
  } else if (layout_.format == VideoFormat::yuyv) {
    take_yuyv_luma(plane(bytes, 0, layout_.width, layout_.height, CV_8UC2));
  } else {
    take_luma(plane(bytes, 0, layout_.width, layout_.height, CV_8UC1), layout_.limited);
  }
  ++revision_;
  frame.luma = luma_;
  if (with_chroma) take_chroma(frame);
  return true;
}

void VideoPixels::show() const {
  if (is_grey()) {
    mat_of(luma_).copyTo(shown_);
    return;
  }
  if (jpeg_ != nullptr) {
    rgb_.create(layout_.height, layout_.width, CV_8UC3);
    if (!jpeg_->to_rgb(rgb_.data)) rgb_.setTo(0);
  } else if (layout_.format == VideoFormat::yuyv) {
    cv::cvtColor(plane(bytes_, 0, layout_.width, layout_.height, CV_8UC2), rgb_, cv::COLOR_YUV2RGB_YUYV);
  } else {
    const cv::Mat luma = plane(bytes_, 0, layout_.width, layout_.height, CV_8UC1);
    const std::size_t offset = static_cast<std::size_t>(layout_.stride) * static_cast<std::size_t>(layout_.height);
    cv::cvtColorTwoPlane(luma, plane(bytes_, offset, layout_.width / 2, layout_.height / 2, CV_8UC2), rgb_,
                         cv::COLOR_YUV2RGB_NV12);
  }
  if (shrinks()) cv::resize(rgb_, shown_, {width_, height_}, 0, 0, cv::INTER_AREA);
  else shown_ = rgb_;
}

Picture VideoPixels::picture() const {
  if (shown_revision_ != revision_ && !bytes_.empty()) {
    show();
    shown_revision_ = revision_;
  }
  Picture picture;
  if (shown_.empty()) return picture;
  picture.pixels = shown_.data;
  picture.width = shown_.cols, picture.height = shown_.rows;
  picture.stride = static_cast<int>(shown_.step[0]);
  picture.format = shown_.channels() == 1 ? PixelFormat::luma8 : PixelFormat::rgb8;
  picture.revision = shown_revision_;
  return picture;
}

std::unique_ptr<JpegPlanes> open_jpeg_planes() {
  static const LateModule module("libneontetra_jpeg.so", "which reads the pictures of cameras that send JPEG");
  using Make = JpegPlanes* (*)();
  return std::unique_ptr<JpegPlanes>(reinterpret_cast<Make>(module.function("neontetra_jpeg_planes"))());
}

double VideoPixels::brightness() const {
  constexpr int kEvery = 16;
  int64_t sum = 0, count = 0;
  for (int y = 0; y < luma_.height; y += kEvery) {
    for (int x = 0; x < luma_.width; x += kEvery) sum += luma_.row(y)[x], ++count;
  }
  return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0;
}

}  // namespace nt
