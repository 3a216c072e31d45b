// SPDX-License-Identifier: Apache-2.0
#include "core/landmarks/landmarks.h"

#include "core/base/det_math.h"
#include "core/base/image_view.h"
#include "core/landmarks/body.h"
#include "core/landmarks/fins.h"
#include "core/landmarks/tail.h"
#include "core/outline/fourier.h"
#include "core/outline/midline.h"
#include "core/outline/moments.h"

namespace nt {
namespace {

// Shape and travel of consecutive frames are nearly the same observation, so each later frame adds only a part.
constexpr float kRepeatedEvidence = 0.2f;
constexpr float kShortest_px = 8.0f;  // below it the outline's pixel steps are the shape
constexpr float kRoundest = 1.35f;    // length^2 / area: a disc has 1.27, an angelfish 1.5, a trout 8
constexpr int kArcReach = 4;          // points: a ragged rim is not longer than a smooth one
constexpr float kBeforeTail = 0.7f;   // of a bent fish's axis: from here its tail fin is looked at
constexpr int kPeduncle = kStations * 5 / 6;
constexpr float kThin_px = 4.0f;  // half-width there, up to which the outline may have lost the last of the tail
// Half-width in the middle of the rear, of the length, up to which a notched tail is no fin but noise: a larva has 0.017,
// the tank's fish 0.03.
constexpr float kSlender = 0.026f;
constexpr int kRear = kStations * 5 / 8;
constexpr int kRounds = 2;  // of centring
// The part of the axis at either end that is drawn straight on to the outline.
constexpr float kHeadTrim = 0.09f, kTailTrim = 0.05f;

struct LandmarksImpl final : Landmarks {
  LandmarkSettings settings;
  std::span<Vec2> contour;  // a copy, clockwise on the screen
  std::span<float> arc;
  std::span<AlongAxis> along;
  std::span<Vec2> smooth;
  Axis axis;
  float log_odds = 0;
  float area = 0;
  OrderStep step;
  bool was_swapped = false;
  bool found = false;

