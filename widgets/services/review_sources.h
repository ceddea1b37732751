// SPDX-License-Identifier: GPL-3.0-or-later
// The campaigns of a session as a review sees them: observations with what the user took out, machine, scans.
#pragma once

#include <QString>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scanning/scan_evaluation.h"
#include "core/tasks/campaign_state.h"
#include "core/workflows/review_workflow.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

struct ReviewSource {
  std::int64_t id = 0;
  QString name;
  std::shared_ptr<const Campaign> campaign;
  ObservationsToFit observations;   ///< null without any
  std::vector<std::string> states;  ///< in order; the first is the reference
  std::vector<double> angles_deg;   ///< of the table, ascending
  std::vector<ScanCapture> scans;   ///< empty without a profiler
  /// The stored search for what the simulation lacks; null if there was none.
  std::shared_ptr<const nlohmann::json> discrepancy;
  NineParameterOptions fit;  ///< as chosen on the page Model of that campaign
  /// What has changed since what is shown was worked out; empty: it holds.
  std::vector<std::string> changed;

  /// Predictions are made once, by the job that first asks for them.
  [[nodiscard]] const ReviewPrediction& simulation() const;
  [[nodiscard]] const ReviewPrediction& completed() const;

 private:
  mutable std::once_flag simulated_, finished_;
  mutable ReviewPrediction simulation_, completed_;
};

/// The campaign at hand is there at once. Another one is read by a job that its owner starts: until `take` got what was
/// read, it has no source.
class ReviewSources {
 public:
  /// Reads a campaign in the background, and gives what was read to `take`, null where it could not be read.
  using ReadInBackground = std::function<void(std::int64_t id, const QString& name, CampaignSource source)>;
  ReviewSources(SessionModel& session, ReadInBackground read)
      : session_(session), read_in_background_(std::move(read)) {}
  /// Forgets what is shown of the campaigns; another one than that at hand is read anew where something of it changed.
  void refresh();
  [[nodiscard]] std::vector<std::pair<std::int64_t, QString>> campaigns() const;
  /// Null while the campaign is being read, and if it cannot be.
  [[nodiscard]] std::shared_ptr<const ReviewSource> source(std::int64_t id);
  [[nodiscard]] bool reading(std::int64_t id) const;
  void take(std::int64_t id, std::shared_ptr<const CampaignState> state);

 private:
  /// What the session holds of a campaign, as far as reading it depends on it.
  struct Version {
    std::string fingerprint;
    CampaignEdits edits;
    ExcludedItems excluded;
    std::vector<std::int64_t> results;  ///< the newest of every kind
    bool operator==(const Version&) const = default;
  };
  struct Other {
    Version version;
    bool reading = true;
    std::shared_ptr<const CampaignState> state;  ///< null: it is being read, or cannot be
  };
  [[nodiscard]] Version versionOf(std::int64_t id) const;
  /// As it would be if it were at hand; asks for it to be read where it is not there as it is now.
  [[nodiscard]] std::shared_ptr<const CampaignState> stateOf(std::int64_t id);

  SessionModel& session_;
  ReadInBackground read_in_background_;
  std::map<std::int64_t, Other> others_;
  std::int64_t session_number_ = -1;
  std::map<std::int64_t, std::shared_ptr<const ReviewSource>> read_;
};

}  // namespace spindrift::gui
