// SPDX-License-Identifier: Apache-2.0
// A character taken apart so that its control points can be corrected, and put together again. Off the frame path.
//
// Input: a character. The mesh is kept in figure pixels (core/character/character.h, FigureFrame), where it stays while
// control points move. Output: the character with other control points: another origin, another direction, the same mesh,
// texture and triangles. The control points it came with are found().
// Proposing anew looks at the mesh's silhouette from above with the code that looks at pictures. Cost: proposing about
// 0.3 s, putting together well under 1 ms for 2,500 vertices.
#pragma once
#include <span>
#include <vector>

#include "app/author/corrections.h"
#include "app/author/rig.h"
#include "core/base/vec3.h"
#include "core/character/character.h"

namespace nt {

// A character and what it points to; texture, heights and texture coordinates are those of the figure, which must outlive it.
struct RiggedCharacter {
  std::vector<float> confidences;
  std::vector<Vec2> vertices;
  std::vector<Vec3> normals;
  std::vector<uint32_t> triangles;
  Character character;
};

class RiggedFigure {
 public:
  // The texture's pixels must outlive this.
  explicit RiggedFigure(const Character& character);

  const Rig& found() const { return found_; }
  // What corrections are applied to: found(), or proposed anew where they ask for another S.
  Rig found_for(const Corrections& corrections) const;
  // `now` says how many axis points there are and which end is the head.
  Rig propose(const Rig& now, int harmonics) const;
  RiggedCharacter with(const Rig& rig) const;

  std::span<const Vec2> vertices() const { return vertices_; }  // figure pixels
  std::span<const Vec2> texcoords() const { return texcoords_; }
  // In painting order: of a solid those that are nearest to the viewer above come last.
  std::span<const uint32_t> triangles() const { return triangles_; }
  const Picture& texture() const { return texture_; }
  bool solid() const { return !heights_.empty(); }
  Vec2 corner() const { return corner_; }  // of the box around the vertices
  Vec2 size() const { return size_; }

 private:
  void sort_by_height();

  std::vector<Vec2> vertices_, texcoords_;
  std::vector<float> heights_;
  std::vector<Vec3> normals_;  // x, y along the figure's axes
  std::vector<uint32_t> triangles_;
  Picture texture_;
  Vec2 dir_;  // the figure's main axis
  Vec2 corner_, size_;
  Rig found_;
};

}  // namespace nt
