// SPDX-License-Identifier: Apache-2.0
#include "core/motion/finetune.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace nt {
namespace {

using Kind = MotionProperty::Kind;
constexpr MotionProperty kHead{Kind::head, 0};

std::vector<Motion> sequence_of(const std::vector<float>& values, MotionProperty u = kHead) {
  std::vector<Motion> sequence(values.size(), straight_motion(3, 15));
  for (std::size_t i = 0; i < values.size(); ++i) set_value(sequence[i], u, values[i]);
  return sequence;
}

// [F] Table 2: the edit of frame 1042, row by row. The recording itself is not printed there; this one leaves the rest
// pose's other side just where the table's windows say, and holds the table's M_r at r.
struct Row {
  MotionProperty u;
  int p, q;
  float rest, value, edited;
};
constexpr int kR = 1042;
const Row kTable2[] = {
    {{Kind::up_axis, 1}, 1040, 1049, 1.6589f, 0.9704f, 1.1062f},
    {{Kind::up_axis, 2}, 1039, 1050, 1.5965f, 0.7586f, 1.0261f},
    {{Kind::head, 0}, 1039, 1052, 1.4987f, 0.5493f, 0.8666f},
    {{Kind::r_fin, 0}, 1040, 1132, 5.5535f, 4.1450f, 5.2623f},
};

std::vector<Motion> recording_of(const Row& row) {
  std::vector<Motion> sequence(1200, straight_motion(3, 15));
  for (int i = 0; i < 1200; ++i) {
    const bool inside = i >= row.p && i <= row.q;
    const float fade = 1.0f / (1.0f + 0.1f * std::abs(static_cast<float>(i - kR)));
    const float side = inside ? (row.value - row.rest) * fade : 0.1f;  // the table's rows all lie below the rest pose
    set_value(sequence[static_cast<std::size_t>(i)], row.u, row.rest + side);
  }
  return sequence;
}

TEST(FineTune, Table2Windows) {
  for (const Row& row : kTable2) {
    const EditWindow window = edit_window(recording_of(row), row.u, row.rest, kR, row.edited);
    EXPECT_EQ(window.p, row.p);
    EXPECT_EQ(window.q, row.q);
  }
}

TEST(FineTune, Table2Values) {
  for (const Row& row : kTable2) {
    const std::vector<Motion> m = recording_of(row);
    std::vector<Motion> n = m;
    edit_angle(n, row.u, row.rest, kR, row.edited, edit_window(m, row.u, row.rest, kR, row.edited));
    const auto value = [&](const std::vector<Motion>& s, int i) {
      return value_of(s[static_cast<std::size_t>(i)], row.u);
    };
    EXPECT_NEAR(value(n, kR), row.edited, 1e-6f);
    EXPECT_EQ(value(n, row.p - 1), value(m, row.p - 1));
    EXPECT_EQ(value(n, row.q + 1), value(m, row.q + 1));
    EXPECT_NEAR(value(n, row.p), value(m, row.p), 1e-6f);
    EXPECT_NEAR(value(n, row.q), value(m, row.q), 1e-6f);
    for (int i = row.p; i <= row.q; ++i) {  // Eq 18 as printed, which holds for I = 1
      const double end = i <= kR ? row.p : row.q;
      const double f = 1.0 - (kR - i) * (kR - i) / ((kR - end) * (kR - end));
      EXPECT_NEAR(value(n, i), (1.0 - f) * value(m, i) + f * row.edited, 1e-5) << i;
    }
  }
}

// [F] Fig. 6: a fin opened too far in eleven frames is mended by one edit of one of them.
TEST(FineTune, OneEditMendsAFinThatIsTooExtreme) {
  const MotionProperty fin{Kind::r_fin, 0};
  const float rest = 0.0f, limit = 1.0f;
  std::vector<float> angles(60, -0.1f);
  for (int i = 20; i <= 30; ++i)
    angles[static_cast<std::size_t>(i)] = 1.8f - 0.14f * std::abs(static_cast<float>(i - 25));
  std::vector<Motion> n = sequence_of(angles, fin);
  edit_angle(n, fin, rest, 25, 0.6f, edit_window(n, fin, rest, 25, 0.6f));
  // The windows' ends stay as they were, as Eq 21 has it; between them the excess goes.
  for (int i = 22; i <= 28; ++i) EXPECT_LT(value_of(n[static_cast<std::size_t>(i)], fin), limit) << i;
  for (int i = 20; i <= 30; ++i)
    EXPECT_LE(value_of(n[static_cast<std::size_t>(i)], fin), angles[static_cast<std::size_t>(i)] + 1e-6f) << i;
  for (int i : {19, 31}) EXPECT_EQ(value_of(n[static_cast<std::size_t>(i)], fin), -0.1f);
}

TEST(FineTune, AReversalReplacesTheMotion) {
  // Bent to +0.5 by mistake between 10 and 20: the edit says -0.4, and nothing of the mistake is left.
  std::vector<float> angles(31, -0.01f);
  for (int i = 10; i <= 20; ++i) angles[static_cast<std::size_t>(i)] = 0.5f;
  std::vector<Motion> n = sequence_of(angles);
  edit_angle(n, kHead, 0.0f, 15, -0.4f, edit_window(n, kHead, 0.0f, 15, -0.4f));
  EXPECT_NEAR(n[15].head_angle, -0.4f, 1e-6f);
  EXPECT_NEAR(n[12].head_angle, -0.4f * (1.0f - 9.0f / 25.0f), 1e-6f);
  EXPECT_NEAR(n[10].head_angle, 0.0f, 1e-6f);  // the rest pose, not 0 by accident: see the next test
  EXPECT_NEAR(n[21].head_angle, -0.01f, 1e-6f);
}

TEST(FineTune, AReversalGoesThroughTheRestPoseNotThroughZero) {
  std::vector<float> angles(21, 1.4f);
  for (int i = 5; i <= 15; ++i) angles[static_cast<std::size_t>(i)] = 2.0f;
  std::vector<Motion> n = sequence_of(angles);
  edit_angle(n, kHead, 1.5f, 10, 1.2f, edit_window(n, kHead, 1.5f, 10, 1.2f));
  for (const Motion& m : n) EXPECT_GE(m.head_angle, 1.2f - 1e-6f);  // Eq 18 as printed falls to 0 at p and q
  EXPECT_NEAR(n[5].head_angle, 1.5f, 1e-6f);
}

TEST(FineTune, AnEditAtTheEndOfItsWindow) {
  std::vector<Motion> n = sequence_of({0.5f, 0.5f, 0.5f, -0.1f});
  edit_angle(n, kHead, 0.0f, 0, 0.9f, edit_window(n, kHead, 0.0f, 0, 0.9f));
  EXPECT_NEAR(n[0].head_angle, 0.9f, 1e-6f);
  EXPECT_NEAR(n[1].head_angle, 0.25f * 0.5f + 0.75f * 0.9f, 1e-6f);
  EXPECT_NEAR(n[2].head_angle, 0.5f, 1e-6f);
  EXPECT_EQ(n[3].head_angle, -0.1f);
}

TEST(FineTune, AFrameOnTheRestPoseTakesTheSideOfTheEdit) {
  std::vector<Motion> n = sequence_of({-0.2f, 0.3f, 0.0f, 0.3f, -0.2f});
  const EditWindow up = edit_window(n, kHead, 0.0f, 2, 0.5f), down = edit_window(n, kHead, 0.0f, 2, -0.5f);
  EXPECT_EQ(up.p, 1);
  EXPECT_EQ(up.q, 3);
  EXPECT_EQ(down.p, 2);
  EXPECT_EQ(down.q, 2);
  const EditWindow none = edit_window(n, kHead, 0.0f, 2, 0.0f);
  EXPECT_EQ(none.p, 2);
  EXPECT_EQ(none.q, 2);
}

// A fin that opens twice and lies folded, unseen, in between: an edit of one stroke leaves the other alone.
TEST(FineTune, FoldedFinsPartTheStrokes) {
  const MotionProperty fin{Kind::l_fin, 0};
  std::vector<float> angles(60, kFoldedLeftFin);
  for (int i : {10, 11, 12, 13, 40, 41, 42, 43}) angles[static_cast<std::size_t>(i)] = kFoldedLeftFin - 0.8f;
  const EditWindow window = edit_window(sequence_of(angles, fin), fin, kFoldedLeftFin, 41, kFoldedLeftFin - 0.5f);
  EXPECT_EQ(window.p, 40);
  EXPECT_EQ(window.q, 43);
  // A stroke made where there was none reaches to the next ones' ends and no farther.
  angles[2] = kFoldedLeftFin - 0.3f, angles[50] = kFoldedLeftFin - 0.3f;
  const EditWindow made = edit_window(sequence_of(angles, fin), fin, kFoldedLeftFin, 25, kFoldedLeftFin - 0.5f);
  EXPECT_EQ(made.p, 10);
  EXPECT_EQ(made.q, 43);
}

TEST(FineTune, APathEditMovesTheNeighboursAlong) {
  const MotionProperty x{Kind::centre_x, 0};
  std::vector<float> line(21);
  for (int i = 0; i < 21; ++i) line[static_cast<std::size_t>(i)] = 10.0f * static_cast<float>(i);
  std::vector<Motion> n = sequence_of(line, x);
  edit_path(n, x, 10, 130.0f, path_window(21, 10, 4));
  EXPECT_NEAR(n[10].centre.x, 130.0f, 1e-4f);
  EXPECT_NEAR(n[8].centre.x, 80.0f + 0.75f * 30.0f, 1e-4f);
  EXPECT_NEAR(n[6].centre.x, 60.0f, 1e-4f);
  EXPECT_EQ(n[5].centre.x, 50.0f);
  EXPECT_EQ(n[15].centre.x, 150.0f);
}

TEST(FineTune, APathWindowEndsWithTheSequence) {
  const EditWindow window = path_window(10, 8, 5);
  EXPECT_EQ(window.p, 3);
  EXPECT_EQ(window.q, 9);
}

}  // namespace
}  // namespace nt
