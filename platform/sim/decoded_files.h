// SPDX-License-Identifier: Apache-2.0
// Video and picture files through OpenCV, as frame_source.h promises. Compiled into libneontetra_codecs.so alone.
#pragma once
#include <memory>
#include <string>

#include "platform/sim/frame_source.h"

namespace nt {

std::unique_ptr<FrameSource> open_decoded_files(const std::string& path);

}  // namespace nt
