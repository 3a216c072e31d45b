// SPDX-License-Identifier: Apache-2.0
#include "core/segment/vibe.h"

#include <hwy/cache_control.h>

#include <bit>
#include <cstring>

#include "core/segment/difference.h"
#include "core/segment/fill.h"
#include "core/segment/lanes.h"

namespace nt {
namespace {

constexpr std::size_t kTable = 16384;  // random bytes beyond one row's length, so that rows start at different places

// True when all 64 pixels match the samples of the first two planes: nearly every segment of ground does.
HWY_INLINE bool all_match_two(const uint8_t* luma, const uint8_t* first, const uint8_t* second, int radius) {
  static_assert(Vibe::kMinMatches == 2);
  const ByteLanes d;
  const auto limit = hn::Set(d, static_cast<uint8_t>(radius));
  auto beyond = hn::Zero(d);
  for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, luma + i), a = hn::LoadU(d, first + i), b = hn::LoadU(d, second + i);
    beyond = hn::Or(beyond, hn::SaturatedSub(hn::Max(abs_diff(v, a), abs_diff(v, b)), limit));
  }
  return hn::AllTrue(d, hn::Eq(beyond, hn::Zero(d)));
}

// Bits of the pixels with fewer than kMinMatches samples within `radius`. Lane groups read on until every lane has its
// matches.
uint64_t classify_planes(const uint8_t* luma, const uint8_t* samples, std::ptrdiff_t plane_stride, int radius) {
  const ByteLanes d;
  const auto limit = hn::Set(d, static_cast<uint8_t>(radius));
  const auto needed = hn::Set(d, static_cast<uint8_t>(Vibe::kMinMatches));
  uint64_t word = 0;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, luma + i);
    auto matches = hn::Zero(d);
    auto lacking = hn::Ne(matches, needed);
    for (int k = 0; k < Vibe::kSamples && !hn::AllFalse(d, lacking); ++k) {
      const auto diff = abs_diff(v, hn::LoadU(d, samples + k * plane_stride + i));
      // A true comparison is -1, so subtracting it counts.
      matches = hn::Sub(matches, hn::VecFromMask(d, hn::Eq(hn::Min(diff, limit), diff)));
      lacking = hn::Ne(hn::Min(matches, needed), needed);
    }
    store_bits(d, lacking, i, word);
  }
  return word;
}

HWY_INLINE uint64_t classify_segment(const uint8_t* luma, const uint8_t* samples, std::ptrdiff_t plane_stride,
                                     int radius) {
  if (HWY_LIKELY(all_match_two(luma, samples, samples + plane_stride, radius))) return 0;
  return classify_planes(luma, samples, plane_stride, radius);
}

// to[i] = luma[i] where chosen[i] is 255 and bit i of `frozen` is clear.
void refresh_segment(const uint8_t* luma, const uint8_t* chosen, uint64_t frozen, uint8_t* to) {
  const ByteLanes d;
  for (std::size_t i = 0; i < 64; i += hn::Lanes(d)) {
    auto pick = hn::LoadU(d, chosen + i);
    if (HWY_UNLIKELY(frozen != 0)) pick = hn::AndNot(lanes_of_bits(d, frozen, i), pick);
    const auto old = hn::LoadU(d, to + i);
    // old ^ (pick & (old ^ new)) selects without a blend instruction.
    hn::StoreU(hn::Xor(old, hn::And(pick, hn::Xor(old, hn::LoadU(d, luma + i)))), d, to + i);
  }
}

}  // namespace

Vibe* Vibe::create(Arena& arena, const BackgroundSettings& settings, int width, int height, uint64_t seed) {
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(align_up(static_cast<std::size_t>(width)));
  const std::size_t plane = static_cast<std::size_t>(stride) * static_cast<std::size_t>(height);
  auto self = arena.take<Vibe>(1);
  // One guard line at either end: a neighbour update reaches one pixel over a segment's edge.
  auto samples = arena.take_raw<uint8_t>(plane * kSamples + 2 * kAlignment);
  auto estimate = arena.take_raw<uint8_t>(plane);
  auto chosen = arena.take_raw<uint8_t>(kTable + static_cast<std::size_t>(stride));
  auto guessed =
      arena.take_raw<uint64_t>(static_cast<std::size_t>(words_for(width)) * static_cast<std::size_t>(height));
  if (self.empty() || guessed.empty()) return nullptr;
  Vibe& vibe = self[0];
  vibe.settings_ = settings;
  vibe.width_ = width, vibe.height_ = height, vibe.stride_ = stride;
  vibe.samples_ = samples.subspan(kAlignment, plane * kSamples);
  vibe.plane_ = estimate;
  vibe.chosen_ = chosen;
  vibe.guessed_ = {guessed.data(), width, height, words_for(width)};
  vibe.random_ = Random(seed);
  for (uint8_t& c : chosen) c = vibe.random_.below(kSubsampling / kSegments) == 0 ? 255 : 0;
  return &vibe;
}

