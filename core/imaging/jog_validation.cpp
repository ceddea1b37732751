// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/jog_validation.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "core/base/text.h"

namespace spindrift {

ResolutionCheck checkAgainstResolution(const ObservationSet& observations, const MachineDescription& machine,
                                       double part) {
  ResolutionCheck check;
  const std::vector<std::string> states = observations.states();
  if (states.size() < 2) {
    check.status = FitStatus::Degenerate;
    check.reason = "There is only one state: nothing to compare.";
    return check;
  }
  constexpr std::array<const char*, 3> names{"X", "Y", "Z"};
  std::vector<std::string> failed;
  for (std::size_t k = 0; k < 3; ++k) {
    AxisVerdict verdict;
    verdict.component = all_components[k];
    std::map<std::string, double> first;
    std::map<std::string, std::vector<double>> series;
    double squares = 0.0;
    for (const Observation& o : observations.rows) {
      if (o.component != verdict.component || o.use == ObservationUse::Exclude) continue;
      const auto [reference, is_first] = first.try_emplace(o.point, o.value);
      const double change = o.value - reference->second;
      series[o.point].push_back(change);
      if (is_first) continue;
      ++verdict.count;
      squares += change * change;
      if (std::abs(change) >= verdict.largest_um) {
        verdict.largest_um = std::abs(change);
        verdict.largest_sigma_um = o.sigma;
        verdict.largest_at = fmt::format("{} in state {}", o.point, o.state);
      }
    }
    if (verdict.count == 0) continue;
    const LinearAxis* axis = machine.findAxis(names[k]);
    if (axis == nullptr || !axis->resolution_um) {
      throw InputError({machine.file, "$.axes"},
                       fmt::format("gives no resolution_um of axis {}, which this check needs.", names[k]));
    }
    verdict.limit_um = part * *axis->resolution_um;
    verdict.rms_um = std::sqrt(squares / static_cast<double>(verdict.count));
    double scatter = 0.0;
    double dof = 0.0;
    for (const auto& [point, values] : series) {
      double mean = 0.0;
      for (const double v : values) mean += v / static_cast<double>(values.size());
      for (const double v : values) scatter += (v - mean) * (v - mean);
      dof += static_cast<double>(values.size()) - 1.0;
    }
    verdict.standard_deviation_um = dof > 0.0 ? std::sqrt(scatter / dof) : 0.0;
    verdict.passed = verdict.largest_um <= verdict.limit_um;
    if (!verdict.passed) {
      failed.push_back(fmt::format("{} is off by {:.1f} µm at {} (allowed {:.2f} µm)", toString(verdict.component),
                                   verdict.largest_um, verdict.largest_at, verdict.limit_um));
    }
    check.axes.push_back(verdict);
  }
  if (check.axes.empty()) {
    check.status = FitStatus::Degenerate;
    check.reason = "No point was measured in more than one state.";
    return check;
  }
  check.status = FitStatus::Converged;
  check.passed = failed.empty();
  check.reason = check.passed
                     ? fmt::format("Passed: all differences stay within {} times the resolution of their axis.", part)
                     : fmt::format("Not passed: {}.", joinedList(failed));
  return check;
}

}  // namespace spindrift
