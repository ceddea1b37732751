// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_outputs.h"

#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

bool sameSignal(const ThermalInput& a, const ThermalInput& b) {
  return a.name == b.name && a.kind == b.kind && a.power == b.power && a.scale == b.scale && a.reference == b.reference;
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
  SeveralOutputs all;
  std::vector<ThermalModel> models;
  const auto count = static_cast<double>(outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (std::count(outputs.begin(), outputs.end(), outputs[i]) > 1) {
      throw InputError("output \"" + outputs[i] + "\" is given twice; allowed: every column once.");
    }
    IdentifyRequest one = request;
    one.output = outputs[i];
    const auto at = static_cast<double>(i);
    all.results.push_back(identifyThermalModel(one, job.part(at / count, (at + 1.0) / count)));
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
  return {{"outputs", list}, {"model", model.json()}, {"good_enough", good_enough}, {"elapsed_ms", elapsed_ms}};
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
  for (const std::string& name : names) text += ",measured_" + name + ",predicted_" + name;
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
