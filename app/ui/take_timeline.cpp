// SPDX-License-Identifier: Apache-2.0
#include "app/ui/take_timeline.h"

#include <algorithm>
#include <cmath>

#include "app/ui/theme.h"

namespace nt {
namespace {

constexpr int64_t kLeastShown = 30;
constexpr float kLeastReach_deg = 20, kHeadroom = 1.12f;
constexpr float kBandShare = 0.07f;  // of the plot's height: the confidences of the visible frames
constexpr float kFaint = 0.28f;
constexpr Colour kSure = rgb(0x2FA39A), kNotSure = rgb(0xF2A93B), kNoPose = rgb(0x4A5560);
constexpr Colour kGround = rgb(0xFFFFFF), kRestLine = rgb(0xC9D3D9), kHill = rgb(0xE0662F, 0.16f),
                 kEdge = rgb(0xE0662F, 0.8f), kCursor = rgb(0x22313A), kRecorded = rgb(0x8B979E, 0.9f),
                 kOutside = rgb(0xFFFFFF, 0.62f);
constexpr float kFullySure = 0.7f;
constexpr float kHillShare = 0.92f;  // of the plot's height at the frame itself

Colour mixed(Colour a, Colour b, float t) {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, 1};
}

Colour colour_of(const Motion& motion, MotionProperty property) {
  return motion.status == PoseStatus::ok ? confidence_colour(confidence_of(motion, property)) : kNoPose;
}

const Motion& motion_at(const ClipEditor& editor, int64_t frame, bool recorded) {
  return recorded ? editor.recorded_at(frame) : editor.motions()[static_cast<std::size_t>(frame)];
}

// Frames without a pose hold the last one, or nothing at all: no curve goes by them.
bool has_pose(const ClipEditor& editor, int64_t frame, bool recorded) {
  return motion_at(editor, frame, recorded).status == PoseStatus::ok;
}

float shown_value(const ClipEditor& editor, MotionProperty property, int64_t frame, bool recorded) {
  return degrees_or_pixels(value_of(motion_at(editor, frame, recorded), property), property, editor.rest());
}

}  // namespace

Colour confidence_colour(float confidence) {
  return mixed(kNotSure, kSure, std::clamp(confidence / kFullySure, 0.0f, 1.0f));
}

Colour curve_colour(std::size_t index) {
  static constexpr Colour kColours[] = {rgb(0x7A4FB5), rgb(0x3B6FD4), rgb(0x2A9FD6), rgb(0xE5352B),
                                        rgb(0xD9822B), rgb(0xB59A1B), rgb(0x6FA32B), rgb(0x2B8F4A),
                                        rgb(0x1B7F8C), rgb(0xC2378A), rgb(0x8C5A3C)};
  return kColours[index % std::size(kColours)];
}

void TakeTimeline::lay_out(const Area& plot, const Area& strip, const ClipEditor& editor) {
  plot_ = plot, strip_ = strip;
  if (editor.holding()) return;
  shown_ = std::min(shown_, editor.frames());
  const int64_t margin = shown_ / 12, frame = editor.frame();
  if (frame < first_ + margin || frame >= first_ + shown_ - margin) first_ = frame - shown_ / 2;
  first_ = std::clamp<int64_t>(first_, 0, editor.frames() - shown_);
  if (scaled_revision_ == editor.revision()) return;
  scaled_revision_ = editor.revision();
  float reach = kLeastReach_deg;
  for (const NamedCurve& curve : curves_) {
    if (curve.property.is_path()) continue;
    for (int64_t i = 0; i < editor.frames(); ++i)
      if (has_pose(editor, i, false)) reach = std::max(reach, std::abs(shown_value(editor, curve.property, i, false)));
  }
  reach_deg_ = kHeadroom * reach;
}

void TakeTimeline::zoom(bool in, const ClipEditor& editor) {
  const int64_t middle = editor.frame();
  shown_ = std::clamp(in ? shown_ / 2 : shown_ * 2, std::min(kLeastShown, editor.frames()), editor.frames());
  first_ = std::clamp<int64_t>(middle - shown_ / 2, 0, editor.frames() - shown_);
}

float TakeTimeline::x_of(double frame) const {
  const double along = (frame - static_cast<double>(first_) + 0.5) / static_cast<double>(shown_);
  return plot_.corner.x + plot_.size.x * static_cast<float>(along);
}

int64_t TakeTimeline::plot_frame(float x) const {
  const double along = static_cast<double>(x - plot_.corner.x) / static_cast<double>(plot_.size.x);
  return first_ +
         std::clamp<int64_t>(static_cast<int64_t>(std::floor(along * static_cast<double>(shown_))), 0, shown_ - 1);
}

