// SPDX-License-Identifier: Apache-2.0
// The choice between methods behind `--inputs auto`: which plain or dynamic model of one output the training data
// support, found by free runs inside the training range, and the average of those that they do not tell apart.
//
// Candidates (all linear in lags of the inputs, core/thermal/thermal_model.h, so that any average of them is one model
// that is stored, judged and run by the compensator as it is):
//   line        offset and a gain for each of a few inputs, no memory;
//   few lags    one time constant per input, chosen from a fine grid (the output-error structure with one pole per
//               input);
//   shared lags one or two time constants that all inputs share, from the same grid (the structure of ARX, whose inputs
//               have one denominator, fitted to free runs and not to the next row);
//   ridge       a dense grid of time constants per input, gains shrunk by a ridge of several strengths;
//   response    core/thermal/response_fit.h: drifting zero, physical prior of the gains; of many inputs the few that
//               tell what all of them tell (core/thermal/input_projection.h).
// All but the last are tried on every set of inputs (up to four inputs), or, without the shared ones, along a forward
// selection; of more than four,
// line and ridge on all temperatures and on all inputs too, which no search picked (they count as one input): what many
// noisy sensors have in common is told best by all of them. What is chosen is
// projected in the same way if it uses more inputs than ProjectionOptions::maximum_inputs.
//
// Evidence: every candidate is fitted to a part of the training range and runs free over the rest, for several rolling
// origins (the past predicts the future) and for blocks left out (the rest predicts the block; the block of the first
// warm-up is the one that leaves the range of the others). Each of these runs has its own scale: what counts is the
// mean of ln(mean squared error) over them, and over what the rows of the fit themselves let expect of new ones once
// every coefficient has had its price in independent rows: few runs tell simple candidates apart by chance, and few
// hours have few independent rows, so that the simple ones win there (core/thermal/method_evidence.h). Weights of
// candidates are a power of that geometric mean squared error, times a prior that makes every further input less
// probable. The power is 1 (Bates and Granger 1969) where the errors
// of the best candidate differ from run to run by factors of e and more, as in records that leave their range: there
// sharper weights choose by chance; it rises to 4 as that scatter falls. Between that average and `response` the errors
// of the averages themselves decide. A forward selection that tries a hundred sets of inputs is flattered by the runs
// that chose among them; so the whole search, inputs, time constants and weights, is made again for every run with the
// runs that share no row with it, and only the result of that search is judged there (nested cross-validation). Odds
// come from the mean difference over the runs, less where the runs disagree; where commanded speeds cut the training
// into at least three blocks of operation the physical prior of `response` has odds of 2.5 to 1 beforehand, that is,
// the others must be better by some evidence and not by much. Uncertainty: posterior of every candidate plus their
// scatter, which grows where the inputs leave what was seen; scaled so that errors and intervals agree in the runs that
// judged, and in those alone that predict all that comes after them, for `response` as for the others. Source: Bates
// and Granger 1969; Yao et al. 2018 (stacking and pseudo-BMA); Tashman 2000 (rolling origins); Varma and Simon 2006
// (nested cross-validation); Akaike 1970 (final prediction error). The equation
// error of ARX and the continuous poles of output error are no candidates, their structures are: in records of hours
// most ARX models have no equivalent in lags and output error has too few rows before the origins. Shared lags make
// records of two to four inputs better and those of a dozen not, where a forward selection has more to choose by
// chance; fits to whitened rows, as ARX weighs them, and a prior against each coefficient make none better
// (tests/benchmarks/thermal/choice_study.cpp). Failure:
// InputError as fitResponse; FitStatus Degenerate if nothing could be determined.
#pragma once

#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/thermal/input_projection.h"
#include "core/thermal/response_fit.h"

namespace spindrift {

struct MethodChoiceOptions {
  std::vector<double> taus_s = {0.0, 150.0, 300.0, 600.0, 1200.0, 2400.0, 4800.0, 9600.0};
  /// Of few lags: steps of sqrt(2), so that a time constant is met within a fifth.
  std::vector<double> few_lag_taus_s = {0.0,    150.0,  212.0,  300.0,  424.0,  600.0,  849.0,
                                        1200.0, 1697.0, 2400.0, 3394.0, 4800.0, 6788.0, 9600.0};
  std::vector<double> shrinkages = {1e-4, 1e-3, 1e-2, 1e-1};  ///< ridge relative to the variance of a lag
  std::vector<double> origins = {0.4, 0.55, 0.7, 0.85};       ///< parts of the training range
  double sharpness = 1.0;                                     ///< exponent at a scatter of 1 in ln(mean squared error)
  double sharpest = 4.0;                                      ///< largest exponent; the least is 1
  double input_penalty = 0.5;                                 ///< ln of the prior odds against each further input
  double response_odds = 2.5;  ///< prior odds for `response` where speeds make blocks of operation
  int maximum_inputs = 6;      ///< of the forward selection
  bool whole_sets = true;      ///< of more than four inputs: line and ridge on all of them too
  /// Whether the beginning of the training may be left out, where the machine still follows what was before the record:
  /// lags begin in balance with their inputs, and a machine that does not spoils every time constant. Tried where the
  /// first 15 % are twice as far off as the rest; done where models without the beginning predict the last 30 % of the
  /// training with less than half of the error.
  bool may_settle = true;
  ResponseFitOptions response;
  ProjectionOptions projection;  ///< of `response` on few inputs
  bool all_inputs = false;       ///< no choice among the inputs: `response` uses all of them
  /// Chosen already, because several outputs share them: `response` is projected onto these, the others use no more.
  std::vector<std::string> shared_inputs;

  /// Throws InputError.
  void validate() const;
};

/// What blocked evidence says of one method.
struct MethodEvidence {
  std::string method;         ///< "line", "few time constants", "shared time constants", "ridge", "response"
  double left_out_rms = 0.0;  ///< geometric mean over the runs inside the training range, unit of the output
  double weight = 0.0;        ///< share of the model
};

struct MethodChoiceResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  ThermalModel model;  ///< one output
  std::vector<InputVerdict> verdicts;
  std::vector<MethodEvidence> methods;
  double left_out_rms = 0.0;  ///< of the model, geometric mean over the runs
  std::vector<std::string> notes;
};

/// Training rows: `from_s` <= t < `to_s`.
[[nodiscard]] MethodChoiceResult chooseMethod(const TimeSeries& series, const std::string& output,
                                              const std::vector<std::string>& inputs, double from_s, double to_s,
                                              const MethodChoiceOptions& options, const JobContext& job);

/// The model whose prediction is sum weight_k prediction_k, for models of one output of the same name. Its covariance
/// is the weighted covariance plus the scatter of the models; empty if one of them has none.
[[nodiscard]] ThermalModel weightedAverage(const std::vector<ThermalModel>& models, const std::vector<double>& weights);

}  // namespace spindrift
