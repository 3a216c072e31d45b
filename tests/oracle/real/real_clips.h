// SPDX-License-Identifier: Apache-2.0
// The six filmed fish that capture is judged on, and what a person saw in them.
#pragma once
#include <string>
#include <vector>

#include "tests/oracle/real/reference_midline.h"

namespace nt::test {

struct RealClip {
  std::string file;  // below shared/data/fish_topview
  ReferenceSettings reference;
  cv::Point2d head_in_first;  // where the head is in the first frame with the fish: pixels, by eye
  int first_frame = 0;        // with the fish
  std::string fins{};         // labels of its pectoral fins, a file beside this one; "": none
};

inline std::vector<RealClip> real_clips() {
  return {
      {"sunfish_pectoral_flume.avi", {.strong = 180, .weak = 120, .fork = 0.05}, {30, 128}, 0, "sunfish_fins.txt"},
      {"trout_flume.avi", {.strong = 180, .weak = 60, .fork = 0.08}, {185, 282}, 0},
      {"sunfish_bcf_hires.avi", {.strong = 80, .weak = 40, .fork = 0.06}, {62, 300}, 0},
      {"fish_piv_darkfield_2k.mp4",
       {.bright = true, .strong = 100, .weak = 40, .median_filter = 5, .blur = 2},
       {1110, 330},
       0},
      {"zebrafish_larva_dish_1fish.mp4", {.ground = 0.6, .strong = 50, .weak = 15, .along = 3}, {450, 206}, 0},
      {"zebrafish_larva_free_crop.mp4", {.ground = 0.8, .strong = 60, .weak = 12, .blur = 0.7}, {70, 44}, 5},
  };
}

}  // namespace nt::test
