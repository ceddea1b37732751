// SPDX-License-Identifier: Apache-2.0
// Few inputs that tell what a model of many inputs tells: projection of its prediction.
//
// A selection by the error of blocks left out chooses by chance where sensors move together: on real spindle data it
// costs half as much again in new operation. Instead the model with all inputs (core/thermal/response_fit.h), which
// averages what its sensors have in common, is the reference. Inputs enter one after another, each time the one with
// which a ridge regression on the lags of all inputs so far leaves least of the reference's course,
//   left^2 = sum_o |f_o - X w_o|^2 / |f_o|^2    (f_o centred prediction of output o over training),
// until the root of its mean over the outputs is below `tolerance`, or there are `maximum_inputs`. Several outputs
// share their inputs in this way. The kept inputs begin with the gains that they have in the reference, and the same
// ridge shrinks what these change by to take over the rest: sensors that move together in training and part later do
// not exchange their gains. Stability: the same on random halves made of blocks of time; the frequency of an
// input is how often it was chosen. Source: Piironen, Paasiniemi and Vehtari 2020 (projective inference); Meinshausen
// and Buehlmann 2010 (stability).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {

struct ProjectionOptions {
  int maximum_inputs = 8;
  double tolerance = 5e-4;  ///< of the spread of the reference
  double shrinkage = 1e-4;  ///< ridge relative to the variance of a lag
  int resamples = 16;
  std::uint64_t seed = 1;
};

struct ProjectedInput {
  std::string name;
  bool kept = false;
  double frequency = 0.0;  ///< part of the resamples in which it was chosen
  double left = 0.0;       ///< what is left of the reference without it (kept) or with it added (dropped)
};

struct ProjectionResult {
  std::vector<ProjectedInput> inputs;  ///< all, those kept first in order of entry
  std::vector<std::string> kept;
  double left = 0.0;  ///< root of the mean square that the kept inputs leave of the reference, relative
};

/// `models`: one output each, of the same series; rows from_s <= t < to_s.
[[nodiscard]] ProjectionResult projectOntoFewInputs(const TimeSeries& series, const std::vector<ThermalModel>& models,
                                                    double from_s, double to_s, const ProjectionOptions& options,
                                                    const JobContext& job);

struct ProjectedModel {
  ThermalModel model;                    ///< kind "response", one output
  std::vector<double> contribution_rms;  ///< over training, of each kept input in the order of `kept`
};

/// A model of one output, projected onto the lags of its kept inputs.
[[nodiscard]] ProjectedModel projectModel(const TimeSeries& series, const ThermalModel& model,
                                          const std::vector<std::string>& kept, double from_s, double to_s,
                                          const ProjectionOptions& options);

}  // namespace spindrift
