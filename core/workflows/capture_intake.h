// SPDX-License-Identifier: Apache-2.0
// What capturing keeps in mind from one file that arrives to the next: answers given so far, touches as they come in,
// the fullest scan of each artefact. The same for the window (which examines on a thread) and the command line (which
// examines in a loop); both store what they find in their own way.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/workflows/incoming.h"

namespace spindrift {

class CaptureIntake {
 public:
  CaptureIntake() = default;
  /// `journal`: what arrived before.
  explicit CaptureIntake(std::vector<IncomingItem> journal);

  /// True for the folder of a session and all that lies in it: the program would watch what it writes itself.
  [[nodiscard]] static bool liesInside(const std::filesystem::path& folder, const std::filesystem::path& session);

  /// Gets ready for touches: those the campaign holds already, and how a control prints them (may be missing). Throws
  /// InputError for a list or template that cannot be read; what was ready before stays.
  void expectTouches(const Campaign& campaign, std::optional<JsonNode> pattern);
  /// Null before expectTouches.
  [[nodiscard]] const TouchFeed* touches() const { return feed_.get(); }
  [[nodiscard]] std::size_t touchCount() const { return feed_ == nullptr ? 0 : feed_->live().touches().size(); }
  /// "74 touches so far; 4 are taken over when their feature is complete."
  [[nodiscard]] std::string touchSentence() const;
  /// Takes in a file of touches as it is now; its time is that of its first sight. Returns how many are new. Throws
  /// InputError for an unusable header.
  std::size_t takeTouches(const ExaminedFile& examined);
  /// Rows that are ready for touches.csv; `all`: also those that wait for the end of their feature.
  [[nodiscard]] std::vector<std::string> takeRows(bool all);

  /// For the check of the next file.
  [[nodiscard]] IncomingContext context(const Campaign& campaign, const MeasurementPlan& plan) const;

  [[nodiscard]] const std::vector<IncomingItem>& items() const { return items_; }
  /// Puts an item in the place of the one of that name, or at the end. What was said about a file holds when it is
  /// found again with the same content, after a restart for example. Returns what stands in the list now.
  const IncomingItem& show(const IncomingItem& item);
  /// An answer that was stored.
  void remember(const ExaminedFile& answer);

  /// What is to be taken again: an item of the plan or a file, and why. `what` is empty for touches, whose sentence
  /// says it.
  struct Retake {
    std::string what;
    std::string why;
  };
  /// Without what has been taken again since: `done` are the items of the plan that are there.
  [[nodiscard]] std::vector<Retake> retakes(const std::set<std::string>& done) const;

 private:
  std::vector<IncomingItem> items_;
  std::map<std::string, IncomingItem> answered_;  ///< by name, the last answer to each
  std::unique_ptr<TouchFeed> feed_;
  bool printed_ = false;
  std::map<std::string, double> first_seen_s_;
  std::map<std::string, std::size_t> fullest_;  ///< artefact -> points
};

}  // namespace spindrift
