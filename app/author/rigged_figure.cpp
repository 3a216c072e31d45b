// SPDX-License-Identifier: Apache-2.0
#include "app/author/rigged_figure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "app/author/figure_frame.h"
#include "app/author/proposal.h"

namespace nt {
namespace {

// The figure's main axis is the character's direction unless the midline runs across it: cosine of 45 degrees.
constexpr float kAcross = 0.7f;
constexpr int kMargin = 8;  // pixels around the silhouette

// A mirror image's left fin is drawn on the figure's right.
int fin_in_figure(const FigureFrame& f, int fin) { return f.mirror ? fin ^ 1 : fin; }

// From the order of a character file.
void take_confidences(Rig& rig, std::span<const float> from, const FigureFrame& frame) {
  std::size_t at = 0;
  rig.centre_confidence = from[at++];
  rig.head_confidence = from[at++];
  rig.tail_confidence = from[at++];
  for (int i = 0; i < rig.u_num; ++i) rig.up_confidence[i] = from[at++];
  for (int i = 0; i < rig.l_num; ++i) rig.low_confidence[i] = from[at++];
  for (int i = 0; i < kMaxFins; ++i, at += 3) {
    rig.fins[fin_in_figure(frame, i)].confidence = std::min({from[at], from[at + 1], from[at + 2]});
  }
}

Rig rig_of(const Character& c) {
  Rig rig;
  rig.u_num = c.u_num, rig.l_num = c.l_num, rig.harmonics = c.harmonics;
  rig.deformer = c.deformer, rig.flip = c.figure.mirror, rig.has_tail_fin = c.has_tail_fin;
  const auto place = [&](Vec2 p) { return to_figure(c.figure, p); };
  rig.centre = place(c.rest.centre), rig.head = place(c.rest.head), rig.tail = place(c.rest.tail);
  for (int i = 0; i < c.u_num; ++i) rig.up_axis[i] = place(c.rest.up_axis[i]);
  for (int i = 0; i < c.l_num; ++i) rig.low_axis[i] = place(c.rest.low_axis[i]);
  for (int i = 0; i < kMaxFins; ++i) {
    const FinPoints& fin = c.rest.fins[i];
    if (fin.present)
      rig.fins[fin_in_figure(c.figure, i)] = {true, place(fin.tip), place(fin.top), place(fin.bottom), 0};
  }
  take_confidences(rig, c.confidences, c.figure);
  return rig;
}

ControlPoints control_points(const Rig& rig, const FigureFrame& frame) {
  const auto local = [&](Vec2 p) { return to_character(frame, p); };
  ControlPoints c;
  c.centre = {}, c.head = local(rig.head), c.tail = local(rig.tail);
  for (int i = 0; i < rig.u_num; ++i) c.up_axis[i] = local(rig.up_axis[i]);
  for (int i = 0; i < rig.l_num; ++i) c.low_axis[i] = local(rig.low_axis[i]);
  for (int i = 0; i < kMaxFins; ++i) {
    const RigFin& fin = rig.fins[fin_in_figure(frame, i)];
    if (fin.present) c.fins[i] = {true, local(fin.top), local(fin.bottom), local(fin.tip)};
  }
  return c;
}

// In the order of a character file.
std::vector<float> confidences_of(const Rig& rig, const FigureFrame& frame) {
  std::vector<float> out{rig.centre_confidence, rig.head_confidence, rig.tail_confidence};
  out.insert(out.end(), rig.up_confidence, rig.up_confidence + rig.u_num);
  out.insert(out.end(), rig.low_confidence, rig.low_confidence + rig.l_num);
  for (int i = 0; i < kMaxFins; ++i) out.insert(out.end(), 3, rig.fins[fin_in_figure(frame, i)].confidence);
  return out;
}

cv::Point pixel(Vec2 p) { return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))}; }

Vec2 vec(cv::Point p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

// The mesh seen from above, as a picture of `size` pixels whose first one is at `origin` in the figure.
cv::Mat silhouette(std::span<const Vec2> vertices, std::span<const uint32_t> triangles, cv::Point origin,
                   cv::Size size) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8U);
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    cv::Point corners[3];
    for (std::size_t k = 0; k < 3; ++k) corners[k] = pixel(vertices[triangles[i + k]]) - origin;
    cv::fillConvexPoly(mask, corners, 3, 255);
  }
  return mask;
}

