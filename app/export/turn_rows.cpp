// SPDX-License-Identifier: Apache-2.0
#include "app/export/turn_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <system_error>
#include <vector>

#include "app/text_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

struct Point {
  double x = 0, y = 0;
};

// Columns of a row (app/export/pose_csv).
constexpr std::size_t kStatus = 2, kCentre = 3, kDirection = 5, kHead = 6, kTail = 8, kFins = 10, kAxis = 22;
constexpr std::size_t kConfidences = 6, kHeadConfidence = 1, kTailConfidence = 2, kFinConfidence = 3;
// Where the scale is known: millimetres of centre, head, tail and the fins, and the length.
constexpr std::size_t kMillimetres = 11, kHeadMm = 2, kTailMm = 4, kLeftFinMm = 6, kRightFinMm = 8;

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= row.size();) {
    const std::size_t comma = std::min(row.find(',', at), row.size());
    cells.push_back(row.substr(at, comma - at));
    at = comma + 1;
  }
  return cells;
}

std::string joined(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) row += (i > 0 ? "," : "") + cells[i];
  return row;
}

std::string fixed(double value, int decimals) {
  char digits[64];
  return {digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr};
}

bool read(const std::string& cell, double& value) {
  const char* end = cell.data() + cell.size();
  const auto done = std::from_chars(cell.data(), end, value);
  return done.ec == std::errc() && done.ptr == end;
}

bool read(const std::vector<std::string>& cells, std::size_t at, Point& p) {
  return read(cells[at], p.x) && read(cells[at + 1], p.y);
}

// The n points that divide the polyline evenly, its ends left out.
std::vector<Point> divided(const std::vector<Point>& line, int n) {
  const auto step = [&](std::size_t i) { return std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y); };
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += step(i);
  std::vector<Point> out;
  double walked = 0;
  for (std::size_t i = 1; i < line.size() && static_cast<int>(out.size()) < n; ++i) {
    const double here = step(i);
    while (static_cast<int>(out.size()) < n) {
      const double want = length * static_cast<double>(out.size() + 1) / (n + 1);
      if (want > walked + here && i + 1 < line.size()) break;
      const double u = here > 0 ? std::min((want - walked) / here, 1.0) : 0.0;
      out.push_back({line[i - 1].x + (line[i].x - line[i - 1].x) * u, line[i - 1].y + (line[i].y - line[i - 1].y) * u});
    }
    walked += here;
  }
  return out;
}

double near_to(double angle, double last) {
  return angle + 2 * std::numbers::pi * std::round((last - angle) / (2 * std::numbers::pi));
}

// The direction column goes on from row to row through the turned ones.
void keep_continuous(std::string& row, double& last) {
  std::vector<std::string> cells = cells_of(row);
  double angle = 0;
  if (cells.size() <= kDirection || !read(cells[kDirection], angle)) return;
  last = near_to(angle, last);
  cells[kDirection] = fixed(last, 5);
  row = joined(cells);
}

bool has_pose(const std::string& row) {
  const std::vector<std::string> cells = cells_of(row);
  return cells.size() > kStatus && cells[kStatus] == "ok";
}

void write_turned(const std::string& path, const std::string& other, std::span<const uint8_t> turned, int u_num,
                  int l_num) {
  std::ifstream in(path);
  TextFile out(other, TextFile::Kind::whole);
  std::string row;
  std::size_t pose = 0;
  double last = 0;
  while (std::getline(in, row)) {
    if (has_pose(row) && pose < turned.size() && turned[pose++] != 0) row = turned_row(row, u_num, l_num);
    keep_continuous(row, last);
    out.write(row + "\n");
  }
  out.close();
}

}  // namespace

std::string turned_row(const std::string& row, int u_num, int l_num) {
  std::vector<std::string> cells = cells_of(row);
  const std::size_t up = static_cast<std::size_t>(u_num), low = static_cast<std::size_t>(l_num);
  const std::size_t confidences = kAxis + 2 * (up + low);
  const std::size_t mm = confidences + kConfidences;
  if (cells.size() != mm && cells.size() != mm + kMillimetres) return row;
  Point centre, p;
  double direction = 0;
  std::vector<Point> ahead, behind;  // from the centre to the head and to the tail, as recorded
  if (!read(cells, kCentre, centre) || !read(cells[kDirection], direction)) return row;
  ahead.push_back(centre), behind.push_back(centre);
  for (std::size_t i = 0; i < up; ++i) {
    if (!read(cells, kAxis + 2 * i, p)) return row;
    ahead.push_back(p);
  }
  for (std::size_t i = 0; i < low; ++i) {
    if (!read(cells, kAxis + 2 * (up + i), p)) return row;
    behind.push_back(p);
  }
  if (!read(cells, kHead, p)) return row;
  ahead.push_back(p);
  if (!read(cells, kTail, p)) return row;
  behind.push_back(p);

  std::swap(cells[kHead], cells[kTail]), std::swap(cells[kHead + 1], cells[kTail + 1]);
  for (std::size_t xy = 0; xy < 2 && cells.size() > mm; ++xy) {
    std::swap(cells[mm + kHeadMm + xy], cells[mm + kTailMm + xy]);
    cells[mm + kLeftFinMm + xy].clear(), cells[mm + kRightFinMm + xy].clear();
  }
  cells[kDirection] = fixed(direction + std::numbers::pi, 5);
  std::vector<Point> axis = divided(behind, u_num);
  const std::vector<Point> rest = divided(ahead, l_num);
  axis.insert(axis.end(), rest.begin(), rest.end());
  for (std::size_t i = 0; i < axis.size(); ++i)
    cells[kAxis + 2 * i] = fixed(axis[i].x, 3), cells[kAxis + 2 * i + 1] = fixed(axis[i].y, 3);
  for (std::size_t i = kFins; i < kAxis; ++i) cells[i].clear();
  for (const std::size_t which : {kHeadConfidence, kTailConfidence}) {
    double sure = 0;
    if (read(cells[confidences + which], sure)) cells[confidences + which] = fixed(1 - sure, 3);
  }
  for (const std::size_t fin : {kFinConfidence, kFinConfidence + 1}) cells[confidences + fin] = fixed(0, 3);
  return joined(cells);
}

int64_t turn_rows(const std::string& path, std::span<const uint8_t> turned, int u_num, int l_num) {
  std::error_code ignored;
  const int64_t count = std::count(turned.begin(), turned.end(), uint8_t{1});
  if (count == 0 || path == "-" || !std::filesystem::is_regular_file(path, ignored)) return 0;
  const std::string other = path + ".turning";
  try {
    write_turned(path, other, turned, u_num, l_num);
    std::filesystem::rename(other, path);
  } catch (const std::exception& e) {
    std::filesystem::remove(other, ignored);
    throw UserError(path + ": head and tail of " + std::to_string(count) +
                    " rows could not be put right, it is kept as recorded (" + e.what() + ")");
  }
  return count;
}

}  // namespace nt
