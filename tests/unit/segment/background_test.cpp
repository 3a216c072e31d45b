// SPDX-License-Identifier: Apache-2.0
#include "core/segment/background.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/block.h"

namespace nt {
namespace {

constexpr struct {
  BackgroundKind kind;
  const char* name;
} kModels[] = {{BackgroundKind::vibe, "vibe"}, {BackgroundKind::still, "still"}, {BackgroundKind::backlit, "backlit"}};

Result<Background*> create(Arena& arena, BackgroundKind kind, int width, int height) {
  Limits limits;
  limits.max_width = 100, limits.max_height = 60;
  return Background::create(arena, limits, {kind, 0}, width, height, 1);
}

TEST(Background, EachKindIsMadeInExactlyTheMemoryItAsksFor) {
  for (const auto& model : kModels) {
    Arena measure;
    EXPECT_TRUE(create(measure, model.kind, 99, 60).ok());
    const test::Block block(measure.used());
    Arena arena(block.span());
    const auto made = create(arena, model.kind, 99, 60);
    ASSERT_TRUE(made.ok()) << model.name;
    EXPECT_STREQ(made.value()->name(), model.name);
    Arena less(block.span().first(measure.used() - 1));
    EXPECT_EQ(create(less, model.kind, 99, 60).status().code, StatusCode::out_of_memory) << model.name;
  }
}

TEST(Background, FramesThatDoNotFitAreRefusedByName) {
  for (const auto& model : kModels) {
    const test::Block block(1 << 20);
    const int sizes[][2] = {{101, 60}, {100, 61}, {0, 10}, {10, 0}, {-1, 10}};
    for (const auto& size : sizes) {
      Arena arena(block.span());
      const auto made = create(arena, model.kind, size[0], size[1]);
      EXPECT_EQ(made.status().code, StatusCode::bad_argument);
      EXPECT_NE(std::strstr(made.status().message, "max_width"), nullptr);
    }
  }
}

}  // namespace
}  // namespace nt
