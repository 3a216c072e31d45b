// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/half_chroma.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "platform/sim/sim_camera.h"

namespace nt {
namespace {

TEST(HalfChroma, GreyIs128AndColourIsBt601InEitherOrder) {
  cv::Mat rgb(5, 7, CV_8UC3, cv::Scalar::all(77));
  rgb(cv::Rect(2, 2, 2, 2)).setTo(cv::Scalar(200, 100, 50));
  HalfChroma chroma;
  for (const bool is_rgb : {true, false}) {
    if (!is_rgb) {
      cv::Mat bgr;
      const int order[] = {0, 2, 1, 1, 2, 0};
      bgr.create(rgb.size(), rgb.type());
      cv::mixChannels(&rgb, 1, &bgr, 1, order, 3);
      rgb = bgr;
    }
    Frame frame;
    chroma.give(rgb, is_rgb, frame);
    ASSERT_EQ(frame.cb.width, 4);
    ASSERT_EQ(frame.cb.height, 3);
    ASSERT_EQ(frame.cr.width, 4);
    EXPECT_EQ(frame.cb.row(0)[3], 128);
    EXPECT_EQ(frame.cr.row(2)[0], 128);
    // Where blocks do not straddle: 7 x 5 is halved to 4 x 3, so only about.
    EXPECT_LT(frame.cb.row(1)[1], 115);
    EXPECT_GT(frame.cr.row(1)[1], 145);
  }
}

TEST(HalfChroma, TheTankGivesChromaWhenAskedAndItsFishIsAnotherColourThanItsGravel) {
  TankSettings settings;
  settings.scene = "ghost";
  SimCamera camera(settings, 3, 960, 544);
  EXPECT_TRUE(camera.next()->cb.empty());
  camera.give_chroma();
  const Frame frame = *camera.next();
  ASSERT_EQ(frame.cb.width, 480);
  ASSERT_EQ(frame.cb.height, 272);
  const Vec2 at = camera.truth()->pose.centre * 0.5f;
  const int fish = frame.cr.row(static_cast<int>(at.y))[static_cast<int>(at.x)], gravel = frame.cr.row(5)[5];
  EXPECT_GT(fish, gravel + 30);
}

}  // namespace
}  // namespace nt
