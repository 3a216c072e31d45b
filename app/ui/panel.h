// SPDX-License-Identifier: Apache-2.0
// Buttons, switches and sliders over a scene, by Dear ImGui: large enough for fingers, the same with mouse and touch.
//
// One Panel a window. Between begin() and end() widgets are placed by area, scene pixels; draw() paints them in the callback
// of Display::draw_over. Widgets return what the user did in this frame. Nothing needs hovering, a keyboard or scrolling.
// Sizes follow `unit`: the height of a button, scene pixels; text has the size that fits it.
// Font: DejaVu Sans where Debian has it (fonts-dejavu-core), else the one inside Dear ImGui.
// A GLES 3.0 context must be current in open_panel(), begin(), draw() and the destructor.
// Dear ImGui is linked into libneontetra_panel.so alone (app/panel), which open_panel() loads.
#pragma once
#include <initializer_list>
#include <memory>
#include <string>

#include "app/character_edit/figure_view.h"
#include "app/ui/pointer.h"
#include "core/scene/scene.h"

namespace nt {

class Panel {
 public:
  virtual ~Panel() = default;

  virtual void begin(int width, int height, float dt_s, const PointerState& pointer, float unit) = 0;
  virtual void end() = 0;
  virtual void draw() const = 0;

  virtual void fill(const Area& area, Colour colour, float rounding = 0) = 0;
  virtual void dot(Vec2 at, float diameter, Colour colour, Colour rim) = 0;
  enum class Align : uint8_t { left, middle };
  virtual void text(const Area& area, const std::string& words, Colour colour, Align align = Align::left) = 0;
  // Words on a small plate at a point, kept inside `within`.
  virtual void tag(Vec2 at, const std::string& words, const Area& within) = 0;
  enum class Look : uint8_t { plain, on, main, off };  // off: cannot be pressed
  virtual bool button(const Area& area, const std::string& words, Look look = Look::plain) = 0;
  // [-] a slider with the words and the value [+]; true when the value has changed.
  virtual bool number(const Area& area, const char* words, int& value, int least, int most) = 0;
  // Buttons side by side, one of them on; the one that was pressed, or -1.
  int choice(const Area& area, std::initializer_list<const char*> words, int on);
};

// Throws UserError where the module is missing.
std::unique_ptr<Panel> open_panel();

}  // namespace nt
