// SPDX-License-Identifier: Apache-2.0
// A take swum by characters, as pictures: numbered PNG files with alpha, and a sprite sheet.
//
// PNG: one file a frame, noon.png becomes noon-00000.png, noon-00001.png, ...; the size of the troupe's pane, transparent where
// nobody is. Sprite sheet: one PNG with all frames of one character in equal cells, the fish on the spot with its head up,
// and beside it a JSON file in the layout of TexturePacker's and Aseprite's arrays (docs/FORMATS.md) with the fish's path, so
// that a game can move it. Cost: drawing and encoding; a sheet is held in memory.
#pragma once
#include <string>

#include "app/take/troupe.h"

namespace nt {

struct PngSeries {
  std::string first_file;
  std::size_t frames = 0;  // fewer than there are after Ctrl-C
};
PngSeries write_png_series(const std::string& path, Troupe& troupe, const Pane& pane);

struct SpriteSheet {
  std::string json_path;
  int width = 0, height = 0, cell_width = 0, cell_height = 0, columns = 0;
};
inline constexpr int kMostSheetPixels = 16384;  // a side; more is refused by most graphics cards

// `length_px`: of the fish in the sheet.
SpriteSheet write_sprites(const std::string& path, const EditedTake& take, const Performance& performance,
                          const Wardrobe& wardrobe, double length_px);

}  // namespace nt
