// SPDX-License-Identifier: Apache-2.0
// Displays come with libneontetra_display.so when the first one is asked for: a capture goes without SDL and EGL.
#include "platform/display.h"
#include "platform/late_module.h"

namespace nt {
namespace {

void* display_function(const char* name) {
  static const LateModule module("libneontetra_display.so", "which shows and draws pictures");
  return module.function(name);
}

}  // namespace

std::unique_ptr<Display> open_headless_display(int width, int height) {
  using Open = void (*)(int, int, std::unique_ptr<Display>&);
  static const auto open = reinterpret_cast<Open>(display_function("neontetra_open_headless_display"));
  std::unique_ptr<Display> display;
  open(width, height, display);
  return display;
}

std::unique_ptr<Display> open_sdl_display(const std::string& title, int width, int height,
                                          const WindowSettings& settings) {
  using Open = void (*)(const std::string&, int, int, const WindowSettings&, std::unique_ptr<Display>&);
  static const auto open = reinterpret_cast<Open>(display_function("neontetra_open_sdl_display"));
  std::unique_ptr<Display> display;
  open(title, width, height, settings, display);
  return display;
}

}  // namespace nt
