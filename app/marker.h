// SPDX-License-Identifier: Apache-2.0
// A printed AprilTag (family 36h11) in a picture: luma -> its four corners. OpenCV's aruco module does the work,
// in libneontetra_codecs.so: it brings 15 MB of other libraries along.
#pragma once
#include <array>
#include <optional>

#include "core/base/image_view.h"
#include "core/base/vec2.h"

namespace nt {

// In pixels of the picture, sub-pixel, in order around the marker; of the largest one if there are several.
std::optional<std::array<Vec2, 4>> find_marker(LumaView luma);

}  // namespace nt
