// SPDX-License-Identifier: Apache-2.0
// Colours of windows with buttons: warm paper for the figure, quiet buttons, one accent for what is on.
#pragma once
#include "core/scene/scene.h"

namespace nt {

constexpr Colour rgb(unsigned hex, float a = 1) {
  return {static_cast<float>(hex >> 16 & 0xffu) / 255.0f, static_cast<float>(hex >> 8 & 0xffu) / 255.0f,
          static_cast<float>(hex & 0xffu) / 255.0f, a};
}

inline constexpr Colour kPaper = rgb(0xF3EFE6), kSide = rgb(0xFFFFFF), kShade = rgb(0x20303A, 0.55f);
inline constexpr Colour kInk = rgb(0x22313A), kInkSoft = rgb(0x5B6B74), kInkFaint = rgb(0xA9B4BA),
                        kOnAccent = rgb(0xFFFFFF);
inline constexpr Colour kFace = rgb(0xE6EBEE), kFaceDark = rgb(0xC9D3D9), kFaceOff = rgb(0xF1F3F4);
inline constexpr Colour kAccent = rgb(0x1E7F8C), kAccentDark = rgb(0x145E68);
inline constexpr Colour kMain = rgb(0xE0662F), kMainDark = rgb(0xB84F21);
inline constexpr Colour kTrack = rgb(0xE6EBEE), kGrab = rgb(0xBFD9DD), kGrabDark = rgb(0x9CC6CC);
inline constexpr Colour kPlate = rgb(0x22313A, 0.88f);

// Control points, as in the overlay: head red, tail blue, midline cyan, fin tips green, their roots yellow.
inline constexpr Colour kHeadPoint = rgb(0xE5352B), kTailPoint = rgb(0x2F6BFF), kAxisPoint = rgb(0x21B7D6),
                        kTipPoint = rgb(0x23B04A), kRootPoint = rgb(0xF5C518), kCentrePoint = rgb(0xFFFFFF);
inline constexpr Colour kRim = rgb(0x1B2930), kUnsure = rgb(0xFF7A00), kHeld = rgb(0xFFFFFF);

}  // namespace nt
