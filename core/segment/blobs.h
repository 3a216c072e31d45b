// SPDX-License-Identifier: Apache-2.0
// Connected components of a bit-packed mask, 8-connected.
//
// mask -> runs (horizontal, labelled) -> blobs (area, box, centroid, second moments). Blobs smaller than `min_area_px`
// are dropped and their runs get label -1.
// Method: runs joined by union-find with the row above (one pass), then one pass that sums per component.
// Cost: one bit scan over the words plus O(runs); 0.01 ms at 960x544 on a clean mask.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/image_view.h"
#include "core/base/limits.h"
#include "core/base/vec2.h"

namespace nt {

struct Run {
  int16_t y, x0, x1;  // x0 <= x < x1
  int32_t label;      // index into blobs, or -1
};

struct Blob {
  Box box;
  int area_px = 0;
  Vec2 centroid;
  float major_px = 0;  // standard deviations along the principal axes of its pixels
  float minor_px = 0;
  bool touches_edge = false;
  bool ghost = false;  // nothing is there: the background remembers something that is gone
};

class Blobs {
 public:
  static Blobs* create(Arena& arena, const Limits& limits);  // null when measuring
  // False when runs or blobs were dropped for want of room: runs_dropped() / blobs_dropped() say which.
  bool find(const BitMask& mask, int min_area_px);
  std::span<const Blob> blobs() const { return blobs_.first(static_cast<std::size_t>(blob_count_)); }
  void mark_ghost(int label) { blobs_[static_cast<std::size_t>(label)].ghost = true; }
  std::span<const Run> runs() const { return runs_.first(static_cast<std::size_t>(run_count_)); }
  bool runs_dropped() const { return runs_dropped_; }
  bool blobs_dropped() const { return blobs_dropped_; }

 private:
  void scan(const BitMask& mask);
  void join_with_row_above(int above_begin, int above_end, int begin, int end);
  void sum_up(const BitMask& mask, int min_area_px);
  int root(int i);

  struct Sums {
    int64_t n, x, y, xx, yy, xy;
    Box box;
  };
  std::span<Run> runs_;
  std::span<int32_t> parent_;  // union-find over runs
  std::span<Sums> sums_;       // per component
  std::span<Blob> blobs_;
  int run_count_ = 0, blob_count_ = 0;
  bool runs_dropped_ = false, blobs_dropped_ = false;
};

}  // namespace nt
