// SPDX-License-Identifier: Apache-2.0
#include "core/pipeline/pipeline.h"

#include "core/base/arena.h"
#include "core/base/det_math.h"
#include "core/base/hash.h"
#include "core/landmarks/landmarks.h"
#include "core/outline/moments.h"
#include "core/outline/trace.h"
#include "core/segment/blobs.h"
#include "core/segment/clean.h"
#include "core/segment/ghost.h"
#include "core/segment/refine.h"
#include "core/segment/target.h"

namespace nt {
namespace {

// A lamp switched on, or a camera that was pushed: this share of the picture differs for this many frames.
constexpr float kFloodShare = 0.4f;
constexpr int kFloodFrames = 8;
constexpr float kRingHole = 0.1f;  // share of the outline: eyes of the ground's tone are 2 %, a ring's hole much more
constexpr int kGhostBlobs = 64;    // more blobs than this are specks, not ghosts; bounds the cost of looking
constexpr int kForgetOrder = 15;   // frames without a pose after which the order of head and tail is open again
constexpr float kTravelFrames = 5.0f;

struct CaptureImpl final : Capture {
  Limits limits;
  CaptureSettings settings;
  int width = 0, height = 0;
  std::size_t bytes_used = 0;

  Background* background = nullptr;
  Blobs* blobs = nullptr;
  Refine* refine = nullptr;
  Landmarks* landmarks = nullptr;
  Target target;
  BitMask raw, scratch, open, keep;
  std::span<Vec2> contour;
  std::span<BlobView> views;

  int contour_count = 0;
  Box fish_box;  // of the contour
  int contour_high_water = 0;
  int view_count = 0;
  int flood_frames = 0;
  bool kept = false;  // `keep` holds a fish
  FishPose pose;
  Motion motion;
  bool has_motion = false;
  float init_len = 0;
  Vec2 last_head, last_tail, last_centre, travel;
  float head_log_odds = 0;
  bool has_last = false;
  int frames_without_pose = 0;
  uint64_t hash = kHashSeed;

