// SPDX-License-Identifier: Apache-2.0
// Areas of one colour as scene items.
#pragma once
#include "app/character_edit/figure_view.h"
#include "app/ui/pane.h"
#include "core/scene/scene.h"

namespace nt {

inline constexpr uint8_t kWhitePixel[4] = {255, 255, 255, 255};
inline constexpr Picture kPlain{kWhitePixel, 1, 1, 4, PixelFormat::rgba8, kPlainPicture, 1};

inline void add_area(Scene& scene, const Area& area, Colour colour) {
  scene.image(kPlain, area.corner, area.size, colour);
}

}  // namespace nt
