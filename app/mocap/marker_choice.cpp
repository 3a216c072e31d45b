// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/marker_choice.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "platform/camera.h"

namespace nt {
namespace {

// A marker's whole name is that one alone (M4, not M40); another word all whose names begin so.
bool picks(const std::string& word, const MarkerFile& file, std::size_t m) {
  if (word.empty()) return false;
  const bool whole = std::find(file.names.begin(), file.names.end(), word) != file.names.end();
  return whole ? file.names[m] == word : file.names[m].starts_with(word);
}

}  // namespace

void add_marker_choice(CLI::App& command, MarkerChoice& choice) {
  command.add_option("--only", choice.only, "markers by their names, or by how those begin, separated by commas")
      ->type_name("NAMES");
  command
      .add_option("--axes", choice.axes,
                  "the recording's axes that are the mesh's x, y, z, such as x,z,-y (default: by trying)")
      ->type_name("AXES");
  command.add_flag("--mirror", choice.mirror, "the recording's mirror image: a right hand's for a left one");
  command
      .add_option("--frame", choice.frame, "of the recording, in which the actor stands as the mesh does (default 0)")
      ->type_name("N");
}

MarkerFile read_recording(const std::string& path, const MarkerChoice& choice) {
  MarkerFile file = read_marker_file(path);
  if (choice.mirror) {
    for (Vec3& p : file.positions) p.x = -p.x;
  }
  return file;
}

std::vector<std::size_t> chosen_markers(const MarkerFile& file, const MarkerChoice& choice) {
  if (choice.frame < 0 || choice.frame >= static_cast<int64_t>(file.frames())) {
    throw UserError("--frame is beyond the file's " + std::to_string(file.frames()) + " frames", 2);
  }
  const std::string& only = choice.only;
  std::vector<std::size_t> out;
  for (std::size_t m = 0; m < file.markers(); ++m) {
    bool wanted = only.empty();
    for (std::size_t from = 0; from < only.size();) {
      const std::size_t to = std::min(only.find(',', from), only.size());
      const std::string word = only.substr(from, to - from);
      wanted = wanted || picks(word, file, m);
      from = to + 1;
    }
    if (wanted) out.push_back(m);
  }
  if (out.empty()) {
    throw UserError("no marker's name begins with --only '" + only + "'; the first is '" + file.names[0] + "'", 2);
  }
  return out;
}

}  // namespace nt
