// SPDX-License-Identifier: Apache-2.0
#include "core/segment/part.h"

#include "core/segment/clean.h"

namespace nt {
namespace {

// Pixels of one blob that the mask holds.
void paint(std::span<const Run> runs, int label, const Box& box, const BitMask& within, const BitMask& out) {
  for (const Run& run : runs) {
    if (run.label != label || run.y < box.y0 || run.y >= box.y1) continue;
    for (int x = max_int(run.x0, box.x0); x < min_int(run.x1, box.x1); ++x)
      if (within.at(x - box.x0, run.y - box.y0)) out.set(x - box.x0, run.y - box.y0);
  }
}

// One ring more, along `within` and not into `taken`; false when nothing was won.
bool win_ring(const BitMask& side, const BitMask& within, const BitMask& taken, const BitMask& scratch) {
  dilate3(side, scratch);
  uint64_t won = 0;
  for (int i = 0; i < side.words_per_row * side.height; ++i) {
    const uint64_t next = scratch.words[i] & within.words[i] & ~taken.words[i];
    won |= next & ~side.words[i];
    side.words[i] |= next;
  }
  return won != 0;
}

}  // namespace

void part_from_others(const BitMask& fish, const Box& box, std::span<const Run> runs, int mine,
                      std::span<const int> others, std::span<uint64_t> scratch_a, std::span<uint64_t> scratch_b,
                      std::span<uint64_t> scratch_c) {
  BitMask ours = fish, theirs = fish, scratch = fish;
  ours.words = scratch_a.data(), theirs.words = scratch_b.data(), scratch.words = scratch_c.data();
  clear_mask(ours);
  clear_mask(theirs);
  paint(runs, mine, box, fish, ours);
  for (const int other : others) paint(runs, other, box, fish, theirs);
  for (bool won = true; won;) {
    won = win_ring(ours, fish, theirs, scratch);
    won = win_ring(theirs, fish, ours, scratch) || won;
  }
  for (int i = 0; i < fish.words_per_row * fish.height; ++i) fish.words[i] = ours.words[i];
}

}  // namespace nt
