// SPDX-License-Identifier: Apache-2.0
// Which markers of a recording are used, and how its axes lie: options that several commands share.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "app/mocap/marker_file.h"

namespace CLI {
class App;
}

namespace nt {

struct MarkerChoice {
  std::string only;     // names, or how names begin, separated by commas; all where it is empty
  std::string axes;     // registration.h, parse_axes; "" tries all
  int64_t frame = 0;    // where the actor stands as the mesh does
  bool mirror = false;  // a right hand's recording for a left one
};

void add_marker_choice(CLI::App& command, MarkerChoice& choice);

// The recording, its mirror image if that is asked for.
MarkerFile read_recording(const std::string& path, const MarkerChoice& choice);

// Throws UserError (code 2) when there is none, or when the file ends before the frame.
std::vector<std::size_t> chosen_markers(const MarkerFile& file, const MarkerChoice& choice);

}  // namespace nt
