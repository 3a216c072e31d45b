// SPDX-License-Identifier: Apache-2.0
// A disk that is full after so many bytes, for everything that SQLite writes while it lives. One at a time.
#pragma once
#include <cstdint>

namespace nt::test {

class FullDisk {
 public:
  explicit FullDisk(int64_t bytes);
  ~FullDisk();
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
};

}  // namespace nt::test
