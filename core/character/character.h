// SPDX-License-Identifier: Apache-2.0
// A character: a drawing cut into triangles, with the control points of [F] section 5 in its rest pose.
//
// This is a view onto the bytes of a character file (docs/FORMATS.md): the file is mapped or read once and used as it
// is, without parsing or copying. `open_character` checks magic, version, sizes, every index and the checksum, and
// refuses what does not fit with one line.
//
// Frame of reference: character units = pixels of the drawing; origin at the rest pose's centre, x to the character's
// right, y towards its head (so y is up, as in the fish-local frame of core/motion/motion.h). u_num and l_num are the
// character's own; retargeting resamples the motion when the capture used others.
// Cost: O(file size) once for the checks.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/landmarks/fish_pose.h"
#include "core/scene/scene.h"

namespace nt {

// [F] Eq 12, in character units and axes. A character without fins has has_l_fin / has_r_fin false.
struct ControlPoints {
  Vec2 centre, head, tail;
  Vec2 up_axis[kMaxUpAxis];
  Vec2 low_axis[kMaxLowAxis];
  Vec2 jun_tl, jun_tr, jun_bl, jun_br;
  Vec2 l_fin, r_fin;
};

struct Character {
  int u_num = 3, l_num = 15;
  bool has_l_fin = false, has_r_fin = false;
  ControlPoints rest;
  std::span<const Vec2> vertices;       // rest pose, character units
  std::span<const Vec2> texcoords;      // [0, 1], v down
  std::span<const uint32_t> triangles;  // three indices each
  Picture texture;                      // rgba8
};

// `bytes` must start on a 64-byte line and outlive the Character.
Result<Character> open_character(std::span<const std::byte> bytes, const Limits& limits);

}  // namespace nt
