// SPDX-License-Identifier: Apache-2.0
// What a person has changed about a proposal. Off the frame path.
//
// Rig (what was found in the picture) + Corrections -> Rig (what is saved). Corrections are positions, not steps: applied
// to a rig that already holds them they change nothing, so a character can be corrected again and again, and made anew
// from its picture and be the same. Figure pixels (rig.h). Order: ends, numbers, midline, fins, points, the rest.
// As text (docs/FORMATS.md, "Corrections"): one `key = value` a line, for a file beside the character and for --set.
// Errors: UserError with one line. Cost: microseconds.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/author/rig.h"

namespace nt {

inline constexpr int kMostHarmonics = 16;
inline constexpr int kMostMidlinePoints = 64;
inline constexpr float kFarthest = 1e5f;  // figure pixels; farther is a mistake

// Which end of the figure is the head: the one farther in a direction, or the one nearer to a point.
struct HeadEnd {
  std::string word;  // left, right, up, down; empty: the point counts
  Vec2 point;
};

struct Corrections {
  std::optional<HeadEnd> head_end;
  std::optional<int> u_num, l_num, harmonics;
  std::optional<int> fin_pairs;  // 0, 1 or 2
  std::vector<Vec2> midline;     // head to tail; empty: as proposed
  bool removed[kMaxFins] = {};   // this fin is none
  std::map<PointId, Vec2> moved;
  std::optional<bool> mirror;  // moved points of one side are mirrored to the other, where that has none of its own
  std::optional<bool> tail_fin;
  std::optional<bool> flip;
  std::optional<MlsKind> deformer;

  bool empty() const { return text_lines().empty(); }
  // "key = value", in a fixed order, without the heading; equal for equal corrections.
  std::vector<std::string> text_lines() const;
};

// The rig with the corrections in it; corrected points get confidence 1. Throws UserError where they do not go together.
Rig corrected(Rig rig, const Corrections& corrections);

// One "key = value" or "key=value" into `into`, replacing what it said of this key. `where` begins messages:
// "koi.corrections.txt:7", "--set". `fins` replaces what was said of single fins, too. Throws UserError (exit code 2).
void set_correction(Corrections& into, const std::string& where, const std::string& line);

Corrections parse_corrections(const std::string& name, const std::string& text);  // a whole file's text
std::string corrections_text(const Corrections& corrections);                     // what parse_corrections reads back

// koi.ntchar -> koi.corrections.txt
std::string corrections_path(const std::string& character_path);
Corrections load_corrections(const std::string& path);  // throws UserError where it cannot be read
void save_corrections(const std::string& path, const Corrections& corrections);

const char* to_string(MlsKind kind);

// To a tenth of a pixel, as files have it.
Vec2 tidy(Vec2 p);

}  // namespace nt
