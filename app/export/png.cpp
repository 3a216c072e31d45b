// SPDX-License-Identifier: Apache-2.0
#include "app/export/png.h"

#include <opencv2/imgproc.hpp>

#include "app/export/output_file.h"
#include "app/picture_copy.h"
#include "platform/camera.h"
#include "platform/codecs.h"

namespace nt {
namespace {

cv::Mat as_opencv(const Picture& picture) {
  const int channels = channels_of(picture.format);
  // OpenCV's matrix takes no const pixels; they are only read.
  const cv::Mat pixels(picture.height, picture.width, CV_8UC(channels), const_cast<uint8_t*>(picture.pixels),
                       static_cast<std::size_t>(picture.stride));
  if (channels == 1) return pixels;
  cv::Mat swapped;
  cv::cvtColor(pixels, swapped, channels == 3 ? cv::COLOR_RGB2BGR : cv::COLOR_RGBA2BGRA);
  return swapped;
}

}  // namespace

std::vector<uint8_t> png_bytes(const Picture& picture, const std::string& name) {
  if (picture.pixels == nullptr || picture.width <= 0 || picture.height <= 0) {
    throw UserError("cannot write " + name + ": there is no picture to write");
  }
  std::vector<uint8_t> bytes;
  if (!codecs().encode_png(as_opencv(picture), bytes))
    throw UserError("cannot write " + name + ": OpenCV here has no PNG encoder");
  return bytes;
}

void write_png(const std::string& path, const Picture& picture) {
  const std::vector<uint8_t> bytes = png_bytes(picture, path);
  OutputFile file(path);
  const bool complete = file.write_at(0, bytes);
  if (!file.close() || !complete) throw UserError(file.error_line() + "; the picture is cut");
}

}  // namespace nt
