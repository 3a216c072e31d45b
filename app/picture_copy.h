// SPDX-License-Identifier: Apache-2.0
// A picture's bytes: how many a pixel has, and a copy of them all, rows packed.
#pragma once
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace nt {

constexpr int channels_of(PixelFormat format) {
  return format == PixelFormat::luma8 ? 1 : (format == PixelFormat::rgb8 ? 3 : 4);
}

// Into `pixels`, which is made as large as need be. A picture without pixels stays so.
Picture copied(Picture picture, std::vector<uint8_t>& pixels);

}  // namespace nt