int64_t TakeTimeline::strip_frame(float x, const ClipEditor& editor) const {
  const double along = static_cast<double>(x - strip_.corner.x) / static_cast<double>(strip_.size.x);
  return static_cast<int64_t>(std::floor(along * static_cast<double>(editor.frames())));
}

TakeTimeline::Scale TakeTimeline::scale_of(const ClipEditor& editor, MotionProperty property) const {
  if (!property.is_path()) return {-reach_deg_, reach_deg_};
  // Over what is visible of the recording, so that the curve moves and not the scale.
  Scale scale{1e9f, -1e9f};
  const int64_t step = std::max<int64_t>(shown_ / 1000, 1);
  for (int64_t i = first_; i < first_ + shown_; i += step) {
    if (!has_pose(editor, i, true)) continue;
    const float shown = shown_value(editor, property, i, true);
    scale = {std::min(scale.least, shown), std::max(scale.most, shown)};
  }
  if (scale.least > scale.most) return {};
  const float room = std::max(0.25f * (scale.most - scale.least), 10.0f);
  return {scale.least - room, scale.most + room};
}

float TakeTimeline::y_of(float shown, Scale scale) const {
  const float height = plot_.size.y * (1 - kBandShare);
  const float share = std::clamp((scale.most - shown) / (scale.most - scale.least), 0.0f, 1.0f);
  return plot_.corner.y + height * share;
}

Vec2 TakeTimeline::on_plot(const ClipEditor& editor, MotionProperty property, int64_t frame) const {
  return {x_of(static_cast<double>(frame)),
          y_of(shown_value(editor, property, frame, false), scale_of(editor, property))};
}

float TakeTimeline::value_at(float y, const ClipEditor& editor) const {
  const Scale scale = scale_of(editor, editor.selected());
  const float share = (y - plot_.corner.y) / (plot_.size.y * (1 - kBandShare));
  const float shown = scale.most - share * (scale.most - scale.least);
  return from_degrees_or_pixels(shown, editor.selected(), editor.rest());
}

std::span<const Vec2> TakeTimeline::keep(std::vector<Vec2> points) { return points_.emplace_back(std::move(points)); }

void TakeTimeline::line(Scene& scene, Vec2 from, Vec2 to, Colour colour, float width_px) {
  scene.lines(keep({from, to}), colour, width_px);
}

void TakeTimeline::add_curve(Scene& scene, const ClipEditor& editor, MotionProperty property, Colour colour,
                             float width_px, bool recorded) {
  const Scale scale = scale_of(editor, property);
  // Where several frames share a column of pixels their least and their greatest are drawn.
  const auto columns = static_cast<int64_t>(plot_.size.x);
  const int64_t each = std::max<int64_t>(1, shown_ / columns);
  std::vector<Vec2> points;
  for (int64_t i = first_; i < first_ + shown_; i += each) {
    float least = 1e9f, most = -1e9f;
    for (int64_t k = i; k < std::min(i + each, first_ + shown_); ++k) {
      if (!has_pose(editor, k, recorded)) continue;
      const float value = shown_value(editor, property, k, recorded);
      least = std::min(least, value), most = std::max(most, value);
    }
    if (least > most) continue;
    const float x = x_of(static_cast<double>(i) + 0.5 * static_cast<double>(each - 1));
    points.push_back({x, y_of(least, scale)});
    if (each > 1) points.push_back({x, y_of(most, scale)});
  }
  scene.lines(keep(std::move(points)), colour, width_px);
}

void TakeTimeline::add_window(Scene& scene, const ClipEditor& editor) {
  const EditWindow window = editor.window();
  const float height = plot_.size.y * (1 - kBandShare), floor = plot_.corner.y + height;
  const auto first = std::max<int64_t>(window.p, first_), last = std::min<int64_t>(window.q, first_ + shown_ - 1);
  const int64_t each = std::max<int64_t>(1, shown_ / static_cast<int64_t>(plot_.size.x));
  std::vector<Vec2> ridge, strip;  // the ridge and the floor under it, in turn
  for (int64_t i = first; i <= last; i += each) {
    const float share = influence(static_cast<int>(i), static_cast<int>(editor.frame()), window);
    ridge.push_back({x_of(static_cast<double>(i)), floor - kHillShare * height * share});
    strip.insert(strip.end(), {ridge.back(), {ridge.back().x, floor}});
  }
  if (ridge.size() < 2) return;
  hill_.clear();
  for (uint32_t i = 0; i + 2 < strip.size(); i += 2) hill_.insert(hill_.end(), {i, i + 1, i + 2, i + 1, i + 3, i + 2});
  scene.plain(keep(std::move(strip)), hill_, kHill);
  scene.lines(keep(std::move(ridge)), kEdge, 1.5f);
}

