// SPDX-License-Identifier: Apache-2.0
// Where measured and simulated deviations disagree, which effect of the catalogue is missing, and what its addition
// gains.
//
//   observation = (1 + gain error) simulation + constant(point, component) + sum of effects
//               + shift(state, component) + own noise + what nobody knows
//
// Observations um / urad, places mm in MCF, times s. One probabilistic model: constants are free; gain errors of the
// simulation and the offset of its clock have priors; own noise of every component is the stated sigma times a scale,
// part of it correlated in time, with heavy tails where the data have them; a state may be shifted as a whole; all of
// their sizes are estimated from the data. What remains smooth in time and space and is none of these is told.
// Which effects: a posterior over sets of effects (effect_posterior.h). An effect is named with the probability that
// its name is right; others that may stand in its place are its rivals. A name that the data support stays, even if
// something else remains. Rows marked `holdout` only report, they never select and are never fitted. Sources: Kennedy
// and O'Hagan 2001 (model discrepancy); Golub and Pereyra 1973 (variable projection); Schwarz 1978.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/error_model.h"
#include "core/machine/machine_description.h"
#include "core/machine/observation.h"
#include "core/machine/operating_log.h"
#include "core/machine/sensor_role.h"

namespace spindrift {

class EffectModel;
class OwnEffects;
struct NoiseModel;
struct SimulatorTangents;

struct DiscrepancyOptions {
  int max_effects = 4;              ///< 0 ... 10
  std::vector<std::string> accept;  ///< ids that are put into the model in any case, in this order
  std::vector<std::string> reject;  ///< ids that the user does not want considered
  double false_alarm_rate = 0.01;   ///< (0, 0.2]: of naming anything when nothing is missing
  bool suggest = true;              ///< compute what to measure next for rivals
  double suggest_hours = 8.0;       ///< what the user allows the next measurement: hours of machine time, (0, 72]
  int suggest_points = 4;           ///< points, 1 ... 50
  int suggest_times = 16;           ///< times at which all of these are measured, 3 ... 200
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
  bool absolute = false;                   ///< values are absolute: no free constant for each point and component
  std::shared_ptr<const OwnEffects> own;   ///< effects of the user; may be null
  std::shared_ptr<const ErrorModel> base;  ///< the simulation as a model, by the clock of the observations; may be null
  std::shared_ptr<const SimulatorTangents> tangents;  ///< of a simulator (simulator_tangents.h); may be null
  std::string base_table;                             ///< name of simulation.csv for model.json; may be empty
  std::vector<std::string> notes;                     ///< sentences about the simulation that belong to the result
  std::string why_unmatched;  ///< why predictions are missing, "12 lie after its last row"; may be empty
  /// Clock of log and simulation minus clock of the observations as far as it is known beforehand, s: `predicted` is of
  /// the time `time_s` + `log_clock_s` for every observation, and so is what the log says (simulation_clock.h).
  double log_clock_s = 0.0;
  double log_clock_uncertainty_s = 0.0;
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
  std::string title;  ///< of an effect of the user's; empty: effectTitle(id)
  std::string physics;
  std::string drivers;                  ///< "feed_y_mm_min (lag 2400 s) + T_ambient_degC (lag 900 s)"
  std::vector<std::string> rivals;      ///< cannot be told from `id` with these data
  std::vector<std::string> containers;  ///< hold this effect as a special case and fit as well
  double confidence = 0.0;              ///< probability that the name is right
  std::vector<FittedParameter> parameters;
  double delta_bic = 0.0;  ///< gain in BIC when the effect enters
  double delta_chi2 = 0.0;
  double margin = 0.0;                        ///< in evidence ahead of the most probable other effect
  double rms_um = 0.0;                        ///< of its contribution in the component where it is largest
  double crossvalidated_rms_before_um = 0.0;  ///< blocks of fit rows left out, predicted without this effect
  double crossvalidated_rms_after_um = 0.0;
  double heldout_rms_before_um = 0.0;  ///< rows marked holdout (the left-out blocks where there are none)
  double heldout_rms_after_um = 0.0;
  bool forced = false;  ///< put in by the user
};

/// Noise of one component as found.
struct NoiseEstimate {
  Component component = Component::EX;
  double scale = 1.0;  ///< standard deviation of the own noise: actual / stated sigma, outliers left out
  double scale_uncertainty = 0.0;
  double common_um = 0.0;  ///< standard deviation of the shift common to all points of a state, um or urad
  double correlated_part = 0.0;
  double correlation_time_s = 0.0;
  double drift_um = 0.0;  ///< of common_um, the part that drifts: standard deviation, um or urad
  double drift_correlation_time_s = 0.0;
};

/// The component whose readings scatter most over their stated sigma, if one does by more than three times: what agrees
/// within such a scatter shows little. Null if none does.
[[nodiscard]] const NoiseEstimate* farAboveStated(const std::vector<NoiseEstimate>& noise);

/// The shift of one state that re-referencing leaves.
struct StateShift {
  std::string state;
  Component component = Component::EX;
  double time_s = 0.0;
  double shift_um = 0.0;  ///< um or urad
  double standard_uncertainty = 0.0;
};

/// A reading far from all that the model allows; it was given little weight.
struct OutlyingReading {
  std::size_t row = 0;     ///< of the observations, from 0
  double deviation = 0.0;  ///< in standard deviations of the own noise
};

struct EffectCandidate {
  std::string id;
  double probability = 0.0;  ///< that it is among what is missing, before rivals and what remains are weighed
  bool rejected = false;     ///< by the user: weighed, but not named
};

/// What remains beside the effects, in one component.
struct ComponentRemainder {
  Component component = Component::EX;
  double rms_um = 0.0;    ///< um or urad
  double evidence = 0.0;  ///< 2 ln of the odds that it is more than noise
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

/// rms in um over displacements; in urad over rotations where nothing else was observed.
struct DiscrepancyGap {
  double rms_before_um = 0.0;
  double rms_after_um = 0.0;
  double noise_um = 0.0;
  double heldout_rms_before_um = 0.0;
  double heldout_rms_after_um = 0.0;
  bool rotations = false;  ///< all of it is in urad

