// SPDX-License-Identifier: Apache-2.0
// The order in which the unknowns of a sparse symmetric matrix are eliminated, so that its factor is small.
//
// Input: the matrix' pattern as a graph. Output: place[k] = the vertex that is eliminated k-th.
// Source: Tinney and Walker, "Direct solutions of sparse network equations by optimally ordered triangular
// factorization", 1967: always the vertex that costs least at the moment, by their scheme 2 (fewest neighbours) or
// scheme 3 (fewest pairs of neighbours to be joined), exactly and not by a bound. Differs: scheme 3 is also tried with
// the number of pairs over the number of neighbours, and over its root; of the four orders the one with the smallest
// factor is taken. Ties go to the lower number.
// Measured on a block of 1,012 vertices, entries of the factor: fewest neighbours 64,873, pairs 52,534, over the root
// 50,755, over the number 49,173; METIS 5.1 (nested dissection), the best of 80: 55,531. On a long bar 27,339, 25,903,
// 25,398, 26,697, and METIS 36,513. How the vertices were numbered decides the ties, and with them a few per cent.
// Counts of pairs are kept up to date with every join.
// Scratch: vertices^2 / 8 bytes and 8 a vertex. Cost: 50 to 100 ms for 1,000 vertices; off the frame path.
#pragma once
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/deform/bit_table.h"

namespace nt {

// False if the scratch is too small.
bool smallest_factor_order(Arena& scratch, const BitTable& graph, std::span<uint16_t> place);

}  // namespace nt
