// SPDX-License-Identifier: Apache-2.0
// One block of zeroed memory on a 64-byte line, for core's arenas.
#pragma once
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>

#include "core/base/arena.h"

namespace nt {

class AlignedBlock {
 public:
  AlignedBlock() = default;
  explicit AlignedBlock(std::size_t bytes)
      : size_(align_up(bytes)), data_(static_cast<std::byte*>(std::aligned_alloc(kAlignment, size_))) {
    if (data_ == nullptr) throw std::bad_alloc();
    std::memset(data_.get(), 0, size_);  // also touches every page before the first frame
  }
  std::span<std::byte> bytes() const { return {data_.get(), size_}; }

 private:
  struct Free {
    void operator()(std::byte* p) const { std::free(p); }
  };
  std::size_t size_ = 0;
  std::unique_ptr<std::byte, Free> data_;
};

}  // namespace nt
