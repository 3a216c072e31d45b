// SPDX-License-Identifier: Apache-2.0
// How the camera has moved since a reference picture: small luma -> similarity, and how far it can be trusted.
//
// Method: inverse compositional Gauss-Newton (Baker and Matthews, "Lucas-Kanade 20 years on", IJCV 2004), block by block:
// each 8 x 8 block of the reference says, with its own mean taken away (so light may change), by how much it seems moved;
// a similarity is fitted to what the blocks say by iteratively reweighted least squares. Blocks of fish, of moving
// plants and of what was a fish in the reference disagree and lose their weight.
// Differs: the blocks' normal equations are kept apart, so that outliers are judged in pixels and not in grey levels.
// Frame of reference: pixels of the small pictures, origin at their middle.
// Memory: 8 bytes a small pixel and 80 a block. Cost: about 0.04 ms an iteration at 120x68; 2 to 6 iterations. A search
// costs about 0.5 ms; only frames that are not recognised need one.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/image_view.h"
#include "core/base/similarity.h"

namespace nt {

using SmallView = ImageView<const uint16_t>;

struct Alignment {
  Similarity seen_from_reference;  // about the middle, small pixels
  bool known = false;              // enough blocks with texture are in view, and most of them agree
  int blocks = 0;                  // with texture and in view
  float agreeing = 0;              // share of these that follow the fit to within 0.2 small pixels
  float left = 0;                  // share of the unaligned difference (at the start of the search) that is left
};

class Align {
 public:
  static constexpr int kSide = 8;          // of a block, small pixels
  static constexpr int kFewestBlocks = 8;  // of texture, for any answer

  // For small pictures of width x height.
  static Align* create(Arena& arena, int width, int height);
  Align() = default;

  void set_reference(SmallView picture);
  // `start`: where the search begins, best the motion expected. It ends when a step moves no corner by `close_enough`,
  // small pixels.
  Alignment find(SmallView picture, const Similarity& start, float close_enough);
  // After a jolt: `start`, shifted by whole small pixels to where the picture looks most like the reference.
  Similarity search(SmallView picture, const Similarity& start) const;
  int textured() const { return textured_; }  // blocks of the reference with something to hold on to

 private:
  struct Block {
    float x = 0, y = 0;            // middle, from the picture's middle
    float xx = 0, xy = 0, yy = 0;  // sum of squared gradients, means taken away
    bool textured = false;
    bool in_view = false;
    float bx = 0, by = 0;  // gradient times difference
    float dx = 0, dy = 0;  // the block's own displacement
    float weight = 0;
    float difference = 0;  // sum of squares, mean taken away
  };
  void measure(Block& block, SmallView picture, const Similarity& t) const;
  void look(SmallView picture, const Similarity& t);
  bool fit(double step[4]);
  bool solve(double step[4]) const;
  void start_from_median(double step[4]);
  void weigh(const double step[4]);
  float total_difference() const;
  void judge(Alignment& out) const;
  int corner(int index, bool vertical) const;

  int width_ = 0, height_ = 0;
  int blocks_x_ = 0, blocks_y_ = 0, first_x_ = 0, first_y_ = 0;
  int textured_ = 0;
  std::span<uint16_t> reference_;
  std::span<int16_t> gradient_x_, gradient_y_;  // each block's mean taken away
  std::span<Block> blocks_;
  std::span<float> sorted_;
};

}  // namespace nt
