// SPDX-License-Identifier: Apache-2.0
// The window of `neontetra character --edit`: the figure at the left, buttons at the right and above, 1280x720 or 800x480,
// mouse or touch.
//
// Character + corrections -> corrections, through `save`. Drag a point to move it; draw the midline; place fins; the swim
// button lets the character swim at once after the simulated tank. Keys: 1 2 3 tools, m mirror, space swim, arrows move the
// point, Ctrl+Z and Ctrl+Y, Ctrl+S, q.
// Cost: a frame is drawn 60 times a second; a change that is swum puts the character on anew (about 20 ms).
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/author/rigged_figure.h"
#include "app/character_edit/editor.h"
#include "app/character_edit/test_swim.h"
#include "app/ui/editor_canvas.h"
#include "app/ui/editor_window.h"

namespace nt {

class CharacterEditor : public EditorWindow {
 public:
  using Save = std::function<void(const Character&, const Corrections&)>;  // may throw UserError: then it is shown
  // `character`'s pixels must outlive this.
  CharacterEditor(Display& display, std::string name, const Character& character, const Corrections& corrections,
                  Save save);

  const Editor& editor() const { return editor_; }
  bool swimming() const { return swimming_; }
  Vec2 on_screen(PointId id) const { return view_.to_scene(point_at(editor_.rig(), id)); }  // scene pixels
  const Area& canvas() const { return canvas_area_; }

 private:
  void lay_out() override;
  void press_key(const InputEvent& event) override;
  bool press(Vec2 at, float reach) override;
  void drag(Vec2 at) override { editor_.drag(view_.to_figure(at)); }
  void release() override { editor_.release(); }
  void show() override;
  void compose(float dt_s) override;
  void pointer_is_up() override { editor_.end_gesture(); }
  uint64_t revision() const override { return editor_.revision(); }
  bool unsaved() const override { return editor_.unsaved(); }
  void write() override;
  std::string saved_words() const override { return "Saved: " + name_; }

  void show_bar();
  void show_side();
  void show_tools(int& index);
  void show_numbers(int& index);
  void show_legend();
  void show_status();
  std::string advice() const;
  void swim(bool on);

  std::string name_;
  RiggedFigure figure_;
  Editor editor_;
  EditorCanvas canvas_;
  Save save_;
  Area canvas_area_, bar_, side_, status_;
  FigureView view_;
  bool swimming_ = false;
  std::optional<int> harmonics_;  // chosen, and set when the slider is let go: proposing takes its time
  std::unique_ptr<TestSwim> swim_;
  RiggedCharacter worn_;
  std::optional<uint64_t> worn_revision_;
};

}  // namespace nt
