// SPDX-License-Identifier: Apache-2.0
#include "app/numbers.h"

#include <charconv>
#include <sstream>

#include "platform/camera.h"

namespace nt {
namespace {

// The largest frame side that files and the tank may have; 8K is 7680.
constexpr int kMaxSide = 16384;

template <class T>
T parse(const std::string& what, const std::string& text, T least, T most, const char* kind) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !(value >= least && value <= most)) {
    std::ostringstream line;
    line << what << " must be " << kind << " from " << least << " to " << most << ", not '" << text << "'";
    throw UserError(line.str(), 2);
  }
  return value;
}

}  // namespace

int64_t parse_integer(const std::string& what, const std::string& text, int64_t least, int64_t most) {
  return parse<int64_t>(what, text, least, most, "a whole number");
}

double parse_number(const std::string& what, const std::string& text, double least, double most) {
  return parse<double>(what, text, least, most, "a number");
}

Size parse_size(const std::string& what, const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos) {
    throw UserError(what + " must be WIDTHxHEIGHT in pixels, such as 960x544, not '" + text + "'", 2);
  }
  Size size;
  size.width = static_cast<int>(parse_integer(what + " width", text.substr(0, x), 1, kMaxSide));
  size.height = static_cast<int>(parse_integer(what + " height", text.substr(x + 1), 1, kMaxSide));
  return size;
}

}  // namespace nt
