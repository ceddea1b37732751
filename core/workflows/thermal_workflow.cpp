// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_workflow.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/math/distributions.h"
#include "core/math/statistics.h"
#include "core/thermal/autocorrelation.h"
#include "core/thermal/baselines.h"
#include "core/thermal/input_selection.h"
#include "core/thermal/method_choice.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/compensated_data.h"
#include "core/workflows/thermal_structures.h"

namespace spindrift {
namespace {

/// How a model was found, in words.
std::string_view kindInWords(std::string_view kind) {
  if (kind == "arx") return "ARX model";
  if (kind == "output_error") return "output-error model";
  if (kind == "response") return "step-response model";
  return "model of first-order time constants";
}

constexpr std::size_t sparse_minimum = 12;  ///< cycles in training: fewer determine no response

std::size_t rowsWithin(const TimeSeries& series, const Signal& signal, const TimeRange& range) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < series.time_s.size(); ++r)
    if (series.time_s[r] >= range.from_s && series.time_s[r] < range.to_s && std::isfinite(signal.values[r])) ++count;
  return count;
}

ResidualDiagnosis diagnose(const TimeSeries& series, const IdentifyResult& result, const TimeRange& train) {
  ResidualDiagnosis out;
  const double span = std::min(train.to_s, series.time_s.back()) - std::max(train.from_s, series.time_s.front());
  out.period_s = std::max(series.medianPeriod_s(), span / 1000.0);
  if (result.model.period_s > 0.0) out.period_s = result.model.period_s;
  const BinnedSeries bins = binSeries(series.time_s, out.period_s, train.from_s, train.to_s);
  std::vector<double> e = bridged(bins.time_s, bins.mean(result.left), false);
  const double centre = mean(e);
  for (double& v : e) v -= centre;
  const auto n = e.size();
  const std::size_t lags = std::min<std::size_t>(25, n / 4);
  const std::vector<double> of_residual = autocorrelation(e, n / 4);
  double q = 0.0;
  for (std::size_t lag = 0; lag <= lags; ++lag) {
    out.autocorrelation.push_back(of_residual[lag]);
    if (lag > 0) q += out.autocorrelation.back() * out.autocorrelation.back() / static_cast<double>(n - lag);
  }
  q *= static_cast<double>(n) * (static_cast<double>(n) + 2.0);
  out.whiteness_p_value = lags > 0 ? chiSquaredTail(q, static_cast<double>(lags)) : 1.0;
  for (const std::string& name : result.inputs) {
    const Signal& signal = series.at(name);
    std::vector<double> u = bins.mean(bridged(series.time_s, signal.values, holdsUntilNextRow(signal.kind)));
    const double middle = mean(u);
    double uu = 0.0;
    double ee = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      u[i] -= middle;
      uu += u[i] * u[i];
      ee += e[i] * e[i];
    }
    ResidualDiagnosis::Cross cross;
    cross.input = name;
    for (std::size_t lag = 0; lag <= lags; ++lag) {
      double sum = 0.0;
      for (std::size_t i = lag; i < n; ++i) sum += e[i] * u[i - lag];
      const double c = uu > 0.0 && ee > 0.0 ? sum / std::sqrt(uu * ee) : 0.0;
      if (std::abs(c) > cross.largest) {
        cross.largest = std::abs(c);
        cross.lag_s = static_cast<double>(lag) * out.period_s;
      }
    }
    // Bartlett: variance of the cross-correlation of unrelated, autocorrelated signals.
    const std::vector<double> of_input = autocorrelation(u, n / 4);
    double sum = 1.0;
    for (std::size_t lag = 1; lag < n / 4; ++lag) sum += 2.0 * of_residual[lag] * of_input[lag];
    cross.limit = std::min(1.0, 2.58 * std::sqrt(std::max(1.0, sum) / static_cast<double>(n)));
    out.cross.push_back(cross);
  }
  return out;
}

}  // namespace

TimeRange TimeRange::parse(const std::string& text, const std::string& option) {
  TimeRange range;
  const std::size_t colon = text.find(':');
  bool good = colon != std::string::npos && parseNumber(trimmed(text.substr(0, colon)), range.from_s);
  if (good) {
    const std::string end(trimmed(std::string_view(text).substr(colon + 1)));
    if (end.empty()) {
      range.to_s = 1e300;
    } else {
      good = parseNumber(end, range.to_s);
    }
  }
  if (!good || range.to_s <= range.from_s) {
    throw InputError(fmt::format(
        "{} \"{}\" is not a range; allowed: FROM:TO in seconds with FROM < TO, such as 0:57600.", option, text));
  }
  return range;
}

nlohmann::json RunQuality::json() const {
  return {{"samples", samples},
          {"fit_percent", jsonNumber(fit_percent)},
          {"p2p", jsonNumber(p2p)},
          {"rmse", jsonNumber(rmse)}};
}

