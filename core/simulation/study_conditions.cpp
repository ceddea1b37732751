// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/study_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "core/base/random.h"

namespace spindrift {
namespace {

enum class ConditionStream : std::uint64_t {
  Noise = 101,
  Tails,
  Outliers,
  Sigma,
  Common,
  Warm,
  Clock,
  Sensors,
  Gaps,
  Uneven,
  Drift
};

Random streamOf(std::uint64_t seed, ConditionStream stream) {
  Random random(seed * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(stream));
  return random.split();
}

double studentT4(Random& random) {
  const double z = random.normal();
  double chi2 = 0.0;
  for (int i = 0; i < 4; ++i) chi2 += std::pow(random.normal(), 2);
  return z / std::sqrt(0.25 * std::max(chi2, 1e-12)) / std::numbers::sqrt2;  // variance nu / (nu - 2) = 2
}

/// Noise of unit variance per row, correlated from one state of a series to the next.
std::vector<double> unitNoise(const std::vector<Observation>& rows, bool tails, double ar1, std::uint64_t seed) {
  Random normal = streamOf(seed, ConditionStream::Noise);
  Random heavy = streamOf(seed, ConditionStream::Tails);
  std::map<std::pair<std::string, Component>, double> memory;
  std::vector<double> noise(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double fresh = tails ? studentT4(heavy) : normal.normal();
    const auto [entry, first] = memory.try_emplace({rows[i].point, rows[i].component}, fresh);
    if (!first) entry->second = ar1 * entry->second + std::sqrt(1.0 - ar1 * ar1) * fresh;
    noise[i] = entry->second;
  }
  return noise;
}

/// A smooth factor over the machine: 1 + 0.15 x a sum of long waves of unit rms over the points.
std::map<std::string, double> unevenFactors(const std::vector<Observation>& rows, std::uint64_t seed) {
  Random random = streamOf(seed, ConditionStream::Uneven);
  std::map<std::string, Eigen::Vector3d> places;
  for (const Observation& row : rows) places.emplace(row.point, row.position_mm);
  std::map<std::string, double> wave;
  for (int k = 0; k < 4; ++k) {
    Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
    direction.normalize();
    const double length_mm = random.uniform(500.0, 1200.0);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    for (const auto& [point, place] : places) {
      wave[point] += std::sin(2.0 * std::numbers::pi * direction.dot(place) / length_mm + phase);
    }
  }
  double mean = 0.0;
  for (const auto& [point, value] : wave) mean += value / static_cast<double>(wave.size());
  double square = 0.0;
  for (const auto& [point, value] : wave) square += std::pow(value - mean, 2) / static_cast<double>(wave.size());
  for (auto& [point, value] : wave) value = 1.0 + 0.15 * (value - mean) / std::sqrt(std::max(square, 1e-12));
  return wave;
}

/// rms over the rows to be fitted, in the component where it is largest, of the change since the first row of a series,
/// in sigma.
double strengthOf(const std::vector<double>& signal, const std::vector<Observation>& rows) {
  std::map<std::pair<std::string, Component>, double> first;
  std::map<Component, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double start = first.try_emplace({rows[i].point, rows[i].component}, signal[i]).first->second;
    if (rows[i].use != ObservationUse::Fit) continue;
    auto& [sum, count] = sums[rows[i].component];
    sum += std::pow((signal[i] - start) / rows[i].sigma, 2);
    ++count;
  }
  double strength = 0.0;
  for (const auto& [component, sum] : sums) strength = std::max(strength, std::sqrt(sum.first / sum.second));
  return strength;
}

/// Courses that an instrument drifts along, in sigma, each component for itself: exponentially correlated in time.
class InstrumentDrift {
 public:
  explicit InstrumentDrift(std::uint64_t seed)
      : random_(streamOf(seed, ConditionStream::Drift)),
        size_(random_.uniform(0.5, 1.0)),
        time_s_(random_.uniform(1800.0, 3600.0)) {}
  [[nodiscard]] double time_s() const { return time_s_; }
  /// At times that do not decrease.
  double next(Component component, double time_s) {
    const double fresh = random_.normal();
    const auto [at, first] = at_.try_emplace(component, time_s, size_ * fresh);
    auto& [last_s, value] = at->second;
    if (first) return value;
    const double kept = std::exp(-(time_s - last_s) / time_s_);
    value = kept * value + size_ * std::sqrt(1.0 - kept * kept) * fresh;
    last_s = time_s;
    return value;
  }

