// SPDX-License-Identifier: Apache-2.0
// A recorded clip as a camera: any video that OpenCV's FFmpeg reads, or pictures as an image sequence.
//
// Path -> frames at the working size: the largest size with the source's aspect that fits work_width x work_height, never
// larger than the source; shrunk by area averaging. luma is BT.601 grey, full range (0 black, 255 white) whatever the
// file's own range; rotation flags are applied. picture() is rgb8.
// A path may be a video, one picture (a clip of one frame), a folder of pictures, a pattern such as frame_%04d.png, or a
// glob such as 'shots/*.jpg'. Pictures go in natural order (frame_2 before frame_10).
// Timestamps are sequence / fps. A frame that cannot be decoded leaves a gap in the sequence and does not end the clip.
// Cost: decoding, one resize, two colour conversions; no allocation of our own after the first frame.
#pragma once
#include <cstdint>

#include "platform/camera.h"
#include "platform/working_size.h"

namespace nt {

// fps_override > 0 replaces the file's frame rate (container rates of high-speed clips are often false).
// Throws UserError, one line: missing, not a video, without frames, too small (under 16x16), too large (over 8192).
std::unique_ptr<Camera> open_file_camera(const std::string& path, int work_width, int work_height,
                                         double fps_override = 0, int64_t most_pixels = 0);

}  // namespace nt
