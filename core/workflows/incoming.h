// SPDX-License-Identifier: Apache-2.0
// Captures as they arrive in a watched folder: checked at once, copied into the campaign at once, answered with
// accepted, take again, waiting or twice, in one sentence each.
//
//   look (FolderWatch) -> task -> examineArrival (any thread: reads, checks, copies durably) -> finish (the owner of
//   the session: row into the list, journal)
// A file is copied before anything is said about it, under a name that follows from its content, so that a crash at any
// moment loses nothing and repeats nothing. What is not accepted lies in captures/kept, beside the campaign's data.
// An image that contradicts the others of its fiducial and state (capture_agreement.h) is to be taken again.
// Twice: by content, whatever the name. Which item of the plan a file is: by the item's id in its name, else the first
// open item of its kind. Its time is when it was written, since the campaign start.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/imaging/capture_agreement.h"
#include "core/machine/campaign.h"
#include "core/probing/live_touches.h"
#include "core/probing/touch_stream.h"
#include "core/workflows/folder_watch.h"
#include "core/workflows/measurement_plan.h"

namespace spindrift {

class Session;

enum class IncomingState { Waiting, Accepted, Retake, Twice, Ignored };
[[nodiscard]] std::string toString(IncomingState state);
enum class IncomingKind { Image, Cloud, Touches, Other };

struct IncomingItem {
  std::string name;  ///< of the file, relative to the watched folder
  IncomingKind kind = IncomingKind::Other;
  IncomingState state = IncomingState::Waiting;
  std::string sentence;
  std::string hash;               ///< SHA-256 of the content
  std::string stored;             ///< where its copy lies, relative to the campaign folder
  std::string plan_item;          ///< which item of the plan it is
  double time_s = 0.0;            ///< when it was written, since the campaign start
  std::optional<ImagePose> pose;  ///< of an image whose pattern was decoded
  double sharpness = 0.0;         ///< of an image, FocusMeasure::normalised

  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] static IncomingItem parse(const nlohmann::json& json);
};

/// An image of the campaign that an arriving one is compared with.
struct ListedImage {
  SeenCapture seen;
  std::string image;   ///< relative to the campaign folder
  bool known = false;  ///< false: pose and sharpness are still to be read from the file
};

/// What a check needs to know, copied so that it can run anywhere.
/// A file of which the campaign has a copy.
struct KnownFile {
  std::string name;    ///< under which it arrived
  std::string stored;  ///< where its copy lies, relative to the campaign folder
  std::string hash;    ///< SHA-256 of its content; empty: only its first 8 digits are known, from the name of the copy
};

struct IncomingContext {
  std::filesystem::path campaign_folder;
  double start_unix_s = 0.0;
  MeasurementPlan plan;
  std::set<std::string> done;                           ///< items of the plan that are there
  std::vector<ListedImage> images;                      ///< of the list of the campaign
  std::map<std::string, std::vector<KnownFile>> known;  ///< by the first 8 digits of the hash
  std::map<std::string, std::size_t> fullest;           ///< artefact -> points of its fullest scan so far
  bool printed = false;  ///< a template for printed text is set: .txt and .log hold touches
};
/// Of a campaign with its plan and the journal of what arrived before.
[[nodiscard]] IncomingContext incomingContext(const Campaign& campaign, const MeasurementPlan& plan,
                                              const std::vector<IncomingItem>& journal, bool printed);

/// What a check found.
struct ExaminedFile {
  IncomingItem item;
  bool unreadable = false;        ///< cut short, perhaps: worth another look a moment later
  std::string list, header, row;  ///< of an accepted image or cloud
  std::string text;               ///< of touches: the whole file as it is now
  std::string artefact;           ///< of a cloud
  std::size_t points = 0;
};
/// Checks one file and copies it into the campaign folder. A file that cannot be used is an answer, not an exception;
/// throws InputError only if the copy cannot be written (disk full, folder gone).
[[nodiscard]] ExaminedFile examineArrival(const std::filesystem::path& file, const std::string& name,
                                          std::int64_t written_ns, const IncomingContext& context);
/// The same for an image in memory (a camera), as a PNG.
[[nodiscard]] ExaminedFile examineImage(const std::string& bytes, const std::string& name, std::int64_t written_ns,
                                        const IncomingContext& context);

/// The live list of a watched folder and what is to be examined next.
class IncomingFolder {
 public:
  explicit IncomingFolder(const std::filesystem::path& folder, const FolderWatchOptions& watch = {},
                          double patience_s = 5.0);
  struct Task {
    WatchedFile file;
    std::string name;
    bool last_chance = false;  ///< what is still unreadable now is to be taken again
  };
  /// Looks at the folder; returns true if the list changed.
  bool look(double now_s);
  [[nodiscard]] std::optional<Task> next();
  /// The answer to a task. Returns the item as it now stands in the list.
  const IncomingItem& finish(const Task& task, ExaminedFile examined, double now_s);
  [[nodiscard]] const std::vector<IncomingItem>& items() const { return items_; }
  [[nodiscard]] const std::string& problem() const { return watch_.problem(); }
  [[nodiscard]] bool idle() const { return tasks_.empty() && again_.empty() && watch_.unsettled() == 0; }
  [[nodiscard]] const std::filesystem::path& folder() const { return watch_.folder(); }

 private:
  IncomingItem& itemOf(const std::string& name);

  FolderWatch watch_;
  double patience_s_;
  std::vector<IncomingItem> items_;
  std::deque<Task> tasks_;
  std::vector<std::pair<double, Task>> again_;  ///< when, what
};

/// Touches of all files that arrive, judged live.
class TouchFeed {
 public:
  /// `there`: touches the campaign holds already. `pattern`: template of printed text.
  TouchFeed(const MachineDescription& machine, const TouchList* there, std::optional<JsonNode> pattern = std::nullopt);
  /// The text of a file as it is now, `first_s` when it was first seen (s since the campaign start; times printed by a
  /// control count from there). Returns how many touches are new. Throws InputError: unusable header or template.
  std::size_t update(const std::string& name, std::string_view text, double first_s);
  [[nodiscard]] const LiveTouches& live() const { return live_; }
  [[nodiscard]] LiveTouches& live() { return live_; }
  /// Rows of touches.csv that are ready for the campaign.
  [[nodiscard]] std::vector<std::string> takeRows(bool all);
  /// Lines that could not be read, as sentences.
  [[nodiscard]] std::vector<std::string> problems() const;
  [[nodiscard]] bool waiting() const;  ///< a file ends in the middle of a line
  [[nodiscard]] static const char* header();

 private:
  struct Source {
    TouchStream stream;
    double first_s;
  };
  MachineDescription machine_;
  std::optional<JsonNode> pattern_;
  std::map<std::string, Source> sources_;
  LiveTouches live_;
};

/// The journal of a campaign and its plan, kept in the session. Empty where there is none.
[[nodiscard]] std::vector<IncomingItem> incomingJournal(const Session& session, std::int64_t campaign);
[[nodiscard]] MeasurementPlan storedPlan(const Session& session, std::int64_t campaign);
void storePlan(Session& session, std::int64_t campaign, const MeasurementPlan& plan);
/// Takes over an examined file: row of an accepted one into its list, item into the journal. Throws InputError.
void recordArrival(Session& session, std::int64_t campaign, const ExaminedFile& examined);

}  // namespace spindrift
