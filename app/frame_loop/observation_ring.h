// SPDX-License-Identifier: Apache-2.0
// A ring of observations between two threads, with one for their pictures beside it: those are a thousand times as large, so
// there are fewer, and an observation may come without.
#pragma once
#include <atomic>
#include <cstdint>
#include <vector>

#include "app/frame_loop/ring.h"
#include "app/observation.h"

namespace nt {

class ObservationRing {
 public:
  ObservationRing(std::size_t observations, std::size_t pictures) : seen_(observations), pixels_(pictures) {}

  // Of the writer. False when the ring is full. A picture that finds no place is left out.
  bool add(const Observation& seen, const Keep& what);
  // In place of the last one where the ring is full: then false.
  bool add_newest(const Observation& seen, const Keep& what);
  bool wait_free(std::chrono::milliseconds most) { return seen_.wait_free(most); }
  bool wait_picture_free(std::chrono::milliseconds most) { return pixels_.wait_free(most); }

  // Of the reader: the next observation, valid until the next call; null when there is none, and then the last one stays.
  const Observation* next();
  // Lets the last one go, so that the writer has its place.
  void let_go();
  bool wait_filled(std::chrono::milliseconds most) { return seen_.wait_filled(most); }
  void close();
  bool closed() { return seen_.closed(); }
  int64_t pictures_lost() const { return pictures_lost_; }  // that found no place

 private:
  struct Slot {
    KeptObservation seen;
    bool has_pixels = false;
  };
  Ring<Slot> seen_;
  Ring<std::vector<uint8_t>> pixels_;
  Slot* held_ = nullptr;          // the reader's
  bool last_has_pixels_ = false;  // the writer's
  std::atomic<int64_t> pictures_lost_{0};
};

}  // namespace nt
