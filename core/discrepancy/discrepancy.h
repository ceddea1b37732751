// SPDX-License-Identifier: Apache-2.0
// Where measured and simulated deviations disagree, which effect of the catalogue is missing, and what its addition
// gains.
//
//   observation = simulation * (1 + gain error of the component) + constant(point, component) + sum of effects + noise
//
// Observations um / urad, places mm in MCF, times s. The constants are free; gain errors carry a Gaussian prior of the
// stated uncertainty; noise is sigma as stated times a scale, part of it correlated in time within a series (point,
// component) as exp(-dt/T); scale, part and T are estimated and whitened. Effects are fitted by variable projection.
// Rows marked `holdout` only report, they never select and are never fitted.
//
// Which effects: forward search with joint refits; an effect enters when its gain in chi-squared passes a union bound
// over every driver, lag and onset tried, beyond a model-error term proportional to what the accepted effects explain,
// and when it predicts blocks of states that were left out. Effects that the data cannot separate are rivals. When
// something stays that no effect explains, nothing is named.
// Sources: Golub and Pereyra 1973 (variable projection); Kennedy and O'Hagan 2001 (model discrepancy); Schwarz 1978.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/error.h"
#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/error_model.h"
#include "core/machine/machine_description.h"
#include "core/machine/observation.h"
#include "core/machine/operating_log.h"

