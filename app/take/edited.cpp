// SPDX-License-Identifier: Apache-2.0
#include "app/take/edited.h"

#include <cstdio>
#include <utility>

#include "platform/camera.h"

namespace nt {
namespace {

Take open_take(const std::string& path) {
  Take take = Take::open(path, Take::Access::read);
  if (take.recovered()) std::fprintf(stderr, "%s: its recording was cut off; recovered\n", path.c_str());
  return take;
}

RecordedMotion motion_of(const std::vector<TakeFrame>& frames) {
  RecordedMotion recorded;
  recorded.motions.reserve(frames.size());
  if (!frames.empty()) recorded.first_frame = frames.front().frame;
  for (const TakeFrame& frame : frames) {
    recorded.motions.push_back(frame.motion);
    if (recorded.init_len == 0) recorded.init_len = frame.init_len;
  }
  return recorded;
}

EditedTake read_fish(Take& take, int fish, bool edits) {
  const std::vector<TakeFrame> frames = take.frames(fish);
  RecordedMotion recorded = motion_of(frames);
  EditedTake result{take.info(), fish_shape(frames), recorded.init_len, {}};
  result.clip = apply_edits(std::move(recorded.motions), straight_motion(take.info().u_num, take.info().l_num),
                            edits ? edits_for(parsed(take.edits()), fish) : std::vector<Edit>{});
  return result;
}

}  // namespace

RecordedMotion recorded_motion(Take& take, int fish) { return motion_of(take.frames(fish)); }

std::vector<Edit> parsed(const std::vector<std::string>& lines) {
  std::vector<Edit> edits;
  for (const std::string& line : lines) edits.push_back(parse_edit(line));
  return edits;
}

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
