// SPDX-License-Identifier: Apache-2.0
#include "core/segment/refine.h"

#include <array>
#include <bit>

#include "core/base/det_math.h"
#include "core/segment/clean.h"
#include "core/segment/difference.h"
#include "core/segment/noise.h"
#include "core/segment/shadow.h"
#include "core/segment/smooth.h"

namespace nt {
namespace {

// Two classes count as two when this share of the variance lies between them; a uniform distribution has 0.75, a fish
// without a shadow in the tank 0.55 to 0.7.
constexpr float kSeparate = 0.78f;
// A shadow keeps the ground's texture: the slope of luma on background equals their ratio. A fin hides part of it.
constexpr float kSameTexture = 0.2f;
// Of fish and shadow together, the part that does not lie under the fish. More than this is the fish itself: a larva whose
// eyes are much darker than the rest of it.
constexpr double kLargestShadow = 0.55;

// The weak mask is not opened, so it falls into more parts than the frame has blobs.
constexpr int kPartsPerBlob = 4;
constexpr int kMostFlicker = 24;  // grey levels; more is no flicker
constexpr float kGlow = 0.12f;    // of the fish's own contrast; its fins have a quarter of it and more:
constexpr float kFaintFin = 0.25f;
constexpr float kNoisy = 4.0f;  // grey levels: from here on the fins of the tank's fish drown in single pixels' noise
constexpr int kRim = 2;         // pixels
constexpr float kBlurred = 0.45f;  // of the noise is left by the blur (0.375), with the background plane's own
LumaView part_of(LumaView whole, const Box& box) {
  return {whole.row(box.y0) + box.x0, box.width(), box.height(), whole.stride};
}

void set_range(const BitMask& mask, int y, int x0, int x1) {
  uint64_t* row = mask.row(y);
  for (int x = x0; x < x1;) {
    const int end = min_int((x | 63) + 1, x1);
    const uint64_t up_to = (end & 63) == 0 ? ~uint64_t{0} : (uint64_t{1} << (end & 63)) - 1;
    row[x >> 6] |= up_to & (~uint64_t{0} << (x & 63));
    x = end;
  }
}

bool any_in_range(const BitMask& mask, int y, int x0, int x1) {
  const uint64_t* row = mask.row(y);
  for (int x = x0; x < x1;) {
    const int end = min_int((x | 63) + 1, x1);
    const uint64_t up_to = (end & 63) == 0 ? ~uint64_t{0} : (uint64_t{1} << (end & 63)) - 1;
    if ((row[x >> 6] & up_to & (~uint64_t{0} << (x & 63))) != 0) return true;
    x = end;
  }
  return false;
}

template <class F>
void combine(const BitMask& out, F&& f) {
  for (int i = 0; i < out.words_per_row * out.height; ++i) out.words[i] = f(i);
}

template <class F>
void for_pixels(const BitMask& mask, F&& f) {
  for (int y = 0; y < mask.height; ++y) {
    for (int i = 0; i < mask.words_per_row; ++i) {
      for (uint64_t word = mask.row(y)[i]; word != 0; word &= word - 1) f(64 * i + std::countr_zero(word), y);
    }
  }
}

// Histogram of |luma - background| over every `step`th row of a mask.
std::array<int, 256> differences(LumaView luma, LumaView background, const BitMask& mask, int step) {
  std::array<int, 256> histogram{};
  for (int y = 0; y < mask.height; y += step) {
    const uint8_t* v = luma.row(y);
    const uint8_t* b = background.row(y);
    for (int i = 0; i < mask.words_per_row; ++i) {
      for (uint64_t word = mask.row(y)[i]; word != 0; word &= word - 1) {
        const int x = 64 * i + std::countr_zero(word), d = v[x] - b[x];
        ++histogram[static_cast<std::size_t>(d < 0 ? -d : d)];
      }
    }
  }
  return histogram;
}

// How much brighter than the background the picture is around the fish, which covers far less than half of the box: a lamp
// that flickers. Less than two levels is the plane's own rounding.
int light_offset(LumaView luma, LumaView background) {
  std::array<int, 511> histogram{};
  int total = 0;
  for (int y = 0; y < luma.height; y += 4) {
    const uint8_t *v = luma.row(y), *b = background.row(y);
    for (int x = 0; x < luma.width; x += 2, ++total) ++histogram[static_cast<std::size_t>(v[x] - b[x] + 255)];
  }
  int median = 0;
  for (int below = histogram[0]; 2 * below < total; below += histogram[static_cast<std::size_t>(median)]) ++median;
  median -= 255;
  return median > -2 && median < 2 ? 0 : clamp_int(median, -kMostFlicker, kMostFlicker);
}

int median_of(const std::array<int, 256>& histogram) {
  int total = 0, median = 0;
  for (int n : histogram) total += n;
  for (int below = histogram[0]; 2 * below < total; below += histogram[static_cast<std::size_t>(median)]) ++median;
  return median;
}

// Slope of luma on background and the ratio of their means over a mask; false when the ground is too plain to tell.
bool texture_kept(LumaView luma, LumaView background, const BitMask& mask) {
  int64_t n = 0, sb = 0, si = 0, sbb = 0, sbi = 0;
  for_pixels(mask, [&](int x, int y) {
    const int64_t b = background.row(y)[x], i = luma.row(y)[x];
    ++n, sb += b, si += i, sbb += b * b, sbi += b * i;
  });
  if (n < 32 || sb == 0) return false;
  const double count = static_cast<double>(n);
  const double variance =
      static_cast<double>(sbb) / count - static_cast<double>(sb) / count * (static_cast<double>(sb) / count);
  const double covariance =
      static_cast<double>(sbi) / count - static_cast<double>(sb) / count * (static_cast<double>(si) / count);
  const double ratio = static_cast<double>(si) / static_cast<double>(sb);
  if (variance < 9.0 || ratio < 0.4 || ratio > 0.95) return false;
  const double slope = covariance / variance;
  return slope > ratio - kSameTexture && slope < ratio + kSameTexture;
}

}  // namespace

Refine* Refine::create(Arena& arena, const Limits& limits) {
  auto self = arena.take<Refine>(1);
  const std::size_t words =
      static_cast<std::size_t>(words_for(limits.max_width)) * static_cast<std::size_t>(limits.max_height);
  std::span<uint64_t> masks[7];
  for (auto& m : masks) m = arena.take_raw<uint64_t>(words);
  auto blurred = arena.take_raw<uint8_t>(static_cast<std::size_t>(limits.max_width) *
                                         static_cast<std::size_t>(limits.max_height) / 3);
  Limits parts = limits;
  parts.max_blobs *= kPartsPerBlob;
  Blobs* blobs = Blobs::create(arena, parts);
  if (self.empty() || blobs == nullptr) return nullptr;
  for (int i = 0; i < 7; ++i) self[0].words_[i] = masks[i];
  self[0].blurred_ = blurred;
  self[0].blobs_ = blobs;
  return &self[0];
}

void Refine::paint_seeds(std::span<const Run> runs, int label, const Box& box, const BitMask& seeds) {
  clear_mask(seeds);
  for (const Run& run : runs) {
    if (run.label == label) set_range(seeds, run.y - box.y0, run.x0 - box.x0, run.x1 - box.x0);
  }
}

// out = the largest connected part of `candidates` among those that hold a seed. False when there is none.
bool Refine::keep_connected(const BitMask& candidates, const BitMask& seeds, const BitMask& out) {
  blobs_->find(candidates, 1);
  runs_dropped_ |= blobs_->runs_dropped(), blobs_dropped_ |= blobs_->blobs_dropped();
  clear_mask(out);
  int best = -1, best_area = 0;
  for (const Run& run : blobs_->runs()) {
    if (run.label < 0) continue;
    const int area = blobs_->blobs()[static_cast<std::size_t>(run.label)].area_px;
    if (area > best_area && any_in_range(seeds, run.y, run.x0, run.x1)) best = run.label, best_area = area;
  }
  for (const Run& run : blobs_->runs()) {
    if (best >= 0 && run.label == best) set_range(out, run.y, run.x0, run.x1);
  }
  return best >= 0;
}

// Pixels of `fish` that are shadow. A shadow darkens the ground a little and keeps its texture; the fish is the class
// farther from the background.
bool Refine::find_shadow(LumaView luma, LumaView background, const BitMask& fish, const BitMask& seeds,
                         const BitMask& bright, const BitMask& dark, const BitMask& shadow) const {
  const OtsuSplit split = otsu(differences(luma, background, fish, 2));
  const BitMask far = shadow;  // first the class farther from the background, then what is left of the dark
  mask_of_difference(luma, background, split.threshold, 0, far);
  int bright_seeds = 0, dark_seeds = 0, found = 0, total = 0;
  combine(shadow, [&](int i) {
    const uint64_t sure = seeds.words[i] & far.words[i];
    total += std::popcount(fish.words[i]);
    bright_seeds += std::popcount(sure & bright.words[i]);
    dark_seeds += std::popcount(sure & dark.words[i]);
    const uint64_t near_and_dark = fish.words[i] & dark.words[i] & ~far.words[i];
    found += std::popcount(near_and_dark);
    return near_and_dark;
  });
  if (found == 0) return false;
  if (bright_seeds > 2 * dark_seeds) return true;  // a bright fish: what is a little darker than the ground is not it
  return found < kLargestShadow * total && split.eta > kSeparate && texture_kept(luma, background, shadow);
}

// Grows what must not be learned by 8 pixels. Not only the fish's rim is half-transparent: where its tail rests on ground
// of the same tone it is in no mask, and a plane that learned it there would show a ghost when it beats again.
void Refine::grow(const BitMask& mask, const BitMask& scratch) const {
  spread(mask, scratch, 1);
  spread(scratch, mask, 2);
  spread(mask, scratch, 4);
  spread(scratch, mask, 1);
}

bool Refine::reaches_border(const BitMask& mask) const {
  const int last = mask.width - 1;
  for (int y = 0; y < mask.height; ++y)
    if (mask.at(0, y) || mask.at(last, y)) return true;
  return any_in_range(mask, 0, 0, mask.width) || any_in_range(mask, mask.height - 1, 0, mask.width);
}

FishMask Refine::fish(LumaView luma, LumaView background, float noise_sigma, const Blob& blob, int label,
                      std::span<const Run> runs, bool remove_shadow, const Background* model) {
  runs_dropped_ = blobs_dropped_ = false;
  FishMask result;
  result.box = blob.box;
  // Room for what the opening and the strong threshold lost: a tail fin, a fin that just opened. Where the fish turns out
  // to reach farther (the blob was but a part of it) the box grows and the step is done again.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const int margin = max_int(16, max_int(result.box.width(), result.box.height()) / 3);
    Box box = grown(result.box, margin, luma.width, luma.height);
    // Whole mask words: rows without partial segments, and the same words as the frame's.
    box.x0 = box.x0 / 64 * 64;
    box.x1 = min_int((box.x1 + 63) / 64 * 64, luma.width);
    const bool whole_frame = box.width() == luma.width && box.height() == luma.height;
    result = fish_in(box, luma, background, noise_sigma, label, runs, remove_shadow, model);
    if (whole_frame || !reaches_border(result.mask)) break;
  }
  return result;
}