void TakeTimeline::add_keys(Scene& scene, const ClipEditor& editor, float line_px) {
  std::vector<Vec2> keys;
  for (const int64_t frame : editor.keys(editor.selected()))
    if (frame >= first_ && frame < first_ + shown_) keys.push_back(on_plot(editor, editor.selected(), frame));
  const auto at = keep(std::move(keys));
  scene.points(at, kGround, 4.5f * line_px);
  scene.points(at, kEdge, 3.2f * line_px);
}

void TakeTimeline::add_confidences(Scene& scene, const ClipEditor& editor, const Area& area, FrameRange range,
                                   PictureId slot) {
  const int64_t frames = range.last - range.first + 1;
  const int64_t columns = std::min<int64_t>(frames, static_cast<int64_t>(area.size.x));
  Strip& strip = strips_[slot == kBandPicture ? 1 : 0];
  strip.rgb.clear();
  for (int64_t c = 0; c < columns; ++c) {
    const int64_t begin = range.first + c * frames / columns, end = range.first + (c + 1) * frames / columns;
    Colour sum{0, 0, 0, 1};
    for (int64_t i = begin; i < end; ++i) {
      const Colour one = colour_of(editor.motions()[static_cast<std::size_t>(i)], editor.selected());
      sum.r += one.r, sum.g += one.g, sum.b += one.b;
    }
    for (const float part : {sum.r, sum.g, sum.b})
      strip.rgb.push_back(static_cast<uint8_t>(std::lround(255 * part / static_cast<float>(end - begin))));
  }
  Picture picture;
  picture.pixels = strip.rgb.data();
  picture.width = static_cast<int>(columns), picture.height = 1, picture.stride = static_cast<int>(columns) * 3;
  picture.format = PixelFormat::rgb8;
  picture.id = slot, picture.revision = ++strip.revision;
  scene.image(picture, area.corner, area.size);
}

void TakeTimeline::add_strip(Scene& scene, const ClipEditor& editor, float line_px) {
  add_confidences(scene, editor, strip_, {0, editor.frames() - 1}, kStripPicture);
  const auto x = [&](int64_t frame) {
    return strip_.corner.x + strip_.size.x * static_cast<float>(frame) / static_cast<float>(editor.frames());
  };
  const float top = strip_.corner.y, height = strip_.size.y, left = strip_.corner.x, right = left + strip_.size.x;
  const FrameRange range = editor.range();
  scene.area({left, top}, {x(range.first) - left, height}, kOutside);
  scene.area({x(range.last + 1), top}, {right - x(range.last + 1), height}, kOutside);
  const float begin = x(first_), end = x(first_ + shown_);
  scene.lines(keep({{begin, top}, {end, top}, {end, top + height}, {begin, top + height}}), kCursor, line_px, true);
  const float at = x(editor.frame()) + 0.5f * strip_.size.x / static_cast<float>(editor.frames());
  line(scene, {at, top}, {at, top + height}, kGround, 2.5f * line_px);
  line(scene, {at, top}, {at, top + height}, kEdge, 1.5f * line_px);
}

void TakeTimeline::draw(Scene& scene, const ClipEditor& editor, float line_px) {
  points_.clear();
  scene.area(plot_.corner, plot_.size, kGround);
  const MotionProperty selected = editor.selected();
  add_window(scene, editor);
  const float height = plot_.size.y * (1 - kBandShare), right = plot_.corner.x + plot_.size.x;
  const float middle = plot_.corner.y + 0.5f * height;
  if (!selected.is_path()) line(scene, {plot_.corner.x, middle}, {right, middle}, kRestLine, line_px);
  Colour colour = kAccent;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    Colour own = curve_colour(i);
    if (curves_[i].property == selected) colour = own;
    own.a = kFaint;
    if (curves_[i].property != selected && curves_[i].property.is_path() == selected.is_path())
      add_curve(scene, editor, curves_[i].property, own, line_px);
  }
  add_curve(scene, editor, selected, kRecorded, line_px, true);
  add_curve(scene, editor, selected, colour, 2 * line_px);
  add_keys(scene, editor, line_px);
  add_confidences(scene, editor, {{plot_.corner.x, plot_.corner.y + height}, {plot_.size.x, plot_.size.y - height}},
                  {first_, first_ + shown_ - 1}, kBandPicture);
  const float x = x_of(static_cast<double>(editor.frame()));
  line(scene, {x, plot_.corner.y}, {x, plot_.corner.y + plot_.size.y}, kCursor, line_px);
  scene.points(keep({on_plot(editor, selected, editor.frame())}), kCursor, 4.5f * line_px);
  add_strip(scene, editor, line_px);
}

}  // namespace nt
