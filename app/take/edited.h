// SPDX-License-Identifier: Apache-2.0
// A take as it is to be shown: one fish's recording with the take's edits applied.
#pragma once
#include "app/take/edits.h"
#include "app/take/fish_shape.h"
#include "app/take/take.h"

namespace nt {

struct EditedTake {
  TakeInfo info;
  FishShape shape;
  float init_len = 0;
  Clip clip;
};

// A fish's motion as it was recorded.
struct RecordedMotion {
  std::vector<Motion> motions;
  float init_len = 0;       // its length in the first frame that has one, pixels; 0: never seen
  int64_t first_frame = 0;  // of the take
};
RecordedMotion recorded_motion(Take& take, int fish);
std::vector<Edit> parsed(const std::vector<std::string>& lines);
// `wanted` -1: all. At least one; throws UserError where there is no such fish; `path` is for the message.
std::vector<int> choose_fish(Take& take, const std::string& path, int wanted);

// Opens the take and says on stderr where it had to be recovered. `fish` -1: the first one. `edits` false: as recorded.
// Throws UserError: no such fish, edits that do not fit.
EditedTake load_take(const std::string& path, int fish, bool edits);
// All fish of the take, or the one asked for; all as long as the take.
std::vector<EditedTake> load_fish(const std::string& path, int fish, bool edits);

}  // namespace nt
