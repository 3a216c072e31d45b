// SPDX-License-Identifier: Apache-2.0
// The valid name nearest to a mistyped one, by edit distance, for "did you mean" in messages.
#pragma once
#include <string>
#include <vector>

namespace nt {

// Insertions, deletions, replacements and swaps of neighbours, each 1. O(|a| |b|).
int edit_distance(const std::string& a, const std::string& b);

// The nearest of `names` (the first of equals); "" when there are none.
std::string nearest_name(const std::string& wanted, const std::vector<std::string>& names);

// "a, b, c"
std::string joined(const std::vector<std::string>& names);

}  // namespace nt
