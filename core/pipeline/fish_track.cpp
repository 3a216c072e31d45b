// SPDX-License-Identifier: Apache-2.0
#include "core/pipeline/fish_track.h"

#include <array>

#include "core/base/det_math.h"
#include "core/outline/moments.h"
#include "core/outline/stations.h"
#include "core/outline/trace.h"
#include "core/segment/clean.h"
#include "core/segment/part.h"

namespace nt {
namespace {

constexpr float kRingHole = 0.1f;  // share of the outline: eyes of the ground's tone are 2 %, a ring's hole much more
constexpr int kForgetOrder = 15;   // frames without a pose after which the order of head and tail is open again
constexpr float kTravelFrames = 5.0f;
// What has been there for less, or is smaller, may be a part of this fish.
constexpr int kKnownFrames = 10;
constexpr float kFishBeside = 0.35f;
constexpr float kNearlyClosed = 0.6f;                // of the axis, from head to tail
constexpr float kCaudalFin = 0.19f;                  // of the axis that is seen without it
constexpr float kWhole = 1.13f, kWholePart = 0.05f;  // of a fish's usual axis; how much of it a frame is
constexpr float kGrowth = 1.08f, kBeside = 0.5f;     // of a fish that swims in, in a frame; of the axis, from the edge
constexpr float kCutWidth = 1.5f;                    // pixels, either side of the line that opens a ring

}  // namespace

bool FishTrack::layout(Arena& arena, const Limits& limits, int width, int height) {
  const int words = words_for(width);
  auto mask = arena.take<uint64_t>(static_cast<std::size_t>(words) * static_cast<std::size_t>(height));
  protect = {mask.data(), width, height, words};
  contour = arena.take<Vec2>(static_cast<std::size_t>(max_int(limits.max_contour_points, 0)));
  smooth = arena.take<Vec2>(2 * kStations);
  return !arena.full();
}

PoseStatus FishTrack::follow(const CaptureTools& tools) {
  Swimmer* swimmer = tools.swimmers.find(swimmer_id);
  if (swimmer == nullptr) unprotect();
  const PoseStatus status = swimmer != nullptr ? look_for(tools, *swimmer) : PoseStatus::absent;
  if (status != PoseStatus::ok) miss(status);
  return status;
}

PoseStatus FishTrack::look_for(const CaptureTools& tools, Swimmer& swimmer) {
  if (swimmer.blob < 0) return PoseStatus::lost;
  const Blob& blob = tools.blobs.blobs()[static_cast<std::size_t>(swimmer.blob)];
  const PoseStatus status = outline(tools, swimmer);
  if (swimmer.in_heap) return PoseStatus::occluded;
  if (!blob.touches_edge) looks = swimmer.looks;
  entering_ |= blob.touches_edge || status == PoseStatus::partial;
  if (status != PoseStatus::ok) return status;
  return blob.touches_edge ? PoseStatus::partial : find_pose(tools, swimmer);
}

void FishTrack::miss(PoseStatus status) {
  ++frames_without_pose_;
  pose.status = status;
  pose.confidence = {};
  contour_count = 0;
}

// The blob's outline into `contour`; ok, or why it can give no pose.
PoseStatus FishTrack::outline(const CaptureTools& tools, const Swimmer& swimmer) {
  const int index = swimmer.blob;
  const Blob& blob = tools.blobs.blobs()[static_cast<std::size_t>(index)];
  const LumaView luma = tools.frame.luma;
  Refine& refine = tools.refine;
  const FishMask fish =
      refine.fish(luma, tools.background.estimate(), tools.background.noise_sigma(), blob, index, tools.blobs.runs(),
                  tools.settings.shadows && tools.background.can_have_shadows(), &tools.background);
  if (refine.runs_dropped()) tools.report.flags |= kRunsDropped;
  if (refine.blobs_dropped()) tools.report.flags |= kBlobsDropped;
  if (fish.shadow_removed) tools.report.flags |= kShadowRemoved;
  fins_may_hide_ = fish.fins_may_hide;
  protect_from_learning(fish);
  const bool leaves_tank = clip(tools, fish);
  touching_ = part(tools, fish, index);
  tools.clock.lap(Stage::refine);
  trace(tools, fish);
  const bool ring = may_be_closed() && is_ring(fish);
  if (ring && open_ring(fish, predicted(swimmer))) trace(tools, fish);
  const bool cut = measure_contour(luma.width, luma.height, tools.frame_from_reference);
  tools.clock.lap(Stage::outline);
  if (cut || leaves_tank) return PoseStatus::partial;
  if (ring && is_ring(fish)) return PoseStatus::occluded;
  return contour_count > 0 ? PoseStatus::ok : PoseStatus::lost;
}

void FishTrack::trace(const CaptureTools& tools, const FishMask& fish) {
  const int count = trace_outline(fish.mask, fish.box.x0, fish.box.y0, contour);
  if (count < 0) tools.report.flags |= kContourCut;
  contour_count = max_int(count, 0);
  contour_high_water = max_int(contour_high_water, contour_count);
}

// A fish that was straight a moment ago is no ring now: what its outline encloses lies between it and remains of its shadow.
bool FishTrack::may_be_closed() const {
  if (!has_last_ || frames_without_pose_ > kForgetOrder) return true;
  return length(last_axis_[0] - last_axis_[kOrderPoints - 1]) < kNearlyClosed * pose.axis_len;
}

// By Pick's theorem an outline of n border pixels and area A holds A + n / 2 + 1 pixels; what the mask lacks is a hole.
bool FishTrack::is_ring(const FishMask& fish) const {
  const float enclosed = det::abs(polygon_area(points())) + 0.5f * static_cast<float>(contour_count) + 1.0f;
  return enclosed - static_cast<float>(count_bits(fish.mask)) > kRingHole * enclosed;
}

// Where the head meets the tail an outline has no ends. They touch where they were last seen to come together: the ring is
// cut there, along the ray from its middle through the point halfway between them. False without a pose to go by.
bool FishTrack::open_ring(const FishMask& fish, Vec2 moved) const {
  if (!has_last_ || frames_without_pose_ > kForgetOrder) return false;
  const Vec2 middle = polygon_moments(points()).centroid;
  const Vec2 gap = lerp(last_axis_[0], last_axis_[kOrderPoints - 1], 0.5f) + moved - middle;
  if (length_sq(gap) == 0.0f) return false;
  const Vec2 ray = normalised(gap);
  for (int y = 0; y < fish.mask.height; ++y) {
    for (int x = 0; x < fish.mask.width; ++x) {
      const Vec2 p = Vec2{static_cast<float>(x + fish.box.x0), static_cast<float>(y + fish.box.y0)} - middle;
      if (dot(p, ray) > 0.0f && det::abs(cross(ray, p)) < kCutWidth) fish.mask.clear(x, y);
    }
  }
  return true;
}

// How far it has swum since the last pose.
Vec2 FishTrack::predicted(const Swimmer& swimmer) const {
  return swimmer.velocity * static_cast<float>(frames_without_pose_ + 1);
}

// Cuts off what lies outside of the tank; true when there was something.
bool FishTrack::clip(const CaptureTools& tools, const FishMask& fish) const {
  if (tools.tank == nullptr) return false;
  uint64_t outside = 0;
  for (int y = 0; y < fish.mask.height; ++y) {
    uint64_t* row = fish.mask.row(y);
    const uint64_t* tank = tools.tank->row(y + fish.box.y0) + fish.box.x0 / 64;
    for (int i = 0; i < fish.mask.words_per_row; ++i) outside |= row[i] & ~tank[i], row[i] &= tank[i];
  }
  return outside != 0;
}

// Takes away from what was taken back to the blob what belongs to other swimmers whose fins touch this one's. False when
// there are none.
bool FishTrack::part(const CaptureTools& tools, const FishMask& fish, int mine) const {
  std::array<int, Swimmers::kMostSwimmers> others{};
  std::size_t count = 0;
  for (const Swimmer& other : tools.swimmers.all()) {
    if (other.blob < 0 || other.blob == mine || other.frames < kKnownFrames ||
        other.looks.area_px < kFishBeside * looks.area_px)
      continue;
    const Box& there = tools.blobs.blobs()[static_cast<std::size_t>(other.blob)].box;
    if (there.x0 >= fish.box.x1 || there.x1 <= fish.box.x0 || there.y0 >= fish.box.y1 || there.y1 <= fish.box.y0)
      continue;
    for (const Run& run : tools.blobs.runs()) {
      if (run.label != other.blob || !fish.mask.at((run.x0 + run.x1) / 2 - fish.box.x0, run.y - fish.box.y0)) continue;
      others[count++] = other.blob;
      break;
    }
  }
  if (count == 0) return false;
  const auto words = [&](std::size_t i) {
    const BitMask& m = tools.scratch[i];
    return std::span<uint64_t>(m.words, static_cast<std::size_t>(m.words_per_row) * static_cast<std::size_t>(m.height));
  };
  part_from_others(fish.mask, fish.box, tools.blobs.runs(), mine, std::span<const int>(others).first(count), words(0),
                   words(1), words(2));
  return true;
}

// Its box; true when the fish may be cut by the edge of the frame or of the reference: two pixels short of it, because its
// rim is half-transparent.
bool FishTrack::measure_contour(int width, int height, const Similarity& frame_from_reference) {
  const float right = static_cast<float>(width - 3), bottom = static_cast<float>(height - 3);
  const auto at_edge = [&](Vec2 p) { return p.x <= 2 || p.y <= 2 || p.x >= right || p.y >= bottom; };
  bool cut = false;
  if (contour_count > 0) box = {width, height, 0, 0};
  for (const Vec2 p : points()) {
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    box.x0 = min_int(box.x0, x), box.x1 = max_int(box.x1, x + 1);
    box.y0 = min_int(box.y0, y), box.y1 = max_int(box.y1, y + 1);
    cut |= at_edge(p) || at_edge(frame_from_reference(p));
  }
  return cut;
}

// The caudal fin of a fish that swims in is seen last, and where it may hide, not at all: whether it may still be outside.
// So may the rest of a fish that grows from frame to frame beside the edge: light on the wall can hide where it is cut.
bool FishTrack::tail_may_be_outside(const CaptureTools& tools) {
  const bool grows = pose.axis_len > kGrowth * last_len_;
  last_len_ = pose.axis_len;
  if (!entering_) return false;
  const float most_x = static_cast<float>(tools.frame.luma.width - 1),
              most_y = static_cast<float>(tools.frame.luma.height - 1);
  float room = fins_may_hide_ ? (grows ? kBeside : kCaudalFin) * pose.axis_len : 0.0f;
  // Of one that has been here before, no more is missing than it had then.
  const float missing = kWhole * whole_len_ - pose.axis_len;
  if (missing > 0) room = det::min(room, missing);
  const auto near_edge = [&](Vec2 p) {
    return det::min(det::min(p.x, p.y), det::min(most_x - p.x, most_y - p.y)) < room;
  };
  entering_ = near_edge(pose.head) || near_edge(pose.tail);
  return entering_;
}

LandmarkHints FishTrack::hints(const CaptureTools& tools, const Swimmer& swimmer, std::span<Vec2> last) const {
  LandmarkHints hints;
  const Vec2 moved = predicted(swimmer);
  for (std::size_t i = 0; i < last.size(); ++i) last[i] = last_axis_[i] + moved;
  if (has_last_) hints.last = last;
  hints.head_log_odds = head_log_odds_;
  hints.trust = 1.0f - static_cast<float>(frames_without_pose_) / (kForgetOrder + 1);
  hints.travel = has_last_ ? travel_ : swimmer.velocity * kTravelFrames;
  if (has_last_) hints.usual_length = whole_len_;
  hints.luma = tools.frame.luma, hints.ground = tools.background.estimate();
  return hints;
}

PoseStatus FishTrack::find_pose(const CaptureTools& tools, Swimmer& swimmer) {
  // After a gap the fish may have turned round out of sight: only shape and travel say where its head is.
  const bool changed = last_swimmer_ != swimmer.id;
  last_swimmer_ = swimmer.id;
  if (changed || frames_without_pose_ > kForgetOrder) has_last_ = false, head_log_odds_ = 0;
  if (changed) init_len = last_len_ = 0;
  Landmarks& landmarks = tools.landmarks;
  Vec2 last[kOrderPoints];
  const bool found = landmarks.find(points(), hints(tools, swimmer, last), pose);
  tools.clock.lap(Stage::landmarks);
  const int largest = tools.settings.max_area_px;
  const bool too_large = largest > 0 && landmarks.area_px() > static_cast<float>(largest);
  if (!found || too_large ||
      !swimmer.observe(box, pose.centre, landmarks.area_px(), pose.axis_len, touching_, tools.settings.lost_after))
    return PoseStatus::occluded;
  if (tail_may_be_outside(tools)) return PoseStatus::partial;
  if (landmarks.swapped()) tools.report.flags |= kHeadTailSwapped;
  pose.status = PoseStatus::ok;
  remember(landmarks);
  if (tools.moved) to_frame(tools.frame_from_reference);
  motion = motion_from_pose(pose, tools.frame.timestamp_ns, has_motion ? &motion : nullptr);
  has_motion = true;
  tools.clock.lap(Stage::motion);
  return PoseStatus::ok;
}

void FishTrack::remember(const Landmarks& landmarks) {
  head_log_odds_ = landmarks.head_log_odds();
  // Travel over about the last kTravelFrames, as a running sum that forgets.
  travel_ = has_last_ ? travel_ * (1.0f - 1.0f / kTravelFrames) + (pose.centre - last_centre_) : Vec2{};
  const std::span<const Vec2> midline = landmarks.midline();
  for (int i = 0; i < kOrderPoints; ++i)
    last_axis_[i] = midline[static_cast<std::size_t>(i * (kStations - 1) / (kOrderPoints - 1))];
  last_centre_ = pose.centre;
  order = landmarks.order();
  has_last_ = true;
  frames_without_pose_ = 0;
  if (init_len == 0) init_len = pose.axis_len;
  whole_len_ += (pose.axis_len - whole_len_) * (whole_len_ == 0 ? 1.0f : kWholePart);
  const std::span<const Vec2> reconstruction = landmarks.smooth_contour();
  for (std::size_t i = 0; i < smooth.size(); ++i) smooth[i] = reconstruction[i];
}

// Everything that is handed out.
void FishTrack::to_frame(const Similarity& t) {
  for (Vec2& p : contour.first(static_cast<std::size_t>(contour_count))) p = t(p);
  for (Vec2& p : smooth) p = t(p);
  for (Vec2* p : {&pose.centre, &pose.head, &pose.tail, &pose.l_fin, &pose.r_fin, &pose.jun_tl, &pose.jun_tr,
                  &pose.jun_bl, &pose.jun_br})
    *p = t(*p);
  for (Vec2& p : pose.up_axis) p = t(p);
  for (Vec2& p : pose.low_axis) p = t(p);
  pose.dir = normalised(t.turned(pose.dir));
  pose.axis_len *= t.scale();
}

void FishTrack::change_reference(const Similarity& new_from_old) {
  for (Vec2& p : last_axis_) p = new_from_old(p);
  last_centre_ = new_from_old(last_centre_);
  travel_ = new_from_old.turned(travel_);
}

// What is around the fish becomes next frame's `protect`.
void FishTrack::protect_from_learning(const FishMask& fish) {
  clear_mask(protect);
  protected_now = true;
  for (int y = 0; y < fish.around.height; ++y) {
    const uint64_t* from = fish.around.row(y);
    uint64_t* to = protect.row(y + fish.box.y0) + fish.box.x0 / 64;
    for (int i = 0; i < fish.around.words_per_row; ++i) to[i] = from[i];
  }
}

}  // namespace nt
