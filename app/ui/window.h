// SPDX-License-Identifier: Apache-2.0
// Opens the display that is wished for, by default a window or screen that somebody can see.
#pragma once
#include <memory>
#include <string>

#include "platform/display.h"

namespace CLI {
class App;
}

namespace nt {

struct DisplayOptions {
  DisplayKind kind = DisplayKind::automatic;
  int rotation_deg = 0;  // clockwise
  bool full_screen = false;
};
// --display, --rotation and --fullscreen. `unseen`: egl and null are offered too.
void add_display_options(CLI::App& command, DisplayOptions& options, bool unseen);
// The same and --window-size, for windows with buttons.
void add_window_options(CLI::App& command, std::string& size, DisplayOptions& options);

// Throws UserError where there is no such display. Without a screen SDL falls back to drivers that show nothing; these are
// taken only when the user names one (SDL_VIDEODRIVER=offscreen), as tests do. `mode` holds unless the whole screen is wished for.
std::unique_ptr<Display> find_display(const std::string& title, int width, int height, const DisplayOptions& options,
                                      WindowMode mode = WindowMode::window);
// The same, and says on standard error which display that is.
std::unique_ptr<Display> open_window(const std::string& title, int width, int height,
                                     const DisplayOptions& options = {}, WindowMode mode = WindowMode::window);

}  // namespace nt
