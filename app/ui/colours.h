// SPDX-License-Identifier: Apache-2.0
// Colours of the app, and colours typed by a user.
#pragma once
#include <string>

#include "core/scene/scene.h"

namespace nt {

inline constexpr Colour kWater{0x1B / 255.0f, 0x4B / 255.0f, 0x5A / 255.0f, 1};  // the default backdrop

Colour parse_colour(const std::string& text);  // "#RRGGBB"; throws UserError (exit code 2)

}  // namespace nt
