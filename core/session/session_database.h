// SPDX-License-Identifier: Apache-2.0
// The tables of a session behind plain C++ types. SOCI stays in the .cpp; every SOCI failure becomes an InputError that
// names the session's database file.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/session/campaign_files.h"
#include "core/session/capture_list.h"
#include "core/session/session.h"

namespace spindrift {

class SessionDatabase {
 public:
  /// Newest schema this program writes.
  static constexpr int newest_version = 4;

  /// Opens or makes the database file and brings it to `newest_version`; `messages` receives what a migration did. The
  /// old database is copied to `<file>.version-<n>` first; a migration that fails leaves it as it was.
  SessionDatabase(const std::filesystem::path& file, std::vector<std::string>& messages);
  ~SessionDatabase();
  SessionDatabase(const SessionDatabase&) = delete;
  SessionDatabase& operator=(const SessionDatabase&) = delete;

  /// Throws InputError if the file is not at its place any more (folder removed, network folder gone): SQLite would go
  /// on writing into a file that nobody will find again.
  void requireInPlace() const;

  /// `folder` is stored relative to the session.
  std::int64_t addCampaign(const std::string& name, const std::string& folder, const std::string& fingerprint);
  /// Stores these files of a campaign (others stay), or nothing. What was to be written into them (`setPending`) is
  /// written.
  void setFiles(std::int64_t id, const KnownFiles& files);
  [[nodiscard]] KnownFiles files(std::int64_t id) const;
  [[nodiscard]] std::optional<KnownFile> file(std::int64_t id, const std::string& name) const;
  /// Of all files that count together. Made when it is asked for after they changed, which takes as long as there are
  /// files.
  [[nodiscard]] std::string fingerprint(std::int64_t id) const;
  /// Keeps it, so that the next program need not make it.
  void keepFingerprint(std::int64_t id);

  /// The end of a list that is about to be written: done again if the program dies meanwhile.
  struct PendingList {
    std::string list;  ///< relative to the campaign folder
    ListChange change;
  };
  void setPending(std::int64_t id, const PendingList& pending);
  void dropPending(std::int64_t id, const std::string& list);
  [[nodiscard]] std::vector<PendingList> pending(std::int64_t id) const;

  /// What arrived, one JSON object a name, in the order of first arrival.
  void setArrival(std::int64_t id, const std::string& name, const std::string& json);
  [[nodiscard]] std::optional<nlohmann::json> arrival(std::int64_t id, const std::string& name) const;
  [[nodiscard]] std::vector<nlohmann::json> arrivals(std::int64_t id) const;

  /// Their fingerprints are empty while they have to be made again.
  [[nodiscard]] std::vector<CampaignRecord> campaigns() const;
  void removeCampaign(std::int64_t id);

  std::int64_t addResult(const StoredResult& result);
  [[nodiscard]] std::vector<StoredResult> results(std::int64_t campaign, const std::string& kind) const;
  [[nodiscard]] std::optional<StoredResult> latestResult(std::int64_t campaign, const std::string& kind) const;
  [[nodiscard]] std::optional<UnreadResult> latestUnread(std::int64_t campaign, const std::string& kind) const;
  /// All of a kind without their payloads, oldest first.
  [[nodiscard]] std::vector<StoredResult> resultHeads(std::int64_t campaign, const std::string& kind) const;
  [[nodiscard]] nlohmann::json payload(std::int64_t result) const;
  [[nodiscard]] std::vector<std::string> resultKinds(std::int64_t campaign) const;
  [[nodiscard]] std::size_t countResults(std::int64_t campaign) const;
  void removeResult(std::int64_t id);

  /// All of them or none; those without a reason are in again.
  void exclude(std::int64_t campaign, const std::vector<Exclusion>& items, const std::string& now_utc);
  [[nodiscard]] std::vector<Exclusion> exclusions(std::int64_t campaign) const;

  /// With its id, or with a new one in place of 0. No id is given twice, so that a note which was removed can come
  /// back.
  std::int64_t addNote(std::int64_t campaign, const Note& note);
  void removeNote(std::int64_t id);
  [[nodiscard]] std::vector<Note> notes(std::int64_t campaign) const;

  void setSetting(const std::string& key, const std::string& json);
  [[nodiscard]] std::optional<nlohmann::json> setting(const std::string& key) const;

 private:
  struct Connection;
  /// For everything that changes the database.
  template <typename Body>
  auto writing(Body body) const -> decltype(body());

  [[nodiscard]] std::vector<UnreadResult> selectResults(std::int64_t campaign, const std::string& kind,
                                                        const char* order, bool with_payload = true) const;

  std::filesystem::path file_;
  mutable std::map<std::int64_t, std::string> fingerprints_;  ///< made since the files changed
  std::unique_ptr<Connection> connection_;
};

}  // namespace spindrift
