// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/base/random.h"
#include "core/discrepancy/effect_model.h"

namespace spindrift::study {

bool sameEffect(const std::string& a, const std::string& b) {
  const auto either = [&](std::string_view x, std::string_view y) { return (a == x && b == y) || (a == y && b == x); };
  return a == b || either("rotary.expansion.r0t", "table.expansion.xy");
}

bool containsEffect(const std::string& container, const std::string& simple) {
  const auto starts = [](const std::string& id, std::string_view stem) { return id.starts_with(stem); };
  if (starts(container, "head.tilt.")) {
    return starts(simple, "spindle.") || starts(simple, "ambient.drift.");
  }
  if (container == "column.expansion.z") {
    return simple == "spindle.growth.z" || simple == "spindle.centrifugal.z" || simple == "ambient.drift.z" ||
           simple == "scale.expansion.z";
  }
  if (container == "spindle.growth.z") return simple == "spindle.centrifugal.z";
  return starts(container, "ball_screw.nonuniform.") && simple == "ball_screw.expansion." + container.substr(22);
}

namespace {

/// The name and its rivals; a set of more than three, containers not counted, is no answer and comes back empty.
std::vector<std::string> setOf(const Answer::Listed& listed) {
  std::vector<std::string> set{listed.id};
  set.insert(set.end(), listed.rivals.begin(), listed.rivals.end());
  const auto counted = std::count_if(set.begin(), set.end(), [&](const std::string& id) {
    return std::none_of(set.begin(), set.end(), [&](const std::string& other) { return containsEffect(id, other); });
  });
  if (counted > 3) set.clear();
  return set;
}

/// Gives each hidden effect a listed one of its own if that can be (augmenting paths).
bool assign(std::size_t hidden, const std::vector<std::vector<bool>>& fits, std::vector<bool>& tried,
            std::vector<int>& owner) {
  for (std::size_t k = 0; k < owner.size(); ++k) {
    if (!fits[hidden][k] || tried[k]) continue;
    tried[k] = true;
    if (owner[k] < 0 || assign(static_cast<std::size_t>(owner[k]), fits, tried, owner)) {
      owner[k] = static_cast<int>(hidden);
      return true;
    }
  }
  return false;
}

}  // namespace

Verdict judge(const Answer& answer, const std::vector<std::string>& hidden) {
  Verdict verdict;
  const std::size_t count = answer.effects.size();
  std::vector<std::vector<bool>> fits(hidden.size(), std::vector<bool>(count, false));
  for (std::size_t k = 0; k < count; ++k) {
    const Answer::Listed& listed = answer.effects[k];
    const std::vector<std::string> set = setOf(listed);
    bool near_truth = false;
    for (std::size_t h = 0; h < hidden.size(); ++h) {
      fits[h][k] = std::any_of(set.begin(), set.end(), [&](const auto& id) { return sameEffect(id, hidden[h]); });
      const bool among =
          sameEffect(listed.id, hidden[h]) || std::any_of(listed.rivals.begin(), listed.rivals.end(),
                                                          [&](const auto& id) { return sameEffect(id, hidden[h]); });
      near_truth = near_truth || among;
    }
    if (!near_truth) verdict.outcome = Outcome::Wrong;
  }
  std::vector<int> owner(count, -1);
  for (std::size_t h = 0; h < hidden.size(); ++h) {
    std::vector<bool> tried(count, false);
    if (assign(h, fits, tried, owner)) ++verdict.found;
  }
  if (verdict.outcome == Outcome::Wrong) return verdict;
  const bool all = !hidden.empty() && verdict.found == static_cast<int>(hidden.size()) && count == hidden.size();
  if (!all) return verdict;
  const bool by_name = std::all_of(hidden.begin(), hidden.end(), [&](const std::string& id) {
    return std::any_of(answer.effects.begin(), answer.effects.end(),
                       [&](const Answer::Listed& listed) { return sameEffect(listed.id, id); });
  });
  verdict.outcome = by_name ? Outcome::Named : Outcome::Rival;
  return verdict;
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

double heldOutStrength(const VirtualCampaign& campaign) {
  const std::vector<double> hidden = heldOutMotion(campaign, campaign.truth.hidden_signal);
  const auto& rows = campaign.campaign.observations->rows;
  std::map<Component, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Holdout) continue;
    auto& [sum, count] = sums[rows[i].component];
    sum += hidden[i] * hidden[i];
    ++count;
  }
  double strength = 0.0;
  for (const auto& [component, sum] : sums) strength = std::max(strength, std::sqrt(sum.first / sum.second));
  return strength;
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
  // As good as without noise; none at all, and what all points share is a shift of the instrument as well as an effect.
  constexpr double hardly_any = 0.02;
  Random random(17);
  for (std::size_t i = 0; i < count; ++i) {
    Observation& o = input.observations.rows[i];
    o.value = campaign.truth.total[i] + hardly_any * o.sigma * random.normal();
  }
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

std::vector<std::pair<std::string, double>> gainsOfMissed(const DiscrepancyInput& input,
                                                          const std::vector<std::string>& hidden,
                                                          const Answer& answer) {
  const auto listed = [&](const std::string& id) {
    return std::any_of(answer.effects.begin(), answer.effects.end(),
                       [&](const Answer::Listed& e) { return sameEffect(e.id, id); });
  };
  DiscrepancyOptions options;
  options.suggest = false;
  options.max_effects = 0;
  options.accept = hidden;
  JobContext job;
  std::vector<std::pair<std::string, double>> out;
  for (const FoundEffect& e : findDiscrepancy(input, options, job).effects)
    if (!listed(e.id)) out.emplace_back(e.id, e.delta_bic);
  return out;
}

}  // namespace spindrift::study
