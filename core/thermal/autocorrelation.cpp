// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/autocorrelation.h"

#include <algorithm>
#include <bit>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace spindrift {

std::vector<double> autocorrelation(std::span<const double> values, std::size_t lags) {
  if (values.empty()) return {};
  lags = std::min(lags, values.size() - 1);
  std::vector<double> padded(std::bit_ceil(2 * values.size()), 0.0);
  std::copy(values.begin(), values.end(), padded.begin());
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, padded);
  for (std::complex<double>& s : spectrum) s = std::norm(s);
  fft.inv(padded, spectrum);
  const double zero = padded[0];
  std::vector<double> out(lags + 1, 0.0);
  if (zero > 0.0)
    for (std::size_t k = 0; k <= lags; ++k) out[k] = padded[k] / zero;
  return out;
}

}  // namespace spindrift
