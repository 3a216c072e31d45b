// SPDX-License-Identifier: Apache-2.0
// Where fish can be: --roi and --tank -> a picture as large as the working frame, 255 inside, 0 outside.
//
// Corners are pixels of the source video; a picture is fitted to the frame, and what of it is darker than middle grey is
// outside. With both options only what lies in both is inside.
#pragma once
#include <opencv2/core/mat.hpp>

#include "app/options.h"
#include "platform/camera.h"

namespace nt {

// Empty when fish can be everywhere. Throws UserError for a picture that cannot be read, corners outside of the source
// picture, and where nothing is left.
cv::Mat tank_mask(const AreaOptions& area, const CameraInfo& info);

}  // namespace nt
