// SPDX-License-Identifier: Apache-2.0
// Where scenes go: a window, a screen without a desktop, an off-screen picture, or nowhere. What is drawn is drawn by the same
// renderer (OpenGL ES 3.0) in all.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace nt {

// Keys beyond ASCII, in InputEvent::key.
enum KeyCode : int { kKeyLeft = 256, kKeyRight, kKeyUp, kKeyDown };

struct InputEvent {
  // click: the left button or a finger goes down on the canvas; move and release: anywhere, also beside it
  enum class Kind : uint8_t { quit, key, click, move, release } kind = Kind::quit;
  int key = 0;  // lower-case ASCII, 27 for escape, or a KeyCode
  bool ctrl = false, shift = false;
  Vec2 at;                // click, move, release: scene pixels
  bool finger = false;    // not the mouse
  int64_t finger_id = 0;  // which finger
};

struct DisplaySize {
  int width = 0, height = 0;  // pixels
};

// window: X11 or Wayland; kms: a whole screen without a desktop; egl: an off-screen picture; null: nothing is drawn.
// automatic: a window where there is a desktop, else kms; never what nobody sees.
enum class DisplayKind : uint8_t { automatic, window, kms, egl, null };
const char* to_string(DisplayKind kind);

// large: a window, or the whole screen where that is no larger than the window asked for
enum class WindowMode : uint8_t { window, large, full_screen };

struct WindowSettings {
  WindowMode mode = WindowMode::window;
  DisplayKind kind = DisplayKind::automatic;  // not egl, not null
  int rotation_deg = 0;                       // clockwise, of what a screen shows: 0, 90, 180, 270
};

class Display {
 public:
  virtual ~Display() = default;
  virtual std::string name() const = 0;      // "SDL2 window (x11)", "EGL surfaceless", "null"
  virtual std::string renderer() const = 0;  // GL_RENDERER and version
  virtual DisplaySize size() const = 0;      // as the picture stands, rotation undone
  void draw(const Scene& scene) { draw_over(scene, {}); }
  // `over`, when there is one, draws on with the GL context that is current then, before the picture is shown.
  virtual void draw_over(const Scene& scene, const std::function<void()>& over) = 0;
  // The picture last drawn: rgb8, rows top down, canvas size. Headless display only; empty in a window.
  virtual std::span<const uint8_t> pixels() { return {}; }
  // The same as rgba8, not premultiplied: how much of what lies behind the scene shows through, where its background does.
  virtual std::span<const uint8_t> pixels_with_alpha() { return {}; }
  virtual void poll(std::vector<InputEvent>& events) { events.clear(); }
};

// Throw UserError with one line when there is no display / no GLES 3.
std::unique_ptr<Display> open_headless_display(int width, int height);
std::unique_ptr<Display> open_sdl_display(const std::string& title, int width, int height,
                                          const WindowSettings& settings = {});
// Needs nothing and shows nothing: the rest of the program runs as with any other.
std::unique_ptr<Display> open_null_display(int width, int height);

}  // namespace nt
