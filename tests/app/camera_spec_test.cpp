// SPDX-License-Identifier: Apache-2.0
#include "app/camera_spec.h"

#include <gtest/gtest.h>

namespace nt {
namespace {

// The error that a SPEC gives; fails the test when it gives none.
UserError error_of(const std::string& text) {
  try {
    (void)parse_camera_spec(text);
  } catch (const UserError& error) {
    return error;
  }
  ADD_FAILURE() << text << " was accepted";
  return UserError("");
}

bool says(const UserError& error, const std::string& part) {
  return std::string(error.what()).find(part) != std::string::npos;
}

TEST(CameraSpec, TankIs960x544At30UnlessToldOtherwise) {
  const CameraSpec spec = parse_camera_spec("sim");
  EXPECT_EQ(spec.kind, CameraSpec::Kind::sim);
  EXPECT_EQ(spec.tank.width, 960);
  EXPECT_EQ(spec.tank.height, 544);
  EXPECT_EQ(spec.tank.fps, 30);
  EXPECT_EQ(spec.frames, -1);
}

TEST(CameraSpec, ReadsEveryKeyOfTheTank) {
  const std::string scene = tank_scene_names().back();
  const CameraSpec spec = parse_camera_spec("sim:scene=" + scene + ",seed=7,size=640x360,fps=12.5,frames=40");
  EXPECT_EQ(spec.tank.scene, scene);
  EXPECT_EQ(spec.tank.seed, 7u);
  EXPECT_EQ(spec.tank.width, 640);
  EXPECT_EQ(spec.tank.height, 360);
  EXPECT_EQ(spec.tank.fps, 12.5);
  EXPECT_EQ(spec.frames, 40);
}

TEST(CameraSpec, FilesWithAndWithoutTheirPrefix) {
  EXPECT_EQ(parse_camera_spec("file:no/such.avi").path, "no/such.avi");
  const CameraSpec bare = parse_camera_spec(NEONTETRA_BINARY);
  EXPECT_EQ(bare.kind, CameraSpec::Kind::file);
  EXPECT_EQ(bare.path, NEONTETRA_BINARY);
}

TEST(CameraSpec, NamesTheNearestKeySceneAndKind) {
  EXPECT_TRUE(says(error_of("sim:sede=3"), "did you mean 'seed'"));
  EXPECT_TRUE(says(error_of("sim:scene=clam"), "did you mean 'calm'"));
  EXPECT_TRUE(says(error_of("smi:seed=3"), "did you mean 'sim'"));
  for (const char* text : {"sim:sede=3", "sim:scene=clam", "smi:seed=3", "sim:seed", "webcam:0"}) {
    EXPECT_EQ(error_of(text).exit_code, 2) << text;
  }
}

TEST(CameraSpec, SaysWhatNumbersAreAllowed) {
  EXPECT_TRUE(says(error_of("sim:frames=many"), "whole number from 1"));
  EXPECT_TRUE(says(error_of("sim:frames=0"), "whole number from 1"));
  EXPECT_TRUE(says(error_of("sim:fps=-3"), "from 1 to 1000"));
  EXPECT_TRUE(says(error_of("sim:fps=nan"), "from 1 to 1000"));
  EXPECT_TRUE(says(error_of("sim:size=960"), "960x544"));
  EXPECT_TRUE(says(error_of("sim:size=0x544"), "whole number from 1"));
}

TEST(CameraSpec, ReadsEveryKeyOfAV4l2Camera) {
  const CameraSpec spec =
      parse_camera_spec("v4l2:/dev/video2,size=1280x720,fps=25,format=mjpeg,lock=off,mains=50,wait=3");
  EXPECT_EQ(spec.kind, CameraSpec::Kind::v4l2);
  EXPECT_EQ(spec.v4l2.path, "/dev/video2");
  EXPECT_EQ(spec.v4l2.wish.width, 1280);
  EXPECT_EQ(spec.v4l2.wish.height, 720);
  EXPECT_EQ(spec.v4l2.wish.fps, 25);
  EXPECT_EQ(spec.v4l2.wish.format, VideoFormat::mjpeg);
  EXPECT_FALSE(spec.v4l2.lock);
  EXPECT_EQ(spec.v4l2.mains, Mains::hz50);
  EXPECT_EQ(spec.v4l2.wait_s, 3);
  EXPECT_EQ(parse_camera_spec("/dev/video3").v4l2.path, "/dev/video3");
  EXPECT_EQ(parse_camera_spec("v4l2").v4l2.path, "/dev/video0");
  EXPECT_TRUE(parse_camera_spec("v4l2").v4l2.lock);
  EXPECT_TRUE(says(error_of("v4l2:/dev/video0,format=yuv"), "did you mean 'yuyv'"));
  EXPECT_TRUE(says(error_of("v4l2:/dev/video0,sise=3x4"), "did you mean 'size'"));
  EXPECT_TRUE(says(error_of("v4l2:/dev/video0,lock=maybe"), "unknown 'maybe'"));
  EXPECT_EQ(error_of("v4l2:/dev/video0,mains=55").exit_code, 2);
}

TEST(CameraSpec, ACameraThatIsNotThereIsNoCamera) {
  try {
    (void)open_camera(parse_camera_spec("v4l2:/dev/video99"), std::nullopt, 0);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.exit_code, 3);
    EXPECT_TRUE(says(error, "/dev/video99: opening the camera failed (open: No such file or directory)"));
  }
}

TEST(CameraSpec, AMissingBareFileIsNoCamera) { EXPECT_EQ(error_of("no/such/clip.avi").exit_code, 3); }

TEST(CameraSpec, AnEmptyPathAndAKeyGivenTwiceAreMistakes) {
  EXPECT_TRUE(says(error_of("file:"), "path is missing"));
  EXPECT_TRUE(says(error_of("sim:seed=1,size=640x360,seed=1"), "'seed' is given twice"));
  EXPECT_EQ(error_of("file:").exit_code, 2);
  EXPECT_EQ(error_of("sim:seed=1,seed=2").exit_code, 2);
}

TEST(CameraSpec, ATankLargerThanTheWorkingSizeIsShrunkAsAFileIs) {
  const auto size_of = [](const char* spec, std::optional<Size> work) {
    const CameraInfo info = open_camera(parse_camera_spec(spec), work, 0)->info();
    return std::to_string(info.source_width) + "x" + std::to_string(info.source_height) + " at " +
           std::to_string(info.width) + "x" + std::to_string(info.height);
  };
  EXPECT_EQ(size_of("sim", std::nullopt), "960x544 at 960x544");
  EXPECT_EQ(size_of("sim:size=1920x1088", std::nullopt), "1920x1088 at 960x544");
  EXPECT_EQ(size_of("sim:size=640x480", Size{320, 320}), "640x480 at 320x240");
  EXPECT_EQ(size_of("sim:size=320x240", Size{640, 480}), "320x240 at 320x240");
  EXPECT_THROW(size_of("sim", Size{8, 8}), UserError);
}

}  // namespace
}  // namespace nt
