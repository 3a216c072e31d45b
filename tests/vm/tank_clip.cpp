// SPDX-License-Identifier: Apache-2.0
// tank_clip SCENE WIDTH HEIGHT FRAMES FOLDER: a clip of the simulated tank, twice.
//
// FOLDER/clip.yuyv: raw pictures, as a camera sends them: YUYV, luma from 16 to 235. FOLDER/pictures/NNNN.pgm: the luma that
// a camera of ours makes of them, from 0 to 255. So a capture of the pictures and one of the camera see the same bytes.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "platform/linux/luma_rows.h"
#include "platform/sim/tank.h"

namespace {

void write(std::ofstream& file, const std::vector<uint8_t>& bytes) {
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: tank_clip SCENE WIDTH HEIGHT FRAMES FOLDER\n");
    return 2;
  }
  nt::TankSettings settings;
  settings.scene = argv[1];
  settings.width = std::atoi(argv[2]), settings.height = std::atoi(argv[3]);
  const int frames = std::atoi(argv[4]);
  const std::filesystem::path folder = argv[5];
  std::filesystem::create_directories(folder / "pictures");
  nt::Tank tank(settings);
  std::ofstream clip(folder / "clip.yuyv", std::ios::binary);
  const auto pixels = static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  std::vector<uint8_t> yuyv(2 * pixels, 128), grey(pixels);
  for (int n = 0; n < frames; ++n) {
    const nt::LumaView luma = tank.render_next();
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto width = static_cast<std::size_t>(settings.width);
      const int value = luma.row(static_cast<int>(i / width))[i % width];
      yuyv[2 * i] = static_cast<uint8_t>(16 + (219 * value + 127) / 255);
      grey[i] = nt::spread_luma(yuyv[2 * i]);
    }
    write(clip, yuyv);
    char name[32];
    std::snprintf(name, sizeof name, "%04d.pgm", n);
    std::ofstream picture(folder / "pictures" / name, std::ios::binary);
    picture << "P5\n" << settings.width << " " << settings.height << "\n255\n";
    write(picture, grey);
    if (!picture.flush()) clip.setstate(std::ios::failbit);
  }
  if (clip.flush()) return 0;
  std::fprintf(stderr, "tank_clip: cannot write %s\n", folder.c_str());
  return 1;
}
