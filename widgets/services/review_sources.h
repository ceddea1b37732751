// SPDX-License-Identifier: GPL-3.0-or-later
// The campaigns of a session as a review sees them: observations with what the user took out, machine, scans.
#pragma once

#include <QString>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/scanning/scan_evaluation.h"
#include "core/workflows/review_workflow.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

struct ReviewSource {
  std::int64_t id = 0;
  QString name;
  std::shared_ptr<const Campaign> campaign;
  std::shared_ptr<const ObservationSet> observations;  ///< null without any
  std::vector<std::string> states;                     ///< in order; the first is the reference
  std::vector<double> angles_deg;                      ///< of the table, ascending
  std::vector<ScanCapture> scans;                      ///< empty without a profiler
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

class ReviewSources {
 public:
  explicit ReviewSources(SessionModel& session) : session_(session) {}
  /// Forgets what was read; campaigns are read anew when they are asked for.
  void refresh();
  [[nodiscard]] std::vector<std::pair<std::int64_t, QString>> campaigns() const;
  /// Null if the campaign cannot be read.
  [[nodiscard]] std::shared_ptr<const ReviewSource> source(std::int64_t id);

 private:
  SessionModel& session_;
  std::map<std::int64_t, std::shared_ptr<const ReviewSource>> read_;
};

}  // namespace spindrift::gui
