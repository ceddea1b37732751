// SPDX-License-Identifier: Apache-2.0
// The pattern of operation in which a model was trained: where its inputs stood together, so that a new pattern is seen
// although every input alone stays within its range (a cold spindle in a hot room, a bed that cools under a hot frame).
//
// Model: z holds every input and its lag of `lag_s`, centred and in units of its spread over training, turned into
// uncorrelated directions of unit variance; a direction that hardly occurred counts as if it had 1 % of the variance of
// an input, below which a difference between inputs is noise of the sensors and no pattern. Places of training that
// cover all its rows are kept (at most 48, each the furthest from those before: Gonzalez 1985). With d the distance to
// the nearest of them,
//   novelty = d / (1 + r),   r: the largest d of training,
// so that up to 1 a pattern lies within one spread of something seen. What a model leaves in training grows with the
// distance from it: in a new pattern a prediction multiplies that remainder by the novelty; what the gains contribute
// to the uncertainty grows by itself. Failure: InputError for an input that is not in the series.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace spindrift {

struct TimeSeries;

struct TrainingPattern {
  std::vector<std::string> inputs;  ///< columns of the log
  double lag_s = 0.0;
  Eigen::VectorXd mean;        ///< of the inputs, then of their lags; units of the inputs
  Eigen::MatrixXd directions;  ///< from (values - mean) to coordinates: coordinates = directions * (values - mean)
  Eigen::MatrixXd seen;        ///< coordinates of the places, one a row
  double reach = 0.0;          ///< 1 + r

  /// At every row; up to 1 was seen.
  [[nodiscard]] std::vector<double> novelty(const TimeSeries& series) const;
  /// The two inputs that are furthest from each other at a row, measured by how far apart they were in training, where
  /// together they are further out than each alone by more than both together by as much again; else nothing.
  [[nodiscard]] std::vector<std::string> apart(const TimeSeries& series, std::size_t row) const;
};

/// Of these columns over from_s <= t < to_s; inputs that do not change there are left out. The lag is a twentieth of
/// the time of training, at most an hour.
[[nodiscard]] TrainingPattern trainingPattern(const TimeSeries& series, const std::vector<std::string>& inputs,
                                              double from_s, double to_s);

}  // namespace spindrift
