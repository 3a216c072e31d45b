// SPDX-License-Identifier: Apache-2.0
#include "app/author/assemble.h"

namespace nt {

Character character_of(const Proposal& proposal, const CharacterFrame& local, const LandmarkSettings& settings) {
  const FishPose& pose = proposal.pose;
  Character character;
  character.u_num = settings.u_num, character.l_num = settings.l_num, character.harmonics = settings.harmonics;
  character.has_tail_fin = proposal.has_tail_fin;
  character.figure = {pose.centre, pose.dir, false};
  character.confidences = proposal.confidences;
  ControlPoints& c = character.rest;
  c.centre = local(pose.centre), c.head = local(pose.head), c.tail = local(pose.tail);
  for (int i = 0; i < pose.u_num; ++i) c.up_axis[i] = local(pose.up_axis[i]);
  for (int i = 0; i < pose.l_num; ++i) c.low_axis[i] = local(pose.low_axis[i]);
  for (int i = 0; i < kMaxFins; ++i) {
    const FinPoints& fin = proposal.fins[i];
    if (fin.present) c.fins[i] = {true, local(fin.top), local(fin.bottom), local(fin.tip)};
  }
  return character;
}

Picture picture_of(const cv::Mat& rgba) {
  Picture picture;
  picture.pixels = rgba.data, picture.width = rgba.cols, picture.height = rgba.rows;
  picture.stride = static_cast<int>(rgba.step), picture.format = PixelFormat::rgba8;
  return picture;
}

}  // namespace nt
