// SPDX-License-Identifier: Apache-2.0
#include "app/take/edits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/take/property_group.h"
#include "tests/app/swimming_motion.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

constexpr MotionProperty kTail{MotionProperty::Kind::tail, 0};

Clip edited(const std::vector<Motion>& m, const std::vector<std::string>& lines) {
  std::vector<Edit> edits;
  for (const std::string& line : lines) edits.push_back(parse_edit(line));
  return apply_edits(m, straight_motion(3, 15), edits);
}

double largest_step(const std::vector<Motion>& m, MotionProperty u) {
  double largest = 0;
  for (std::size_t i = 1; i < m.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(value_of(m[i], u) - value_of(m[i - 1], u))));
  return largest;
}

TEST(Edits, LinesAreReadBackAsWritten) {
  for (const char* line : {"set head_angle 1042 0.8666", "set low_axis_angle_15 3 -1.25", "move centre_x 10 130.5 4",
                           "smooth body 0:99 5", "exaggerate low_axis 10:20 1.5", "fish 3 set l_fin_angle 7 -2.5",
                           "repair 0:99 0.4", "trim 5:10", "loop 20:60 8", "retime 0.5"})
    EXPECT_EQ(to_line(parse_edit(line)), line);
}

TEST(Edits, MistakesAreOneLineWithItsNumber) {
  const struct {
    const char* line;
    const char* words;
  } cases[] = {
      {"fish 2 trim 0:9", "for all fish"},
      {"fish x set head_angle 3 1", "fish"},
      {"smoth body 0:9 3", "did you mean 'smooth'"},
      {"set head_angl 3 1", "did you mean 'head_angle'"},
      {"set body 3 1", "unknown 'body'"},
      {"set centre_x 3 1", "use move"},
      {"move tail_angle 3 1 2", "use set"},
      {"exaggerate path 0:9 2", "no rest pose"},
      {"set head_angle -1 1", "set"},
      {"set head_angle 3 nan", "set"},
      {"set head_angle 3", "expected set ANGLE FRAME RADIANS"},
      {"set head_angle 3 1 2", "after it"},
      {"trim 5", "expected trim FIRST:LAST"},
      {"trim 9:5", "trim"},
      {"exaggerate body 0:9 -1", "exaggerate"},
      {"retime 0", "retime"},
  };
  const TempDir dir;
  for (const auto& mistake : cases) {
    write_text(dir / "edits", std::string("# a comment\n\nretime 1 # as it is\n") + mistake.line + "\n");
    const std::string line = user_error([&] { read_edits(dir / "edits"); });
    EXPECT_NE(line.find("edits:4: "), std::string::npos) << mistake.line << " -> " << line;
    EXPECT_NE(line.find(mistake.words), std::string::npos) << mistake.line << " -> " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  EXPECT_NE(user_error([&] { read_edits(dir / "none"); }).find("cannot read the edits"), std::string::npos);
}

TEST(Edits, AnyTextIsReadOrRefused) {
  const std::string letters = "setmovsmthexagrpilo headcntryx_0123456789.:-# \t\n\r\x80\xff";
  std::mt19937 random(3);
  const TempDir dir;
  for (int round = 0; round < 600; ++round) {
    std::string text = round % 2 == 0 ? "set head_angle 10 0.5\nsmooth body 0:9 3\n" : "";
    for (unsigned long n = random() % 40; n > 0; --n) {
      const std::size_t at = text.empty() ? 0 : random() % text.size();
      text.insert(at, 1, letters[random() % letters.size()]);
    }
    write_text(dir / "edits", text);
    user_error([&] { apply_edits(swimming(30), straight_motion(3, 15), read_edits(dir / "edits")); });
  }
}

TEST(Edits, FramesAndBonesThatAreNotThere) {
  EXPECT_NE(user_error([] { edited(swimming(30), {"set head_angle 30 1"}); }).find("the last is 29"),
            std::string::npos);
  EXPECT_NE(user_error([] {
              edited(swimming(30), {"trim 0:9", "smooth body 0:20 3"});
            }).find("the last is 9"),
            std::string::npos);
  EXPECT_NE(user_error([] { edited(swimming(30), {"set low_axis_angle_16 3 1"}); }).find("15 low bones"),
            std::string::npos);
}

TEST(Edits, TheRecordingIsUntouchedAndOrderMatters) {
  const std::vector<Motion> m = swimming(60);
  const Clip a = edited(m, {"exaggerate body 0:59 2", "set tail_angle 5 -1.2"});
  const Clip b = edited(m, {"set tail_angle 5 -1.2", "exaggerate body 0:59 2"});
  EXPECT_NEAR(a.motions[5].tail_angle, -1.2f, 1e-6f);
  EXPECT_NEAR(b.motions[5].tail_angle, -3.14159265f / 2 + 2 * (-1.2f + 3.14159265f / 2), 1e-5f);
  EXPECT_NEAR(m[5].tail_angle, -3.14159265f / 2 + 0.5f, 1e-5f);
}

TEST(Edits, SmoothTakesJitterAndLeavesTheBeat) {
  const std::vector<Motion> clean = swimming(200);
  std::vector<Motion> noisy = clean;
  std::mt19937 random(1);
  std::normal_distribution<float> jitter(0, 0.05f);
  for (Motion& frame : noisy) frame.tail_angle += jitter(random);
  const Clip clip = edited(noisy, {"smooth tail_angle 0:199 8"});
  double before = 0, after = 0;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    before += std::pow(noisy[i].tail_angle - clean[i].tail_angle, 2);
    after += std::pow(clip.motions[i].tail_angle - clean[i].tail_angle, 2);
  }
  EXPECT_LT(after, 0.4 * before);
}

