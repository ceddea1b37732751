// SPDX-License-Identifier: GPL-3.0-or-later
// The campaigns of a session as a review sees them: observations with what the user took out, machine, scans.
#pragma once

#include <Eigen/Geometry>
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
#include "widgets/services/from_observations.h"

namespace spindrift::gui {

/// What can be chosen to be seen of observations.
struct ReviewChoices {
  std::vector<std::string> states;  ///< in order; the first is the reference
  std::vector<double> angles_deg;   ///< of the table, ascending
  Eigen::AlignedBox2d extent_mm;    ///< of the points, X and Y

  [[nodiscard]] static ReviewChoices of(const ObservationSet& observations);
};

struct ReviewSource {
  std::int64_t id = 0;
  QString name;
  std::shared_ptr<const Campaign> campaign;
  ObservationsToFit observations;  ///< null without any
  ReviewChoices choices;           ///< of them
  std::vector<ScanCapture> scans;  ///< empty without a profiler
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

/// A campaign that is not at hand, as a review needs it.
struct ReadForReview {
  CampaignState state;
  ObservationsToFit observations;
  ReviewChoices choices;

  /// Any thread. Throws InputError, Cancelled.
  [[nodiscard]] static ReadForReview read(const CampaignSource& source, JobContext& job);
};

/// The observations of the campaign at hand are looked through on a thread of their own, and another campaign is read
/// by a job that its owner starts: until that is done, and `take` got what was read, they have no source.
class ReviewSources {
 public:
  /// Reads a campaign in the background, and gives what was read to `take`, null where it could not be read.
  using ReadInBackground = std::function<void(std::int64_t id, const QString& name, CampaignSource source)>;
  /// `looked_through`: the campaign at hand has a source now.
  ReviewSources(SessionModel& session, ReadInBackground read, std::function<void()> looked_through)
      : session_(session), read_in_background_(std::move(read)), choices_(std::move(looked_through)) {}
  /// Forgets what is shown of the campaigns; another one than that at hand is read anew where something of it changed.
  void refresh();
  [[nodiscard]] std::vector<std::pair<std::int64_t, QString>> campaigns() const;
  /// Null while the campaign is being read, and if it cannot be.
  [[nodiscard]] std::shared_ptr<const ReviewSource> source(std::int64_t id);
  [[nodiscard]] bool reading(std::int64_t id) const;
  void take(std::int64_t id, std::shared_ptr<const ReadForReview> read);

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
    std::shared_ptr<const ReadForReview> read;  ///< null: it is being read, or cannot be
  };
  [[nodiscard]] Version versionOf(std::int64_t id) const;
  /// As it would be if it were at hand; asks for it to be read where it is not there as it is now.
  [[nodiscard]] std::shared_ptr<const ReadForReview> readOf(std::int64_t id);

  SessionModel& session_;
  ReadInBackground read_in_background_;
  FromObservations<ReviewChoices> choices_;  ///< of the campaign at hand
  std::map<std::int64_t, Other> others_;
  std::int64_t session_number_ = -1;
  std::map<std::int64_t, std::shared_ptr<const ReviewSource>> read_;
};

}  // namespace spindrift::gui
