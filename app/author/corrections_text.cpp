// SPDX-License-Identifier: Apache-2.0
// Corrections as text, and back: docs/FORMATS.md, "Corrections".
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <sstream>
#include <system_error>

#include "app/author/corrections.h"
#include "app/author/polyline.h"
#include "app/nearest_name.h"
#include "app/numbers.h"
#include "app/text_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr std::size_t kLargestFile = 256 * 1024;
constexpr int kFormat = 1;
constexpr const char* kHeading =
    "# Corrections of a Neontetra character: what differs from the proposal.\n"
    "# Positions are x,y in pixels of the figure, y down, as in 'neontetra character --preview'.\n";

constexpr MlsKind kDeformers[] = {MlsKind::rigid, MlsKind::similarity, MlsKind::affine};

[[noreturn]] void refuse(const std::string& line) { throw UserError(line, 2); }

// What a user typed, fit to stand in one line.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) out += c >= ' ' && c < 127 ? c : '?';
  return out + (text.size() > 40 ? "...'" : "'");
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

int parse_count(const std::string& what, const std::string& text, int least, int most) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || value < least || value > most) {
    refuse(what + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most) + ", not " +
           quoted(text));
  }
  return value;
}

bool parse_yes(const std::string& what, const std::string& text) {
  if (text != "yes" && text != "no") refuse(what + " must be yes or no, not " + quoted(text));
  return text == "yes";
}

bool parse_coordinate(const char*& at, const char* end, float& value) {
  const auto [stop, error] = std::from_chars(at, end, value);
  at = stop;
  return error == std::errc{} && value >= -kFarthest && value <= kFarthest;
}

Vec2 parse_point(const std::string& what, const std::string& text) {
  Vec2 p;
  const char* at = text.data();
  const char* end = at + text.size();
  const bool good = parse_coordinate(at, end, p.x) && at != end && *at++ == ',' && parse_coordinate(at, end, p.y);
  if (!good || at != end) refuse(what + " must be x,y in pixels of the figure, such as 512,80.5, not " + quoted(text));
  return tidy(p);
}

std::vector<Vec2> parse_line(const std::string& what, const std::string& text) {
  std::vector<Vec2> line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    line.push_back(parse_point(what, word));
    if (line.size() > kMostMidlinePoints)
      refuse(what + " may have " + std::to_string(kMostMidlinePoints) + " points; leave some out");
  }
  if (line.size() < 2 || !(line_length(line) >= 1))
    refuse(what + " needs at least two points x,y, head first, such as 900,300 500,310 100,300");
  return line;
}

HeadEnd parse_head_end(const std::string& what, const std::string& text) {
  const bool word = text == "left" || text == "right" || text == "up" || text == "down";
  if (word) return {text, {}};
  if (text.find(',') == std::string::npos)
    refuse(what + " must be left, right, up, down or x,y near the head, not " + quoted(text));
  return {"", parse_point(what, text)};
}

MlsKind parse_deformer(const std::string& what, const std::string& text) {
  for (const MlsKind kind : kDeformers) {
    if (text == to_string(kind)) return kind;
  }
  refuse(what + " must be rigid, similarity or affine, not " + quoted(text));
}

using Setter = std::function<void(Corrections&, const std::string& what, const std::string& text)>;

void set_point(Corrections& c, PointId id, const std::string& what, const std::string& text) {
  if (id.kind == PointKind::fin_tip) {
    c.removed[id.index] = text == "none";
    if (c.removed[id.index]) {
      std::erase_if(c.moved, [&](const auto& point) { return point.first.of_fin() && point.first.index == id.index; });
      return;
    }
  }
  c.moved[id] = parse_point(what, text);
}

std::map<std::string, Setter> make_setters() {
  using C = Corrections&;
  using S = const std::string&;
  std::map<std::string, Setter> all;
  all["format"] = [](C, S what, S text) {
    if (parse_count(what, text, 1, 1'000'000) > kFormat)
      refuse(what + ": these corrections are newer than this program; update neontetra");
  };
  all["head_end"] = [](C c, S what, S text) { c.head_end = parse_head_end(what, text); };
  all["u_num"] = [](C c, S what, S text) { c.u_num = parse_count(what, text, 1, kMaxUpAxis); };
  all["l_num"] = [](C c, S what, S text) { c.l_num = parse_count(what, text, 1, kMaxLowAxis); };
  all["harmonics"] = [](C c, S what, S text) { c.harmonics = parse_count(what, text, 1, kMostHarmonics); };
  all["fins"] = [](C c, S what, S text) { c.fin_pairs = parse_count(what, text, 0, kMaxFins / 2); };
  all["midline"] = [](C c, S what, S text) { c.midline = parse_line(what, text); };
  all["mirror"] = [](C c, S what, S text) { c.mirror = parse_yes(what, text); };
  all["tail_fin"] = [](C c, S what, S text) { c.tail_fin = parse_yes(what, text); };
  all["flip"] = [](C c, S what, S text) { c.flip = parse_yes(what, text); };
  all["deformer"] = [](C c, S what, S text) { c.deformer = parse_deformer(what, text); };
  for (const std::string& name : all_point_names()) {
    all[name] = [id = *point_named(name)](C c, S what, S text) { set_point(c, id, what, text); };
  }
  return all;
}

