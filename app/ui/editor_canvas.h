// SPDX-License-Identifier: Apache-2.0
// The figure with its midline, fins and control points, as scene items.
//
// Editor + view -> items added to the scene, scene pixels. Control points that are unsure (confidence below kUnsureBelow)
// stand in an orange ring, the one that is held in a white one with cross hairs that show from under a finger.
// The spans that the scene points to live here until the next call. Cost: one pass over the vertices.
#pragma once
#include <span>
#include <vector>

#include "app/author/rigged_figure.h"
#include "app/character_edit/editor.h"
#include "app/character_edit/figure_view.h"
#include "core/scene/scene.h"

namespace nt {

inline constexpr float kUnsureBelow = 0.5f;
// Points that deserve a look.
int unsure_points(const Rig& rig);

class EditorCanvas {
 public:
  explicit EditorCanvas(const RiggedFigure& figure) : figure_(figure) {}
  // `dot` is the diameter of a large control point, scene pixels.
  void draw(Scene& scene, const Editor& editor, const FigureView& view, const Area& area, float dot);

 private:
  void add_skeleton(Scene& scene, const Rig& rig, const FigureView& view, float dot);
  void add_points(Scene& scene, const Rig& rig, const FigureView& view, float dot);
  void add_cross(Scene& scene, Vec2 at, const Area& area, float dot);
  std::span<const Vec2> kept(std::vector<Vec2> points);

  const RiggedFigure& figure_;
  std::vector<Vec2> vertices_;
  std::vector<std::vector<Vec2>> lines_;  // what the scene points to
};

}  // namespace nt