FishMask Refine::fish_in(const Box& box, LumaView luma, LumaView background, float noise_sigma, int label,
                         std::span<const Run> runs, bool remove_shadow, const Background* model) {
  FishMask result;
  result.box = box;
  const int w = box.width(), h = box.height(), words = words_for(w);
  const auto mask = [&](int i) { return BitMask{words_[i].data(), w, h, words}; };
  const BitMask seeds = mask(0), bright = mask(1), dark = mask(2), candidates = mask(3), fish = mask(4),
                shadow = mask(5), around = mask(6);
  const LumaView ground = part_of(background, box);
  LumaView here = part_of(luma, box);
  // A box of more than a third of the frame does without: so large a fish is seen through any noise.
  const bool blurred =
      noise_sigma > kNoisy && static_cast<std::size_t>(w) * static_cast<std::size_t>(h) <= blurred_.size();
  if (blurred) {  // then the samples' own noise widens their reach
    const ImageView<uint8_t> calm{blurred_.data(), w, h, w};
    blur_binomial(here, calm);
    here = {calm.data, w, h, w};
    noise_sigma *= kBlurred;
  }

  paint_seeds(runs, label, box, seeds);
  // Above the noise, and above the glow and the lens blur around a fish of high contrast.
  const int contrast = median_of(differences(here, ground, seeds, 4));
  const int weak = max_int(weak_threshold(noise_sigma), static_cast<int>(kGlow * static_cast<float>(contrast)));
  result.fins_may_hide = static_cast<float>(weak) > kFaintFin * static_cast<float>(contrast);
  masks_of_difference(here, ground, weak, light_offset(here, ground), bright, dark);
  combine(candidates, [&](int i) { return bright.words[i] | dark.words[i] | seeds.words[i]; });
  if (model != nullptr) {
    // A vein of light on the ground differs from the estimate, but has been seen before. Only the rim of what is new may
    // hold familiar pixels: there fish and ground mix.
    const int differing = count_bits(candidates);
    model->clear_familiar(here, box.x0, box.y0, blurred ? weak / 2 : weak, candidates);
    // A calm ground's rims are a third of the fish; a surface that ripples is several times as large.
    result.fins_may_hide |= differing > 2 * count_bits(candidates);
    spread(candidates, shadow, kRim);
    combine(candidates, [&](int i) { return (shadow.words[i] & (bright.words[i] | dark.words[i])) | seeds.words[i]; });
  }
  keep_connected(candidates, seeds, fish);
  combine(around, [&](int i) { return fish.words[i]; });
  if (remove_shadow && find_shadow(here, ground, fish, seeds, bright, dark, shadow)) {
    combine(seeds, [&](int i) { return seeds.words[i] & ~shadow.words[i]; });
    combine(candidates, [&](int i) { return candidates.words[i] & ~shadow.words[i]; });
    keep_connected(candidates, seeds, fish);
    result.shadow_removed = true;
  }
  grow(around, shadow);
  result.mask = fish;
  result.around = around;
  return result;
}

}  // namespace nt
