// SPDX-License-Identifier: Apache-2.0
// Ghosts: blobs where something that the background model remembers is gone (a fish that was present in the first frame).
//
// A real object has its edges in the picture, a ghost has them in the background. Along the ends of a blob's runs the steps
// of both are summed up and compared.
// luma, background estimate, runs of one blob -> bool. Cost: eight pixel reads a run.
#pragma once
#include <span>

#include "core/base/image_view.h"
#include "core/segment/blobs.h"

namespace nt {

bool is_ghost(LumaView luma, LumaView background, std::span<const Run> runs, int label);

}  // namespace nt
