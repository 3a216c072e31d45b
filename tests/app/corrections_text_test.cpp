// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "app/author/corrections.h"
#include "core/base/random.h"
#include "platform/camera.h"
#include "tests/app/straight_rig.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

const std::string kEverything =
    "format = 1\nhead_end = left\nu_num = 5\nl_num = 20\nharmonics = 8\nmidline = 90,300 500.5,330 880,-290\n"
    "fins = 2\nr_fin_2 = none\nhead = 1.5,2\nlow_axis_3 = 700,320\nl_fin = 300,500\njun_tl = 1,2\nmirror = yes\n"
    "tail_fin = no\nflip = yes\ndeformer = affine\n";

std::string refusal(const std::string& text) {
  try {
    (void)parse_corrections("koi.corrections.txt", text);
  } catch (const UserError& e) {
    EXPECT_EQ(e.exit_code, 2);
    const std::string line = e.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_LT(line.size(), 300u) << line;
    return line;
  }
  return "";
}

TEST(CorrectionsText, WhatIsWrittenIsReadBack) {
  const Corrections c = parse_corrections("x", kEverything);
  const std::string text = corrections_text(c);
  EXPECT_EQ(corrections_text(parse_corrections("x", text)), text);
  EXPECT_NE(text.find(kEverything), std::string::npos) << text;  // said in that order
  ASSERT_EQ(c.midline.size(), 3u);
  test::expect_near(c.midline[2], {880, -290}, 0);
  EXPECT_TRUE(c.removed[3]);
  EXPECT_EQ(*c.deformer, MlsKind::affine);
  EXPECT_FALSE(*c.tail_fin);
}

TEST(CorrectionsText, CommentsBlanksAndWindowsLineEndsAreFine) {
  const Corrections c = parse_corrections("x", "# by hand\r\n\r\n  head=1,2 # the snout\r\n\tl_fin = none\r\n");
  test::expect_near(c.moved.at(*point_named("head")), {1, 2}, 0);
  EXPECT_TRUE(c.removed[0]);
  EXPECT_TRUE(parse_corrections("x", "").empty());
  EXPECT_TRUE(Corrections{}.empty());
}

