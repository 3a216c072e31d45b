// SPDX-License-Identifier: Apache-2.0
#include "app/ui/colours.h"

#include <charconv>

#include "platform/camera.h"

namespace nt {

Colour parse_colour(const std::string& text) {
  unsigned rgb = 0;
  const char* end = text.data() + text.size();
  const bool shaped = text.size() == 7 && text[0] == '#';
  if (!shaped || std::from_chars(text.data() + 1, end, rgb, 16).ptr != end) {
    throw UserError("--backdrop must be a colour such as #1B4B5A, not '" + text + "'", 2);
  }
  const auto part = [rgb](unsigned shift) { return static_cast<float>(rgb >> shift & 0xffu) / 255.0f; };
  return {part(16), part(8), part(0), 1};
}

}  // namespace nt
