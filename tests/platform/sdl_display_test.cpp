// SPDX-License-Identifier: Apache-2.0
// The window, on SDL's driver without a screen: same picture as off-screen, and events in scene pixels.
#include <GLES3/gl3.h>
#include <SDL2/SDL.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/platform/test_scene.h"

namespace nt {
namespace {

class SdlDisplayTest : public ::testing::Test {
 protected:
  void open(int width, int height, int rotation_deg = 0) {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    try {
      display_ = open_sdl_display("test", width, height, {.rotation_deg = rotation_deg});
    } catch (const UserError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  void TearDown() override { unsetenv("SDL_VIDEODRIVER"); }

  static void push_click(int x, int y) {
    SDL_Event event{};
    event.type = SDL_MOUSEBUTTONDOWN;
    event.button.button = SDL_BUTTON_LEFT;
    event.button.x = x;
    event.button.y = y;
    SDL_PushEvent(&event);
  }
  static void push_key(SDL_Keycode key) {
    SDL_Event event{};
    event.type = SDL_KEYDOWN;
    event.key.keysym.sym = key;
    SDL_PushEvent(&event);
  }

  std::unique_ptr<Display> display_;
};

TEST_F(SdlDisplayTest, DrawsWhatTheHeadlessDisplayDraws) {
  open(kTestWidth, kTestHeight);
  if (!display_) return;
  const TestScene test;
  display_->draw(test.scene);
  EXPECT_TRUE(display_->pixels().empty());
  // The offscreen driver's surface is not swapped away: the context that draw() left current still holds the picture.
  std::vector<uint8_t> window(static_cast<std::size_t>(kTestWidth * kTestHeight * 4));
  glReadPixels(0, 0, kTestWidth, kTestHeight, GL_RGBA, GL_UNSIGNED_BYTE, window.data());

  std::unique_ptr<Display> headless;
  try {
    headless = open_headless_display(kTestWidth, kTestHeight);
  } catch (const UserError& error) {
    GTEST_SKIP() << error.what();
  }
  headless->draw(test.scene);
  const auto shot = headless->pixels();
  int different = 0, coloured = 0;
  for (int y = 0; y < kTestHeight; ++y) {
    for (int x = 0; x < kTestWidth; ++x) {
      const Rgb want = pixel(shot, kTestWidth, x, y);
      const std::size_t at = static_cast<std::size_t>((kTestHeight - 1 - y) * kTestWidth + x) * 4;
      different += near_colour({window[at], window[at + 1], window[at + 2]}, want, 1) ? 0 : 1;
      coloured += near_colour(want, {51, 51, 51}, 1) ? 0 : 1;
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(coloured, 3000);
}

TEST_F(SdlDisplayTest, ClicksAreScenePixelsAndBarsAreNotTheScene) {
  open(400, 200);
  if (!display_) return;
  Scene scene;
  scene.clear(50, 50, {});
  display_->draw(scene);  // drawn at scale 4, from x = 100 to 300
  std::vector<InputEvent> events;
  display_->poll(events);
  push_click(50, 100);
  push_click(100, 0);
  push_click(200, 100);
  push_click(310, 100);
  display_->poll(events);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, InputEvent::Kind::click);
  EXPECT_FLOAT_EQ(events[0].at.x, 0);
  EXPECT_FLOAT_EQ(events[0].at.y, 0);
  EXPECT_FLOAT_EQ(events[1].at.x, 25);
  EXPECT_FLOAT_EQ(events[1].at.y, 25);
}

// A scene of 40x20 with a coloured corner, in a window of that size: where the corner comes to lie, and that a click there is a
// click on the corner.
struct Turn {
  int rotation_deg;
  int corner_x, corner_y;  // on the screen, pixels, y down
};
class TurnedDisplayTest : public SdlDisplayTest, public ::testing::WithParamInterface<Turn> {};

TEST_P(TurnedDisplayTest, ThePictureTurnsClockwiseAndThePointerFollows) {
  const Turn turn = GetParam();
  open(40, 20, turn.rotation_deg);
  if (!display_) return;
  EXPECT_EQ(display_->size().width, 40);
  EXPECT_EQ(display_->size().height, 20);
  Scene scene;
  scene.clear(40, 20, {0, 0, 1, 1});
  const Vec2 corner[] = {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}};
  scene.lines(corner, {1, 0, 0, 1}, 8.0f);
  display_->draw(scene);
  const int height = turn.rotation_deg % 180 == 0 ? 20 : 40;
  uint8_t rgba[4] = {};
  glReadPixels(turn.corner_x, height - 1 - turn.corner_y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
  EXPECT_GT(rgba[0], 200);
  EXPECT_LT(rgba[2], 60);
  std::vector<InputEvent> events;
  display_->poll(events);
  push_click(turn.corner_x, turn.corner_y);
  display_->poll(events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].at.x, 1, 1.01f);
  EXPECT_NEAR(events[0].at.y, 1, 1.01f);
}

INSTANTIATE_TEST_SUITE_P(Turns, TurnedDisplayTest,
                         ::testing::Values(Turn{0, 1, 1}, Turn{90, 18, 1}, Turn{180, 38, 18}, Turn{270, 1, 38}));

TEST(NullDisplayTest, TakesScenesAndShowsNothing) {
  const std::unique_ptr<Display> display = open_null_display(30, 20);
  display->draw(TestScene().scene);
  EXPECT_EQ(display->size().width, 30);
  EXPECT_TRUE(display->pixels().empty());
  EXPECT_THROW(open_null_display(0, 20), UserError);
}

TEST_F(SdlDisplayTest, KeysAndQuit) {
  open(64, 64);
  if (!display_) return;
  std::vector<InputEvent> events;
  display_->poll(events);
  push_key(SDLK_p);
  push_key(SDLK_F5);
  push_key(SDLK_ESCAPE);
  SDL_Event quit{};
  quit.type = SDL_QUIT;
  SDL_PushEvent(&quit);
  display_->poll(events);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].kind, InputEvent::Kind::key);
  EXPECT_EQ(events[0].key, 'p');
  EXPECT_EQ(events[1].key, 27);
  EXPECT_EQ(events[2].kind, InputEvent::Kind::quit);
}

TEST_F(SdlDisplayTest, FingersAreClicksMovesAndReleasesInScenePixels) {
  open(400, 200);
  if (!display_) return;
  Scene scene;
  scene.clear(50, 50, {});
  display_->draw(scene);  // drawn at scale 4, from x = 100 to 300
  std::vector<InputEvent> events;
  display_->poll(events);
  for (const Uint32 type : {SDL_FINGERDOWN, SDL_FINGERMOTION, SDL_FINGERUP}) {
    SDL_Event event{};
    event.type = type;
    event.tfinger.fingerId = 9;
    event.tfinger.x = type == SDL_FINGERUP ? 0.95f : 0.5f, event.tfinger.y = 0.5f;
    SDL_PushEvent(&event);
  }
  display_->poll(events);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].kind, InputEvent::Kind::click);
  EXPECT_EQ(events[1].kind, InputEvent::Kind::move);
  EXPECT_EQ(events[2].kind, InputEvent::Kind::release);
  for (const InputEvent& event : events) {
    EXPECT_TRUE(event.finger);
    EXPECT_EQ(event.finger_id, 9);
  }
  EXPECT_NEAR(events[0].at.x, 25, 0.01f);
  EXPECT_NEAR(events[0].at.y, 25, 0.01f);
  EXPECT_NEAR(events[2].at.x, 70, 0.01f);  // in the bar: a release is told wherever it is
}

