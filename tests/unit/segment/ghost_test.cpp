// SPDX-License-Identifier: Apache-2.0
#include "core/segment/ghost.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/picture.h"

namespace nt {
namespace {

using test::Picture;

const Box kPlace{30, 10, 60, 20};

std::vector<Run> runs_of(const Box& box, int label) {
  std::vector<Run> runs;
  for (int y = box.y0; y < box.y1; ++y)
    runs.push_back({static_cast<int16_t>(y), static_cast<int16_t>(box.x0), static_cast<int16_t>(box.x1), label});
  return runs;
}

Picture with_object(int grey) {
  Picture p(100, 40, 100);
  return p.paint(kPlace, grey);
}

TEST(Ghost, EdgesOfTheBackgroundAloneAreAGhost) {
  const Picture empty(100, 40, 100), object = with_object(60);
  EXPECT_TRUE(is_ghost(empty.luma(), object.luma(), runs_of(kPlace, 0), 0));
  EXPECT_FALSE(is_ghost(object.luma(), empty.luma(), runs_of(kPlace, 0), 0)) << "a real fish";
  EXPECT_FALSE(is_ghost(object.luma(), object.luma(), runs_of(kPlace, 0), 0)) << "edges in both";
  EXPECT_FALSE(is_ghost(empty.luma(), empty.luma(), runs_of(kPlace, 0), 0)) << "no edges at all";
}

TEST(Ghost, FaintEdgesDoNotTell) {
  EXPECT_FALSE(is_ghost(Picture(100, 40, 100).luma(), with_object(90).luma(), runs_of(kPlace, 0), 0));
}

TEST(Ghost, OnlyTheBlobsOwnRunsCount) {
  EXPECT_FALSE(is_ghost(Picture(100, 40, 100).luma(), with_object(60).luma(), runs_of(kPlace, 1), 0));
  EXPECT_FALSE(is_ghost(Picture(100, 40, 100).luma(), with_object(60).luma(), {}, 0));
}

TEST(Ghost, RunsAtTheFramesEdgeReadNothingOutside) {
  const Box all{0, 0, 5, 2};
  EXPECT_FALSE(is_ghost(Picture(5, 2, 0).luma(), Picture(5, 2, 255).luma(), runs_of(all, 0), 0));
  EXPECT_FALSE(is_ghost(Picture(1, 1, 0).luma(), Picture(1, 1, 255).luma(), runs_of({0, 0, 1, 1}, 0), 0));
}

}  // namespace
}  // namespace nt
