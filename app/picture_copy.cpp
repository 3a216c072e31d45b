// SPDX-License-Identifier: Apache-2.0
#include "app/picture_copy.h"

#include <cstring>

namespace nt {

Picture copied(Picture picture, std::vector<uint8_t>& pixels) {
  if (picture.pixels == nullptr) return picture;
  const std::size_t row =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(channels_of(picture.format));
  pixels.resize(row * static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y) {
    std::memcpy(pixels.data() + row * static_cast<std::size_t>(y),
                picture.pixels + static_cast<std::ptrdiff_t>(y) * picture.stride, row);
  }
  picture.pixels = pixels.data();
  picture.stride = static_cast<int>(row);
  return picture;
}

}  // namespace nt
