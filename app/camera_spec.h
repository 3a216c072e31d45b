// SPDX-License-Identifier: Apache-2.0
// The SPEC of --camera: text -> which camera, and the camera itself.
//
//   sim[:scene=NAME][,seed=N][,size=WxH][,fps=N][,frames=N]   the simulated tank, 960x544 at 30 frames a second
//   file:PATH                                                 a video or an image sequence; a bare path works too
//   v4l2:/dev/videoN[,size=WxH][,fps=N][,format=nv12|yuyv|grey|mjpeg][,lock=on|off][,mains=50|60|off|auto][,wait=S]
//                                                             a USB camera; lock: settle, then lock exposure and white
//                                                             balance; wait: seconds for one that was unplugged
//   libcamera[:ID][,size=WxH][,fps=N][,lock=on|off]           a camera of libcamera's, whose name has ID in it; without ID the first
// Anything else throws UserError that names what exists and the nearest valid name: exit code 2, or 3 for a file that
// is not there.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/numbers.h"
#include "platform/camera.h"
#include "platform/linux/libcamera_camera.h"
#include "platform/linux/v4l2_camera.h"
#include "platform/sim/tank.h"

namespace nt {

struct CameraSpec {
  enum class Kind : uint8_t { sim, file, v4l2, libcamera } kind = Kind::sim;
  TankSettings tank;    // sim
  int64_t frames = -1;  // sim: where it ends; -1 = never
  std::string path;     // file
  V4l2Settings v4l2;
  LibcameraSettings libcamera;
};

CameraSpec parse_camera_spec(const std::string& text);

inline constexpr Size kDefaultWork{960, 544};

// `work` is the largest frame handed out: a larger file or tank is shrunk to fit, a smaller one is left as it is. Without it
// a file is shrunk to as many pixels as kDefaultWork has, whatever its shape: a square one would lose half of them in its box.
// `fps` above 0 overrides the source's frame rate; a camera is asked for it where its SPEC names none.
std::unique_ptr<Camera> open_camera(const CameraSpec& spec, std::optional<Size> work, double fps,
                                    const CameraManners& manners = {});

}  // namespace nt