 private:
  Random random_;
  double size_;
  double time_s_;
  std::map<Component, std::pair<double, double>> at_;
};

bool isBase(const CampaignTruth& truth, const std::string& id) {
  return std::find(truth.base.begin(), truth.base.end(), id) != truth.base.end();
}

/// Adds to everything that the truth says about a hidden cause: its signal times (factor of the row - 1).
template <typename Factor>
void scaleHidden(VirtualCampaign& campaign, const std::string& id, const Factor& factor) {
  CampaignTruth& truth = campaign.truth;
  const auto found = truth.signals.find(id);
  if (found == truth.signals.end() || isBase(truth, id)) return;
  for (std::size_t i = 0; i < found->second.size(); ++i) {
    const double change = (factor(i) - 1.0) * found->second[i];
    found->second[i] += change;
    truth.total[i] += change;
    truth.hidden_signal[i] += change;
  }
}

/// Times restart from 0 where the log begins; the simulation counts from its first state.
void cutBeginning(VirtualCampaign& campaign, double warm_s) {
  for (Observation& row : campaign.campaign.observations.edit().rows) row.time_s -= warm_s;
  std::map<std::pair<std::string, Component>, double> first;
  for (SimulatedRow& row : campaign.simulation) {
    row.time_s -= warm_s;
    row.predicted -= first.try_emplace({row.point, row.component}, row.predicted).first->second;
    row.predicted = std::round(row.predicted * 1e4) / 1e4;
  }
  const OperatingLog& whole = *campaign.campaign.log;
  std::vector<double> times;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < whole.time_s().size(); ++i) {
    if (whole.time_s()[i] < warm_s) {
      begin = i + 1;
    } else {
      times.push_back(whole.time_s()[i] - warm_s);
    }
  }
  OperatingLog rest(times);
  for (const std::string& name : whole.names()) {
    const std::vector<double>& values = *whole.signal(name);
    rest.setSignal(name, {values.begin() + static_cast<std::ptrdiff_t>(begin), values.end()});
  }
  campaign.campaign.log = rest;
  std::map<std::string, std::vector<std::size_t>> dropouts;
  for (const auto& [name, rows] : campaign.dropouts) {
    for (const std::size_t row : rows) {
      if (row >= begin) dropouts[name].push_back(row - begin);
    }
  }
  campaign.dropouts = dropouts;
}

/// Rows that stay.
std::vector<bool> keptRows(const std::vector<Observation>& rows, std::uint64_t seed) {
  Random random = streamOf(seed, ConditionStream::Gaps);
  std::vector<std::string> states;
  for (const Observation& row : rows) {
    if (states.empty() || states.back() != row.state) states.push_back(row.state);
  }
  const double part = random.uniform(0.2, 0.3);
  std::set<std::string> missing;
  const std::size_t count = 2 + random.index(3);
  while (missing.size() < std::min(count, states.size() - 1))
    missing.insert(states[1 + random.index(states.size() - 1)]);
  std::vector<bool> kept;
  for (const Observation& row : rows) kept.push_back(random.uniform() >= part && !missing.contains(row.state));
  return kept;
}

}  // namespace

StudyConditions StudyConditions::together() {
  StudyConditions c;
  c.sigma = c.tails = c.common = c.coarse_sensors = c.gaps = true;
  c.base_error = 0.08;
  return c;
}

nlohmann::json StudyConditions::json() const {
  return {{"sigma", sigma},
          {"tails", tails},
          {"common", common},
          {"drift", drift},
          {"warm_start", warm_start},
          {"clock", clock},
          {"coarse_sensors", coarse_sensors},
          {"slow_sensors", slow_sensors},
          {"gaps", gaps},
          {"uneven", uneven},
          {"base_error", base_error},
          {"one_base_error", one_base_error}};
}

double warmUp_s(const StudyConditions& conditions, std::uint64_t seed) {
  if (!conditions.warm_start) return 0.0;
  return 30.0 * std::round(streamOf(seed, ConditionStream::Warm).uniform(7200.0, 10800.0) / 30.0);
}

void prepare(Scenario& s, const StudyConditions& c, std::uint64_t seed) {
  SPINDRIFT_ASSERT(s.measurement.has_value(), "a study campaign without a measurement");
  const double warm_s = warmUp_s(c, seed);
  if (warm_s > 0.0) {
    s.duration_s += warm_s;
    s.random_programme.duration_s = s.duration_s;
    for (double& time : s.measurement->times_s) time += warm_s;
    for (auto& [id, effect] : s.effects) {
      for (const char* name : {"time_s", "onset_s"}) {
        const auto found = effect.setting.parameters.find(name);
        if (found != effect.setting.parameters.end()) found->second += warm_s;
      }
    }
    // The instrument comes to the warm machine.
    s.random_programme.instrument_on_s = warm_s;
  }
  if (c.clock) {
    s.measurement->clock_offset_s = std::round(streamOf(seed, ConditionStream::Clock).uniform(-240.0, 240.0));
    for (double& time : s.measurement->times_s) time += 300.0;
  }
  Random random = streamOf(seed, ConditionStream::Sensors);
  for (SensorOptions& sensor : s.sensors) {
    const double lag_s = random.uniform(300.0, 900.0);
    if (c.coarse_sensors) sensor.resolution_K = 0.5;
    if (c.slow_sensors) sensor.time_constant_s = lag_s;
  }
}

