// SPDX-License-Identifier: Apache-2.0
// Resident memory of this process, bytes, from /proc/self/status; 0 where that is not to be had.
#pragma once
#include <cstdint>

namespace nt {

int64_t resident_bytes();       // now
int64_t peak_resident_bytes();  // the most so far

}  // namespace nt
