// SPDX-License-Identifier: Apache-2.0
#include "app/export/film.h"

namespace nt {

Film::Film(const std::string& video_path, const std::string& sheet_path, int width, int height, double fps)
    : width_(width), height_(height), sheet_path_(sheet_path) {
  if (!video_path.empty()) video_ = std::make_unique<VideoWriter>(video_path, width, height, fps);
}

void Film::add(const Scene& scene, int times) {
  if (!wanted()) return;
  if (display_ == nullptr) display_ = open_headless_display(width_, height_);
  display_->draw(scene);
  const std::span<const uint8_t> rgb = display_->pixels();
  for (int i = 0; i < times; ++i) {
    if (video_ != nullptr) video_->add(rgb);
    if (!sheet_path_.empty()) sheet_.add(rgb, width_, height_);
    ++frames_;
  }
}

void Film::finish() {
  if (video_ != nullptr) video_->finish();
  if (!sheet_path_.empty() && frames_ > 0) sheet_.write(sheet_path_);
}

}  // namespace nt
