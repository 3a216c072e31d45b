// SPDX-License-Identifier: Apache-2.0
#include "core/base/simd_target.h"

#include "hwy/highway.h"

namespace nt {

const char* simd_target() { return hwy::TargetName(HWY_TARGET); }

}  // namespace nt
