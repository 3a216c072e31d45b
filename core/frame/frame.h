// SPDX-License-Identifier: Apache-2.0
// One picture from a camera, as core sees it. The platform owns the pixels until the step returns.
#pragma once
#include <cstdint>

#include "core/base/image_view.h"

namespace nt {

struct Frame {
  LumaView luma;        // 8-bit grey, full range
  LumaView cb{}, cr{};  // chroma of 2 x 2 blocks, so half the luma's size rounded up, 128 = grey; empty without colour
  uint64_t sequence = 0;     // the camera's own count; a gap means dropped frames
  int64_t timestamp_ns = 0;  // monotonic, the camera's clock
};

}  // namespace nt
