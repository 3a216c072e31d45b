// SPDX-License-Identifier: Apache-2.0
#include "app/author/marker_places.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "platform/camera.h"

namespace nt {

bool is_marker_places(const std::string& path) { return path.ends_with(".txt") || path.ends_with(".markers"); }

std::vector<MarkerSpec> parse_marker_places(const std::string& text, const std::string& name,
                                            const TriangleMesh& mesh) {
  std::vector<MarkerSpec> out;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto bad = [&](const std::string& what) {
      return UserError(name + ", line " + std::to_string(number) + ": " + what);
    };
    std::istringstream in(line.substr(0, line.find('#')));
    MarkerSpec marker;
    if (!(in >> marker.name)) continue;
    std::vector<double> values;
    for (double v = 0; in >> v;) values.push_back(v);
    if (!in.eof() || (values.size() != 1 && values.size() != 3)) throw bad("NAME X Y Z or NAME VERTEX is wanted");
    if (values.size() == 3) {
      marker.position = {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
    } else {
      if (!(values[0] >= 0 && values[0] < static_cast<double>(mesh.positions.size()))) {
        throw bad("the mesh has vertices 0 to " + std::to_string(mesh.positions.size() - 1));
      }
      marker.position = mesh.positions[static_cast<std::size_t>(values[0])];
    }
    if (std::any_of(out.begin(), out.end(), [&](const MarkerSpec& m) { return m.name == marker.name; })) {
      throw bad("there is a marker '" + marker.name + "' already");
    }
    out.push_back(marker);
  }
  if (out.empty()) throw UserError(name + " has no marker in it");
  return out;
}

std::vector<MarkerSpec> read_marker_places(const std::string& path, const TriangleMesh& mesh) {
  std::ifstream in(path);
  if (!in) throw UserError("cannot read " + path + "; is the name right?");
  return parse_marker_places(std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>()), path,
                             mesh);
}

}  // namespace nt
