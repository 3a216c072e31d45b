// SPDX-License-Identifier: Apache-2.0
// Components against cv::connectedComponentsWithStats, 8-connected, and their axes against cv::moments.
#include "core/segment/blobs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracle/masks.h"
#include "tests/support/block.h"

namespace {

class BlobsOracle : public testing::Test {
 protected:
  void SetUp() override {
    limits_.max_blobs = limits_.max_runs;  // noise has more components than a tank
    nt::Arena measure;
    (void)nt::Blobs::create(measure, limits_);
    block_ = std::make_unique<nt::test::Block>(measure.used());
    arena_ = nt::Arena(block_->span());
    blobs_ = nt::Blobs::create(arena_, limits_);
    ASSERT_NE(blobs_, nullptr);
  }

  // The label that our runs give to a pixel; -2 where no run is.
  cv::Mat labels(cv::Size size) const {
    cv::Mat out(size, CV_32S, cv::Scalar(-2));
    for (const nt::Run& run : blobs_->runs()) out.row(run.y).colRange(run.x0, run.x1) = run.label;
    return out;
  }

  void compare(const cv::Mat& mask, int min_area_px) {
    cv::Mat theirs, stats, centroids;
    const int count = cv::connectedComponentsWithStats(mask, theirs, stats, centroids, 8);
    const nt::test::OwnedMask ours(mask);
    ASSERT_TRUE(blobs_->find(ours.view(), min_area_px));
    const cv::Mat own = labels(mask.size());
    ASSERT_EQ(cv::countNonZero((own != -2) != (mask != 0)), 0) << "runs cover the mask, no more and no less";

    std::size_t kept = 0;
    for (int i = 1; i < count; ++i) {
      const cv::Mat component = theirs == i;
      const bool keep = stats.at<int>(i, cv::CC_STAT_AREA) >= min_area_px;
      kept += keep;
      double lowest = 0, highest = 0;
      cv::minMaxLoc(own, &lowest, &highest, nullptr, nullptr, component);
      ASSERT_EQ(lowest, highest) << "one label for a component";
      ASSERT_EQ(lowest >= 0, keep);
      if (keep)
        compare_blob(blobs_->blobs()[static_cast<std::size_t>(lowest)], stats.row(i), centroids.row(i), component);
    }
    EXPECT_EQ(blobs_->blobs().size(), kept);
  }

  static void compare_blob(const nt::Blob& blob, const cv::Mat& stats, const cv::Mat& centroid,
                           const cv::Mat& component) {
    const cv::Rect box(stats.at<int>(cv::CC_STAT_LEFT), stats.at<int>(cv::CC_STAT_TOP),
                       stats.at<int>(cv::CC_STAT_WIDTH), stats.at<int>(cv::CC_STAT_HEIGHT));
    EXPECT_EQ(blob.area_px, stats.at<int>(cv::CC_STAT_AREA));
    EXPECT_EQ(cv::Rect(blob.box.x0, blob.box.y0, blob.box.width(), blob.box.height()), box);
    EXPECT_NEAR(blob.centroid.x, centroid.at<double>(0), 1e-3);
    EXPECT_NEAR(blob.centroid.y, centroid.at<double>(1), 1e-3);
    EXPECT_EQ(blob.touches_edge,
              box.x == 0 || box.y == 0 || box.br().x == component.cols || box.br().y == component.rows);
    const cv::Moments m = cv::moments(component, true);
    const double mean = (m.mu20 + m.mu02) / 2 / m.m00;
    const double spread = std::hypot((m.mu20 - m.mu02) / 2, m.mu11) / m.m00;
    EXPECT_NEAR(blob.major_px, std::sqrt(mean + spread), 0.02 * (1 + std::sqrt(mean)));
    EXPECT_NEAR(blob.minor_px, std::sqrt(std::max(mean - spread, 0.0)), 0.02 * (1 + std::sqrt(mean)));
  }

  nt::Limits limits_;
  std::unique_ptr<nt::test::Block> block_;
  nt::Arena arena_;
  nt::Blobs* blobs_ = nullptr;
};

TEST_F(BlobsOracle, NoiseOfEveryDensity) {
  cv::RNG rng(3);
  for (const cv::Size size : nt::test::mask_sizes()) {
    for (const double share : {0.0, 0.1, 0.4, 0.6, 0.9, 1.0}) compare(nt::test::noise_mask(size, share, rng), 1);
  }
}

TEST_F(BlobsOracle, BlobsWithAMinimumArea) {
  cv::RNG rng(4);
  for (const cv::Size size : nt::test::mask_sizes()) {
    for (const int min_area_px : {1, 2, 12}) compare(nt::test::blob_mask(size, 5, rng), min_area_px);
  }
}

TEST_F(BlobsOracle, SpiralsJoinLate) {
  cv::Mat mask(64, 200, CV_8U, cv::Scalar(0));
  for (int i = 0; i < 30; i += 3) cv::rectangle(mask, {i, i}, {199 - i, 63 - i}, 255);
  for (int i = 0; i < 27; i += 6) cv::line(mask, {100, i}, {100, i + 3}, 255);  // joins every other pair of rings
  compare(mask, 1);
}

}  // namespace
