// SPDX-License-Identifier: Apache-2.0
// Whittaker smoother: weighted values on the stations of an axis -> the smooth curve that follows them.
//
// Minimises sum w_j (x_j - y_j)^2 + lambda sum (x_(j-1) - 2 x_j + x_(j+1))^2 (Eilers 2003); weight 0 makes a gap that is
// bridged smoothly. `lower_envelope` is the asymmetric variant (Eilers and Boelens 2005): values above the curve hardly
// count, so the curve runs along the foot of peaks.
// Cost: a banded Cholesky factorisation of kStations unknowns, about 1 microsecond a solve; the envelope takes six.
#pragma once
#include <array>

#include "core/outline/stations.h"

namespace nt {

using StationValues = std::array<float, kStations>;

StationValues smoothed(const StationValues& values, const StationValues& weights, float lambda);
StationValues lower_envelope(const StationValues& values, float lambda);

}  // namespace nt
