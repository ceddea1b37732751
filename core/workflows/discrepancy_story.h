// SPDX-License-Identifier: Apache-2.0
// The discrepancy between simulation and measurement as a story with steps: what a search found, which effects the user
// has added to the model so far, and every series of observations before and after. Can be kept in a session and told
// again without a new search. Units as in FORMATS.md: um and urad, mm in MCF, s.
//
//   before  simulation alone                                  residual = value - simulated - constant_before
//   after   simulation plus the effects added, jointly fitted  residual = value - completed - constant_after
//
// `rms`, `noise` and `excess` of a series are over its rows with use `fit`; excess^2 = max(0, rms^2 - noise^2). Noise
// is the stated sigma times the scale found, with what the stated gain uncertainty of the simulation lets this series
// move.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/reporting/discrepancy_report.h"
#include "core/workflows/discrepancy_workflow.h"

namespace spindrift {

/// Where a point was measured with the table at one angle.
struct TablePlace {
  double c_deg = 0.0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< mean of the readings there
};

/// Observations of one component at one point, in order of time. Rows that are excluded or have no simulation are not
/// in it.
struct DiscrepancySeries {
  std::string point;
  Component component = Component::EX;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< mean
  std::vector<TablePlace> places;  ///< in order of the angles of the table; stories of earlier versions keep none
  std::vector<std::size_t> place;  ///< of each reading, an index of `places`; empty: all in the first
  std::vector<double> time_s;
  std::vector<double> value;            ///< as observed
  std::vector<double> simulated;        ///< as given
  std::vector<double> completed;        ///< empty while nothing has been added
  std::vector<double> completed_sigma;  ///< standard uncertainty of it, gain of the simulation included
  /// What all effects found, added or not, explain of value - simulated - constant_before; empty if there are none.
  std::vector<double> explained;
  /// What is neither an effect found nor noise, um or urad; NaN at rows held out; empty in stories that did not keep
  /// it.
  std::vector<double> remaining;
  std::vector<bool> held_out;
  double constant_before = 0.0;
  double constant_after = 0.0;
  double noise = 0.0;
  double rms_before = 0.0;
  double rms_after = 0.0;  ///< NaN while nothing has been added
  double excess_before = 0.0;
  double excess_after = 0.0;  ///< NaN while nothing has been added
  /// The series by itself, or a place it belongs to, deviates more than the noise allows (1 % for all series together).
  bool significant = false;

  /// Angle and position of reading `i`; of stories without places 0 and the mean.
  [[nodiscard]] TablePlace placeOf(std::size_t i) const;
  /// Of `remaining`; NaN if nothing of it is known.
  [[nodiscard]] double remainingRms() const;
  /// Where the size of `remaining` is largest; empty if nothing of it is known.
  [[nodiscard]] std::optional<std::size_t> largestRemaining() const;
};

struct DiscrepancyStory {
  DiscrepancyVerdict verdict = DiscrepancyVerdict::None;
  bool decided = true;
  std::string message;
  std::vector<std::string> added;          ///< ids, in the order in which the user added them
  std::vector<FoundEffect> effects;        ///< added ones (`forced`) first, then those that the search proposes
  std::vector<DisagreementPlace> where;    ///< of the simulation alone
  DiscrepancyGap gap;                      ///< with the effects added; `after` is NaN while there are none
  std::optional<DiscrepancyGap> proposed;  ///< with those proposed too; empty if nothing is proposed
  bool has_holdout = false;                ///< false: the held-out numbers are of blocks left out in turn
  std::optional<MeasurementSuggestion> suggestion;
  std::string leftover;
  std::vector<DiscrepancyStep> steps;
  std::vector<std::string> warnings;
  std::vector<EffectCandidate> candidates;  ///< the most probable first, named or not
  std::vector<NoiseEstimate> noise;
  std::vector<StateShift> shifts;
  std::vector<OutlyingObservation> outliers;
  std::vector<ComponentRemainder> remainder;
  double tail_dof = 0.0;  ///< Student degrees of freedom of the own noise; 0: normal
  double clock_offset_s = 0.0;
  double clock_offset_uncertainty_s = 0.0;  ///< 0: these data do not show it
  std::vector<DiscrepancySeries> series;
  nlohmann::json result;  ///< of the search, as FORMATS.md has it

  /// The first effect that is proposed and not added; null if there is none.
  [[nodiscard]] const FoundEffect* nextProposal() const;
  [[nodiscard]] const DiscrepancySeries* find(const std::string& point, Component component) const;
  /// Largest rms of a series, before and after, and not below its noise, of displacements or of rotations: the limit of
  /// a common colour scale.
  [[nodiscard]] double largestRms(bool rotations) const;

  /// For a report: "after" is with the effects added, or with those proposed while none is.
  [[nodiscard]] DiscrepancyReportData reportData() const;
  /// How far the fitted rows move, and those held out; NaN after while nothing has been added.
  [[nodiscard]] std::array<GapFigures, 2> movements() const;

  [[nodiscard]] nlohmann::json json() const;
  /// Reads what `json` wrote. Throws InputError if it is something else.
  [[nodiscard]] static DiscrepancyStory parse(const nlohmann::json& json);
};

/// Searches with `options.accept` in the model, and fits the model that holds these alone. Throws InputError as
/// findDiscrepancy, Cancelled.
[[nodiscard]] DiscrepancyStory tellDiscrepancy(const Campaign& campaign, ObservationSet observations,
                                               const DiscrepancyOptions& options, JobContext& job);

}  // namespace spindrift