TEST_F(SdlDisplayTest, ArrowsAndControlAreTold) {
  open(64, 64);
  if (!display_) return;
  std::vector<InputEvent> events;
  display_->poll(events);
  push_key(SDLK_LEFT);
  SDL_Event undo{};
  undo.type = SDL_KEYDOWN;
  undo.key.keysym.sym = SDLK_z, undo.key.keysym.mod = KMOD_LCTRL;
  SDL_PushEvent(&undo);
  display_->poll(events);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].key, kKeyLeft);
  EXPECT_FALSE(events[0].ctrl);
  EXPECT_EQ(events[1].key, 'z');
  EXPECT_TRUE(events[1].ctrl);
}

TEST_F(SdlDisplayTest, WhatIsDrawnOverTheSceneIsDrawnInItsContext) {
  open(64, 64);
  if (!display_) return;
  Scene scene;
  scene.clear(64, 64, {1, 1, 1, 1});
  display_->draw_over(scene, [] {
    glClearColor(0, 1, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  });
  uint8_t rgba[4] = {};
  glReadPixels(32, 32, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
  EXPECT_EQ(rgba[0], 0);
  EXPECT_EQ(rgba[1], 255);
  EXPECT_EQ(display_->size().width, 64);
}

[[noreturn]] void open_without_display() {
  for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY"}) unsetenv(variable);
  setenv("SDL_VIDEODRIVER", "x11", 1);
  try {
    open_sdl_display("test", 64, 64);
  } catch (const UserError& error) {
    std::cerr << error.what() << std::endl;
    std::_Exit(error.exit_code);
  }
  std::_Exit(0);
}

TEST(SdlDisplayDeathTest, WithoutADisplaySaysSoInOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(open_without_display(), ::testing::ExitedWithCode(1), "^no window: there is no display [^\n]*\n$");
}

}  // namespace
}  // namespace nt
