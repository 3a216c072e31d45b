// SPDX-License-Identifier: Apache-2.0
#include "app/ui/editor_canvas.h"

#include <algorithm>
#include <map>

#include "app/author/polyline.h"
#include "app/ui/pane.h"
#include "app/ui/theme.h"

namespace nt {
namespace {

// Diameters as shares of a large point's.
constexpr float kSmall = 0.62f, kRimWidth = 0.22f, kRingWidth = 0.75f;

bool large(PointId id) {
  return id.kind == PointKind::head || id.kind == PointKind::tail || id.kind == PointKind::fin_tip;
}

Colour colour_of(PointId id) {
  switch (id.kind) {
    case PointKind::head:
      return kHeadPoint;
    case PointKind::tail:
      return kTailPoint;
    case PointKind::centre:
      return kCentrePoint;
    case PointKind::up_axis:
    case PointKind::low_axis:
      return kAxisPoint;
    case PointKind::fin_tip:
      return kTipPoint;
    case PointKind::fin_top:
    case PointKind::fin_bottom:
      break;
  }
  return kRootPoint;
}

}  // namespace

int unsure_points(const Rig& rig) {
  const std::vector<PointId> all = points_of(rig);
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [&](PointId id) { return point_confidence(rig, id) < kUnsureBelow; }));
}

std::span<const Vec2> EditorCanvas::kept(std::vector<Vec2> points) {
  lines_.push_back(std::move(points));
  return lines_.back();
}

void EditorCanvas::draw(Scene& scene, const Editor& editor, const FigureView& view, const Area& area, float dot) {
  lines_.clear();
  vertices_.clear();
  for (const Vec2 v : figure_.vertices()) vertices_.push_back(view.to_scene(v));
  Picture texture = figure_.texture();
  texture.id = kFirstCharacterPicture;
  scene.mesh(texture, vertices_, figure_.texcoords(), figure_.triangles());
  add_skeleton(scene, editor.rig(), view, dot);
  add_points(scene, editor.rig(), view, dot);
  if (!editor.stroke().empty()) {
    std::vector<Vec2> stroke;
    for (const Vec2 p : editor.stroke()) stroke.push_back(view.to_scene(p));
    scene.lines(kept(stroke), kRim, 0.55f * dot);
    scene.lines(lines_.back(), kUnsure, 0.35f * dot);
  }
  const std::optional<PointId> shown = editor.held() ? editor.held() : editor.selected();
  if (!shown) return;
  const Vec2 at = view.to_scene(point_at(editor.rig(), *shown));
  if (editor.held()) add_cross(scene, at, area, dot);
  const float size = (large(*shown) ? 1.0f : kSmall) * dot;
  scene.points(kept({at}), kRim, size + 0.75f * dot);
  scene.points(lines_.back(), kHeld, size + 0.5f * dot);
  scene.points(lines_.back(), colour_of(*shown), size);
}

void EditorCanvas::add_skeleton(Scene& scene, const Rig& rig, const FigureView& view, float dot) {
  const auto shown = [&](std::vector<Vec2> line) {
    for (Vec2& p : line) p = view.to_scene(p);
    return kept(std::move(line));
  };
  const std::span<const Vec2> midline = shown(rounded_line(midline_of(rig)));
  scene.lines(midline, kRim, 0.34f * dot);
  scene.lines(midline, kAxisPoint, 0.2f * dot);
  for (const RigFin& fin : rig.fins) {
    if (!fin.present) continue;
    const std::span<const Vec2> edge = shown({fin.top, fin.tip, fin.bottom});
    scene.lines(edge, kRim, 0.28f * dot, true);
    scene.lines(edge, kTipPoint, 0.15f * dot, true);
  }
}

// One item for all points that look alike: a scene has room for few. Large ones last, so that nothing lies over them.
void EditorCanvas::add_points(Scene& scene, const Rig& rig, const FigureView& view, float dot) {
  for (const bool of_large : {false, true}) {
    const float size = (of_large ? 1.0f : kSmall) * dot;
    std::vector<Vec2> all, unsure;
    std::map<PointKind, std::vector<Vec2>> by_kind;
    for (const PointId id : points_of(rig)) {
      if (large(id) != of_large) continue;
      const Vec2 at = view.to_scene(point_at(rig, id));
      all.push_back(at);
      by_kind[id.kind].push_back(at);
      if (point_confidence(rig, id) < kUnsureBelow) unsure.push_back(at);
    }
    const std::span<const Vec2> rings = kept(std::move(unsure)), rims = kept(std::move(all));
    scene.points(rings, kRim, size + kRingWidth * dot);
    scene.points(rings, kUnsure, size + (kRingWidth - 0.15f) * dot);
    scene.points(rims, kRim, size + kRimWidth * dot);
    for (auto& [kind, at] : by_kind) scene.points(kept(std::move(at)), colour_of({kind, 0}), size);
  }
}

void EditorCanvas::add_cross(Scene& scene, Vec2 at, const Area& area, float dot) {
  const Vec2 far = area.corner + area.size;
  scene.lines(kept({{area.corner.x, at.y}, {far.x, at.y}}), kRim, 0.06f * dot);
  scene.lines(kept({{at.x, area.corner.y}, {at.x, far.y}}), kRim, 0.06f * dot);
}

}  // namespace nt
