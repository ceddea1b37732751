// SPDX-License-Identifier: Apache-2.0
// The story of a discrepancy for people: verdict, effects with evidence, candidates with their probabilities, what was
// taken as noise, what remains, time histories before and after, points, places and steps. Deviations um or urad, times
// h. One self-contained file, or the same parts inside a larger report.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/machine/field.h"
#include "core/reporting/report.h"

namespace spindrift {

/// One observation: measured minus simulation, and minus the completed model, each relative to the constant of its
/// series (from the rows that were fitted). NaN where there is none.
struct DiscrepancyReportRow {
  double time_s = 0.0;
  std::string point;
  Component component = Component::EX;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double sigma = 0.0;
  double before = 0.0;
  double after = 0.0;
  bool held_out = false;
  double measured = 0.0;                                        ///< as observed
  double remaining = std::numeric_limits<double>::quiet_NaN();  ///< neither effect nor noise
  double c_deg = 0.0;                                           ///< angle of the table
};

/// A reading far from all that the model allows, with what people find it by.
struct OutlyingObservation {
  std::size_t row = 0;  ///< of the observations, from 0
  double time_s = 0.0;
  std::string state;
  std::string point;
  Component component = Component::EX;
  double value = 0.0;      ///< as observed, um or urad
  double deviation = 0.0;  ///< in standard deviations of the own noise
};
[[nodiscard]] std::vector<OutlyingObservation> outlyingObservations(const ObservationSet& observations,
                                                                    const std::vector<OutlyingReading>& outliers);

/// What the answer makes of a candidate: a name, what may stand in its place, what holds it as a special case.
enum class CandidateRole { Named, Rival, Container, None };
[[nodiscard]] CandidateRole candidateRole(const std::string& id, const std::vector<FoundEffect>& effects);

/// The one number that is stated of a candidate: of what was named its confidence, of every other the probability that
/// it is among what is missing.
[[nodiscard]] double statedProbability(const EffectCandidate& candidate, const std::vector<FoundEffect>& effects);

/// 2 ln of the odds from which on a remainder is said to be there: "very strong" (Kass and Raftery 1995).
inline constexpr double clear_evidence = 10.0;

/// How far the rows that were fitted, or those held out, move before and after. NaN where there is none.
struct GapFigures {
  bool rotations = false;   ///< in urad: no displacement was measured; else displacements in um, rotations left aside
  double p2p_before = 0.0;  ///< largest peak-to-peak of one series (point and component)
  double p2p_after = 0.0;
  /// 100 (1 - |residual| / |measured - its mean|), each series about its own mean: 100 is perfect, 0 no better than a
  /// constant.
  double fit_before_percent = 0.0;
  double fit_after_percent = 0.0;
};
[[nodiscard]] GapFigures gapFigures(const std::vector<DiscrepancyReportRow>& rows, bool held_out);

/// A step of the search that added an effect which the result does not hold.
[[nodiscard]] bool takenOutAgain(const DiscrepancyStep& step, const std::vector<FoundEffect>& effects);

/// Nodes of a map along the longer side of the table.
inline constexpr int report_map_nodes = 40;

/// What the story tells, from a search that was just made or from one that a session keeps.
struct DiscrepancyReportData {
  DiscrepancyVerdict verdict = DiscrepancyVerdict::None;
  std::string message;
  std::vector<FoundEffect> effects;
  bool user_adds = false;  ///< effects enter the model when a user adds them: each is then marked added or proposed
  DiscrepancyGap gap;
  std::vector<DisagreementPlace> where;
  std::optional<MeasurementSuggestion> suggestion;
  std::string leftover;
  std::vector<DiscrepancyStep> steps;
  std::vector<std::string> warnings;
  std::vector<DiscrepancyReportRow> rows;
  std::vector<EffectCandidate> candidates;  ///< the most probable first
  std::vector<NoiseEstimate> noise;
  std::vector<StateShift> shifts;
  std::vector<OutlyingObservation> outliers;
  std::vector<ComponentRemainder> remainder;
  double tail_dof = 0.0;  ///< Student degrees of freedom of the own noise; 0: normal
  double clock_offset_s = 0.0;
  double clock_offset_uncertainty_s = 0.0;  ///< 0: these data do not show it
};
[[nodiscard]] DiscrepancyReportData discrepancyReportData(const DiscrepancyInput& input,
                                                          const DiscrepancyResult& result);

/// The sentence of the verdict, effects by their titles.
[[nodiscard]] ReportText discrepancyHeadline(const DiscrepancyReportData& data);

/// Adds the story below the present section of a document; with maps over `table` if there is one.
void addDiscrepancyStory(Report& document, const DiscrepancyReportData& data, const std::optional<FieldGrid>& table);

/// The story as a document of its own, to which more may be added.
[[nodiscard]] Report discrepancyDocument(const std::string& campaign, const DiscrepancyReportData& data,
                                         const std::optional<FieldGrid>& table);

}  // namespace spindrift
