// SPDX-License-Identifier: Apache-2.0
#include "app/ui/window.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "platform/camera.h"

namespace nt {

std::unique_ptr<Display> find_display(const std::string& title, int width, int height, const DisplayOptions& options,
                                      WindowMode mode) {
  if (options.kind == DisplayKind::null) return open_null_display(width, height);
  if (options.kind == DisplayKind::egl) return open_headless_display(width, height);
  // libwayland, which SDL asks first, complains on stderr when this is not set.
  ::setenv("XDG_RUNTIME_DIR", "/nonexistent", 0);
  if (options.full_screen) mode = WindowMode::full_screen;
  std::unique_ptr<Display> display = open_sdl_display(title, width, height, {mode, options.kind, options.rotation_deg});
  const std::string name = display->name();
  const bool unseen = name.find("offscreen") != std::string::npos || name.find("dummy") != std::string::npos;
  if (unseen && std::getenv("SDL_VIDEODRIVER") == nullptr) {
    throw UserError(
        "no window: there is no display; start from a desktop session or a text console, or make a video "
        "with 'neontetra animate'");
  }
  return display;
}

std::unique_ptr<Display> open_window(const std::string& title, int width, int height, const DisplayOptions& options,
                                     WindowMode mode) {
  std::unique_ptr<Display> display = find_display(title, width, height, options, mode);
  const DisplaySize size = display->size();
  std::fprintf(stderr, "display: %s, %dx%d, %s\n", display->name().c_str(), size.width, size.height,
               display->renderer().c_str());
  return display;
}

void add_display_options(CLI::App& command, DisplayOptions& options, bool unseen) {
  std::vector<DisplayKind> kinds = {DisplayKind::automatic, DisplayKind::window, DisplayKind::kms};
  if (unseen) kinds.insert(kinds.end(), {DisplayKind::egl, DisplayKind::null});
  std::map<std::string, DisplayKind> by_name;
  std::string names;
  for (const DisplayKind kind : kinds) {
    by_name[to_string(kind)] = kind;
    names += (names.empty() ? "" : "|") + std::string(to_string(kind));
  }
  command
      .add_option_function<std::string>(
          "--display", [&options, by_name](const std::string& name) { options.kind = by_name.at(name); },
          std::string("where it is shown: auto (a window, or without a desktop the screen; default), window (X11, "
                      "Wayland), kms (the screen without a desktop)") +
              (unseen ? ", egl (drawn, not shown), null (not even drawn)" : ""))
      ->type_name(names)
      ->check(CLI::IsMember(by_name));
  command.add_option("--rotation", options.rotation_deg, "turn what the screen shows clockwise, degrees (default 0)")
      ->type_name("0|90|180|270")
      ->check(CLI::IsMember({0, 90, 180, 270}));
  command.add_flag("--fullscreen", options.full_screen, "on the whole screen, as on one of 800x480");
}

void add_window_options(CLI::App& command, std::string& size, DisplayOptions& options) {
  command.add_option("--window-size", size, "of the window (default " + size + ")")->type_name("WxH");
  add_display_options(command, options, false);
}

}  // namespace nt
