// SPDX-License-Identifier: Apache-2.0
// A BVH is read back by a small reader that knows the format and nothing of us; its joints must lie on the poses' points.
#include "app/export/bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "app/export/pose_table.h"
#include "core/motion/property.h"

namespace nt {
namespace {

struct Joint {
  std::string name;
  int parent = -1;
  double x = 0, y = 0, z = 0;
  int channels = 0, first_channel = 0;
};

struct Scene3 {
  std::vector<Joint> joints;
  std::vector<std::vector<double>> frames;
  double frame_time = 0;
};

Scene3 read_bvh(const std::string& text) {
  std::istringstream in(text);
  Scene3 scene;
  std::string word;
  std::vector<int> open;
  int next = -1, channels = 0;
  while (in >> word && word != "MOTION") {
    if (word == "ROOT" || word == "JOINT" || word == "End") {
      Joint joint;
      in >> joint.name;
      if (word == "End") joint.name = scene.joints[static_cast<std::size_t>(open.back())].name + "_end";
      joint.parent = open.empty() ? -1 : open.back();
      next = static_cast<int>(scene.joints.size());
      scene.joints.push_back(joint);
    } else if (word == "{") {
      open.push_back(next);
    } else if (word == "}") {
      open.pop_back();
    } else if (word == "OFFSET") {
      Joint& joint = scene.joints.back();
      in >> joint.x >> joint.y >> joint.z;
    } else if (word == "CHANNELS") {
      Joint& joint = scene.joints.back();
      in >> joint.channels;
      joint.first_channel = channels;
      channels += joint.channels;
      for (int i = 0; i < joint.channels; ++i) in >> word;
    }
  }
  std::size_t frames = 0;
  in >> word >> frames >> word >> word >> scene.frame_time;
  scene.frames.assign(frames, std::vector<double>(static_cast<std::size_t>(channels)));
  for (auto& frame : scene.frames)
    for (double& value : frame) in >> value;
  return scene;
}

// World x and z of each joint; all turns are about y, as the file's own words say.
std::map<std::string, std::pair<double, double>> positions(const Scene3& scene, std::size_t frame) {
  std::map<std::string, std::pair<double, double>> at;
  std::vector<double> turn(scene.joints.size()), px(scene.joints.size()), pz(scene.joints.size());
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    const auto* c = scene.frames[frame].data() + joint.first_channel;
    const double own = joint.channels > 0 ? c[joint.channels - 1] * 3.14159265358979 / 180 : 0;
    if (joint.parent < 0) {
      px[j] = c[0], pz[j] = c[2], turn[j] = own;
    } else {
      const auto p = static_cast<std::size_t>(joint.parent);
      const double s = std::sin(turn[p]), k = std::cos(turn[p]);
      px[j] = px[p] + k * joint.x + s * joint.z;
      pz[j] = pz[p] - s * joint.x + k * joint.z;
      turn[j] = turn[p] + own;
    }
    at[joint.name] = {px[j], pz[j]};
  }
  return at;
}

// A take of a fish whose bones keep their lengths: bent, turning, one fin out.
std::vector<TakeFrame> bending(int count) {
  FishShape shape;
  shape.head_len = 20, shape.tail_len = 9;
  for (float& len : shape.up_len) len = 25;
  for (float& len : shape.low_len) len = 10;
  shape.l_fin_len = 40, shape.r_fin_len = 42;
  shape.l_front = {-18, 40}, shape.l_back = {-20, 25}, shape.r_front = {17, 41}, shape.r_back = {21, 24};
  std::vector<TakeFrame> frames(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    TakeFrame& frame = frames[static_cast<std::size_t>(i)];
    const float t = static_cast<float>(i);
    frame.frame = i;
    Motion& m = frame.motion = straight_motion(3, 15);
    m.status = PoseStatus::ok, m.confidence = {1, 1, 1, 1, 1, 1};
    m.centre = {300 + t, 200 - 2 * t}, m.dir_rad = 0.3f * t;
    m.head_angle += 0.2f * std::sin(t), m.tail_angle += 0.5f * std::cos(t), m.l_fin_angle = -2.5f + 0.1f * t,
                                                                            m.r_fin_angle = -0.4f;
    for (int b = 0; b < 15; ++b) m.low_axis_angle[b] += 0.05f * static_cast<float>(b) * std::sin(t);
    frame.pose = pose_of(m, shape);
  }
  return frames;
}

TEST(FishShape, FindsTheBonesAndTheFinsAgain) {
  const std::vector<TakeFrame> frames = bending(20);
  const FishShape shape = fish_shape(frames);
  for (const TakeFrame& frame : frames) {
    const FishPose again = pose_of(frame.motion, shape);
    for (Vec2 FishPose::*point :
         {&FishPose::head, &FishPose::tail, &FishPose::l_fin, &FishPose::r_fin, &FishPose::jun_bl})
      EXPECT_LT(length(again.*point - frame.pose.*point), 0.05f);
    EXPECT_LT(length(again.low_axis[7] - frame.pose.low_axis[7]), 0.05f);
  }
  EXPECT_NEAR(shape.axis_len(), 20 + 75 + 150 + 9, 0.01f);
}

TEST(Bvh, JointsLieOnThePoints) {
  const std::vector<TakeFrame> frames = bending(12);
  const FishShape shape = fish_shape(frames);
  std::vector<Motion> motions;
  for (const TakeFrame& frame : frames) motions.push_back(frame.motion);
  const Scene3 scene = read_bvh(bvh(motions, shape, 25, 2.0));
  ASSERT_EQ(scene.frames.size(), 12u);
  EXPECT_NEAR(scene.frame_time, 0.04, 1e-9);
  const double unit = 2.0 / static_cast<double>(shape.axis_len());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    auto at = positions(scene, i);
    const FishPose& pose = frames[i].pose;
    const auto expect = [&](const std::string& joint, Vec2 point) {
      ASSERT_TRUE(at.contains(joint)) << joint;
      EXPECT_NEAR(at[joint].first, static_cast<double>(point.x) * unit, 2e-3) << joint << " in " << i;
      EXPECT_NEAR(at[joint].second, static_cast<double>(point.y) * unit, 2e-3) << joint << " in " << i;
    };
    expect("centre", pose.centre), expect("head_end", pose.head), expect("tail_end", pose.tail);
    expect("up_axis_3", pose.up_axis[1]), expect("low_axis_15", pose.low_axis[13]), expect("tail", pose.low_axis[14]);
    expect("l_fin", pose.jun_tl), expect("l_fin_end", pose.l_fin), expect("r_fin_end", pose.r_fin);
  }
}

