// SPDX-License-Identifier: Apache-2.0
// The regressors of a response fit (private to thermal): every usable input, passed through lags of many time constants
// and, for speeds and feeds, raised to several powers, averaged over bins of equal length and centred.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/thermal/response_fit.h"

namespace spindrift::response {

/// One column of the dictionary.
struct Feature {
  int input = 0;  ///< in Dictionary::inputs
  double tau_s = 0.0;
  double spread = 0.0;     ///< rms over the training bins, about its mean
  double reference = 0.0;  ///< mean over the training bins
};

/// Units: those of the signals; time s.
struct Dictionary {
  std::vector<ThermalInput> inputs;
  std::vector<Feature> features;
  Eigen::MatrixXd X;  ///< bins x features, centred
  Eigen::VectorXd y;
  Eigen::VectorXd scatter;  ///< mean square of the rows about the mean of their bin
  double y_mean = 0.0;
  double typical_spread = 1.0;         ///< median over the temperatures' features
  double typical_driven_spread = 1.0;  ///< median over the features of speeds and feeds
  std::vector<double> time_s;
  double period_s = 0.0;
  std::vector<int> block;  ///< block of operation of each bin
  int blocks = 0;
  bool by_operation = false;  ///< blocks begin where a speed or feed leaves zero; else equal parts
};

/// Bins between `from_s` and `to_s` in which the output was measured; empty if there are none. `y`: the output at
/// every row.
[[nodiscard]] Dictionary buildDictionary(const TimeSeries& series, const std::vector<double>& y,
                                         const std::vector<std::string>& names, double from_s, double to_s,
                                         const ResponseFitOptions& options);

/// Drops what cannot be used and says why; of more than 64 columns those are kept that tell most, so that memory and
/// time stay what they are with 64. Throws InputError if an input is the output itself.
[[nodiscard]] std::vector<std::string> usableInputs(const TimeSeries& series, const std::string& output,
                                                    const std::vector<std::string>& names, double from_s, double to_s,
                                                    std::vector<InputVerdict>& verdicts);

/// Rows after removing the drift's correlation: (z_k - phi z_{k-1}), scaled where a gap makes phi smaller. Column 0 is
/// the offset.
struct Whitened {
  Eigen::MatrixXd X;
  Eigen::VectorXd y;
  double phi = 0.0;
};

[[nodiscard]] Whitened whiten(const Dictionary& d, double noise_tau_s);

/// Precision (inverse prior variance) of the gains of these columns of the dictionary, per innovation variance.
[[nodiscard]] Eigen::VectorXd priorPrecision(const Dictionary& d, const std::vector<Eigen::Index>& columns,
                                             double strength, double slow_preference,
                                             const ResponseFitOptions& options);

}  // namespace spindrift::response