RunQuality runQuality(std::span<const double> time_s, std::span<const double> measured,
                      std::span<const double> predicted, const TimeRange& range) {
  std::vector<double> m;
  std::vector<double> s;
  std::vector<double> d;
  for (std::size_t r = 0; r < time_s.size(); ++r) {
    if (time_s[r] < range.from_s || time_s[r] >= range.to_s || !std::isfinite(measured[r]) ||
        !std::isfinite(predicted[r]))
      continue;
    m.push_back(measured[r]);
    s.push_back(predicted[r]);
    d.push_back(measured[r] - predicted[r]);
  }
  if (m.empty()) return {0, std::nan(""), std::nan(""), std::nan("")};
  return {m.size(), fitPercent(m, s), peakToPeak(d), rootMeanSquare(d)};
}

IdentifyResult identifyThermalModel(const IdentifyRequest& request, const JobContext& job) {
  TimeSeriesOptions options;
  options.temperature_unit = request.temperature_unit;
  return identifyThermalModel(readTimeSeries(request.log, options), request, job);
}

IdentifyResult identifyThermalModel(TimeSeries series, const IdentifyRequest& request, const JobContext& job) {
  const auto started = std::chrono::steady_clock::now();
  IdentifyResult result;
  leaveOutCompensated(series);
  result.notes = series.notes;
  const Signal& output = series.at(request.output);
  for (const auto& [range, name] : {std::pair{request.train, "--train"}, std::pair{request.test, "--test"}}) {
    if (rowsWithin(series, output, range) == 0) {
      throw InputError(
          {series.file, ""},
          fmt::format("{} {:.6g}:{:.6g} holds no measured value of {}; the record runs from {:.6g} to {:.6g} s.", name,
                      range.from_s, range.to_s, request.output, series.time_s.front(), series.time_s.back()));
    }
  }
  const bool overlap = request.test.from_s < request.train.to_s && request.train.from_s < request.test.to_s;
  if (overlap) {
    result.notes.push_back("Train and test overlap: the test figures are not evidence for new data.");
  }
  std::vector<std::string> names = request.inputs.empty() ? automaticInputs(series, request.output) : request.inputs;
  for (std::string& name : names) name = series.at(name).name;  // a model names what it was given, with its unit
  const bool structured =
      request.method == "arx" || request.method == "oe" || (request.method.empty() && request.order);
  const bool sparse = isSparse(output);
  if (sparse && structured) {
    throw InputError({series.file, fmt::format("column {}", request.output)},
                     "is measured at few rows only, and ARX and output error need a value at nearly every one; use the "
                     "method response (all time constants).");
  }
  ResponseFitOptions options;
  options.period_s = request.period_s;
  if (sparse) options.minimum_samples = sparse_minimum;
  std::vector<std::string> chosen = names;
  const bool chosen_by_evidence = !structured && !sparse && request.method.empty();
  if (chosen_by_evidence) {
    MethodChoiceOptions choice;
    choice.response = options;
    choice.all_inputs = !request.inputs.empty();
    choice.shared_inputs = request.shared_inputs;
    MethodChoiceResult fit = chooseMethod(series, request.output, names, request.train.from_s, request.train.to_s,
                                          choice, job.part(0.0, 0.8));
    if (fit.status != FitStatus::Converged) throw InputError({series.file, ""}, fit.message);
    result.model = std::move(fit.model);
    result.verdicts = std::move(fit.verdicts);
    result.methods = std::move(fit.methods);
    result.left_out_rms = fit.left_out_rms;
    result.notes.insert(result.notes.end(), fit.notes.begin(), fit.notes.end());
  } else if (!structured) {
    ResponseFitResult fit = fitResponse(series, request.output, names, request.train.from_s, request.train.to_s,
                                        options, job.part(0.0, 0.8));
    if (fit.status != FitStatus::Converged) throw InputError({series.file, ""}, fit.message);
    result.model = std::move(fit.model);
    result.verdicts = std::move(fit.verdicts);
    result.left_out_rms = fit.left_out_rms;
    result.notes.insert(result.notes.end(), fit.notes.begin(), fit.notes.end());
  }
  std::vector<double> simulated;
  if (structured) {
    if (request.inputs.empty()) {
      // A low-order model cannot carry every sensor: the inputs that group LASSO keeps, at most four.
      const SelectionResult selection =
          selectByGroupLasso(series, request.output, names, request.train.from_s, request.train.to_s, {}, job);
      chosen.assign(selection.kept.begin(),
                    selection.kept.begin() + std::min<std::ptrdiff_t>(4, std::ssize(selection.kept)));
      result.verdicts.clear();
      for (const SelectedInput& in : selection.inputs) {
        const bool kept = std::find(chosen.begin(), chosen.end(), in.name) != chosen.end();
        result.verdicts.push_back({in.name, kept, in.reason, 0.0, 0.0});
      }
      result.left_out_rms = 0.0;
    }
    IdentifyRequest fixed = request;
    if (fixed.method.empty()) fixed.method = "arx";
    StructuredFit fit = fitStructured(series, fixed, chosen, job);
    result.model = std::move(fit.model);
    result.structure = std::move(fit.structure);
    simulated = std::move(fit.predicted);
    result.notes.insert(result.notes.end(), fit.notes.begin(), fit.notes.end());
  }
  for (const ThermalInput& input : result.model.inputs)
    if (std::find(result.inputs.begin(), result.inputs.end(), input.name) == result.inputs.end())
      result.inputs.push_back(input.name);
  result.model.learnPattern(series, 0, request.train.from_s, request.train.to_s);
  ThermalPrediction prediction = result.model.predict(series, 0);
  // What is judged is what is shipped; only a model without equivalent in lags is shown by its own simulation.
  if (structured && result.model.outputs.front().terms.empty()) prediction.value = std::move(simulated);
  result.time_s = series.time_s;
  result.measured = output.values;
  result.predicted = std::move(prediction.value);
  result.left.resize(result.measured.size());
  std::transform(result.measured.begin(), result.measured.end(), result.predicted.begin(), result.left.begin(),
                 std::minus<>());
  result.sigma = std::move(prediction.sigma);
  result.outside = std::move(prediction.outside);
  result.notes.insert(result.notes.end(), prediction.notes.begin(), prediction.notes.end());
  result.train = runQuality(result.time_s, result.measured, result.predicted, request.train);
  result.test = runQuality(result.time_s, result.measured, result.predicted, request.test);
  const auto [plain_from, plain_to] = std::pair{request.train.from_s, request.train.to_s};
  std::vector<PlainModel> plain_models = {noModel(series, request.output, plain_from, plain_to),
                                          staticRegression(series, request.output, plain_from, plain_to)};
  if (request.peers) {
    plain_models.push_back(firstOrderArx(series, request.output, plain_from, plain_to));
    plain_models.push_back(laggedRidge(series, request.output, plain_from, plain_to));
  }
  ThermalVerdict verdict{true,
                         std::max(request.test.from_s, series.time_s.front()),
                         std::min(request.test.to_s, series.time_s.back()),
                         result.test.rmse,
                         {}};
  for (std::size_t i = 0; i < plain_models.size(); ++i) {
    const PlainModel& plain = plain_models[i];
    result.plain.push_back({plain.name, runQuality(result.time_s, result.measured, plain.prediction, request.train),
                            runQuality(result.time_s, result.measured, plain.prediction, request.test), plain.note});
    if (i >= 2) continue;  // the peers are other dynamic models: shown, but not what decides
    if (result.test.rmse >= result.plain.back().test.rmse) {
      result.good_enough = verdict.good_enough = false;
      const std::string reason =
          fmt::format("in the test range the model (rms {:.3g}) is no better than \"{}\" (rms {:.3g})",
                      result.test.rmse, plain.name, result.plain.back().test.rmse);
      verdict.reason += (verdict.reason.empty() ? "" : "; ") + reason;
      result.notes.push_back(reason + ": do not compensate with it; train on a longer or more varied range.");
    }
  }
  if (overlap) {
    result.good_enough = verdict.good_enough = false;
    verdict.reason += std::string(verdict.reason.empty() ? "" : "; ") +
                      "it was judged on rows that trained it, which shows nothing of new data";
  }
  if (result.model.outputs.front().terms.empty()) {
    result.good_enough = verdict.good_enough = false;
    verdict.reason +=
        std::string(verdict.reason.empty() ? "" : "; ") + "the model has no equivalent in first-order time constants";
  }
  result.model.outputs.front().verdict = std::move(verdict);
  for (const std::string& name : result.inputs) result.step_responses.push_back(result.model.stepResponse(0, name));
  result.residual = diagnose(series, result, request.train);
  result.elapsed_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
  return result;
}

