// SPDX-License-Identifier: Apache-2.0
#include "app/ui/backdrop.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "platform/camera.h"
#include "platform/codecs.h"

namespace nt {
namespace {

// The middle of the picture that has the pane's shape, in the pane's size.
cv::Mat fitted(const std::string& path, const Pane& pane) {
  const cv::Mat bgr = codecs().read_picture(path, cv::IMREAD_COLOR);
  if (bgr.empty()) throw UserError("--backdrop: cannot read the picture " + path);
  const double scale =
      std::min(bgr.cols / static_cast<double>(pane.width), bgr.rows / static_cast<double>(pane.height));
  const int width = std::clamp(static_cast<int>(std::lround(scale * pane.width)), 1, bgr.cols);
  const int height = std::clamp(static_cast<int>(std::lround(scale * pane.height)), 1, bgr.rows);
  const cv::Rect middle((bgr.cols - width) / 2, (bgr.rows - height) / 2, width, height);
  cv::Mat small, rgb;
  cv::resize(bgr(middle), small, {pane.width, pane.height}, 0, 0, scale > 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::cvtColor(small, rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

}  // namespace

BackdropOption parse_backdrop(const std::string& text) {
  using Kind = BackdropOption::Kind;
  if (text == "camera") return {Kind::camera, kWater, ""};
  if (text.starts_with("#")) return {Kind::colour, parse_colour(text), ""};
  if (std::filesystem::is_regular_file(text)) return {Kind::picture, kWater, text};
  throw UserError(
      "--backdrop must be a colour such as #1B4B5A, a picture, or camera; there is no picture '" + text + "'", 2);
}

void add_backdrop_option(CLI::App& command, const std::function<void(const BackdropOption&)>& take) {
  command
      .add_option_function<std::string>(
          "--backdrop", [take](const std::string& text) { take(parse_backdrop(text)); },
          "behind the character: a colour (#RRGGBB, default #1B4B5A), a picture, or camera: the camera's picture with "
          "the fish painted over")
      ->type_name("COLOUR|FILE|camera");
}

Backdrop::Backdrop(const BackdropOption& option, const Pane& pane) : pane_(pane), colour_(option.colour) {
  if (option.kind == BackdropOption::Kind::camera)
    throw UserError("--backdrop camera: a take holds no pictures; name a colour or a picture", 2);
  show_picture(option);
}

void Backdrop::show_picture(const BackdropOption& option) {
  picture_.id = kBackdropPicture;
  if (option.kind == BackdropOption::Kind::picture) {
    rgb_ = fitted(option.path, pane_);
    picture_.pixels = rgb_.data;
    picture_.width = rgb_.cols, picture_.height = rgb_.rows, picture_.stride = static_cast<int>(rgb_.step);
    picture_.format = PixelFormat::rgb8, picture_.revision = 1;
  }
}

Backdrop::Backdrop(const BackdropOption& option, const Pane& pane, Session& session)
    : pane_(pane), colour_(option.colour) {
  show_picture(option);
  if (option.kind == BackdropOption::Kind::camera) {
    plate_.emplace(session.info().width, session.info().height);
    // Before an even field the fish may never leave its place: then the median shows it, and the field itself is easily filled in.
    if (std::strcmp(session.capture().background_name(), "backlit") != 0) plate_->learn(session.camera());
  }
}

void Backdrop::update(const Observation& seen) {
  if (!plate_ || seen.picture.pixels == nullptr) return;
  plate_->update(seen.picture, seen.around_fish, seen.foreground);
  const uint32_t id = picture_.id;
  picture_ = plate_->picture();
  picture_.id = id;
}

void Backdrop::draw(Scene& scene) const {
  if (picture_.pixels == nullptr) return;
  scene.image(picture_, pane_.corner, {static_cast<float>(pane_.width), static_cast<float>(pane_.height)});
}

}  // namespace nt
