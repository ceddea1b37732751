// SPDX-License-Identifier: Apache-2.0
// Which files a campaign consists of, and what was in them: written down when they enter the session, held against the
// disk when it is opened. A result is made from these contents; a file that is another one makes it outdated.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/session/fingerprint.h"
#include "core/session/session.h"

namespace spindrift {

class SessionDatabase;

struct KnownFile {
  std::string content;  ///< fingerprint; empty while the file is missing
  /// False for what lies among the captures and stands in no list: nothing is made from it.
  bool counts = true;
};
using KnownFiles = std::map<std::string, KnownFile>;

/// Fingerprint of the files that count.
[[nodiscard]] std::string fingerprintOf(const KnownFiles& files);

/// Reads these files again (names relative to the campaign folder; one that is not there is missing) and stores what
/// they are now; `contents` holds the fingerprints of files that need not be read. They count from now on.
void recordFiles(SessionDatabase& database, const CampaignRecord& record, const std::vector<std::string>& names,
                 const FileFingerprints& contents = {});

/// Holds what was found on the disk against what is known, stores it and says what was other.
FileCheck takeFiles(SessionDatabase& database, const CampaignRecord& record, const FileFingerprints& found);

/// Lists of captures, relative to the campaign folder, in order of their names.
[[nodiscard]] std::vector<std::string> captureLists(const std::filesystem::path& campaign);

/// Files in the campaign folder that rows of a list name.
[[nodiscard]] std::vector<std::string> filesNamedIn(const std::filesystem::path& campaign,
                                                    const std::vector<std::string>& rows);

}  // namespace spindrift
