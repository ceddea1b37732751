// SPDX-License-Identifier: Apache-2.0
// Autocorrelation of a uniformly sampled record by fast Fourier transform (Wiener and Khinchin), n ln n.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace spindrift {

/// r(k) = sum_i v(i) v(i - k) / sum_i v(i)^2 for k = 0 ... lags (at most n - 1), without taking a mean away; the record
/// is padded with zeros, so that its end does not meet its start. All zero for a record of zeros, empty for none.
[[nodiscard]] std::vector<double> autocorrelation(std::span<const double> values, std::size_t lags);

}  // namespace spindrift
