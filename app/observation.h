// SPDX-License-Identifier: Apache-2.0
// What one step of a session gave, for whoever draws or records it.
//
// An Observer looks at the session where it stands: nothing is copied but poses, and all views end with its next look.
// KeptObservation holds a copy for another thread; its memory is that of the largest it has held, so it soon allocates no more.
// Frame of reference: pixels of the working frame. Cost: a look well under 1 us a fish; keeping is a copy of what is asked for.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/session.h"
#include "platform/sim/tank.h"

namespace nt {

struct FishSeen {
  FishPose pose;
  Motion motion;                  // of the last step that gave a pose
  float init_len = 0;             // Capture::init_len()
  OrderStep order;                // Capture::order()
  std::span<const Vec2> contour;  // Capture::contour()
};

struct Observation {
  int64_t frame_index = -1;  // of the session, from 0
  Frame frame;               // its pixels only where nothing was copied
  int64_t had_ns = 0;        // when the camera had the frame, by the steady clock; 0: not known
  uint64_t luma_hash = 0;    // of the frame's pixels; only where it was asked for
  StepReport report;
  std::span<const FishSeen> fish;  // by number; all that are followed, seen or not
  int target = 0;                  // its number
  std::span<const BlobView> blobs;
  Picture picture;                   // of the camera; no pixels where it was not kept
  BitMask around_fish, foreground;   // no words where they were not kept
  const TankTruth* truth = nullptr;  // of the simulated tank, in the tank's own pixels
  const Statistics* statistics = nullptr;

  const FishSeen& of_target() const { return fish[static_cast<std::size_t>(target)]; }
  const FishPose& pose() const { return of_target().pose; }
};

class Observer {
 public:
  // Of the session's last step. The camera's picture and the masks have to be made: they are there where they are asked for.
  const Observation& look(Session& session, bool picture = false, bool masks = false);

 private:
  std::array<FishSeen, kMostFish> fish_;
  Observation seen_;
};
// FNV-1a of all pixels.
uint64_t luma_hash(const LumaView& luma);

// What is copied beside frame number, times, report, poses and motions.
struct Keep {
  bool contours = false, blobs = false, picture = false, masks = false, luma_hash = false, truth = false,
       statistics = false;
};

class KeptObservation {
 public:
  // `pixels`: where the picture goes; null: nowhere, and the copy has none.
  void keep(const Observation& seen, const Keep& what, std::vector<uint8_t>* pixels);
  const Observation& view() const { return view_; }

 private:
  void keep_mask(BitMask& mask, std::vector<uint64_t>& words);

  Observation view_;
  std::vector<FishSeen> fish_;
  std::array<std::vector<Vec2>, kMostFish> contours_;
  std::vector<BlobView> blobs_;
  std::vector<uint64_t> around_fish_, foreground_;
  std::optional<TankTruth> truth_;
  std::unique_ptr<Statistics> statistics_;  // large, and seldom wanted
};

}  // namespace nt
