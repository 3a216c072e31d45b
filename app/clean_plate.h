// SPDX-License-Identifier: Apache-2.0
// The camera's picture with the fish painted over: what a drawing swims on in place of the fish.
//
// Camera pictures (luma8 or rgb8) and masks of what is not tank -> a picture of the same size and format, in which every
// pixel of the masks, grown by kMargin, shows the empty tank: the mean of what that pixel showed while it was free (each new
// picture counts a quarter, so it follows the light and loses the noise). A pixel that was never free takes what lies
// to the left and right of it, blended. learn() looks ahead in clips that can be rewound: the median of up to 15
// pictures, which shows the tank wherever the fish does not stay.
// Cost: about 1 ms at 960x544 in colour; learn() as long as decoding 600 frames. No allocation in update().
#pragma once
#include <cstdint>
#include <vector>

#include "core/base/image_view.h"
#include "core/scene/scene.h"
#include "platform/camera.h"

namespace nt {

class CleanPlate {
 public:
  CleanPlate(int width, int height);

  void learn(Camera& camera);  // leaves it rewound
  // Either mask may be empty (no words). Another size than the constructor's is ignored.
  void update(const Picture& camera, const BitMask& first, const BitMask& second);
  // With the fish painted over, as of the last update; null pixels before the first.
  const Picture& picture() const { return picture_; }

 private:
  void merge(const BitMask& first, const BitMask& second);
  void take_word(const uint8_t* from, std::size_t at, int pixels, uint64_t hidden, uint64_t& known);
  void fill_unknown(int y);
  BitMask view(std::vector<uint64_t>& words);

  int width_, height_;
  std::size_t channels_ = 3;
  std::vector<uint8_t> tank_, shown_;
  std::vector<uint64_t> known_, hidden_, scratch_;  // masks, a bit a pixel
  Picture picture_;
};

}  // namespace nt
