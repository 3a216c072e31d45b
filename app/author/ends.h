// SPDX-License-Identifier: Apache-2.0
// Which two ends of a figure are its head and its tail. A drawing has no swimming direction, so the shape must tell.
//
// Shape, eye-like spots, and what the user said -> the two ends, the way between them inside the figure, and how sure.
// Candidates are the ends of the figure's parts, and where its mirror line leaves it. A pair of them counts by how long
// and thick the way between them is, by lying on the mirror line of a symmetric figure, and by having the eyes near
// one of them. Of the pair, the head is the end with the eyes, the wider half, and not the one with a caudal fin (a narrow
// stem, then wider). Confidence: the log odds of these, and how far the next best pair is behind.
#pragma once
#include <optional>
#include <vector>

#include "app/author/eyes.h"
#include "app/author/shape.h"

namespace nt {

// Where the user says the head is: a point in the figure's pixels, or a direction (unit).
struct ToldHead {
  std::optional<Vec2> point;
  Vec2 direction;
};

struct FigureEnds {
  Path path;                      // from head to tail
  std::optional<Vec2> tail_twin;  // where the path ends at one corner of a tail fin, the other
  double head_confidence = 0;     // that the head is at this end; 0 a guess, 1 sure
  double ends_confidence = 0;     // that these two are the ends
  double mirror_likeness = 0;
  bool on_mirror = false;  // the ends lie on the figure's mirror line
  bool has_tail_fin = false;
};

// Throws nothing; a figure without two ends gives an empty path.
FigureEnds find_figure_ends(const Shape& shape, const cv::Mat& mask, const std::vector<EyeSpot>& eyes,
                            const std::optional<ToldHead>& told);

}  // namespace nt
