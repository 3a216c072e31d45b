// SPDX-License-Identifier: Apache-2.0
// The real binary: millimetres, a lens, a camera in the hand, latency and memory, and what users get wrong about them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/aruco.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/app/csv_table.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

using Json = nlohmann::json;

void expect_one_line(const std::string& arguments, int exit_code, const std::string& part) {
  const Outcome outcome = neontetra("capture -c sim:size=320x180,frames=5 --background vibe " + arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << arguments << ": " << outcome.err;
  EXPECT_EQ(outcome.error_lines(), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

TEST(MeasuredCapture, MistakesAreOneClearLine) {
  const TempDir dir;
  write_text(dir / "lens.txt", "fx 300\nfy 300\ncx 160\n");
  expect_one_line("--stabilise maybe", 2, "off, on or auto");
  expect_one_line("--scale-mm 50", 2, "go together");
  expect_one_line("--scale-points 1,2,100,2", 2, "go together");
  expect_one_line("--scale-points 1,2,3 --scale-mm 50", 2, "X1,Y1,X2,Y2");
  expect_one_line("--scale-points 1,2,100,2 --scale-mm 50 --marker-mm 20", 2, "choose one");
  expect_one_line("--scale-points 1,2,100,2 --scale-mm 0", 2, "--scale-mm");
  expect_one_line("--marker-mm 20", 1, "no AprilTag");
  expect_one_line("--lens " + (dir / "none.txt"), 1, "no such file");
  expect_one_line("--lens " + (dir / "lens.txt"), 1, "cy is missing");
}

TEST(MeasuredCapture, TwoPointsGiveMillimetresInTheCsvAndTheReport) {
  const TempDir dir;
  const Outcome run = neontetra(
      "capture -c sim:size=320x180,frames=120 --background vibe --scale-points 10,10,110,10 --scale-mm 50 --csv " +
      (dir / "p.csv") + " --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_DOUBLE_EQ(Json::parse(run.out)["calibration"]["px_per_mm"], 2);
  const CsvTable table(dir / "p.csv");
  int poses = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ASSERT_EQ(table.cells(row), table.columns());
    if (table.text(row, "status") != "ok") {
      EXPECT_EQ(table.text(row, "length_mm"), "");
      continue;
    }
    ++poses;
    EXPECT_NEAR(*table.number(row, "head_x_mm"), *table.number(row, "head_x") / 2, 1e-3);
    EXPECT_NEAR(*table.number(row, "length_mm"), 73.3 / 2, 2);
  }
  EXPECT_GT(poses, 30);
}

TEST(MeasuredCapture, ALensMovesThePointsAsOpenCvWould) {
  const TempDir dir;
  write_text(dir / "lens.txt", "fx 300\nfy 300\ncx 160\ncy 90\nk1 -0.2\n");
  const std::string capture = "capture -c sim:size=320x180,frames=110 --background vibe --csv ";
  ASSERT_EQ(neontetra(capture + (dir / "plain.csv")).exit_code, 0);
  ASSERT_EQ(neontetra(capture + (dir / "lens.csv") + " --lens " + (dir / "lens.txt")).exit_code, 0);
  const CsvTable plain(dir / "plain.csv"), lens(dir / "lens.csv");
  double most = 0;
  for (std::size_t row = 0; row < plain.rows(); ++row) {
    if (plain.text(row, "status") != "ok") continue;
    const double x = (*lens.number(row, "head_x") - 160) / 300, y = (*lens.number(row, "head_y") - 90) / 300;
    const double radial = 1 - 0.2 * (x * x + y * y);
    EXPECT_NEAR(160 + 300 * x * radial, *plain.number(row, "head_x"), 0.01);
    EXPECT_NEAR(90 + 300 * y * radial, *plain.number(row, "head_y"), 0.01);
    most = std::max(most, std::abs(*lens.number(row, "head_x") - *plain.number(row, "head_x")));
  }
  EXPECT_GT(most, 0.3) << "the lens must do something";
}

TEST(MeasuredCapture, AMarkerInTheTankGivesTheScale) {
  const TempDir dir;
  cv::Mat marker, picture(360, 640, CV_8U, cv::Scalar(150));
  cv::aruco::drawMarker(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11), 3, 80, marker, 1);
  picture(cv::Rect(490, 30, 100, 100)).setTo(255);
  marker.copyTo(picture(cv::Rect(500, 40, 80, 80)));
  for (int n = 0; n < 40; ++n) {
    cv::Mat frame = picture.clone();
    cv::ellipse(frame, {100 + 5 * n, 220}, {40, 12}, 0, 0, 360, 40, cv::FILLED, cv::LINE_AA);
    char name[32];
    std::snprintf(name, sizeof name, "f_%03d.png", n);
    cv::imwrite(dir / name, frame);
  }
  const Outcome run = neontetra("capture -c " + dir.path() + " --background vibe --marker-mm 20 --csv " +
                                (dir / "p.csv") + " --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json calibration = Json::parse(run.out)["calibration"];
  EXPECT_NEAR(calibration["px_per_mm"].get<double>(), 4, 0.05);
  EXPECT_EQ(calibration["scale_from"], "marker");
  EXPECT_EQ(Json::parse(run.out)["frames"], 40) << "the frames looked at for the marker are filmed too";
}

TEST(MeasuredCapture, AHandIsNoticedAndSaid) {
  const Outcome run = neontetra("capture -c sim:scene=shake,size=320x180,frames=40 --background vibe --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("the camera moves"), std::string::npos);
  const Json report = Json::parse(run.out);
  EXPECT_EQ(report["stabilise"]["mode"], "auto");
  EXPECT_EQ(report["stabilise"]["active"], true);
  EXPECT_GT(report["flags"]["stabilised"], 20);
  const Outcome still = neontetra("capture -c sim:size=320x180,frames=40 --background vibe --json -");
  EXPECT_EQ(Json::parse(still.out)["stabilise"]["active"], false);
  EXPECT_EQ(still.err.find("camera moves"), std::string::npos);
}

TEST(MeasuredCapture, AtTheCamerasPaceTheLatencyIsReported) {
  const Outcome run = neontetra("capture -c sim:size=320x180,frames=30,fps=25 --background vibe --real-time --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("latency"), std::string::npos);
  const Json latency = Json::parse(run.out)["latency"];
  const double median = latency["median_ms"];
  EXPECT_GT(median, 0);
  EXPECT_LE(median, latency["p99_ms"]);
  EXPECT_LT(latency["median_frame_times"], 1);
  EXPECT_NEAR(latency["median_frame_times"].get<double>(), median / 40, 0.01);
  EXPECT_TRUE(Json::parse(neontetra("capture -c sim:size=320x180,frames=3 --background vibe --json -").out)["latency"]
                  .is_null());
}

TEST(MeasuredCapture, MemoryStaysUnderFortyMegabytesAndIsFlat) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the sanitizer's own memory is counted too";
#endif
  const Json full = Json::parse(neontetra("capture -c sim --frames 150 --csv /dev/null --json -").out)["memory"];
  EXPECT_LE(full["process_peak_bytes"], 40'000'000);
  const auto end_of = [](const char* frames) {
    const Json memory = Json::parse(neontetra(std::string("capture -c sim:scene=long,size=320x180,frames=") + frames +
                                              " --background vibe --csv /dev/null --json -")
                                        .out)["memory"];
    return memory["process_end_bytes"].get<int64_t>();
  };
  EXPECT_LE(end_of("3000"), end_of("600") + 400'000);
}

}  // namespace
}  // namespace nt
