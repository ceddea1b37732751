// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/session.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

/// All that a session hands out.
void readAll(const Session& session) {
  for (const CampaignRecord& record : session.campaigns()) {
    (void)session.exclusions(record.id);
    (void)session.notes(record.id);
    (void)session.arrivals(record.id);
    (void)session.results(record.id);
    for (const std::string& kind : session.resultKinds(record.id)) {
      for (const StoredResult& result : session.resultHeads(record.id, kind)) (void)session.payload(result.id);
      (void)session.latestResult(record.id, kind);
    }
    (void)session.setting("plan/" + std::to_string(record.id));
  }
}

void database(std::string_view bytes) {
  for (const char* left_over : {"session/session.sqlite-journal", "session/session.sqlite-wal"})
    std::filesystem::remove(scratchFile(left_over, ""));
  (void)scratchFile("session/session.sqlite", bytes);
  const std::filesystem::path file =
      scratchFile("session/spindrift-session.json", R"({"format":"spindrift-session","version":2})");
  std::filesystem::create_directories(file.parent_path() / "campaigns");
  readAll(Session::open(file.parent_path()));
}

void version(std::string_view bytes) {
  static const std::filesystem::path folder = [] {
    const std::filesystem::path made = scratchFile("version/new", "").parent_path() / "session";
    std::filesystem::remove_all(made);
    (void)Session::create(made);
    return made;
  }();
  (void)scratchFile("version/session/spindrift-session.json", bytes);
  (void)Session::open(folder);
}

constexpr Reader readers[] = {{"session_database", database}, {"session_version", version}};

}  // namespace

std::span<const Reader> sessionReaders() {
  return readers;
}

}  // namespace spindrift::testing
