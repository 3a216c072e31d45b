// SPDX-License-Identifier: Apache-2.0
#include "app/ui/backdrop.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/support/temp_dir.h"

namespace nt {
namespace {

CaptureOptions tank() {
  CaptureOptions options;
  options.camera = parse_camera_spec("sim:scene=calm,seed=1,size=320x180,frames=120");
  options.background = parse_background("vibe");
  return options;
}

TEST(Backdrop, WhatAUserMaySay) {
  const TempDir dir;
  cv::imwrite(dir / "sea.png", cv::Mat(10, 10, CV_8UC3, cv::Scalar(9, 9, 9)));
  EXPECT_EQ(parse_backdrop("camera").kind, BackdropOption::Kind::camera);
  EXPECT_EQ(parse_backdrop("#00ff00").kind, BackdropOption::Kind::colour);
  EXPECT_FLOAT_EQ(parse_backdrop("#00ff00").colour.g, 1);
  EXPECT_EQ(parse_backdrop(dir / "sea.png").path, dir / "sea.png");
  for (const std::string wrong : {"red", "#00ff0", "#gg0000", "", "/no/such.png"}) {
    try {
      parse_backdrop(wrong);
      ADD_FAILURE() << wrong;
    } catch (const UserError& error) {
      EXPECT_EQ(error.exit_code, 2);
    }
  }
}

TEST(Backdrop, APictureIsCutToThePanesShape) {
  const TempDir dir;
  cv::Mat wide(100, 400, CV_8UC3, cv::Scalar(0, 0, 255));  // red, with blue ends that do not fit
  wide.colRange(0, 90).setTo(cv::Scalar(255, 0, 0));
  wide.colRange(310, 400).setTo(cv::Scalar(255, 0, 0));
  cv::imwrite(dir / "wide.png", wide);
  Session session(tank());
  const Pane pane = beside(pane_for(320, 180));
  const Backdrop backdrop(parse_backdrop(dir / "wide.png"), pane, session);
  Scene scene;
  scene.clear(2 * pane.width, pane.height, backdrop.colour());
  backdrop.draw(scene);
  ASSERT_EQ(scene.items().size(), 1u);
  const SceneItem& item = scene.items()[0];
  EXPECT_EQ(item.at.x, pane.corner.x);
  EXPECT_EQ(item.picture.width, pane.width);
  EXPECT_EQ(item.picture.height, pane.height);
  for (const int x : {5, pane.width / 2, pane.width - 6}) {
    EXPECT_EQ(item.picture.pixels[x * 3], 255) << x;
    EXPECT_EQ(item.picture.pixels[x * 3 + 2], 0) << x;
  }
}

TEST(Backdrop, ABrokenPictureIsOneLine) {
  const TempDir dir;
  cv::imwrite(dir / "x.png", cv::Mat(10, 10, CV_8UC1, cv::Scalar(9)));
  std::filesystem::resize_file(dir / "x.png", 20);
  Session session(tank());
  EXPECT_THROW(Backdrop(parse_backdrop(dir / "x.png"), pane_for(320, 180), session), UserError);
}

// Where the fish is, the camera's picture is painted over with the ground: the tank without its fish is nearly the same.
TEST(Backdrop, TheCamerasPictureHasNoFish) {
  Session session(tank());
  Backdrop backdrop({BackdropOption::Kind::camera, kWater, ""}, pane_for(320, 180), session);
  Observer observer;
  ASSERT_TRUE(session.step());
  const Picture first = session.camera().picture();  // the fish is not there yet
  const std::vector<uint8_t> empty(first.pixels,
                                   first.pixels + static_cast<std::ptrdiff_t>(first.stride) * first.height);
  double with = 0, without = 0;
  int poses = 0;
  do {
    backdrop.update(observer.look(session, true, true));
    if (session.report().status != PoseStatus::ok) continue;
    ++poses;
    Scene scene;
    scene.clear(640, 360, kWater);
    backdrop.draw(scene);
    const uint8_t* shown = scene.items()[0].picture.pixels;
    const Picture camera = session.camera().picture();
    for (const Vec2 p : session.capture().contour()) {  // the fish's rim, and 4 pixels inwards
      const Vec2 at = lerp(p, session.capture().pose().centre, 0.15f);
      const auto i = static_cast<std::size_t>(static_cast<int>(at.y) * camera.stride + 3 * static_cast<int>(at.x));
      with += std::abs(camera.pixels[i] - empty[i]);
      without += std::abs(shown[i] - empty[i]);
    }
  } while (session.step());
  EXPECT_GT(poses, 50);
  EXPECT_LT(without, 0.15 * with) << without << " of " << with;
}

}  // namespace
}  // namespace nt
