// SPDX-License-Identifier: Apache-2.0
#include "app/export/take_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "app/export/png.h"
#include "app/export/pose_csv.h"
#include "app/export/report.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/text_file.h"
#include "core/base/det_math.h"
#include "platform/camera.h"
#include "platform/display.h"

namespace nt {
namespace {

constexpr Colour kNothing{0, 0, 0, 0};

std::string numbered(const std::string& path, std::size_t number) {
  const std::filesystem::path whole(path);
  char digits[32];
  std::snprintf(digits, sizeof digits, "-%05zu", number);
  return (whole.parent_path() / (whole.stem().string() + digits + whole.extension().string())).string();
}

Picture as_picture(std::span<const uint8_t> rgba, int width, int height) {
  Picture picture;
  picture.pixels = rgba.data(), picture.width = width, picture.height = height, picture.stride = 4 * width;
  picture.format = PixelFormat::rgba8;
  return picture;
}

// Where a take's fish swims on the spot with its head up.
Performance on_the_spot(Performance performance) {
  for (Sighting& sighting : performance.frames) sighting.motion.centre = {}, sighting.motion.dir_rad = -det::kHalfPi;
  return performance;
}

struct Box {
  float left = 0, top = 0, right = 0, bottom = 0;
};

class Sprites {
 public:
  Sprites(const Performance& performance, const Wardrobe& wardrobe, double length_px)
      : performance_(on_the_spot(performance)), wardrobe_(wardrobe), progress_(2 * count()) {
    pane_.scale = static_cast<float>(length_px) / performance.frames.front().init_len;
  }

  SpriteSheet write(const std::string& path, const Json& head, const EditedTake& take, const Performance& path_of) {
    measure();
    lay_out();
    draw();
    write_png(path, as_picture(pixels_, sheet_.width, sheet_.height));
    sheet_.json_path = std::filesystem::path(path).replace_extension(".json").string();
    write_text(sheet_.json_path, pretty(description(path, head, take, path_of)));
    return sheet_;
  }

 private:
  int count() const { return static_cast<int>(performance_.frames.size()); }

  // What all frames together cover, from the centre, scene pixels.
  void measure() {
    Actor actor(wardrobe_, 0);
    pane_.corner = {-0.5f * pane_.scale, -0.5f * pane_.scale};  // the frame's 0, 0 is the scene's
    perform(actor, performance_, pane_, Before::first_pose, [&](std::size_t i) {
      for (const Vec2 v : actor.retarget().vertices()) {
        box_ = {std::min(box_.left, v.x), std::min(box_.top, v.y), std::max(box_.right, v.x),
                std::max(box_.bottom, v.y)};
      }
      progress_.show(static_cast<int64_t>(i) + 1);
    });
  }

  void lay_out() {
    constexpr float kRim = 2;  // transparent pixels, so that neighbours do not bleed into each other
    pivot_ = {std::ceil(-box_.left + kRim), std::ceil(-box_.top + kRim)};
    sheet_.cell_width = static_cast<int>(pivot_.x + std::ceil(box_.right + kRim));
    sheet_.cell_height = static_cast<int>(pivot_.y + std::ceil(box_.bottom + kRim));
    const double square = std::sqrt(static_cast<double>(count()) * sheet_.cell_height / sheet_.cell_width);
    sheet_.columns = std::clamp(static_cast<int>(std::lround(square)), 1, count());
    sheet_.width = sheet_.columns * sheet_.cell_width;
    sheet_.height = (count() + sheet_.columns - 1) / sheet_.columns * sheet_.cell_height;
    if (std::max(sheet_.width, sheet_.height) > kMostSheetPixels)
      throw UserError(
          "a sprite sheet of " + std::to_string(sheet_.width) + "x" + std::to_string(sheet_.height) +
              " pixels is more than can be used; ask for a lower --rate, a shorter --range or a smaller --length",
          2);
  }

  void draw() {
    pixels_.assign(static_cast<std::size_t>(sheet_.width) * static_cast<std::size_t>(sheet_.height) * 4, 0);
    const std::unique_ptr<Display> display = open_headless_display(sheet_.cell_width, sheet_.cell_height);
    Actor actor(wardrobe_, 0);
    pane_.corner += pivot_;
    Scene scene;
    perform(actor, performance_, pane_, Before::first_pose, [&](std::size_t i) {
      scene.clear(sheet_.cell_width, sheet_.cell_height, kNothing);
      actor.draw(scene);
      display->draw(scene);
      put(i, display->pixels_with_alpha());
      progress_.show(count() + static_cast<int64_t>(i) + 1);
    });
  }