int Vibe::radius() const {
  if (settings_.radius > 0) return settings_.radius;
  return match_radius(noise_.sigma());
}

void Vibe::learn(LumaView luma) {
  if (!started_) initialise(luma, nullptr);
}

void Vibe::restart() {
  started_ = false;
  frames_ = 0;
  noise_.restart();
}

// The samples of a pixel are its own value and its neighbours' in the first frame (ViBe section III-B). Where a fish
// may hide the ground they are drawn from the ground beside it: guesses, which spread as the ground does.
void Vibe::initialise(LumaView luma, const BitMask* unknown) {
  for (int y = 0; y < height_; ++y) {
    std::memcpy(plane_.data() + y * stride_, luma.row(y), static_cast<std::size_t>(width_));
    for (int k = 0; k < kSamples; ++k) {
      const uint32_t r = k < kMinMatches ? 4 : random_.below(9);  // 4: the pixel itself
      const int dx = static_cast<int>(r % 3) - 1, dy = static_cast<int>(r / 3) - 1;
      const uint8_t* from = luma.row(clamp_int(y + dy, 0, height_ - 1));
      uint8_t* to = sample_row(k, y);
      for (int x = 0; x < width_; ++x) to[x] = from[clamp_int(x + dx, 0, width_ - 1)];
      std::memset(to + width_, from[width_ - 1], static_cast<std::size_t>(stride_ - width_));
    }
  }
  guess_age_ = kGuessFrames;
  if (unknown != nullptr) guess(*unknown);
  light_.start(luma);
  started_ = true;
}

// One sample, too little for a match, remembers the pixel itself.
void Vibe::guess(const BitMask& unknown) {
  for (int k = 1; k < kSamples; ++k) fill_unknown(unknown, Fill::drawn, random_, sample_plane(k));
  fill_unknown(unknown, Fill::mean, random_, {plane_.data(), width_, height_, stride_});
  for (int i = 0; i < guessed_.words_per_row * height_; ++i) guessed_.words[i] = unknown.words[i];
  guess_age_ = 0;
}

// A guessed pixel that has shown one and the same ground-like value over more than a beat of the tail is ground that was
// never hidden, between the fins or beside the body. What moves there is the fish.
void Vibe::settle_guess(LumaView luma) {
  if (guess_age_ >= kGuessFrames || ++guess_age_ % 4 != 0) return;
  uint8_t tail[64];
  const int still = weak_threshold(noise_.sigma()), like_ground = radius();
  for (int y = 0; y < height_; ++y) {
    for_segments(luma.row(y), width_, tail, [&](int x, const uint8_t* at) {
      uint64_t& guessed = guessed_.row(y)[x >> 6];
      if (guessed == 0) return;
      const uint8_t* samples = sample_row(0, y) + x;
      uint64_t moved = 0;
      for (uint64_t word = guessed; word != 0; word &= word - 1) {
        const int i = std::countr_zero(word), d = at[i] - samples[i];
        if (d > still || -d > still) moved |= uint64_t{1} << i;
      }
      guessed &= ~moved;
      if (guess_age_ < kGuessFrames) return;
      const uint64_t fish = classify_segment(at, samples, stride_ * height_, like_ground);
      for (uint64_t word = guessed & ~fish; word != 0; word &= word - 1) {
        const int i = std::countr_zero(word);
        plane_[static_cast<std::size_t>(y * stride_ + x + i)] = at[i];
        for (int k = 0; k < kSamples; k += 2) sample_row(k, y)[x + i] = at[i];
      }
    });
  }
}

void Vibe::follow_light(LumaView luma, const BitMask* keep) {
  const Relight relight = light_.update(luma, keep != nullptr);
  relit_ = relight.all != 1.0f;
  if (relit_) scale_pixels(relight.all, samples_), scale_pixels(relight.all, plane_);
  if (relight.kept == 1.0f || keep == nullptr) return;
  for (int k = 0; k < kSamples; ++k) scale_pixels(relight.kept, relight.rounding, *keep, sample_plane(k));
  scale_pixels(relight.kept, relight.rounding, *keep, {plane_.data(), width_, height_, stride_});
}

// Calls f(x) for the first pixel of every segment whose bit is set; bits repeat after 64 segments.
template <class F>
HWY_INLINE void for_turns(uint64_t turns, int width, F&& f) {
  for (int x0 = 0; x0 < width; x0 += 64 * 64) {
    const int segments = (width - x0 + 63) >> 6;
    uint64_t left = segments >= 64 ? turns : turns & ((uint64_t{1} << segments) - 1);
    for (; left != 0; left &= left - 1) f(x0 + 64 * std::countr_zero(left));
  }
}

