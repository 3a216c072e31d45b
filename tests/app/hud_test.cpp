// SPDX-License-Identifier: Apache-2.0
#include "app/ui/hud.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "platform/camera.h"

namespace nt {
namespace {

int images(const Hud& hud) {
  Scene scene;
  scene.clear(640, 360, {});
  hud.draw(scene);
  return static_cast<int>(scene.items().size());
}

TEST(Hud, EmptyTextHidesItAndTheKeyToo) {
  const Statistics statistics;
  Hud none("");
  EXPECT_FALSE(none.due(1'000'000'000));
  EXPECT_EQ(images(none), 0);
  Hud hud(kDefaultInfo);
  ASSERT_TRUE(hud.due(1'000'000'000));
  hud.update(1'000'000'000, statistics, {"", "carp", "q quit"});
  EXPECT_EQ(images(hud), 1);
  hud.toggle();
  EXPECT_EQ(images(hud), 0);
  hud.toggle();
  EXPECT_EQ(images(hud), 1);
}

TEST(Hud, RenewsTwiceASecondOrAtOnce) {
  Hud hud("%frame");
  hud.update(1'000'000'000, Statistics{}, {});
  EXPECT_FALSE(hud.due(1'400'000'000));
  EXPECT_TRUE(hud.due(1'600'000'000));
  hud.renew();
  EXPECT_TRUE(hud.due(1'000'000'001));
}

TEST(Hud, LinesSitAtTheLowerEdge) {
  const auto top = [](const char* text) {
    Hud hud(text);
    hud.update(1, Statistics{}, {});
    Scene scene;
    scene.clear(640, 360, {});
    hud.draw(scene);
    return scene.items()[0].at.y;
  };
  EXPECT_FLOAT_EQ(top("one") - top("one\\ntwo\\nthree"), 40);
  EXPECT_GT(top("%frame"), 320);
}

TEST(Hud, TheLatencyIsTheMediansOfBoth) {
  Statistics statistics;
  TimeHistogram to_picture;
  EXPECT_EQ(latency_text(statistics, nullptr), "0.0 ms to the pose, 0.0 to the picture");
  for (int i = 0; i < 3; ++i) statistics.latency.add(5'000'000), to_picture.add(16'000'000);
  double pose_ms = 0, picture_ms = 0;  // to 2.2 %
  ASSERT_EQ(std::sscanf(latency_text(statistics, &to_picture).c_str(), "%lf ms to the pose, %lf to the picture",
                        &pose_ms, &picture_ms),
            2);
  EXPECT_NEAR(pose_ms, 5, 0.2);
  EXPECT_NEAR(picture_ms, 16, 0.5);
}

TEST(Hud, UnknownNamesAreRefused) {
  EXPECT_NO_THROW(check_info_text(kDefaultInfo));
  EXPECT_NO_THROW(check_info_text("no names"));
  for (const char* wrong : {"%speed", "100 %", "%fps %"}) {
    try {
      check_info_text(wrong);
      ADD_FAILURE() << wrong;
    } catch (const UserError& error) {
      EXPECT_EQ(error.exit_code, 2);
      EXPECT_NE(std::string(error.what()).find("%times"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace nt
