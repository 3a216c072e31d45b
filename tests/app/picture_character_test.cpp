// SPDX-License-Identifier: Apache-2.0
#include "app/author/picture_character.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "app/aligned_block.h"
#include "app/author/character_file.h"
#include "app/author/triangulate.h"
#include "core/character/retarget.h"
#include "platform/camera.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

const std::string kCarp = std::string(NEONTETRA_ASSETS) + "/characters/carp.png";

const AuthoredCharacter& carp() {
  static const AuthoredCharacter authored = author_picture(kCarp, {});
  return authored;
}

class PictureCharacter : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return dir_ / name; }
  std::string picture(const std::string& name, const cv::Mat& image) const {
    cv::imwrite(path(name), image);
    return path(name);
  }
  // The one line that author_picture refuses a picture with; empty when it does not.
  static std::string refusal(const std::string& file, const PictureOptions& options = {}) {
    try {
      (void)author_picture(file, options);
    } catch (const UserError& e) {
      return e.what();
    }
    return "";
  }
  static void expect_one_line(const std::string& line, const std::string& part) {
    EXPECT_NE(line.find(part), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  TempDir dir_;
};

// A leaf with a fork, head to the left, without fins.
cv::Mat leaf(int channels) {
  cv::Mat image(300, 600, channels == 4 ? CV_8UC4 : CV_8UC3,
                channels == 4 ? cv::Scalar(0, 0, 0, 0) : cv::Scalar(250, 250, 250));
  const cv::Scalar ink = channels == 4 ? cv::Scalar(40, 90, 200, 255) : cv::Scalar(40, 90, 200);
  cv::ellipse(image, {260, 150}, {200, 60}, 0, 0, 360, ink, cv::FILLED);
  const std::vector<cv::Point> fork{{430, 150}, {560, 80}, {530, 150}, {560, 220}};
  cv::fillPoly(image, std::vector<std::vector<cv::Point>>{fork}, ink);
  return image;
}

TEST_F(PictureCharacter, TheCarpHasTheVerticesAskedFor) {
  EXPECT_GE(carp().report.vertices, 2000);
  EXPECT_LE(carp().report.vertices, 3000);
  EXPECT_TRUE(carp().report.from_alpha);
  EXPECT_TRUE(carp().report.notes.empty()) << carp().report.notes.front();
  EXPECT_LE(std::max(carp().report.texture_width, carp().report.texture_height), 1024);
}

TEST_F(PictureCharacter, TheCarpsTrianglesAllHavePositiveAreaAndFillItsOutline) {
  const LoadedCharacter loaded(carp().bytes, "carp", Limits{});
  const Character& c = loaded.character();
  double area = 0;
  std::set<uint32_t> used;
  for (std::size_t i = 0; i < c.triangles.size(); i += 3) {
    const Vec2 a = c.vertices[c.triangles[i]], b = c.vertices[c.triangles[i + 1]], d = c.vertices[c.triangles[i + 2]];
    const float twice = cross(b - a, d - a);
    ASSERT_GT(twice, 0.0f);
    area += 0.5 * static_cast<double>(twice);
    used.insert(c.triangles.begin() + static_cast<std::ptrdiff_t>(i),
                c.triangles.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  }
  EXPECT_EQ(used.size(), c.vertices.size());
  const cv::Mat rgba(c.texture.height, c.texture.width, CV_8UC4, const_cast<uint8_t*>(c.texture.pixels));
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  const double opaque = cv::countNonZero(alpha >= 128);
  EXPECT_GT(area, opaque);  // the mesh covers the soft edge too
  EXPECT_LT(area, opaque * 1.06);
}

TEST_F(PictureCharacter, TheCarpsLandmarksAreWhereTheyWereDrawn) {
  // Places of make_carp.py in its 1024x640 picture: snout (978, 320), notch of the tail (126, 320), fins about (620, 320 +- 240)
  // on roots of 30 px about x 772; the crop starts at the tail's tips (x 24) and the fins' (y 82), less the margin.
  const FishPose& p = carp().report.proposal.pose;
  const Vec2 origin{24 - 2 - 8, 82 - 2 - 8};
  const auto expect_at = [&](Vec2 p_texture, Vec2 drawn, float tolerance) {
    EXPECT_NEAR(p_texture.x + origin.x, drawn.x, tolerance);
    EXPECT_NEAR(p_texture.y + origin.y, drawn.y, tolerance);
  };
  expect_at(p.head, {978, 320}, 15);
  expect_at(p.tail, {126, 320}, 15);
  expect_at(p.l_fin, {620, 80}, 25);  // swims to the right: its left is up
  expect_at(p.r_fin, {620, 560}, 25);
  expect_at(p.jun_tl, {787, 238}, 12);
  expect_at(p.jun_tr, {787, 402}, 12);
  expect_at(p.jun_bl, {757, 235}, 20);
  expect_at(p.jun_br, {757, 405}, 20);
  for (int i = 0; i < p.l_num; ++i) EXPECT_NEAR(p.low_axis[i].y + origin.y, 320, 8);
  EXPECT_GT(p.dir.x, 0.99f);
}

TEST_F(PictureCharacter, TheCarpsControlPointsAreInCharacterUnits) {
  const LoadedCharacter loaded(carp().bytes, "carp", Limits{});
  const ControlPoints& c = loaded.character().rest;
  EXPECT_NEAR(length(c.centre), 0, 1e-3f);
  EXPECT_GT(c.head.y, 300);
  EXPECT_LT(c.tail.y, -400);
  EXPECT_LT(c.fins[kLeftFin].tip.x, -200);
  EXPECT_GT(c.fins[kRightFin].tip.x, 200);
  EXPECT_GT(c.fins[kLeftFin].top.y, c.fins[kLeftFin].bottom.y);
}

// The carp on the stage, not smoothed, upright, its head up.
class StagedCarp {
 public:
  StagedCarp() : loaded_(carp().bytes, "carp", Limits{}) {
    RetargetSettings settings;
    settings.smooth = false;
    Arena measure;
    (void)Retarget::create(measure, loaded_.character(), settings);
    memory_ = AlignedBlock(measure.used());
    Arena arena(memory_.bytes());
    retarget_ = Retarget::create(arena, loaded_.character(), settings).value();
    retarget_->start(retarget_->lengths().body_len);
  }
  Retarget* operator->() { return retarget_; }
  // Triangles that a pose turns over; the scene's y is down, so the sense of all changes.
  int inverted(const Motion& motion) {
    retarget_->pose(motion, 0, {});
    const Character& c = loaded_.character();
    const auto twice = [&](std::span<const Vec2> v, std::size_t i) {
      return cross(v[c.triangles[i + 1]] - v[c.triangles[i]], v[c.triangles[i + 2]] - v[c.triangles[i]]);
    };
    int count = 0;
    for (std::size_t i = 0; i < c.triangles.size(); i += 3) {
      if (twice(c.vertices, i) * twice(retarget_->vertices(), i) >= 0) ++count;
    }
    return count;
  }

 private:
  LoadedCharacter loaded_;
  AlignedBlock memory_;
  Retarget* retarget_ = nullptr;
};

TEST_F(PictureCharacter, TheCarpsFinsFoldAndOpenAsFarAsAFishs) {
  StagedCarp stage;
  for (const FinRange r : {stage->fin_range(kLeftFin), stage->fin_range(kRightFin)}) {
    EXPECT_LE(r.folded, 0.42f);
    EXPECT_GE(r.open, 1.5f - 1e-4f);
    EXPECT_GT(r.width(), 1.1f);  // of kFishFins' 1.2: amplitudes are kept
  }
}

TEST_F(PictureCharacter, NoFinAngleTurnsATriangleOfTheCarpOver) {
  StagedCarp stage;
  Motion m = stage->rest_motion();
  for (float angle = -4.0f; angle < 4.0f; angle += 0.1f) {
    m.l_fin_angle = angle;
    m.r_fin_angle = -2.0f * angle;
    ASSERT_EQ(stage.inverted(m), 0) << angle;
  }
}

TEST_F(PictureCharacter, TransparentPixelsBesideTheFigureHaveItsColour) {
  const LoadedCharacter loaded(carp().bytes, "carp", Limits{});
  const Picture& t = loaded.character().texture;
  int dark = 0;
  for (int i = 0; i < t.width * t.height; ++i) {
    const uint8_t* p = t.pixels + 4 * i;
    if (p[3] < 128 && p[0] + p[1] + p[2] < 60) ++dark;
  }
  EXPECT_EQ(dark, 0);
}

TEST_F(PictureCharacter, TheSamePictureGivesTheSameBytes) { EXPECT_EQ(carp().bytes, author_picture(kCarp, {}).bytes); }

TEST_F(PictureCharacter, OptionsReachTheFile) {
  PictureOptions options;
  options.u_num = 2, options.l_num = 25, options.vertices = 600;
  const AuthoredCharacter a = author_picture(kCarp, options);
  const LoadedCharacter loaded(a.bytes, "carp", Limits{});
  EXPECT_EQ(loaded.character().u_num, 2);
  EXPECT_EQ(loaded.character().l_num, 25);
  EXPECT_NEAR(a.report.vertices, 600, 60);
}

TEST_F(PictureCharacter, TheHeadGoesWhereTheUserSays) {
  const std::string file = picture("leaf.png", leaf(4));
  for (const char* said : {"right", "left", "0.95,0.5", "0.05,0.5"}) {
    PictureOptions options;
    options.head = parse_head_side(said);
    const bool right = std::string(said) == "right" || said[2] == '9';
    const FishPose p = author_picture(file, options).report.proposal.pose;
    EXPECT_EQ(p.head.x > p.tail.x, right) << said;
  }
  for (const char* wrong : {"", "front", "1.5,0.2", "0.5", "0.5,0.5,1", "nan,0"}) {
    EXPECT_THROW((void)parse_head_side(wrong), UserError) << wrong;
  }
}

TEST_F(PictureCharacter, WithoutFinsTheReportSaysSo) {
  const AuthoredCharacter a = author_picture(picture("leaf.png", leaf(4)), {});
  EXPECT_FALSE(LoadedCharacter(a.bytes, "leaf", Limits{}).character().rest.fins[kLeftFin].present);
  ASSERT_EQ(a.report.notes.size(), 2u);
  expect_one_line(a.report.notes[0], "left fin not seen");
}

TEST_F(PictureCharacter, WithoutTransparencyTheEdgesCutItOut) {
  const AuthoredCharacter a = author_picture(picture("leaf.jpg", leaf(3)), {});
  EXPECT_FALSE(a.report.from_alpha);
  EXPECT_GE(a.report.vertices, 2000);
  EXPECT_NEAR(std::abs(a.report.proposal.pose.head.x - a.report.proposal.pose.tail.x), 470, 25);  // 60 to 530
}

TEST_F(PictureCharacter, WhatIsNoPictureOfAFigureGetsOneLine) {
  expect_one_line(refusal(path("none.png")), "no such file");
  expect_one_line(refusal(path("")), "not a picture");
  std::ofstream(path("text.png")) << "this is text\n";
  expect_one_line(refusal(path("text.png")), "not a picture");
  std::ofstream(path("empty.png"));
  expect_one_line(refusal(path("empty.png")), "not a picture");
  expect_one_line(refusal(picture("dot.png", cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 0, 0)))), "too small");
  expect_one_line(refusal(picture("plain.png", cv::Mat(200, 300, CV_8UC3, cv::Scalar(9, 99, 200)))), "no figure");
  expect_one_line(refusal(picture("clear.png", cv::Mat(200, 300, CV_8UC4, cv::Scalar(9, 99, 200, 0)))), "no figure");
}

