// SPDX-License-Identifier: Apache-2.0
#include "app/export/pose_csv.h"

#include <charconv>
#include <span>

#include "app/export/turn_rows.h"
#include "core/base/det_math.h"

namespace nt {
namespace {

void add_fixed(std::string& row, double value, int decimals) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr;
  row += ',';
  row.append(digits, end);
}

void add_point(std::string& row, bool seen, Vec2 at) {
  if (!seen) {
    row += ",,";
    return;
  }
  add_fixed(row, at.x, 3);
  add_fixed(row, at.y, 3);
}

void add_axis_names(std::string& header, const char* name, int count) {
  for (int i = 1; i <= count; ++i) {
    const std::string column = name + std::to_string(i);
    header += "," + column + "_x," + column + "_y";
  }
}

}  // namespace

std::string pose_csv_header(int u_num, int l_num, bool in_mm) {
  std::string header = "frame,t_s,status,centre_x,centre_y,dir_rad";
  for (const char* point : {"head", "tail", "l_fin", "r_fin", "jun_tl", "jun_tr", "jun_bl", "jun_br"}) {
    header += std::string(",") + point + "_x," + point + "_y";
  }
  add_axis_names(header, "up_axis_", u_num);
  add_axis_names(header, "low_axis_", l_num);
  for (const char* group : {"centre", "head", "tail", "l_fin", "r_fin", "axis"}) {
    header += std::string(",") + group + "_confidence";
  }
  if (in_mm) {
    for (const char* point : {"centre", "head", "tail", "l_fin", "r_fin"})
      header += std::string(",") + point + "_x_mm," + point + "_y_mm";
    header += ",length_mm";
  }
  return header + "\n";
}

PoseCsv::PoseCsv(const std::string& path, float scale, const Calibration& calibration, int u_num, int l_num)
    : path_(path), file_(path), u_num_(u_num), l_num_(l_num), scale_(scale), calibration_(calibration) {
  file_.write(pose_csv_header(u_num, l_num, calibration.px_per_mm > 0));
}

// Of the head; a lens turns it a little.
Vec2 PoseCsv::direction(const FishPose& pose) const {
  return calibration_.lens ? out(pose.centre + pose.dir) - out(pose.centre) : pose.dir;
}

void PoseCsv::add_mm(const FishPose& pose, const PoseConfidence& seen) {
  const auto mm_per_px = static_cast<float>(1 / calibration_.px_per_mm);
  const auto point = [&](float confidence, Vec2 p) { add_point(row_, confidence > 0, out(p) * mm_per_px); };
  point(seen.centre, pose.centre);
  point(seen.head, pose.head);
  point(seen.tail, pose.tail);
  point(seen.l_fin, pose.l_fin);
  point(seen.r_fin, pose.r_fin);
  if (seen.axis <= 0) {
    row_ += ',';
    return;
  }
  float sum = 0;
  Vec2 last = out(pose.head);
  const auto go_to = [&](Vec2 p) {
    const Vec2 at = out(p);
    sum += length(at - last);
    last = at;
  };
  for (int i = pose.u_num - 1; i >= 0; --i) go_to(pose.up_axis[i]);
  go_to(pose.centre);
  for (int i = 0; i < pose.l_num; ++i) go_to(pose.low_axis[i]);
  go_to(pose.tail);
  add_fixed(row_, sum * mm_per_px, 3);
}

int64_t PoseCsv::look_back() {
  order_.trace_back(steps_);
  return turn_rows(path_, steps_, u_num_, l_num_);
}

void PoseCsv::add(int64_t frame, int64_t time_ns, const FishPose& pose, const OrderStep& order) {
  const bool ok = pose.ok();
  if (ok) steps_.push_back(order_.add(order));
  const PoseConfidence seen = ok ? pose.confidence : PoseConfidence{};
  row_ = std::to_string(frame);
  add_fixed(row_, static_cast<double>(time_ns) * 1e-9, 6);
  row_ += std::string(",") + to_string(pose.status);
  const auto point = [&](float confidence, Vec2 p) { add_point(row_, confidence > 0, out(p)); };
  point(seen.centre, pose.centre);
  if (ok) {
    const Vec2 dir = direction(pose);
    last_dir_rad_ = det::unwrap(det::atan2(dir.y, dir.x), last_dir_rad_);
    add_fixed(row_, last_dir_rad_, 5);
  } else {
    row_ += ',';
  }
  point(seen.head, pose.head);
  point(seen.tail, pose.tail);
  point(seen.l_fin, pose.l_fin);
  point(seen.r_fin, pose.r_fin);
  point(seen.l_fin, pose.jun_tl);  // a junction is found from its fin's tip
  point(seen.r_fin, pose.jun_tr);
  point(seen.l_fin, pose.jun_bl);
  point(seen.r_fin, pose.jun_br);
  for (int i = 0; i < pose.u_num; ++i) point(seen.axis, pose.up_axis[i]);
  for (int i = 0; i < pose.l_num; ++i) point(seen.axis, pose.low_axis[i]);
  for (float c : {seen.centre, seen.head, seen.tail, seen.l_fin, seen.r_fin, seen.axis}) add_fixed(row_, c, 3);
  if (calibration_.px_per_mm > 0) add_mm(pose, seen);
  row_ += '\n';
  file_.write(row_);
}

}  // namespace nt
