// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/thermal/compensator.h"
#include "core/thermal/thermal_model.h"
#include "core/thermal/time_series.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

void timeSeries(std::string_view bytes) {
  const TimeSeries series = parseTimeSeries(bytes, "log.csv");
  for (const Signal& signal : series.signals) (void)signalQuality(series, signal);
}

/// What a compensator takes, it also stands: whatever the inputs are, every output is a number within its limits.
void thermalModel(std::string_view bytes) {
  const ThermalModel model = ThermalModel::parse(JsonNode::parse(bytes, "model.json"));
  const auto compensator = std::make_unique<Compensator>();
  CompensatorLimits limits;
  limits.forced = true;
  const std::string problem = compensator->load(model, 0.1, limits);
  if (!problem.empty()) throw InputError(problem);
  constexpr std::array<double, 8> values{
      20.0, 25.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300, 1e300,
      0.0,  21.0};
  std::vector<double> inputs(static_cast<std::size_t>(compensator->inputCount()));
  std::vector<double> outputs(static_cast<std::size_t>(compensator->outputCount()));
  for (std::size_t step = 0; step < 200; ++step) {
    for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] = values[(step / 5 + i * step) % values.size()];
    (void)compensator->step(inputs.data(), nullptr, outputs.data());
    for (const double value : outputs)
      SPINDRIFT_ASSERT(std::abs(value) <= limits.limit, "an output stays within its limit");
  }
}

constexpr Reader readers[] = {{"time_series", timeSeries}, {"thermal_model", thermalModel}};

}  // namespace

std::span<const Reader> thermalReaders() {
  return readers;
}

}  // namespace spindrift::testing
