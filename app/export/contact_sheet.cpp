// SPDX-License-Identifier: Apache-2.0
#include "app/export/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "app/export/png.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr int kLargestTileWidth = 480;
constexpr int kGap = 4;  // pixels between tiles

}  // namespace

void ContactSheet::add(std::span<const uint8_t> rgb, int width, int height) {
  const int64_t frame = frames_++;
  if (frame % stride_ != 0) return;
  if (static_cast<int>(kept_.size()) == 2 * tiles_) {
    thin_out();
    if (frame % stride_ != 0) return;
  }
  if (frame == 0) {
    tile_width_ = std::min(width, kLargestTileWidth);
    tile_height_ = std::max(1, static_cast<int>(std::lround(static_cast<double>(height) * tile_width_ / width)));
  }
  const cv::Mat source(height, width, CV_8UC3, const_cast<uint8_t*>(rgb.data()));
  Tile tile;
  tile.frame = frame;
  tile.rgb.resize(static_cast<std::size_t>(tile_width_) * static_cast<std::size_t>(tile_height_) * 3);
  cv::Mat small(tile_height_, tile_width_, CV_8UC3, tile.rgb.data());
  cv::resize(source, small, small.size(), 0, 0, cv::INTER_AREA);
  kept_.push_back(std::move(tile));
}

void ContactSheet::thin_out() {
  stride_ *= 2;
  std::erase_if(kept_, [this](const Tile& tile) { return tile.frame % stride_ != 0; });
}

std::vector<const ContactSheet::Tile*> ContactSheet::choice() const {
  std::vector<const Tile*> out;
  const auto held = static_cast<int>(kept_.size());
  const int shown = std::min(held, tiles_);
  for (int i = 0; i < shown; ++i) {
    const double at = shown > 1 ? static_cast<double>(i) * (held - 1) / (shown - 1) : 0.0;
    out.push_back(&kept_[static_cast<std::size_t>(std::lround(at))]);
  }
  return out;
}

std::vector<int64_t> ContactSheet::chosen() const {
  std::vector<int64_t> frames;
  for (const Tile* tile : choice()) frames.push_back(tile->frame);
  return frames;
}

void ContactSheet::write(const std::string& path) const {
  const std::vector<const Tile*> shown = choice();
  if (shown.empty()) throw UserError("cannot write " + path + ": there was no frame to show");
  const auto count = static_cast<int>(shown.size());
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  const int rows = (count + columns - 1) / columns;
  cv::Mat sheet(rows * (tile_height_ + kGap) - kGap, columns * (tile_width_ + kGap) - kGap, CV_8UC3,
                cv::Scalar::all(255));
  for (int i = 0; i < count; ++i) {
    const cv::Rect place(i % columns * (tile_width_ + kGap), i / columns * (tile_height_ + kGap), tile_width_,
                         tile_height_);
    auto* pixels = const_cast<uint8_t*>(shown[static_cast<std::size_t>(i)]->rgb.data());
    cv::Mat(tile_height_, tile_width_, CV_8UC3, pixels).copyTo(sheet(place));
  }
  Picture picture;
  picture.pixels = sheet.data;
  picture.width = sheet.cols;
  picture.height = sheet.rows;
  picture.stride = static_cast<int>(sheet.step[0]);
  picture.format = PixelFormat::rgb8;
  write_png(path, picture);
}

}  // namespace nt
