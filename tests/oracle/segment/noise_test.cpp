// SPDX-License-Identifier: Apache-2.0
// The noise meter against a camera whose Gaussian noise is known.
#include "core/segment/noise.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace {

TEST(NoiseOracle, GaussianOfKnownSigma) {
  for (const double sigma : {1.0, 1.5, 2.5, 5.0, 9.0, 12.8}) {
    cv::RNG rng(7);
    nt::NoiseMeter meter;
    cv::Mat ground(180, 321, CV_32F);
    rng.fill(ground, cv::RNG::UNIFORM, 60, 190);
    for (int n = 0; n < 30; ++n) {
      cv::Mat noise(ground.size(), CV_32F), seen;
      rng.fill(noise, cv::RNG::NORMAL, 0, sigma);
      cv::Mat(ground + noise).convertTo(seen, CV_8U);
      meter.add({seen.data, seen.cols, seen.rows, static_cast<std::ptrdiff_t>(seen.step)});
    }
    EXPECT_NEAR(meter.sigma(), sigma, 0.06 * sigma + 0.05);
  }
}

}  // namespace
