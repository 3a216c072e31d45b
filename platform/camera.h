// SPDX-License-Identifier: Apache-2.0
// Where frames come from: a file, the simulated tank, a camera. One seam for all.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "core/frame/frame.h"
#include "core/scene/scene.h"

namespace nt {

struct TankTruth;

// Thrown by platform and app code; `what()` is the one line for the user: what, where, what to do.
struct UserError : std::runtime_error {
  int exit_code;  // 1 failed, 2 usage, 3 no camera
  explicit UserError(const std::string& line, int code = 1) : std::runtime_error(line), exit_code(code) {}
};

struct CameraInfo {
  std::string name;      // for messages: "file:clip.avi", "sim:scene=calm"
  int source_width = 0;  // pixels of the source video
  int source_height = 0;
  int width = 0;  // pixels of the frames handed out (the working size)
  int height = 0;
  double fps = 0;            // nominal frames a second
  int64_t frame_count = -1;  // -1 when not known
  bool live = false;         // frames come when they come: there is no pace to keep and nothing to skip
};

class Camera {
 public:
  virtual ~Camera() = default;
  virtual const CameraInfo& info() const = 0;
  // The next frame, or nothing at the end. Pixels stay valid until the next call. Throws UserError on a broken source.
  virtual std::optional<Frame> next() = 0;
  // From the next frame on, frames carry chroma; a grey camera gives grey, or none.
  virtual void give_chroma() {}
  // The colour picture of the last frame, for showing (luma8 or rgb8, working size).
  virtual Picture picture() const = 0;
  // Starts again from the first frame; false where the source cannot (a live camera).
  virtual bool rewind() { return false; }
  // Whether next() has something to say at once; false only while a live camera has no frame yet. Asking may end the last
  // frame's pixels (the camera was unplugged), never picture()'s.
  virtual bool ready() { return true; }
  // When timestamp 0 was, by the steady clock, going by the last frame; 0 where frames are not waited for.
  virtual int64_t epoch_ns() const { return 0; }
  // Of the simulated tank: what it knows of the last frame, in its own pixels. Null from a camera that films.
  virtual const TankTruth* truth() { return nullptr; }
  // Why a live camera ended before its time (pulled, silent), one line; empty when it did not. What was filmed until then
  // is kept by whoever films.
  virtual std::string failure() const { return {}; }
  // What went wrong without ending the clip (frames skipped, a file cut short), one line; empty when nothing did. Ask at the end.
  virtual std::string warning() const { return {}; }
};

}  // namespace nt
