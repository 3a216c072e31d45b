// SPDX-License-Identifier: Apache-2.0
// How a mesh lies: its own axes -> right, forward, up of a swimmer seen from above. Off the frame path.
//
// Input: the corners of all triangles in the file's axes, what the user says. Output: three orthogonal unit vectors, right-
// handed (right x forward = up); forward is along the body, its sense not known yet unless it was said.
// Method: PCA over the triangles by area ([F] section 5 lays a model down so); the longest axis is forward. Of the
// others, up is the one about which the body is less its own mirror image (left and right are alike, back and belly are
// not); where that does not tell, the one nearer to the file's y, which is up in glTF and most OBJ files, and for
// a body that stands upright the file's z. An axis within 15 degrees of one of the file's is that one. Cost: O(triangles).
#pragma once
#include <optional>
#include <span>
#include <string>

#include "app/author/mesh_soup.h"

namespace nt {

struct MeshAxes {
  Vec3 right{1, 0, 0}, forward{0, 1, 0}, up{0, 0, 1};
  bool head_told = false;
  double symmetry = 0;  // of left and right, 0 to 1
};

struct ToldAxes {
  std::optional<Vec3> head, up;
};

// "+x", "-x", "+y", ... of the file's axes. Throws UserError (code 2); `what` names the option.
Vec3 parse_axis(const std::string& what, const std::string& text);

MeshAxes find_axes(std::span<const SoupCorner> corners, const ToldAxes& told);

// Turns the corners so that x is right, y forward, z up.
void turn_to(std::span<SoupCorner> corners, const MeshAxes& axes);

}  // namespace nt
