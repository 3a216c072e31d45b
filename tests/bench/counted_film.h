// SPDX-License-Identifier: Apache-2.0
// The film that instructions are counted on: of the tank's `calm`, one empty frame for the background to start with, then
// the whole fish; kBefore frames to settle, kCounted to be counted. A file of raw luma, the same on every machine, so that
// whoever counts does not count the drawing of it too.
#pragma once
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/frame/frame.h"
#include "platform/sim/tank.h"

namespace nt {

inline constexpr int kBefore = 80;  // frames after which model, noise and tracking have settled
inline constexpr int kCounted = 16;

struct FilmSize {
  int width, height;
  std::string name() const { return std::to_string(width) + "x" + std::to_string(height); }
};

inline void shoot_film(const std::string& path, FilmSize size) {
  constexpr int kFirst = 100;  // the fish has swum in by then, whole
  Tank tank({.scene = "calm", .seed = 1, .width = size.width, .height = size.height});
  std::ofstream file(path, std::ios::binary);
  for (int n = 0; n < kFirst + kBefore - 1 + kCounted; ++n) {
    const LumaView luma = tank.render_next();
    if (n != 0 && n < kFirst) continue;
    for (int y = 0; y < luma.height; ++y) file.write(reinterpret_cast<const char*>(luma.row(y)), luma.width);
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

class FilmReader {
 public:
  FilmReader(const std::string& path, FilmSize size)
      : file_(path, std::ios::binary),
        size_(size),
        pixels_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}
  // Frame 0, 1, ... kBefore + kCounted - 1; valid until the next call.
  Frame next() {
    if (!file_.read(pixels_.data(), static_cast<std::streamsize>(pixels_.size())))
      throw std::runtime_error("the film is cut short");
    Frame frame;
    frame.luma = {reinterpret_cast<const uint8_t*>(pixels_.data()), size_.width, size_.height, size_.width};
    frame.sequence = static_cast<uint64_t>(count_);
    frame.timestamp_ns = count_++ * 33'333'333ll;
    return frame;
  }

 private:
  std::ifstream file_;
  FilmSize size_;
  std::vector<char> pixels_;
  int64_t count_ = 0;
};

}  // namespace nt
