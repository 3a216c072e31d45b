// SPDX-License-Identifier: Apache-2.0
// Where scenes go: a window, or an off-screen picture. The scene is drawn by the same renderer in both.
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

// large: a window, or the whole screen where that is no larger than the window asked for
enum class WindowMode : uint8_t { window, large, full_screen };

class Display {
 public:
  virtual ~Display() = default;
  virtual std::string name() const = 0;      // "SDL2 window (x11)", "EGL surfaceless"
  virtual std::string renderer() const = 0;  // GL_RENDERER and version
  virtual DisplaySize size() const = 0;
  void draw(const Scene& scene) { draw_over(scene, {}); }
  // `over`, when there is one, draws on with the GL context that is current then, before the picture is shown.
  virtual void draw_over(const Scene& scene, const std::function<void()>& over) = 0;
  // The picture last drawn: rgb8, rows top down, canvas size. Headless display only; empty in a window.
  virtual std::span<const uint8_t> pixels() { return {}; }
  // The same as rgba8, not premultiplied: how much of what lies behind the scene shows through, where its background does.
  virtual std::span<const uint8_t> pixels_with_alpha() { return {}; }
  virtual void poll(std::vector<InputEvent>& events) { events.clear(); }
};

// Both throw UserError with one line when there is no display / no GLES 3.
std::unique_ptr<Display> open_headless_display(int width, int height);
std::unique_ptr<Display> open_sdl_display(const std::string& title, int width, int height,
                                          WindowMode mode = WindowMode::window);

}  // namespace nt
