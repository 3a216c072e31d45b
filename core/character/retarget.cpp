// SPDX-License-Identifier: Apache-2.0
#include "core/character/retarget.h"

#include "core/base/det_math.h"
#include "core/character/fin_region.h"

namespace nt {
namespace {

// Step of the search for a fin's range, and what ends it: a triangle with less than this share of its rest area (bends
// of the body take some more), or a fin whose area is off by more than this (of the 10 % that it may be with them).
constexpr float kRangeStep = 0.05f;
constexpr float kCrushedArea = 0.1f;
constexpr float kFinAreaOff = 0.06f;

// A body's control points lie nearly on a line, and affine deformation shears without bound where it sees only that line:
// with 0.02 in place of this the bundled carp turns 2,988 triangles over in the tank's `turns`, with this none.
constexpr float kThinSpread = 0.15f;

// A fin's own control points lie at least this share of its length beyond its root: nearer to it the fin hands over to
// the body. Of 0.15, 0.25 and 0.35 on the bundled carp over the tank's `turns`, only 0.25 and 0.35 turn no triangle over,
// and 0.25 keeps the fins' area better.
constexpr float kSpotsFrom = 0.25f;

float distance(Vec2 a, Vec2 b) { return length(b - a); }

Vec2 polar(float len, float angle_rad) {
  const det::SinCos a = det::sincos(angle_rad);
  return {len * a.cos, len * a.sin};
}

float angle_of(Vec2 v) { return det::atan2(v.y, v.x); }

// The angle of bone k of n, counted from the centre, the last one ending at the head or tail, read from a motion whose
// m bones cover the same axis. Bones are of equal length in both, so only fractions of the axis matter.
float bone_angle(const float* axis, int axis_count, float end_angle, int k, int n) {
  const int m = axis_count + 1;
  const auto at = [&](int i) { return i < axis_count ? axis[i] : end_angle; };
  if (m == n) return at(k);
  const float middle = (static_cast<float>(k) + 0.5f) / static_cast<float>(n);
  const float s = det::clamp(middle * static_cast<float>(m) - 0.5f, 0.0f, static_cast<float>(m - 1));
  const int i = static_cast<int>(s);
  if (i >= m - 1) return at(m - 1);
  return at(i) + det::wrap(at(i + 1) - at(i)) * (s - static_cast<float>(i));
}

// FinRange's measure of an angle in the fish-local frame; in (-pi/2, 3 pi/2], so that it is continuous wherever a fin goes.
float open_of_angle(float angle_rad, float side) {
  return det::unwrap(side > 0 ? angle_rad + det::kHalfPi : -det::kHalfPi - angle_rad, det::kHalfPi);
}
float angle_of_open(float open, float side) { return side > 0 ? open - det::kHalfPi : -det::kHalfPi - open; }

// Left fins have even indices, right ones odd.
bool is_left(int index) { return index % 2 == 0; }
float fish_side(int index) { return is_left(index) ? -1.0f : 1.0f; }

// Moving least squares in its place would be another deformer than the one asked for.
const Status kLatticeRefused{
    StatusCode::bad_data,
    "the character's lattice cannot be solved; make it anew with `neontetra character --lattice`"};

bool refused(const Arena& arena, const LatticePose* pose) {
  return pose == nullptr && !arena.measuring() && !arena.full();
}

}  // namespace

BoneLengths bone_lengths(const Character& character) {
  const ControlPoints& c = character.rest;
  BoneLengths l;
  Vec2 joint = c.centre;
  for (int i = 0; i < character.u_num; ++i) {
    l.up_len[i] = distance(joint, c.up_axis[i]);
    l.body_len += l.up_len[i];
    joint = c.up_axis[i];
  }
  l.head_len = distance(joint, c.head);
  joint = c.centre;
  for (int i = 0; i < character.l_num; ++i) {
    l.low_len[i] = distance(joint, c.low_axis[i]);
    l.body_len += l.low_len[i];
    joint = c.low_axis[i];
  }
  l.tail_len = distance(joint, c.tail);
  l.body_len += l.head_len + l.tail_len;
  for (int i = 0; i < kMaxFins; ++i) l.fin_len[i] = c.fins[i].present ? distance(c.fins[i].top, c.fins[i].tip) : 0.0f;
  return l;
}

void Retarget::add_fin(int index) {
  const auto& [present, top, bottom, tip] = character_.rest.fins[index];
  Fin& fin = fins_[index];
  fin.present = true;
  fin.first = control_count_;
  // By where the fin is rather than by its name: a mirrored or odd drawing still opens outwards.
  fin.side = (tip.x - top.x) + (tip.x - character_.rest.centre.x) >= 0 ? 1.0f : -1.0f;
  fin.rest_open = open_of_angle(angle_of(tip - top), fin.side);
  rest_[control_count_++] = top;
  rest_[control_count_++] = bottom;
  rest_[control_count_++] = tip;
  spread_spots(fin, character_.rest.fins[index]);
}

// The vertices of the fin that lie farthest from its tip and from each other, one after the other.
void Retarget::spread_spots(const Fin& fin, const FinPoints& points) {
  const FinRegion region(character_, points, 1.0f);
  const Vec2 root = lerp(points.top, points.bottom, 0.5f);
  const float from = kSpotsFrom * distance(points.top, points.tip);
  for (std::size_t k = 0; k < kFinSpots; ++k) {
    Vec2 best = lerp(root, points.tip, 0.5f + 0.06f * static_cast<float>(k));  // where the fin has no vertices
    float farthest = 0;
    for (const Vec2 v : character_.vertices) {
      if (region.beyond(v) < from || !region.holds(v)) continue;
      float nearest = length_sq(v - points.tip);
      for (std::size_t i = fin.first + 3; i < control_count_; ++i) {
        nearest = det::min(nearest, length_sq(v - rest_[i]));
      }
      if (nearest <= farthest) continue;
      farthest = nearest;
      best = v;
    }
    rest_[control_count_++] = best;
  }
}

void Retarget::collect_rest() {
  const ControlPoints& c = character_.rest;
  control_count_ = 0;
  rest_[control_count_++] = c.centre;
  rest_[control_count_++] = c.head;
  rest_[control_count_++] = c.tail;
  for (int i = 0; i < character_.u_num; ++i) rest_[control_count_++] = c.up_axis[i];
  for (int i = 0; i < character_.l_num; ++i) rest_[control_count_++] = c.low_axis[i];
  for (int i = 0; i < kMaxFins; ++i) {
    if (c.fins[i].present) add_fin(i);
  }
}

Result<Retarget*> Retarget::create(Arena& arena, const Character& character, const RetargetSettings& settings) {
  Retarget r;
  r.character_ = character;
  r.settings_ = settings;
  r.lengths_ = bone_lengths(character);
  if (!(r.lengths_.body_len > 0.0f)) {
    return Status{StatusCode::bad_data, "the character's axis has no length; place its head and tail apart"};
  }
  r.collect_rest();
  const std::span<Retarget> self = arena.take<Retarget>(1);
  const std::span<const Vec2> rest{r.rest_, r.control_count_};
  const std::span<const Vec2> body = rest.first(r.body_count());
  // The fins' points behind the body's; only their junctions are read.
  r.junctions_ = Mls::create(arena, rest.subspan(body.size()), body, settings.mls, settings.mls_alpha, kThinSpread);
  r.mesh_ = Mls::create(arena, character.vertices, rest, settings.mls, settings.mls_alpha, kThinSpread);
  r.vertices_ = arena.take<Vec2>(character.vertices.size());
  r.solid_.create(arena, character, body);
  if (settings.deformer == Deformer::lattice) {
    if (!LatticePose::fits(character, rest)) {
      return Status{
          StatusCode::bad_data,
          "the character has no lattice for its control points; make one with `neontetra character --lattice`"};
    }
    r.lattice_ = LatticePose::create(arena, character);
    if (refused(arena, r.lattice_)) return kLatticeRefused;
  }
  r.meter_ = DistortionMeter::create(arena, character);
  r.filter_.create(arena, 2 * r.control_count_ + 3, scaled(KalmanParameters{}, r.lengths_.body_len));
  if (arena.measuring()) return Result<Retarget*>(static_cast<Retarget*>(nullptr));
  if (arena.full()) return Status{StatusCode::out_of_memory, "no memory for the character; raise max_vertices"};
  for (int i = 0; i < kMaxFins; ++i) {
    if (r.fins_[i].present) r.find_fin_range(i);
  }
  self[0] = r;
  return Result<Retarget*>(&self[0]);
}

Result<Retarget*> Retarget::twin(Arena& arena, const Retarget& of) {
  Retarget r = of;
  r.started_ = false;
  const std::span<Retarget> self = arena.take<Retarget>(1);
  r.vertices_ = arena.take<Vec2>(of.vertices_.size());
  r.solid_.twin(arena, of.solid_);
  if (r.settings_.deformer == Deformer::lattice) {
    r.lattice_ = LatticePose::create(arena, r.character_);
    if (refused(arena, r.lattice_)) return kLatticeRefused;
  }
  r.filter_ = {};
  r.filter_.create(arena, 2 * r.control_count_ + 3, scaled(KalmanParameters{}, r.lengths_.body_len));
  if (arena.measuring()) return Result<Retarget*>(static_cast<Retarget*>(nullptr));
  if (arena.full()) return Status{StatusCode::out_of_memory, "no memory for the character; raise max_vertices"};
  self[0] = r;
  return Result<Retarget*>(&self[0]);
}

// Whether no triangle is crushed, and the fin keeps its area, when it alone stands at `open`.
bool Retarget::fin_fits(int index, float open) {
  for (std::size_t i = 0; i < control_count_; ++i) points_[i] = rest_[i];
  turn_fin(fins_[index], open, 0.0f);
  mesh_->deform({points_, control_count_}, vertices_);
  const Distortion d = meter_->measure(vertices_, 1.0f, false);
  return d.least > kCrushedArea && det::abs(d.fin_area[index] - 1.0f) < kFinAreaOff;
}

// From the rest pose step by step until a triangle gives way, folding first: no farther back than a fish's folded fin, and
// the whole no wider than what a fish's fins sweep.
void Retarget::find_fin_range(int index) {
  const Fin& fin = fins_[index];
  const float least = det::max(kFishFins.folded, fin.rest_open - kFishFins.width());
  FinRange range{fin.rest_open, fin.rest_open};
  for (float next = fin.rest_open; range.folded > least && fin_fits(index, next);
       next = det::max(least, next - kRangeStep)) {
    range.folded = next;
  }
  const float most = range.folded + kFishFins.width();
  for (float next = fin.rest_open; range.open < most && fin_fits(index, next);
       next = det::min(most, next + kRangeStep)) {
    range.open = next;
  }
  fin_range_[index] = range;
}

Motion Retarget::rest_motion() const {
  const auto image = [](Vec2 p) { return Vec2{p.x, -p.y}; };
  const ControlPoints& c = character_.rest;
  FishPose pose;
  pose.status = PoseStatus::ok;
  pose.u_num = character_.u_num;
  pose.l_num = character_.l_num;
  pose.centre = image(c.centre);
  pose.dir = {0.0f, -1.0f};
  pose.head = image(c.head);
  pose.tail = image(c.tail);
  for (int i = 0; i < character_.u_num; ++i) pose.up_axis[i] = image(c.up_axis[i]);
  for (int i = 0; i < character_.l_num; ++i) pose.low_axis[i] = image(c.low_axis[i]);
  pose.confidence = {1, 1, 1, 0, 0, 1};
  Motion m = motion_from_pose(pose, 0, nullptr);
  m.centre = {};
  for (int i = kMaxFins - 1; i >= 0; --i) {  // where there are two pairs, the first one tells
    if (!fins_[i].present) continue;
    const FinRange range = fin_range_[i];
    const float share = range.width() > 0.0f ? (fins_[i].rest_open - range.folded) / range.width() : 0.0f;
    (is_left(i) ? m.l_fin_angle : m.r_fin_angle) =
        angle_of_open(kFishFins.folded + share * kFishFins.width(), fish_side(i));
    (is_left(i) ? m.confidence.l_fin : m.confidence.r_fin) = 1.0f;
  }
  return m;
}

void Retarget::start(float init_len_px) {
  scale_ = init_len_px > 0.0f ? lengths_.body_len / init_len_px : 1.0f;
  filter_.reset();
  if (lattice_ != nullptr) lattice_->reset();
  started_ = false;
}

// Algorithm 3, lines 1-5.
void Retarget::pose_body(const Motion& m) {
  const int up = character_.u_num, low = character_.l_num;
  std::size_t at = 3;
  Vec2 joint;
  points_[0] = joint;
  for (int i = 0; i < up; ++i) {
    joint += polar(lengths_.up_len[i], bone_angle(m.up_axis_angle, m.u_num, m.head_angle, i, up + 1));
    points_[at++] = joint;
  }
  points_[1] = joint + polar(lengths_.head_len, bone_angle(m.up_axis_angle, m.u_num, m.head_angle, up, up + 1));
  joint = points_[0];
  for (int i = 0; i < low; ++i) {
    joint += polar(lengths_.low_len[i], bone_angle(m.low_axis_angle, m.l_num, m.tail_angle, i, low + 1));
    points_[at++] = joint;
  }
  points_[2] = joint + polar(lengths_.tail_len, bone_angle(m.low_axis_angle, m.l_num, m.tail_angle, low, low + 1));
}

// A body that bends draws the junctions together on its inner side and apart on its outer one: a fin whose root did so would
// lose or gain area. Its root keeps its middle and direction, and gets back its length; the body beside it gives way.
void Retarget::keep_root(const Fin& fin) {
  Vec2 &top = points_[fin.first], &bottom = points_[fin.first + 1];
  const float len = distance(top, bottom);
  if (len <= 0.0f) return;
  const Vec2 middle = lerp(top, bottom, 0.5f);
  const Vec2 half = (bottom - top) * (0.5f * distance(rest_[fin.first], rest_[fin.first + 1]) / len);
  top = middle - half, bottom = middle + half;
}

// Algorithm 4, lines 2-4, for one fin: its junctions have been moved with the body already.
void Retarget::pose_fin(int index, float angle_rad) {
  const Fin& fin = fins_[index];
  keep_root(fin);
  const Vec2 top = points_[fin.first], bottom = points_[fin.first + 1];
  // How far the body has turned where the fin is rooted; the range of the fin turns with it.
  const float turn = det::wrap(angle_of(bottom - top) - angle_of(rest_[fin.first + 1] - rest_[fin.first]));
  const float open = det::clamp(open_of_angle(angle_rad - turn, fish_side(index)), kFishFins.folded, kFishFins.open);
  const FinRange range = fin_range_[index];
  const float share = (open - kFishFins.folded) / kFishFins.width();
  turn_fin(fin, range.folded + share * range.width(), turn);
}

// The tip and the spots, about the fin's lower junction, from where they are at rest.
void Retarget::turn_fin(const Fin& fin, float open, float body_turn) {
  const Vec2 pivot = points_[fin.first + 1], rest_pivot = rest_[fin.first + 1];
  const float turn = angle_of_open(open, fin.side) - angle_of_open(fin.rest_open, fin.side) + body_turn;
  const det::SinCos a = det::sincos(turn);
  for (std::size_t i = fin.first + 2; i < fin.first + 3 + kFinSpots; ++i) {
    const Vec2 p = rest_[i] - rest_pivot;
    points_[i] = pivot + Vec2{p.x * a.cos - p.y * a.sin, p.x * a.sin + p.y * a.cos};
  }
}

void Retarget::smooth(Frame& frame, float dt_s) {
  if (started_) frame.dir_rad = det::unwrap(frame.dir_rad, last_dir_rad_);
  last_dir_rad_ = frame.dir_rad;
  started_ = true;
  if (!settings_.smooth) return;
  // A turn moves the ends of the body by half a body length per radian: in that unit it has the points' noise.
  const float arm = 0.5f * lengths_.body_len;
  float values[2 * kMaxControls + 3];
  std::size_t n = 0;
  for (std::size_t i = 0; i < control_count_; ++i) {
    values[n++] = points_[i].x;
    values[n++] = points_[i].y;
  }
  values[n++] = frame.centre.x;
  values[n++] = frame.centre.y;
  values[n++] = frame.dir_rad * arm;
  filter_.update({values, n}, dt_s);
  n = 0;
  for (std::size_t i = 0; i < control_count_; ++i) {
    points_[i] = {values[n], values[n + 1]};
    n += 2;
  }
  frame = {{values[n], values[n + 1]}, values[n + 2] / arm};
}

void Retarget::place_vertices() {
  const Vec2 right = right_of(up_);
  for (Vec2& v : vertices_) v = origin_ + right * v.x + up_ * v.y;
  if (lattice_ != nullptr) solid_.take(*lattice_, up_);
  else solid_.pose({points_, body_count()}, up_);
}

void Retarget::place(const Frame& frame, const Placement& placement) {
  const det::SinCos a = det::sincos(frame.dir_rad);
  const Vec2 dir{a.cos, a.sin};
  const Vec2 up = dir * placement.zoom, right = right_of(dir) * placement.zoom;
  const Vec2 origin = placement.offset + frame.centre * placement.zoom;
  const auto scene = [&](Vec2 p) { return origin + right * p.x + up * p.y; };
  zoom_ = placement.zoom, origin_ = origin, up_ = up;
  if (!renderer_places()) place_vertices();
  ControlPoints& c = scene_points_;
  std::size_t at = 0;
  c.centre = scene(points_[at++]), c.head = scene(points_[at++]), c.tail = scene(points_[at++]);
  for (int i = 0; i < character_.u_num; ++i) c.up_axis[i] = scene(points_[at++]);
  for (int i = 0; i < character_.l_num; ++i) c.low_axis[i] = scene(points_[at++]);
  for (int i = 0; i < kMaxFins; ++i) {
    c.fins[i].present = fins_[i].present;
    if (!fins_[i].present) continue;
    const Vec2* fin = points_ + fins_[i].first;
    c.fins[i].top = scene(fin[0]), c.fins[i].bottom = scene(fin[1]), c.fins[i].tip = scene(fin[2]);
  }
}

void Retarget::deform() {
  if (lattice_ == nullptr) {
    mesh_->deform({points_, control_count_}, vertices_);
    return;
  }
  (void)lattice_->pose({points_, control_count_}, settings_.vertices);
  if (!settings_.vertices) return;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const Vec3 p = lattice_->place(v);
    vertices_[v] = {p.x, p.y};
  }
}

void Retarget::pose(const Motion& motion, float dt_s, const Placement& placement) {
  pose_body(motion);
  const std::size_t body = body_count();
  junctions_->deform({points_, body}, {points_ + body, control_count_ - body});
  for (int i = 0; i < kMaxFins; ++i) {
    if (fins_[i].present) pose_fin(i, is_left(i) ? motion.l_fin_angle : motion.r_fin_angle);
  }
  Frame frame{motion.centre * scale_, motion.dir_rad};
  smooth(frame, dt_s);
  deform();
  place(frame, placement);
}

}  // namespace nt
