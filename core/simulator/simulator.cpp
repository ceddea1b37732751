// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/simulator.h"

#include <algorithm>
#include <atomic>

namespace spindrift {

const SimulatorParameter* Simulator::find(std::string_view name) const {
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const SimulatorParameter& p) { return p.name == name || p.id() == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

SimulatorRuns runAll(const Simulator& simulator, const std::vector<ParameterValues>& sets, const ObservationSet& at,
                     const JobContext& job, std::string_view stage) {
  SimulatorRuns out;
  out.runs.resize(sets.size());
  out.failed.resize(sets.size());
  std::atomic<std::size_t> done = 0;
  parallelFor(sets.size(), job, [&](std::size_t i) {
    try {
      out.runs[i] = simulator.run(sets[i], at, job);
    } catch (const SimulatorFailed& failure) {
      out.failed[i] = failure.what();
    }
    job.report(static_cast<double>(++done) / static_cast<double>(sets.size()), stage);
  });
  return out;
}

}  // namespace spindrift
