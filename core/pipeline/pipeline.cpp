// SPDX-License-Identifier: Apache-2.0
#include "core/pipeline/pipeline.h"

#include "core/base/arena.h"
#include "core/base/hash.h"
#include "core/landmarks/landmarks.h"
#include "core/pipeline/fish_track.h"
#include "core/segment/blobs.h"
#include "core/segment/clean.h"
#include "core/segment/ghost.h"
#include "core/segment/refine.h"

namespace nt {
namespace {

// A lamp switched on, or a camera that was pushed: this share of the picture differs for this many frames.
constexpr float kFloodShare = 0.4f;
constexpr int kFloodFrames = 8;
constexpr int kGhostBlobs = 64;  // more blobs than this are specks, not ghosts; bounds the cost of looking

struct CaptureImpl final : Capture {
  Limits limits;
  CaptureSettings settings;
  int width = 0, height = 0;
  std::size_t bytes_used = 0;

  Background* background = nullptr;
  Blobs* blobs = nullptr;
  Refine* refine = nullptr;
  Landmarks* landmarks = nullptr;
  BitMask raw, scratch, open;
  std::span<BlobView> views;
  FishTrack fish;

  int view_count = 0;
  int flood_frames = 0;
  uint64_t hash = kHashSeed;

  bool layout(Arena& arena, int w, int h);
  StepReport run(const Frame& frame, NowNs now);
  bool segment(const Frame& frame, StageClock& clock, StepReport& report);
  void publish_blobs(int selected);
  void take_fingerprint();
  StepReport finish(StepReport report, PoseStatus status);
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
  blobs = Blobs::create(arena, limits);
  refine = Refine::create(arena, limits);
  landmarks = Landmarks::create(arena, limits, {settings.u_num, settings.l_num, settings.harmonics});
  views = arena.take<BlobView>(static_cast<std::size_t>(max_int(limits.max_blobs, 0)));
  return fish.layout(arena, limits, w, h);
}

// Background to blobs. False when the mask of this frame means nothing.
bool CaptureImpl::segment(const Frame& frame, StageClock& clock, StepReport& report) {
  const bool means_something = background->apply(frame.luma, fish.protected_now ? &fish.protect : nullptr, raw);
  clock.lap(Stage::background);
  report.foreground_share =
      static_cast<float>(count_bits(raw)) / (static_cast<float>(width) * static_cast<float>(height));
  flood_frames = report.foreground_share > kFloodShare ? flood_frames + 1 : 0;
  if (flood_frames >= kFloodFrames) {
    background->restart();
    flood_frames = 0;
    fish.unprotect();
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

void CaptureImpl::publish_blobs(int selected) {
  view_count = 0;
  for (const Blob& b : blobs->blobs()) {
    const bool mine = view_count == selected;
    views[static_cast<std::size_t>(view_count++)] = {b.box, b.centroid, b.area_px, mine};
  }
}

void CaptureImpl::take_fingerprint() {
  hash = kHashSeed;
  for (int i = 0; i < raw.words_per_row * height; ++i) hash = hash_u64(raw.words[i], hash);
  for (const Blob& b : blobs->blobs()) {
    hash = hash_u64(static_cast<uint64_t>(b.area_px), hash);
    hash = hash_u64(static_cast<uint64_t>(b.box.x0) << 32 | static_cast<uint64_t>(b.box.y0), hash);
  }
  for (const Vec2 p : fish.contour.first(static_cast<std::size_t>(fish.contour_count)))
    hash = hash_u64(static_cast<uint64_t>(p.x) << 32 | static_cast<uint64_t>(p.y), hash);
}

StepReport CaptureImpl::finish(StepReport report, PoseStatus status) {
  report.status = status;
  if (settings.fingerprint) take_fingerprint();
  return report;
}

StepReport CaptureImpl::run(const Frame& frame, NowNs now) {
  StepReport report;
  StageClock clock(now, report.times);
  view_count = 0;
  if (frame.luma.width != width || frame.luma.height != height) {
    report.flags |= kFrameSize;
    fish.miss(PoseStatus::absent);
    return finish(report, PoseStatus::absent);
  }
  if (!segment(frame, clock, report)) {
    fish.miss(PoseStatus::relearn);
    return finish(report, PoseStatus::relearn);
  }
  const TargetChoice choice = fish.target.update(blobs->blobs());
  publish_blobs(choice.blob);
  clock.lap(Stage::target);
  const CaptureTools tools{frame, settings, *background, *blobs, *refine, *landmarks, clock, report};
  const PoseStatus status = fish.follow(tools, choice);
  return finish(report, status);
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
  c.fish.target.set_lost_after(settings.lost_after);
  c.bytes_used = arena.used();
  return static_cast<Capture*>(&c);
}

void Capture::learn(const Frame& frame) {
  CaptureImpl& c = impl(*this);
  if (frame.luma.width == c.width && frame.luma.height == c.height) c.background->learn(frame.luma);
}
StepReport Capture::step(const Frame& frame, NowNs now) { return impl(*this).run(frame, now); }
void Capture::select_at(Vec2 point) { impl(*this).fish.target.select_at(point); }
void Capture::select_next() { impl(*this).fish.target.select_next(); }
void Capture::select_auto() { impl(*this).fish.target.select_auto(); }
void Capture::relearn() { impl(*this).background->restart(), impl(*this).fish.unprotect(); }
const FishPose& Capture::pose() const { return impl(*this).fish.pose; }
const Motion& Capture::motion() const { return impl(*this).fish.motion; }
float Capture::init_len() const { return impl(*this).fish.init_len; }
std::span<const BlobView> Capture::blobs() const {
  return impl(*this).views.first(static_cast<std::size_t>(impl(*this).view_count));
}
std::span<const Vec2> Capture::contour() const {
  const FishTrack& fish = impl(*this).fish;
  return fish.contour.first(static_cast<std::size_t>(fish.contour_count));
}
std::span<const Vec2> Capture::smooth_contour() const {
  const FishTrack& fish = impl(*this).fish;
  return fish.pose.ok() ? fish.smooth : std::span<const Vec2>{};
}
const char* Capture::background_name() const { return impl(*this).background->name(); }
uint64_t Capture::integer_hash() const { return impl(*this).hash; }
std::size_t Capture::bytes_used() const { return impl(*this).bytes_used; }
int Capture::contour_points_high_water() const { return impl(*this).fish.contour_high_water; }

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
