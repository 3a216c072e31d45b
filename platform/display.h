// SPDX-License-Identifier: Apache-2.0
// Where scenes go: a window, or an off-screen picture. The scene is drawn by the same renderer in both.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace nt {

struct InputEvent {
  enum class Kind : uint8_t { quit, key, click } kind = Kind::quit;
  int key = 0;  // lower-case ASCII, or 27 for escape
  Vec2 at;      // click: scene pixels
};

class Display {
 public:
  virtual ~Display() = default;
  virtual std::string name() const = 0;      // "SDL2 window (x11)", "EGL surfaceless"
  virtual std::string renderer() const = 0;  // GL_RENDERER and version
  virtual void draw(const Scene& scene) = 0;
  // The picture last drawn: rgb8, rows top down, canvas size. Headless display only; empty in a window.
  virtual std::span<const uint8_t> pixels() { return {}; }
  virtual void poll(std::vector<InputEvent>& events) { events.clear(); }
};

// Both throw UserError with one line when there is no display / no GLES 3.
std::unique_ptr<Display> open_headless_display(int width, int height);
std::unique_ptr<Display> open_sdl_display(const std::string& title, int width, int height);

}  // namespace nt
