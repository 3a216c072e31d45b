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
#include <vector>

#include "app/author/rigged_figure.h"
#include "app/character_edit/editor.h"
#include "app/character_edit/test_swim.h"
#include "app/ui/editor_canvas.h"
#include "app/ui/panel.h"
#include "app/ui/pointer.h"
#include "platform/display.h"

namespace nt {

class CharacterEditor {
 public:
  using Save = std::function<void(const Character&, const Corrections&)>;  // may throw UserError: then it is shown
  // `character`'s pixels must outlive this.
  CharacterEditor(Display& display, std::string name, const Character& character, const Corrections& corrections,
                  Save save);

  // Events, one picture. False when the user is done. dt_s since the last call.
  bool frame(float dt_s);
  const Editor& editor() const { return editor_; }
  bool swimming() const { return swimming_; }
  bool asking() const { return asking_; }  // whether to save
  Vec2 on_screen(PointId id) const;        // scene pixels
  const Area& canvas() const { return canvas_area_; }

 private:
  struct Layout {
    float unit = 44, gap = 6;  // scene pixels: the height of a button, the space between
    Area canvas, bar, side, status;
    FigureView view;
  };
  Layout lay_out() const;
  void read_events();
  void press_key(const InputEvent& event);
  void use_pointer(const PointerState& pointer, const Layout& layout);
  void show_bar(const Layout& layout);
  void show_side(const Layout& layout);
  void show_tools(const Layout& layout, int& row);
  void show_numbers(const Layout& layout, int& row);
  void show_legend(const Layout& layout);
  void show_status(const Layout& layout);
  void show_question(const Layout& layout);
  Area row_area(const Layout& layout, int row) const;
  std::string advice() const;
  void save();
  void leave();
  void swim(bool on);
  void compose(const Layout& layout, float dt_s);

  Display& display_;
  std::string name_;
  RiggedFigure figure_;
  Editor editor_;
  EditorCanvas canvas_;
  std::unique_ptr<Panel> panel_ = open_panel();
  PointerQueue pointers_;
  PointerState pointer_;
  Save save_;
  std::vector<InputEvent> events_;
  Scene scene_;
  Area canvas_area_;
  bool pressed_ = false;    // the pointer was down in the last frame
  bool on_canvas_ = false;  // and went down there
  bool quit_ = false, asking_ = false, swimming_ = false;
  std::optional<int> harmonics_;  // chosen, and set when the slider is let go: proposing takes its time
  std::string message_;           // of the last save, until the next change
  uint64_t message_revision_ = 0;
  std::unique_ptr<TestSwim> swim_;
  RiggedCharacter worn_;
  std::optional<uint64_t> worn_revision_;
};

}  // namespace nt
