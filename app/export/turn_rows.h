// SPDX-License-Identifier: Apache-2.0
// Rows of a pose CSV turned round: what was called the head is the tail.
//
// A CSV (docs/FORMATS.md) and one flag for each row with a pose -> the same file with these rows turned: head and tail
// exchanged, the midline run through backwards and sampled anew, the direction reversed and kept continuous from row to row.
// Pectoral fins of a turned row were looked for behind the wrong end: they are left out, with confidence 0. Its head and
// tail confidence is what the live filter left for this order, below 0.5.
// The new file is written beside the old one and takes its place when it is complete: whatever stops the program, one of the
// two is there whole. Cost: one pass over the file, a row in memory at a time.
#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace nt {

// One row, without the line's end. `u_num`, `l_num`: points of the midline in it. Rows that are not as written are kept.
std::string turned_row(const std::string& row, int u_num, int l_num);

// `turned`: one entry for each row with status ok, in order. Returns how many rows were turned; the file is not touched
// where that is 0, nor where it is no regular file. Throws UserError; the file is then as it was.
int64_t turn_rows(const std::string& path, std::span<const uint8_t> turned, int u_num, int l_num);

}  // namespace nt