namespace spindrift {

class EffectModel;

struct DiscrepancyOptions {
  int max_effects = 4;              ///< 0 ... 10
  std::vector<std::string> accept;  ///< ids that are put into the model in any case, in this order
  std::vector<std::string> reject;  ///< ids that the user does not want considered
  double false_alarm_rate = 0.01;   ///< (0, 0.2]: of naming anything when nothing is missing
  bool suggest = true;              ///< compute what to measure next for rivals
  void validate() const;
};

/// Everything the search looks at. `predicted[i]` belongs to `observations.rows[i]`, NaN where the simulation has no
/// value.
struct DiscrepancyInput {
  MachineDescription machine;
  std::optional<OperatingLog> log;
  ObservationSet observations;
  std::vector<double> predicted;
  double simulation_gain_uncertainty = 0.01;
  std::shared_ptr<const ErrorModel> base;  ///< the simulation as a model; may be null
  std::string base_table;                  ///< name of simulation.csv for model.json; may be empty
};

enum class DiscrepancyVerdict { Named, Ambiguous, Unknown, None };
[[nodiscard]] std::string_view toString(DiscrepancyVerdict verdict) noexcept;

struct FittedParameter {
  std::string name;  ///< with its unit
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

struct FoundEffect {
  std::string id;
  std::string physics;
  std::string drivers;                  ///< "feed_y_mm_min (lag 2400 s) + T_ambient_degC (lag 900 s)"
  std::vector<std::string> rivals;      ///< cannot be told from `id` with these data
  std::vector<std::string> containers;  ///< hold this effect as a special case and fit as well
  double confidence = 0.0;              ///< probability that the name is right
  std::vector<FittedParameter> parameters;
  double delta_bic = 0.0;  ///< gain in BIC when the effect enters
  double delta_chi2 = 0.0;
  double margin = 0.0;  ///< in score (chi-squared minus parameters x ln n) ahead of the best other effect
  double rms_um = 0.0;  ///< of its contribution in the component where it is largest
  double crossvalidated_rms_before_um = 0.0;  ///< blocks of fit rows left out, predicted without this effect
  double crossvalidated_rms_after_um = 0.0;
  double heldout_rms_before_um = 0.0;  ///< rows marked holdout (the left-out blocks where there are none)
  double heldout_rms_after_um = 0.0;
  bool forced = false;  ///< put in by the user
};

/// A place where residuals are larger than noise allows. p-values hold for all places looked at together.
struct DisagreementPlace {
  Component component = Component::EX;
  std::vector<std::string> points;
  double from_s = 0.0;
  double to_s = 0.0;
  double excess_um = 0.0;  ///< rms beyond the noise (um or urad)
  double p_value = 1.0;
  std::string condition;  ///< "spindle on", "z above 200 mm"; empty for a span of time
};

/// rms in um over displacements (urad are weighed by their sigma relative to the mean sigma of displacements).
struct DiscrepancyGap {
  double rms_before_um = 0.0;
  double rms_after_um = 0.0;
  double noise_um = 0.0;
  double heldout_rms_before_um = 0.0;
  double heldout_rms_after_um = 0.0;
};

/// What to measure next to separate an effect from its rivals.
struct MeasurementSuggestion {
  std::vector<std::string> points;
  std::vector<double> times_s;  ///< of this campaign's programme, when it is run again
  std::string conditions;
  std::string separates;  ///< "spindle.drift.x from ambient.drift.x"
  double expected_delta_bic = 0.0;
};

/// One step of the search, kept for the session and the report.
struct DiscrepancyStep {
  std::string id;
  bool accepted = false;
  double delta_bic = 0.0;
  double delta_chi2 = 0.0;
  std::string reason;
};

struct DiscrepancyResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;  ///< one sentence for the user
  DiscrepancyVerdict verdict = DiscrepancyVerdict::None;
  bool decided = true;  ///< false: the data do not suffice to decide anything; `message` says why
  std::vector<FoundEffect> effects;
  std::vector<DisagreementPlace> where;
  DiscrepancyGap gap;
  std::optional<MeasurementSuggestion> suggestion;
  std::string leftover;  ///< empty: nothing is left
  std::vector<DiscrepancyStep> steps;
  std::vector<std::string> warnings;
  std::shared_ptr<const EffectModel> model;  ///< the effects found (without the base)
  /// Per row of the observations: simulation, completed model (with the free constant of the series, so that it
  /// compares with the value); NaN where there is no simulation.
  std::vector<double> simulated;
  std::vector<double> completed;
  std::vector<double> constant;        ///< the fitted constant of the row's series
  std::vector<double> effect_part;     ///< sum of the effects at the row
  std::size_t unmatched = 0;           ///< observations without a prediction
  double noise_scale = 1.0;            ///< actual / stated sigma
  double noise_correlated_part = 0.0;  ///< 0 ... 1
  double noise_correlation_time_s = 0.0;
  double explained_fraction = 0.0;  ///< of the structured part of the residual
  /// In BIC, of an unknown cause (a free course in time, or a free pattern times a course) over the effects found, in
  /// the component where it is largest; below zero the names are the better explanation.
  double unknown_advantage = 0.0;
  double leftover_p_value = 1.0;  ///< of the most structured part of what is left

  /// The JSON of FORMATS.md.
  [[nodiscard]] nlohmann::json json() const;
  /// A few lines for people.
  [[nodiscard]] std::string summary() const;
};

/// Throws InputError: fewer than half of the observations have a prediction, no observation to fit, an unknown id.
[[nodiscard]] DiscrepancyResult findDiscrepancy(const DiscrepancyInput& input, const DiscrepancyOptions& options,
                                                JobContext& job);

/// The prediction of a simulation table or model for every observation. Reads campaign.simulation (or `simulation.csv`
/// beside campaign.json); throws InputError if there is none or it cannot be read.
[[nodiscard]] DiscrepancyInput discrepancyInput(const Campaign& campaign, ObservationSet observations);

/// simulation.csv: time_s,point,component,predicted.
class SimulationTable {
 public:
  [[nodiscard]] static SimulationTable read(const std::filesystem::path& file);
  /// NaN if the table has no row for it (times agree within 1 ms).
  [[nodiscard]] double at(double time_s, const std::string& point, Component component) const;
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }

 private:
  std::map<std::tuple<std::string, int, long long>, double> values_;
};

}  // namespace spindrift