  Vec2 corner(std::size_t i) const {
    const int at = static_cast<int>(i);
    return {static_cast<float>(at % sheet_.columns * sheet_.cell_width),
            static_cast<float>(at / sheet_.columns * sheet_.cell_height)};
  }

  void put(std::size_t i, std::span<const uint8_t> cell) {
    const auto row_bytes = static_cast<std::size_t>(sheet_.cell_width) * 4;
    const auto x = static_cast<std::size_t>(corner(i).x), y = static_cast<std::size_t>(corner(i).y);
    for (std::size_t row = 0; row < static_cast<std::size_t>(sheet_.cell_height); ++row) {
      std::memcpy(&pixels_[((y + row) * static_cast<std::size_t>(sheet_.width) + x) * 4], &cell[row * row_bytes],
                  row_bytes);
    }
  }

  Json description(const std::string& path, const Json& head, const EditedTake& take,
                   const Performance& path_of) const {
    const float scale = static_cast<float>(take.info.source_width) / static_cast<float>(take.info.width);
    const std::string name = std::filesystem::path(path).stem().string();
    const int w = sheet_.cell_width, h = sheet_.cell_height;
    Json frames = Json::array();
    for (std::size_t i = 0; i < performance_.frames.size(); ++i) {
      const Motion& m = path_of.frames[i].motion;
      const Vec2 at = to_source(m.centre, scale);
      frames.push_back(
          {{"filename", name + " " + std::to_string(i)},
           {"frame", {{"x", std::lround(corner(i).x)}, {"y", std::lround(corner(i).y)}, {"w", w}, {"h", h}}},
           {"rotated", false},
           {"trimmed", false},
           {"spriteSourceSize", {{"x", 0}, {"y", 0}, {"w", w}, {"h", h}}},
           {"sourceSize", {{"w", w}, {"h", h}}},
           {"pivot", {{"x", pivot_.x / static_cast<float>(w)}, {"y", pivot_.y / static_cast<float>(h)}}},
           {"duration", std::lround(1000 / path_of.fps)},
           {"path", {{"x", at.x}, {"y", at.y}, {"rotation", m.dir_rad + det::kHalfPi}}}});
    }
    Json meta = head;
    meta["image"] = std::filesystem::path(path).filename().string();
    meta["format"] = "RGBA8888";
    meta["size"] = {{"w", sheet_.width}, {"h", sheet_.height}};
    meta["scale"] = "1";
    meta["fps"] = path_of.fps;  // exact, as durations are whole milliseconds
    meta["frameTags"] = {{{"name", take.info.name}, {"from", 0}, {"to", count() - 1}, {"direction", "forward"}}};
    return {{"frames", frames}, {"meta", meta}};
  }

  Performance performance_;
  const Wardrobe& wardrobe_;
  Progress progress_;
  Pane pane_;
  Box box_;
  Vec2 pivot_;
  SpriteSheet sheet_;
  std::vector<uint8_t> pixels_;
};

}  // namespace

PngSeries write_png_series(const std::string& path, Troupe& troupe, const Pane& pane) {
  const std::unique_ptr<Display> display = open_headless_display(pane.width, pane.height);
  Progress progress(static_cast<int64_t>(troupe.frames()));
  Scene scene;
  std::size_t i = 0;
  for (; i < troupe.frames() && !interrupted(); ++i) {
    troupe.show(i, 1);
    scene.clear(pane.width, pane.height, kNothing);
    troupe.draw(scene);
    display->draw(scene);
    write_png(numbered(path, i), as_picture(display->pixels_with_alpha(), pane.width, pane.height));
    progress.show(static_cast<int64_t>(i) + 1);
  }
  return {numbered(path, 0), i};
}

SpriteSheet write_sprites(const std::string& path, const EditedTake& take, const Performance& performance,
                          const Wardrobe& wardrobe, double length_px) {
  const Json head = {{"app", "neontetra"}, {"version", "1.0"}};
  return Sprites(performance, wardrobe, length_px).write(path, head, take, performance);
}

}  // namespace nt
