// SPDX-License-Identifier: Apache-2.0
#include "core/segment/field.h"

#include <gtest/gtest.h>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Picture;

float lit(int x, int y) {
  const float u = static_cast<float>(x) / 96 - 1, v = static_cast<float>(y) / 64 - 1;
  return 140 + 20 * u - 15 * v - 25 * u * u + 8 * u * v;
}

TEST(Field, FollowsUnevenLightAndLeavesOutWhatStandsOnIt) {
  Picture p(192, 128);
  Random random(2);
  p.each([](int x, int y, int) { return lit(x, y); }).noise(random, 4).ellipse(90, 60, 40, 12, 20);
  const FieldSurface surface = fit_field(p.luma());
  for (int y = 4; y < 124; y += 12) {
    uint8_t row[192];
    surface.draw(0, y, 192, row);
    for (int x = 4; x < 188; x += 12) EXPECT_NEAR(row[x], lit(x, y), 4) << x << " " << y;
  }
  const FieldResiduals found = measure_field(p.luma(), surface);
  EXPECT_NEAR(found.sigma, 4.5f, 1.0f);
  EXPECT_NEAR(found.median_level, 135, 6);
}

TEST(Field, APartOfARowIsThatPartOfTheRow) {
  Picture p(100, 40);
  p.each([](int x, int y, int) { return x + y; });
  const FieldSurface surface = fit_field(p.luma());
  uint8_t row[100], part[30];
  surface.draw(0, 17, 100, row);
  surface.draw(40, 17, 30, part);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(part[i], row[40 + i]);
}

}  // namespace
}  // namespace nt
