// SPDX-License-Identifier: Apache-2.0
// A session: everything a user keeps about one or more campaigns, in one folder that can be copied to another computer.
//
//   spindrift-session.json   {"format":"spindrift-session","version":1}, the only file every version can read
//   session.sqlite           results with provenance, exclusions with reasons, notes, settings (one transaction a
//   change) campaigns/<name>/        imported campaigns: plain files, copied once, never altered by an evaluation lock
//   held by the one process that works on the session
//
// Every change is on the disk when the call returns: a crash loses at most the call in progress.
#pragma once

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
#include "core/session/fingerprint.h"

namespace spindrift {

/// Where a result comes from. A result is current while `inputs` and `options` are what they would be now.
struct Provenance {
  std::string program_version;
  std::string created_utc;
  std::string inputs_fingerprint;
  nlohmann::json options = nlohmann::json::object();  ///< everything that influenced the result, seed included
  /// What it was made from, by name: Session::inputs, and other results by their kind. Empty for results of versions
  /// that did not write it down.
  nlohmann::json inputs = nlohmann::json::object();
};

/// What a result is made from, taken when the work on it starts. Files, exclusions or options that change while it is
/// worked out make the result outdated; they never make it look as if it had been made from them.
struct ResultOrigin {
  std::int64_t campaign = 0;
  std::string kind;
  nlohmann::json options = nlohmann::json::object();
  nlohmann::json inputs = nlohmann::json::object();

  /// Made from the same, with the same options.
  [[nodiscard]] bool sameAs(const ResultOrigin& other) const {
    return campaign == other.campaign && kind == other.kind && inputs == other.inputs && options == other.options;
  }
};

struct StoredResult {
  std::int64_t id = 0;
  std::int64_t campaign = 0;
  std::string kind;  ///< "evaluate", "fit", "discrepancy", ...
  Provenance provenance;
  nlohmann::json payload;
};

/// A result whose payload is still text: to read that of a large one takes a while, and any thread can do it.
struct UnreadResult {
  StoredResult head;  ///< without its payload
  std::string payload;
  std::filesystem::path database;  ///< for the sentence of an error
  /// Throws InputError: the text is no JSON.
  [[nodiscard]] StoredResult read() const;
};

struct CampaignRecord {
  std::int64_t id = 0;
  std::string name;
  std::filesystem::path folder;  ///< absolute; inside the session unless the campaign is only referred to
  std::string fingerprint;       ///< of the content of its files, as far as results are made from them
  std::string imported_utc;
};

/// Something the user took out, and why: a capture ("captures/images/a.jpg") or an observation ("M1/F3/EX").
struct Exclusion {
  std::string item;
  std::string reason;
  std::string created_utc;
};

struct Note {
  std::int64_t id = 0;
  std::string step;
  std::string text;
  std::string created_utc;
  std::string item;  ///< what it is about within the step, such as a capture; empty: the step
};

/// Files of a campaign that are not what they were, by their names in the campaign folder.
struct FileCheck {
  std::vector<std::string> changed, missing, added;
  [[nodiscard]] bool same() const { return changed.empty() && missing.empty() && added.empty(); }
  /// "log.csv has another content; captures/a.jpg and 2 more are missing"
  [[nodiscard]] std::string sentence() const;
};

/// A campaign that has been checked and copied into a session's folder, and is not part of it yet. Takes its copy away
/// again if it never becomes one.
class StagedCampaign {
 public:
  /// Any thread. Throws InputError, Cancelled; leaves no trace then.
  StagedCampaign(const std::filesystem::path& session_folder, const std::filesystem::path& source, JobContext& job);
  StagedCampaign(const StagedCampaign&) = delete;
  StagedCampaign& operator=(const StagedCampaign&) = delete;
  ~StagedCampaign();

 private:
  friend class Session;
  std::filesystem::path source_;
  std::filesystem::path copy_;
  std::string name_;
  FileFingerprints files_;
};

class CaptureList;
class SessionDatabase;
class SessionLock;

/// Not thread-safe: one thread (in the desktop program the GUI thread) owns it; jobs get copies of what they need.
class Session {
 public:
  /// Makes a new session in a folder that does not exist or is empty. Throws InputError.
  [[nodiscard]] static Session create(const std::filesystem::path& folder);
  /// Opens a session; one of an older version is migrated first (a copy of the old database stays beside it). Throws
  /// InputError: no session there, a newer version, in use by another process, damaged.
  [[nodiscard]] static Session open(const std::filesystem::path& folder);
  /// True if the folder holds a session of any version.
  [[nodiscard]] static bool isSession(const std::filesystem::path& folder);
  /// True if the program that worked on the session last ended without closing it (crash, power cut) and nobody works
  /// on it now. Changes nothing.
  [[nodiscard]] static bool wasLeftOpen(const std::filesystem::path& folder);

  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  /// Sentences about what a migration did; empty if there was none.
  [[nodiscard]] const std::vector<std::string>& migrationMessages() const noexcept { return migration_messages_; }

  /// Sentences about what opening found after a crash and put in order; empty after an orderly end.
  [[nodiscard]] const std::vector<std::string>& recoveryMessages() const noexcept { return recovery_messages_; }

