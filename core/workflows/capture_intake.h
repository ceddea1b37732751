// SPDX-License-Identifier: Apache-2.0
// What capturing keeps in mind from one file that arrives to the next: answers given so far, touches as they come in,
// the fullest scan of each artefact. The same for the window (which examines on a thread) and the command line (which
// examines in a loop); both store what they find in their own way.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
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
  /// Takes in what a file of touches grew by; its time is that of its first sight. Returns how many are new. What does
  /// not go on where the last part ended is left alone (the file is read again). Throws InputError for an unusable
  /// template.
  std::size_t takeTouches(const ExaminedFile& examined);
  /// Nothing more comes: last lines of lists count without their end.
  void finishTouches();
  /// Lines of lists that could not be read, as sentences.
  [[nodiscard]] std::vector<std::string> touchProblems() const;
  /// Touches that are ready for touches.csv; `all`: also those that wait for the end of their feature.
  [[nodiscard]] std::vector<Touch> takeFinished(bool all);

  /// For the checks of the next files. Made once from the lists of the campaign (which takes as long as they are), then
  /// kept up to date by `remember`; made again when captures have been taken out or brought back.
  [[nodiscard]] std::shared_ptr<const IncomingContext> context(const Campaign& campaign, const MeasurementPlan& plan);
  /// The plan is another one, or the lists were changed by others: the context is made again when it is asked for.
  void forgetContext() { stale_ = true; }

  [[nodiscard]] const std::vector<IncomingItem>& items() const { return items_; }
  [[nodiscard]] bool knows(const std::string& name) const { return known_.contains(name); }
  /// Puts an item in the place of the one of that name, or at the end. What was said about a file holds when it is
  /// found again with the same content, after a restart for example. Returns what stands in the list now.
  const IncomingItem& show(const IncomingItem& item);
  /// An answer that was stored.
  void remember(const ExaminedFile& answer);
  /// Touches that were stored.
  void remember(const std::vector<Touch>& touches);

  /// What is to be taken again: an item of the plan or a file, and why. `what` is empty for touches, whose sentence
  /// says it.
  struct Retake {
    std::string what;
    std::string why;
  };
  /// Without what has been taken again since: `done` are the items of the plan that are there.
  [[nodiscard]] std::vector<Retake> retakes(const std::set<std::string>& done) const;

 private:
  struct KnownItem {
    std::size_t index = 0;                 ///< in items_
    std::optional<IncomingItem> answered;  ///< the last answer
  };

  std::vector<IncomingItem> items_;
  std::unordered_map<std::string, KnownItem> known_;  ///< by name
  std::set<std::size_t> retakes_;                     ///< of items_, those to be taken again
  std::unique_ptr<TouchFeed> feed_;
  bool printed_ = false;
  std::map<std::string, double> first_seen_s_;
  std::map<std::string, std::uint64_t> taken_;  ///< file of touches -> bytes taken in
  std::shared_ptr<IncomingContext> context_;
  bool stale_ = false;  ///< context_ has to be made again
};

}  // namespace spindrift
