// SPDX-License-Identifier: Apache-2.0
// What the take editor starts from: one fish's recording, the edits so far, and how large its picture was.
#pragma once
#include <string>
#include <vector>

#include "app/take/edits.h"
#include "app/take/take.h"
#include "core/base/vec2.h"

namespace nt {

struct EditedClip {
  std::vector<Motion> recorded;
  std::vector<Edit> edits;  // of all fish of the take
  double fps = 30;
  float init_len_px = 0;    // the fish's length in its first frame
  Vec2 frame_px;            // the working frame
  int fish = -1;            // whom new edits are for; -1: there is only one
  std::string video = {};   // the camera's pictures that were kept; empty: none
  int64_t video_first = 0;  // the recorded frame that its first picture shows
};

// `fish` -1: the first one; `path` is for messages. Throws UserError: no such fish, no pose at all, edits that cannot be read.
EditedClip load_clip(Take& take, const std::string& path, int fish);

}  // namespace nt
