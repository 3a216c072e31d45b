// SPDX-License-Identifier: Apache-2.0
#include "app/export/bvh.h"

#include <cstdio>
#include <vector>

#include "core/base/det_math.h"

namespace nt {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

class Writer {
 public:
  Writer(const FishShape& shape, double length_units)
      : shape_(shape), unit_(length_units / static_cast<double>(shape.axis_len())) {}

  std::string hierarchy() {
    text_ = "HIERARCHY\nROOT centre\n{\n";
    offset(0, 0);
    text_ += "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
    chain("up_axis_", shape_.u_num, shape_.up_len, "head", shape_.head_len, -1);
    chain("low_axis_", shape_.l_num, shape_.low_len, "tail", shape_.tail_len, 1);
    fin("l_fin", shape_.l_front, shape_.l_fin_len);
    fin("r_fin", shape_.r_front, shape_.r_fin_len);
    return text_ + "}\n";
  }

  // One line: the root's position and turn, then each joint's turn against its parent.
  std::string frame(const Motion& m) {
    text_.clear();
    number(m.centre.x * unit_), number(0), number(m.centre.y * unit_);
    turn(-(m.dir_rad + det::kHalfPi));
    const auto bones = [&](const float* angles, int count, float end, float straight) {
      float parent = straight;
      for (int i = 0; i < count; ++i) turn(angles[i] - parent), parent = angles[i];
      turn(end - parent);
    };
    bones(m.up_axis_angle, shape_.u_num, m.head_angle, det::kHalfPi);
    bones(m.low_axis_angle, shape_.l_num, m.tail_angle, -det::kHalfPi);
    if (shape_.l_fin_len > 0) turn(m.l_fin_angle + det::kHalfPi);
    if (shape_.r_fin_len > 0) turn(m.r_fin_angle + det::kHalfPi);
    text_.back() = '\n';
    return text_;
  }

 private:
  void number(double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.6f ", value);
    text_ += digits;
  }
  void turn(float about_y_rad) { number(0), number(0), number(static_cast<double>(about_y_rad) * kDegrees); }
  // x to the right, z back, pixels.
  void offset(float x, float z) {
    text_ += "OFFSET ";
    number(x * unit_), number(0), number(z * unit_);
    text_.back() = '\n';
  }
  void open(const std::string& name, float x, float z) {
    text_ += "JOINT " + name + "\n{\n";
    offset(x, z);
    text_ += "CHANNELS 3 Zrotation Xrotation Yrotation\n";
  }
  void end(float z) {
    text_ += "End Site\n{\n";
    offset(0, z);
    text_ += "}\n";
  }
  // Bones along z, each joint where the bone before it ends.
  void chain(const std::string& name, int count, const float* lengths, const char* last, float last_length,
             float side) {
    float at = 0;
    for (int i = 0; i < count; ++i) {
      open(name + std::to_string(i + 1), 0, side * at);
      at = lengths[i];
    }
    open(last, 0, side * at);
    end(side * last_length);
    for (int i = 0; i <= count; ++i) text_ += "}\n";
  }
  void fin(const char* name, Vec2 root, float length) {
    if (length <= 0) return;
    open(name, root.x, -root.y);
    end(length);
    text_ += "}\n";
  }

  const FishShape& shape_;
  double unit_;
  std::string text_;
};

}  // namespace

std::string bvh(std::span<const Motion> motions, const FishShape& shape, double fps, double length_units) {
  Writer writer(shape, length_units);
  std::string text = writer.hierarchy();
  char head[80];
  std::snprintf(head, sizeof head, "MOTION\nFrames: %zu\nFrame Time: %.9f\n", motions.size(), 1 / fps);
  text += head;
  for (const Motion& motion : motions) text += writer.frame(motion);
  return text;
}

}  // namespace nt
