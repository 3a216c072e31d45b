// SPDX-License-Identifier: Apache-2.0
// A fish goes in, a swimming drawing comes out: the real binary on the tank, and on real clips where they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "tests/app/csv_table.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

const std::string kCarp = NEONTETRA_ASSETS "/characters/carp.png";
const std::string kClips = NEONTETRA_ASSETS "/../../shared/data/fish_topview/";

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double distance(const CsvTable& a, const CsvTable& b, std::size_t row, const std::string& point) {
  return std::hypot(*a.number(row, point + "_x") - *b.number(row, point + "_x"),
                    *a.number(row, point + "_y") - *b.number(row, point + "_y"));
}

// Length of the true body: centre to head plus centre to tail, along the axis points.
double body_length(const CsvTable& truth, std::size_t row) {
  std::vector<std::string> chain = {"head"};
  for (int i = 3; i >= 1; --i) chain.push_back("up_axis_" + std::to_string(i));
  chain.push_back("centre");
  for (int i = 1; i <= 15; ++i) chain.push_back("low_axis_" + std::to_string(i));
  chain.push_back("tail");
  double sum = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    sum += std::hypot(*truth.number(row, chain[i] + "_x") - *truth.number(row, chain[i - 1] + "_x"),
                      *truth.number(row, chain[i] + "_y") - *truth.number(row, chain[i - 1] + "_y"));
  }
  return sum;
}

TEST(EndToEnd, TankPosesMatchTheTruthInTheSameColumns) {
  const TempDir dir;
  const Outcome run = neontetra("capture -c sim:frames=400,seed=2 --background vibe --csv " + dir / "poses.csv" +
                                " --truth " + dir / "truth.csv" + " --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CsvTable poses(dir / "poses.csv"), truth(dir / "truth.csv");
  EXPECT_EQ(poses.header(), truth.header());
  ASSERT_EQ(poses.rows(), 400u);
  ASSERT_EQ(truth.rows(), 400u);
  std::vector<double> head_errors;
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    if (poses.text(row, "status") != "ok" || truth.text(row, "status") != "ok") continue;
    head_errors.push_back(distance(poses, truth, row, "head") / body_length(truth, row));
  }
  ASSERT_GT(head_errors.size(), 200u);
  EXPECT_LT(median(head_errors), 0.03);

  const nlohmann::json report = nlohmann::json::parse(run.out);
  EXPECT_EQ(report["format"], 1);
  EXPECT_EQ(report["frames"], 400);
  EXPECT_GT(report["frames_with_pose"], 200);
  EXPECT_EQ(report["status"]["ok"], report["frames_with_pose"]);
  EXPECT_GT(report["stages_us"]["background"]["median"], 0);
  EXPECT_GT(report["stages_us"]["total"]["p99"], report["stages_us"]["total"]["median"]);
  EXPECT_GE(report["stages_us"]["total"]["p999"], report["stages_us"]["total"]["p99"]);
  EXPECT_LE(report["memory"]["core_bytes"], 16'000'000);
  if (!report["allocations_after_frame_0"].is_null()) {
    EXPECT_EQ(report["allocations_after_frame_0"], 0);
  }
}

TEST(EndToEnd, TheSameSeedGivesTheSamePoses) {
  const TempDir dir;
  for (const std::string name : {"a.csv", "b.csv"}) {
    ASSERT_EQ(neontetra("capture -c sim:frames=60,seed=5 --csv " + dir / name).exit_code, 0);
  }
  EXPECT_EQ(read_text(dir / "a.csv"), read_text(dir / "b.csv"));
}

TEST(EndToEnd, TheDrawingSwims) {
  const TempDir dir;
  const Outcome run = neontetra("animate -c sim:frames=150,seed=2 --background vibe --character " + kCarp + " --out " +
                                dir / "swim.mp4" + " --contact-sheet " + dir / "sheet.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(dir / "sheet.png"));
  cv::VideoCapture video(dir / "swim.mp4");
  ASSERT_TRUE(video.isOpened());
  EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 60, 0.1);  // one in-between for 30 frames a second
  cv::Mat frame, last;
  int frames = 0, moving = 0;
  while (video.read(frame)) {
    // Compression alone stays well under 40 grey levels; a drawing that moves uncovers water.
    if (!last.empty() && cv::norm(frame, last, cv::NORM_INF) > 40) ++moving;
    frame.copyTo(last);
    ++frames;
  }
  EXPECT_EQ(frames, 149 * 2 + 1);
  EXPECT_GT(moving, 60);
}

TEST(EndToEnd, SideBySideIsTwiceAsWide) {
  const TempDir dir;
  ASSERT_EQ(neontetra("animate -c sim:frames=5 --inbetweens 0 --side-by-side --character " + kCarp + " --out " +
                      dir / "two.mp4")
                .exit_code,
            0);
  cv::VideoCapture video(dir / "two.mp4");
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), 1920);
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_HEIGHT), 544);
}

struct Clip {
  const char* file;
  const char* background;  // that `auto` must choose
  int first_visible;       // frame from which the fish is wholly visible
};

class RealClip : public testing::TestWithParam<Clip> {};

TEST_P(RealClip, APoseInAtLeast95PercentOfTheFrames) {
  const Clip& clip = GetParam();
  if (!std::filesystem::exists(kClips + clip.file)) GTEST_SKIP() << "no real clips on this machine";
  const TempDir dir;
  const Outcome run = neontetra("capture -c " + kClips + clip.file + " --csv " + dir / "poses.csv" + " --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["background"]["name"], clip.background);
  const CsvTable poses(dir / "poses.csv");
  std::size_t ok = 0, visible = 0;
  for (std::size_t row = static_cast<std::size_t>(clip.first_visible); row < poses.rows(); ++row, ++visible) {
    ok += poses.text(row, "status") == "ok" ? 1 : 0;
  }
  EXPECT_GE(static_cast<double>(ok), 0.95 * static_cast<double>(visible)) << ok << " of " << visible;
}

// The larva's first_visible was set by eye: frames 0 to 4 are empty water, and the fish comes in in frame 5.
INSTANTIATE_TEST_SUITE_P(Clips, RealClip,
                         testing::Values(Clip{"sunfish_pectoral_flume.avi", "backlit", 0},
                                         Clip{"trout_flume.avi", "backlit", 0},
                                         Clip{"sunfish_bcf_hires.avi", "backlit", 0},
                                         Clip{"zebrafish_larva_free_crop.mp4", "vibe", 6}),
                         [](const auto& test) {
                           std::string name = test.param.file;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace nt
