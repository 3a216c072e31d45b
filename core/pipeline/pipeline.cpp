// SPDX-License-Identifier: Apache-2.0
#include "core/pipeline/pipeline.h"

#include <array>

#include "core/base/arena.h"
#include "core/base/hash.h"
#include "core/landmarks/landmarks.h"
#include "core/pipeline/fish_track.h"
#include "core/segment/blobs.h"
#include "core/segment/clean.h"
#include "core/segment/first_sight.h"
#include "core/segment/ghost.h"
#include "core/segment/refine.h"
#include "core/segment/swimmers.h"
#include "core/segment/target.h"

namespace nt {
namespace {

// A lamp switched on, or a camera that was pushed: this share of the picture differs for this many frames.
constexpr float kFloodShare = 0.4f;
constexpr int kFloodFrames = 8;
// Who besides the target is a fish: seen for so long, of that shape, and having swum so many of its lengths.
constexpr int kFishFrames = 10;
constexpr float kFishLike = 0.25f, kFishTravel = 0.5f;
constexpr float kSameLooks = 0.25f;  // Looks::unlike, up to which one that comes in is one that was lost
constexpr int kGhostBlobs = 64;      // more blobs than this are specks, not ghosts; bounds the cost of looking

struct CaptureImpl final : Capture {
  Limits limits;
  CaptureSettings settings;
  int width = 0, height = 0;
  std::size_t bytes_used = 0;

  Background* background = nullptr;
  Stabiliser* stabiliser = nullptr;  // null: the camera stands still
  Blobs* blobs = nullptr;
  Refine* refine = nullptr;
  Landmarks* landmarks = nullptr;
  FirstSight first_sight;
  BitMask raw, open, scratch;
  std::span<BlobView> views;
  Swimmers swimmers;
  Target target;
  std::span<FishTrack> fish;
  int target_fish = 0;
  BitMask tank;  // where fish can be; of width 0: everywhere
  int tank_pixels = 0;
  BitMask keep;  // what all fish protect, where there are several
  Similarity frame_from_reference;
  bool has_background = false;  // its estimate means something

  int view_count = 0;
  int flood_frames = 0;
  uint64_t raw_hash = kHashSeed, hash = kHashSeed;

