// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/compensated_data.h"

namespace spindrift {
namespace {

bool sameSignal(const ThermalInput& a, const ThermalInput& b) {
  return a.name == b.name && a.kind == b.kind && a.power == b.power && a.scale == b.scale && a.reference == b.reference;
}

/// The inputs that all outputs share; none where every output is fine with all that there are, or where an output is
/// too sparse for a choice between methods.
std::optional<ProjectionResult> sharedInputs(const TimeSeries& measured, const IdentifyRequest& request,
                                             const std::vector<std::string>& outputs, const JobContext& job) {
  const ProjectionOptions options;
  TimeSeries series = measured;
  leaveOutCompensated(series);
  ResponseFitOptions fit;
  fit.period_s = request.period_s;
  fit.judge_inputs = false;
  std::vector<ThermalModel> models;
  std::set<std::string> used;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (isSparse(series.at(outputs[i]))) return std::nullopt;
    job.throwIfCancelled();
    ResponseFitResult one = fitResponse(series, outputs[i], automaticInputs(series, outputs[i]), request.train.from_s,
                                        request.train.to_s, fit, job);
    if (one.status != FitStatus::Converged) return std::nullopt;
    for (const ThermalInput& input : one.model.inputs) used.insert(input.name);
    models.push_back(std::move(one.model));
  }
  if (std::ssize(used) <= options.maximum_inputs) return std::nullopt;
  return projectOntoFewInputs(series, models, request.train.from_s, request.train.to_s, options, job);
}

/// What the shared choice says of an input, added to the verdicts of one output.
void tell(const ProjectionResult& shared, IdentifyResult& result) {
  for (const ProjectedInput& input : shared.inputs) {
    const auto own = std::find_if(result.verdicts.begin(), result.verdicts.end(),
                                  [&](const InputVerdict& v) { return v.name == input.name; });
    const std::string often =
        fmt::format("chosen in {:.0f} % of the resamples for all outputs together", 100.0 * input.frequency);
    const bool known = own != result.verdicts.end();
    if (known && own->reason.find("models with it") != std::string::npos) {  // of the methods other than response
      own->reason += "; " + often;
      continue;
    }
    InputVerdict verdict = known ? *own : InputVerdict{};
    verdict.name = input.name;
    verdict.reason =
        verdict.kept ? fmt::format("its part of the prediction is {:.2g} rms; {}", verdict.contribution_rms, often)
                     : fmt::format(
                           "redundant: the inputs kept for all outputs carry the same information; they leave {:.2g} % "
                           "of the time history of the models with all inputs unexplained, with it {:.2g} %; {}",
                           100.0 * shared.left, 100.0 * input.left, often);
    if (known) {
      *own = std::move(verdict);
      continue;
    }
    result.verdicts.push_back(std::move(verdict));
  }
}

}  // namespace

ThermalModel joined(const std::vector<ThermalModel>& models) {
  SPINDRIFT_ASSERT(!models.empty(), "at least one model is needed");
  ThermalModel all = models.front();
  all.inputs.clear();
  all.outputs.clear();
  for (const ThermalModel& model : models) {
    if (model.kind != all.kind) all.kind = "lags";
    std::vector<int> place;
    for (const ThermalInput& input : model.inputs) {
      const auto known = std::find_if(all.inputs.begin(), all.inputs.end(),
                                      [&](const ThermalInput& other) { return sameSignal(other, input); });
      place.push_back(static_cast<int>(known - all.inputs.begin()));
      if (known == all.inputs.end()) {
        all.inputs.push_back(input);
      } else {
        known->train_min = std::max(known->train_min, input.train_min);
        known->train_max = std::min(known->train_max, input.train_max);
      }
    }
    for (ThermalOutput output : model.outputs) {
      for (LagTerm& term : output.terms) term.input = place[static_cast<std::size_t>(term.input)];
      all.outputs.push_back(std::move(output));
    }
  }
  return all;
}

SeveralOutputs identifySeveralOutputs(const IdentifyRequest& request, const std::vector<std::string>& outputs,
                                      const JobContext& job) {
  TimeSeriesOptions options;
  options.temperature_unit = request.temperature_unit;
  return identifySeveralOutputs(readTimeSeries(request.log, options), request, outputs, job);
}

SeveralOutputs identifySeveralOutputs(const TimeSeries& series, const IdentifyRequest& request,
                                      const std::vector<std::string>& outputs, const JobContext& job) {
  for (const std::string& name : outputs)
    if (std::count(outputs.begin(), outputs.end(), name) > 1)
      throw InputError("output \"" + name + "\" is given twice; allowed: every column once.");
  SeveralOutputs all;
  IdentifyRequest one = request;
  const auto count = static_cast<double>(outputs.size());
  const double shared_until = 0.3;
  if (request.inputs.empty() && request.method.empty() && !request.order && outputs.size() > 1)
    all.projection = sharedInputs(series, request, outputs, job.part(0.0, shared_until));
  if (all.projection) one.shared_inputs = all.projection->kept;
  std::vector<ThermalModel> models;
  const JobContext rest = job.part(all.projection ? shared_until : 0.0, 1.0);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    one.output = outputs[i];
    const auto at = static_cast<double>(i);
    all.results.push_back(identifyThermalModel(series, one, rest.part(at / count, (at + 1.0) / count)));
    if (all.projection) tell(*all.projection, all.results.back());
    all.names.push_back(outputs[i]);
    all.good_enough = all.good_enough && all.results.back().good_enough;
    models.push_back(all.results.back().model);
  }
  all.model = joined(models);
  return all;
}

nlohmann::json SeveralOutputs::json() const {
  nlohmann::json list = nlohmann::json::array();
  double elapsed_ms = 0.0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    nlohmann::json one = results[i].json();
    one["output"] = names[i];
    list.push_back(std::move(one));
    elapsed_ms += results[i].elapsed_ms;
  }
  nlohmann::json out = {
      {"outputs", list}, {"model", model.json()}, {"good_enough", good_enough}, {"elapsed_ms", elapsed_ms}};
  if (projection) {
    out["shared_inputs"] = nlohmann::json::array();
    for (const ProjectedInput& i : projection->inputs)
      out["shared_inputs"].push_back(
          {{"input", i.name}, {"kept", i.kept}, {"frequency", i.frequency}, {"left", jsonNumber(i.left)}});
  }
  return out;
}

std::string SeveralOutputs::summary() const {
  std::string text;
  for (std::size_t i = 0; i < results.size(); ++i) {
    text += (i > 0 ? "\n" : "") + results[i].summary();
  }
  return text;
}

void SeveralOutputs::writePrediction(const std::filesystem::path& file) const {
  std::string text = "time_s";
  for (const std::string& name : names)
    text += "," + csvField("measured_" + name) + "," + csvField("predicted_" + name);
  text += '\n';
  for (std::size_t r = 0; r < results.front().time_s.size(); ++r) {
    text += exactNumber(results.front().time_s[r]);
    for (const IdentifyResult& one : results) {
      text += ',';
      if (std::isfinite(one.measured[r])) text += exactNumber(one.measured[r]);
      text += ',' + exactNumber(one.predicted[r]);
    }
    text += '\n';
  }
  writeFileAtomically(file, text);
}

}  // namespace spindrift
