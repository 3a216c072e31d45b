// SPDX-License-Identifier: Apache-2.0
#include "app/ui/video_pane.h"

#include <algorithm>
#include <cmath>

#include "app/ui/pane.h"
#include "app/ui/theme.h"
#include "core/base/det_math.h"

namespace nt {

void VideoPane::draw(Scene& scene, const Area& area, const FigureView& view, int64_t frame, const Motion& motion,
                     float length_px, float line_px) {
  video_.want(frame);
  scene.area(area.corner, area.size, kInk);
  const Picture picture = video_.picture();
  if (picture.pixels == nullptr || !video_.problem().empty()) return;
  add_part(scene, area, view, picture);
  if (motion.status != PoseStatus::ok) return;
  const det::SinCos course = det::sincos(motion.dir_rad);
  course_ = {view.to_scene(motion.centre),
             view.to_scene(motion.centre + Vec2{course.cos, course.sin} * (0.6f * length_px))};
  scene.lines(course_, kRim, 3 * line_px);
  scene.lines(course_, kHeld, line_px);
  const std::span<const Vec2> centre = std::span(course_).first(1);
  scene.points(centre, kRim, 6 * line_px);
  scene.points(centre, kCentrePoint, 4 * line_px);
}

// Nothing is drawn outside of the pane: whole pixels that begin in it.
void VideoPane::add_part(Scene& scene, const Area& area, const FigureView& view, Picture picture) {
  const Vec2 first = view.to_figure(area.corner), last = view.to_figure(area.corner + area.size);
  const auto clamped = [](float at, int size) { return std::clamp(static_cast<int>(std::floor(at)), 0, size); };
  const int left = clamped(first.x + 1, picture.width), top = clamped(first.y + 1, picture.height);
  const int right = clamped(last.x, picture.width), bottom = clamped(last.y, picture.height);
  if (left >= right || top >= bottom) return;
  picture.pixels += static_cast<std::ptrdiff_t>(top) * picture.stride + 3 * static_cast<std::ptrdiff_t>(left);
  picture.width = right - left, picture.height = bottom - top;
  picture.id = kKeptPicture, picture.revision = ++revision_;
  const Vec2 corner{static_cast<float>(left), static_cast<float>(top)};
  const Vec2 size{static_cast<float>(picture.width), static_cast<float>(picture.height)};
  scene.image(picture, view.to_scene(corner), size * view.scale);
}

}  // namespace nt