TEST(CorrectionsText, MistakesAreOneLineWithTheLineNumberAndWhatIsAllowed) {
  EXPECT_EQ(refusal("\nhaed = 1,2"), "koi.corrections.txt:2: there is no 'haed'; did you mean head?");
  EXPECT_EQ(refusal("u_num = 9"), "koi.corrections.txt:1: u_num must be a whole number from 1 to 8, not '9'");
  EXPECT_EQ(refusal("head"), "koi.corrections.txt:1: write key = value, such as head = 900,300, not 'head'");
  EXPECT_EQ(refusal("head = 1"),
            "koi.corrections.txt:1: head must be x,y in pixels of the figure, such as 512,80.5, not '1'");
  EXPECT_EQ(refusal("mirror = 1"), "koi.corrections.txt:1: mirror must be yes or no, not '1'");
  EXPECT_EQ(refusal("deformer = bone"),
            "koi.corrections.txt:1: deformer must be rigid, similarity or affine, not 'bone'");
  EXPECT_EQ(refusal("head_end = north"),
            "koi.corrections.txt:1: head_end must be left, right, up, down or x,y near the head, not 'north'");
  EXPECT_EQ(
      refusal("midline = 1,1"),
      "koi.corrections.txt:1: midline needs at least two points x,y, head first, such as 900,300 500,310 100,300");
  EXPECT_EQ(refusal("head = 1,2\n\nhead = 1,3"), "koi.corrections.txt:3: head was given in line 1 already");
  EXPECT_EQ(refusal("format = 2"),
            "koi.corrections.txt:1: format: these corrections are newer than this program; update neontetra");
  for (const char* bad :
       {"head = nan,1", "head = 1,inf", "head = 1e9,1", "head = 1,2,3", "head = 1 ,2", "= 1", "fins = 3", "fins = -1",
        "l_num = 15.0", "centre = none", "midline = 1,1 1,1", "jun_tl = none"})
    EXPECT_NE(refusal(bad), "") << bad;
  EXPECT_NE(refusal(std::string(300'000, '#')), "");
  std::string long_line = "midline =";
  for (int i = 0; i <= kMostMidlinePoints; ++i) long_line += " " + std::to_string(i) + ",1";
  EXPECT_NE(refusal(long_line), "");
}

TEST(CorrectionsText, ASettingReplacesTheOneBefore) {
  Corrections c;
  set_correction(c, "--set", "l_fin = none");
  set_correction(c, "--set", "l_fin=4,5");
  EXPECT_FALSE(c.removed[0]);
  test::expect_near(c.moved.at(*point_named("l_fin")), {4, 5}, 0);
  set_correction(c, "--set", "jun_tl=4,6");
  set_correction(c, "--set", "l_fin=none");
  EXPECT_TRUE(c.moved.empty());
}

TEST(CorrectionsText, PairsOfFinsReplaceWhatWasSaidOfSingleOnes) {
  Corrections c;
  for (const char* line : {"head=9,9", "l_fin=4,5", "jun_tl=4,6", "r_fin=none", "l_fin_2=7,8"})
    set_correction(c, "--set", line);
  set_correction(c, "--set", "fins=1");
  EXPECT_FALSE(c.removed[kRightFin]);
  EXPECT_EQ(c.moved.size(), 3u);  // head, l_fin, jun_tl
  set_correction(c, "--set", "fins=0");
  ASSERT_EQ(c.moved.size(), 1u);
  test::expect_near(c.moved.at(*point_named("head")), {9, 9}, 0);
  set_correction(c, "--set", "l_fin=4,5");  // the other way round a tip places its fin
  EXPECT_EQ(c.moved.size(), 2u);
}

TEST(CorrectionsText, TheFileStandsBesideTheCharacter) {
  EXPECT_EQ(corrections_path("a/koi.ntchar"), "a/koi.corrections.txt");
  const TempDir dir;
  const std::string path = dir / "koi.corrections.txt";
  const Corrections c = parse_corrections("x", kEverything);
  save_corrections(path, c);
  EXPECT_EQ(corrections_text(load_corrections(path)), corrections_text(c));
  for (const std::string& missing : {dir / "nothing.txt", std::string(dir / ".")}) {
    EXPECT_THROW((void)load_corrections(missing), UserError);
  }
}

// Whatever bytes come: corrections that can be written and read back and applied, or one line.
TEST(CorrectionsText, FuzzedTextIsReadOrRefusedInOneLine) {
  Random random(7);
  const std::string letters = "=,.- \n\t#\r0123456789enoys_afinrtlhdmux\x01\xff";
  int read = 0, refused = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text = round % 4 == 0 ? "" : kEverything;
    for (uint32_t changes = 1 + random.below(6); changes > 0; --changes) {
      const char letter = letters[random.below(static_cast<uint32_t>(letters.size()))];
      const std::size_t at = random.below(static_cast<uint32_t>(text.size() + 1));
      const uint32_t how = random.below(3);
      if (how == 0 || at == text.size()) text.insert(at, 1, letter);
      else if (how == 1) text[at] = letter;
      else text.erase(at, 1 + random.below(20));
    }
    try {
      const Corrections c = parse_corrections("fuzz", text);
      EXPECT_EQ(corrections_text(parse_corrections("again", corrections_text(c))), corrections_text(c));
      ++read;
      (void)corrected(test::straight_rig(), c);
    } catch (const UserError& e) {
      const std::string line = e.what();
      ASSERT_EQ(std::count_if(line.begin(), line.end(), [](char ch) { return ch < ' ' || ch > '~'; }), 0) << line;
      ++refused;
    }
  }
  EXPECT_GT(read, 500);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace nt
