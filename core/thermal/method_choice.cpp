// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/method_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "core/thermal/method_average.h"
#include "core/thermal/method_candidates.h"
#include "core/thermal/method_evidence.h"
#include "core/thermal/response_dictionary.h"

namespace spindrift {

using namespace choice;
using namespace response;

namespace {

/// Isolated slips of the probe: rows further from the median of their seven neighbours than noise and course allow.
/// A median follows every monotonic course exactly.
std::size_t removeSlips(const std::vector<double>& time_s, std::vector<double>& y, double from_s, double to_s) {
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < y.size(); ++r)
    if (time_s[r] >= from_s && time_s[r] < to_s && std::isfinite(y[r])) rows.push_back(r);
  if (rows.size() < 20) return 0;
  std::vector<double> values;
  for (const std::size_t r : rows) values.push_back(y[r]);
  const double range = quantile(values, 0.95) - quantile(values, 0.05);
  std::vector<double> off(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t a = std::min(k >= 3 ? k - 3 : 0, rows.size() - 7);
    off[k] = values[k] - median(std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(a),
                                                    values.begin() + static_cast<std::ptrdiff_t>(a + 7)));
  }
  const double limit = std::max(8.0 * robustSigma(off), 0.25 * range);
  std::size_t removed = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (std::abs(off[k]) <= limit) continue;
    y[rows[k]] = std::nan("");
    ++removed;
  }
  return removed;
}

std::string nameOf(Method method) {
  switch (method) {
    case Method::Line:
      return "line";
    case Method::FewLags:
      return "few time constants";
    case Method::SharedLags:
      return "shared time constants";
    case Method::Ridge:
      return "ridge";
    case Method::Response:
      break;
  }
  return "response";
}

/// Signals, whatever the number of powers that a speed enters with.
int inputCount(const ThermalModel& model) {
  std::set<std::string> names;
  for (const ThermalInput& input : model.inputs) names.insert(input.name);
  return static_cast<int>(names.size());
}

}  // namespace

void MethodChoiceOptions::validate() const {
  response.validate();
  if (taus_s.empty() || few_lag_taus_s.empty() || shrinkages.empty() || maximum_inputs < 1)
    throw InputError("an option of the choice between methods is empty; allowed: at least one value each.");
  if (!(sharpness > 0.0) || !(sharpest >= 1.0) || !(input_penalty >= 0.0) || !(response_odds > 0.0))
    throw InputError("sharpness and odds of the choice between methods must be positive.");
  for (const double part : origins)
    if (!(part > 0.0 && part < 1.0)) throw InputError("an origin of the choice must lie between 0 and 1.");
}

namespace {

/// rms of measured minus predicted over rows that were measured; NaN where there are fewer than ten.
double errorOver(const TimeSeries& series, const ThermalModel& model, double from_s, double to_s) {
  const ThermalPrediction prediction = model.predict(series, 0);
  const std::vector<double>& measured = series.at(model.outputs.front().name).values;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t r = 0; r < series.time_s.size(); ++r) {
    if (series.time_s[r] < from_s || series.time_s[r] >= to_s) continue;
    const double error = measured[r] - prediction.value[r];
    if (!std::isfinite(error)) continue;
    squares += error * error;
    ++count;
  }
  constexpr std::size_t least = 10;
  return count < least ? std::nan("") : std::sqrt(squares / static_cast<double>(count));
}

MethodChoiceResult chooseWithin(const TimeSeries& series, const std::string& output,
                                const std::vector<std::string>& names, double from_s, double to_s,
                                const MethodChoiceOptions& options, const JobContext& job);

/// How much of the beginning is better left out, as a part of the training; 0: none.
double unsettledPart(const TimeSeries& series, const std::string& output, const std::vector<std::string>& names,
                     double from_s, double to_s, const ThermalModel& whole, const MethodChoiceOptions& options,
                     const JobContext& job) {
  constexpr double beginning = 0.15;
  constexpr double far_off = 2.0;
  constexpr double judged_from = 0.7;
  constexpr double telling = 0.5;
  const double span = to_s - from_s;
  const double early = errorOver(series, whole, from_s, from_s + beginning * span);
  const double later = errorOver(series, whole, from_s + 2.0 * beginning * span, to_s);
  if (!(early > far_off * later)) return 0.0;
  const double split = from_s + judged_from * span;
  constexpr std::array parts{0.0, 0.1, 0.2, 0.3};
  double best = std::numeric_limits<double>::infinity();
  double with_all = best;
  double best_part = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto at = static_cast<double>(i) / static_cast<double>(parts.size());
    try {
      const MethodChoiceResult without = chooseWithin(series, output, names, from_s + parts[i] * span, split, options,
                                                      job.part(at, at + 1.0 / static_cast<double>(parts.size())));
      if (without.status != FitStatus::Converged) continue;
      const double error = errorOver(series, without.model, split, to_s);
      if (i == 0) with_all = error;
      if (!(error < best)) continue;
      best = error;
      best_part = parts[i];
    } catch (const InputError&) {
      continue;  // too little is left
    }
  }
  return best < telling * with_all ? best_part : 0.0;
}

}  // namespace

