// SPDX-License-Identifier: Apache-2.0
// A point or a direction in space, float.
#pragma once

namespace nt {

struct Vec3 {
  float x = 0.0f;
  float y = 0.0f;
  float z = 0.0f;
};

}  // namespace nt