  // Campaigns -----------------------------------------------------------------------------------------------------
  /// Checks a campaign folder by reading it and copies it into the session. Cancelling leaves no trace. A campaign with
  /// the same content is not imported twice: its existing id is returned.
  std::int64_t importCampaign(const std::filesystem::path& source, JobContext& job);
  /// Makes a staged campaign one of this session, quickly: the second half of an import.
  std::int64_t adoptCampaign(StagedCampaign& staged);
  /// A new, empty campaign inside the session for capturing into; `machine_json` is the text of machine.json.
  std::int64_t newCampaign(const std::string& name, const std::string& start_utc, const std::string& machine_json);
  [[nodiscard]] std::vector<CampaignRecord> campaigns() const;
  /// Throws InternalError for an unknown id.
  [[nodiscard]] CampaignRecord campaign(std::int64_t id) const;
  /// Takes a campaign and its results out of the session. Its files are moved to `removed/` inside the session.
  void removeCampaign(std::int64_t id);
  /// Adds rows to `captures/<list>` for files that lie in the campaign folder already, or for lists without files
  /// (touches). Rows go where their time belongs, so that captures may arrive out of order; rows that are there
  /// already are not added again. All of them are there afterwards, or none. What that costs does not depend on how
  /// many rows there are (capture_list.h). Throws InputError: disk full, folder gone, the list has other columns.
  void addCaptureRows(std::int64_t campaign, const std::string& list, const std::string& header,
                      const std::vector<std::string>& rows);
  /// log.csv of the campaign grows, or has grown: what was made from it is outdated. Where to write it is returned.
  std::filesystem::path recordsLog(std::int64_t campaign);

  /// What arrived in a watched folder, an object for each name of a file, in the order in which the names came first.
  void setArrival(std::int64_t campaign, const std::string& name, const nlohmann::json& item);
  [[nodiscard]] std::optional<nlohmann::json> arrival(std::int64_t campaign, const std::string& name) const;
  [[nodiscard]] std::vector<nlohmann::json> arrivals(std::int64_t campaign) const;

  /// Holds what was found on the disk (`fingerprintsOfFiles` of the campaign folder, on any thread) against what the
  /// session knows. What is other becomes known: results made from it turn outdated.
  FileCheck takeFiles(std::int64_t campaign, const FileFingerprints& found);

  // Results -------------------------------------------------------------------------------------------------------
  /// What results of this campaign are made from now, by name: "files", "exclusions", "machine" and "clocks" (as the
  /// user edited them).
  [[nodiscard]] nlohmann::json inputs(std::int64_t campaign) const;
  /// To be called when the work starts, on the inputs that it is given. `made_from` adds to `inputs` what else it is
  /// made from: results by their kind.
  [[nodiscard]] ResultOrigin originOf(std::int64_t campaign, const std::string& kind, const nlohmann::json& options,
                                      const nlohmann::json& made_from = nlohmann::json::object()) const;
  /// Files a result under the campaign that it was started for; nothing if that is no longer in the session. Returns
  /// what was stored, without reading it again.
  std::optional<StoredResult> keepResult(const ResultOrigin& origin, nlohmann::json payload);
  [[nodiscard]] std::optional<StoredResult> latestResult(std::int64_t campaign, const std::string& kind) const;
  [[nodiscard]] std::optional<UnreadResult> latestUnread(std::int64_t campaign, const std::string& kind) const;
  [[nodiscard]] std::vector<StoredResult> results(std::int64_t campaign) const;
  /// All results of a kind without their payloads (those may be large), oldest first; `payload` fetches one.
  [[nodiscard]] std::vector<StoredResult> resultHeads(std::int64_t campaign, const std::string& kind) const;
  [[nodiscard]] nlohmann::json payload(std::int64_t result) const;
  /// The kinds of which there is at least one result.
  [[nodiscard]] std::vector<std::string> resultKinds(std::int64_t campaign) const;
  void removeResult(std::int64_t result);
  /// False: something of `inputs` has changed since. Options and other results are known to the tasks
  /// (core/tasks/task_graph.h) alone.
  [[nodiscard]] bool isCurrent(const StoredResult& result) const;

  // Exclusions, notes, settings -------------------------------------------------------------------------------------
  void exclude(std::int64_t campaign, const std::string& item, const std::string& reason);
  void restore(std::int64_t campaign, const std::string& item);
  /// Takes items out, those without a reason back in: all of them, or none where that cannot be stored or the program
  /// ends meanwhile. Their times are those of the call.
  void exclude(std::int64_t campaign, const std::vector<Exclusion>& items);
  [[nodiscard]] std::vector<Exclusion> exclusions(std::int64_t campaign) const;
  std::int64_t addNote(std::int64_t campaign, const std::string& step, const std::string& text,
                       const std::string& item = {});
  /// A note with the id and the time it had, so that one that was removed can come back; id 0: a new one, of which the
  /// id is returned.
  std::int64_t addNote(std::int64_t campaign, const Note& note);
  void removeNote(std::int64_t note);
  [[nodiscard]] std::vector<Note> notes(std::int64_t campaign) const;
  void setSetting(const std::string& key, const nlohmann::json& value);
  [[nodiscard]] std::optional<nlohmann::json> setting(const std::string& key) const;
  /// Keys of what the user put in place of a file's: the edited machine, and offsets between clocks.
  [[nodiscard]] static std::string machineKey(std::int64_t campaign);
  [[nodiscard]] static std::string clocksKey(std::int64_t campaign);

 private:
  Session(std::filesystem::path folder, std::unique_ptr<SessionLock> lock, std::unique_ptr<SessionDatabase> database);
  /// Without its fingerprint, which may take a while to make.
  [[nodiscard]] CampaignRecord place(std::int64_t id) const;
  [[nodiscard]] CaptureList& listOf(const CampaignRecord& record, const std::string& list);

  std::filesystem::path folder_;
  std::unique_ptr<SessionLock> lock_;
  std::unique_ptr<SessionDatabase> database_;
  std::map<std::filesystem::path, std::unique_ptr<CaptureList>> lists_;
  std::vector<std::string> migration_messages_;
  std::vector<std::string> recovery_messages_;
};

/// Now, as "2026-01-31T08:00:00Z".
[[nodiscard]] std::string utcNow();

}  // namespace spindrift
