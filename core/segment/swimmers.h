// SPDX-License-Identifier: Apache-2.0
// Everything that swims, frame by frame: which blob of this frame is which of the last.
//
// blobs of one frame -> up to kMostSwimmers swimmers with identities, their place, speed, looks (area, length, brightness)
// and blob. Those that swim over each other share a blob: they are a heap, swim on as they did, and are told apart on the
// other side by where they must be and what they look like.
// Method: prediction by constant velocity, gates by place and area, the assignment of least total cost (assign.h).
// [F] section 4 follows one fish and does not say how.
// Memory: 5 KB. Cost: O(swimmers x blobs), some microseconds; brightness is looked at only where there are two and more.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/base/image_view.h"
#include "core/base/similarity.h"
#include "core/base/vec2.h"
#include "core/segment/assign.h"
#include "core/segment/blobs.h"

namespace nt {

// What tells one fish from another.
struct Looks {
  float area_px = 0;
  float length_px = 0;
  float luma = 0;  // mean grey level; 0 = not looked at yet

  // 0 the same .. ; 0.3 is a fish 15 % longer.
  float unlike(const Looks& other) const;
};

class Swimmer {
 public:
  uint32_t id = 0;       // 0: nobody
  int blob = -1;         // in this frame; -1 when it is not seen
  bool in_heap = false;  // another one is in the same blob
  Vec2 centroid;         // as last seen, or where it must be by now in a heap
  Vec2 velocity;         // pixels a frame, smoothed
  Box box;               // of the whole fish, as last observed
  Looks looks;           // of its blobs
  Vec2 first;            // where it was first seen
  float travelled = 0;   // the greatest distance from there, in lengths
  float likeness = 0;    // smoothed fish_likeness
  int frames = 0;        // in which it was seen
  int lost_frames = 0;   // since it was seen last
  int heap_frames = 0;   // that it has been in a heap
  int alone_frames = 0;  // that it has shared a blob no larger than itself
  uint32_t part_of =
      0;         // broke off this one's blob and has never been a length away from it: light broke the fish in two
  Box last_box;  // before this frame
  bool followed = false;  // somebody wants to know: it is kept longer

  void start(const Blob& blob, uint32_t new_id);
  // This frame's blob is (a part of) it. `alone`: and nobody else's, so that it shows its looks.
  void see(const Blob& blob, float luma, bool alone);
  // It is somewhere in this blob.
  void swim_in_heap(const Blob& heap);
  // What the refined outline says of the fish in this frame; its blob may have been only a part of it, or have held its
  // shadow. False when the outline suddenly encloses much more or its axis is much shorter: the fish has merged with
  // something, or closed into a ring; for at most `patience` frames. `touching`: another one hangs together with it.
  bool observe(const Box& whole, Vec2 centre, float area_px, float axis_len_px, bool touching, int patience);
  // This frame's blob was not it alone: it is taken to have swum on, inside it.
  void swim_on();

  // The camera has moved, and places are counted from another frame on: what is remembered goes along.
  void change_reference(const Similarity& new_from_old);

  Vec2 moved() const;      // since it was last seen, by prediction
  float patience() const;  // grows while it is not seen
  float length_px() const { return length_px_; }
  // Of the whole fish, where its outline has been seen: its blob may be but a part of it.
  float area_px() const { return whole_area_px_ > looks.area_px ? whole_area_px_ : looks.area_px; }

 private:
  void move_to(Vec2 centre);

  Vec2 last_centroid_, last_velocity_;  // before this frame
  int last_gap_ = 1;                    // frames between last_centroid_ and this frame
  float length_px_ = 0;                 // roughly
  float whole_area_px_ = 0, axis_len_px_ = 0;
  bool whole_known_ = false;  // observed whole, not only as a blob
  int odd_frames_ = 0;
};

// 0..1: how much a blob looks like a fish from above: elongated, filled like an ellipse, not cut by the frame's edge.
float fish_likeness(const Blob& blob);
float length_of(const Blob& blob);

class Swimmers {
 public:
  static constexpr int kMostSwimmers = 16;

  void set_lost_after(int frames) { lost_after_ = frames; }
  void set_largest(int area_px) { largest_px_ = area_px; }  // nothing larger is a fish; 0 = no such limit
  // `runs` and `luma` are of the blobs' frame.
  void update(std::span<const Blob> blobs, std::span<const Run> runs, LumaView luma);

  std::span<Swimmer> all() { return {swimmers_.data(), static_cast<std::size_t>(count_)}; }
  std::span<const Swimmer> all() const { return {swimmers_.data(), static_cast<std::size_t>(count_)}; }
  Swimmer* find(uint32_t id);           // null when it is gone
  Swimmer* of_blob(int blob, Vec2 at);  // the one nearest to `at` of those that share it; null for none
  Swimmer* begin(const Blob& blob, int index);
  void forget(uint32_t id);

 private:
  void look_at(std::span<const Blob> blobs, std::span<const Run> runs, LumaView luma);
  void match(std::span<const Blob> blobs);
  void claim_pieces(std::span<const Blob> blobs);
  int largest_piece(const Swimmer& one, std::span<const Blob> blobs) const;
  void find_heaps(std::span<const Blob> blobs);
  bool is_small_beside(const Swimmer& swimmer, int blob) const;
  int heap_of(const Swimmer& swimmer, std::span<const Blob> blobs) const;
  void drop_doubles(std::span<const Blob> blobs);
  bool hides_the_rest(const Swimmer& one) const;
  int users(int blob) const;
  void welcome(std::span<const Blob> blobs);
  void drop_the_lost();
  float cost(const Swimmer& swimmer, const Blob& blob, float luma) const;
  bool is_part(const Blob& blob, std::span<const Blob> blobs) const;

  std::array<Swimmer, kMostSwimmers> swimmers_{};
  std::array<float, kMostColumns> luma_{};  // of this frame's blobs
  int count_ = 0;
  uint32_t next_id_ = 1;
  int lost_after_ = 30;
  int largest_px_ = 0;
};

}  // namespace nt