MethodChoiceResult chooseMethod(const TimeSeries& series, const std::string& output,
                                const std::vector<std::string>& names, double from_s, double to_s,
                                const MethodChoiceOptions& options, const JobContext& job) {
  options.validate();
  MethodChoiceResult whole = chooseWithin(series, output, names, from_s, to_s, options, job.part(0.0, 0.4));
  if (!options.may_settle || whole.status != FitStatus::Converged || series.time_s.empty()) return whole;
  const double from = std::max(from_s, series.time_s.front());
  const double to = std::min(to_s, series.time_s.back());
  const double part = unsettledPart(series, output, names, from, to, whole.model, options, job.part(0.4, 0.8));
  if (part == 0.0) return whole;
  MethodChoiceResult settled =
      chooseWithin(series, output, names, from + part * (to - from), to_s, options, job.part(0.8, 1.0));
  if (settled.status != FitStatus::Converged) return whole;
  settled.model.train_from_s = whole.model.train_from_s;  // looked at all the same: no row of it judges anything
  settled.notes.push_back(fmt::format(
      "The first {:.1f} h of the training are left out: the machine still followed what was before the record, and "
      "models without them predict the rest of the training with less than half of the error.",
      part * (to - from) / seconds_per_hour));
  return settled;
}

namespace {

MethodChoiceResult chooseWithin(const TimeSeries& series, const std::string& output,
                                const std::vector<std::string>& names, double from_s, double to_s,
                                const MethodChoiceOptions& options, const JobContext& job) {
  MethodChoiceResult result;
  std::vector<InputVerdict> refused;
  const std::vector<std::string> usable = usableInputs(series, output, names, from_s, to_s, refused);
  const bool project =
      !options.shared_inputs.empty() || (!options.all_inputs && std::ssize(usable) > options.projection.maximum_inputs);
  ResponseFitOptions first = options.response;
  first.judge_inputs = options.response.judge_inputs && !project;
  ResponseFitResult response = fitResponse(series, output, names, from_s, to_s, first, job.part(0.0, 0.3));
  if (response.status != FitStatus::Converged) {
    result.status = response.status;
    result.message = response.message;
    return result;
  }
  std::vector<std::string> plain_names = usable;
  if (project) {
    ProjectionResult few;
    if (options.shared_inputs.empty()) {
      few = projectOntoFewInputs(series, {response.model}, from_s, to_s, options.projection, job.part(0.3, 0.4));
    } else {
      const auto used = [&](const std::string& name) {
        return std::any_of(response.model.inputs.begin(), response.model.inputs.end(),
                           [&](const ThermalInput& i) { return i.name == name; });
      };
      for (const std::string& name : options.shared_inputs)
        if (used(name)) few.kept.push_back(name);
      std::erase_if(plain_names, [&](const std::string& name) {
        return std::find(options.shared_inputs.begin(), options.shared_inputs.end(), name) ==
               options.shared_inputs.end();
      });
    }
    if (!few.kept.empty()) {
      ProjectedModel projected = projectModel(series, response.model, few.kept, from_s, to_s, options.projection);
      response.verdicts = explained(few, projected, usable);
      response.verdicts.insert(response.verdicts.end(), refused.begin(), refused.end());
      response.model = std::move(projected.model);
    }
  }
  std::vector<double> clean = series.at(output).values;
  if (const std::size_t slips = removeSlips(series.time_s, clean, from_s, to_s); slips > 0)
    result.notes.push_back(
        fmt::format("{} isolated values of {} were left out of the choice between methods.", slips, output));
  ResponseFitOptions lags = options.response;
  for (const std::vector<double>* taus : {&options.taus_s, &options.few_lag_taus_s})
    lags.taus_s.insert(lags.taus_s.end(), taus->begin(), taus->end());
  std::sort(lags.taus_s.begin(), lags.taus_s.end());
  lags.taus_s.erase(std::unique(lags.taus_s.begin(), lags.taus_s.end()), lags.taus_s.end());
  const double span = std::min(to_s, series.time_s.back()) - std::max(from_s, series.time_s.front());
  lags.period_s = std::max({options.response.period_s, series.medianPeriod_s(), span / 400.0});
  const Dictionary d = buildDictionary(series, clean, usable, from_s, to_s, lags);
  if (d.y.size() < 40) {
    result.model = std::move(response.model);
    result.verdicts = std::move(response.verdicts);
    result.left_out_rms = response.left_out_rms;
    result.methods = {{"response", response.left_out_rms, 1.0}};
    result.notes.push_back("Too few samples for a choice between methods: response.");
    result.status = FitStatus::Converged;
    return result;
  }
  const Evidence evidence(d, options);
  PlainCandidates plain(d, evidence, plain_names, options);
  plain.search(job.part(0.4, 0.8));
  const std::vector<Candidate> members = responseMembers(d, evidence, options);
  {
    ThermalOutput& o = response.model.outputs.front();
    o.covariance *= calibration(evidence, members, options, anything, evidence.innovationVariance(members),
                                o.noise_sigma * o.noise_sigma) /
                    response.calibration;  // the runs of the choice, in place of those of the fit
  }
  const std::vector<double> plain_errors = averagedErrors(evidence, plain.all, options, anything);
  const std::vector<double> response_errors = averagedErrors(evidence, members, options, anything);
  const double of_plain = mean(plain_errors);
  const double of_response = mean(response_errors);
  const double odds = logOdds(plain_errors, response_errors) - (d.by_operation ? std::log(options.response_odds) : 0.0);
  double plain_weight = 1.0 / (1.0 + std::exp(-odds));
  // Averaged where nothing tells them apart (odds below two to one), else the better of both.
  if (plain_weight < 1.0 / 3.0) plain_weight = 0.0;
  if (plain_weight > 2.0 / 3.0) plain_weight = 1.0;
  job.report(0.9, "averaging");

  std::map<Method, double> shares;
  if (plain_weight > 0.0) {
    Averaged average = averaged(d, evidence, plain.all, plain_names, output, options);
    average.model.train_from_s = response.model.train_from_s;
    average.model.train_to_s = response.model.train_to_s;
    average.model.source = response.model.source;
    for (const auto& [method, share] : average.shares) shares[method] = plain_weight * share;
    result.verdicts = plain_weight >= 0.5 ? std::move(average.verdicts) : std::move(response.verdicts);
    if (plain_weight >= 0.5) result.verdicts.insert(result.verdicts.end(), refused.begin(), refused.end());
    result.model = plain_weight < 1.0
                       ? weightedAverage({average.model, response.model}, {plain_weight, 1.0 - plain_weight})
                       : std::move(average.model);
    for (InputVerdict& v : result.verdicts)
      v.kept = std::any_of(result.model.inputs.begin(), result.model.inputs.end(),
                           [&](const ThermalInput& i) { return i.name == v.name; });
  } else {
    result.model = std::move(response.model);
    result.verdicts = std::move(response.verdicts);
  }
  if (project && options.shared_inputs.empty() && inputCount(result.model) > options.projection.maximum_inputs) {
    const ProjectionResult few =
        projectOntoFewInputs(series, {result.model}, from_s, to_s, options.projection, job.part(0.9, 1.0));
    ProjectedModel projected = projectModel(series, result.model, few.kept, from_s, to_s, options.projection);
    result.verdicts = explained(few, projected, usable);
    result.verdicts.insert(result.verdicts.end(), refused.begin(), refused.end());
    projected.model.kind = result.model.kind;
    result.model = std::move(projected.model);
  }
  for (const Method method : {Method::Line, Method::FewLags, Method::SharedLags, Method::Ridge}) {
    const auto of_method = [&](const Candidate& c) { return c.method == method; };
    if (std::none_of(plain.all.begin(), plain.all.end(), of_method)) continue;
    result.methods.push_back(
        {nameOf(method), std::exp(0.5 * averagedEvidence(evidence, plain.all, options, of_method)), shares[method]});
  }
  result.methods.push_back({nameOf(Method::Response), std::exp(0.5 * of_response), 1.0 - plain_weight});
  result.left_out_rms = std::exp(0.5 * (plain_weight * of_plain + (1.0 - plain_weight) * of_response));
  result.notes.insert(result.notes.end(), response.notes.begin(), response.notes.end());
  result.status = FitStatus::Converged;
  result.message = fmt::format("{} inputs, {} time constants", result.model.inputs.size(),
                               result.model.outputs.front().terms.size());
  return result;
}

}  // namespace

}  // namespace spindrift
