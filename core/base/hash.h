// SPDX-License-Identifier: Apache-2.0
// FNV-1a, 64 bits: the fingerprint of a stage's output, compared between machines. Not for security.
#pragma once
#include <cstddef>
#include <cstdint>

namespace nt {

inline constexpr uint64_t kHashSeed = 0xcbf29ce484222325ull;

inline uint64_t hash_bytes(const void* data, std::size_t size, uint64_t seed = kHashSeed) {
  const auto* p = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) seed = (seed ^ p[i]) * 0x100000001b3ull;
  return seed;
}

// Integers are hashed by value, low byte first, so the byte order of the machine does not matter.
inline uint64_t hash_u64(uint64_t v, uint64_t seed) {
  for (int i = 0; i < 8; ++i, v >>= 8) seed = (seed ^ (v & 0xff)) * 0x100000001b3ull;
  return seed;
}

}  // namespace nt
