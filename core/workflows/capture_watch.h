// SPDX-License-Identifier: Apache-2.0
// Capturing without a window: what arrives in a folder is checked, copied into a campaign of a session and answered,
// file by file, as the desktop program does it (core/workflows/incoming.h). Times in s on any clock that never runs
// backwards.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/session/session.h"
#include "core/workflows/capture_intake.h"
#include "core/workflows/incoming.h"

namespace spindrift {

class CaptureWatch {
 public:
  /// `pattern`: template of the text that a control prints (spindrift-printed-text); may be empty. Throws InputError:
  /// no such folder, the folder of the session itself.
  CaptureWatch(Session& session, std::int64_t campaign, const std::filesystem::path& folder,
               std::optional<JsonNode> pattern = std::nullopt, const FolderWatchOptions& watch = {},
               double patience_s = 5.0);

  /// Looks once and examines everything that has settled. Returns what was decided: accepted, to be taken again, twice,
  /// ignored. Throws InputError if something cannot be stored; what was stored before stays.
  [[nodiscard]] std::vector<IncomingItem> turn(double now_s);
  /// Stores touches that still waited for the end of their line or feature.
  void finish();
  /// Nothing is being written or waits for a second look.
  [[nodiscard]] bool idle() const { return folder_.idle(); }
  [[nodiscard]] const std::string& problem() const { return folder_.problem(); }
  /// Sentences about captures to be taken again: those whose item of the plan is not there yet.
  [[nodiscard]] std::vector<std::string> retakes() const;
  [[nodiscard]] const MeasurementPlan& plan() const { return plan_; }
  [[nodiscard]] const std::set<std::string>& done() const { return context_->captures().done; }
  /// Lines of lists of touches that could not be read, as sentences.
  [[nodiscard]] std::vector<std::string> problems() const { return intake_.touchProblems(); }
  /// What was never complete.
  [[nodiscard]] std::vector<IncomingItem> undecided() const;
  [[nodiscard]] std::size_t touches() const { return intake_.touchCount(); }

 private:
  void storeTouches(bool all);

  Session& session_;
  std::int64_t campaign_;
  Campaign data_;  ///< as it was at the beginning: captures change nothing in it
  MeasurementPlan plan_;
  CaptureIntake intake_;
  std::shared_ptr<const IncomingContext> context_;
  IncomingFolder folder_;
};

}  // namespace spindrift
