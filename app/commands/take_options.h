// SPDX-License-Identifier: Apache-2.0
// What export and play have in common: a take, its fish, who swims them, and which moments are shown.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/take/troupe.h"

namespace CLI {
class App;
}

namespace nt {

struct TakeOptions {
  std::string take;
  std::vector<std::string> characters;
  std::optional<MlsKind> mls;        // unset: as the character's file says
  std::optional<Deformer> deformer;  // unset: the lattice where the file has one
  int fish = -1;                     // all, or the first where a format holds one
  bool recorded = false;
  Moments moments;
};
void add_take_options(CLI::App& command, TakeOptions& options);

// Of every fish that has a pose in these moments. Throws UserError where none has.
std::vector<Performance> performances_of(const std::vector<EditedTake>& fish, const TakeOptions& options);

}  // namespace nt
