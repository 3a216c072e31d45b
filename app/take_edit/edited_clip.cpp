// SPDX-License-Identifier: Apache-2.0
#include "app/take_edit/edited_clip.h"

#include <utility>

#include "app/take/edited.h"
#include "platform/camera.h"
#include "platform/linux/process_memory.h"

namespace nt {

EditedClip load_clip(Take& take, const std::string& path, int fish) {
  const int chosen = choose_fish(take, path, fish).front();
  RecordedMotion recorded = recorded_motion(take, chosen);
  if (recorded.init_len <= 0) throw UserError(path + ": not one frame with a pose, nothing to edit");
  give_back_freed_memory();  // the take's rows: 15 MB of ten minutes
  const TakeInfo& info = take.info();
  return {std::move(recorded.motions),
          parsed(take.edits()),
          info.fps,
          recorded.init_len,
          {static_cast<float>(info.width), static_cast<float>(info.height)},
          take.fish().size() > 1 ? chosen : -1,
          video_beside(path, info),
          info.video_first - recorded.first_frame};
}

}  // namespace nt
