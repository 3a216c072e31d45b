// SPDX-License-Identifier: Apache-2.0
// A small character for tests of core, made without a picture: a grid of vertices over a straight fish 200 units long,
// with two fins of four: 33 control points. Bytes as in docs/FORMATS.md, so it goes through open_character like any other.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/support/block.h"

namespace nt::test {

inline constexpr int kFishColumns = 9, kFishRows = 41;
inline constexpr int kFishVertices = kFishColumns * kFishRows;
inline constexpr int kFishTriangles = 2 * (kFishColumns - 1) * (kFishRows - 1);
inline constexpr int kFishControls = 33;

class DrawnFish {
 public:
  DrawnFish();
  std::span<const std::byte> bytes() const { return block_.span(); }

 private:
  Block block_;
};

}  // namespace nt::test