  bool layout(Arena& arena, int w, int h);
  StepReport run(const Frame& frame, NowNs now);
  bool segment(const Frame& frame, StageClock& clock, StepReport& report);
  bool outline(const Frame& frame, int blob, StageClock& clock, StepReport& report);
  void find_pose(const Frame& frame, StageClock& clock, StepReport& report);
  void remember_pose();
  void protect_fish(const FishMask* fish);
  void publish_blobs(int selected);
  void take_fingerprint();
  void finish(PoseStatus status, StepReport& report);
};

CaptureImpl& impl(Capture& c) { return static_cast<CaptureImpl&>(c); }
const CaptureImpl& impl(const Capture& c) { return static_cast<const CaptureImpl&>(c); }

BitMask take_mask(Arena& arena, int w, int h) {
  const int words = words_for(w);
  auto space = arena.take<uint64_t>(static_cast<std::size_t>(words) * static_cast<std::size_t>(h));
  return {space.data(), w, h, words};
}

bool CaptureImpl::layout(Arena& arena, int w, int h) {
  auto model = Background::create(arena, limits, settings.background, w, h, settings.seed);
  if (!model.ok()) return false;
  background = model.value();
  raw = take_mask(arena, w, h);
  scratch = take_mask(arena, w, h);
  open = take_mask(arena, w, h);
  keep = take_mask(arena, w, h);
  blobs = Blobs::create(arena, limits);
  refine = Refine::create(arena, limits);
  landmarks = Landmarks::create(arena, limits, {settings.u_num, settings.l_num, settings.harmonics});
  contour = arena.take<Vec2>(static_cast<std::size_t>(max_int(limits.max_contour_points, 0)));
  views = arena.take<BlobView>(static_cast<std::size_t>(max_int(limits.max_blobs, 0)));
  return !arena.full();
}

// Background to blobs. False when the mask of this frame means nothing.
bool CaptureImpl::segment(const Frame& frame, StageClock& clock, StepReport& report) {
  const bool means_something = background->apply(frame.luma, kept ? &keep : nullptr, raw);
  clock.lap(Stage::background);
  report.foreground_share =
      static_cast<float>(count_bits(raw)) / (static_cast<float>(width) * static_cast<float>(height));
  flood_frames = report.foreground_share > kFloodShare ? flood_frames + 1 : 0;
  if (flood_frames >= kFloodFrames) {
    background->restart();
    flood_frames = 0, kept = false;
    report.flags |= kRelearned;
    return false;
  }
  if (!means_something) return false;

  open_mask(raw, scratch, open, settings.open_size);
  clock.lap(Stage::clean);
  const int min_area = settings.min_area_px > 0 ? settings.min_area_px : max_int(width * height / 4000, 9);
  blobs->find(open, min_area);
  if (blobs->runs_dropped()) report.flags |= kRunsDropped;
  if (blobs->blobs_dropped()) report.flags |= kBlobsDropped;
  report.blobs = static_cast<int>(blobs->blobs().size());
  for (int i = 0; i < report.blobs && report.blobs <= kGhostBlobs; ++i) {
    if (!is_ghost(frame.luma, background->estimate(), blobs->runs(), i)) continue;
    blobs->mark_ghost(i);
    background->absorb(frame.luma, blobs->runs(), i);
  }
  clock.lap(Stage::components);
  return true;
}

// The target's outline into `contour`. False when there is none; report.status says why.
bool CaptureImpl::outline(const Frame& frame, int index, StageClock& clock, StepReport& report) {
  const Blob& blob = blobs->blobs()[static_cast<std::size_t>(index)];
  const FishMask fish = refine->fish(frame.luma, background->estimate(), background->noise_sigma(), blob, index,
                                     blobs->runs(), settings.shadows && background->can_have_shadows());
  if (refine->runs_dropped()) report.flags |= kRunsDropped;
  if (refine->blobs_dropped()) report.flags |= kBlobsDropped;
  if (fish.shadow_removed) report.flags |= kShadowRemoved;
  protect_fish(&fish);
  clock.lap(Stage::refine);
  const int count = trace_outline(fish.mask, fish.box.x0, fish.box.y0, contour);
  if (count < 0) report.flags |= kContourCut;
  contour_count = max_int(count, 0);
  contour_high_water = max_int(contour_high_water, contour_count);
  // Two pixels short of the frame's edge the fish may already be cut: its rim is half-transparent.
  const float right = static_cast<float>(width - 3), bottom = static_cast<float>(height - 3);
  bool touches_edge = false;
  for (int i = 0; i < contour_count; ++i) {
    const Vec2 p = contour[static_cast<std::size_t>(i)];
    if (i == 0) fish_box = {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.x), static_cast<int>(p.y)};
    fish_box.x0 = min_int(fish_box.x0, static_cast<int>(p.x)),
    fish_box.x1 = max_int(fish_box.x1, static_cast<int>(p.x) + 1);
    fish_box.y0 = min_int(fish_box.y0, static_cast<int>(p.y)),
    fish_box.y1 = max_int(fish_box.y1, static_cast<int>(p.y) + 1);
    touches_edge |= p.x <= 2 || p.y <= 2 || p.x >= right || p.y >= bottom;
  }
  clock.lap(Stage::outline);
  // By Pick's theorem an outline of n border pixels and area A holds A + n / 2 + 1 pixels; what the mask lacks is a hole.
  const float enclosed = det::abs(polygon_area({contour.data(), static_cast<std::size_t>(contour_count)})) +
                         0.5f * static_cast<float>(contour_count) + 1.0f;
  const bool ring = enclosed - static_cast<float>(count_bits(fish.mask)) > kRingHole * enclosed;
  if (touches_edge) report.status = PoseStatus::partial;
  else if (ring) report.status = PoseStatus::occluded;
  return contour_count > 0 && !touches_edge && !ring;
}

// The fish is not learned as background: what is around it becomes next frame's `keep`.
void CaptureImpl::protect_fish(const FishMask* fish) {
  clear_mask(keep);
  kept = fish != nullptr;
  if (!kept) return;
  for (int y = 0; y < fish->around.height; ++y) {
    const uint64_t* from = fish->around.row(y);
    uint64_t* to = keep.row(y + fish->box.y0) + fish->box.x0 / 64;
    for (int i = 0; i < fish->around.words_per_row; ++i) to[i] = from[i];
  }
}

void CaptureImpl::publish_blobs(int selected) {
  view_count = 0;
  for (const Blob& b : blobs->blobs()) {
    const bool mine = view_count == selected;
    views[static_cast<std::size_t>(view_count++)] = {b.box, b.centroid, b.area_px, mine};
  }
}

void CaptureImpl::remember_pose() {
  head_log_odds = landmarks->head_log_odds();
  // Travel over about the last kTravelFrames, as a running sum that forgets.
  travel = has_last ? travel * (1.0f - 1.0f / kTravelFrames) + (pose.centre - last_centre) : Vec2{};
  last_head = pose.head, last_tail = pose.tail, last_centre = pose.centre;
  has_last = true;
  frames_without_pose = 0;
  if (init_len == 0) init_len = pose.axis_len;
}

void CaptureImpl::find_pose(const Frame& frame, StageClock& clock, StepReport& report) {
  // After a gap the fish may have turned round out of sight: only shape and travel say where its head is.
  if (target.changed() || frames_without_pose > kForgetOrder) has_last = false, head_log_odds = 0;
  if (target.changed()) init_len = 0;
  LandmarkHints hints;
  hints.has_last = has_last;
  const Vec2 moved = target.velocity() * static_cast<float>(frames_without_pose + 1);
  hints.last_head = last_head + moved, hints.last_tail = last_tail + moved;
  hints.head_log_odds = head_log_odds;
  hints.travel = has_last ? travel : target.velocity() * kTravelFrames;
  const bool found = landmarks->find({contour.data(), static_cast<std::size_t>(contour_count)}, hints, pose);
  clock.lap(Stage::landmarks);
  if (!found || !target.observe(fish_box, pose.centre, landmarks->area_px(), pose.axis_len)) {
    report.status = PoseStatus::occluded;
    return;
  }
  if (landmarks->swapped()) report.flags |= kHeadTailSwapped;
  pose.status = report.status = PoseStatus::ok;
  remember_pose();
  motion = motion_from_pose(pose, frame.timestamp_ns, has_motion ? &motion : nullptr);
  has_motion = true;
  clock.lap(Stage::motion);
}

void CaptureImpl::take_fingerprint() {
  hash = kHashSeed;
  for (int i = 0; i < raw.words_per_row * height; ++i) hash = hash_u64(raw.words[i], hash);
  for (const Blob& b : blobs->blobs()) {
    hash = hash_u64(static_cast<uint64_t>(b.area_px), hash);
    hash = hash_u64(static_cast<uint64_t>(b.box.x0) << 32 | static_cast<uint64_t>(b.box.y0), hash);
  }
  for (const Vec2 p : contour.first(static_cast<std::size_t>(contour_count)))
    hash = hash_u64(static_cast<uint64_t>(p.x) << 32 | static_cast<uint64_t>(p.y), hash);
}

void CaptureImpl::finish(PoseStatus status, StepReport& report) {
  report.status = status;
  if (status != PoseStatus::ok) {
    ++frames_without_pose;
    pose.status = status;
    pose.confidence = {};
    contour_count = 0;
  }
  if (settings.fingerprint) take_fingerprint();
}

StepReport CaptureImpl::run(const Frame& frame, NowNs now) {
  StepReport report;
  StageClock clock(now, report.times);
  view_count = 0;
  if (frame.luma.width != width || frame.luma.height != height) {
    report.flags |= kFrameSize;
    finish(PoseStatus::absent, report);
    return report;
  }
  if (!segment(frame, clock, report)) {
    finish(PoseStatus::relearn, report);
    return report;
  }
  const TargetChoice choice = target.update(blobs->blobs());
  publish_blobs(choice.blob);
  clock.lap(Stage::target);
  report.status = choice.status;
  if (choice.blob < 0) {
    if (choice.status == PoseStatus::absent) kept = false;
  } else if (outline(frame, choice.blob, clock, report) && choice.status == PoseStatus::ok) {
    find_pose(frame, clock, report);
  } else if (report.status == PoseStatus::ok) {
    report.status = PoseStatus::lost;
  }
  finish(report.status, report);
  return report;
}

}  // namespace

