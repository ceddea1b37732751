// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/adaptive.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/math/statistics.h"
#include "core/thermal/input_selection.h"
#include "core/thermal/measurement_update.h"

namespace spindrift {
namespace {

/// The model of one error as it stands, with its free run over the whole record (causal: row r only depends on rows up
/// to r).
struct LiveModel {
  std::vector<double> run;
  /// Columns, one per row of the series at which a decision is made: the model's own error at two of them differs by
  /// |column - column| (standard uncertainty).
  Eigen::MatrixXd error;
  std::vector<char> outside;
  std::vector<std::string> inputs;
  double remainder = 1.0;

  /// How far the model's own error may have moved between two decisions.
  [[nodiscard]] double sigmaSince(Eigen::Index corrected, Eigen::Index now) const {
    return (error.col(now) - error.col(corrected)).norm();
  }
};

class Replay {
 public:
  Replay(const TimeSeries& series, const std::vector<AdaptiveError>& errors, const std::vector<std::string>& candidates,
         const AdaptiveOptions& options, const JobContext& job)
      : series_(series),
        errors_(errors),
        candidates_(candidates),
        options_(options),
        job_(job),
        random_(options.seed),
        known_(series) {
    for (const AdaptiveError& e : errors_) {
      truth_.push_back(series.at(e.name).values);
      for (Signal& s : known_.signals)
        if (s.name == e.name) std::fill(s.values.begin(), s.values.end(), std::nan(""));
    }
  }

  /// Models of the setup, one per error.
  std::vector<LiveModel> setUp();
  /// `models`: of the setup; none: they are found here.
  AdaptiveResult run(std::vector<LiveModel> models = {});

 private:
  /// Measures through the setup; the first row after it.
  std::size_t measureSetup(AdaptiveResult& result, std::size_t& last_setup_row);

  void measure(std::size_t row) {
    for (std::size_t e = 0; e < errors_.size(); ++e) {
      if (!std::isfinite(truth_[e][row])) continue;
      for (Signal& s : known_.signals)
        if (s.name == errors_[e].name)
          s.values[row] =
              truth_[e][row] + (options_.add_noise ? random_.normal(0.0, errors_[e].measurement_sigma) : 0.0);
    }
  }
  void forget(std::size_t error, std::size_t row) {
    for (Signal& s : known_.signals)
      if (s.name == errors_[error].name) s.values[row] = std::nan("");
  }
  [[nodiscard]] bool measurable(std::size_t row) const {
    return std::any_of(truth_.begin(), truth_.end(), [row](const auto& t) { return std::isfinite(t[row]); });
  }
  [[nodiscard]] double measured(std::size_t error, std::size_t row) const {
    return known_.at(errors_[error].name).values[row];
  }

  LiveModel identify(std::size_t error, double until_s) const {
    ResponseFitOptions fit;
    fit.period_s = series_.medianPeriod_s();
    fit.strengths = {0.5};
    fit.slow_preferences = {0.25};
    fit.minimum_samples = 20;
    fit.judge_inputs = false;
    std::vector<std::string> inputs = candidates_;
    const auto& values = known_.at(errors_[error].name).values;
    const auto count = std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (options_.select_inputs && count >= 45) {
      SelectionOptions selection;
      selection.resamples = 0;
      const SelectionResult chosen =
          selectByGroupLasso(known_, errors_[error].name, candidates_, -1e300, until_s, selection, job_);
      if (chosen.kept.size() >= 2) inputs = chosen.kept;
    }
    const ResponseFitResult result = fitResponse(known_, errors_[error].name, inputs, -1e300, until_s, fit, job_);
    if (result.status != FitStatus::Converged)
      throw InputError({series_.file, fmt::format("column {}", errors_[error].name)}, result.message);
    LiveModel live;
    const ThermalOutput& output = result.model.outputs.front();
    live.remainder = std::max(output.noise_sigma, errors_[error].measurement_sigma);
    const Eigen::MatrixXd x = result.model.features(series_, 0);
    Eigen::VectorXd coefficients(static_cast<Eigen::Index>(output.terms.size()) + 1);
    coefficients[0] = output.offset;
    for (std::size_t k = 0; k < output.terms.size(); ++k)
      coefficients[static_cast<Eigen::Index>(k) + 1] = output.terms[k].gain;
    const Eigen::VectorXd run = x * coefficients;
    live.run.assign(run.data(), run.data() + run.size());
    live.outside = result.model.outsideTraining(series_, 0);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(output.covariance);
    const Eigen::MatrixXd root = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    const Eigen::MatrixXd at_decisions = x(decision_rows_, Eigen::all);
    live.error = root.transpose() * at_decisions.transpose();
    for (const ThermalInput& input : result.model.inputs)
      if (std::find(live.inputs.begin(), live.inputs.end(), input.name) == live.inputs.end())
        live.inputs.push_back(input.name);
    return live;
  }

