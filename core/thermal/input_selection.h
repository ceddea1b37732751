// SPDX-License-Identifier: Apache-2.0
// Which inputs a model needs, and why: group LASSO over the lags of each input (TALC, P1), stability under resampling,
// and clusters of sensors that tell the same (P4's three groups).
//
// Group LASSO: minimise 1/(2n) |y - sum_g X_g w_g|^2 + lambda sum_g sqrt(p_g) |w_g| with every group orthonormalised,
// so that an input enters with all its lags or not at all. Block coordinate descent on a path of lambda; the lambda
// with the smallest error on blocks of time left out wins, and the simplest model within one standard error of it is
// taken (unless `strict` is false). The sets chosen are refitted by ridge for judging. Stability: the selection is
// repeated on random halves made of blocks of time; an input's frequency is how often it was chosen. Source: P1 ref.
// [10], [11] (adaptive input selection, group LASSO for ARX models); Yuan and Lin 2006; Meinshausen and Buehlmann 2010.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/thermal/time_series.h"

namespace spindrift {

struct SelectionOptions {
  std::vector<double> taus_s = {0.0, 900.0, 3600.0, 10800.0};  ///< lags of each input
  double speed_power = 1.5;
  int path = 25;             ///< values of lambda
  int blocks = 6;            ///< of time, for held-out error
  int resamples = 24;        ///< for stability
  double stable_from = 0.5;  ///< frequency from which an input counts as stable
  std::uint64_t seed = 1;
};

struct SelectedInput {
  std::string name;
  bool kept = false;
  double frequency = 0.0;      ///< of selection under resampling
  double enters_at = 0.0;      ///< lambda / largest lambda at which it enters the path (1: first)
  double error_without = 0.0;  ///< held-out rms of the kept set without it (kept) or with it added (dropped)
  std::string reason;
};

struct SelectionResult {
  std::string method;
  std::vector<SelectedInput> inputs;  ///< all candidates
  std::vector<std::string> kept;      ///< in order of entry
  double held_out_rms = 0.0;
};

[[nodiscard]] SelectionResult selectByGroupLasso(const TimeSeries& series, const std::string& output,
                                                 const std::vector<std::string>& candidates, double from_s, double to_s,
                                                 const SelectionOptions& options, const JobContext& job);

/// Sensors grouped by what they tell: average linkage on the rms difference of their changes, relative to the larger of
/// both changes.
struct SensorCluster {
  std::vector<std::string> names;
  double mean_change = 0.0;    ///< mean range of its sensors over the record
  std::string representative;  ///< the sensor closest to the others
};
/// `count` clusters (0: cut at the largest jump of the linkage), largest change first. Constant sensors form a cluster
/// of their own.
[[nodiscard]] std::vector<SensorCluster> clusterSensors(const TimeSeries& series, const std::vector<std::string>& names,
                                                        int count = 3);

}  // namespace spindrift
