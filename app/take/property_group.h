// SPDX-License-Identifier: Apache-2.0
// Words for the numbers of a motion: each property's own name (core/motion/property.h), and groups: up_axis, low_axis,
// body (both, head and tail), fins, path.
#pragma once
#include <string>
#include <vector>

#include "core/motion/property.h"

namespace nt {

std::vector<MotionProperty> properties_of(const std::string& word);  // empty: no such word
std::vector<std::string> property_words();                           // of a motion of the default 3 and 15 bones

}  // namespace nt
