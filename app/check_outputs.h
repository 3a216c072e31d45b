// SPDX-License-Identifier: Apache-2.0
// Before a command works: no output may be one of the files that it reads, nor a folder, nor a take that is there, nor may two
// outputs be one file, and the folder of each is there.
//
// Paths -> UserError (one line; code 2, where the disk is not as it should be 1) or nothing. Empty paths and "-" (standard
// output) are passed over. Files are compared, not spellings: a link to the video is the video.
#pragma once
#include <string>
#include <vector>

namespace nt {

void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace nt