  bool layout(Arena& arena, int w, int h);
  StepReport run(const Frame& frame, NowNs now);
  bool steady(Frame& frame, StageClock& clock, StepReport& report);
  void restart_background();
  void change_reference();
  bool segment(const Frame& frame, StageClock& clock, StepReport& report);
  void fill_tank();
  const BitMask* protected_pixels();
  void unprotect();
  bool protects() const;
  void number_fish();
  int number_for(const Swimmer& swimmer) const;
  bool is_fish(const Swimmer& swimmer) const;
  PoseStatus miss_all(PoseStatus status);
  void publish_blobs();
  FishTrack& the_fish(int i) { return fish[static_cast<std::size_t>(i < 0 ? target_fish : i)]; }
  const FishTrack& the_fish(int i) const { return fish[static_cast<std::size_t>(i < 0 ? target_fish : i)]; }
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
  // An even field shows nothing of the camera's motion, only particles of their own.
  const bool even = settings.background.kind == BackgroundKind::backlit;
  const Stabilise mode = even && settings.stabilise == Stabilise::automatic ? Stabilise::off : settings.stabilise;
  stabiliser = Stabiliser::create(arena, mode, w, h);
  raw = take_mask(arena, w, h);
  scratch = take_mask(arena, w, h);
  open = take_mask(arena, w, h);
  blobs = Blobs::create(arena, limits);
  refine = Refine::create(arena, limits);
  landmarks = Landmarks::create(arena, limits, {settings.u_num, settings.l_num, settings.harmonics});
  views = arena.take<BlobView>(static_cast<std::size_t>(max_int(limits.max_blobs, 0)));
  if (settings.tank.data != nullptr) tank = take_mask(arena, w, h);
  const int count = clamp_int(settings.max_fish, 1, kMostFish);
  if (count > 1) keep = take_mask(arena, w, h);
  fish = arena.take<FishTrack>(static_cast<std::size_t>(count));
  FishTrack unmeasured;  // a measuring arena hands out no fish
  for (int i = 0; i < count; ++i) {
    FishTrack& one = fish.empty() ? unmeasured : fish[static_cast<std::size_t>(i)];
    if (!one.layout(arena, limits, w, h)) return false;
  }
  return !arena.full();
}

void CaptureImpl::fill_tank() {
  tank_pixels = width * height;
  if (tank.empty()) return;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (settings.tank.row(y)[x] != 0) tank.set(x, y);
  tank_pixels = max_int(count_bits(tank), 1);
  settings.tank = {};  // its owner may forget it
}

// The frame as the reference camera would have seen it. False when it cannot be told.
bool CaptureImpl::steady(Frame& frame, StageClock& clock, StepReport& report) {
  if (stabiliser == nullptr) return true;
  const Stabilised seen = stabiliser->apply(frame.luma, has_background ? background->estimate() : LumaView{});
  clock.lap(Stage::stabilise);
  if (seen.renewed) {
    change_reference();
    background->restart();
    unprotect();
    report.flags |= kRelearned;
    return true;
  }
  if (seen.lost) return false;
  frame.luma = seen.luma;
  frame_from_reference = seen.frame_from_reference;
  if (seen.moved) report.flags |= kStabilised;
  return true;
}

void CaptureImpl::restart_background() {
  background->restart();
  flood_frames = 0;
  unprotect();
  if (stabiliser == nullptr) return;
  stabiliser->restart();
  change_reference();
}

// From now on places are counted from what the camera sees now.
void CaptureImpl::change_reference() {
  for (FishTrack& one : fish) one.change_reference(frame_from_reference);
  for (Swimmer& one : swimmers.all()) one.change_reference(frame_from_reference);
  frame_from_reference = {};
}

// Background to blobs. False when the mask of this frame means nothing.
bool CaptureImpl::segment(const Frame& frame, StageClock& clock, StepReport& report) {
  const int min_area = settings.min_area_px > 0 ? settings.min_area_px : max_int(width * height / 4000, 9);
  if (!background->ready() && !protects())
    fish[0].protected_now = first_sight.find(frame.luma, min_area, *blobs, raw, scratch, fish[0].protect) > 0;
  background->see_chroma(frame.cb, frame.cr);
  const bool means_something = background->apply(frame.luma, protected_pixels(), raw);
  has_background = true;
  if (background->relit()) report.flags |= kRelearned;
  clock.lap(Stage::background);
  if (!tank.empty())
    for (int i = 0; i < raw.words_per_row * height; ++i) raw.words[i] &= tank.words[i];
  report.foreground_share = static_cast<float>(count_bits(raw)) / static_cast<float>(tank_pixels);
  if (settings.fingerprint) {
    raw_hash = kHashSeed;
    for (int i = 0; i < raw.words_per_row * height; ++i) raw_hash = hash_u64(raw.words[i], raw_hash);
  }
  flood_frames = report.foreground_share > kFloodShare ? flood_frames + 1 : 0;
  if (flood_frames >= kFloodFrames) {
    restart_background();
    report.flags |= kRelearned;
    return false;
  }
  if (!means_something) return false;

  open_mask(raw, scratch, open, settings.open_size);
  clock.lap(Stage::clean);
  blobs->find(open, min_area);
  if (blobs->runs_dropped()) report.flags |= kRunsDropped;
  if (blobs->blobs_dropped()) report.flags |= kBlobsDropped;
  report.blobs = static_cast<int>(blobs->blobs().size());
  for (int i = 0; i < report.blobs && report.blobs <= kGhostBlobs; ++i) {
    if (!is_ghost(frame.luma, background->estimate(), blobs->runs(), i)) continue;
    blobs->mark_ghost(i);
    background->absorb(frame.luma, blobs->runs(), i);
  }
  if (const int stone = first_sight.lifeless(blobs->blobs()); stone >= 0) {
    blobs->mark_ghost(stone);
    background->absorb(frame.luma, blobs->runs(), stone);
  }
  clock.lap(Stage::components);
  return true;
}

// What must not be learned as background, or null.
const BitMask* CaptureImpl::protected_pixels() {
  if (fish.size() == 1) return fish[0].protected_now ? &fish[0].protect : nullptr;
  clear_mask(keep);
  for (const FishTrack& one : fish) {
    if (!one.protected_now) continue;
    for (int i = 0; i < keep.words_per_row * height; ++i) keep.words[i] |= one.protect.words[i];
  }
  return &keep;
}

void CaptureImpl::unprotect() {
  for (FishTrack& one : fish) one.unprotect();
}

bool CaptureImpl::protects() const {
  for (const FishTrack& one : fish)
    if (one.protected_now) return true;
  return false;
}

// Worth a number of its own, besides the target.
bool CaptureImpl::is_fish(const Swimmer& s) const {
  return s.blob >= 0 && !s.in_heap && s.frames >= kFishFrames && s.likeness > kFishLike && s.travelled > kFishTravel;
}

// The number for a swimmer that has none; -1 when all are taken. One that was lost is known again by its looks.
int CaptureImpl::number_for(const Swimmer& s) const {
  int alike = -1, unused = -1, free = -1;
  float least = kSameLooks;
  for (int i = static_cast<int>(fish.size()) - 1; i >= 0; --i) {
    const FishTrack& one = fish[static_cast<std::size_t>(i)];
    if (one.swimmer_id != 0) continue;
    free = i;
    if (one.looks.area_px == 0) unused = i;
    else if (one.looks.unlike(s.looks) <= least) least = one.looks.unlike(s.looks), alike = i;
  }
  return alike >= 0 ? alike : unused >= 0 ? unused : free;
}

// Which swimmer is which fish.
void CaptureImpl::number_fish() {
  const auto number_of = [this](uint32_t id) {
    for (int i = 0; i < static_cast<int>(fish.size()); ++i)
      if (fish[static_cast<std::size_t>(i)].swimmer_id == id) return i;
    return -1;
  };
  for (FishTrack& one : fish)
    if (swimmers.find(one.swimmer_id) == nullptr) one.swimmer_id = 0;
  if (const Swimmer* chosen = swimmers.find(target.id())) {
    int number = number_of(chosen->id);
    if (number < 0) {
      const int fitting = number_for(*chosen);
      number = fitting < 0 ? target_fish : fitting;  // all are taken: in place of the last target
      fish[static_cast<std::size_t>(number)].swimmer_id = chosen->id;
    }
    target_fish = number;
  }
  for (Swimmer& s : swimmers.all()) {
    int number = number_of(s.id);
    if (number < 0 && fish.size() > 1 && is_fish(s) && (number = number_for(s)) >= 0)
      fish[static_cast<std::size_t>(number)].swimmer_id = s.id;
    s.followed = number >= 0;
  }
}

PoseStatus CaptureImpl::miss_all(PoseStatus status) {
  for (FishTrack& one : fish) one.miss(status);
  return status;
}

void CaptureImpl::publish_blobs() {
  view_count = 0;
  const Swimmer* mine = swimmers.find(target.id());
  for (const Blob& b : blobs->blobs()) {
    const bool selected = mine != nullptr && mine->blob == view_count;
    const Vec2 low{static_cast<float>(b.box.x0), static_cast<float>(b.box.y0)};
    const Vec2 by = frame_from_reference(low) - low;
    const int dx = static_cast<int>(by.x), dy = static_cast<int>(by.y);
    const Box box{b.box.x0 + dx, b.box.y0 + dy, b.box.x1 + dx, b.box.y1 + dy};
    views[static_cast<std::size_t>(view_count++)] = {box, frame_from_reference(b.centroid), b.area_px, selected};
  }
}

void CaptureImpl::take_fingerprint() {
  hash = raw_hash;
  for (const Blob& b : blobs->blobs()) {
    hash = hash_u64(static_cast<uint64_t>(b.area_px), hash);
    hash = hash_u64(static_cast<uint64_t>(b.box.x0) << 32 | static_cast<uint64_t>(b.box.y0), hash);
  }
  for (const FishTrack& one : fish)
    for (const Vec2 p : one.contour.first(static_cast<std::size_t>(one.contour_count)))
      hash = hash_u64(static_cast<uint64_t>(p.x) << 32 | static_cast<uint64_t>(p.y), hash);
}

StepReport CaptureImpl::finish(StepReport report, PoseStatus status) {
  report.status = status;
  if (settings.fingerprint) take_fingerprint();
  return report;
}

StepReport CaptureImpl::run(const Frame& given, NowNs now) {
  Frame frame = given;
  StepReport report;
  StageClock clock(now, report.times);
  view_count = 0;
  if (frame.luma.width != width || frame.luma.height != height) {
    report.flags |= kFrameSize;
    return finish(report, miss_all(PoseStatus::absent));
  }
  if (!steady(frame, clock, report) || !segment(frame, clock, report)) {
    return finish(report, miss_all(PoseStatus::relearn));
  }
  swimmers.update(blobs->blobs(), blobs->runs(), frame.luma);
  target.update(swimmers, blobs->blobs());
  number_fish();
  publish_blobs();
  clock.lap(Stage::target);
  const std::array<BitMask, 3> spare{scratch, open, raw};  // the blobs hold what is still needed of them
  const CaptureTools tools{frame,
                           frame_from_reference,
                           (report.flags & kStabilised) != 0,
                           settings,
                           *background,
                           *blobs,
                           swimmers,
                           tank.empty() ? nullptr : &tank,
                           spare,
                           *refine,
                           *landmarks,
                           clock,
                           report};
  for (FishTrack& one : fish) one.follow(tools);
  return finish(report, the_fish(kTarget).pose.status);
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
  if (settings.max_fish < 1 || settings.max_fish > kMostFish)
    return Status{StatusCode::bad_argument, "max_fish must be 1 to 16"};
  if (settings.tank.data != nullptr && (settings.tank.width != width || settings.tank.height != height))
    return Status{StatusCode::bad_argument, "the tank's mask must be as large as the frames"};
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
  c.swimmers.set_lost_after(settings.lost_after);
  c.swimmers.set_largest(settings.max_area_px);
  c.fill_tank();
  c.bytes_used = arena.used();
  return static_cast<Capture*>(&c);
}

void Capture::learn(const Frame& frame) {
  CaptureImpl& c = impl(*this);
  if (frame.luma.width != c.width || frame.luma.height != c.height) return;
  if (c.stabiliser == nullptr) return c.background->learn(frame.luma);
  const Stabilised seen = c.stabiliser->apply(frame.luma, {});
  if (!seen.lost) c.background->learn(seen.luma);
}
StepReport Capture::step(const Frame& frame, NowNs now) { return impl(*this).run(frame, now); }
void Capture::select_at(Vec2 point) { impl(*this).target.select_at(impl(*this).frame_from_reference.inverse()(point)); }
void Capture::select_next() { impl(*this).target.select_next(); }
void Capture::select_auto() { impl(*this).target.select_auto(); }
void Capture::relearn() { impl(*this).restart_background(); }
int Capture::fish_count() const { return static_cast<int>(impl(*this).fish.size()); }
int Capture::target() const { return impl(*this).target_fish; }
const FishPose& Capture::pose(int fish) const { return impl(*this).the_fish(fish).pose; }
const Motion& Capture::motion(int fish) const { return impl(*this).the_fish(fish).motion; }
float Capture::init_len(int fish) const { return impl(*this).the_fish(fish).init_len; }
OrderStep Capture::order(int fish) const { return impl(*this).the_fish(fish).order; }
std::span<const BlobView> Capture::blobs() const {
  return impl(*this).views.first(static_cast<std::size_t>(impl(*this).view_count));
}
std::span<const Vec2> Capture::contour(int fish) const {
  const FishTrack& one = impl(*this).the_fish(fish);
  return one.contour.first(static_cast<std::size_t>(one.contour_count));
}
std::span<const Vec2> Capture::smooth_contour(int fish) const {
  const FishTrack& one = impl(*this).the_fish(fish);
  return one.pose.ok() ? one.smooth : std::span<const Vec2>{};
}
BitMask Capture::foreground() const { return impl(*this).open; }
BitMask Capture::around_fish() {
  const BitMask* mask = impl(*this).protected_pixels();
  return mask != nullptr ? *mask : BitMask{};
}
const char* Capture::background_name() const { return impl(*this).background->name(); }
const Similarity& Capture::camera_motion() const { return impl(*this).frame_from_reference; }
bool Capture::stabilising() const { return impl(*this).stabiliser != nullptr && impl(*this).stabiliser->active(); }
bool Capture::camera_unknowable() const { return impl(*this).stabiliser != nullptr && impl(*this).stabiliser->blind(); }
uint64_t Capture::integer_hash() const { return impl(*this).hash; }
std::size_t Capture::bytes_used() const { return impl(*this).bytes_used; }
int Capture::contour_points_high_water() const {
  int most = 0;
  for (const FishTrack& one : impl(*this).fish) most = max_int(most, one.contour_high_water);
  return most;
}

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
