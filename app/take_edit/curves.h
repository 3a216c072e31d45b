// SPDX-License-Identifier: Apache-2.0
// The few numbers of a motion that an animator works with, by plain names: what the take editor shows as curves.
//
// Values as people read them: angles in degrees from the rest pose (a straight fish with folded fins; both fins open
// upwards), the course in degrees, positions in pixels of the working frame.
#pragma once
#include <string>
#include <vector>

#include "core/motion/property.h"

namespace nt {

struct NamedCurve {
  const char* name;
  MotionProperty property;
  const char* group;  // what smooth and exaggerate take together with it: a word of app/take/property_group.h
};

// Eleven: course, position, and from head to tail the joints and fins. `bones`: how many there are.
std::vector<NamedCurve> named_curves(const Motion& bones);

// "Left fin"; of a joint that has no curve of its own "Tail joint 7".
std::string plain_name(MotionProperty property, const std::vector<NamedCurve>& curves);
const char* group_of(MotionProperty property);

float degrees_or_pixels(float value, MotionProperty property, const Motion& rest);
float from_degrees_or_pixels(float shown, MotionProperty property, const Motion& rest);
const char* unit_of(MotionProperty property);  // "°", " px"

// How sure the capture was of this number, 0 to 1; 0 where there was no pose.
float confidence_of(const Motion& motion, MotionProperty property);

}  // namespace nt
