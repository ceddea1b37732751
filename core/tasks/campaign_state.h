// SPDX-License-Identifier: Apache-2.0
// A campaign as its session sees it: the files, with the machine as edited, the clocks moved, what the user excluded,
// and the latest result of every kind. The window and the command line read it here.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"
#include "core/session/session.h"
#include "core/tasks/task_graph.h"
#include "core/workflows/clock_offsets.h"
#include "core/workflows/evaluate_campaign.h"

namespace spindrift {

/// The evaluation of a campaign's captures, as it was stored.
struct StoredEvaluation {
  std::int64_t id = 0;
  ObservationSet observations;
  nlohmann::json details = nlohmann::json::object();  ///< JSON of `evaluate` (FORMATS.md)
  std::vector<RejectedCapture> rejected;
  std::vector<std::string> warnings;
  std::string summary;
  bool good_enough = true;
  /// Each by itself, without its observations, where there are several; empty: one, or of an earlier version.
  std::vector<InstrumentEvaluation> instruments;
};

/// Payload of a result of kind "evaluate" and back. Throws InputError: the session is damaged or another's.
[[nodiscard]] nlohmann::json payloadOf(const CampaignEvaluation& evaluation);
[[nodiscard]] StoredEvaluation evaluationFrom(const StoredResult& result);
/// As it was worked out, the observations of all instruments together; nothing where an earlier version stored several
/// instruments, without saying which of them a detail, a warning or a rejected capture belongs to.
[[nodiscard]] std::optional<CampaignEvaluation> asWorkedOut(const StoredEvaluation& stored);

/// Items as in Exclusion, with their reasons.
using ExcludedItems = std::map<std::string, std::string>;

struct CampaignState {
  std::int64_t id = 0;  ///< 0: the session has no campaign
  std::shared_ptr<const Campaign> campaign;
  bool machine_edited = false;
  ExcludedItems excluded;
  std::map<std::string, std::optional<StoredResult>> latest;
  std::shared_ptr<const StoredEvaluation> evaluation;

  /// `wanted` 0: the one that was at hand last, else the newest. Throws InputError.
  [[nodiscard]] static CampaignState read(const Session& session, std::int64_t wanted = 0);
  /// Takes over what was stored as the latest of its kind. Throws InputError as evaluationFrom.
  void keep(const std::string& kind, std::optional<StoredResult> result);
  /// The last evaluation, read when it is another than last time; null if there is none. Throws InputError as
  /// evaluationFrom.
  void readEvaluation();
  /// Its tasks; this and the ledger have to live as long.
  [[nodiscard]] TaskGraph tasks(const Session& session, const TaskLedger& ledger) const;
};

/// Offsets between the clocks of logger and instruments, as a session keeps them for a campaign.
[[nodiscard]] ClockOffsets clockOffsetsOf(const Session& session, std::int64_t campaign);
/// What the user excluded of a campaign, as the session holds it now.
[[nodiscard]] ExcludedItems excludedItems(const Session& session, std::int64_t campaign);
/// The campaign without the captures that were excluded: to be worked on.
[[nodiscard]] std::shared_ptr<const Campaign> withoutExcluded(const Campaign& campaign, const ExcludedItems& excluded);
/// Marks what the user excluded; moves the times of observations whose clocks were not moved when they were read.
void applyChoices(ObservationSet& set, const ExcludedItems& excluded, const ClockOffsets& offsets);
/// The campaign's own observations, else those of its evaluation; what the user excluded is marked so. Nothing if there
/// are none.
[[nodiscard]] std::optional<ObservationSet> observationsAtHand(const Campaign& campaign,
                                                               const StoredEvaluation* evaluation,
                                                               const ExcludedItems& excluded,
                                                               const ClockOffsets& offsets);
/// Observations to fit: those at hand, what was taken while compensating marked as excluded.
[[nodiscard]] std::optional<ObservationSet> observationsToFit(const Campaign& campaign,
                                                              const StoredEvaluation* evaluation,
                                                              const ExcludedItems& excluded,
                                                              const ClockOffsets& offsets);

}  // namespace spindrift
