// SPDX-License-Identifier: Apache-2.0
#include "app/take/edits.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "app/nearest_name.h"
#include "app/numbers.h"
#include "app/take/property_group.h"
#include "app/take/reshape.h"
#include "core/motion/finetune.h"
#include "platform/camera.h"

namespace nt {
namespace {

using Kind = Edit::Kind;

// What follows the word, in order: p property, g property or group, f frame, r range of frames, v value, n radius.
struct Form {
  const char* word;
  const char* arguments;
  const char* usage;
  double least, most;  // of v
};
constexpr double kAny = 1e6;
constexpr Form kForms[] = {
    {"set", "pfv", "set ANGLE FRAME RADIANS", -kAny, kAny},
    {"move", "pfvn", "move PATH FRAME VALUE RADIUS", -kAny, kAny},
    {"smooth", "grv", "smooth WHAT FIRST:LAST FRAMES", 0, 1000},
    {"exaggerate", "grv", "exaggerate WHAT FIRST:LAST FACTOR", 0, 10},
    {"repair", "rv", "repair FIRST:LAST CONFIDENCE", 0, 1},
    {"trim", "r", "trim FIRST:LAST", 0, 0},
    {"loop", "rv", "loop FIRST:LAST BLENDED", 0, 10000},
    {"retime", "v", "retime SPEED", 0.01, 100},
};

const Form& form_of(const std::string& word) {
  std::vector<std::string> words;
  for (const Form& form : kForms) {
    if (word == form.word) return form;
    words.emplace_back(form.word);
  }
  throw UserError("unknown edit '" + word + "'; did you mean '" + nearest_name(word, words) +
                      "'? (there are: " + joined(words) + ")",
                  2);
}

constexpr int64_t kLastFrame = 100'000'000;
constexpr int64_t kMostFish = 1'000'000;  // numbers of fish that came and went

void parse_range(const Form& form, const std::string& text, Edit& edit) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw UserError(std::string("expected ") + form.usage + ", got '" + text + "'", 2);
  edit.first = parse_integer(form.word, text.substr(0, colon), 0, kLastFrame);
  edit.last = parse_integer(form.word, text.substr(colon + 1), edit.first, kLastFrame);
}

void parse_argument(const Form& form, char kind, const std::string& text, Edit& edit) {
  switch (kind) {
    case 'p':
    case 'g':
      edit.what = text;
      if (properties_of(text).empty() || (kind == 'p' && properties_of(text).size() != 1))
        throw UserError("unknown '" + text + "'; did you mean '" + nearest_name(text, property_words()) + "'?", 2);
      break;
    case 'f':
      edit.first = edit.last = parse_integer(form.word, text, 0, kLastFrame);
      break;
    case 'r':
      parse_range(form, text, edit);
      break;
    case 'v':
      edit.value = parse_number(form.word, text, form.least, form.most);
      break;
    default:
      edit.radius = parse_integer(form.word, text, 0, kLastFrame);
      break;
  }
}

void check_meaning(const Edit& edit) {
  if (edit.fish >= 0 && edit.renumbers())
    throw UserError(
        "trim, loop and retime are for all fish of a take; leave out 'fish " + std::to_string(edit.fish) + "'", 2);
  if (edit.what.empty()) return;
  const bool path = properties_of(edit.what).front().is_path();
  if (edit.kind == Kind::set && path)
    throw UserError("set: " + edit.what + " has no rest pose; use move " + edit.what + " FRAME VALUE RADIUS", 2);
  if (edit.kind == Kind::move && !path) throw UserError("move: " + edit.what + " is an angle of the body; use set", 2);
  if (edit.kind == Kind::exaggerate && path)
    throw UserError("exaggerate: " + edit.what + " has no rest pose to exaggerate from", 2);
}

std::string number_text(double value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void check_frames(const Edit& edit, std::size_t frames) {
  if (edit.last < static_cast<int64_t>(frames)) return;
  throw UserError("'" + to_line(edit) + "': there are " + std::to_string(frames) + " frames, the last is " +
                      std::to_string(static_cast<int64_t>(frames) - 1),
                  2);
}

void check_bones(const Edit& edit, const Motion& motion) {
  if (edit.what.empty()) return;
  const std::vector<MotionProperty> properties = properties_of(edit.what);
  if (properties.size() == 1 && !has(motion, properties.front()))
    throw UserError("'" + to_line(edit) + "': this motion has " + std::to_string(motion.u_num) + " up and " +
                        std::to_string(motion.l_num) + " low bones",
                    2);
}

void change(const Edit& edit, const Motion& rest, Clip& clip) {
  const auto first = static_cast<std::size_t>(edit.first), last = static_cast<std::size_t>(edit.last);
  const int r = static_cast<int>(edit.first);
  std::vector<MotionProperty> what;
  for (const MotionProperty property : properties_of(edit.what))
    if (has(rest, property)) what.push_back(property);
  const auto value = static_cast<float>(edit.value);
  std::vector<Motion>& m = clip.motions;
  switch (edit.kind) {
    case Kind::set: {
      const float zero = value_of(rest, what.front());
      edit_angle(m, what.front(), zero, r, value, edit_window(m, what.front(), zero, r, value));
      break;
    }
    case Kind::move:
      edit_path(m, what.front(), r, value, path_window(static_cast<int>(m.size()), r, static_cast<int>(edit.radius)));
      break;
    case Kind::smooth:
      for (const MotionProperty property : what) smooth(m, property, first, last, edit.value);
      break;
    case Kind::exaggerate:
      for (const MotionProperty property : what) exaggerate(m, property, value_of(rest, property), first, last, value);
      break;
    case Kind::repair:
      repair(m, first, last, value);
      break;
    case Kind::trim:
      m = std::vector<Motion>(m.begin() + first, m.begin() + last + 1);
      break;
    case Kind::loop:
      clip.seam = make_loop(m, first, last, static_cast<std::size_t>(edit.value));
      break;
    case Kind::retime:
      retime(m, edit.value);
      break;
  }
}

}  // namespace

Edit parse_edit(const std::string& line) {
  std::istringstream words(line);
  std::string word;
  words >> word;
  Edit edit;
  if (word == "fish") {
    if (!(words >> word)) throw UserError("expected fish NUMBER EDIT", 2);
    edit.fish = static_cast<int>(parse_integer("fish", word, 0, kMostFish));
    if (!(words >> word)) throw UserError("expected fish NUMBER EDIT", 2);
  }
  const Form& form = form_of(word);
  edit.kind = static_cast<Kind>(&form - kForms);
  for (const char* kind = form.arguments; *kind != 0; ++kind) {
    if (!(words >> word)) throw UserError(std::string("expected ") + form.usage, 2);
    parse_argument(form, *kind, word, edit);
  }
  if (words >> word) throw UserError(std::string("expected ") + form.usage + ", got '" + word + "' after it", 2);
  check_meaning(edit);
  return edit;
}

std::string to_line(const Edit& edit) {
  const Form& form = kForms[static_cast<std::size_t>(edit.kind)];
  std::string line = edit.fish < 0 ? "" : "fish " + std::to_string(edit.fish) + " ";
  line += form.word;
  for (const char* kind = form.arguments; *kind != 0; ++kind) {
    line += ' ';
    if (*kind == 'p' || *kind == 'g') line += edit.what;
    if (*kind == 'f') line += std::to_string(edit.first);
    if (*kind == 'r') line += std::to_string(edit.first) + ":" + std::to_string(edit.last);
    if (*kind == 'v') line += number_text(edit.value);
    if (*kind == 'n') line += std::to_string(edit.radius);
  }
  return line;
}

std::vector<Edit> edits_for(std::span<const Edit> edits, int fish) {
  std::vector<Edit> own;
  std::copy_if(edits.begin(), edits.end(), std::back_inserter(own),
               [&](const Edit& edit) { return edit.concerns(fish); });
  return own;
}

std::vector<Edit> read_edits(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw UserError(path + ": cannot read the edits; is the path right?");
  std::vector<Edit> edits;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      edits.push_back(parse_edit(line));
    } catch (const UserError& error) {
      throw UserError(path + ":" + std::to_string(number) + ": " + error.what(), 2);
    }
  }
  return edits;
}

void apply_edit(const Edit& edit, const Motion& rest, Clip& clip) {
  check_frames(edit, clip.motions.size());
  if (clip.motions.empty()) return;
  check_bones(edit, clip.motions.front());
  change(edit, rest, clip);
}

Clip apply_edits(std::vector<Motion> recorded, const Motion& rest, std::span<const Edit> edits) {
  Clip clip{std::move(recorded), {}};
  for (const Edit& edit : edits) apply_edit(edit, rest, clip);
  return clip;
}

}  // namespace nt
