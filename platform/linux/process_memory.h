// SPDX-License-Identifier: Apache-2.0
// Resident memory of this process. Bytes, from /proc/self/status; 0 where that is not to be had.
#pragma once
#include <cstdint>

namespace nt {

int64_t resident_bytes();       // now
int64_t peak_resident_bytes();  // the most so far
// Freed memory goes back to the system now. glibc keeps it otherwise, once it has seen large blocks come and go.
void give_back_freed_memory();

}  // namespace nt
