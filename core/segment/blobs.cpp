// SPDX-License-Identifier: Apache-2.0
#include "core/segment/blobs.h"

#include <bit>

#include "core/base/det_math.h"

namespace nt {
namespace {

// Next bit at or after x that equals `set`, or width.
int next_bit(const uint64_t* row, int x, int width, bool set) {
  while (x < width) {
    uint64_t word = set ? row[x >> 6] : ~row[x >> 6];
    word >>= x & 63;
    if (word != 0) return min_int(x + std::countr_zero(word), width);
    x = (x | 63) + 1;
  }
  return width;
}

}  // namespace

Blobs* Blobs::create(Arena& arena, const Limits& limits) {
  auto self = arena.take<Blobs>(1);
  const auto runs = static_cast<std::size_t>(max_int(limits.max_runs, 0));
  const auto blobs = static_cast<std::size_t>(max_int(limits.max_blobs, 0));
  auto run_space = arena.take<Run>(runs);
  auto parents = arena.take<int32_t>(runs);
  auto sums = arena.take<Sums>(blobs);
  auto blob_space = arena.take<Blob>(blobs);
  if (self.empty() || arena.full()) return nullptr;
  self[0].runs_ = run_space;
  self[0].parent_ = parents;
  self[0].sums_ = sums;
  self[0].blobs_ = blob_space;
  return &self[0];
}

int Blobs::root(int i) {
  while (parent_[static_cast<std::size_t>(i)] != i) {
    int32_t& p = parent_[static_cast<std::size_t>(i)];
    p = parent_[static_cast<std::size_t>(p)];
    i = p;
  }
  return i;
}

void Blobs::join_with_row_above(int above_begin, int above_end, int begin, int end) {
  int a = above_begin;
  for (int i = begin; i < end; ++i) {
    const Run& run = runs_[static_cast<std::size_t>(i)];
    // 8-connected: a run above touches when it overlaps [x0 - 1, x1 + 1).
    while (a < above_end && runs_[static_cast<std::size_t>(a)].x1 < run.x0) ++a;
    for (int b = a; b < above_end && runs_[static_cast<std::size_t>(b)].x0 <= run.x1; ++b) {
      const int p = root(b), q = root(i);
      parent_[static_cast<std::size_t>(max_int(p, q))] = min_int(p, q);
    }
  }
}

void Blobs::scan(const BitMask& mask) {
  int above_begin = 0, above_end = 0;
  for (int y = 0; y < mask.height; ++y) {
    const uint64_t* row = mask.row(y);
    const int begin = run_count_;
    for (int x = next_bit(row, 0, mask.width, true); x < mask.width;) {
      const int end = next_bit(row, x, mask.width, false);
      if (run_count_ >= static_cast<int>(runs_.size())) {
        runs_dropped_ = true;
        join_with_row_above(above_begin, above_end, begin, run_count_);
        return;
      }
      runs_[static_cast<std::size_t>(run_count_)] = {static_cast<int16_t>(y), static_cast<int16_t>(x),
                                                     static_cast<int16_t>(end), -1};
      parent_[static_cast<std::size_t>(run_count_)] = run_count_;
      ++run_count_;
      x = next_bit(row, end, mask.width, true);
    }
    join_with_row_above(above_begin, above_end, begin, run_count_);
    above_begin = begin, above_end = run_count_;
  }
}

void Blobs::sum_up(const BitMask& mask, int min_area_px) {
  int components = 0;
  for (int i = 0; i < run_count_; ++i) {
    Run& run = runs_[static_cast<std::size_t>(i)];
    const int r = root(i);
    if (r == i) {  // the first run of its component, as roots are the smallest index
      if (components >= static_cast<int>(sums_.size())) {
        blobs_dropped_ = true;
        continue;
      }
      run.label = components++;
      sums_[static_cast<std::size_t>(run.label)] = {0, 0, 0, 0, 0, 0, {run.x0, run.y, run.x1, run.y + 1}};
    } else {
      run.label = runs_[static_cast<std::size_t>(r)].label;
    }
    if (run.label < 0) continue;
    Sums& s = sums_[static_cast<std::size_t>(run.label)];
    const int64_t n = run.x1 - run.x0, a = run.x0, b = run.x1 - 1, y = run.y;
    const int64_t x = (a + b) * n / 2;
    s.n += n, s.x += x, s.y += y * n, s.xy += x * y, s.yy += y * y * n;
    s.xx += (b * (b + 1) * (2 * b + 1) - (a - 1) * a * (2 * a - 1)) / 6;
    s.box.x0 = min_int(s.box.x0, run.x0), s.box.x1 = max_int(s.box.x1, run.x1);
    s.box.y1 = run.y + 1;
  }
  // Keep the large ones; sums_ is reused as the map from component to blob, through its n.
  for (int c = 0; c < components; ++c) {
    Sums& s = sums_[static_cast<std::size_t>(c)];
    if (s.n < min_area_px) {
      s.n = -1;
      continue;
    }
    Blob& blob = blobs_[static_cast<std::size_t>(blob_count_)];
    const double n = static_cast<double>(s.n), mx = static_cast<double>(s.x) / n, my = static_cast<double>(s.y) / n;
    const double cxx = static_cast<double>(s.xx) / n - mx * mx, cyy = static_cast<double>(s.yy) / n - my * my;
    const double cxy = static_cast<double>(s.xy) / n - mx * my;
    const double half = det::sqrt(0.25 * (cxx - cyy) * (cxx - cyy) + cxy * cxy);
    const double mean = 0.5 * (cxx + cyy);
    blob = {};
    blob.box = s.box;
    blob.area_px = static_cast<int>(s.n);
    blob.centroid = {static_cast<float>(mx), static_cast<float>(my)};
    blob.major_px = static_cast<float>(det::sqrt(mean + half));
    blob.minor_px = static_cast<float>(det::sqrt(mean - half > 0 ? mean - half : 0));
    blob.touches_edge = s.box.x0 == 0 || s.box.y0 == 0 || s.box.x1 == mask.width || s.box.y1 == mask.height;
    s.n = blob_count_++;
  }
  for (int i = 0; i < run_count_; ++i) {
    Run& run = runs_[static_cast<std::size_t>(i)];
    if (run.label >= 0) run.label = static_cast<int32_t>(sums_[static_cast<std::size_t>(run.label)].n);
  }
}

bool Blobs::find(const BitMask& mask, int min_area_px) {
  run_count_ = blob_count_ = 0;
  runs_dropped_ = blobs_dropped_ = false;
  scan(mask);
  sum_up(mask, min_area_px);
  return !runs_dropped_ && !blobs_dropped_;
}

}  // namespace nt
