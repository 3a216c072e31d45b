// SPDX-License-Identifier: Apache-2.0
// The camera's own picture beside the character in the take editor: the video that was kept with the take.
//
// Frame of the recording + where frame pixels lie in the pane -> scene items: the part of the picture that the pane shows, and on
// it where the clip as it stands has the fish and its course. What is missing is a line of problem(), never an exception.
// What the scene points to lives here until the next draw(). Cost: one upload of the part that is shown.
#pragma once
#include <array>
#include <string>

#include "app/character_edit/figure_view.h"
#include "app/take_edit/kept_video.h"
#include "core/motion/motion.h"

namespace nt {

class VideoPane {
 public:
  VideoPane(const std::string& path, int64_t first) : video_(path, first) {}
  // `motion`: the clip's, of the same moment. `length_px`: of the fish; frame pixels.
  void draw(Scene& scene, const Area& area, const FigureView& view, int64_t frame, const Motion& motion,
            float length_px, float line_px);
  KeptVideo& video() { return video_; }

 private:
  void add_part(Scene& scene, const Area& area, const FigureView& view, Picture picture);

  KeptVideo video_;
  uint64_t revision_ = 0;
  std::array<Vec2, 2> course_;
};

}  // namespace nt
