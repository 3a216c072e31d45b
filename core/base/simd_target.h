// SPDX-License-Identifier: Apache-2.0
// The instruction set that Highway's static dispatch was built for: "SSSE3", "NEON", "SCALAR", ...
// Shown by `doctor` and `bench`, because a wrong -march silently builds scalar code.
#pragma once

namespace nt {

const char* simd_target();

}  // namespace nt
