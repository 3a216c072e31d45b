// SPDX-License-Identifier: Apache-2.0
#include "app/author/proposal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>

#include "app/author/figure.h"
#include "app/author/inner_axis.h"
#include "platform/camera.h"

namespace nt {
namespace {

// A figure drawn with OpenCV, and what load_figure would make of it.
struct Drawn {
  cv::Mat rgba{cv::Mat::zeros(500, 900, CV_8UC4)}, mask{cv::Mat::zeros(500, 900, CV_8U)};
  std::vector<Vec2> outline;
  void ellipse(cv::Point at, cv::Size axes, double angle = 0) {
    cv::ellipse(mask, at, axes, angle, 0, 360, 255, cv::FILLED);
  }
  void polygon(const std::vector<cv::Point>& points) {
    cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{points}, 255);
  }
  void polyline(const std::vector<cv::Point>& points, int thick) { cv::polylines(mask, points, false, 255, thick); }
  void eye(cv::Point at, int radius) { eyes_.push_back({at, radius}); }
  Proposal propose(const std::optional<ToldHead>& told = {}) {
    rgba.setTo(cv::Scalar(240, 180, 60, 255), mask);
    for (const auto& [at, radius] : eyes_)
      cv::circle(rgba, at, radius, cv::Scalar(20, 20, 20, 255), cv::FILLED, cv::LINE_AA);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    outline.clear();
    for (const cv::Point p : contours.at(0)) outline.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
    return propose_landmarks("drawn", mask, rgba, outline, told, LandmarkSettings{});
  }

 private:
  std::vector<std::pair<cv::Point, int>> eyes_;
};

std::vector<Vec2> axis_of(const FishPose& p) {
  std::vector<Vec2> line{p.head};
  for (int i = p.u_num - 1; i >= 0; --i) line.push_back(p.up_axis[i]);
  line.push_back(p.centre);
  line.insert(line.end(), p.low_axis, p.low_axis + p.l_num);
  line.push_back(p.tail);
  return line;
}

// The axis's points, and between them nearly.
void expect_inside(const cv::Mat& mask, const FishPose& p) {
  const std::vector<Vec2> line = axis_of(p);
  std::vector<Vec2> dense;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    for (int k = 0; k < 8; ++k) dense.push_back(lerp(line[i], line[i + 1], static_cast<float>(k) / 8));
  }
  dense.push_back(line.back());
  EXPECT_TRUE(inside_figure(mask, line));
  // Chords cut a curl's corners by a few pixels.
  cv::Mat grown;
  cv::dilate(mask, grown, cv::getStructuringElement(cv::MORPH_ELLIPSE, {13, 13}));
  EXPECT_TRUE(inside_figure(grown, dense));
}

Drawn side_fish() {  // thin head to the left, deep body and forked tail to the right
  Drawn d;
  d.polygon({{80, 250},
             {300, 130},
             {520, 130},
             {640, 230},
             {760, 150},
             {730, 250},
             {760, 350},
             {640, 270},
             {520, 370},
             {300, 370}});
  return d;
}

TEST(Proposal, AnEyeTellsTheHead) {
  Drawn left = side_fish();
  left.eye({170, 235}, 14);
  const Proposal a = left.propose();
  EXPECT_LT(a.pose.head.x, 150);
  EXPECT_GT(a.pose.tail.x, 650);
  EXPECT_GT(a.pose.confidence.head, 0.5f);
  EXPECT_TRUE(a.has_tail_fin);
  expect_inside(left.mask, a.pose);
}

TEST(Proposal, WithoutAnEyeTheTailFinTellsButLess) {
  Drawn blind = side_fish(), seeing = side_fish();
  seeing.eye({170, 235}, 14);
  const Proposal a = blind.propose();
  EXPECT_LT(a.pose.head.x, 150);
  EXPECT_LE(a.pose.confidence.head, seeing.propose().pose.confidence.head);
}

TEST(Proposal, AForkedTailEndsInItsNotch) {
  Drawn d = side_fish();
  d.eye({170, 235}, 14);
  const Proposal a = d.propose();
  EXPECT_NEAR(a.pose.tail.x, 735, 25);
  EXPECT_NEAR(a.pose.tail.y, 250, 25);
}

TEST(Proposal, TheUserIsBelieved) {
  Drawn d = side_fish();
  d.eye({170, 235}, 14);
  ToldHead told;
  told.direction = {1, 0};
  const Proposal a = d.propose(told);
  EXPECT_GT(a.pose.head.x, a.pose.tail.x);
  EXPECT_GT(a.pose.confidence.head, 0.9f);
  told.point = Vec2{90, 250};
  EXPECT_LT(d.propose(told).pose.head.x, 150);
}

TEST(Proposal, ACurledFigureKeepsItsMidlineInside) {
  Drawn d;  // a bow, thick at one end
  for (int k = 0; k <= 200; k += 2) {
    const double a = k * CV_PI / 180;
    d.ellipse({450 + static_cast<int>(160 * std::cos(a)), 250 + static_cast<int>(160 * std::sin(a))},
              {58 - k / 5, 58 - k / 5});
  }
  const Proposal a = d.propose();
  expect_inside(d.mask, a.pose);
  EXPECT_FALSE(a.by_capture);
  EXPECT_GT(a.pose.axis_len, 480);                      // round the bow (560), not across (315)
  EXPECT_LT(length(a.pose.head - Vec2{610, 190}), 90);  // the thick end
}

