// SPDX-License-Identifier: Apache-2.0
// Every capacity at 0, 1 and one less than what is needed: a flag or a message that names the limit, and no crash.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "core/pipeline/pipeline.h"
#include "tests/support/tank_run.h"

namespace {

constexpr int kFrames = 150;
const nt::TankSettings kTank{.width = 320, .height = 180};

// The frames are filmed once.
const std::vector<std::vector<uint8_t>>& film() {
  static const auto frames = [] {
    std::vector<std::vector<uint8_t>> out;
    nt::Tank tank(kTank);
    for (int n = 0; n < kFrames; ++n) {
      const nt::LumaView luma = tank.render_next();
      std::vector<uint8_t>& copy = out.emplace_back();
      for (int y = 0; y < luma.height; ++y) copy.insert(copy.end(), luma.row(y), luma.row(y) + luma.width);
    }
    return out;
  }();
  return frames;
}

struct Outcome {
  uint32_t flags = 0;
  int poses = 0;
};

Outcome run(const nt::Limits& limits) {
  const nt::CaptureSettings settings;
  const nt::test::Block block(nt::Capture::bytes_needed(limits, settings));
  auto made = nt::Capture::create(block.span(), limits, settings, kTank.width, kTank.height);
  EXPECT_TRUE(made.ok()) << made.status().message;
  Outcome out;
  for (const auto& pixels : film()) {
    nt::Frame frame;
    frame.luma = {pixels.data(), kTank.width, kTank.height, kTank.width};
    out.flags |= made.value()->step(frame).flags;
    out.poses += made.value()->pose().ok();
  }
  return out;
}

struct Capacity {
  const char* name;
  int nt::Limits::*field;
  nt::StepFlag flag;
};

class LimitsTest : public testing::TestWithParam<Capacity> {
 protected:
  static uint32_t flags_at(int value) {
    nt::Limits limits = nt::test::limits_for(kTank);
    limits.*GetParam().field = value;
    return run(limits).flags & GetParam().flag;
  }
};

TEST_P(LimitsTest, RaisesItsFlagBelowWhatIsNeededAndNotAtIt) {
  int too_few = 1, enough = nt::Limits{}.*GetParam().field;
  ASSERT_EQ(flags_at(enough), 0u) << "the default must do";
  ASSERT_GT(run(nt::test::limits_for(kTank)).poses, kFrames / 4) << "a fish must have been there";
  EXPECT_NE(flags_at(0), 0u);
  if (flags_at(1) == 0u) return;  // one is all that these frames need
  while (enough - too_few > 1) {
    const int middle = (too_few + enough) / 2;
    (flags_at(middle) != 0 ? too_few : enough) = middle;
  }
  EXPECT_NE(flags_at(enough - 1), 0u);
  EXPECT_EQ(flags_at(enough), 0u);
}

TEST_P(LimitsTest, NamesTheLimit) {
  EXPECT_NE(std::strstr(nt::limit_to_raise(GetParam().flag), GetParam().name), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Capture, LimitsTest,
                         testing::Values(Capacity{"max_runs", &nt::Limits::max_runs, nt::kRunsDropped},
                                         Capacity{"max_blobs", &nt::Limits::max_blobs, nt::kBlobsDropped},
                                         Capacity{"max_contour_points", &nt::Limits::max_contour_points,
                                                  nt::kContourCut}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(LimitsOfSize, FramesThatDoNotFitAreRefused) {
  for (int nt::Limits::*side : {&nt::Limits::max_width, &nt::Limits::max_height}) {
    const nt::Limits fits = nt::test::limits_for(kTank);
    for (const int value : {0, 1, fits.*side - 1}) {
      nt::Limits limits = fits;
      limits.*side = value;
      const nt::test::Block block(nt::Capture::bytes_needed(limits, {}));
      const auto made = nt::Capture::create(block.span(), limits, {}, kTank.width, kTank.height);
      EXPECT_FALSE(made.ok());
      EXPECT_NE(std::strstr(made.status().message, "max_width"), nullptr) << made.status().message;
    }
  }
}

TEST(LimitsOfSize, AFrameOfAnotherSizeIsFlaggedAndNotProcessed) {
  nt::test::TankRun tank(kTank);
  tank.film();
  nt::Frame frame = tank.frame();
  frame.luma.width = kTank.width + 1;
  EXPECT_NE(tank.capture().step(frame).flags & nt::kFrameSize, 0u);
  EXPECT_NE(std::strstr(nt::limit_to_raise(nt::kFrameSize), "max_width"), nullptr);
}

TEST(LimitsOfSize, OneByteLessThanNeededIsRefused) {
  const nt::Limits limits = nt::test::limits_for(kTank);
  const std::size_t bytes = nt::Capture::bytes_needed(limits, {});
  const nt::test::Block block(bytes);
  const auto create = [&](std::size_t n) {
    return nt::Capture::create(block.span().first(n), limits, {}, kTank.width, kTank.height);
  };
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, bytes - 1}) {
    EXPECT_EQ(create(n).status().code, nt::StatusCode::out_of_memory);
  }
  EXPECT_TRUE(create(bytes).ok());
}

TEST(LimitsOfCharacter, ADrawingThatDoesNotFitIsRefusedByName) {
  const nt::test::DrawnFish drawing;
  const struct {
    const char* name;
    int nt::Limits::*field;
    int needed;
  } capacities[] = {{"max_vertices", &nt::Limits::max_vertices, nt::test::kFishVertices},
                    {"max_triangles", &nt::Limits::max_triangles, nt::test::kFishTriangles},
                    {"max_control_points", &nt::Limits::max_control_points, nt::test::kFishControls}};
  for (const auto& c : capacities) {
    nt::Limits limits;
    for (const int value : {0, 1, c.needed - 1}) {
      limits.*c.field = value;
      const auto opened = nt::open_character(drawing.bytes(), limits);
      EXPECT_FALSE(opened.ok()) << c.name << " " << value;
      EXPECT_NE(std::strstr(opened.status().message, c.name), nullptr) << opened.status().message;
    }
    limits.*c.field = c.needed;
    EXPECT_TRUE(nt::open_character(drawing.bytes(), limits).ok()) << c.name;
  }
}

}  // namespace