nlohmann::json IdentifyResult::json() const {
  nlohmann::json out = {{"model", model.json()},
                        {"inputs", inputs},
                        {"train", train.json()},
                        {"test", test.json()},
                        {"left_out_rms", jsonNumber(left_out_rms)},
                        {"elapsed_ms", elapsed_ms},
                        {"notes", notes}};
  out["selection"] = nlohmann::json::array();
  for (const InputVerdict& v : verdicts) {
    out["selection"].push_back({{"input", v.name},
                                {"kept", v.kept},
                                {"reason", v.reason},
                                {"contribution_rms", jsonNumber(v.contribution_rms)},
                                {"error_without_percent", jsonNumber(v.error_without_percent)}});
  }
  if (!methods.empty()) {
    out["methods"] = nlohmann::json::array();
    for (const MethodEvidence& m : methods)
      out["methods"].push_back(
          {{"method", m.method}, {"left_out_rms", jsonNumber(m.left_out_rms)}, {"weight", m.weight}});
  }
  out["plain_models"] = nlohmann::json::array();
  for (const ModelComparison& p : plain) {
    out["plain_models"].push_back(
        {{"name", p.name}, {"train", p.train.json()}, {"test", p.test.json()}, {"note", p.note}});
  }
  out["step_response"] = nlohmann::json::array();
  for (const StepResponse& s : step_responses) {
    nlohmann::json value = nlohmann::json::array();
    nlohmann::json uncertainty = nlohmann::json::array();
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      value.push_back(jsonNumber(s.value[i]));
      uncertainty.push_back(jsonNumber(s.sigma[i]));
    }
    out["step_response"].push_back({{"input", s.input},
                                    {"step", s.step},
                                    {"unit", s.unit},
                                    {"time_s", s.time_s},
                                    {"value", value},
                                    {"standard_uncertainty", uncertainty},
                                    {"coverage_factor_95", s.coverage_factor},
                                    {"final_value", jsonNumber(s.final_value)},
                                    {"final_standard_uncertainty", jsonNumber(s.final_sigma)},
                                    {"time_to_63_percent_s", jsonNumber(s.time_to_63_percent_s)}});
  }
  nlohmann::json cross = nlohmann::json::array();
  for (const auto& c : residual.cross)
    cross.push_back({{"input", c.input}, {"largest", c.largest}, {"lag_s", c.lag_s}, {"limit_99_percent", c.limit}});
  out["residual"] = {{"period_s", residual.period_s},
                     {"autocorrelation", residual.autocorrelation},
                     {"whiteness_p_value", residual.whiteness_p_value},
                     {"cross_correlation", cross}};
  if (!structure.empty()) out["structure"] = structure;
  const auto marked = static_cast<std::size_t>(std::count(outside.begin(), outside.end(), char{1}));
  out["outside_training_rows"] = marked;
  out["good_enough"] = good_enough;
  return out;
}

