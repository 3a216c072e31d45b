// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/platform/test_scene.h"

namespace nt {
namespace {

bool mesa_is_installed() {
  void* library = dlopen("libEGL_mesa.so.0", RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) dlclose(library);
  return library != nullptr;
}

std::unique_ptr<Display> open_or_null(int width, int height) {
  try {
    return open_headless_display(width, height);
  } catch (const UserError& error) {
    // Only a machine without Mesa may skip: where it is installed the display must open.
    EXPECT_FALSE(mesa_is_installed()) << error.what();
    return nullptr;
  }
}

TEST(HeadlessDisplay, DrawsTheSceneTopDown) {
  const auto display = open_or_null(kTestWidth, kTestHeight);
  if (!display) GTEST_SKIP() << "no EGL";
  const TestScene test;
  display->draw(test.scene);
  const auto shot = display->pixels();
  ASSERT_EQ(shot.size(), static_cast<std::size_t>(kTestWidth * kTestHeight * 3));
  const auto at = [&](int x, int y) { return pixel(shot, kTestWidth, x, y); };
  EXPECT_TRUE(near_colour(at(2, 2), {0, 0, 0}));
  EXPECT_TRUE(near_colour(at(37, 37), {255, 255, 255}));
  EXPECT_TRUE(near_colour(at(93, 40), {255, 0, 0}));
  EXPECT_TRUE(near_colour(at(126, 40), {0, 255, 0}));
  EXPECT_TRUE(near_colour(at(15, 90), {255, 255, 255}));
  EXPECT_TRUE(near_colour(at(120, 90), {0, 0, 255}));
  EXPECT_TRUE(near_colour(at(60, 60), {153, 153, 26}));
  EXPECT_TRUE(near_colour(at(150, 110), {51, 51, 51}));
}

TEST(HeadlessDisplay, TwoAtOnceDoNotDisturbEachOther) {
  const auto first = open_or_null(16, 16);
  auto second = open_or_null(8, 8);
  if (!first || !second) GTEST_SKIP() << "no EGL";
  Scene red, green;
  red.clear(16, 16, {1, 0, 0, 1});
  green.clear(8, 8, {0, 1, 0, 1});
  first->draw(red);
  second->draw(green);
  EXPECT_TRUE(near_colour(pixel(first->pixels(), 16, 8, 8), {255, 0, 0}));
  EXPECT_TRUE(near_colour(pixel(second->pixels(), 8, 4, 4), {0, 255, 0}));
  second.reset();
  first->draw(green);
  EXPECT_TRUE(near_colour(pixel(first->pixels(), 16, 8, 8), {0, 255, 0}));
  EXPECT_NE(first->renderer().find("OpenGL ES 3"), std::string::npos) << first->renderer();
}

TEST(HeadlessDisplay, RefusesSizesThatCannotBe) {
  EXPECT_THROW(open_headless_display(0, 10), UserError);
  if (!open_or_null(8, 8)) GTEST_SKIP() << "no EGL";
  EXPECT_THROW(open_headless_display(1 << 20, 1 << 20), UserError);
}

// A fresh process, because EGL looks for its drivers once.
[[noreturn]] void open_with(const char* variable) {
  setenv(variable, "/nonexistent", 1);
  try {
    open_headless_display(16, 16);
  } catch (const UserError& error) {
    std::cerr << error.what() << std::endl;
    std::_Exit(error.exit_code);
  }
  std::_Exit(0);
}

TEST(HeadlessDisplayDeathTest, SaysInOneLineWhatIsMissing) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(open_with("__EGL_VENDOR_LIBRARY_FILENAMES"), ::testing::ExitedWithCode(1),
              "^no off-screen display: .*; install Mesa: apt install libegl-mesa0 libgl1-mesa-dri\n$");
}

}  // namespace
}  // namespace nt
