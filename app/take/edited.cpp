// SPDX-License-Identifier: Apache-2.0
#include "app/take/edited.h"

#include <cstdio>

#include "platform/camera.h"

namespace nt {
namespace {

Take open_take(const std::string& path) {
  Take take = Take::open(path, Take::Access::read);
  if (take.recovered()) std::fprintf(stderr, "%s: its recording was cut off; recovered\n", path.c_str());
  return take;
}

// -1: all.
std::vector<int> choose_fish(Take& take, const std::string& path, int wanted) {
  const std::vector<int> fish = take.fish();
  if (fish.empty()) throw UserError(path + ": the take is empty");
  if (wanted < 0) return fish;
  std::string there;
  for (const int number : fish) {
    if (number == wanted) return {number};
    there += (there.empty() ? "" : ", ") + std::to_string(number);
  }
  throw UserError(path + ": there is no fish " + std::to_string(wanted) + " in it (there are: " + there + ")", 2);
}

EditedTake read_fish(Take& take, int fish, bool edits) {
  const std::vector<TakeFrame> frames = take.frames(fish);
  EditedTake result{take.info(), fish_shape(frames), 0, {}};
  std::vector<Motion> motions;
  for (const TakeFrame& frame : frames) {
    motions.push_back(frame.motion);
    if (result.init_len == 0) result.init_len = frame.init_len;
  }
  std::vector<Edit> list;
  if (edits)
    for (const std::string& line : take.edits()) list.push_back(parse_edit(line));
  result.clip = apply_edits(std::move(motions), straight_motion(take.info().u_num, take.info().l_num), list);
  return result;
}

}  // namespace

EditedTake load_take(const std::string& path, int fish, bool edits) {
  Take take = open_take(path);
  return read_fish(take, choose_fish(take, path, fish).front(), edits);
}

std::vector<EditedTake> load_fish(const std::string& path, int fish, bool edits) {
  Take take = open_take(path);
  std::vector<EditedTake> result;
  for (const int number : choose_fish(take, path, fish)) result.push_back(read_fish(take, number, edits));
  return result;
}

}  // namespace nt
