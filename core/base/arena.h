// SPDX-License-Identifier: Apache-2.0
// A bump allocator over one block that the platform hands in. Nothing is ever freed one by one.
//
// The same layout code runs twice: once over a measuring arena (no memory, it only counts), which makes
// `bytes_needed` exact by construction, and once over the real block.
// Every span starts on a 64-byte line, so rows can be read by SIMD lanes without a special first case.
#pragma once
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

namespace nt {

inline constexpr std::size_t kAlignment = 64;

constexpr std::size_t align_up(std::size_t n, std::size_t to = kAlignment) { return (n + to - 1) / to * to; }

class Arena {
 public:
  // A measuring arena: hands out empty spans and counts what a real one would need.
  Arena() = default;
  // `memory` must start on a 64-byte line.
  explicit Arena(std::span<std::byte> memory) : base_(memory.data()), size_(memory.size()) {}

  bool measuring() const { return base_ == nullptr; }
  std::size_t used() const { return used_; }
  std::size_t high_water() const { return high_water_; }
  std::size_t capacity() const { return size_; }
  // True once a request did not fit; from then on the spans handed out are empty.
  bool full() const { return full_; }

  // `count` zero-initialised elements, or an empty span when measuring or full.
  template <class T>
  std::span<T> take(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>, "an arena runs no destructors");
    std::byte* at = bump(count * sizeof(T));
    if (at == nullptr) return {};
    T* first = reinterpret_cast<T*>(at);
    for (std::size_t i = 0; i < count; ++i) new (first + i) T{};
    return {first, count};
  }
  // As take, but leaves the bytes as they are: for scratch that is written before it is read.
  template <class T>
  std::span<T> take_raw(std::size_t count) {
    static_assert(std::is_trivial_v<T>);
    std::byte* at = bump(count * sizeof(T));
    return at == nullptr ? std::span<T>{} : std::span<T>{reinterpret_cast<T*>(at), count};
  }
  // Gives back everything; the high-water mark stays.
  void rewind() { used_ = 0, full_ = false; }

 private:
  std::byte* bump(std::size_t bytes) {
    const std::size_t end = used_ + align_up(bytes);
    if (base_ == nullptr) {
      used_ = end;
      return nullptr;
    }
    if (full_ || end > size_) {
      full_ = true;
      return nullptr;
    }
    std::byte* at = base_ + used_;
    used_ = end;
    high_water_ = used_ > high_water_ ? used_ : high_water_;
    return at;
  }

  std::byte* base_ = nullptr;
  std::size_t size_ = 0;
  std::size_t used_ = 0;
  std::size_t high_water_ = 0;
  bool full_ = false;
};

}  // namespace nt
