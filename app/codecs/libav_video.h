// SPDX-License-Identifier: Apache-2.0
// Video files through libav, as app/export/video_writer.h promises. Compiled into libneontetra_codecs.so alone.
#pragma once
#include <memory>
#include <string>

#include "platform/codecs.h"

namespace nt {

std::unique_ptr<VideoFile> open_libav_video(const std::string& path, int width, int height, double fps);
const char* h264_encoder_name();  // null: none is installed

}  // namespace nt
