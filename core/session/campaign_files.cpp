// SPDX-License-Identifier: Apache-2.0
#include "core/session/campaign_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/sha256.h"
#include "core/session/session_database.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

bool isAmongCaptures(const std::string& name) {
  return name.starts_with("captures/");
}

std::string listed(const std::vector<std::string>& names) {
  std::string text = names.front();
  if (names.size() > 1) text += fmt::format(" and {} more", names.size() - 1);
  return text;
}

}  // namespace

std::string FileCheck::sentence() const {
  std::string text;
  const auto add = [&](const std::vector<std::string>& names, const char* one, const char* many) {
    if (names.empty()) return;
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", listed(names), names.size() == 1 ? one : many);
  };
  add(changed, "has another content", "have another content");
  add(missing, "is missing", "are missing");
  add(added, "was added", "were added");
  return text;
}

std::string fingerprintOf(const KnownFiles& files) {
  FileFingerprints counted;
  for (const auto& [name, file] : files)
    if (file.counts) counted[name] = file.content;
  return fingerprintOf(counted);
}

void recordFiles(SessionDatabase& database, const CampaignRecord& record, const std::vector<std::string>& names,
                 const FileFingerprints& contents) {
  KnownFiles changed;
  const auto take = [&](const std::string& name, std::string content) {
    const std::optional<KnownFile> known = database.file(record.id, name);
    if (!known || !known->counts || known->content != content) changed[name] = {std::move(content), true};
  };
  for (const auto& [name, content] : contents) take(name, content);
  for (const std::string& name : names) {
    const fs::path file = record.folder / name;
    if (!contents.contains(name)) take(name, fs::is_regular_file(file) ? sha256OfFile(file) : std::string());
  }
  if (!changed.empty()) database.setFiles(record.id, changed);
}

namespace {

/// Files that the lists of captures name.
std::set<std::string> filesInLists(const fs::path& campaign) {
  std::vector<std::string> rows;
  for (const std::string& list : captureLists(campaign)) {
    const std::string text = readFile(campaign / list);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
      if (end > begin) rows.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  const std::vector<std::string> named = filesNamedIn(campaign, rows);
  return {named.begin(), named.end()};
}

}  // namespace

FileCheck takeFiles(SessionDatabase& database, const CampaignRecord& record, const FileFingerprints& found) {
  const KnownFiles all = database.files(record.id);
  const bool first = all.empty();
  KnownFiles changed;
  FileCheck check;
  std::optional<std::set<std::string>> listed;  // what the lists name, if it is asked for
  for (const auto& [name, content] : found) {
    const auto known = all.find(name);
    if (known == all.end()) {
      if (!first && isAmongCaptures(name) && !listed) listed = filesInLists(record.folder);
      const bool counts = first || !isAmongCaptures(name) || listed->contains(name);
      changed[name] = {content, counts};
      if (counts && !first) check.added.push_back(name);
    } else if (known->second.content != content) {
      changed[name] = {content, true};
      check.changed.push_back(name);
    }
  }
  for (const auto& [name, file] : all) {
    if (found.contains(name) || file.content.empty()) continue;
    changed[name] = {"", file.counts};
    if (file.counts) check.missing.push_back(name);
  }
  if (!changed.empty()) database.setFiles(record.id, changed);
  return check;
}

std::vector<std::string> captureLists(const fs::path& campaign) {
  std::vector<std::string> lists;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(campaign / "captures", ignored)) {
    if (entry.path().extension() == ".csv" && entry.is_regular_file(ignored))
      lists.push_back("captures/" + entry.path().filename().string());
  }
  std::sort(lists.begin(), lists.end());
  return lists;
}

std::vector<std::string> filesNamedIn(const fs::path& campaign, const std::vector<std::string>& rows) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const std::string& row : rows) {
    for (std::size_t begin = 0; begin <= row.size();) {
      const std::size_t end = std::min(row.find(',', begin), row.size());
      const fs::path named = fs::path(row.substr(begin, end - begin)).lexically_normal();
      begin = end + 1;
      if (named.empty() || named.is_absolute() || *named.begin() == ".." || !named.has_extension()) continue;
      if (fs::is_regular_file(campaign / named, ignored)) found.push_back(named.generic_string());
    }
  }
  return found;
}

}  // namespace spindrift
