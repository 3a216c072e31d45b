// SPDX-License-Identifier: Apache-2.0
#include "app/calibration.h"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "platform/camera.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
const Lens kLens{900, 905, 645, 352, -0.31, 0.12, 0.0011, -0.0007, -0.02};

std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(Calibration, PointsComeOutWhereOpenCvPutsThem) {
  const cv::Mat camera = (cv::Mat_<double>(3, 3) << kLens.fx, 0, kLens.cx, 0, kLens.fy, kLens.cy, 0, 0, 1);
  const std::vector<double> k = {kLens.k1, kLens.k2, kLens.p1, kLens.p2, kLens.k3};
  std::vector<cv::Point2f> seen, ideal;
  for (int y = 0; y < kHeight; y += 45)
    for (int x = 0; x < kWidth; x += 40) seen.emplace_back(static_cast<float>(x), static_cast<float>(y));
  cv::undistortPoints(seen, ideal, camera, k, cv::noArray(), camera, cv::TermCriteria(3, 100, 1e-10));
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec2 ours = kLens.undistorted({seen[i].x, seen[i].y});
    EXPECT_NEAR(ours.x, ideal[i].x, 0.01);
    EXPECT_NEAR(ours.y, ideal[i].y, 0.01);
    EXPECT_LT(length(kLens.distorted(ours) - Vec2{seen[i].x, seen[i].y}), 0.01f);
  }
}

TEST(Calibration, ReadsPlainLinesAndWhatOpenCvWrites) {
  const TempDir dir;
  write_text(dir / "lens.txt", "# phone, 1280x720\nfx 900\nfy: 905\ncx = 645\ncy 352\nk1 -0.31\nk2 0.12\np1 0.0011\n");
  const Lens plain = read_lens(dir / "lens.txt", kWidth, kHeight);
  EXPECT_EQ(plain.fy, 905);
  EXPECT_EQ(plain.cx, 645);
  EXPECT_EQ(plain.k1, -0.31);
  EXPECT_EQ(plain.k3, 0);
  for (const char* name : {"lens.yml", "lens.xml", "lens.json"}) {
    cv::FileStorage storage(dir / name, cv::FileStorage::WRITE);
    storage << "image_width" << kWidth << "image_height" << kHeight;
    storage << "camera_matrix" << cv::Mat(cv::Matx33d(900, 0, 645, 0, 905, 352, 0, 0, 1));
    storage << "distortion_coefficients" << cv::Mat(cv::Matx<double, 5, 1>(-0.31, 0.12, 0.0011, -0.0007, -0.02));
    storage.release();
    const Lens lens = read_lens(dir / name, kWidth, kHeight);
    EXPECT_EQ(lens.fx, 900) << name;
    EXPECT_EQ(lens.p2, -0.0007) << name;
    EXPECT_EQ(lens.k3, -0.02) << name;
  }
}

TEST(Calibration, EachMistakeIsOneClearLine) {
  const TempDir dir;
  const auto error = [&](const std::string& text) {
    write_text(dir / "lens.txt", text);
    return error_of([&] { read_lens(dir / "lens.txt", kWidth, kHeight); });
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(error_of([&] { read_lens(dir / "none.txt", kWidth, kHeight); }), "no such file"));
  EXPECT_TRUE(has(error(""), "fx is missing"));
  EXPECT_TRUE(has(error("fx 900\nfy 900\ncx 1\ncy x\n"), "line 4: 'x' is no number"));
  EXPECT_TRUE(has(error("fx 900\nfyy 900\n"), "did you mean 'fy'"));
  EXPECT_TRUE(has(error("fx 900 901\n"), "one number"));
  EXPECT_TRUE(has(error("fx 0\nfy 900\ncx 1\ncy 1\n"), "above 1 pixel"));
  EXPECT_TRUE(has(error("fx 400\nfy 400\ncx 640\ncy 360\nk1 -0.9\n"), "cannot be undone"));
  EXPECT_TRUE(has(error("%YAML:1.0\n---\nfoo: 1\n"), "camera_matrix"));
  EXPECT_TRUE(has(error("{ broken"), "not a calibration file"));
  cv::FileStorage storage(dir / "other.yml", cv::FileStorage::WRITE);
  storage << "image_width" << 640 << "image_height" << 480;
  storage << "camera_matrix" << cv::Mat(cv::Matx33d(500, 0, 320, 0, 500, 240, 0, 0, 1));
  storage << "distortion_coefficients" << cv::Mat(cv::Mat::zeros(5, 1, CV_64F));
  storage.release();
  EXPECT_TRUE(has(error_of([&] { read_lens(dir / "other.yml", kWidth, kHeight); }), "640x480"));
}

TEST(Calibration, TwoPointsGiveTheScaleOfTheIdealPicture) {
  Calibration plain;
  plain.set_scale(parse_scale_points("100,200,400,600"), 50);
  EXPECT_NEAR(plain.px_per_mm, 10, 1e-5);
  Calibration bent;
  bent.lens = kLens;
  bent.set_scale(parse_scale_points("100,200,400,600"), 50);
  EXPECT_GT(bent.px_per_mm, 10.1) << "a barrel shrinks what is far from the middle";
  for (const char* bad : {"1,2,3", "1,2,3,4,5", "1,2,3,x", "100,100,104,100", "", "-1,0,50,50"})
    EXPECT_NE(error_of([&] { parse_scale_points(bad); }), "") << bad;
}

TEST(Calibration, AMarkersSideGivesTheScaleUnlessItIsSlanted) {
  Calibration calibration;
  calibration.set_scale(std::array<Vec2, 4>{Vec2{10, 10}, Vec2{90, 10}, Vec2{90, 90}, Vec2{10, 90}}, 20);
  EXPECT_NEAR(calibration.px_per_mm, 4, 1e-5);
  EXPECT_NE(error_of([] {
              Calibration slanted;
              slanted.set_scale(std::array<Vec2, 4>{Vec2{10, 10}, Vec2{90, 20}, Vec2{90, 80}, Vec2{10, 90}}, 20);
            }).find("slant"),
            std::string::npos);
}

}  // namespace
}  // namespace nt