namespace {

/// A model file states the units of deviations alone; who reads of a temperature is told its unit.
std::string unitForPeople(const ThermalOutput& output) {
  return signalKind(output.name, {}) == SignalKind::Temperature ? "degC" : output.unit;
}

}  // namespace

std::string IdentifyResult::summary() const {
  const std::string unit = printedUnit(unitForPeople(model.outputs.front()));
  std::string text = fmt::format("{}: {} with {} ({})\n", model.outputs.front().name, kindInWords(model.kind),
                                 countOf(inputs.size(), "input"), joinedList(inputs));
  const auto line = [&](const std::string& name, const RunQuality& a, const RunQuality& b) {
    text += fmt::format("  {:<42} train fit {:7.1f} %  rms {:8.3f}   test fit {:7.1f} %  rms {:8.3f}  p2p {:8.3f} {}\n",
                        name, printed(a.fit_percent), printed(a.rmse), printed(b.fit_percent), printed(b.rmse),
                        printed(b.p2p), unit);
  };
  text += "free run (no measured output is used after training):\n";
  line("this model", train, test);
  for (const ModelComparison& p : plain) line(p.name, p.train, p.test);
  for (const MethodEvidence& m : methods)
    text += fmt::format("  method {:<9} rms of runs left out inside training {:8.3f}, share of the model {:3.0f} %\n",
                        m.method, printed(m.left_out_rms), printed(100.0 * m.weight));
  for (const InputVerdict& v : verdicts)
    text += fmt::format("  {} {}: {}\n", v.kept ? "kept   " : "dropped", v.name, v.reason);
  const auto marked = static_cast<std::size_t>(std::count(outside.begin(), outside.end(), char{1}));
  if (marked > 0)
    text += fmt::format("{} of {} rows lie outside the range of training and are marked\n", marked, outside.size());
  for (const std::string& n : notes) text += "note: " + n + "\n";
  return text;
}

void IdentifyResult::writePrediction(const std::filesystem::path& file) const {
  std::string text = "time_s,measured,predicted,sigma,outside_training\n";
  for (std::size_t r = 0; r < time_s.size(); ++r) {
    text += exactNumber(time_s[r]) + ',';
    if (std::isfinite(measured[r])) text += exactNumber(measured[r]);
    text += ',' + exactNumber(predicted[r]) + ',';
    if (r < sigma.size()) text += exactNumber(sigma[r]);
    text += r < outside.size() && outside[r] != 0 ? ",1\n" : ",0\n";
  }
  writeFileAtomically(file, text);
}

}  // namespace spindrift
