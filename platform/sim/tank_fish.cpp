// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_fish.h"

#include "core/base/det_math.h"

namespace nt::tank {
namespace {

constexpr float kStep = 1.0f / kSpineSteps;
constexpr float kWidestS = 0.30f, kWidest = 0.085f;  // half width, BL
constexpr float kPeduncleS = 0.82f, kPeduncle = 0.020f;
constexpr float kFinFrontS = 0.24f, kFinRearS = 0.32f;  // roots of the pectoral fins
constexpr float kFinLength = 0.16f;
constexpr float kWaveLength = 0.95f;  // BL, carangiform

float smooth(float t) {
  t = det::clamp(t, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

Vec2 bezier(Vec2 a, Vec2 b, Vec2 c, float t) { return lerp(lerp(a, b, t), lerp(b, c, t), t); }

void append_bezier(std::vector<Vec2>& out, Vec2 a, Vec2 b, Vec2 c, int steps) {  // without a, with c
  for (int i = 1; i <= steps; ++i) out.push_back(bezier(a, b, c, static_cast<float>(i) / static_cast<float>(steps)));
}

// One side of the caudal fin from the peduncle to just before the tail point (1, 0).
void append_caudal(std::vector<Vec2>& side, CaudalFin caudal) {
  const Vec2 root{kPeduncleS, kPeduncle}, end{1.0f, 0.0f};
  if (caudal == CaudalFin::forked) {
    const Vec2 tip_front{1.055f, 0.083f}, tip_back{1.075f, 0.078f};
    append_bezier(side, root, {0.90f, 0.022f}, tip_front, 12);
    append_bezier(side, tip_front, {1.085f, 0.092f}, tip_back, 4);
    append_bezier(side, tip_back, {1.012f, 0.040f}, end, 10);
  } else {
    const Vec2 shoulder{0.955f, 0.062f};
    append_bezier(side, root, {0.875f, 0.020f}, {0.905f, 0.045f}, 8);
    append_bezier(side, {0.905f, 0.045f}, {0.925f, 0.064f}, shoulder, 6);
    append_bezier(side, shoulder, {1.0f, 0.058f}, end, 10);
  }
  side.pop_back();
}

struct BodyFrameFin {
  std::vector<Vec2> outline;  // (s, n) with n > 0 outwards: front root first, rear root last
};

// A swept-back fan whose leading edge stands at `angle` from the body's side.
BodyFrameFin fin_outline(float angle) {
  const Vec2 front{kFinFrontS, body_half_width(kFinFrontS)}, rear{kFinRearS, body_half_width(kFinRearS)};
  const auto ray = [&](float turn, float reach) {
    const det::SinCos d = det::sincos(angle + turn);
    return front + Vec2{d.cos, d.sin} * (kFinLength * reach);
  };
  const Vec2 tip = ray(0.0f, 1.0f), back = ray(-0.42f, 0.86f);
  BodyFrameFin fin;
  fin.outline.push_back(front);
  append_bezier(fin.outline, front, ray(0.12f, 0.55f), tip, 8);
  append_bezier(fin.outline, tip, ray(-0.20f, 1.08f), back, 8);
  append_bezier(fin.outline, back, ray(-0.55f, 0.52f), rear, 8);
  return fin;
}

// The point of the segment a-b where it crosses the body's outline.
Vec2 outline_crossing(Vec2 a, Vec2 b) {
  const float ga = a.y - body_half_width(a.x), gb = b.y - body_half_width(b.x);
  const Vec2 p = ga == gb ? a : lerp(a, b, ga / (ga - gb));
  return {p.x, body_half_width(p.x)};
}

}  // namespace

float body_half_width(float s) {
  if (s <= 0.0f) return 0.0f;
  if (s < kWidestS) {
    const float t = (kWidestS - s) / kWidestS;
    return kWidest * det::sqrt(1.0f - t * t * (0.35f + 0.65f * t));
  }
  return kPeduncle + (kWidest - kPeduncle) * (1.0f - smooth((s - kWidestS) / (kPeduncleS - kWidestS)));
}

Vec2 FishShape::at(float s, float n) const {
  const float f = det::clamp(s * kSpineSteps + kSpineBefore, 0.0f, kSpinePoints - 1.001f);
  const int i = static_cast<int>(f);
  const float t = f - static_cast<float>(i);
  return lerp(spine[i], spine[i + 1], t) + normalised(lerp(normal[i], normal[i + 1], t)) * (n * length_px);
}

FishModel::FishModel(float length_px, CaudalFin caudal) : length_px_(length_px) {
  constexpr int kHeadNodes = 24, kTrunkNodes = 36;
  for (int i = 1; i <= kHeadNodes; ++i) {  // denser at the snout, where the outline turns
    const float t = static_cast<float>(i) / kHeadNodes;
    const float s = kWidestS * t * t;
    side_.push_back({s, body_half_width(s)});
  }
  for (int i = 1; i <= kTrunkNodes; ++i) {
    const float s = kWidestS + (kPeduncleS - kWidestS) * static_cast<float>(i) / kTrunkNodes;
    side_.push_back({s, body_half_width(s)});
  }
  append_caudal(side_, caudal);

  // The skull does not bend, the trunk bends most, the caudal fin follows.
  std::vector<float> turned(kSpinePoints, 0.0f);
  float total = 0.0f;
  for (int i = 1; i < kSpinePoints; ++i) {
    const float s = (static_cast<float>(i - kSpineBefore)) * kStep;
    total += smooth((s - 0.10f) / 0.28f) * (1.0f - 0.6f * smooth((s - 0.80f) / 0.15f));
    turned[i] = total;
  }
  const float whole = turned[kSpineBefore + kSpineSteps], pivot = turned[kSpineBefore + kPivotStep];
  for (int i = 0; i + 1 < kSpinePoints; ++i) {
    bend_share_.push_back((pivot - 0.5f * (turned[i] + turned[i + 1])) / whole);
    const float s = det::max((static_cast<float>(i - kSpineBefore) + 0.5f) * kStep, 0.0f);
    wave_share_.push_back(0.06f + 0.10f * s + 0.84f * s * s);
  }
}

void FishModel::shape(const Posture& posture, FishShape& out) const {
  out.length_px = length_px_;
  bend_spine(posture, out);
  for (int side : {kLeft, kRight}) shape_fin(side, posture.fin_rad[side], out);
  out.body.clear();
  out.body.push_back(out.at(0.0f));
  for (Vec2 p : side_) out.body.push_back(out.at(p.x, p.y));
  out.body.push_back(out.at(1.0f));
  for (std::size_t i = side_.size(); i-- > 0;) out.body.push_back(out.at(side_[i].x, -side_[i].y));
  join_contour(out);
}

void FishModel::bend_spine(const Posture& posture, FishShape& out) const {
  out.spine.resize(kSpinePoints);
  out.normal.resize(kSpinePoints);
  Vec2 towards_head[kSpinePoints];
  for (int i = 0; i + 1 < kSpinePoints; ++i) {
    const float s = det::max((static_cast<float>(i - kSpineBefore) + 0.5f) * kStep, 0.0f);
    const float wave =
        posture.wave_rad * wave_share_[i] * det::sin(posture.wave_phase_rad - det::kTwoPi / kWaveLength * s);
    const det::SinCos d = det::sincos(posture.heading_rad + posture.bend_rad * bend_share_[i] + wave);
    towards_head[i] = {d.cos, d.sin};
  }
  const int pivot = kSpineBefore + kPivotStep;
  const float step_px = length_px_ * kStep;
  out.spine[pivot] = posture.pivot;
  for (int i = pivot; i > 0; --i) out.spine[i - 1] = out.spine[i] + towards_head[i - 1] * step_px;
  for (int i = pivot; i + 1 < kSpinePoints; ++i) out.spine[i + 1] = out.spine[i] - towards_head[i] * step_px;
  for (int i = 0; i < kSpinePoints; ++i) {
    const Vec2 before = towards_head[max_int(i - 1, 0)], after = towards_head[min_int(i, kSpinePoints - 2)];
    out.normal[i] = right_of(normalised(before + after));
  }
}

void FishModel::shape_fin(int side, float angle, FishShape& out) const {
  FinShape& fin = out.fin[side];
  const float sign = side == kRight ? 1.0f : -1.0f;
  const auto place = [&](Vec2 p) { return out.at(p.x, sign * p.y); };
  const std::vector<Vec2> line = fin_outline(angle).outline;
  fin.polygon.clear();
  fin.outside.clear();
  fin.stands_out = 0.0f;
  std::size_t first = 0, last = 0, tip = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    fin.polygon.push_back(place(line[i]));
    const float beyond = line[i].y - body_half_width(line[i].x);
    if (line[i].y > line[tip].y) tip = i;
    if (i == 0 || i + 1 == line.size() || beyond <= 0.0f) continue;
    if (first == 0) first = i;
    last = i;
    fin.stands_out = det::max(fin.stands_out, beyond);
  }
  fin.tip = place(line[tip]);
  fin.root = place(line.front());
  fin.front = fin.root;
  fin.rear = place(line.back());
  if (fin.stands_out < 0.002f) return;  // hidden: under half a pixel
  const Vec2 enters = first == 1 ? line.front() : outline_crossing(line[first - 1], line[first]);
  const Vec2 leaves = last + 2 == line.size() ? line.back() : outline_crossing(line[last], line[last + 1]);
  fin.front = place(enters);
  fin.rear = place(leaves);
  // Kept in body coordinates until join_contour has cut the body's side at the two ends.
  fin.outside.push_back(enters);
  for (std::size_t i = first; i <= last; ++i) fin.outside.push_back(line[i]);
  fin.outside.push_back(leaves);
}

void FishModel::join_contour(FishShape& out) const {
  const auto walk = [&](int which, float sign, std::vector<Vec2>& line) {  // snout to tail, without both
    FinShape& fin = out.fin[which];
    std::size_t i = 0;
    if (!fin.outside.empty()) {
      const float from = fin.outside.front().x, to = fin.outside.back().x;
      for (; i < side_.size() && side_[i].x < from; ++i) line.push_back(out.at(side_[i].x, sign * side_[i].y));
      for (Vec2& p : fin.outside) line.push_back(p = out.at(p.x, sign * p.y));
      while (i < side_.size() && side_[i].x <= to) ++i;
    }
    for (; i < side_.size(); ++i) line.push_back(out.at(side_[i].x, sign * side_[i].y));
  };
  std::vector<Vec2> left;
  out.contour.clear();
  out.contour.push_back(out.at(0.0f));
  walk(kRight, 1.0f, out.contour);
  out.contour.push_back(out.at(1.0f));
  walk(kLeft, -1.0f, left);
  out.contour.insert(out.contour.end(), left.rbegin(), left.rend());
}

}  // namespace nt::tank