const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> all = make_setters();
  return all;
}

// Sets it and says which key it was.
std::string set_one(Corrections& into, const std::string& where, const std::string& line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) refuse(where + ": write key = value, such as head = 900,300, not " + quoted(line));
  const std::string key = trimmed(line.substr(0, equals));
  const auto setter = setters().find(key);
  if (setter == setters().end()) {
    std::vector<std::string> known;
    for (const auto& [name, unused] : setters()) known.push_back(name);
    refuse(where + ": there is no " + quoted(key) + "; did you mean " + nearest_name(key.substr(0, 40), known) + "?");
  }
  setter->second(into, where + ": " + key, trimmed(line.substr(equals + 1)));
  return key;
}

std::string number_text(float value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value == 0 ? 0.0f : value).ptr;
  return {text.data(), end};
}

std::string point_text(Vec2 p) { return number_text(p.x) + "," + number_text(p.y); }

}  // namespace

const char* to_string(MlsKind kind) {
  switch (kind) {
    case MlsKind::rigid:
      return "rigid";
    case MlsKind::similarity:
      return "similarity";
    case MlsKind::affine:
      break;
  }
  return "affine";
}

std::vector<std::string> Corrections::text_lines() const {
  std::vector<std::string> lines;
  const auto say = [&](const std::string& key, const std::string& value) { lines.push_back(key + " = " + value); };
  const auto number = [&](const char* key, std::optional<int> v) {
    if (v) say(key, std::to_string(*v));
  };
  const auto yes = [&](const char* key, std::optional<bool> v) {
    if (v) say(key, *v ? "yes" : "no");
  };
  if (head_end) say("head_end", head_end->word.empty() ? point_text(head_end->point) : head_end->word);
  number("u_num", u_num), number("l_num", l_num), number("harmonics", harmonics);
  if (!midline.empty()) {
    std::string all;
    for (const Vec2 p : midline) all += (all.empty() ? "" : " ") + point_text(p);
    say("midline", all);
  }
  number("fins", fin_pairs);
  for (int fin = 0; fin < kMaxFins; ++fin) {
    if (removed[fin]) say(point_name({PointKind::fin_tip, fin}), "none");
  }
  for (const auto& [id, at] : moved) say(point_name(id), point_text(at));
  yes("mirror", mirror), yes("tail_fin", tail_fin), yes("flip", flip);
  if (deformer) say("deformer", to_string(*deformer));
  return lines;
}

void set_correction(Corrections& into, const std::string& where, const std::string& line) {
  const std::string key = set_one(into, where, line);
  if (key != "fins") return;
  // It replaces what was said of single fins before: whether there are some, and where those lay that are to go.
  std::fill(std::begin(into.removed), std::end(into.removed), false);
  const int fins = 2 * *into.fin_pairs;
  std::erase_if(into.moved, [&](const auto& point) { return point.first.of_fin() && point.first.index >= fins; });
}

Corrections parse_corrections(const std::string& name, const std::string& text) {
  if (text.size() > kLargestFile) refuse(name + " is too large to be a file of corrections");
  Corrections out;
  std::map<std::string, int> seen;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string content = trimmed(line.substr(0, line.find('#')));
    if (content.empty()) continue;
    const std::string where = name + ":" + std::to_string(number);
    const std::string key = set_one(out, where, content);
    const auto [first, fresh] = seen.try_emplace(key, number);
    if (!fresh) refuse(where + ": " + key + " was given in line " + std::to_string(first->second) + " already");
  }
  return out;
}

std::string corrections_text(const Corrections& corrections) {
  std::string text = kHeading;
  text += "format = " + std::to_string(kFormat) + "\n";
  for (const std::string& line : corrections.text_lines()) text += line + "\n";
  return text;
}

std::string corrections_path(const std::string& character_path) {
  return std::filesystem::path(character_path).replace_extension(".corrections.txt").string();
}

Corrections load_corrections(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  std::error_code unused;
  if (in && !std::filesystem::is_directory(path, unused)) text << in.rdbuf();
  if (!in || in.bad() || std::filesystem::is_directory(path, unused))
    throw UserError("cannot read the corrections " + path + ": no such file, or no right to read it");
  return parse_corrections(path, text.str());
}

void save_corrections(const std::string& path, const Corrections& corrections) {
  const std::string partial = path + ".part";
  write_text(partial, corrections_text(corrections));
  std::error_code error;
  std::filesystem::rename(partial, path, error);
  if (error) throw UserError("cannot write the corrections to " + path + ": " + error.message());
}

}  // namespace nt