  [[nodiscard]] GainOffsetFilter freshFilter(std::size_t error, const LiveModel& live) const {
    UpdateOptions update;
    update.measurement_sigma = errors_[error].measurement_sigma;
    update.offset_sigma = std::max(live.remainder, errors_[error].trigger_sigma);
    update.offset_tau_s = 8.0 * 3600.0;
    update.gain_sigma = 0.1;
    update.gain_drift_per_sqrt_h = 0.02;
    return GainOffsetFilter(update);
  }

  const TimeSeries& series_;
  const std::vector<AdaptiveError>& errors_;
  const std::vector<std::string>& candidates_;
  const AdaptiveOptions& options_;
  const JobContext& job_;
  Random random_;
  TimeSeries known_;  ///< what the algorithm may see
  std::vector<std::vector<double>> truth_;
  /// The last row measured in the setup, then every row at which the triggers are looked at. They depend on the record
  /// alone, so the error of a model is worked out there only and not at every row of a fast log.
  std::vector<Eigen::Index> decision_rows_;
};

std::size_t Replay::measureSetup(AdaptiveResult& result, std::size_t& last_setup_row) {
  const std::vector<double>& time = series_.time_s;
  const double live_from = time.front() + options_.setup_s;
  const double half_row = 0.5 * series_.medianPeriod_s();  // recorded cycles stand at the nearest row
  std::size_t row = 0;
  double next = time.front();
  for (; row < time.size() && time[row] < live_from; ++row) {
    if (time[row] < next || !measurable(row)) continue;
    next = std::max(next + options_.setup_interval_s, time[row] - half_row + options_.setup_interval_s);
    measure(row);
    last_setup_row = row;
    ++result.setup_measurements;
  }
  if (row >= time.size()) {
    throw InputError(
        {series_.file, ""},
        fmt::format(
            "the record ends before the setup of {:.6g} s is over; allowed: a longer record or a shorter setup.",
            options_.setup_s));
  }
  decision_rows_ = {static_cast<Eigen::Index>(last_setup_row)};
  double next_decision = live_from;
  for (std::size_t r = row; r < time.size(); ++r) {
    if (time[r] < next_decision || !measurable(r)) continue;
    while (next_decision <= time[r]) next_decision += options_.decision_s;
    decision_rows_.push_back(static_cast<Eigen::Index>(r));
  }
  return row;
}

std::vector<LiveModel> Replay::setUp() {
  AdaptiveResult unused;
  std::size_t last_setup_row = 0;
  measureSetup(unused, last_setup_row);
  std::vector<LiveModel> models(errors_.size());
  parallelFor(errors_.size(), job_,
              [&](std::size_t e) { models[e] = identify(e, series_.time_s.front() + options_.setup_s); });
  return models;
}

AdaptiveResult Replay::run(std::vector<LiveModel> models) {
  AdaptiveResult result;
  const std::vector<double>& time = series_.time_s;
  const double live_from = time.front() + options_.setup_s;
  const double half_row = 0.5 * series_.medianPeriod_s();
  std::size_t last_setup_row = 0;
  std::size_t row = measureSetup(result, last_setup_row);
  const std::size_t first_live = row;
  const bool given = !models.empty();
  std::vector<GainOffsetFilter> filters;
  for (std::size_t e = 0; e < errors_.size(); ++e) {
    if (!given) models.push_back(identify(e, live_from));
    filters.push_back(freshFilter(e, models[e]));
    AdaptiveErrorResult out;
    out.name = errors_[e].name;
    out.static_prediction = models[e].run;
    out.adaptive_prediction.assign(time.size(), 0.0);
    std::fill(out.static_prediction.begin(), out.static_prediction.begin() + static_cast<std::ptrdiff_t>(first_live),
              0.0);
    result.errors.push_back(std::move(out));
    result.events.push_back(
        {live_from, AdaptiveEventKind::Setup,
         fmt::format("model of {} from {} measurements with {} inputs: {}", errors_[e].name, result.setup_measurements,
                     models[e].inputs.size(), joinedList(models[e].inputs))});
  }
  double last_measurement = live_from;
  std::size_t measured_row = last_setup_row;
  Eigen::Index measured_decision = 0;  // place of measured_row in decision_rows_
  Eigen::Index decision = 0;
  double demanded = -1.0;  // time of a measurement that an exceedance asked for
  std::string trigger;
  for (; row < time.size(); ++row) {
    const double dt = row > first_live ? time[row] - time[row - 1] : 0.0;
    for (std::size_t e = 0; e < errors_.size(); ++e) {
      filters[e].advance(dt);
      result.errors[e].adaptive_prediction[row] = filters[e].value(models[e].run[row]);
    }
    if (decision + 1 >= std::ssize(decision_rows_) ||
        static_cast<Eigen::Index>(row) != decision_rows_[static_cast<std::size_t>(decision) + 1])
      continue;
    ++decision;
    if (row % 64 == 0)
      job_.report(static_cast<double>(row) / static_cast<double>(time.size()), "replaying the campaign");
    job_.throwIfCancelled();
    const double since = time[row] - last_measurement;
    if (since + half_row < options_.shortest_interval_s) continue;
    trigger.clear();
    if (demanded >= 0.0 && time[row] + half_row >= demanded) trigger = "asked for by the last exceedance";
    if (trigger.empty() && since + half_row >= options_.longest_interval_s)
      trigger = "longest interval without a measurement";
    for (std::size_t e = 0; e < errors_.size() && trigger.empty(); ++e) {
      const double sigma =
          std::hypot(filters[e].sigma(models[e].run[row]), models[e].sigmaSince(measured_decision, decision));
      if (sigma > errors_[e].trigger_sigma) {
        trigger = fmt::format("uncertainty of {} is {:.2f}", errors_[e].name, sigma);
      } else if (models[e].outside[row] > models[e].outside[measured_row] &&
                 since >= 2.0 * options_.shortest_interval_s) {
        trigger = fmt::format("a temperature pattern that the model of {} has not seen", errors_[e].name);
      }
    }
    if (trigger.empty()) continue;
    measure(row);
    ++result.measurements;
    last_measurement = time[row];
    const Eigen::Index corrected = measured_decision;
    measured_row = row;
    measured_decision = decision;
    demanded = -1.0;
    result.events.push_back({time[row], AdaptiveEventKind::Measurement, trigger});
    std::vector<std::size_t> exceeded;
    for (std::size_t e = 0; e < errors_.size(); ++e) {
      const double value = measured(e, row);
      if (!std::isfinite(value)) continue;
      const double difference = value - filters[e].value(models[e].run[row]);
      if (!filters[e].measure(value, models[e].run[row], {}, models[e].sigmaSince(corrected, decision))) {
        forget(e, row);
        demanded = time[row] + options_.shortest_interval_s;
        result.events.push_back({time[row], AdaptiveEventKind::Refused,
                                 fmt::format("{} measured {:+.2f} off the prediction, far beyond its uncertainty: used "
                                             "if the next measurement confirms it",
                                             errors_[e].name, difference)});
        continue;
      }
      if (std::abs(difference) <= errors_[e].action_limit) continue;
      exceeded.push_back(e);
      result.events.push_back({time[row], AdaptiveEventKind::LimitExceeded,
                               fmt::format("{} measured {:+.2f} beside the prediction, limit {:.2f}", errors_[e].name,
                                           difference, errors_[e].action_limit)});
    }
    if (exceeded.empty()) continue;
    demanded = time[row] + options_.shortest_interval_s;
    for (const std::size_t e : exceeded) {
      if (static_cast<int>(result.reidentifications) >= options_.maximum_reidentifications) break;
      models[e] = identify(e, time[row] + 1e-6);
      filters[e] = freshFilter(e, models[e]);
      (void)filters[e].measure(measured(e, row), models[e].run[row]);  // the first of a new filter is never refused
      ++result.reidentifications;
      result.events.push_back({time[row], AdaptiveEventKind::Reidentified,
                               fmt::format("model of {} identified again with {} inputs: {}", errors_[e].name,
                                           models[e].inputs.size(), joinedList(models[e].inputs))});
    }
  }
  for (std::size_t e = 0; e < errors_.size(); ++e) {
    AdaptiveErrorResult& out = result.errors[e];
    const double zero = *std::find_if(truth_[e].begin(), truth_[e].end(), [](double v) { return std::isfinite(v); });
    std::vector<double> none;
    std::vector<double> fixed;
    std::vector<double> adaptive;
    for (std::size_t r = first_live; r < time.size(); ++r) {
      if (!std::isfinite(truth_[e][r])) continue;
      none.push_back(truth_[e][r] - zero);
      fixed.push_back(truth_[e][r] - out.static_prediction[r]);
      adaptive.push_back(truth_[e][r] - out.adaptive_prediction[r]);
    }
    out.rms_uncompensated = rootMeanSquare(none);
    out.rms_static = rootMeanSquare(fixed);
    out.rms_adaptive = rootMeanSquare(adaptive);
    out.static_reduction_percent = 100.0 * (1.0 - out.rms_static / out.rms_uncompensated);
    out.adaptive_reduction_percent = 100.0 * (1.0 - out.rms_adaptive / out.rms_uncompensated);
  }
  return result;
}

}  // namespace

void AdaptiveOptions::validate() const {
  if (!(setup_s > 0.0) || !(setup_interval_s > 0.0) || !(shortest_interval_s > 0.0) ||
      !(longest_interval_s >= shortest_interval_s) || !(decision_s > 0.0)) {
    throw InputError(
        "an interval of the adaptive compensation is not positive, or the longest is shorter than the shortest.");
  }
  if (setup_s / setup_interval_s < 20.0)
    throw InputError("the setup holds fewer than 20 measurements; allowed: a longer setup or a shorter interval.");
}

std::string_view toString(AdaptiveEventKind kind) noexcept {
  switch (kind) {
    case AdaptiveEventKind::Setup:
      return "setup";
    case AdaptiveEventKind::Measurement:
      return "measurement";
    case AdaptiveEventKind::Refused:
      return "refused";
    case AdaptiveEventKind::LimitExceeded:
      return "limit exceeded";
    case AdaptiveEventKind::Reidentified:
      return "re-identified";
  }
  return "event";
}

namespace {

void check(const TimeSeries& series, const std::vector<AdaptiveError>& errors, const AdaptiveOptions& options) {
  options.validate();
  if (errors.empty()) throw InputError("no error was named; allowed: at least one measured column.");
  if (series.time_s.empty()) throw InputError({series.file, ""}, "has no rows.");
  for (const AdaptiveError& e : errors) {
    if (!(e.measurement_sigma > 0.0) || !(e.action_limit > 0.0) || !(e.trigger_sigma > 0.0)) {
      throw InputError(fmt::format("limit and uncertainties of {} must be positive.", e.name));
    }
  }
}

}  // namespace

AdaptiveResult replayAdaptive(const TimeSeries& series, const std::vector<AdaptiveError>& errors,
                              const std::vector<std::string>& candidates, const AdaptiveOptions& options,
                              const JobContext& job) {
  check(series, errors, options);
  return Replay(series, errors, candidates, options, job).run();
}

std::vector<AdaptiveResult> replayAdaptive(const TimeSeries& series, const std::vector<AdaptiveError>& errors,
                                           const std::vector<std::string>& candidates, const AdaptiveOptions& options,
                                           const std::vector<double>& scales, const JobContext& job) {
  check(series, errors, options);
  const std::vector<LiveModel> setup = Replay(series, errors, candidates, options, job.part(0.0, 0.1)).setUp();
  std::vector<AdaptiveResult> results(scales.size());
  const JobContext live = job.part(0.1, 1.0);
  parallelFor(scales.size(), live, [&](std::size_t s) {
    std::vector<AdaptiveError> scaled = errors;
    for (AdaptiveError& e : scaled) {
      e.action_limit *= scales[s];
      e.trigger_sigma *= scales[s];
    }
    AdaptiveOptions own = options;
    own.longest_interval_s = std::max(options.shortest_interval_s, options.longest_interval_s * scales[s]);
    results[s] = Replay(series, scaled, candidates, own, live).run(setup);
  });
  return results;
}

}  // namespace spindrift