TEST(Bvh, AFishWithoutFinsHasNoFinJoints) {
  std::vector<TakeFrame> frames = bending(3);
  for (TakeFrame& frame : frames) frame.pose.confidence.l_fin = frame.pose.confidence.r_fin = 0;
  const FishShape shape = fish_shape(frames);
  const Scene3 scene = read_bvh(bvh(std::vector<Motion>{frames[0].motion}, shape, 25, 1));
  for (const Joint& joint : scene.joints) EXPECT_EQ(joint.name.find("fin"), std::string::npos);
}

TEST(PoseTable, HasThreeHeaderRowsAndAsManyCells) {
  std::vector<FishPose> poses;
  for (const TakeFrame& frame : bending(5)) poses.push_back(frame.pose);
  poses[2].status = PoseStatus::lost;
  poses[3].confidence.l_fin = 0;
  std::istringstream table(pose_table(poses, 2.0f));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(table, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_EQ(rows[0][0], "scorer");
  EXPECT_EQ(rows[1][0], "bodyparts");
  EXPECT_EQ(rows[2][0], "coords");
  for (const auto& row : rows) EXPECT_EQ(row.size(), 1 + 3 * 23u);
  EXPECT_EQ(rows[1][1], "head");
  EXPECT_NEAR(std::stod(rows[3][1]), (static_cast<double>(poses[0].head.x) + 0.5) * 2 - 0.5, 1e-3);
  EXPECT_EQ(rows[5][1], "");
  EXPECT_EQ(rows[5][3], "0");
}

}  // namespace
}  // namespace nt
