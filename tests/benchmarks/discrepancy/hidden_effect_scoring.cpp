// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/discrepancy/effect_model.h"

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

namespace {

/// Values over the rows, whitened and relative to their mean over the fitted rows of the same point and component; 0
/// where there is no such row, and on rows that are not held out.
std::vector<double> heldOutMotion(const VirtualCampaign& campaign, const std::vector<double>& values) {
  const auto& rows = campaign.campaign.observations->rows;
  std::map<std::pair<std::string, Component>, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Fit) continue;
    auto& [sum, count] = sums[{rows[i].point, rows[i].component}];
    sum += values[i];
    ++count;
  }
  std::vector<double> out(rows.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto found = sums.find({rows[i].point, rows[i].component});
    if (rows[i].use != ObservationUse::Holdout || found == sums.end()) continue;
    out[i] = (values[i] - found->second.first / found->second.second) / rows[i].sigma;
  }
  return out;
}

/// sum (a - b)^2 / sum reference^2.
double relativePower(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& reference) {
  double difference = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    whole += reference[i] * reference[i];
  }
  return whole > 0.0 ? difference / whole : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> orZero(const std::vector<double>& values, std::size_t count) {
  return values.size() == count ? values : std::vector<double>(count, 0.0);
}

}  // namespace

HeldOutSignal heldOutSignal(const VirtualCampaign& campaign, const std::vector<double>& effect_part) {
  const std::vector<double> hidden = heldOutMotion(campaign, campaign.truth.hidden_signal);
  const std::vector<double> estimate = heldOutMotion(campaign, orZero(effect_part, hidden.size()));
  HeldOutSignal out;
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    out.hidden += hidden[i] * hidden[i];
    out.missed += (estimate[i] - hidden[i]) * (estimate[i] - hidden[i]);
  }
  return out;
}

double explainedFraction(const VirtualCampaign& campaign, const std::vector<double>& effect_part) {
  return heldOutSignal(campaign, effect_part).explained();
}

namespace {

/// What the noise alone takes from the signal explained: the variance of the prediction over the held-out rows as the
/// model states it, as a part of the hidden signal.
double statedCost(const VirtualCampaign& campaign, const EffectModel& model) {
  const auto& rows = campaign.campaign.observations->rows;
  std::vector<double> variance(rows.size(), 0.0);
  for (const ModelEffect& effect : model.effects()) {
    const auto gains = static_cast<Eigen::Index>(effect.gains.size());
    const auto count = gains + static_cast<Eigen::Index>(effect.parameters.size());
    Eigen::MatrixXd gradient(static_cast<Eigen::Index>(rows.size()), count);
    const auto motion = [&](const ModelEffect& e) {
      const std::vector<double> part = EffectModel::contribution(model.drivers(), e, rows);
      const std::vector<double> held = heldOutMotion(campaign, part);
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(held.data(), static_cast<Eigen::Index>(held.size())));
    };
    const Eigen::VectorXd at = motion(effect);
    for (Eigen::Index i = 0; i < count; ++i) {
      ModelEffect moved = effect;
      if (i < gains) {
        moved.gains.setZero();
        moved.gains[i] = 1.0;
        gradient.col(i) = motion(moved);
        continue;
      }
      if (!(effect.covariance(i, i) > 0.0)) {
        gradient.col(i).setZero();
        continue;
      }
      double& parameter = moved.parameters[static_cast<std::size_t>(i - gains)];
      const double step = std::max(1.0, 0.02 * parameter);
      parameter += step;
      gradient.col(i) = (motion(moved) - at) / step;
    }
    const Eigen::MatrixXd spread = gradient * effect.covariance;
    for (Eigen::Index r = 0; r < gradient.rows(); ++r) {
      variance[static_cast<std::size_t>(r)] += spread.row(r).dot(gradient.row(r));
    }
  }
  double whole = 0.0;
  for (const double h : heldOutMotion(campaign, campaign.truth.hidden_signal)) whole += h * h;
  return whole > 0.0 ? std::accumulate(variance.begin(), variance.end(), 0.0) / whole
                     : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

OracleFit fitKnowingNames(const VirtualCampaign& campaign, const std::vector<std::string>& hidden) {
  DiscrepancyOptions options;
  options.suggest = false;
  options.max_effects = 0;
  options.accept = hidden;
  JobContext job;
  DiscrepancyInput input = inputOf(campaign);
  const std::size_t count = input.observations.rows.size();
  const DiscrepancyResult fitted = findDiscrepancy(input, options, job);
  const std::vector<double> measured = orZero(fitted.effect_part, count);
  for (std::size_t i = 0; i < count; ++i) input.observations.rows[i].value = campaign.truth.total[i];
  const std::vector<double> clean = orZero(findDiscrepancy(input, options, job).effect_part, count);
  OracleFit out;
  if (fitted.model != nullptr) out.stated_cost = statedCost(campaign, *fitted.model);
  double power = 0.0;
  double held = 0.0;
  for (const double h : heldOutMotion(campaign, campaign.truth.hidden_signal)) {
    power += h * h;
    held += h != 0.0 ? 1.0 : 0.0;
  }
  out.strength = held > 0.0 ? std::sqrt(power / held) : 0.0;
  out.explained = explainedFraction(campaign, measured);
  out.noise_free = explainedFraction(campaign, clean);
  out.noise_cost = relativePower(heldOutMotion(campaign, measured), heldOutMotion(campaign, clean),
                                 heldOutMotion(campaign, campaign.truth.hidden_signal));
  return out;
}

}  // namespace spindrift::study
