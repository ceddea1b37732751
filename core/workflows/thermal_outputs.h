// SPDX-License-Identifier: Apache-2.0
// Models of several measured outputs at once. Left to choose, they share few inputs: those onto which the models of all
// outputs with all inputs are projected together (core/thermal/input_projection.h); each output then has its own choice
// of method. All go into one model, as the compensator of a controller loads it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/thermal/input_projection.h"
#include "core/workflows/thermal_workflow.h"

namespace spindrift {

struct SeveralOutputs {
  std::vector<std::string> names;
  std::vector<IdentifyResult> results;         ///< one each
  ThermalModel model;                          ///< all of them
  bool good_enough = true;                     ///< all are
  std::optional<ProjectionResult> projection;  ///< the inputs that were chosen for all; none: there was no choice

  /// {"outputs":[{"output", ... keys of one output}], "model", "elapsed_ms", "shared_inputs"}.
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  /// time_s, then measured_NAME and predicted_NAME of every output.
  void writePrediction(const std::filesystem::path& file) const;
};

/// `request.output` is replaced by each name. Throws InputError as identifyThermalModel, and for a name given twice.
[[nodiscard]] SeveralOutputs identifySeveralOutputs(const IdentifyRequest& request,
                                                    const std::vector<std::string>& outputs, const JobContext& job);
[[nodiscard]] SeveralOutputs identifySeveralOutputs(const TimeSeries& series, const IdentifyRequest& request,
                                                    const std::vector<std::string>& outputs, const JobContext& job);

/// One model with the outputs of all: inputs that are the same column, power, scale and reference are shared; their
/// range of training is the one they have in common. `models` must not be empty and must come from the same period.
[[nodiscard]] ThermalModel joined(const std::vector<ThermalModel>& models);

}  // namespace spindrift