TEST(Edits, AStretchFadesInAndOut) {
  const std::vector<Motion> m = swimming(200);
  const Clip clip = edited(m, {"exaggerate tail_angle 50:150 2"});
  EXPECT_EQ(clip.motions[49].tail_angle, m[49].tail_angle);
  EXPECT_EQ(clip.motions[151].tail_angle, m[151].tail_angle);
  EXPECT_NEAR(clip.motions[105].tail_angle + 1.5707963f, 2 * (m[105].tail_angle + 1.5707963f), 1e-5f);
  EXPECT_LT(largest_step(clip.motions, kTail), 2.2 * largest_step(m, kTail));
}

TEST(Edits, RepairBridgesBadFrames) {
  const std::vector<Motion> good = swimming(100);
  std::vector<Motion> bad = good;
  for (std::size_t i : {30u, 31u, 32u, 70u}) {
    bad[i].status = PoseStatus::lost;
    bad[i].tail_angle = 3, bad[i].centre = {0, 0};
  }
  bad[50].confidence.head = 0.2f, bad[50].tail_angle = 2;
  bad[99].status = PoseStatus::partial;
  const Clip clip = edited(bad, {"repair 0:99 0.5"});
  for (std::size_t i = 0; i < 99; ++i) {
    EXPECT_EQ(clip.motions[i].status, PoseStatus::ok);
    EXPECT_NEAR(clip.motions[i].tail_angle, good[i].tail_angle, 0.2f) << i;
    EXPECT_NEAR(clip.motions[i].centre.x, good[i].centre.x, 1e-3f) << i;
  }
  EXPECT_EQ(clip.motions[99].centre.x, good[98].centre.x);
  for (Motion& frame : bad) frame.status = PoseStatus::absent;
  EXPECT_NE(user_error([&] { edited(bad, {"repair 0:99 0.5"}); }).find("no frame is as sure"), std::string::npos);
}

TEST(Edits, ALoopClosesOnItself) {
  const std::vector<Motion> m = swimming(100);
  const Clip clip = edited(m, {"loop 13:65 10"});  // 53 frames: not a whole number of beats
  ASSERT_EQ(clip.motions.size(), 53u);
  EXPECT_GT(clip.seam.angle_rad, 0.3);
  EXPECT_NEAR(clip.seam.drift_px, 4 * 53, 1e-2);
  std::vector<Motion> twice = clip.motions;
  twice.insert(twice.end(), clip.motions.begin(), clip.motions.end());
  EXPECT_LT(largest_step(twice, kTail), 1.6 * largest_step(m, kTail));
  EXPECT_LT(largest_step(twice, {MotionProperty::Kind::centre_x, 0}), 1.0);
}

TEST(Edits, RetimeKeepsTheFrameRate) {
  const std::vector<Motion> m = swimming(101);
  const Clip slow = edited(m, {"retime 0.5"}), fast = edited(m, {"retime 2"});
  ASSERT_EQ(slow.motions.size(), 201u);
  ASSERT_EQ(fast.motions.size(), 51u);
  EXPECT_NEAR(slow.motions[41].tail_angle, (m[20].tail_angle + m[21].tail_angle) / 2, 1e-5f);
  EXPECT_EQ(fast.motions[10].tail_angle, m[20].tail_angle);
  for (const Clip* clip : {&slow, &fast})
    for (std::size_t i = 1; i < clip->motions.size(); ++i)
      EXPECT_NEAR(static_cast<double>(clip->motions[i].time_ns - clip->motions[i - 1].time_ns), 33'333'333, 5);
}

TEST(PropertyGroup, EveryWordMeansSomething) {
  for (const std::string& word : property_words()) EXPECT_FALSE(properties_of(word).empty()) << word;
  EXPECT_TRUE(properties_of("").empty());
  EXPECT_TRUE(properties_of("bodies").empty());
}

}  // namespace
}  // namespace nt
