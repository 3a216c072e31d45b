// SPDX-License-Identifier: Apache-2.0
// Writes a take while capture runs: frames go into a fixed ring, a thread of its own commits them once a period.
//
// add() never waits and never allocates: a slow disk fills the ring and then frames are counted as not recorded,
// but capture goes on. A run faster than real time is committed whenever half the ring is full. When the disk fails the thread stops, says so once in failure(), and what was
// committed stays. finish() writes the rest and closes the file; after a kill the take holds all but the last period.
// The first frames of a recording may come from a PreRecord: the past few seconds.
#pragma once
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/take/take.h"

namespace nt {

class TakeRecorder {
 public:
  static constexpr int kRingFrames = 2048;
  static constexpr int kPeriod_ms = 900;  // with the commit itself no more than a second is lost
  // Throws UserError when the file cannot be made. `period_ms` between two commits. `past`: frames that come first.
  TakeRecorder(const std::string& path, const TakeInfo& info, int period_ms = kPeriod_ms,
               std::vector<TakeFrame> past = {});
  ~TakeRecorder();
  TakeRecorder(const TakeRecorder&) = delete;
  TakeRecorder& operator=(const TakeRecorder&) = delete;

  void add(const TakeFrame& frame);
  // Stored with the next frames; allocates. Seldom: a few a recording.
  void add_thumbnail(Thumbnail thumbnail);
  int64_t not_recorded() const { return not_recorded_; }
  std::string failure();  // one line; empty while all is well
  void finish();          // throws UserError with failure()'s line

 private:
  void store();
  void commit();
  bool half_full() const;

  Take take_;
  std::vector<TakeFrame> ring_, batch_, past_;
  std::vector<Thumbnail> thumbnails_;             // not yet stored
  std::atomic<uint64_t> written_{0}, stored_{0};  // frames put in, frames taken out
  std::atomic<bool> stop_{false}, failed_{false};
  int64_t not_recorded_ = 0;
  int period_ms_;
  std::mutex mutex_;  // of failure_, thumbnails_ and of the thread's sleep
  std::condition_variable wake_;
  std::string failure_;
  std::thread thread_;
};

// The last frames seen, for a recording that begins before its key was pressed.
class PreRecord {
 public:
  explicit PreRecord(int frames) : ring_(static_cast<std::size_t>(frames)) {}
  void add(const TakeFrame& frame);
  void clear() { count_ = 0; }
  std::vector<TakeFrame> frames() const;  // oldest first

 private:
  std::vector<TakeFrame> ring_;
  uint64_t count_ = 0;
};

}  // namespace nt
