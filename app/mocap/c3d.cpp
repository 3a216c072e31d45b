// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "app/mocap/marker_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr std::size_t kBlock = 512;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// Reads past the end give zeros; the callers bound what they loop over.
class Bytes {
 public:
  explicit Bytes(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T at(std::size_t offset) const {
    T v{};
    if (offset <= bytes_.size() && sizeof v <= bytes_.size() - offset)
      std::memcpy(&v, bytes_.data() + offset, sizeof v);
    return v;
  }
  std::size_t size() const { return bytes_.size(); }
  std::string text(std::size_t offset, std::size_t length) const {
    std::string out;
    for (std::size_t i = 0; i < length && offset + i < bytes_.size(); ++i) out += static_cast<char>(bytes_[offset + i]);
    return out;
  }

 private:
  std::span<const std::byte> bytes_;
};

struct Parameter {
  int group = 0;
  std::string name;
  std::size_t body = 0, end = 0;  // of its type byte, and one past its record
};

std::string upper(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return s;
}

std::string trimmed(std::string s) {
  while (!s.empty() && (static_cast<unsigned char>(s.back()) <= ' ' || static_cast<unsigned char>(s.back()) > '~'))
    s.pop_back();
  const auto first = std::find_if(s.begin(), s.end(), [](unsigned char c) { return c > ' '; });
  s.erase(s.begin(), first);
  return s;
}

std::vector<Parameter> list_parameters(const Bytes& b, std::size_t at) {
  std::vector<Parameter> out;
  for (int k = 0; k < 4096 && at + 4 < b.size(); ++k) {
    const int length = std::abs(static_cast<int>(b.at<int8_t>(at)));
    if (length == 0) break;
    Parameter p;
    p.group = b.at<int8_t>(at + 1);
    p.name = upper(b.text(at + 2, static_cast<std::size_t>(length)));
    const std::size_t offset_at = at + 2 + static_cast<std::size_t>(length);
    const int offset = b.at<int16_t>(offset_at);
    p.body = offset_at + 2;
    p.end = offset > 0 ? offset_at + static_cast<std::size_t>(offset) : b.size();
    out.push_back(p);
    if (offset <= 0) break;
    at = p.end;
  }
  return out;
}

// The strings of a parameter of characters; nothing if its record is too short for what it says it holds.
std::vector<std::string> strings_of(const Bytes& b, const Parameter& p) {
  const int dimensions = b.at<uint8_t>(p.body + 1);
  if (b.at<int8_t>(p.body) != -1 || dimensions < 1 || dimensions > 2) return {};
  const std::size_t width = b.at<uint8_t>(p.body + 2), count = dimensions == 2 ? b.at<uint8_t>(p.body + 3) : 1;
  const std::size_t first = p.body + 2 + static_cast<std::size_t>(dimensions);
  if (first + width * count > std::min(p.end, b.size())) return {};
  std::vector<std::string> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(trimmed(b.text(first + k * width, width)));
  return out;
}

struct Header {
  std::size_t points = 0, analog = 0, frames = 0, promised = 0, data = 0;
  float scale = -1.0f;
  double rate = 0.0;
};

Header read_header(const Bytes& b, const std::string& name) {
  if (b.size() < 2 * kBlock || b.at<uint8_t>(1) != 0x50) throw UserError(name + " is not a C3D file");
  Header h;
  h.points = b.at<uint16_t>(2), h.analog = b.at<uint16_t>(4);
  const std::size_t first = b.at<uint16_t>(6), last = b.at<uint16_t>(8);
  h.scale = b.at<float>(12);
  h.data = (static_cast<std::size_t>(b.at<uint16_t>(16)) - 1) * kBlock;
  h.rate = static_cast<double>(b.at<float>(20));
  if (b.at<uint16_t>(16) == 0 || h.data >= b.size())
    throw UserError(name + " is damaged: its data lies beyond its end");
  if (h.points == 0 || h.points > 4096) throw UserError(name + " has no marker in it");
  const std::size_t word = h.scale < 0.0f ? 4 : 2, bytes = (4 * h.points + h.analog) * word;
  // The header's last frame wraps at 65535 in long files: the file's own length is the better witness.
  const std::size_t there = (b.size() - h.data) / bytes;
  h.promised = last >= first && last != 65535 ? last - first + 1 : there;
  h.frames = last >= first ? std::min(last - first + 1, there) : there;
  if (h.frames == 0) throw UserError(name + " has no frame in it");
  return h;
}

float scale_to_mm(const std::string& unit) {
  if (unit == "M") return 1000.0f;
  if (unit == "CM") return 10.0f;
  return 1.0f;
}

Vec3 read_point(const Bytes& b, const Header& h, std::size_t at) {
  if (h.scale < 0.0f) {
    if (b.at<float>(at + 12) < 0.0f) return {kNone, kNone, kNone};
    return {b.at<float>(at), b.at<float>(at + 4), b.at<float>(at + 8)};
  }
  if (b.at<int16_t>(at + 6) < 0) return {kNone, kNone, kNone};
  return Vec3{static_cast<float>(b.at<int16_t>(at)), static_cast<float>(b.at<int16_t>(at + 2)),
              static_cast<float>(b.at<int16_t>(at + 4))} *
         h.scale;
}

}  // namespace

MarkerFile parse_c3d(std::span<const std::byte> bytes, const std::string& name) {
  const Bytes b(bytes);
  const Header h = read_header(b, name);
  const std::size_t parameters = (static_cast<std::size_t>(std::max<int>(b.at<uint8_t>(0), 1)) - 1) * kBlock;
  if (b.at<uint8_t>(parameters + 3) == 85 || b.at<uint8_t>(parameters + 3) == 86) {
    throw UserError(name + " is a C3D file of a DEC or SGI machine, which is not read; save it in Intel format");
  }
  MarkerFile out;
  out.rate_hz = std::isfinite(h.rate) && h.rate > 0.0 && h.rate < 1e5 ? h.rate : 100.0;
  int group = 0;
  const auto list = list_parameters(b, parameters + 4);
  for (const Parameter& p : list) {
    if (p.group < 0 && p.name == "POINT") group = -p.group;
  }
  float unit = 1.0f;
  for (const Parameter& p : list) {
    if (group == 0 || p.group != group) continue;
    if (p.name == "LABELS" || p.name == "LABELS2") {
      for (const std::string& label : strings_of(b, p)) out.names.push_back(label);
    }
    if (p.name == "UNITS") {
      const auto units = strings_of(b, p);
      if (!units.empty()) unit = scale_to_mm(upper(units[0]));
    }
  }
  if (h.promised > h.frames) {
    out.notes.push_back(name + " ends early: of its " + std::to_string(h.promised) + " frames " +
                        std::to_string(h.frames) + " are there");
  }
  if (out.names.empty()) out.notes.push_back("no labels: the markers are called M1 to M" + std::to_string(h.points));
  out.names.resize(h.points);
  for (std::size_t m = 0; m < h.points; ++m) {
    if (out.names[m].empty()) out.names[m] = "M" + std::to_string(m + 1);
  }
  const std::size_t word = h.scale < 0.0f ? 4 : 2;
  for (std::size_t f = 0; f < h.frames; ++f) {
    for (std::size_t m = 0; m < h.points; ++m) {
      const Vec3 p = unit * read_point(b, h, h.data + (f * (4 * h.points + h.analog) + 4 * m) * word);
      out.positions.push_back(is_seen(p) ? p : Vec3{kNone, kNone, kNone});
    }
  }
  return out;
}

}  // namespace nt
