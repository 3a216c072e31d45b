// SPDX-License-Identifier: Apache-2.0
// One fish that is followed: everything that capture remembers of it from frame to frame, and its way from a blob to a
// pose and a motion.
//
// its swimmer's blob in one frame -> this fish's outline, pose, motion, or a status that says why there is none.
// What holds for the whole frame (background, blobs, the scratch of refine and landmarks) is lent by CaptureTools, so a
// fish costs its contour (8 bytes a point of Limits::max_contour_points), one bit a pixel and a few kilobytes.
// Frame of reference: blobs, memories and predictions are in the pixels of the reference frame (stabilise/), in which the
// tank stands still; pose, motion and contour are given in those of the frame handed in. Mostly the two are one.
#pragma once
#include <span>

#include "core/base/arena.h"
#include "core/base/similarity.h"
#include "core/base/stage_clock.h"
#include "core/frame/frame.h"
#include "core/landmarks/landmarks.h"
#include "core/motion/motion.h"
#include "core/pipeline/pipeline.h"
#include "core/segment/background.h"
#include "core/segment/refine.h"
#include "core/segment/swimmers.h"

namespace nt {

// What the fish of one frame share.
struct CaptureTools {
  const Frame& frame;  // its luma as the reference camera would have seen it
  const Similarity& frame_from_reference;
  bool moved;  // frame_from_reference is not the identity
  const CaptureSettings& settings;
  Background& background;
  const Blobs& blobs;
  Swimmers& swimmers;
  const BitMask* tank;               // where fish can be; null: everywhere
  std::span<const BitMask> scratch;  // three, as large as the frame
  Refine& refine;
  Landmarks& landmarks;
  StageClock& clock;
  StepReport& report;
};

struct FishTrack {
  static constexpr int kOrderPoints = 9;  // along the axis, by which a pose is compared with the last

  uint32_t swimmer_id = 0;  // 0: nobody
  Looks looks;              // of the last swimmer
  FishPose pose;            // of the last step
  Motion motion;            // of the last step with a pose
  bool has_motion = false;
  OrderStep order;             // of the last step with a pose
  float init_len = 0;          // axis length in the first frame with a pose, pixels
  std::span<Vec2> contour;     // room for Limits::max_contour_points
  std::span<Vec2> smooth;      // elliptic Fourier reconstruction; means something with a pose
  int contour_count = 0;       // 0 without a pose
  int contour_high_water = 0;  // the most points of one frame
  Box box;                     // of the contour
  BitMask protect;             // whole frame; what of it must not be learned as background
  bool protected_now = false;  // `protect` holds a fish

  bool layout(Arena& arena, const Limits& limits, int width, int height);
  // One frame of its swimmer; the status is also the pose's.
  PoseStatus follow(const CaptureTools& tools);
  // A frame that gives no pose.
  void miss(PoseStatus status);
  void unprotect() { protected_now = false; }
  // Another frame is the reference from now on.
  void change_reference(const Similarity& new_from_old);

 private:
  PoseStatus look_for(const CaptureTools& tools, Swimmer& swimmer);
  PoseStatus outline(const CaptureTools& tools, const Swimmer& swimmer);
  bool clip(const CaptureTools& tools, const FishMask& fish) const;
  bool part(const CaptureTools& tools, const FishMask& fish, int blob) const;
  bool open_ring(const FishMask& fish, Vec2 moved) const;
  Vec2 predicted(const Swimmer& swimmer) const;
  void trace(const CaptureTools& tools, const FishMask& fish);
  bool tail_may_be_outside(const CaptureTools& tools);
  bool measure_contour(int width, int height, const Similarity& frame_from_reference);
  void to_frame(const Similarity& frame_from_reference);
  bool may_be_closed() const;
  bool is_ring(const FishMask& fish) const;
  PoseStatus find_pose(const CaptureTools& tools, Swimmer& swimmer);
  LandmarkHints hints(const CaptureTools& tools, const Swimmer& swimmer, std::span<Vec2> last) const;
  void remember(const Landmarks& landmarks);
  void protect_from_learning(const FishMask& fish);
  std::span<const Vec2> points() const { return contour.first(static_cast<std::size_t>(contour_count)); }

  Vec2 last_axis_[kOrderPoints], last_centre_, travel_;
  float head_log_odds_ = 0;
  bool has_last_ = false;
  bool touching_ = false;  // what was outlined holds a part of another one
  bool entering_ = true;  // it was cut by the frame's edge, or is new, and its tail has not been seen clear of the edge
  float last_len_ = 0;    // of the axis, in the last frame that had one
  float whole_len_ = 0;   // of the axis, as a rule
  bool opened_ = false;   // the last outline was a ring and has been cut
  bool fins_may_hide_ = false;  // of the last outline
  uint32_t last_swimmer_ = 0;
  int frames_without_pose_ = 0;
};

}  // namespace nt
