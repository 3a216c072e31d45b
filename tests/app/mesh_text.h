// SPDX-License-Identifier: Apache-2.0
// Small meshes as text of OBJ files, for tests: a fish of an ellipsoid body with a fin at either side and a tail fin.
#pragma once
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace nt {

struct ObjText {
  std::string text;
  int vertices = 0;
  void vertex(double x, double y, double z) {
    char line[96];
    std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", x, y, z);
    text += line;
    ++vertices;
  }
  void face(int a, int b, int c) {
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  }
};

// Head towards +x, y up, 2 units long, as fine as `rings`.
inline ObjText fish_obj(int rings = 16) {
  ObjText obj;
  const int segments = rings;
  const double pi = 3.14159265358979;
  for (int i = 0; i <= rings; ++i) {
    const double t = static_cast<double>(i) / rings, x = 1 - 1.7 * t;
    const double r = 0.02 + 0.24 * std::sin(pi * std::pow(t, 0.7));  // widest before the middle
    for (int k = 0; k < segments; ++k) {
      const double a = 2 * pi * k / segments;
      obj.vertex(x, (a < pi ? 1.25 : 1.0) * r * std::sin(a), r * std::cos(a));  // a high back, a low belly
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < segments; ++k) {
      const int a = i * segments + k + 1, b = i * segments + (k + 1) % segments + 1;
      obj.face(a, b, b + segments);
      obj.face(a, b + segments, a + segments);
    }
  }
  for (const int side : {-1, 1}) {  // fins: sheets from the flank outwards and back
    const int first = obj.vertices + 1;
    obj.vertex(0.45, 0, side * 0.2), obj.vertex(0.25, 0, side * 0.2);
    obj.vertex(0.0, 0, side * 0.62), obj.vertex(0.12, 0, side * 0.66);
    obj.face(first, first + 1, first + 2), obj.face(first, first + 2, first + 3);
  }
  const int tail = obj.vertices + 1;
  obj.vertex(-0.66, 0, 0), obj.vertex(-1, 0, 0.22), obj.vertex(-0.9, 0, 0), obj.vertex(-1, 0, -0.22);
  obj.face(tail, tail + 1, tail + 2), obj.face(tail, tail + 2, tail + 3);
  return obj;
}

}  // namespace nt
