// SPDX-License-Identifier: Apache-2.0
// One parameter of a machine over months: control limits, and statistically significant changes.
//
// Model: y_i = level(t_i) + b_i + e_i, e_i normal with the stated standard uncertainty u_i of the evaluation, b_i the
// scatter from campaign to campaign with the unknown variance tau^2 (set-up, room). tau^2 from successive differences,
// which a step or a slow drift hardly touches: the solution of mean(min(d_i^2 / v_i, 6.25)) = E(min(chi2_1, 6.25)) with
// v_i = 2 tau^2 + u_i^2 + u_(i+1)^2 (clipped so that steps do not count; Paule and Mandel 1982 without the clipping).
//
// Control limits: level and scatter of the first points after the machine was changed last (the baseline). Shewhart:
// |z_i| > 3, z_i = (y_i - level) / sqrt(tau^2 + u_i^2 + var(level)). EWMA (Roberts 1959) of these z with weight 0.2,
// limit 2.7 of its own standard deviation; it sees small shifts that last.
//
// Changes: over a stretch without a change the largest of two statistics, each a likelihood ratio: a step at any place
// between two points, or a straight drift. Its p-value is that of the same statistic over permutations of the points
// (values with their uncertainties): exact for any scatter, and it holds for all places looked at together. What is
// significant is named, taken out, and what remains is looked at again. Sources: Hinkley 1970, Worsley 1986; a single
// value far off is named as such, by its z among the others.
//
// Units: those of the parameter; times UTC seconds. Throws InputError for options that make no sense, never for data.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/plant/plant_types.h"

namespace spindrift {

struct ChartOptions {
  std::size_t baseline = 15;  ///< points that level and scatter are taken from, 5 ... 1000
  double shewhart = 3.0;      ///< standard deviations, 1 ... 10
  double ewma_weight = 0.2;   ///< (0, 1]
  double ewma_limit = 2.7;    ///< standard deviations, 1 ... 10
  double alpha = 0.01;        ///< of naming a change in a record without one, 0.001 ... 0.2
  std::uint64_t seed = 1;     ///< of the permutations
  void validate() const;
};

struct ChartPoint {
  TrendPoint point;
  double centre = 0.0;  ///< level of the baseline that holds for this point
  double lower = 0.0;   ///< Shewhart limits of a value with this uncertainty
  double upper = 0.0;
  double ewma = 0.0;  ///< in units of the parameter
  double ewma_lower = 0.0;
  double ewma_upper = 0.0;
  bool baseline = false;
  bool outside = false;       ///< of the Shewhart limits
  bool ewma_outside = false;  ///< of those of the EWMA
};

enum class ChangeKind { Step, Drift, SingleValue };
[[nodiscard]] std::string_view toString(ChangeKind kind) noexcept;

struct NamedChange {
  ChangeKind kind = ChangeKind::Step;
  double from_s = 0.0;  ///< a step lies between these two campaigns; a drift reaches from the one to the other
  double to_s = 0.0;
  double size = 0.0;  ///< of a step or a single value; of a drift: over its whole length
  double standard_uncertainty = 0.0;
  double p_value = 1.0;
  std::string event;  ///< what was entered for that time: kind and note; empty: nothing
  /// "step of +3.2 ± 0.4 um between 2026-01-04 and 2026-01-11 (p < 0.001), where spindle changed was entered"
  [[nodiscard]] std::string sentence(std::string_view unit) const;
};

struct ControlChart {
  std::string unit;
  std::vector<ChartPoint> points;
  std::vector<NamedChange> changes;  ///< in order of time
  double scatter = 0.0;              ///< tau
  bool limits = false;               ///< false: too few values for a baseline
  std::vector<std::string> notes;    ///< what could not be said and why
  /// The newest values are inside of both limits, and nothing has changed since the last event that changes the
  /// machine.
  [[nodiscard]] bool inControl() const;
  [[nodiscard]] nlohmann::json json() const;
};

/// `points` in order of time; `events` of the machine. `name` gives the unit by its end.
[[nodiscard]] ControlChart controlChart(const std::vector<TrendPoint>& points, const std::vector<MachineEvent>& events,
                                        const std::string& name, const ChartOptions& options = {});

/// Variance tau^2 of the scatter from value to value beside the stated uncertainties; 0 for fewer than 4 values.
[[nodiscard]] double scatterVariance(const std::vector<double>& values, const std::vector<double>& sigma);

}  // namespace spindrift