  bool find_outline(std::span<const Vec2> points, const LandmarkHints& hints, FishPose& pose);
  bool has_thin_tail(const StationValues& body, bool notched, float usual_length) const;
  bool decide_order(const LandmarkHints& hints);
  void measure_fins(std::span<const Vec2> c, Stretch right, const StationValues& body, FishPose& pose) const;
  void sample_axis(Vec2 barycentre, FishPose& pose) const;
};

LandmarksImpl& impl(Landmarks& l) { return static_cast<LandmarksImpl&>(l); }
const LandmarksImpl& impl(const Landmarks& l) { return static_cast<const LandmarksImpl&>(l); }

Vec2 at(std::span<const Vec2> c, int i) { return c[static_cast<std::size_t>(i)]; }

int index_gap(int from, int to, int n) { return ((to - from) % n + n) % n; }

// Which end of the axis is the head: true when it is the first. Updates the belief.
bool LandmarksImpl::decide_order(const LandmarkHints& hints) {
  const float evidence = order_evidence(smooth, axis, hints.travel) + contrast_evidence(axis, hints.luma, hints.ground);
  const float same_way = !hints.last.empty() ? hints.trust * continuity(axis, hints.last) : 0.0f;
  float belief = evidence;  // that axis.points[0] is the head
  if (!hints.last.empty()) belief = agreed(hints.head_log_odds, same_way) + kRepeatedEvidence * evidence;
  belief = det::clamp(belief, -8.0f, 8.0f);
  const bool first = belief >= 0;
  log_odds = det::abs(belief);
  was_swapped = !hints.last.empty() && first != (same_way >= 0);
  step = {kRepeatedEvidence * (first ? evidence : -evidence), first ? same_way : -same_way};
  return first;
}

bool LandmarksImpl::has_thin_tail(const StationValues& body, bool notched, float usual_length) const {
  const bool slender = body[kRear] < kSlender * det::max(axis.length, usual_length);
  return body[kPeduncle] < kThin_px && (slender || !notched);
}

void LandmarksImpl::measure_fins(std::span<const Vec2> c, Stretch right, const StationValues& body,
                                 FishPose& pose) const {
  const std::span<const AlongAxis> places = along.first(c.size());
  const Fin l = find_fin(c, places, right, body, axis.length, Side::left);
  const Fin r = find_fin(c, places, right, body, axis.length, Side::right);
  pose.confidence.l_fin = l.confidence, pose.confidence.r_fin = r.confidence;
  pose.l_fin = at(c, l.tip), pose.jun_tl = at(c, l.top), pose.jun_bl = at(c, l.bottom);
  pose.r_fin = at(c, r.tip), pose.jun_tr = at(c, r.top), pose.jun_br = at(c, r.bottom);
}

void LandmarksImpl::sample_axis(Vec2 barycentre, FishPose& pose) const {
  // The axis point nearest to the barycentre ([F] section 4.3, end), between stations too.
  float best = 1e30f, centre_s = 0.4f;
  for (int j = 0; j + 1 < kStations; ++j) {
    const Vec2 a = axis.points[static_cast<std::size_t>(j)], ab = axis.points[static_cast<std::size_t>(j) + 1] - a;
    const float u = det::clamp(dot(barycentre - a, ab) / det::max(length_sq(ab), 1e-12f), 0.0f, 1.0f);
    const float d = length_sq(barycentre - (a + ab * u));
    if (d < best) best = d, centre_s = (static_cast<float>(j) + u) / (kStations - 1);
  }
  pose.centre = point_at(axis, centre_s);
  pose.u_num = settings.u_num, pose.l_num = settings.l_num;
  for (int i = 0; i < settings.u_num; ++i) {
    const float u = static_cast<float>(i + 1) / static_cast<float>(settings.u_num + 1);
    pose.up_axis[i] = point_at(axis, centre_s * (1 - u));
  }
  for (int i = 0; i < settings.l_num; ++i) {
    const float u = static_cast<float>(i + 1) / static_cast<float>(settings.l_num + 1);
    pose.low_axis[i] = point_at(axis, centre_s + (1 - centre_s) * u);
  }
}

bool LandmarksImpl::find_outline(std::span<const Vec2> points, const LandmarkHints& hints, FishPose& pose) {
  found = false;
  const std::size_t n = points.size();
  if (n < 16 || n > contour.size()) return false;
  Moments moments = polygon_moments(points);
  const bool clockwise = moments.area > 0;
  area = det::abs(moments.area);
  for (std::size_t i = 0; i < n; ++i) contour[i] = points[clockwise ? i : n - 1 - i];
  const std::span<const Vec2> c = contour.first(n);
  arc_lengths(c, arc.first(n + 1), kArcReach);
  const std::span<const float> arcs = arc.first(n + 1);
  const float perimeter = arcs[n];

  // First guess of the ends, the paper's axis between them, then which end is which.
  Ends ends = find_ends(c, arcs, moments.centroid);
  const bool bent = !encloses(c, moments.centroid) && find_tips(c, arcs, ends);
  const EllipticFourier fourier = fit_fourier(c, arcs, settings.harmonics);
  const auto t = [&](int i) { return arcs[static_cast<std::size_t>(i)] / perimeter; };
  axis = medial_axis(fourier, t(ends.head), t(ends.tail), smooth);
  // Written so that a length that is not a number is refused too.
  if (!(axis.length >= kShortest_px) || axis.length * axis.length < kRoundest * area) return false;
  const bool kept = decide_order(hints);
  const int head = kept ? ends.head : ends.tail;
  const Vec2 body_point = bent ? point_at(axis, kept ? kBeforeTail : 1 - kBeforeTail) : moments.centroid;
  const int tail = notch_of_tail(c, arcs, body_point, kept ? ends.tail : ends.head);
  axis = medial_axis(fourier, t(head), t(tail), smooth);

  // Ours: centre the axis in the original outline.
  const Stretch right{head, index_gap(head, tail, static_cast<int>(n))};
  const AxisEnds drawn{at(c, head), at(c, tail), kHeadTrim, kTailTrim, tail != (kept ? ends.tail : ends.head)};
  axis = joined_to_ends(axis, drawn);
  StationValues body{};
  for (int round = 0; round < kRounds; ++round) {
    project_outline(c, right, axis, along);
    const WidthProfile widths = width_profile(along.first(n), right);
    body = body_half_width(widths);
    axis = extended_to_outline(centred(axis, widths, body), c, drawn);
  }
  measure_fins(c, right, body, pose);
  if (has_thin_tail(body, drawn.notched, hints.usual_length))
    axis = followed_tail(axis, hints.luma, hints.ground, hints.usual_length);

  sample_axis(moments.centroid, pose);
  pose.head = axis.points[0], pose.tail = axis.points[kStations - 1];
  pose.axis_len = axis.length;
  // The principal axis, signed towards the head ([F] section 4.1).
  pose.dir = dot(moments.axis, pose.head - pose.tail) >= 0 ? moments.axis : moments.axis * -1.0f;
  const float sure = 1.0f / (1.0f + det::exp(-log_odds));
  pose.confidence.centre = pose.confidence.axis = 1.0f;
  pose.confidence.head = pose.confidence.tail = sure;
  found = true;
  return true;
}

}  // namespace

Landmarks* Landmarks::create(Arena& arena, const Limits& limits, const LandmarkSettings& settings) {
  auto self = arena.take<LandmarksImpl>(1);
  const auto n = static_cast<std::size_t>(max_int(limits.max_contour_points, 0));
  auto contour = arena.take<Vec2>(n);
  auto arc = arena.take<float>(n + 1);
  auto along = arena.take<AlongAxis>(n);
  auto smooth = arena.take<Vec2>(2 * kStations);
  if (self.empty() || arena.full()) return nullptr;
  LandmarksImpl& l = self[0];
  l.settings = settings;
  l.settings.u_num = clamp_int(settings.u_num, 1, kMaxUpAxis);
  l.settings.l_num = clamp_int(settings.l_num, 1, kMaxLowAxis);
  l.settings.harmonics = clamp_int(settings.harmonics, 1, kMaxHarmonics);
  l.contour = contour, l.arc = arc, l.along = along, l.smooth = smooth;
  return &l;
}

bool Landmarks::find(std::span<const Vec2> contour, const LandmarkHints& hints, FishPose& pose) {
  return impl(*this).find_outline(contour, hints, pose);
}
float Landmarks::head_log_odds() const { return impl(*this).log_odds; }
float Landmarks::area_px() const { return impl(*this).area; }
OrderStep Landmarks::order() const { return impl(*this).step; }
bool Landmarks::swapped() const { return impl(*this).was_swapped; }
std::span<const Vec2> Landmarks::smooth_contour() const { return impl(*this).smooth; }
std::span<const Vec2> Landmarks::midline() const { return impl(*this).axis.points; }

const char* to_string(PoseStatus status) {
  switch (status) {
    case PoseStatus::ok:
      return "ok";
    case PoseStatus::partial:
      return "partial";
    case PoseStatus::occluded:
      return "occluded";
    case PoseStatus::absent:
      return "absent";
    case PoseStatus::lost:
      return "lost";
    case PoseStatus::relearn:
      return "relearn";
  }
  return "";
}

}  // namespace nt
