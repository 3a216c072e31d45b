// SPDX-License-Identifier: Apache-2.0
// One frame of a take <-> the bytes of its row: little-endian 32-bit floats in the order of docs/FORMATS.md.
#pragma once
#include <span>
#include <vector>

#include "app/take/take.h"

namespace nt {

std::size_t take_row_size(int u_num, int l_num);  // bytes
void write_take_row(const TakeFrame& frame, std::vector<std::byte>& row);
// Everything but number, fish, time, status and flags, which are columns of their own. False: not a row of this size.
bool read_take_row(std::span<const std::byte> row, int u_num, int l_num, TakeFrame& frame);

}  // namespace nt
