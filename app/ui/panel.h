// SPDX-License-Identifier: Apache-2.0
// Buttons, switches and sliders over a scene, by Dear ImGui: large enough for fingers, the same with mouse and touch.
//
// One Panel a window. Between begin() and end() widgets are placed by area, scene pixels; draw() paints them in the callback
// of Display::draw_over. Widgets return what the user did in this frame. Nothing needs hovering, a keyboard or scrolling.
// Sizes follow `unit`: the height of a button, scene pixels; text has the size that fits it.
// Font: DejaVu Sans where Debian has it (fonts-dejavu-core), else the one inside Dear ImGui.
// A GLES 3.0 context must be current in the constructor, begin(), draw() and the destructor.
#pragma once
#include <initializer_list>
#include <string>

#include "app/character_edit/figure_view.h"
#include "app/ui/pointer.h"
#include "core/scene/scene.h"

namespace nt {

class Panel {
 public:
  Panel();
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  void begin(int width, int height, float dt_s, const PointerState& pointer, float unit);
  void end();
  void draw() const;

  void fill(const Area& area, Colour colour, float rounding = 0);
  void dot(Vec2 at, float diameter, Colour colour, Colour rim);
  enum class Align : uint8_t { left, middle };
  void text(const Area& area, const std::string& words, Colour colour, Align align = Align::left);
  // Words on a small plate at a point, kept inside `within`.
  void tag(Vec2 at, const std::string& words, const Area& within);
  enum class Look : uint8_t { plain, on, main, off };  // off: cannot be pressed
  bool button(const Area& area, const std::string& words, Look look = Look::plain);
  // Buttons side by side, one of them on; the one that was pressed, or -1.
  int choice(const Area& area, std::initializer_list<const char*> words, int on);
  // [-] a slider with the words and the value [+]; true when the value has changed.
  bool number(const Area& area, const char* words, int& value, int least, int most);

 private:
  void build_font(float pixels);
  float unit_ = 0;
  bool own_font_ = false;  // DejaVu Sans
};

}  // namespace nt
