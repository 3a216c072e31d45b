// SPDX-License-Identifier: Apache-2.0
// Recorded marker positions: C3D, TRC, Qualisys TSV, CSV.
//
// Input: a file; its kind follows from its ending, C3D also from its key byte. Output: names, rate, and every frame's
// positions in millimetres, in the recorder's own axes; a marker that was not seen has NaN.
// C3D is read by our own few lines (Debian has no library for it): floats and scaled integers of Intel files, labels from
// POINT:LABELS and LABELS2 where they can be read, else M1, M2, ... Parameters are stepped over by their own lengths, so a record
// that is damaged inside harms nothing but itself.
// A text file's missing marker is an empty field, nan, or three zeros.
// CSV: one header row of name_x, name_y, name_z (or name X, ...); a column `time` or `frame` is left out.
// Errors: UserError with one line.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec3.h"

namespace nt {

struct MarkerFile {
  std::vector<std::string> names;
  double rate_hz = 0.0;
  std::vector<Vec3> positions;     // frame after frame, names.size() each
  std::vector<std::string> notes;  // what was odd, one line each

  std::size_t markers() const { return names.size(); }
  std::size_t frames() const { return names.empty() ? 0 : positions.size() / names.size(); }
  std::span<const Vec3> frame(std::size_t f) const { return std::span(positions).subspan(f * markers(), markers()); }
};

bool is_seen(Vec3 p);

MarkerFile read_marker_file(const std::string& path);

// The parts of it, for tests: `name` goes into the messages.
MarkerFile parse_c3d(std::span<const std::byte> bytes, const std::string& name);
MarkerFile parse_marker_text(const std::string& text, const std::string& name);

}  // namespace nt
