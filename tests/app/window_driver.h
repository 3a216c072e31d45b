// SPDX-License-Identifier: Apache-2.0
// An editor's window on SDL's driver without a screen, driven by SDL's own mouse, finger and key events.
#pragma once
#include <GLES3/gl3.h>
#include <SDL2/SDL.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <vector>

#include "app/ui/editor_window.h"
#include "platform/camera.h"

namespace nt::test {

class WindowDriver : public ::testing::TestWithParam<DisplaySize> {
 protected:
  // Skips where there is no GLES; else display_ is there, and size_ what it came to.
  void SetUp() override {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    size_ = GetParam();
    try {
      // The offscreen driver has a screen of its own size; the window may not exceed it.
      display_ = open_sdl_display("test", size_.width, size_.height);
    } catch (const UserError& error) {
      GTEST_SKIP() << error.what();
    }
    size_ = display_->size();
  }
  void TearDown() override {
    display_.reset();
    unsetenv("SDL_VIDEODRIVER");
  }
  virtual EditorWindow& shown() = 0;

  bool frames(int count) {
    bool more = true;
    for (int i = 0; i < count; ++i) more = shown().frame(1.0f / 60);
    return more;
  }
  void mouse(Uint32 type, Vec2 at) {
    SDL_Event event{};
    event.type = type;
    if (type == SDL_MOUSEMOTION) {
      event.motion.x = static_cast<int>(at.x), event.motion.y = static_cast<int>(at.y);
    } else {
      event.button.button = SDL_BUTTON_LEFT;
      event.button.x = static_cast<int>(at.x), event.button.y = static_cast<int>(at.y);
    }
    SDL_PushEvent(&event);
  }
  void finger(Uint32 type, Vec2 at, SDL_FingerID which = 5) {
    SDL_Event event{};
    event.type = type;
    event.tfinger.fingerId = which;
    event.tfinger.x = at.x / static_cast<float>(size_.width), event.tfinger.y = at.y / static_cast<float>(size_.height);
    SDL_PushEvent(&event);
  }
  void key(SDL_Keycode code, Uint16 mod = 0) {
    press_key(code, mod);
    frames(2);
  }
  void press_key(SDL_Keycode code, Uint16 mod = 0) {
    SDL_Event event{};
    event.type = SDL_KEYDOWN;
    event.key.keysym.sym = code, event.key.keysym.mod = mod;
    SDL_PushEvent(&event);
  }
  void tap(Vec2 at) {
    finger(SDL_FINGERDOWN, at);
    finger(SDL_FINGERUP, at);
    frames(6);
  }
  // Without the release where `let_go` is false.
  void drag(Vec2 from, Vec2 to, bool by_finger, bool let_go = true) {
    const auto go = [&](int phase, Vec2 at) {
      if (by_finger) finger(phase == 0 ? SDL_FINGERDOWN : phase == 1 ? SDL_FINGERMOTION : SDL_FINGERUP, at);
      else mouse(phase == 0 ? SDL_MOUSEBUTTONDOWN : phase == 1 ? SDL_MOUSEMOTION : SDL_MOUSEBUTTONUP, at);
      frames(2);
    };
    if (!by_finger) mouse(SDL_MOUSEMOTION, from), frames(1);
    go(0, from);
    for (int i = 1; i <= 8; ++i) go(1, lerp(from, to, static_cast<float>(i) / 8));
    if (let_go) go(2, to);
    frames(3);
  }
  std::vector<uint8_t> picture() {
    std::vector<uint8_t> rgba(static_cast<std::size_t>(size_.width * size_.height * 4));
    glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return rgba;
  }

  DisplaySize size_;
  std::unique_ptr<Display> display_;
};

inline std::string size_name(const ::testing::TestParamInfo<DisplaySize>& size) {
  return std::to_string(size.param.width);
}

}  // namespace nt::test
