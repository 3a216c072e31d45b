// SPDX-License-Identifier: Apache-2.0
// The fish of one frame in the take editor: the character, ghosts of the frames before and after, handles to pull.
//
// ClipEditor + an area -> scene items, scene pixels; a place on the screen -> a handle; a handle that is pulled -> what the edit
// sets. Near: the character fills the area and stays in its middle. Far: the whole working frame, with the way it swims, and
// handles for place and course alone, for the others would lie on each other.
// What the scene points to lives here until the next draw(). Cost: a pose for each ghost, one for the character.
#pragma once
#include <optional>
#include <vector>

#include "app/take_edit/clip_editor.h"
#include "app/take_edit/puppet.h"
#include "core/scene/scene.h"

namespace nt {

struct CanvasLook {
  bool ghosts = true, before = false, far = false;
  bool handles = true;
  float dot_px = 13;
};

class TakeCanvas {
 public:
  TakeCanvas(const Wardrobe& wardrobe, float init_len_px, Vec2 frame_px);

  // Where frame pixels lie; while something is held it stays as it is.
  void lay_out(const Area& area, const ClipEditor& editor, const CanvasLook& look);
  void draw(Scene& scene, const ClipEditor& editor, const CanvasLook& look);

  const FigureView& view() const { return view_; }  // frame pixels -> scene pixels
  std::optional<Handle> hit(const ClipEditor& editor, Vec2 at, float reach);
  std::vector<Handle> handles(const ClipEditor& editor);  // of the current frame
  std::vector<ClipEditor::Setting> pulled(const ClipEditor& editor, MotionProperty property, Vec2 to);

 private:
  std::vector<Handle> handles_of(const Puppet& puppet) const;
  void add_ghosts(Scene& scene, const ClipEditor& editor);
  void add_way(Scene& scene, const ClipEditor& editor, float width_px);
  void add_handles(Scene& scene, const ClipEditor& editor, float dot_px);

  Vec2 frame_px_;
  FigureView view_;
  bool far_ = false;
  Puppet puppet_, trial_;
  std::vector<Puppet> ghosts_;
  std::vector<Vec2> way_;
  std::vector<std::vector<Vec2>> dots_;
};

}  // namespace nt
