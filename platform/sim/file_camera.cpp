// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/file_camera.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "platform/sim/frame_source.h"
#include "platform/sim/half_chroma.h"

namespace nt {
namespace {

constexpr int kSmallestSide = 16;
constexpr int kLargestSide = 8192;

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

class FileCamera : public Camera {
 public:
  FileCamera(const std::string& path, int work_width, int work_height, double fps_override, int64_t most_pixels)
      : name_(std::filesystem::path(path).filename().string()), source_(open_frame_source(path)) {
    if (!source_->read(decoded_))
      throw UserError(path + ": there is no frame in it that can be read; record it again or convert it");
    check_size(path);
    const WorkSize size = working_size(decoded_.cols, decoded_.rows, work_width, work_height, most_pixels);
    if (size.width < kSmallestSide || size.height < kSmallestSide) {
      throw UserError(path + ": at the working size it is " + size_text(size.width, size.height) +
                      " pixels, too small to hold a fish; raise --work-size");
    }
    info_.name = "file:" + path;
    info_.source_width = decoded_.cols;
    info_.source_height = decoded_.rows;
    info_.width = size.width;
    info_.height = size.height;
    info_.fps = fps_override > 0 ? fps_override : source_->fps();
    info_.frame_count = source_->frame_count();
    pending_ = true;
  }

  const CameraInfo& info() const override { return info_; }

  std::optional<Frame> next() override {
    if (!pending_ && !source_->read(decoded_)) {
      ended_ = true;
      return std::nullopt;
    }
    pending_ = false;
    if (decoded_.cols != info_.source_width || decoded_.rows != info_.source_height) {
      throw UserError(name_ + ": frame " + std::to_string(source_->index()) + " is " +
                      size_text(decoded_.cols, decoded_.rows) + " pixels, the first was " +
                      size_text(info_.source_width, info_.source_height) + "; make them all one size");
    }
    convert();
    ++delivered_;
    Frame frame;
    frame.luma = {luma_.data, luma_.cols, luma_.rows, static_cast<std::ptrdiff_t>(luma_.step[0])};
    if (with_chroma_) chroma_.give(rgb_, true, frame);
    frame.sequence = static_cast<uint64_t>(source_->index());
    frame.timestamp_ns = std::llround(static_cast<double>(source_->index()) * 1e9 / info_.fps);
    return frame;
  }

  void give_chroma() override { with_chroma_ = true; }

  Picture picture() const override {
    Picture picture;
    if (delivered_ == 0) return picture;
    picture.pixels = rgb_.data;
    picture.width = rgb_.cols;
    picture.height = rgb_.rows;
    picture.stride = static_cast<int>(rgb_.step[0]);
    picture.format = PixelFormat::rgb8;
    picture.revision = revision_;
    return picture;
  }

  bool rewind() override {
    source_->rewind();
    pending_ = false;
    ended_ = false;
    delivered_ = 0;
    return true;
  }

  std::string warning() const override {
    if (!ended_) return {};
    const int64_t seen = source_->index() + 1;  // decoded and skipped
    const int64_t promised = info_.frame_count;
    // One frame less is ordinary: containers that store a duration round it.
    if (promised > seen + 1) {
      return name_ + ": the file ends early: " + std::to_string(delivered_) + " of " + std::to_string(promised) +
             " frames could be read";
    }
    if (seen > delivered_) {
      return name_ + ": " + std::to_string(seen - delivered_) + " of " + std::to_string(seen) +
             " frames could not be decoded and were skipped";
    }
    return {};
  }

 private:
  void check_size(const std::string& path) const {
    const std::string size = path + ": its frames are " + size_text(decoded_.cols, decoded_.rows) + " pixels, ";
    if (decoded_.cols < kSmallestSide || decoded_.rows < kSmallestSide) {
      throw UserError(size + "too small to hold a fish; use 16x16 or more");
    }
    if (decoded_.cols > kLargestSide || decoded_.rows > kLargestSide) {
      throw UserError(size + "too large; shrink it to 8192 or less a side");
    }
  }

  void convert() {
    const cv::Size size(info_.width, info_.height);
    const bool shrink = size != decoded_.size();
    if (shrink) cv::resize(decoded_, small_, size, 0, 0, cv::INTER_AREA);
    const cv::Mat& bgr = shrink ? small_ : decoded_;
    cv::cvtColor(bgr, luma_, cv::COLOR_BGR2GRAY);
    cv::cvtColor(bgr, rgb_, cv::COLOR_BGR2RGB);
    ++revision_;
  }

  std::string name_;
  std::unique_ptr<FrameSource> source_;
  CameraInfo info_;
  cv::Mat decoded_, small_, luma_, rgb_;
  HalfChroma chroma_;
  bool with_chroma_ = false;
  bool pending_ = false;  // the first frame was decoded to learn its size and is still to be handed out
  bool ended_ = false;
  int64_t delivered_ = 0;
  uint64_t revision_ = 0;
};

}  // namespace

std::unique_ptr<Camera> open_file_camera(const std::string& path, int work_width, int work_height, double fps_override,
                                         int64_t most_pixels) {
  try {
    return std::make_unique<FileCamera>(path, work_width, work_height, fps_override, most_pixels);
  } catch (const cv::Exception&) {
    throw UserError(path + ": it cannot be decoded (damaged, or too large for the memory)");
  }
}

}  // namespace nt
