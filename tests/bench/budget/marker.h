// SPDX-License-Identifier: Apache-2.0
// An instruction that does nothing, and that compilers do not emit by themselves: count_plugin knows it when the emulator
// translates it, and ends an interval of its counting there.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace nt::budget {

// aarch64: HINT #110, which no processor has given a meaning. x86-64: a long NOP whose address is never used.
inline constexpr unsigned char kArmMarker[] = {0xdf, 0x2d, 0x03, 0xd5};
inline constexpr unsigned char kX86Marker[] = {0x0f, 0x1f, 0x80, 0x4e, 0x54, 0x42, 0x00};

inline void mark_interval() {
#if defined(__aarch64__)
  asm volatile("hint #110" ::: "memory");
#elif defined(__x86_64__)
  asm volatile(".byte 0x0f, 0x1f, 0x80, 0x4e, 0x54, 0x42, 0x00" ::: "memory");
#endif
}

inline bool is_marker(const void* code, std::size_t bytes) {
  return (bytes == sizeof kArmMarker && std::memcmp(code, kArmMarker, bytes) == 0) ||
         (bytes == sizeof kX86Marker && std::memcmp(code, kX86Marker, bytes) == 0);
}

}  // namespace nt::budget
