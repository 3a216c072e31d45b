// SPDX-License-Identifier: Apache-2.0
// Scenes -> a video file and a contact sheet, either of them optional, drawn off-screen by the renderer of the window.
//
// The display is opened with the first scene, so a run that writes neither needs no GL.
#pragma once
#include <memory>
#include <string>

#include "app/export/contact_sheet.h"
#include "app/export/video_writer.h"
#include "platform/display.h"

namespace nt {

class Film {
 public:
  // Empty paths are not written. All scenes have the size width x height.
  Film(const std::string& video_path, const std::string& sheet_path, int width, int height, double fps);
  bool wanted() const { return video_ != nullptr || !sheet_path_.empty(); }
  void add(const Scene& scene, int times = 1);  // shown for so many frames of the video
  void finish();                                // writes what is left; throws UserError
  // Where another thread finishes: at last on the one that drew, to which the display is bound.
  void close_display() { display_.reset(); }
  int64_t frames() const { return frames_; }

 private:
  int width_, height_;
  int64_t frames_ = 0;
  std::string sheet_path_;
  std::unique_ptr<VideoWriter> video_;
  ContactSheet sheet_;
  std::unique_ptr<Display> display_;
};

}  // namespace nt