std::size_t Capture::bytes_needed(const Limits& limits, const CaptureSettings& settings) {
  Arena arena;
  arena.take<CaptureImpl>(1);
  CaptureImpl measured;
  measured.limits = limits, measured.settings = settings;
  measured.layout(arena, limits.max_width, limits.max_height);
  return arena.used();
}

Result<Capture*> Capture::create(std::span<std::byte> memory, const Limits& limits, const CaptureSettings& settings,
                                 int width, int height) {
  if (width < 16 || height < 16)
    return Status{StatusCode::bad_argument, "frames under 16x16 pixels are too small to hold a fish"};
  if (width > limits.max_width || height > limits.max_height)
    return Status{StatusCode::bad_argument, "the frame does not fit Limits::max_width x max_height: raise them"};
  if (settings.open_size < 1 || settings.open_size % 2 == 0)
    return Status{StatusCode::bad_argument, "open_size must be odd: 1, 3, 5 ..."};
  Arena arena(memory);
  auto self = arena.take<CaptureImpl>(1);
  if (self.empty())
    return Status{StatusCode::out_of_memory, "the memory handed to core is smaller than bytes_needed()"};
  CaptureImpl& c = self[0];
  c.limits = limits, c.settings = settings;
  c.width = width, c.height = height;
  if (!c.layout(arena, width, height))
    return Status{StatusCode::out_of_memory, "the memory handed to core is smaller than bytes_needed()"};
  c.target.set_lost_after(settings.lost_after);
  c.bytes_used = arena.used();
  return static_cast<Capture*>(&c);
}

