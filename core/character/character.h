// SPDX-License-Identifier: Apache-2.0
// A character: a drawing or a solid model cut into triangles, with the control points of [F] section 5 in its rest pose.
//
// This is a view onto the bytes of a character file (docs/FORMATS.md): the file is mapped or read once and used as it
// is, without parsing or copying. `open_character` checks magic, version, sizes, every index and the checksum, and
// refuses what does not fit with one line.
//
// Frame of reference: character units = pixels of the drawing (of the top view of a solid); origin at the rest pose's
// centre, x to the character's right, y towards its head (so y is up, as in the fish-local frame of core/motion/motion.h),
// z towards the viewer above. Control points lie at z = 0. Triangles run anticlockwise seen from outside (from above for a
// drawing); solids may have open sheets, fins say, so both sides are shown. u_num, l_num and S are the character's own;
// retargeting resamples the motion when the capture used others.
// Cost: O(file size) once for the checks.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/base/vec3.h"
#include "core/deform/embed.h"
#include "core/deform/lattice_view.h"
#include "core/deform/mls.h"
#include "core/landmarks/fish_pose.h"
#include "core/scene/scene.h"

namespace nt {

// The fins of a character: none, one pair, or two. Left and right as the character has them, seen from above. Of two pairs
// the first is the one nearer to the head.
enum FinIndex : int { kLeftFin, kRightFin, kSecondLeftFin, kSecondRightFin, kMaxFins };

struct FinPoints {
  bool present = false;
  Vec2 top, bottom;  // fin-body junctions on the head's side and on the tail's
  Vec2 tip;
};

// [F] Eq 12, in character units and axes.
struct ControlPoints {
  Vec2 centre, head, tail;
  Vec2 up_axis[kMaxUpAxis];
  Vec2 low_axis[kMaxLowAxis];
  FinPoints fins[kMaxFins];
};

// Where character units lie in the figure: pixels of the picture that was cut out, or of a solid's top view, x right, y down.
// Control points that are corrected move the origin of character units; the figure stays.
struct FigureFrame {
  Vec2 centre;          // of the origin
  Vec2 dir{0, -1};      // unit; where y leads to
  bool mirror = false;  // the character is the figure's mirror image: x leads to the left of dir
};

// What moves a character's lattice: markers of a recording or a hand, or the control points of the fish.
enum class LatticeDrive : uint8_t { markers, landmarks };

// A control lattice around a solid ([L], core/deform/lattice.h), in character units: x, y as the vertices', z as the heights'.
// With `landmarks` its markers are the control points that Retarget moves, in Retarget's order, and its skeleton is the midline.
struct CharacterLattice {
  LatticeDrive drive = LatticeDrive::markers;
  LatticeView view;
  EmbeddingView embedding;
  std::span<const uint32_t> slots;  // of each vertex of the character: four a block of the embedding
  std::span<const char> names;      // of the markers, then of the joints, each ended by a 0
  bool present() const { return !view.vertices.empty(); }
};

struct Character {
  int u_num = 3, l_num = 15;
  int harmonics = 5;         // S
  bool has_tail_fin = true;  // false: the tail is the end of the body itself (a flower's stem, a lizard)
  MlsKind deformer = MlsKind::rigid;
  FigureFrame figure;
  ControlPoints rest;
  std::span<const float> confidences;   // one per control point in the file's order; 1 = sure or set by hand
  std::span<const Vec2> vertices;       // rest pose, character units
  std::span<const float> heights;       // z of the vertices; empty for a drawing
  std::span<const Vec3> normals;        // of the vertices at rest, outwards; empty for a drawing
  std::span<const Vec2> texcoords;      // [0, 1], v down
  std::span<const uint32_t> triangles;  // three indices each
  Picture texture;                      // rgba8
  CharacterLattice lattice;             // of some solids

  bool solid() const { return !heights.empty(); }
};

// `bytes` must start on a 64-byte line and outlive the Character.
Result<Character> open_character(std::span<const std::byte> bytes, const Limits& limits);

}  // namespace nt
