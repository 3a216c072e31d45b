// SPDX-License-Identifier: Apache-2.0
// A folder that goes with the test, and small helpers around files in it.
#pragma once
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "platform/camera.h"

namespace nt {

class TempDir {
 public:
  TempDir() {
    std::string name = (std::filesystem::temp_directory_path() / "neontetra_test_XXXXXX").string();
    path_ = mkdtemp(name.data()) != nullptr ? name : std::string();
  }
  ~TempDir() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// What the user would be told; empty when nothing was thrown.
inline std::string user_error(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

// Frame n of a moving picture: a grey ramp from black to white with a red block that moves 4 pixels a frame.
inline std::vector<uint8_t> ramp_frame(int width, int height, int n) {
  std::vector<uint8_t> rgb;
  rgb.reserve(static_cast<std::size_t>(width * height * 3));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool block =
          (x + width - (4 * n) % width) % width < width / 8 && y >= height / 2 && y < height / 2 + height / 8;
      const auto grey = static_cast<uint8_t>(255 * x / (width - 1));
      rgb.insert(rgb.end(), {block ? uint8_t{255} : grey, block ? uint8_t{0} : grey, block ? uint8_t{0} : grey});
    }
  }
  return rgb;
}

}  // namespace nt
