// SPDX-License-Identifier: Apache-2.0
// Errors of set-up calls, without exceptions or heap.
//
// Set-up that can fail returns Result<T>; the per-frame step never does, it returns a report with flags.
// A message is a string literal (static storage), so a Status is two words and can be copied anywhere.
#pragma once
#include <cstdint>
#include <utility>

namespace nt {

enum class StatusCode : uint8_t { ok, bad_argument, out_of_memory, bad_data, unsupported };

struct [[nodiscard]] Status {
  StatusCode code = StatusCode::ok;
  const char* message = "";  // static storage; what is wrong and what to do
  bool ok() const { return code == StatusCode::ok; }
};

// A value or the reason why there is none. T must be default-constructible (a pointer or a small view).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Status status) : status_(status) {}
  bool ok() const { return status_.ok(); }
  const Status& status() const { return status_; }
  T& value() { return value_; }
  const T& value() const { return value_; }

 private:
  T value_{};
  Status status_{};
};

}  // namespace nt