  /// What is there before anything is added is no more than noise; the rest of it is what a simulation may be off by.
  [[nodiscard]] bool withinNoise() const noexcept { return rms_before_um <= 1.25 * noise_um; }
};

/// A part of an operating programme: what the machine does from one time to another, everything else at rest.
struct ProgrammeStep {
  double from_s = 0.0;  ///< since the start of the programme
  double to_s = 0.0;
  std::string action;      ///< "rest", "X alone at 12 m/min", "the program of the log again"
  bool as_logged = false;  ///< what the log did since its start; the rates below are not used
  double spindle_rpm = 0.0;
  std::array<double, 3> feed_mm_min{};  ///< X, Y, Z
  double c_rpm = 0.0;
  bool coolant = false;
  std::array<double, 3> position_mm{};  ///< X, Y, Z: where the axes stand or around which they move

  friend bool operator==(const ProgrammeStep&, const ProgrammeStep&) = default;
};

/// What to measure next to separate effects from their rivals: an operating programme for a machine that has rested
/// overnight, and where and when to measure meanwhile.
struct MeasurementSuggestion {
  std::vector<std::string> points;  ///< of the machine or, where it has none there, "(x, y, z) mm"
  std::vector<double> times_s;      ///< since the start of the programme; all points are measured at each
  std::vector<double> c_deg;        ///< table angle at each time; empty: as it stands
  std::string conditions;           ///< the plan in one sentence
  std::string separates;            ///< "spindle.drift.x from ambient.drift.x"
  double expected_delta_bic = 0.0;  ///< gain in evidence of the effect named over its nearest rival, if it is right
  std::vector<ProgrammeStep> programme;
  bool restart_instrument = false;          ///< off overnight, switched on at the start; else left on
  double expected_information_nats = 0.0;   ///< about which of the candidates it is
  double present_entropy_nats = 0.0;        ///< what there is to be known of that
  double probability_alone_now = 0.0;       ///< of the most probable candidate, as it stands
  double probability_alone_expected = 0.0;  ///< that the right one of them is named without rivals afterwards

  friend bool operator==(const MeasurementSuggestion&, const MeasurementSuggestion&) = default;
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
  std::vector<SensorReading> sensors;        ///< what every temperature of the log was taken for
  std::shared_ptr<const EffectModel> model;  ///< the effects found (without the base)
  /// Per row of the observations: simulation, completed model (with the free constant of the series, so that it
  /// compares with the value); NaN where there is no simulation.
  std::vector<double> simulated;
  std::vector<double> completed;
  std::vector<double> constant;             ///< the fitted constant of the row's series
  std::vector<double> effect_part;          ///< sum of the effects at the row
  std::size_t unmatched = 0;                ///< observations without a prediction
  std::vector<EffectCandidate> candidates;  ///< the ten most probable, whatever is named
  std::vector<NoiseEstimate> noise;         ///< of every component observed
  std::vector<StateShift> shifts;           ///< where a component has a common shift
  std::vector<OutlyingReading> outliers;
  double tail_dof = 0.0;                    ///< Student degrees of freedom of the own noise; 0: normal
  double clock_offset_s = 0.0;              ///< clock of the log minus clock of the observations
  double clock_offset_uncertainty_s = 0.0;  ///< 0: not seen in these data
  std::vector<ComponentRemainder> remainder;
  std::vector<double> remaining;  ///< per row: what remains and is not noise, um or urad; 0 where nothing is known
  std::shared_ptr<const NoiseModel> noise_model;  ///< as found, for fits that go on from here
  double explained_fraction = 0.0;                ///< of the structured part of the residual
  /// Names of parameters of the simulator that do the same to these readings, in pairs.
  std::vector<std::pair<std::string, std::string>> twins;

  /// Noise of a component as found; nothing where the component was not fitted.
  [[nodiscard]] const NoiseEstimate* noiseOf(Component component) const;
  /// Standard deviation of one reading of stated `sigma`: own noise and shift of its state, um or urad.
  [[nodiscard]] double readingSigma(Component component, double sigma) const;
  /// The JSON of FORMATS.md.
  [[nodiscard]] nlohmann::json json() const;
  /// A few lines for people.
  [[nodiscard]] std::string summary() const;
};

/// Throws InputError: fewer than half of the observations have a prediction, no observation to fit, an unknown id.
[[nodiscard]] DiscrepancyResult findDiscrepancy(const DiscrepancyInput& input, const DiscrepancyOptions& options,
                                                JobContext& job);

/// The prediction of a simulation for every observation: a table (core/machine/simulation_table.h), a model, or
/// finite-element results by their map (core/finite_elements). Reads campaign.simulation (or `simulation.csv` beside
/// campaign.json); throws InputError if there is none or it cannot be read.
[[nodiscard]] DiscrepancyInput discrepancyInput(const Campaign& campaign, ObservationSet observations);
/// The same with a simulator's own prediction in place of the campaign's; notes where the two differ.
[[nodiscard]] DiscrepancyInput discrepancyInput(const Campaign& campaign, ObservationSet observations,
                                                std::shared_ptr<const SimulatorTangents> tangents);

}  // namespace spindrift
