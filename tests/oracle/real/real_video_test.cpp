// SPDX-License-Identifier: Apache-2.0
// Capture on filmed fish keeps to what it has reached; bench_real prints the figures.
#include "tests/oracle/real/real_video.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <opencv2/imgproc.hpp>

namespace nt::test {
namespace {

// What a clip must reach: shares of frames within 1.5 % of the length (midline) and 3 % (ends).
struct Promise {
  const char* file;
  double pose, midline, head, tail;
};

// The reference reads a drawn fish right before it judges a filmed one.
TEST(ReferenceMidline, FollowsADrawnFish) {
  cv::Mat frame(200, 400, CV_8U, cv::Scalar(230));
  std::vector<cv::Point2d> spine;
  for (int i = 0; i <= 300; ++i) {
    const double s = i / 300.0, x = 50 + 300 * s, y = 100 + 30 * std::sin(3 * s);
    spine.emplace_back(x, y);
    const double half =
        s < 0.2 ? 20 * std::sqrt(std::max(0.0, 1 - (1 - s / 0.2) * (1 - s / 0.2))) : 20 - 22 * (s - 0.2);
    cv::circle(frame, cv::Point(cvRound(x), cvRound(y)), static_cast<int>(std::max(half, 1.0)),
               cv::Scalar(s < 0.9 ? 20 : 150), -1);
  }
  const ReferencePose pose = reference_midline(frame, {}, {.strong = 150, .weak = 50});
  ASSERT_TRUE(pose.found);
  const bool turned = pose.midline.front().x > pose.midline.back().x;
  const cv::Point2d head = turned ? pose.midline.back() : pose.midline.front();
  const cv::Point2d tail = turned ? pose.midline.front() : pose.midline.back();
  EXPECT_LT(cv::norm(head - spine.front()), 5);
  EXPECT_LT(cv::norm(tail - spine.back()), 5);
  for (const cv::Point2d p : pose.midline) {
    double nearest = 1e9;
    for (const cv::Point2d q : spine) nearest = std::min(nearest, cv::norm(p - q));
    EXPECT_LT(nearest, 3.5) << p.x;
  }
}

TEST(ReferenceMidline, AnEmptyPictureHasNone) {
  EXPECT_FALSE(reference_midline(cv::Mat(60, 80, CV_8U, cv::Scalar(200)), {}, {}).found);
}

class RealVideo : public testing::TestWithParam<Promise> {};

TEST_P(RealVideo, IsCapturedAsThePromiseSays) {
  const Promise& promise = GetParam();
  const std::string folder = std::string(NEONTETRA_SHARED_DATA) + "/fish_topview";
  if (!std::filesystem::exists(folder + "/" + promise.file)) GTEST_SKIP() << "no " << promise.file;
  for (const RealClip& clip : real_clips()) {
    if (clip.file != promise.file) continue;
    const RealAccuracy a = measure_real(clip, folder);
    ASSERT_GT(a.frames, 10);
    EXPECT_EQ(a.wrong_end, 0);
    EXPECT_EQ(a.false_poses, 0);
    EXPECT_GE(a.pose_share(), promise.pose);
    EXPECT_GE(a.share_within(&RealFrame::midline, 1.5), promise.midline);
    EXPECT_GE(a.share_within(&RealFrame::head, 3), promise.head);
    EXPECT_GE(a.share_within(&RealFrame::tail, 3), promise.tail);
    if (clip.fins.empty()) continue;
    EXPECT_GE(compare_fins(a, clip.fins, true).share(), 0.9);
    EXPECT_GE(compare_fins(a, clip.fins, false).share(), 0.9);
  }
}

INSTANTIATE_TEST_SUITE_P(Clips, RealVideo,
                         testing::Values(Promise{"sunfish_pectoral_flume.avi", 1, 1, 1, 0.98},
                                         Promise{"trout_flume.avi", 1, 1, 1, 0.88},
                                         Promise{"sunfish_bcf_hires.avi", 1, 1, 1, 0.9},
                                         Promise{"fish_piv_darkfield_2k.mp4", 1, 1, 1, 0.96},
                                         Promise{"zebrafish_larva_dish_1fish.mp4", 0.97, 0.8, 0.6, 0.7},
                                         Promise{"zebrafish_larva_free_crop.mp4", 1, 0.98, 0.96, 0.95}),
                         [](const auto& test) {
                           const std::string file = test.param.file;
                           return file.substr(0, file.find('.'));
                         });

}  // namespace
}  // namespace nt::test