TEST_F(PictureCharacter, ATruncatedPictureIsRefusedOrRead) {
  std::ifstream in(kCarp, std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  for (const std::size_t n : {8u, 60u, 2000u}) {
    std::ofstream(path("cut.png"), std::ios::binary) << all.substr(0, n);
    EXPECT_NE(refusal(path("cut.png")), "") << n;
  }
}

TEST_F(PictureCharacter, BadOptionsAreUsageErrors) {
  PictureOptions options;
  options.l_num = 33;
  try {
    (void)author_picture(kCarp, options);
    FAIL();
  } catch (const UserError& e) {
    EXPECT_EQ(e.exit_code, 2);
  }
}

TEST_F(PictureCharacter, AFileThatCannotBeWrittenLeavesNothing) {
  EXPECT_THROW(write_character_file(path("no/such/folder.ntchar"), carp().bytes), UserError);
  write_character_file(path("carp.ntchar"), carp().bytes);
  EXPECT_EQ(LoadedCharacter(path("carp.ntchar"), Limits{}).character().u_num, 3);
  EXPECT_FALSE(std::filesystem::exists(path("carp.ntchar.part")));
  EXPECT_THROW(LoadedCharacter(path("gone.ntchar"), Limits{}), UserError);
  EXPECT_THROW(LoadedCharacter(kCarp, Limits{}), UserError);
}

TEST(Triangulate, KeepsEveryOutlineEdgeOfANarrowShape) {
  // A dumb-bell whose bar is far thinner than the triangles: the outline must be sampled finer there.
  std::vector<Vec2> outline;
  const auto line = [&](Vec2 a, Vec2 b) {
    const int n = static_cast<int>(length(b - a));
    for (int i = 0; i < n; ++i) outline.push_back(lerp(a, b, static_cast<float>(i) / static_cast<float>(n)));
  };
  const std::vector<Vec2> corners{{0, 0},     {200, 0},   {200, 97},  {500, 97},  {500, 0},   {700, 0},
                                  {700, 200}, {500, 200}, {500, 103}, {200, 103}, {200, 200}, {0, 200}};
  for (std::size_t i = 0; i < corners.size(); ++i) line(corners[i], corners[(i + 1) % corners.size()]);
  const Triangulation t = triangulate(outline, 400);
  std::set<std::pair<uint32_t, uint32_t>> edges;
  double area = 0;
  for (std::size_t i = 0; i < t.triangles.size(); i += 3) {
    const uint32_t* k = &t.triangles[i];
    for (int e = 0; e < 3; ++e) edges.insert(std::minmax(k[e], k[(e + 1) % 3]));
    const float twice = cross(t.vertices[k[1]] - t.vertices[k[0]], t.vertices[k[2]] - t.vertices[k[0]]);
    EXPECT_GT(twice, 0.0f);
    area += 0.5 * static_cast<double>(twice);
  }
  for (uint32_t i = 0; i < t.outline_count; ++i) {
    const uint32_t next = (i + 1) % static_cast<uint32_t>(t.outline_count);
    EXPECT_TRUE(edges.contains(std::minmax(i, next))) << i;
  }
  EXPECT_NEAR(area, 2 * 200 * 200 + 300 * 6, 800);
}

TEST(Triangulate, RefusesAnOutlineThatCrossesItself) {
  std::vector<Vec2> eight;
  for (int i = 0; i < 400; ++i) {
    const double a = 6.283185307 * i / 400;
    eight.push_back({static_cast<float>(200 * std::sin(a)), static_cast<float>(100 * std::sin(2 * a))});
  }
  EXPECT_THROW((void)triangulate(eight, 300), TriangulationError);
}

}  // namespace
}  // namespace nt
