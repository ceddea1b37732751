// SPDX-License-Identifier: Apache-2.0
// A campaign as its session sees it: the files, with the machine as edited, the clocks moved, what the user excluded,
// and the latest result of every kind. The window and the command line read it here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
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
  std::vector<EvaluationWarning> warnings;
  std::string summary;
  bool good_enough = true;
  /// Each by itself, without its observations, where there are several; empty: one, or of an earlier version.
  std::vector<InstrumentEvaluation> instruments;
};

/// Payload of a result of kind "evaluate" and back. Throws InputError: the session is damaged or another's.
[[nodiscard]] nlohmann::json payloadOf(const CampaignEvaluation& evaluation);
[[nodiscard]] StoredEvaluation evaluationFrom(const StoredResult& result);
/// Its warnings. Earlier versions did not store of what kind they are: they are findings then.
[[nodiscard]] std::vector<EvaluationWarning> warningsOfEvaluation(const nlohmann::json& payload);
/// As it was worked out, the observations of all instruments together; nothing where an earlier version stored several
/// instruments, without saying which of them a detail, a warning or a rejected capture belongs to.
[[nodiscard]] std::optional<CampaignEvaluation> asWorkedOut(const StoredEvaluation& stored);

/// Items as in Exclusion, with their reasons.
using ExcludedItems = std::map<std::string, std::string>;

/// What the user put in place of what the files of a campaign say, as its session keeps it.
struct CampaignEdits {
  nlohmann::json machine;  ///< in place of machine.json; empty: nothing
  ClockOffsets clocks;

  [[nodiscard]] static CampaignEdits of(const Session& session, std::int64_t campaign);
  bool operator==(const CampaignEdits&) const = default;
};

/// What a campaign is read from, taken where its session lives; any thread can read it then (CampaignState::read).
struct CampaignSource {
  std::int64_t id = 0;  ///< 0: the session has no campaign
  std::filesystem::path folder;
  CampaignEdits edits;
  ExcludedItems excluded;
  std::vector<UnreadResult> newest;  ///< of every kind that there is

  /// `wanted` 0: the one that was at hand last, else the newest. Throws InputError.
  [[nodiscard]] static CampaignSource of(const Session& session, std::int64_t wanted = 0);
};

/// The results of a campaign: heads of a kind are read when they are first asked for, and payloads of those that are
/// the latest.
class CampaignResults {
 public:
  /// What TaskGraph calls the latest. Holds until `keep`. Throws InputError: the session is damaged.
  [[nodiscard]] const StoredResult* latest(const TaskGraph& graph, const std::string& kind);
  /// A result that has just been stored.
  void keep(StoredResult result);
  /// One that was read before it is asked for.
  void takeRead(StoredResult result) { read_[result.id] = std::move(result); }

 private:
  /// Nobody knows what a result that cannot be read was made from: it is outdated, whatever it says.
  void giveUp(std::int64_t id);

  std::map<std::string, std::vector<StoredResult>> heads_;  ///< oldest first
  std::map<std::int64_t, StoredResult> read_;
};

struct CampaignState {
  std::int64_t id = 0;                    ///< 0: the session has no campaign
  std::shared_ptr<const Campaign> files;  ///< as they are on the disk
  std::shared_ptr<const Campaign> campaign;
  bool machine_edited = false;
  ExcludedItems excluded;

  /// Any thread. Throws InputError, Cancelled.
  [[nodiscard]] static CampaignState read(const CampaignSource& source, JobContext& job);
  /// Both at once: `wanted` as in CampaignSource::of. Throws InputError.
  [[nodiscard]] static CampaignState read(const Session& session, std::int64_t wanted = 0);
  /// Makes `campaign` of `files`, without reading them again. Throws InputError: no machine.
  void apply(const CampaignEdits& edits);
  /// Takes over what was stored.
  void keep(std::optional<StoredResult> result);
  /// The latest evaluation, read when it is another than last time; null if there is none. Throws InputError as
  /// evaluationFrom.
  [[nodiscard]] std::shared_ptr<const StoredEvaluation> evaluation(const TaskGraph& graph) const;
  /// As it was read last: without a session, where another thread prepares what is shown.
  [[nodiscard]] std::shared_ptr<const StoredEvaluation> readEvaluation() const { return evaluation_; }
  /// Its tasks; this and the ledger have to live as long.
  [[nodiscard]] TaskGraph tasks(const Session& session, const TaskLedger& ledger) const;

 private:
  mutable CampaignResults results_;
  mutable std::shared_ptr<const StoredEvaluation> evaluation_;  ///< as it was read last
};

/// Offsets between the clocks of logger and instruments, as a session keeps them for a campaign.
[[nodiscard]] ClockOffsets clockOffsetsOf(const Session& session, std::int64_t campaign);
/// What the user excluded of a campaign, as the session holds it now.
[[nodiscard]] ExcludedItems excludedItems(const Session& session, std::int64_t campaign);
/// The campaign without the captures that were excluded: to be worked on. Its readings are shared, not copied.
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

/// observationsToFit of a campaign as it is at hand. To take and to copy them costs the same however many there are:
/// what is marked is marked when they are first looked at, by the thread that does, and once for all copies; those of
/// the campaign itself are shared where nothing of them is marked. Any thread.
class ObservationsToFit {
 public:
  /// None.
  ObservationsToFit() = default;
  ObservationsToFit(std::shared_ptr<const Campaign> campaign, std::shared_ptr<const StoredEvaluation> evaluation,
                    ExcludedItems excluded, ClockOffsets offsets);

  [[nodiscard]] bool has_value() const noexcept { return made_ != nullptr; }
  explicit operator bool() const noexcept { return has_value(); }
  [[nodiscard]] const ObservationSet& operator*() const { return *shared(); }
  [[nodiscard]] const ObservationSet* operator->() const { return shared().get(); }
  /// Null if there are none.
  [[nodiscard]] const ObservationSet* get() const { return has_value() ? shared().get() : nullptr; }
  /// There must be some.
  [[nodiscard]] const std::shared_ptr<const ObservationSet>& shared() const;
  /// Made of the same, at once.
  [[nodiscard]] bool operator==(const ObservationsToFit& other) const noexcept { return made_ == other.made_; }
  [[nodiscard]] bool operator==(std::nullptr_t) const noexcept { return !has_value(); }

 private:
  struct Made;
  std::shared_ptr<const Made> made_;
};

}  // namespace spindrift
