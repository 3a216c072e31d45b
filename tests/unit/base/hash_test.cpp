// SPDX-License-Identifier: Apache-2.0
#include "core/base/hash.h"

#include <gtest/gtest.h>

// Vectors of the FNV authors (Fowler, Noll, Vo; IETF draft, 64-bit FNV-1a).
TEST(Hash, MatchesThePublishedVectors) {
  EXPECT_EQ(nt::hash_bytes("", 0), 0xcbf29ce484222325ull);
  EXPECT_EQ(nt::hash_bytes("a", 1), 0xaf63dc4c8601ec8cull);
  EXPECT_EQ(nt::hash_bytes("foobar", 6), 0x85944171f73967e8ull);
}

TEST(Hash, TakesIntegersLowByteFirst) {
  const unsigned char bytes[8] = {0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11};
  EXPECT_EQ(nt::hash_u64(0x1122334455667788ull, nt::kHashSeed), nt::hash_bytes(bytes, sizeof bytes));
}
