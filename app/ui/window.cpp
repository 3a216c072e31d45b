// SPDX-License-Identifier: Apache-2.0
#include "app/ui/window.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "platform/camera.h"

namespace nt {

std::unique_ptr<Display> open_window(const std::string& title, int width, int height, WindowMode mode) {
  // libwayland, which SDL asks first, complains on stderr when this is not set.
  ::setenv("XDG_RUNTIME_DIR", "/nonexistent", 0);
  std::unique_ptr<Display> display = open_sdl_display(title, width, height, mode);
  const std::string name = display->name();
  const bool unseen = name.find("offscreen") != std::string::npos || name.find("dummy") != std::string::npos;
  if (unseen && std::getenv("SDL_VIDEODRIVER") == nullptr) {
    throw UserError(
        "no window: there is no display; start from a desktop session or a text console, or make a video "
        "with 'neontetra animate'");
  }
  return display;
}

void add_window_options(CLI::App& command, std::string& size, bool& full_screen) {
  command.add_option("--window-size", size, "of the window (default " + size + ")")->type_name("WxH");
  command.add_flag("--fullscreen", full_screen, "on the whole screen, as on one of 800x480");
}

}  // namespace nt
