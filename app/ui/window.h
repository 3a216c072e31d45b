// SPDX-License-Identifier: Apache-2.0
// Opens a window that somebody can see.
#pragma once
#include <memory>
#include <string>

#include "platform/display.h"

namespace CLI {
class App;
}

namespace nt {

// Throws UserError where there is no display. Without one SDL falls back to drivers that show nothing; these are taken
// only when the user names one (SDL_VIDEODRIVER=offscreen), as tests do.
std::unique_ptr<Display> open_window(const std::string& title, int width, int height,
                                     WindowMode mode = WindowMode::window);

// --window-size and --fullscreen.
void add_window_options(CLI::App& command, std::string& size, bool& full_screen);

}  // namespace nt
