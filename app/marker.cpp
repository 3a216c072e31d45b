// SPDX-License-Identifier: Apache-2.0
#include "app/marker.h"

#include "platform/codecs.h"

namespace nt {

std::optional<std::array<Vec2, 4>> find_marker(LumaView luma) {
  using Find = bool (*)(const LumaView&, std::array<Vec2, 4>&);
  static const auto find = reinterpret_cast<Find>(codecs_function("neontetra_find_marker"));
  std::array<Vec2, 4> corners;
  if (!find(luma, corners)) return std::nullopt;
  return corners;
}

}  // namespace nt
