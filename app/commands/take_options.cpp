// SPDX-License-Identifier: Apache-2.0
#include "app/commands/take_options.h"

#include <CLI/CLI.hpp>

#include "app/cast.h"
#include "platform/camera.h"

namespace nt {

void add_take_options(CLI::App& command, TakeOptions& options) {
  command.add_option("take", options.take, "the take")->type_name("FILE.take")->required();
  command
      .add_option("--character", options.characters,
                  "who swims it: a character file, a picture or a mesh; several are handed out to the fish in turn")
      ->type_name("FILE");
  add_deformer_options(command, options.mls, options.deformer);
  command.add_option("--fish", options.fish, "this fish of the take only, from 0")
      ->type_name("N")
      ->check(CLI::Range(0, 1000));
  command.add_flag("--recorded", options.recorded, "as it was recorded, without the edits");
  Moments& moments = options.moments;
  command
      .add_option_function<double>(
          "--rate", [&moments](double rate) { moments.rate = rate; }, "frames a second (default: the take's own)")
      ->type_name("FPS")
      ->check(CLI::Range(0.1, 1000.0));
  command
      .add_option_function<std::string>(
          "--range", [&moments](const std::string& text) { moments.range = parse_range("--range", text); },
          "these frames of the edited take only, both inside")
      ->type_name("FIRST:LAST");
  command.add_flag("--loop", moments.loop, "closed: the fish swims on the spot and the end leads into the beginning");
}

std::vector<Performance> performances_of(const std::vector<EditedTake>& fish, const TakeOptions& options) {
  std::vector<Performance> performances;
  for (const EditedTake& take : fish) {
    performances.push_back(performance(take, options.moments));
    if (!has_pose(performances.back())) performances.pop_back();
  }
  if (performances.empty()) throw UserError(options.take + ": not one frame with a pose, nothing to show");
  return performances;
}

}  // namespace nt
