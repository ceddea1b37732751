// SPDX-License-Identifier: Apache-2.0
#include "core/session/session_recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "core/base/file_end.h"
#include "core/base/inside_folder.h"
#include "core/machine/campaign.h"
#include "core/session/campaign_files.h"
#include "core/session/capture_list.h"
#include "core/session/session_database.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

/// A folder name that is safe everywhere: letters, digits, - and _.
std::string folderName(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (plain) {
      safe += c;
    } else if (!safe.empty() && safe.back() != '_') {
      safe += '_';
    }
  }
  return safe.empty() ? "campaign" : safe.substr(0, 60);
}

/// Rows of a list, without its header and comments.
std::size_t rowsOf(const fs::path& list) {
  const std::string text = readFile(list);
  std::size_t rows = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at && text[at] != '#') ++rows;
    at = end + 1;
  }
  return rows > 0 ? rows - 1 : 0;
}

std::size_t removeLeftovers(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code ignored;
  std::vector<fs::path> found;
  for (auto it = fs::recursive_directory_iterator(folder, ignored); it != fs::recursive_directory_iterator();
       it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    const bool half_import = name.starts_with(".importing") && it.depth() == 1;
    const bool half_file = name.starts_with('.') && name.ends_with(".part");
    if (half_import) it.disable_recursion_pending();
    if (half_import || half_file) found.push_back(it->path());
  }
  for (const fs::path& path : found) {
    if (fs::remove_all(path, ignored) > 0) ++count;
  }
  return count;
}

/// Ends of lists that were being written are written, a row that was being appended is taken back.
void finishLists(const CampaignRecord& record, SessionDatabase& database, bool crashed) {
  InsideFolder inside(record.folder);
  for (const SessionDatabase::PendingList& pending : database.pending(record.id)) {
    const fs::path list = inside.path(pending.list, {record.folder, ""});
    std::error_code gone;
    const std::uintmax_t size = fs::file_size(list, gone);
    if (!gone && size >= pending.change.from) replaceEnd(list, pending.change.from, pending.change.text);
    database.dropPending(record.id, pending.list);
  }
  if (!crashed) return;  // a last line without its end is what somebody wrote by hand
  for (const std::string& list : captureLists(record.folder)) {
    if (const auto known = database.file(record.id, list)) (void)cutTornRow(record.folder / list, known->content);
  }
}

/// A folder without a row, as it is.
void takeBack(const fs::path& session_folder, const fs::path& folder, SessionDatabase& database,
              RecoveryReport& report) {
  try {
    const std::string name = Campaign::read(folder).name;
    CampaignRecord record;
    const std::string relative = folder.lexically_relative(session_folder).generic_string();
    const FileFingerprints files = fingerprintsOfFiles(folder, {});
    record.id = database.addCampaign(name, relative, "");
    record.name = name;
    record.folder = folder;
    takeFiles(database, record, files);
    database.keepFingerprint(record.id);
    report.taken_back.push_back(name);
  } catch (const InputError&) {
    report.left_alone.push_back(folder.filename().string());
  } catch (const fs::filesystem_error&) {
    report.left_alone.push_back(folder.filename().string());
  }
}

}  // namespace

fs::path freshFolder(const fs::path& parent, const std::string& name) {
  fs::path folder = parent / folderName(name);
  for (int i = 2; fs::exists(folder); ++i) folder = parent / fmt::format("{}_{}", folderName(name), i);
  return folder;
}

std::string RecoveryReport::sentence() const {
  std::string text = fmt::format("The session was not closed the last time; it is as it was left: {} and {} are there.",
                                 countOf(captures, "capture"), countOf(results, "result"));
  if (leftovers > 0)
    text += fmt::format(" {} removed.", countOf(leftovers, "unfinished file was", "unfinished files were"));
  if (moved > 0)
    text += fmt::format(" {} now in the folder \"removed\".",
                        countOf(moved, "unfinished campaign is", "unfinished campaigns are"));
  return text;
}

std::vector<std::string> RecoveryReport::findings() const {
  std::vector<std::string> out;
  for (const std::string& name : taken_back)
    out.push_back(
        fmt::format("The campaign {} was in the folder of the session and not in its database (one from "
                    "before it was imported?): it is there again, without results.",
                    name));
  for (const std::string& name : left_alone)
    out.push_back(fmt::format("The folder campaigns/{} is no campaign of the session and was left as it is.", name));
  return out;
}

std::string recordedLogKey(std::int64_t campaign) {
  return fmt::format("recorded_log/{}", campaign);
}

RecoveryReport putInOrder(const fs::path& session_folder, SessionDatabase& database, bool crashed) {
  RecoveryReport report;
  report.leftovers = removeLeftovers(session_folder);
  std::set<fs::path> known;
  for (CampaignRecord& record : database.campaigns()) {
    record.folder = session_folder / record.folder;
    known.insert(record.folder.filename());
    finishLists(record, database, crashed);
    std::vector<std::string> lists = captureLists(record.folder);
    for (const std::string& list : lists) report.captures += rowsOf(record.folder / list);
    if (database.setting(recordedLogKey(record.id)) && fs::exists(record.folder / "log.csv"))
      lists.push_back("log.csv");
    report.results += database.countResults(record.id);
    if (database.files(record.id).empty()) {
      // A session of a version that did not write down the files.
      takeFiles(database, record, fingerprintsOfFiles(record.folder, {}));
    } else {
      recordFiles(database, record, lists);
    }
    database.keepFingerprint(record.id);
  }
  std::error_code ignored;
  std::vector<fs::path> unknown;
  for (const auto& entry : fs::directory_iterator(session_folder / "campaigns", ignored))
    if (entry.is_directory(ignored) && !known.contains(entry.path().filename())) unknown.push_back(entry.path());
  std::sort(unknown.begin(), unknown.end());
  for (const fs::path& folder : unknown) {
    // Nothing was cut short: its row is in a database that is not this one.
    if (!crashed) {
      takeBack(session_folder, folder, database, report);
      continue;
    }
    const fs::path target = freshFolder(session_folder / "removed", folder.filename().string());
    fs::create_directories(target.parent_path(), ignored);
    fs::rename(folder, target, ignored);
    if (!ignored) ++report.moved;
  }
  return report;
}

}  // namespace spindrift
