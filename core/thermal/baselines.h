// SPDX-License-Identifier: Apache-2.0
// Plain models that stand beside every dynamic one, so that nobody mistakes an easy record for a good model:
// "no model" (the mean of training) and "static regression on all temperatures" (least squares, no memory).
// Two further plain peers for studies: one first-order ARX on two inputs, and ridge regression over lagged inputs with
// forward selection. All are trained on rows from_s <= t < to_s and predict every row in free run.
#pragma once

#include <string>
#include <vector>

#include "core/thermal/time_series.h"

namespace spindrift {

struct PlainModel {
  std::string name;
  std::vector<double> prediction;  ///< one per row of the series
  std::string note;
};

[[nodiscard]] PlainModel noModel(const TimeSeries& series, const std::string& output, double from_s, double to_s);
/// All temperatures of the series that change. Without any, the note says so and the prediction is the mean.
[[nodiscard]] PlainModel staticRegression(const TimeSeries& series, const std::string& output, double from_s,
                                          double to_s);
/// y(k) = a y(k-1) + b1 u1(k) + b2 u2(k) + c at 60 s: the hottest temperature and the speed, simulated in free run.
[[nodiscard]] PlainModel firstOrderArx(const TimeSeries& series, const std::string& output, double from_s, double to_s);
/// Ridge over lags of 0, 10 min, 30 min and 90 min of every temperature and speed, speed^2; up to 8 inputs chosen
/// forward by the error in the last quarter of training.
[[nodiscard]] PlainModel laggedRidge(const TimeSeries& series, const std::string& output, double from_s, double to_s);

}  // namespace spindrift
