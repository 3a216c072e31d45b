// SPDX-License-Identifier: Apache-2.0
#include "core/segment/swimmers.h"

#include "core/base/det_math.h"

namespace nt {
namespace {

// Matching: a part this large of the fish is enough within its predicted box; elsewhere a blob must lie within kNear lengths
// and have kLeastPart of the area, and its cost (lengths off, plus kAreaCost per factor e of area) must stay under kMostCost.
constexpr float kPartInBox = 0.1f, kNear = 0.6f, kLeastPart = 0.15f, kAreaCost = 0.35f, kMostCost = 1.6f;
// Out of a heap comes whole fish only, and looks tell more than places.
constexpr float kHeapFirst = 0.8f;  // cheaper, so that one who comes out goes before one who seems to have just come in
constexpr float kLeastOfHeap = 0.45f, kMostOfHeap = 1.4f, kPlaceAfterHeap = 0.7f, kLooksAfterHeap = 2.0f;
constexpr int kKnownFrames = 5;       // a blob that was there for less is nobody
constexpr int kMissedFrames = 5;      // and after so many without it, it is forgotten
constexpr int kMostHeapFrames = 150;  // fish that stay over each other for longer are taken for one
constexpr int kHiddenFrames = 20;     // a heap no larger than one fish for so long is one fish
constexpr float kFishBeside = 0.35f;  // of the other's area: what is smaller is a part of it, or hides little of it
constexpr int kTrustedFrames =
    30;                            // seen for less, a swimmer may be a piece of a fish, a light: it gives way to others
constexpr float kNewcomer = 0.1f;  // this much it counts at first
constexpr float kSwum = 0.5f, kLikely = 0.2f;  // lengths; fish_likeness
constexpr float kOneFish = 1.2f;               // of its area
constexpr float kSlowing = 0.97f;              // of the speed is left after a frame unseen
constexpr int kConsidered = 256;               // blobs; where there are more they are specks

bool inside(const Box& box, Vec2 p, float margin) {
  return p.x >= static_cast<float>(box.x0) - margin && p.x < static_cast<float>(box.x1) + margin &&
         p.y >= static_cast<float>(box.y0) - margin && p.y < static_cast<float>(box.y1) + margin;
}

Vec2 clamped(Vec2 p, const Box& box) {
  return {det::clamp(p.x, static_cast<float>(box.x0), static_cast<float>(box.x1)),
          det::clamp(p.y, static_cast<float>(box.y0), static_cast<float>(box.y1))};
}

float log_ratio(float a, float b) { return det::abs(det::log(det::max(a, 1.0f) / det::max(b, 1.0f))); }

Looks looks_of(const Blob& blob, float luma) { return {static_cast<float>(blob.area_px), length_of(blob), luma}; }

// How far a part of it can be from its middle: of one that swims in the length is not known yet.
float reach_of(const Swimmer& s) {
  const Vec2 size{static_cast<float>(s.box.x1 - s.box.x0), static_cast<float>(s.box.y1 - s.box.y0)};
  return det::max(s.length_px(), length(size));
}

// Where the fish was, or so small beside it and so near that it may be its fin, whose root is still out of the frame.
bool may_belong(const Blob& blob, const Swimmer& s) {
  if (inside(s.last_box, blob.centroid, 0)) return true;
  const bool small = static_cast<float>(blob.area_px) < kFishBeside * s.area_px();
  return small && length(blob.centroid - s.centroid) < reach_of(s);
}

// What it weighs that a swimmer finds its blob.
float worth(const Swimmer& s) {
  if (s.followed) return 1.0f;
  if (s.part_of != 0) return kNewcomer;
  return det::clamp(static_cast<float>(s.frames) / kTrustedFrames, kNewcomer, 1.0f);
}

}  // namespace

float length_of(const Blob& blob) { return 4.0f * blob.major_px + 1.0f; }

float fish_likeness(const Blob& blob) {
  if (blob.ghost) return 0.0f;
  const float elongation = blob.major_px / det::max(blob.minor_px, 0.3f);
  // An ellipse of the same moments has area 4 pi sigma_1 sigma_2; a ring or a branching crack has much less.
  const float ellipse = 4.0f * det::kPi * blob.major_px * det::max(blob.minor_px, 0.3f);
  const float filled = static_cast<float>(blob.area_px) / det::max(ellipse, 1.0f);
  const float long_enough = det::clamp((elongation - 1.0f) / 1.5f, 0.0f, 1.0f);
  const float compact = det::clamp((filled - 0.4f) / 0.4f, 0.0f, 1.0f);
  return (0.05f + 0.95f * long_enough * compact) * (blob.touches_edge ? 0.3f : 1.0f);
}

float Looks::unlike(const Looks& other) const {
  const float shade = luma > 0 && other.luma > 0 ? det::min(det::abs(luma - other.luma) / 40.0f, 1.0f) : 0.0f;
  return log_ratio(area_px, other.area_px) + 0.5f * shade;
}

void Swimmer::start(const Blob& of, uint32_t new_id) {
  *this = Swimmer{};
  id = new_id;
  centroid = last_centroid_ = first = of.centroid;
  box = of.box;
  looks = looks_of(of, 0);
  length_px_ = looks.length_px;
  whole_area_px_ = looks.area_px;
  likeness = fish_likeness(of);
}

Vec2 Swimmer::moved() const { return in_heap ? velocity : velocity * static_cast<float>(min_int(lost_frames + 1, 5)); }

float Swimmer::patience() const {
  return 1.0f + 0.2f * static_cast<float>(min_int(max_int(lost_frames, heap_frames / 2), 15));
}

void Swimmer::move_to(Vec2 centre) {
  const Vec2 step = (centre - last_centroid_) * (1.0f / static_cast<float>(last_gap_));
  velocity = lerp(last_velocity_, step, 0.4f);
  centroid = centre;
}

void Swimmer::see(const Blob& of, float luma, bool alone) {
  // Out of a heap the place jumps to where the fish is, the speed does not.
  last_centroid_ = in_heap ? of.centroid - velocity : centroid;
  last_velocity_ = velocity, last_gap_ = lost_frames + 1;
  lost_frames = heap_frames = 0;
  in_heap = false;
  ++frames;
  last_box = box;
  box = of.box;
  move_to(of.centroid);
  likeness += (fish_likeness(of) - likeness) * 0.2f;
  travelled = det::max(travelled, length(centroid - first) / det::max(length_of(of), looks.length_px));
  if (!alone) return;
  if (of.touches_edge) {
    looks.area_px = det::max(static_cast<float>(of.area_px), looks.area_px);
    return;
  }
  const float part = det::max(1.0f / static_cast<float>(frames), 0.08f);
  looks.area_px += (static_cast<float>(of.area_px) - looks.area_px) * part;
  looks.length_px += (length_of(of) - looks.length_px) * part;
  if (!whole_known_) length_px_ = looks.length_px;
  if (luma > 0) looks.luma = looks.luma > 0 ? looks.luma + (luma - looks.luma) * 0.1f : luma;
}

void Swimmer::swim_in_heap(const Blob& heap) {
  lost_frames = 0;
  ++heap_frames;
  in_heap = true;
  velocity = velocity * kSlowing;
  centroid = clamped(centroid + velocity, heap.box);
}

void Swimmer::change_reference(const Similarity& t) {
  for (Vec2* p : {&centroid, &first, &last_centroid_}) *p = t(*p);
  for (Vec2* v : {&velocity, &last_velocity_}) *v = t.turned(*v);
  const Vec2 middle{0.5f * static_cast<float>(box.x0 + box.x1), 0.5f * static_cast<float>(box.y0 + box.y1)};
  const Vec2 by = t(middle) - middle;
  const int dx = static_cast<int>(by.x), dy = static_cast<int>(by.y);
  box = {box.x0 + dx, box.y0 + dy, box.x1 + dx, box.y1 + dy};
}

void Swimmer::swim_on() {
  centroid = clamped(last_centroid_ + last_velocity_ * static_cast<float>(last_gap_), box);
  velocity = last_velocity_;
}

bool Swimmer::observe(const Box& whole, Vec2 centre, float area_px, float axis_len_px, bool touching,
                      int patience_frames) {
  constexpr float kMerged = 1.6f, kMergedTouching = 1.2f;  // fins that open add at most a third
  constexpr float kShadow = 1.9f, kAsLong = 0.1f;  // as long as ever it has taken up remains of its shadow, not a fish
  constexpr float kShrunk = 0.6f;                  // an axis drawn across a ring, not along the fish
  // Its first outline may have been of the part that was in the frame; its blob has grown since.
  const bool known = whole_known_ && odd_frames_ < patience_frames;
  if (!known) whole_area_px_ = area_px, axis_len_px_ = axis_len_px, whole_known_ = true;
  const bool as_long = det::abs(axis_len_px - axis_len_px_) < kAsLong * axis_len_px_;
  const float most = touching ? kMergedTouching : as_long ? kShadow : kMerged;
  if (area_px > most * this->area_px() || axis_len_px < kShrunk * axis_len_px_) {
    ++odd_frames_;
    swim_on();
    return false;
  }
  odd_frames_ = 0;
  box = whole;
  move_to(centre);
  whole_area_px_ += (area_px - whole_area_px_) * 0.3f;
  axis_len_px_ += (axis_len_px - axis_len_px_) * 0.3f;
  length_px_ += (static_cast<float>(max_int(whole.width(), whole.height())) - length_px_) * 0.3f;
  return true;
}

Swimmer* Swimmers::find(uint32_t id) {
  for (Swimmer& s : all())
    if (s.id == id && id != 0) return &s;
  return nullptr;
}

Swimmer* Swimmers::of_blob(int blob, Vec2 at) {
  Swimmer* best = nullptr;
  for (Swimmer& s : all())
    if (s.blob == blob && (best == nullptr || length_sq(s.centroid - at) < length_sq(best->centroid - at))) best = &s;
  return best;
}

Swimmer* Swimmers::begin(const Blob& blob, int index) {
  Swimmer* place = nullptr;
  if (count_ < kMostSwimmers) {
    place = &swimmers_[static_cast<std::size_t>(count_++)];
  } else {
    float least = static_cast<float>(blob.area_px) * fish_likeness(blob);
    for (Swimmer& s : all()) {
      const float worth = s.looks.area_px * s.likeness;
      if (!s.followed && worth < least) least = worth, place = &s;
    }
  }
  if (place == nullptr) return nullptr;
  place->start(blob, next_id_++);
  place->blob = index;
  place->see(blob, 0, true);
  return place;
}

void Swimmers::forget(uint32_t id) {
  if (Swimmer* s = find(id)) *s = swimmers_[static_cast<std::size_t>(--count_)];
}

void Swimmers::update(std::span<const Blob> blobs, std::span<const Run> runs, LumaView luma) {
  drop_the_lost();
  look_at(blobs, runs, luma);
  match(blobs);
  claim_pieces(blobs);
  find_heaps(blobs);
  welcome(blobs);
}

// Brightness of the blobs, every fourth pixel of every second row.
void Swimmers::look_at(std::span<const Blob> blobs, std::span<const Run> runs, LumaView luma) {
  luma_.fill(0);
  if (count_ < 2 || luma.empty()) return;
  std::array<int, kMostColumns> sum{}, n{};
  for (const Run& run : runs) {
    if (run.label < 0 || run.label >= kMostColumns || (run.y & 1) != 0) continue;
    const uint8_t* row = luma.row(run.y);
    for (int x = run.x0; x < run.x1; x += 4)
      sum[static_cast<std::size_t>(run.label)] += row[x], ++n[static_cast<std::size_t>(run.label)];
  }
  for (std::size_t i = 0; i < luma_.size() && i < blobs.size(); ++i)
    if (n[i] > 0) luma_[i] = static_cast<float>(sum[i]) / static_cast<float>(n[i]);
}

// kMostCost and more: it cannot be this blob.
float Swimmers::cost(const Swimmer& s, const Blob& blob, float luma) const {
  if (blob.ghost) return kMostCost;
  const Vec2 moved = s.moved();
  const float patience = s.patience();
  const float ratio = static_cast<float>(blob.area_px) / det::max(s.looks.area_px, 1.0f);
  const float off = length(blob.centroid - s.centroid - moved) / s.length_px();
  if (s.in_heap) {
    const bool whole = ratio > kLeastOfHeap && ratio < kMostOfHeap && off < kNear * patience;
    return whole ? kPlaceAfterHeap * off / patience + kLooksAfterHeap * s.looks.unlike(looks_of(blob, luma))
                 : kMostCost;
  }
  const bool in_box = inside(s.box, blob.centroid - moved, 0.1f * s.length_px() * patience) && ratio > kPartInBox;
  if (!in_box && (off > kNear * patience || ratio < kLeastPart)) return kMostCost;
  const float cost = off / patience + kAreaCost * det::abs(det::log(ratio));
  return in_box ? det::min(cost, 0.99f * kMostCost) : cost;
}

void Swimmers::match(std::span<const Blob> blobs) {
  std::array<float, kMostSwimmers * kMostColumns> costs;
  std::array<int, kMostColumns> blob_of{};  // of a column: only blobs that somebody can be have one
  std::array<int, kMostSwimmers> chosen{};
  costs.fill(kMostCost);
  int width = 0;
  for (int i = 0; i < static_cast<int>(blobs.size()) && width < kMostColumns; ++i) {
    const float shade = i < kMostColumns ? luma_[static_cast<std::size_t>(i)] : 0.0f;
    bool wanted = false;
    for (int k = 0; k < count_; ++k) {
      const Swimmer& s = swimmers_[static_cast<std::size_t>(k)];
      const float c = kMostCost - worth(s) * (kMostCost - cost(s, blobs[static_cast<std::size_t>(i)], shade));
      costs[static_cast<std::size_t>(k * kMostColumns + width)] = c;
      wanted |= c < kMostCost;
    }
    if (wanted) blob_of[static_cast<std::size_t>(width++)] = i;
  }
  assign(costs, count_, kMostColumns, kMostCost, chosen);
  for (int k = 0; k < count_; ++k) {
    const int j = chosen[static_cast<std::size_t>(k)];
    swimmers_[static_cast<std::size_t>(k)].blob = j < 0 || j >= width ? -1 : blob_of[static_cast<std::size_t>(j)];
  }
  drop_doubles(blobs);
}

// Of the blobs where a fish must be, the largest that is no other fish's; its own where there is none.
int Swimmers::largest_piece(const Swimmer& one, std::span<const Blob> blobs) const {
  int best = one.blob;
  int most = best >= 0 ? blobs[static_cast<std::size_t>(best)].area_px : 0;
  for (int i = 0; i < static_cast<int>(blobs.size()) && i < kConsidered; ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    const bool fits = static_cast<float>(blob.area_px) < kOneFish * one.area_px();
    if (blob.ghost || blob.area_px <= most || !fits || !inside(one.box, blob.centroid - one.moved(), 0)) continue;
    bool taken = false;
    for (const Swimmer& other : all()) taken |= &other != &one && other.blob == i && worth(other) >= 1.0f;
    if (!taken) best = i, most = blob.area_px;
  }
  return best;
}

// Noise and light break a fish in pieces: it is seen in the largest, and whoever was thought to be that piece is a part.
void Swimmers::claim_pieces(std::span<const Blob> blobs) {
  for (Swimmer& s : all()) {
    if (worth(s) < 1.0f || s.in_heap) continue;
    const int piece = largest_piece(s, blobs);
    if (piece == s.blob) continue;
    for (Swimmer& other : all())
      if (other.blob == piece) other.blob = -1, other.part_of = s.id;
    s.blob = piece;
  }
}

// What came out of a heap and was not known again at once: its blob is now that of one who was in the heap.
void Swimmers::drop_doubles(std::span<const Blob> blobs) {
  for (int k = 0; k < count_;) {
    const Swimmer& young = swimmers_[static_cast<std::size_t>(k)];
    bool is_double = false;
    for (const Swimmer& s : all()) {
      if (young.blob >= 0 || young.followed || s.blob < 0 || !s.in_heap || young.frames > s.heap_frames) continue;
      is_double |= cost(young, blobs[static_cast<std::size_t>(s.blob)], 0) < 0.5f * kMostCost;
    }
    if (is_double) swimmers_[static_cast<std::size_t>(k)] = swimmers_[static_cast<std::size_t>(--count_)];
    else ++k;
  }
}

// A fin that was a blob of its own for a while, a bubble: it and the fish whose blob this is make no heap.
bool Swimmers::is_small_beside(const Swimmer& s, int blob) const {
  for (const Swimmer& other : all())
    if (&other != &s && other.blob == blob &&
        (s.part_of == other.id || s.looks.area_px < kFishBeside * other.area_px()))
      return true;
  return false;
}

// The blob in which a swimmer that has none of its own must be; -1 for none.
int Swimmers::heap_of(const Swimmer& s, std::span<const Blob> blobs) const {
  if (s.frames < kKnownFrames || s.lost_frames > 0 || s.heap_frames > kMostHeapFrames) return -1;
  // What nobody follows must have swum to be a fish: a line of light on the ground has not.
  if (!s.followed && (s.travelled < kSwum || s.likeness < kLikely)) return -1;
  const Vec2 place = s.centroid + s.moved();
  int best = -1;
  float nearest = 0.5f * s.length_px() * s.patience();
  for (int i = 0; i < static_cast<int>(blobs.size()); ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    if (blob.ghost || static_cast<float>(blob.area_px) < 0.7f * s.looks.area_px || is_small_beside(s, i)) continue;
    const Vec2 inner = clamped(place, blob.box);
    const float off = length(place - inner) + 0.1f * length(place - blob.centroid);
    if (off < nearest) nearest = off, best = i;
  }
  return best;
}

int Swimmers::users(int blob) const {
  int n = 0;
  for (const Swimmer& s : all()) n += s.blob == blob;
  return n;
}

void Swimmers::find_heaps(std::span<const Blob> blobs) {
  for (Swimmer& s : all())
    if (s.blob < 0) s.blob = heap_of(s, blobs);
  for (Swimmer& s : all()) {
    const Swimmer* whole = find(s.part_of);
    if (whole == nullptr || length(whole->centroid - s.centroid) > reach_of(*whole)) s.part_of = 0;
    if (s.blob < 0) {
      ++s.lost_frames;
      s.in_heap = false;
      continue;
    }
    const Blob& blob = blobs[static_cast<std::size_t>(s.blob)];
    const bool heap = users(s.blob) > 1;
    const bool alone = static_cast<float>(blob.area_px) < kOneFish * s.looks.area_px;
    s.alone_frames = heap && alone ? s.alone_frames + 1 : 0;
    if (heap && !hides_the_rest(s)) s.swim_in_heap(blob);
    else s.see(blob, s.blob < kMostColumns ? luma_[static_cast<std::size_t>(s.blob)] : 0.0f, !heap);
  }
}

// Of a heap that has long been no larger than one fish: whether this is the one that is seen.
bool Swimmers::hides_the_rest(const Swimmer& one) const {
  for (const Swimmer& other : all())
    if (other.blob == one.blob && other.alone_frames > one.alone_frames) return false;
  return one.alone_frames > kHiddenFrames;
}

// A part of a fish that is there already is no other fish: one that is small, or one that with the fish's own blob makes
// no more than the whole.
bool Swimmers::is_part(const Blob& blob, std::span<const Blob> blobs) const {
  for (const Swimmer& s : all()) {
    if (s.blob < 0 || !inside(s.box, blob.centroid, 0)) continue;
    const int both = blob.area_px + blobs[static_cast<std::size_t>(s.blob)].area_px;
    if (static_cast<float>(blob.area_px) < 0.5f * s.area_px() || static_cast<float>(both) < 1.1f * s.area_px())
      return true;
  }
  return false;
}

void Swimmers::welcome(std::span<const Blob> blobs) {
  for (int i = 0; i < static_cast<int>(blobs.size()) && i < kConsidered; ++i) {
    const Blob& blob = blobs[static_cast<std::size_t>(i)];
    if (blob.ghost || of_blob(i, blob.centroid) != nullptr || is_part(blob, blobs)) continue;
    if (largest_px_ > 0 && blob.area_px > largest_px_) continue;
    uint32_t whole = 0;
    for (const Swimmer& s : all())
      if (s.blob >= 0 && !s.in_heap && s.frames > kKnownFrames && may_belong(blob, s)) whole = s.id;
    if (Swimmer* born = begin(blob, i)) born->part_of = whole;
  }
}

void Swimmers::drop_the_lost() {
  for (int k = 0; k < count_;) {
    const Swimmer& s = swimmers_[static_cast<std::size_t>(k)];
    const bool known = s.followed || s.frames > lost_after_;
    if (s.lost_frames > (known ? lost_after_ : kMissedFrames))
      swimmers_[static_cast<std::size_t>(k)] = swimmers_[static_cast<std::size_t>(--count_)];
    else ++k;
  }
}

}  // namespace nt
