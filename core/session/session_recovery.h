// SPDX-License-Identifier: Apache-2.0
// What opening a session does after a crash: whatever was cut short is taken back or finished, nothing that was stored
// is lost.
//
//   cut short                                   found as                              done
//   an import                                   campaigns/.importing-*                removed (no row, half a copy)
//   writing a file                              .<name>.<process>.<number>.part       removed (the old file is whole)
//   making or removing a campaign               a folder without a row                moved to removed/
//   nothing: an older database was put back     a folder without a row                a campaign again, without results
//   a capture, between list and database        fingerprint of the list differs       fingerprint brought up to date
//   a row of a list                             a last line without its end           taken back (nobody was told of
//   it) several rows, or one that came late         the end of the list as it is to be,   written again
//                                               kept in the database
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/session/session.h"

namespace spindrift {

class SessionDatabase;

struct RecoveryReport {
  std::size_t captures = 0;             ///< rows in the lists of all campaigns
  std::size_t results = 0;              ///< stored results of all campaigns
  std::size_t leftovers = 0;            ///< half files and half imports that were removed
  std::size_t moved = 0;                ///< folders without a row, now in removed/
  std::vector<std::string> taken_back;  ///< names of campaigns that stood in no row and are in the session again
  std::vector<std::string> left_alone;  ///< folders without a row that are no campaigns

  /// One sentence for the user: after a crash.
  [[nodiscard]] std::string sentence() const;
  /// What was other than it was left in order; empty where nothing was.
  [[nodiscard]] std::vector<std::string> findings() const;
};

/// To be called with the lock held; `crashed`: the program that worked on it before did not end in order. Failures to
/// tidy up (a read-only file) are ignored: they hinder nothing.
RecoveryReport putInOrder(const std::filesystem::path& session_folder, SessionDatabase& database, bool crashed);

/// Setting that says that log.csv of a campaign is recorded into: whatever a recording left there is the campaign's.
[[nodiscard]] std::string recordedLogKey(std::int64_t campaign);

/// A folder in `parent` that does not exist yet, named after `name` with letters that are safe everywhere.
[[nodiscard]] std::filesystem::path freshFolder(const std::filesystem::path& parent, const std::string& name);

}  // namespace spindrift