void Capture::learn(const Frame& frame) {
  CaptureImpl& c = impl(*this);
  if (frame.luma.width == c.width && frame.luma.height == c.height) c.background->learn(frame.luma);
}
StepReport Capture::step(const Frame& frame, NowNs now) { return impl(*this).run(frame, now); }
void Capture::select_at(Vec2 point) { impl(*this).target.select_at(point); }
void Capture::select_next() { impl(*this).target.select_next(); }
void Capture::select_auto() { impl(*this).target.select_auto(); }
void Capture::relearn() { impl(*this).background->restart(), impl(*this).kept = false; }
const FishPose& Capture::pose() const { return impl(*this).pose; }
const Motion& Capture::motion() const { return impl(*this).motion; }
float Capture::init_len() const { return impl(*this).init_len; }
std::span<const BlobView> Capture::blobs() const {
  return impl(*this).views.first(static_cast<std::size_t>(impl(*this).view_count));
}
std::span<const Vec2> Capture::contour() const {
  return impl(*this).contour.first(static_cast<std::size_t>(impl(*this).contour_count));
}
std::span<const Vec2> Capture::smooth_contour() const {
  return impl(*this).pose.ok() ? impl(*this).landmarks->smooth_contour() : std::span<const Vec2>{};
}
const char* Capture::background_name() const { return impl(*this).background->name(); }
uint64_t Capture::integer_hash() const { return impl(*this).hash; }
std::size_t Capture::bytes_used() const { return impl(*this).bytes_used; }
int Capture::contour_points_high_water() const { return impl(*this).contour_high_water; }

const char* limit_to_raise(StepFlag flag) {
  switch (flag) {
    case kRunsDropped:
      return "max_runs";
    case kBlobsDropped:
      return "max_blobs";
    case kContourCut:
      return "max_contour_points";
    case kFrameSize:
      return "max_width, max_height";
    default:
      return "";
  }
}

}  // namespace nt