// Asks for the memory that the row's refresh will touch: it is strewn over all planes, so nothing else foresees it.
Vibe::Turn Vibe::draw_turn(int y, bool neighbours) {
  static_assert(kSegments == 4);  // two random bits
  Turn turn;
  turn.own_choice = chosen_.data() + random_.below(kTable);
  turn.neighbour_choice = chosen_.data() + random_.below(kTable);
  turn.own_segments = random_.next() & random_.next();
  turn.neighbour_segments = neighbours ? random_.next() & random_.next() : 0;
  turn.shifts = random_.next();
  const int dy = static_cast<int>(random_.below(3)) - 1;
  turn.own = sample_row(static_cast<int>(random_.below(kSamples)), y);
  const int neighbours_plane = kMinMatches + static_cast<int>(random_.below(kSamples - kMinMatches));
  turn.other = sample_row(neighbours_plane, clamp_int(y + dy, 0, height_ - 1));
  for_turns(turn.own_segments, width_, [&](int x) { hwy::Prefetch(turn.own + x); });
  for_turns(turn.neighbour_segments, width_, [&](int x) { hwy::Prefetch(turn.other + x); });
  return turn;
}

void Vibe::refresh_row(LumaView luma, int y, const Turn& turn, const uint64_t* foreground, const uint64_t* keep) {
  const auto frozen = [&](int x) {
    return foreground[x >> 6] | (keep != nullptr ? keep[x >> 6] : 0) | ~valid_bits(x, width_);
  };
  uint8_t tail[64];
  const auto pixels = [&](int x) { return segment_at(luma.row(y), x, width_, tail); };
  for_turns(turn.own_segments, width_,
            [&](int x) { refresh_segment(pixels(x), turn.own_choice + x, frozen(x), turn.own + x); });
  for_turns(turn.neighbour_segments, width_, [&](int x) {
    // Two random bits: -1, 0, 0, +1, so that half of the neighbours lie straight above or below.
    const int i = x >> 6 & 31;
    int dx = static_cast<int>(turn.shifts >> i & 1) - static_cast<int>(turn.shifts >> (32 + i) & 1);
    if (x + dx < 0 || x + dx + 64 > stride_) dx = 0;
    refresh_segment(pixels(x), turn.neighbour_choice + x, frozen(x), turn.other + x + dx);
  });
}

bool Vibe::apply(LumaView luma, const BitMask* keep, const BitMask& foreground) {
  noise_.add(luma);
  if (!started_) {
    relit_ = false;
    initialise(luma, keep);
    for (int y = 0; y < height_; ++y)
      std::memset(foreground.row(y), 0, static_cast<std::size_t>(foreground.words_per_row) * 8);
    return false;
  }
  follow_light(luma, keep);
  settle_guess(luma);
  uint8_t tail[64];
  const int match = radius();
  const int rounds = frames_ < kEagerFrames ? kEagerRounds : 1;
  const std::ptrdiff_t plane_stride = stride_ * height_;
  Turn next = draw_turn(0, true);
  for (int y = 0; y < height_; ++y) {
    const Turn turn = next;
    if (y + 1 < height_) next = draw_turn(y + 1, true);
    uint64_t* words = foreground.row(y);
    const uint64_t* kept = keep != nullptr ? keep->row(y) : nullptr;
    const uint8_t* samples = sample_row(0, y);
    for_segments(luma.row(y), width_, tail, [&](int x, const uint8_t* at) {
      words[x >> 6] = classify_segment(at, samples + x, plane_stride, match) & valid_bits(x, width_);
    });
    refresh_row(luma, y, turn, words, kept);
    for (int round = 1; round < rounds; ++round) refresh_row(luma, y, draw_turn(y, false), words, kept);
  }
  follow_background(luma, foreground, keep, follow_limits(frames_++, weak_threshold(noise_.sigma())),
                    {plane_.data(), width_, height_, stride_});
  return true;
}

void Vibe::absorb(LumaView luma, std::span<const Run> runs, int label) {
  copy_runs(luma, runs, label, {plane_.data(), width_, height_, stride_});
  for (int k = 0; k < kSamples; ++k) copy_runs(luma, runs, label, sample_plane(k));
}

void Vibe::clear_familiar(LumaView part, int x0, int y0, int threshold, const BitMask& differing) const {
  // Twice the noise is not unrest: a camera that settles, quantisation.
  const bool restless = light_.unrest() > 2.0f * noise_.sigma();
  const int reach = min_int(restless ? max_int(threshold, weak_threshold(light_.unrest())) : threshold, radius());
  uint8_t tail[64];
  const std::ptrdiff_t plane_stride = stride_ * height_;
  for (int y = 0; y < part.height; ++y) {
    uint64_t* words = differing.row(y);
    const uint8_t* samples = sample_row(0, y0 + y) + x0;
    for_segments(part.row(y), part.width, tail, [&](int x, const uint8_t* at) {
      if (words[x >> 6] != 0) words[x >> 6] &= classify_segment(at, samples + x, plane_stride, reach);
    });
  }
}

}  // namespace nt
