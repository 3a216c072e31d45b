// SPDX-License-Identifier: Apache-2.0
// Poses as comma-separated values, one row a frame; the columns are documented in docs/FORMATS.md.
//
// Points are in pixels of the source video (with a lens file: of the ideal picture, see app/calibration.h), y down; empty where they were not seen. dir_rad is kept continuous from row
// to row. The tank's truth is written by the same code, so the two files compare column by column.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "app/calibration.h"
#include "app/text_file.h"
#include "core/landmarks/fish_pose.h"
#include "core/motion/order.h"

namespace nt {

// `in_mm`: with the columns in millimetres, which a known scale adds at the end.
std::string pose_csv_header(int u_num, int l_num, bool in_mm = false);

// Working pixels -> pixels of the source video: both count from the first pixel's centre.
inline Vec2 to_source(Vec2 p, float scale) { return {(p.x + 0.5f) * scale - 0.5f, (p.y + 0.5f) * scale - 0.5f}; }
inline Vec2 to_working(Vec2 p, float scale) { return {(p.x + 0.5f) / scale - 0.5f, (p.y + 0.5f) / scale - 0.5f}; }

class PoseCsv {
 public:
  // `scale` = source width / working width.
  PoseCsv(const std::string& path, float scale, const Calibration& calibration = {}, int u_num = 3, int l_num = 15);
  // `order` (core's, of this pose) is kept for look_back(): a byte a row.
  void add(int64_t frame, int64_t time_ns, const FishPose& pose, const OrderStep& order = {});
  void close() { file_.close(); }
  // After close(): goes over the whole recording once more and turns the rows whose head was the tail. Returns how many.
  int64_t look_back();

 private:
  Vec2 out(Vec2 p) const { return calibration_.ideal(to_source(p, scale_)); }
  Vec2 direction(const FishPose& pose) const;
  void add_mm(const FishPose& pose, const PoseConfidence& seen);
  std::string path_;
  TextFile file_;
  OrderPass order_;
  std::vector<uint8_t> steps_;  // one a pose
  int u_num_, l_num_;
  float scale_;
  Calibration calibration_;
  float last_dir_rad_ = 0;
  std::string row_;
};

}  // namespace nt
