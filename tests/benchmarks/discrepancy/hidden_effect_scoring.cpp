// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace spindrift::study {

bool sameEffect(const std::string& a, const std::string& b) {
  const auto either = [&](std::string_view x, std::string_view y) { return (a == x && b == y) || (a == y && b == x); };
  return a == b || either("rotary.expansion.r0t", "table.expansion.xy");
}

Outcome judge(const Answer& answer, const std::vector<std::string>& hidden) {
  if (answer.effects.empty()) return Outcome::Abstained;
  std::vector<bool> found(hidden.size(), false);
  bool as_rival = false;
  for (const Answer::Listed& listed : answer.effects) {
    bool matched = false;
    for (std::size_t i = 0; i < hidden.size() && !matched; ++i) {
      if (!found[i] && sameEffect(listed.id, hidden[i])) found[i] = matched = true;
    }
    for (std::size_t i = 0; i < hidden.size() && !matched && listed.rivals.size() <= 2; ++i) {
      const bool among = std::any_of(listed.rivals.begin(), listed.rivals.end(),
                                     [&](const std::string& rival) { return sameEffect(rival, hidden[i]); });
      if (!found[i] && among) found[i] = matched = as_rival = true;
    }
    if (!matched) return Outcome::Wrong;
  }
  // One of two named and the rest said to be unknown is an abstention about the other.
  if (!std::all_of(found.begin(), found.end(), [](bool f) { return f; })) return Outcome::Abstained;
  return as_rival ? Outcome::Rival : Outcome::Named;
}

DiscrepancyInput inputOf(const VirtualCampaign& campaign) {
  DiscrepancyInput input;
  input.machine = campaign.campaign.machine;
  input.log = campaign.campaign.log;
  input.observations = *campaign.campaign.observations;
  input.simulation_gain_uncertainty = campaign.campaign.simulation_gain_uncertainty;
  std::map<std::tuple<std::string, Component, double>, double> table;
  for (const SimulatedRow& row : campaign.simulation) table[{row.point, row.component, row.time_s}] = row.predicted;
  for (const Observation& row : input.observations.rows) {
    const auto found = table.find({row.point, row.component, row.time_s});
    input.predicted.push_back(found == table.end() ? std::numeric_limits<double>::quiet_NaN() : found->second);
  }
  return input;
}

double explainedFraction(const VirtualCampaign& campaign, const std::vector<double>& effect_part) {
  const auto& rows = campaign.campaign.observations->rows;
  struct Mean {
    double hidden = 0.0;
    double estimate = 0.0;
    int count = 0;
  };
  std::map<std::pair<std::string, Component>, Mean> means;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Fit) continue;
    Mean& mean = means[{rows[i].point, rows[i].component}];
    mean.hidden += campaign.truth.hidden_signal[i];
    mean.estimate += i < effect_part.size() ? effect_part[i] : 0.0;
    ++mean.count;
  }
  double left = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Holdout) continue;
    const Mean& mean = means[{rows[i].point, rows[i].component}];
    if (mean.count == 0) continue;
    const double hidden = (campaign.truth.hidden_signal[i] - mean.hidden / mean.count) / rows[i].sigma;
    const double estimate =
        ((i < effect_part.size() ? effect_part[i] : 0.0) - mean.estimate / mean.count) / rows[i].sigma;
    left += (estimate - hidden) * (estimate - hidden);
    whole += hidden * hidden;
  }
  return whole > 0.0 ? 1.0 - left / whole : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace spindrift::study
