// SPDX-License-Identifier: Apache-2.0
// Frames of a take whose every number is different, for the tests of takes.
#pragma once
#include "app/take/take.h"

namespace nt {

inline TakeInfo test_take_info() {
  TakeInfo info;
  info.name = "noon", info.camera = "sim:scene=calm", info.created = "2026-11-22T09:30:00Z", info.tags = "carp, test";
  info.source_width = 1920, info.source_height = 1088, info.width = 960, info.height = 544;
  info.fps = 30;
  return info;
}

inline TakeFrame test_take_frame(int64_t number, int fish = 0) {
  const float n = static_cast<float>(number % 1000);
  TakeFrame frame;
  frame.frame = number, frame.fish = fish, frame.flags = static_cast<uint32_t>(number % 4), frame.init_len = 300 + n;
  Motion& m = frame.motion;
  m.time_ns = number * 33'333'333;
  m.status = number % 7 == 3 ? PoseStatus::lost : PoseStatus::ok;
  m.centre = {n, -n}, m.dir_rad = 0.01f * n;
  m.head_angle = 1.5f + 0.001f * n, m.tail_angle = -1.5f, m.l_fin_angle = -1.0f, m.r_fin_angle = -2.0f - 0.001f * n;
  for (int i = 0; i < m.u_num; ++i) m.up_axis_angle[i] = 1.5f + 0.1f * static_cast<float>(i);
  for (int i = 0; i < m.l_num; ++i) m.low_axis_angle[i] = -1.5f + 0.01f * static_cast<float>(i) + 0.0001f * n;
  m.confidence = {1, 0.9f, 0.8f, 0.7f, 0.6f, 0.5f};
  FishPose& p = frame.pose;
  p.status = m.status, p.confidence = m.confidence;
  p.centre = {n, 1}, p.dir = {0, -1}, p.head = {n, 2}, p.tail = {n, 3}, p.l_fin = {4, n}, p.r_fin = {5, n};
  p.jun_tl = {6, 6}, p.jun_tr = {7, 7}, p.jun_bl = {8, 8}, p.jun_br = {9, 9};
  for (int i = 0; i < p.u_num; ++i) p.up_axis[i] = {10, static_cast<float>(i)};
  for (int i = 0; i < p.l_num; ++i) p.low_axis[i] = {11, static_cast<float>(i) + n};
  p.axis_len = 301;
  return frame;
}

}  // namespace nt
