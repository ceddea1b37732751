// SPDX-License-Identifier: Apache-2.0
// The methods `arx` and `oe` of identifyThermalModel (core/workflows/thermal_workflow.h): bins, order, fit, free run
// over all rows.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/workflows/thermal_workflow.h"

namespace spindrift {

struct StructuredFit {
  ThermalModel model;             ///< lags; without terms if an ARX model has no such form (then a note says so)
  std::vector<double> predicted;  ///< free run, every row of the series
  nlohmann::json structure;
  std::vector<std::string> notes;
};

/// `request.method` "arx" or "oe". Throws InputError where nothing can be fitted.
[[nodiscard]] StructuredFit fitStructured(const TimeSeries& series, const IdentifyRequest& request,
                                          const std::vector<std::string>& inputs, const JobContext& job);

}  // namespace spindrift
