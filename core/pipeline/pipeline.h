// SPDX-License-Identifier: Apache-2.0
// Capture: frame -> fish pose -> motion, in fixed memory. The one header that most of app includes.
//
// bytes_needed() is exact; create() cuts everything from one 64-byte-aligned block; step() never allocates, throws, or
// reads a clock of its own. One thread at a time.
// Frame of reference: pixels of the frames handed in.
// Source: [F] sections 4 and 5 (Algorithm 2); what differs is listed in docs/METHOD.md.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/image_view.h"
#include "core/base/limits.h"
#include "core/base/similarity.h"
#include "core/base/stage_clock.h"
#include "core/base/status.h"
#include "core/frame/frame.h"
#include "core/landmarks/fish_pose.h"
#include "core/landmarks/order_step.h"
#include "core/motion/motion.h"
#include "core/segment/background.h"
#include "core/stabilise/stabiliser.h"

namespace nt {

inline constexpr int kMostFish = 16;

struct CaptureSettings {
  BackgroundSettings background;
  Stabilise stabilise = Stabilise::automatic;
  int u_num = 3;
  int l_num = 15;
  int harmonics = 5;    // S of [F] section 4.3
  int open_size = 3;    // side of the opening's square; 1 switches it off
  int min_area_px = 0;  // smaller blobs are dropped; 0 = 1/4000 of the frame
  int max_area_px = 0;  // larger ones are no fish; 0 = no such limit
  // Where fish can be: as large as the frame, 0 = nothing there is a fish. Copied by create(). Without it: everywhere.
  LumaView tank;
  bool shadows = true;       // Otsu shadow removal, where the background model can have shadows at all
  int lost_after = 30;       // frames without the target until it counts as lost and selection starts anew
  int max_fish = 1;          // with a pose at a time, 1 to kMostFish; the target is one of them
  uint64_t seed = 1;         // of the background model's random choices
  bool fingerprint = false;  // compute integer_hash(); tests compare it between machines
};

// Bits of StepReport::flags. Each names what was dropped and the limit to raise.
enum StepFlag : uint32_t {
  kRunsDropped = 1u << 0,      // Limits::max_runs
  kBlobsDropped = 1u << 1,     // Limits::max_blobs
  kContourCut = 1u << 2,       // Limits::max_contour_points
  kFrameSize = 1u << 3,        // the frame has another size than create() was told: not processed
  kRelearned = 1u << 4,        // the background was learned anew (a lamp, a moved camera)
  kHeadTailSwapped = 1u << 5,  // the order of head and tail was corrected in this frame
  kShadowRemoved = 1u << 6,    // Otsu took a shadow away
  kStabilised = 1u << 7,       // the camera's motion was taken out of this frame
};
const char* limit_to_raise(StepFlag flag);  // "" for flags that are no limits

struct StepReport {
  uint32_t flags = 0;
  PoseStatus status = PoseStatus::absent;
  int blobs = 0;               // salient components in this frame
  float foreground_share = 0;  // of the raw mask, 0..1
  StageTimes times;            // nanoseconds per stage; zero without a clock
};

// A salient component, as `live` shows it for selection.
struct BlobView {
  Box box;
  Vec2 centroid;
  int area_px = 0;
  bool selected = false;
};

class Capture {
 public:
  static std::size_t bytes_needed(const Limits& limits, const CaptureSettings& settings);
  // `memory` starts on a 64-byte line and holds at least bytes_needed(); width x height is the frames' size.
  static Result<Capture*> create(std::span<std::byte> memory, const Limits& limits, const CaptureSettings& settings,
                                 int width, int height);

  // Shows the background model one frame before the first step: `still` takes the median of up to 20 of these.
  // A frame of another size is ignored.
  void learn(const Frame& frame);

  StepReport step(const Frame& frame, NowNs now = nullptr);

  // Selection: the blob nearest to a point from the next step on; the next blob in reading order; automatic.
  void select_at(Vec2 point);
  void select_next();
  void select_auto();
  void relearn();  // forget the background and start again with the next frame

  // Fish are numbered 0 to fish_count() - 1 and keep their number for as long as they are followed, through crossings too.
  // One that was lost for good and comes back is known again by its looks at best.
  static constexpr int kTarget = -1;  // the selected one, whatever its number
  int fish_count() const;             // CaptureSettings::max_fish
  int target() const;                 // its number

  const FishPose& pose(int fish = kTarget) const;  // of the last step
  const Motion& motion(int fish = kTarget) const;  // of the last step that gave a pose
  float init_len(int fish = kTarget) const;        // axis length in the first tracked frame, pixels; 0 before (Eq 15)
  // Of the last step that gave a pose: what it says of head and tail, for an OrderPass.
  OrderStep order(int fish = kTarget) const;
  std::span<const BlobView> blobs() const;
  // Original outline of the fish, last step, and its elliptic Fourier reconstruction; empty without a pose.
  std::span<const Vec2> contour(int fish = kTarget) const;
  std::span<const Vec2> smooth_contour(int fish = kTarget) const;
  // Of the last step, frame coordinates: what differs from the background, opened; the fish and their shadows, grown, as they
  // are kept from being learned (without words where there are none).
  BitMask foreground() const;
  BitMask around_fish();
  const char* background_name() const;
  // Where the camera has gone since the background was learned: pixels of that first frame -> pixels of the last one. The
  // identity where the motion is not taken out.
  const Similarity& camera_motion() const;
  bool stabilising() const;        // the camera's motion is taken out, from this frame on
  bool camera_unknowable() const;  // it should be, but the picture has too little texture to see it
  uint64_t integer_hash()
      const;  // of all integer stages of the last step: masks, blobs, contour (settings.fingerprint)

  std::size_t bytes_used() const;         // of the memory handed in
  int contour_points_high_water() const;  // against Limits::max_contour_points
};

}  // namespace nt
