// SPDX-License-Identifier: Apache-2.0
// A fixed ring between two threads: one fills slots, one empties them, in order. The slots are made once and used again.
//
// The writer asks for a free slot, fills it and pushes it; it is never made to wait unless it asks to. The reader looks at the
// oldest slot for as long as it likes and pops it then. close() wakes both: the writer ends, the reader gets what is left.
// Cost: a lock held for a few nanoseconds; nothing is allocated after the constructor.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace nt {

template <class T>
class Ring {
 public:
  explicit Ring(std::size_t slots) : slots_(slots) {}

  // Of the writer: the slot to fill next; null when all are in use.
  T* free_slot() {
    const std::lock_guard lock(mutex_);
    return written_ - read_ < slots_.size() ? &slots_[written_ % slots_.size()] : nullptr;
  }
  void push() { change(written_); }
  // The slot pushed last is free again; false where the reader may look at it.
  bool take_back() {
    const std::lock_guard lock(mutex_);
    if (written_ - read_ < 2) return false;
    --written_;
    return true;
  }

  // Of the reader: the oldest slot; null when there is none.
  T* oldest() {
    const std::lock_guard lock(mutex_);
    return written_ > read_ ? &slots_[read_ % slots_.size()] : nullptr;
  }
  void pop() { change(read_); }

  std::size_t size() {
    const std::lock_guard lock(mutex_);
    return written_ - read_;
  }
  // Whether something can be written, or read, within that time; a ring that is closed is not waited for.
  bool wait_free(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    moved_.wait_for(lock, most, [this] { return closed_ || written_ - read_ < slots_.size(); });
    return written_ - read_ < slots_.size();
  }
  bool wait_filled(std::chrono::milliseconds most, std::size_t slots = 1) {
    std::unique_lock lock(mutex_);
    moved_.wait_for(lock, most, [&] { return closed_ || written_ - read_ >= slots; });
    return written_ - read_ >= slots;
  }

  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    moved_.notify_all();
  }
  bool closed() {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  void change(uint64_t& count) {
    const std::lock_guard lock(mutex_);
    ++count;
    moved_.notify_all();
  }

  std::vector<T> slots_;
  uint64_t written_ = 0, read_ = 0;  // slots pushed and popped so far
  bool closed_ = false;
  std::mutex mutex_;
  std::condition_variable moved_;
};

}  // namespace nt