TEST(Proposal, ASymmetricFigureLiesAlongItsMirrorLine) {
  Drawn d;  // a body with a head and two long arms: the way from hand to hand is the longest
  d.ellipse({450, 110}, {60, 60});
  d.polygon({{400, 150}, {500, 150}, {480, 460}, {420, 460}});
  d.polyline({{420, 200}, {250, 220}, {90, 180}}, 40);
  d.polyline({{480, 200}, {650, 220}, {810, 180}}, 40);
  d.eye({430, 100}, 8), d.eye({470, 100}, 8);
  const Proposal a = d.propose();
  EXPECT_NEAR(a.pose.head.x, 450, 25);
  EXPECT_LT(a.pose.head.y, 80);
  EXPECT_NEAR(a.pose.tail.x, 450, 25);
  ASSERT_TRUE(a.fins[kLeftFin].present && a.fins[kRightFin].present);
  EXPECT_LT(a.fins[kLeftFin].tip.x, 120);  // swims up the picture: its left is the picture's left
  EXPECT_GT(a.fins[kRightFin].tip.x, 780);
  EXPECT_LT(a.fins[kLeftFin].top.y, a.fins[kLeftFin].bottom.y);
}

TEST(Proposal, FourLegsAreTwoPairsOfFins) {
  Drawn d;
  d.ellipse({400, 250}, {260, 70});
  d.polyline({{600, 250}, {860, 250}}, 24);  // a long tail
  for (const int y : {60, 440}) {
    d.polyline({{260, 250}, {240, y}}, 34);
    d.polyline({{510, 250}, {530, y}}, 34);
  }
  d.eye({180, 225}, 9), d.eye({180, 275}, 9);
  const Proposal a = d.propose();
  EXPECT_LT(a.pose.head.x, 160);
  for (const FinPoints& fin : a.fins) EXPECT_TRUE(fin.present);
  EXPECT_NEAR(a.fins[kLeftFin].tip.x, 240, 30);  // the first pair is nearer to the head
  EXPECT_NEAR(a.fins[kSecondRightFin].tip.x, 530, 30);
  EXPECT_GT(a.fins[kLeftFin].tip.y, 400);  // swims to the left: its left is down
}

TEST(Proposal, EveryControlPointHasAConfidence) {
  Drawn d = side_fish();
  d.eye({170, 235}, 14);
  const Proposal a = d.propose();
  ASSERT_EQ(a.confidences.size(), 3u + 3 + 15 + 3 * kMaxFins);
  for (std::size_t i = 0; i < 21; ++i) EXPECT_GT(a.confidences[i], 0.0f) << i;
  for (const float c : a.confidences) EXPECT_TRUE(c >= 0 && c <= 1);
  for (std::size_t i = 0; i < kMaxFins; ++i) EXPECT_EQ(a.confidences[21 + 3 * i] > 0, a.fins[i].present) << i;
}

TEST(Proposal, DoubtsAreOneLineEach) {
  Drawn d;  // a disc has no head
  d.ellipse({450, 250}, {200, 190});
  const Proposal a = d.propose();
  expect_inside(d.mask, a.pose);
  bool head = false;
  for (const std::string& line : doubts_about(a)) {
    EXPECT_EQ(line.find('\n'), std::string::npos);
    head = head || line.find("--head") != std::string::npos;
  }
  EXPECT_TRUE(head);
}

TEST(Proposal, NoMidlineOfASharedDrawingLeavesItsFigureAndTheFishSwimHeadFirst) {
  const std::filesystem::path folder = std::string(NEONTETRA_SHARED_DATA) + "/drawings";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data";
  // Which way the head lies, as a person sees it: -1 left, 1 right, -2 up.
  const std::map<std::string, int> heads{
      {"noto_fish", -1},      {"noto_tropical_fish", -1}, {"noto_shark", -1},     {"noto_whale", -1},
      {"noto_dolphin", -1},   {"noto_lizard_top", -2},    {"noto_merperson", -2}, {"noto_lobster_top", -2},
      {"noto_sunflower", -2}, {"oc_clown_loach", -1},     {"oc_brown_fish", 1},   {"oc_giraffe_cichlid", 1},
      {"oc_orca", -1},        {"oc_angelfish", 1},        {"noto_shrimp", -1},    {"handdrawn_char1_texture", -2}};
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".png" || name.find("mask") != std::string::npos) continue;
    SCOPED_TRACE(name);
    ++pictures;
    const Figure figure = load_figure(entry.path().string());
    const Proposal a = propose_landmarks(name, figure.mask, figure.rgba, figure.outline, {}, LandmarkSettings{});
    expect_inside(figure.mask, a.pose);
    if (!heads.contains(name)) continue;
    const Vec2 way = a.pose.head - a.pose.tail;
    const int where = heads.at(name);
    EXPECT_TRUE(where == -1 ? way.x < 0 : where == 1 ? way.x > 0 : way.y < 0);
  }
  EXPECT_EQ(pictures, 19);
}

}  // namespace
}  // namespace nt
