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

// Opens the take and says on stderr where it had to be recovered. `fish` -1: the first one. `edits` false: as recorded.
// Throws UserError: no such fish, edits that do not fit.
EditedTake load_take(const std::string& path, int fish, bool edits);
// All fish of the take, or the one asked for; all as long as the take.
std::vector<EditedTake> load_fish(const std::string& path, int fish, bool edits);

}  // namespace nt
