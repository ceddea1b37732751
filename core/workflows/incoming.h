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

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <shared_mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/sha256.h"
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

/// A file of which the campaign has a copy.
struct ArrivedFile {
  std::string name;    ///< under which it arrived
  std::string stored;  ///< where its copy lies, relative to the campaign folder
  std::string hash;    ///< SHA-256 of its content; empty: only its first 8 digits are known, from the name of the copy
};

/// How far a file that grows was read. It is the same file, and only what it grew by is read, while it is the one of
/// this number on its disk and the bytes before `size` are those of `end`.
struct ReadPosition {
  std::pair<std::uint64_t, std::uint64_t> file;  ///< FileReader::identity
  std::uint64_t size = 0;
  std::string end;  ///< at most the last 4 kB
  Sha256 digest;    ///< of all that was read
};

struct ExaminedFile;

/// What the checks need to know of a campaign, made once from its lists and kept up to date by each answer: what an
/// arrival costs does not depend on how many came before. One thread makes it, calls `record` and reads `captures`; the
/// checks may run on any threads meanwhile.
class IncomingContext {
 public:
  /// `journal`: what arrived before. `printed`: a template for printed text is set: .txt and .log hold touches.
  IncomingContext(const Campaign& campaign, MeasurementPlan plan, const std::vector<IncomingItem>& journal,
                  bool printed);

  [[nodiscard]] const std::filesystem::path& campaignFolder() const { return campaign_folder_; }
  [[nodiscard]] double startUnix_s() const { return start_unix_s_; }
  [[nodiscard]] bool printed() const { return printed_; }
  [[nodiscard]] const PlanIndex& plan() const { return plan_; }
  /// Captures that were taken out when it was made: of them nothing is compared.
  [[nodiscard]] const std::set<std::string>& excluded() const { return excluded_; }

  [[nodiscard]] bool isDone(const std::string& plan_item) const;
  [[nodiscard]] const PlannedItem* firstOpen(PlannedKind kind) const;
  /// Copies whose content may be that of this SHA-256.
  [[nodiscard]] std::vector<ArrivedFile> alike(const std::string& hash) const;
  /// Images of a thermal state.
  [[nodiscard]] std::vector<ListedImage> imagesOf(const std::string& state) const;
  /// Points of the fullest scan of an artefact so far; 0: none.
  [[nodiscard]] std::size_t fullest(const std::string& artefact) const;

  /// How far a file of touches was taken in; null: not at all.
  [[nodiscard]] std::shared_ptr<const ReadPosition> positionOf(const std::string& name) const;

  /// An answer that was stored.
  void record(const ExaminedFile& answer);
  /// The touches of a file were taken in as far as it was read.
  void recordPosition(const ExaminedFile& examined);
  /// Touches that were stored.
  void record(const std::vector<Touch>& touches);
  /// Files of touches are read from their beginning again.
  void forgetPositions();
  /// Takes over what is in no list: scans seen, files read.
  void goOnFrom(const IncomingContext& before);
  [[nodiscard]] const PlanCaptures& captures() const { return tally_.captures(); }

 private:
  void addListed(const Campaign& campaign, const std::vector<IncomingItem>& journal);

  std::filesystem::path campaign_folder_;
  double start_unix_s_ = 0.0;
  bool printed_ = false;
  std::set<std::string> excluded_;
  PlanIndex plan_;
  mutable std::shared_mutex mutex_;  ///< of all that follows
  PlanTally tally_;
  std::unordered_map<std::string, std::vector<ListedImage>> images_;  ///< by thermal state
  std::unordered_map<std::string, std::vector<ArrivedFile>> files_;   ///< by the first 8 digits of the hash
  std::map<std::string, std::size_t> fullest_;                        ///< by artefact
  std::map<std::string, std::shared_ptr<const ReadPosition>> positions_;
};

/// What a check found.
struct ExaminedFile {
  IncomingItem item;
  bool unreadable = false;        ///< cut short, perhaps: worth another look a moment later
  std::string list, header, row;  ///< of an accepted image or cloud
  std::string text;               ///< of touches: the file from byte `from` on
  std::uint64_t from = 0;
  std::shared_ptr<const ReadPosition> position;  ///< of touches: behind `text`
  std::string artefact;                          ///< of a cloud
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
  /// The answer to a task. Returns the item as it now stands in the list. An item that still waits could not be stored:
  /// it is examined again after the patience.
  const IncomingItem& finish(const Task& task, ExaminedFile examined, double now_s);
  [[nodiscard]] const std::vector<IncomingItem>& items() const { return items_; }
  /// Indices of the items that are not decided yet.
  [[nodiscard]] const std::set<std::size_t>& waiting() const { return waiting_; }
  [[nodiscard]] const std::string& problem() const { return watch_.problem(); }
  [[nodiscard]] bool idle() const { return tasks_.empty() && again_.empty() && watch_.unsettled() == 0; }
  [[nodiscard]] const std::filesystem::path& folder() const { return watch_.folder(); }

 private:
  void set(const std::string& name, IncomingState state, std::string sentence);
  [[nodiscard]] std::size_t indexOf(const std::string& name);
  void plan(Task task);
  void drop(const std::string& name);

  FolderWatch watch_;
  double patience_s_;
  std::vector<IncomingItem> items_;
  std::unordered_map<std::string, std::size_t> index_;  ///< of items_, by name
  std::set<std::size_t> waiting_;
  std::map<std::uint64_t, Task> tasks_;  ///< in the order in which they are to be done
  std::unordered_map<std::string, std::uint64_t> task_of_;
  std::uint64_t next_task_ = 0;
  std::map<std::string, std::pair<double, Task>> again_;  ///< by name: when, what
};

/// Touches of all files that arrive, judged live.
class TouchFeed {
 public:
  /// `there`: touches the campaign holds already. `pattern`: template of printed text.
  TouchFeed(const MachineDescription& machine, const TouchList* there, std::optional<JsonNode> pattern = std::nullopt);
  /// What a file grew by, or the whole of it (`anew`); `first_s` when it was first seen (s since the campaign start;
  /// times printed by a control count from there). Returns how many touches are new. Throws InputError: unusable header
  /// or template.
  std::size_t update(const std::string& name, std::string_view text, bool anew, double first_s);
  /// Last lines without their end: nothing more comes. Returns how many touches are new.
  std::size_t finish();
  [[nodiscard]] const LiveTouches& live() const { return live_; }
  [[nodiscard]] LiveTouches& live() { return live_; }
  /// Touches that are ready for the campaign.
  [[nodiscard]] std::vector<Touch> takeFinished(bool all) { return live_.takeFinished(all); }
  /// Their rows in touches.csv.
  [[nodiscard]] static std::vector<std::string> rowsOf(const std::vector<Touch>& touches);
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