nlohmann::json AppliedConditions::json() const {
  nlohmann::json sigma = nlohmann::json::object();
  for (const auto& [component, factor] : stated_over_real_sigma) sigma[std::string(toString(component))] = factor;
  nlohmann::json shift = nlohmann::json::array();
  for (const auto& [key, value] : shifts) {
    shift.push_back({{"state", key.first}, {"component", toString(key.second)}, {"shift", value}});
  }
  return {{"stated_over_real_sigma", sigma}, {"outliers", outliers},         {"shifts", shift},
          {"drift_time_s", drift_time_s},    {"warm_start_s", warm_start_s}, {"clock_offset_s", clock_offset_s}};
}

AppliedConditions applyConditions(VirtualCampaign& campaign, const StudyConditions& c, double strength, double ar1,
                                  std::uint64_t seed) {
  AppliedConditions applied;
  CampaignTruth& truth = campaign.truth;
  std::vector<Observation>& rows = campaign.campaign.observations.edit().rows;
  if (c.warm_start && strength > 0.0) {
    for (const std::string& id : truth.hidden) {
      if (isBase(truth, id)) continue;
      const double present = strengthOf(truth.signals.at(id), rows);
      if (!(present > 0.0)) continue;
      scaleHidden(campaign, id, [&](std::size_t) { return strength / present; });
      truth.settings[id].size *= strength / present;
      truth.sizes[id].rms *= strength / present;
    }
  }
  if (c.uneven) {
    const auto factors = unevenFactors(rows, seed);
    for (const std::string& id : truth.hidden) {
      scaleHidden(campaign, id, [&](std::size_t i) { return factors.at(rows[i].point); });
    }
  }

  const std::vector<double> noise = unitNoise(rows, c.tails, ar1, seed);
  Random outlier_random = streamOf(seed, ConditionStream::Outliers);
  Random common_random = streamOf(seed, ConditionStream::Common);
  InstrumentDrift drift(seed);
  applied.drift_time_s = c.drift ? drift.time_s() : 0.0;
  std::vector<bool> outlier(rows.size(), false);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Observation& row = rows[i];
    double off = noise[i];
    if (c.tails && outlier_random.uniform() < 0.01) {
      const double size = outlier_random.uniform(6.0, 15.0);
      off += outlier_random.uniform() < 0.5 ? -size : size;
      outlier[i] = true;
    }
    double value = truth.total[i] + row.sigma * off;
    if (c.common || c.drift) {
      const auto [shift, fresh] = applied.shifts.try_emplace({row.state, row.component}, 0.0);
      if (fresh && c.common) shift->second += 0.6 * row.sigma * common_random.normal();
      if (fresh && c.drift) shift->second += row.sigma * drift.next(row.component, row.time_s);
      value += shift->second;
    }
    row.value = std::round(value * 1e4) / 1e4;
  }
  Random sigma_random = streamOf(seed, ConditionStream::Sigma);
  for (const Component component : all_components) {
    const double factor = std::exp(sigma_random.uniform(std::log(0.6), std::log(1.6)));
    applied.stated_over_real_sigma[component] = c.sigma ? factor : 1.0;
  }
  for (Observation& row : rows) row.sigma *= applied.stated_over_real_sigma.at(row.component);

  if (c.gaps) {
    const std::vector<bool> kept = keptRows(rows, seed);
    const auto compact = [&](auto& values) {
      std::size_t n = 0;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i]) values[n++] = values[i];
      }
      values.resize(n);
    };
    compact(truth.total);
    compact(truth.hidden_signal);
    compact(truth.base_error);
    for (auto& [id, signal] : truth.signals) compact(signal);
    compact(outlier);
    compact(rows);
  }
  for (std::size_t i = 0; i < outlier.size(); ++i) {
    if (outlier[i]) applied.outliers.push_back(i);
  }
  applied.warm_start_s = warmUp_s(c, seed);
  if (c.warm_start) cutBeginning(campaign, applied.warm_start_s);
  if (c.clock) applied.clock_offset_s = std::round(streamOf(seed, ConditionStream::Clock).uniform(-240.0, 240.0));
  return applied;
}

}  // namespace spindrift
