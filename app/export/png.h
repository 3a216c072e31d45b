// SPDX-License-Identifier: Apache-2.0
// Writes a picture as PNG. Pixels (luma8, rgb8 or rgba8, any stride) -> file; throws UserError with one line when the
// folder is missing, may not be written, or the disk is full. Cost: encoding in memory, one write.
#pragma once
#include <string>

#include "core/scene/scene.h"

namespace nt {

void write_png(const std::string& path, const Picture& picture);

}  // namespace nt
