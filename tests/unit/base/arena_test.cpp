// SPDX-License-Identifier: Apache-2.0
#include "core/base/arena.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/support/block.h"

namespace {

struct Layout {
  std::span<uint8_t> bytes;
  std::span<float> floats;
};
Layout lay_out(nt::Arena& arena) { return {arena.take<uint8_t>(65), arena.take_raw<float>(3)}; }

}  // namespace

TEST(Arena, MeasuringCountsExactlyWhatARealOneNeeds) {
  nt::Arena measure;
  EXPECT_TRUE(lay_out(measure).bytes.empty());
  EXPECT_EQ(measure.used(), 128u + 64u);

  nt::test::Block block(measure.used());
  nt::Arena arena(block.span());
  const Layout got = lay_out(arena);
  EXPECT_EQ(got.bytes.size(), 65u);
  EXPECT_EQ(got.floats.size(), 3u);
  EXPECT_FALSE(arena.full());

  nt::Arena small(block.span().first(measure.used() - 1));
  EXPECT_EQ(lay_out(small).floats.size(), 0u);
  EXPECT_TRUE(small.full());
}

TEST(Arena, StartsEverySpanOnALineAndZeroesIt) {
  nt::test::Block block(1024);
  for (std::byte& b : block.span()) b = std::byte{0xff};
  nt::Arena arena(block.span());
  (void)arena.take<uint8_t>(1);
  const std::span<uint32_t> words = arena.take<uint32_t>(20);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(words.data()) % nt::kAlignment, 0u);
  for (uint32_t w : words) EXPECT_EQ(w, 0u);
}

TEST(Arena, OnceFullEvenASmallRequestIsRefused) {
  nt::test::Block block(1024);
  nt::Arena arena(block.span());
  EXPECT_TRUE(arena.take<uint8_t>(5000).empty());
  EXPECT_TRUE(arena.take_raw<uint8_t>(1).empty()) << "else a stage would have some of its spans and not the others";
  EXPECT_TRUE(arena.full());
}

TEST(Arena, RewindKeepsTheHighWaterMark) {
  nt::test::Block block(1024);
  nt::Arena arena(block.span());
  (void)arena.take<uint8_t>(500);
  (void)arena.take<uint8_t>(5000);
  EXPECT_TRUE(arena.full());
  arena.rewind();
  EXPECT_FALSE(arena.full());
  EXPECT_EQ(arena.used(), 0u);
  EXPECT_EQ(arena.high_water(), 512u);
  EXPECT_EQ(arena.take<uint8_t>(1024).size(), 1024u);
}
