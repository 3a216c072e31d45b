// SPDX-License-Identifier: Apache-2.0
// What libneontetra_display.so hands out; platform/linux/late_display.cpp asks for it.
#include "platform/display.h"

extern "C" __attribute__((visibility("default"))) void neontetra_open_headless_display(
    int width, int height, std::unique_ptr<nt::Display>& display) {
  display = nt::open_headless_display(width, height);
}

extern "C" __attribute__((visibility("default"))) void neontetra_open_sdl_display(
    const std::string& title, int width, int height, const nt::WindowSettings& settings,
    std::unique_ptr<nt::Display>& display) {
  display = nt::open_sdl_display(title, width, height, settings);
}
