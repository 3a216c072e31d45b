// SPDX-License-Identifier: Apache-2.0
// A 64-byte-aligned block for core in tests and benches: what a platform hands to Capture::create.
#pragma once
#include <cstddef>
#include <memory>
#include <new>
#include <span>

#include "core/base/arena.h"

namespace nt::test {

class Block {
 public:
  explicit Block(std::size_t bytes)
      : size_(bytes),
        data_(static_cast<std::byte*>(::operator new (align_up(bytes + 1), std::align_val_t{kAlignment}))) {}
  std::span<std::byte> span() const { return {data_.get(), size_}; }

 private:
  struct Free {
    void operator()(std::byte* p) const { ::operator delete (p, std::align_val_t{kAlignment}); }
  };
  std::size_t size_;
  std::unique_ptr<std::byte, Free> data_;
};

}  // namespace nt::test
