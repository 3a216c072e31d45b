// SPDX-License-Identifier: Apache-2.0
// Writes a picture as PNG. Pixels (luma8, rgb8 or rgba8, any stride) -> file; throws UserError with one line when the
// folder is missing, may not be written, or the disk is full. Cost: encoding in memory, one write.
#pragma once
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace nt {

// The file's bytes; `name` is for messages.
std::vector<uint8_t> png_bytes(const Picture& picture, const std::string& name);
void write_png(const std::string& path, const Picture& picture);

}  // namespace nt