// Leaves of a mask its largest figure, filled, and gives its border.
std::vector<Vec2> keep_largest(cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Vec2> outline;
  const auto largest = std::max_element(contours.begin(), contours.end(), [](const auto& a, const auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
  if (largest == contours.end()) return outline;
  mask.setTo(0);
  cv::drawContours(mask, std::vector<std::vector<cv::Point>>{*largest}, 0, 255, cv::FILLED);
  for (const cv::Point p : *largest) outline.push_back(vec(p));
  return outline;
}

// `origin`: of the proposal's pixels, in the figure.
Rig rig_of(const Proposal& proposal, Vec2 origin, const Rig& now, int harmonics) {
  Rig rig = now;
  rig.harmonics = harmonics;
  const FishPose& pose = proposal.pose;
  rig.centre = origin + pose.centre, rig.head = origin + pose.head, rig.tail = origin + pose.tail;
  for (int i = 0; i < rig.u_num; ++i) rig.up_axis[i] = origin + pose.up_axis[i];
  for (int i = 0; i < rig.l_num; ++i) rig.low_axis[i] = origin + pose.low_axis[i];
  for (int i = 0; i < kMaxFins; ++i) {
    const FinPoints& fin = proposal.fins[i];
    rig.fins[i] = {};
    if (fin.present) rig.fins[i] = {true, origin + fin.tip, origin + fin.top, origin + fin.bottom, 0};
  }
  rig.has_tail_fin = proposal.has_tail_fin;
  take_confidences(rig, proposal.confidences, {});
  return rig;
}

}  // namespace

RiggedFigure::RiggedFigure(const Character& c)
    : texcoords_(c.texcoords.begin(), c.texcoords.end()),
      heights_(c.heights.begin(), c.heights.end()),
      triangles_(c.triangles.begin(), c.triangles.end()),
      texture_(c.texture),
      dir_(c.figure.dir),
      found_(rig_of(c)) {
  for (const Vec2 v : c.vertices) vertices_.push_back(to_figure(c.figure, v));
  for (const Vec3 n : c.normals) {
    const Vec2 flat = x_axis(c.figure) * n.x + c.figure.dir * n.y;
    normals_.push_back({flat.x, flat.y, n.z});
  }
  if (c.figure.mirror) {
    for (std::size_t i = 0; i + 2 < triangles_.size(); i += 3) std::swap(triangles_[i + 1], triangles_[i + 2]);
  }
  Vec2 far = vertices_.front();
  corner_ = far;
  for (const Vec2 v : vertices_) {
    corner_ = {std::min(corner_.x, v.x), std::min(corner_.y, v.y)};
    far = {std::max(far.x, v.x), std::max(far.y, v.y)};
  }
  size_ = far - corner_;
  if (c.solid()) sort_by_height();
}

void RiggedFigure::sort_by_height() {
  std::vector<std::size_t> order(triangles_.size() / 3);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t t) {
    return heights_[triangles_[3 * t]] + heights_[triangles_[3 * t + 1]] + heights_[triangles_[3 * t + 2]];
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height(a) < height(b); });
  std::vector<uint32_t> sorted;
  sorted.reserve(triangles_.size());
  for (const std::size_t t : order) {
    const auto first = triangles_.begin() + static_cast<std::ptrdiff_t>(3 * t);
    sorted.insert(sorted.end(), first, first + 3);
  }
  triangles_ = std::move(sorted);
}

Rig RiggedFigure::found_for(const Corrections& corrections) const {
  const int harmonics = corrections.harmonics.value_or(found_.harmonics);
  return harmonics == found_.harmonics ? found_ : propose(found_, harmonics);
}

Rig RiggedFigure::propose(const Rig& now, int harmonics) const {
  // A drawing's pixels are its texture; a solid's texture is no picture of it.
  cv::Point origin;
  cv::Size size(texture_.width, texture_.height);
  cv::Mat rgba;
  if (solid()) {
    const cv::Point margin(kMargin, kMargin), far = pixel(corner_ + size_) + margin;
    origin = pixel(corner_) - margin;
    size = {far.x - origin.x, far.y - origin.y};
  } else {
    rgba = cv::Mat(size, CV_8UC4, const_cast<uint8_t*>(texture_.pixels), static_cast<std::size_t>(texture_.stride));
  }
  cv::Mat mask = silhouette(vertices_, triangles_, origin, size);
  // Parts of a solid that touch nearly are one figure (mesh_character.cpp).
  if (solid()) cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}));
  const std::vector<Vec2> outline = keep_largest(mask);
  const ToldHead told{now.head - vec(origin), normalised(now.head - now.tail)};
  const Proposal proposal =
      propose_landmarks("the figure", mask, rgba, outline, told, {now.u_num, now.l_num, harmonics});
  return rig_of(proposal, vec(origin), now, harmonics);
}

RiggedCharacter RiggedFigure::with(const Rig& rig) const {
  const Vec2 ahead = normalised(rig.head - rig.tail);
  const Vec2 axis = dot(dir_, ahead) < 0 ? dir_ * -1.0f : dir_;
  const FigureFrame frame{rig.centre, dot(axis, ahead) > kAcross ? axis : ahead, rig.flip};
  RiggedCharacter out;
  out.confidences = confidences_of(rig, frame);
  for (const Vec2 v : vertices_) out.vertices.push_back(to_character(frame, v));
  for (const Vec3 n : normals_) {
    const Vec2 flat{n.x, n.y};
    out.normals.push_back({dot(flat, x_axis(frame)), dot(flat, frame.dir), n.z});
  }
  out.triangles = triangles_;
  if (rig.flip) {
    for (std::size_t i = 0; i + 2 < out.triangles.size(); i += 3) std::swap(out.triangles[i + 1], out.triangles[i + 2]);
  }
  Character& c = out.character;
  c.u_num = rig.u_num, c.l_num = rig.l_num, c.harmonics = rig.harmonics;
  c.has_tail_fin = rig.has_tail_fin, c.deformer = rig.deformer, c.figure = frame;
  c.rest = control_points(rig, frame);
  c.confidences = out.confidences;
  c.vertices = out.vertices, c.normals = out.normals, c.triangles = out.triangles;
  c.heights = heights_, c.texcoords = texcoords_, c.texture = texture_;
  return out;
}

}  // namespace nt
