// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "app/mocap/marker_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kMostMarkers = 4096;

std::vector<std::string> split(const std::string& line, char by) {
  std::vector<std::string> out;
  std::string field;
  std::istringstream in(line);
  while (std::getline(in, field, by)) {
    while (!field.empty() && (field.back() == '\r' || field.back() == ' ')) field.pop_back();
    field.erase(field.begin(), std::find_if(field.begin(), field.end(), [](char c) { return c != ' '; }));
    out.push_back(field);
  }
  return out;
}

float number(const std::vector<std::string>& row, std::size_t i) {
  if (i >= row.size() || row[i].empty()) return kNone;
  float v = kNone;
  const char* end = row[i].data() + row[i].size();
  const auto [stop, error] = std::from_chars(row[i].data(), end, v);
  return error == std::errc() && stop == end ? v : kNone;
}

void add_row(MarkerFile& out, const std::vector<std::string>& row, const std::vector<std::size_t>& first, float unit) {
  for (const std::size_t c : first) {
    const Vec3 p = unit * Vec3{number(row, c), number(row, c + 1), number(row, c + 2)};
    const bool there = is_seen(p) && !(p.x == 0.0f && p.y == 0.0f && p.z == 0.0f);
    out.positions.push_back(there ? p : Vec3{kNone, kNone, kNone});
  }
}

bool is_blank(const std::vector<std::string>& row) {
  return std::all_of(row.begin(), row.end(), [](const std::string& s) { return s.empty(); });
}

// Columns 3 apart from `from`, one a marker.
std::vector<std::size_t> columns_from(std::size_t from, std::size_t markers) {
  std::vector<std::size_t> out;
  for (std::size_t m = 0; m < markers; ++m) out.push_back(from + 3 * m);
  return out;
}

// Qualisys: NAME<tab>value lines, MARKER_NAMES among them; a `Frame Time ...` row may follow; then numbers.
MarkerFile qualisys(const std::vector<std::string>& lines, const std::string& name) {
  MarkerFile out;
  std::size_t from = 0;
  for (const std::string& line : lines) {
    auto row = split(line, '\t');
    if (row.empty() || is_blank(row)) continue;
    if (row[0] == "FREQUENCY" && row.size() > 1) out.rate_hz = static_cast<double>(number(row, 1));
    if (row[0] == "MARKER_NAMES") out.names.assign(row.begin() + 1, row.end());
    if (row[0] == "Frame") from = 2;
    if (out.names.empty() || !std::isfinite(number(row, 0)) || row.size() < 3) continue;
    while (!out.names.empty() && out.names.back().empty()) out.names.pop_back();
    add_row(out, row, columns_from(from, out.names.size()), 1.0f);
  }
  if (out.names.empty()) throw UserError(name + ": there is no line MARKER_NAMES");
  return out;
}

// TRC: row 2 names the fields of row 3 (DataRate, Units), row 4 has the names, row 5 X1 Y1 Z1 ..., then numbers.
MarkerFile trc(const std::vector<std::string>& lines, const std::string& name) {
  if (lines.size() < 6) throw UserError(name + " is cut short: a TRC file has five lines before its numbers");
  MarkerFile out;
  const auto keys = split(lines[1], '\t'), values = split(lines[2], '\t');
  float unit = 1.0f;
  for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) {
    if (keys[i] == "DataRate") out.rate_hz = static_cast<double>(number(values, i));
    if (keys[i] == "Units") unit = values[i] == "m" ? 1000.0f : values[i] == "cm" ? 10.0f : 1.0f;
  }
  const auto heads = split(lines[3], '\t');
  std::vector<std::size_t> columns;
  for (std::size_t i = 2; i < heads.size(); ++i) {
    if (heads[i].empty()) continue;
    out.names.push_back(heads[i]);
    columns.push_back(i);
  }
  if (out.names.empty()) throw UserError(name + ": the fourth line names no marker");
  for (std::size_t l = 5; l < lines.size(); ++l) {
    const auto row = split(lines[l], '\t');
    if (!row.empty() && std::isfinite(number(row, 0))) add_row(out, row, columns, unit);
  }
  return out;
}

MarkerFile csv(const std::vector<std::string>& lines, const std::string& name) {
  MarkerFile out;
  const auto heads = split(lines[0], ',');
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i + 2 < heads.size(); ++i) {
    const std::string& h = heads[i];
    if (h.size() < 3 || (h.back() != 'x' && h.back() != 'X')) continue;
    const std::string base = h.substr(0, h.size() - 1);
    if (heads[i + 1].substr(0, base.size()) != base || heads[i + 2].substr(0, base.size()) != base) continue;
    out.names.push_back(base.substr(0, base.size() - 1));
    columns.push_back(i);
  }
  if (out.names.empty()) throw UserError(name + ": the first line should name columns like hand_x, hand_y, hand_z");
  double first_time = 0.0, second_time = 0.0;
  const auto time = std::find(heads.begin(), heads.end(), "time");
  for (std::size_t l = 1; l < lines.size(); ++l) {
    const auto row = split(lines[l], ',');
    if (row.empty() || is_blank(row)) continue;
    if (time != heads.end()) {
      const auto t = static_cast<double>(number(row, static_cast<std::size_t>(time - heads.begin())));
      if (out.positions.empty()) first_time = t;
      if (out.positions.size() == out.names.size()) second_time = t;
    }
    add_row(out, row, columns, 1.0f);
  }
  if (second_time > first_time) out.rate_hz = 1.0 / (second_time - first_time);
  return out;
}

}  // namespace

bool is_seen(Vec3 p) {
  constexpr float kFar = 1e7f;
  return std::abs(p.x) < kFar && std::abs(p.y) < kFar && std::abs(p.z) < kFar;
}

MarkerFile parse_marker_text(const std::string& text, const std::string& name) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines.empty()) throw UserError(name + " is empty");
  const bool is_trc = lines[0].rfind("PathFileType", 0) == 0;
  const bool is_qualisys = lines[0].rfind("NO_OF_FRAMES", 0) == 0;
  if (!is_trc && !is_qualisys && lines[0].find(',') == std::string::npos) {
    throw UserError(name + " is no marker file that is known: C3D, TRC, Qualisys TSV or CSV");
  }
  MarkerFile out = is_trc ? trc(lines, name) : is_qualisys ? qualisys(lines, name) : csv(lines, name);
  if (out.names.size() > kMostMarkers) throw UserError(name + " names too many markers");
  if (out.frames() == 0) throw UserError(name + " has no frame in it");
  if (!(out.rate_hz > 0.0 && out.rate_hz < 1e5)) {
    out.rate_hz = 100.0;
    out.notes.push_back("no rate is given: 100 frames a second are assumed");
  }
  return out;
}

MarkerFile read_marker_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw UserError("cannot read " + path + "; is the name right?");
  const std::string data((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (data.size() > 1 && static_cast<unsigned char>(data[1]) == 0x50 && data[0] < 32) {
    return parse_c3d(std::as_bytes(std::span(data)), path);
  }
  if (path.size() > 4 && path.substr(path.size() - 4) == ".c3d") throw UserError(path + " is not a C3D file");
  return parse_marker_text(data, path);
}

}  // namespace nt
