// SPDX-License-Identifier: Apache-2.0
#include "core/segment/first_sight.h"

#include "core/base/det_math.h"
#include "core/segment/clean.h"
#include "core/segment/difference.h"
#include "core/segment/field.h"
#include "core/segment/target.h"

namespace nt {
namespace {

constexpr float kStandsOut = 3.0f;  // standard deviations of the ground
constexpr int kLeastContrast = 24;  // grey levels
constexpr int kOpen = 5;            // pebbles and lines of light are smaller or thinner
constexpr float kFishLike = 0.5f;   // of fish_likeness: a straight or bent fish has 0.7 and more
constexpr float kLargest = 0.2f;    // of the frame
constexpr int kMostBlobs = 48;      // more than that is a pattern, not fish
constexpr float kGrow = 0.4f;       // standard deviations of the blob's length: a tenth of the fish, for fins and tail
constexpr float kStirred = 0.75f;   // pixels that the centroid has moved
constexpr float kChangedArea = 0.06f;  // share by which the area has changed

void mark_difference(LumaView luma, const FieldSurface& surface, int threshold, const BitMask& mask) {
  constexpr int kPart = 512;  // whole mask words
  uint8_t level[kPart];
  for (int y = 0; y < luma.height; ++y) {
    for (int x = 0; x < luma.width; x += kPart) {
      const int n = min_int(kPart, luma.width - x);
      surface.draw(x, y, n, level);
      mask_of_difference({luma.row(y) + x, n, 1, n}, {level, n, 1, n}, threshold, 0,
                         {mask.row(y) + x / 64, n, 1, words_for(n)});
    }
  }
}

void paint_runs(std::span<const Run> runs, int label, const BitMask& mask) {
  for (const Run& run : runs)
    for (int x = run.x0; run.label == label && x < run.x1; ++x) mask.set(x, run.y);
}

// Grows `mask` by at least r pixels (1, 3, 7, 15, 31 or 63).
void grow_by(int r, const BitMask& mask, const BitMask& scratch) {
  int step = 1;
  for (int reached = 0; reached < r && step <= 32; reached += step, step *= 2) {
    spread(mask, scratch, step);
    for (int i = 0; i < mask.words_per_row * mask.height; ++i) mask.words[i] = scratch.words[i];
  }
}

bool like_a_fish(const Blob& blob, LumaView luma) {
  const float frame = static_cast<float>(luma.width) * static_cast<float>(luma.height);
  return !blob.touches_edge && static_cast<float>(blob.area_px) < kLargest * frame && fish_likeness(blob) > kFishLike;
}

}  // namespace

int FirstSight::find(LumaView luma, int min_area_px, Blobs& blobs, const BitMask& raw, const BitMask& scratch,
                     const BitMask& fish) {
  *this = FirstSight{};
  clear_mask(fish);
  const FieldSurface surface = fit_field(luma);
  const float sigma = measure_field(luma, surface).sigma;
  mark_difference(luma, surface, clamp_int(static_cast<int>(kStandsOut * sigma), kLeastContrast, 255), raw);
  open_mask(raw, scratch, fish, kOpen);
  blobs.find(fish, min_area_px);
  clear_mask(fish);
  if (static_cast<int>(blobs.blobs().size()) > kMostBlobs) return 0;
  float longest = 0;
  for (int i = 0; i < static_cast<int>(blobs.blobs().size()) && count_ < kMostFish; ++i) {
    const Blob& blob = blobs.blobs()[static_cast<std::size_t>(i)];
    if (!like_a_fish(blob, luma)) continue;
    paint_runs(blobs.runs(), i, fish);
    longest = det::max(longest, blob.major_px);
    suspects_[static_cast<std::size_t>(count_++)].box = blob.box;
  }
  if (count_ > 0) grow_by(static_cast<int>(kGrow * longest), fish, scratch);
  return count_;
}

int FirstSight::lifeless(std::span<const Blob> blobs) {
  if (count_ == 0) return -1;
  const bool judged = ++frames_ >= kTrialFrames;
  int found = -1;
  for (Suspect& s : std::span(suspects_).first(static_cast<std::size_t>(count_))) {
    for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
      const Blob& blob = blobs[static_cast<std::size_t>(i)];
      const Vec2 c = blob.centroid;
      if (c.x < static_cast<float>(s.box.x0) || c.x >= static_cast<float>(s.box.x1) ||
          c.y < static_cast<float>(s.box.y0) || c.y >= static_cast<float>(s.box.y1))
        continue;
      if (s.seen++ == 0) s.least = s.most = c, s.least_area = s.most_area = blob.area_px;
      s.least = {det::min(s.least.x, c.x), det::min(s.least.y, c.y)};
      s.most = {det::max(s.most.x, c.x), det::max(s.most.y, c.y)};
      s.least_area = min_int(s.least_area, blob.area_px), s.most_area = max_int(s.most_area, blob.area_px);
      const bool stirred =
          s.most.x - s.least.x > kStirred || s.most.y - s.least.y > kStirred ||
          static_cast<float>(s.most_area - s.least_area) > kChangedArea * static_cast<float>(s.most_area);
      if (judged && !stirred) found = i;
      break;
    }
  }
  if (judged && found < 0) count_ = 0;  // the trial is over
  return found;
}

}  // namespace nt
