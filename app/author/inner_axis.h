// SPDX-License-Identifier: Apache-2.0
// A midline that stays inside its figure: a path between two ends, made smooth and central. Off the frame path.
//
// Frame: the mask's pixels. Cost: a few milliseconds.
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <span>

#include "app/author/shape.h"
#include "core/outline/midline.h"

namespace nt {

// Whether every point of the polyline lies in the mask, its two ends within a few pixels of it.
bool inside_figure(const cv::Mat& mask, std::span<const Vec2> line);

struct InnerAxis {
  Axis axis;
  StationValues body;  // half widths without what stands out at the sides
};

// `outline` clockwise on the screen. With `twin`, the other corner of the tail fin, the axis ends half-way between both.
InnerAxis inner_axis(const cv::Mat& mask, std::span<const Vec2> outline, const Path& path, std::optional<Vec2> twin);

// At each station 0 to 1: how near to the middle between the flanks the axis runs there.
StationValues centredness(const cv::Mat& mask, const Axis& axis, const StationValues& body);

// The body's half widths along any axis.
StationValues body_along(const cv::Mat& mask, std::span<const Vec2> outline, const Axis& axis);

}  // namespace nt
