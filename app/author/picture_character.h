// SPDX-License-Identifier: Apache-2.0
// A picture of a fish (or of anything with a head and a tail) -> the bytes of a character file. Off the frame path.
//
// Steps, [F] sections 3.2 and 5: the figure and its outline (figure.h) -> landmarks (proposal.h) ->
// control points in character units (core/character/character.h: pixels of the texture, origin at the centre, x right, y
// towards the head) -> triangles (triangulate.h) -> texture. Cost: 0.1 to 1 s.
// Errors: UserError with one line.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/author/proposal.h"
#include "core/base/vec3.h"

namespace nt {

// Where the head is, when the drawing's shape leaves a doubt.
struct HeadSide {
  Vec2 direction;                // unit, picture axes (y down); used when there is no point
  std::optional<Vec2> fraction;  // a point in the picture, as shares of its width and height
};
// "left", "right", "up", "down" or "X,Y" in shares of the picture (0.9,0.5 is at the right). Throws UserError.
HeadSide parse_head_side(const std::string& text);

struct PictureOptions {
  std::optional<HeadSide> head;
  int u_num = 3, l_num = 15;  // axis samples, [F] section 7; its flower uses l_num 25
  int harmonics = 5;          // S
  int vertices = 2500;        // wanted; what comes out is within a few per cent
};

struct PictureReport {
  int vertices = 0, triangles = 0;
  int texture_width = 0, texture_height = 0;
  bool from_alpha = false;
  std::string made_from;           // in words
  Proposal proposal;               // landmarks in texture pixels (y down), with confidences
  std::vector<std::string> notes;  // one line each, for the user: "left fin not seen", ...
};

// Where a point of a mesh file lies in the character's figure: pixels of the top view and the height, both in one unit.
struct FigureFromFile {
  Vec3 x, y, z;  // rows of a turn and a scale
  Vec3 shift;
  Vec3 operator()(Vec3 p) const { return Vec3{dot(x, p), dot(y, p), dot(z, p)} + shift; }
};

struct AuthoredCharacter {
  std::vector<std::byte> bytes;
  PictureReport report;
  FigureFromFile figure_from_file;  // of a mesh
};

AuthoredCharacter author_picture(const std::string& path, const PictureOptions& options);

}  // namespace nt
