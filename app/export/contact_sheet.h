// SPDX-License-Identifier: Apache-2.0
// One picture that shows a whole clip: evenly chosen frames of a stream whose length is not known beforehand.
//
// rgb8 frames -> one PNG grid, tiles at most 480 pixels wide, in order from the top left. Frames are kept at a stride that
// doubles whenever twice the wanted number is held, so at the end the choice among them is even to within a stride.
// Cost: one area resize for each frame kept (two in each doubling of the length); memory 2N tiles.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace nt {

class ContactSheet {
 public:
  explicit ContactSheet(int tiles = 12) : tiles_(tiles < 1 ? 1 : tiles) {}
  void add(std::span<const uint8_t> rgb, int width, int height);  // all frames of one size, packed
  // Throws UserError when there was no frame or the file cannot be written.
  void write(const std::string& path) const;
  std::vector<int64_t> chosen() const;  // numbers of the frames that write() shows

 private:
  struct Tile {
    int64_t frame = 0;
    std::vector<uint8_t> rgb;
  };
  std::vector<const Tile*> choice() const;
  void thin_out();

  int tiles_;
  int64_t frames_ = 0, stride_ = 1;
  int tile_width_ = 0, tile_height_ = 0;
  std::vector<Tile> kept_;
};

}  // namespace nt
