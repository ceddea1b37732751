// SPDX-License-Identifier: Apache-2.0
#include "core/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/inside_folder.h"
#include "core/base/json_reader.h"
#include "core/base/log.h"
#include "core/session/campaign_files.h"
#include "core/session/capture_list.h"
#include "core/session/fingerprint.h"
#include "core/session/session_database.h"
#include "core/session/session_lock.h"
#include "core/session/session_recovery.h"

namespace spindrift {
namespace {

constexpr const char* version_file = "spindrift-session.json";
constexpr const char* database_file = "session.sqlite";

void copyFolder(const std::filesystem::path& source, const std::filesystem::path& target, JobContext& job) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source)) {
    if (entry.is_regular_file()) files.push_back(std::filesystem::relative(entry.path(), source));
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    job.report(static_cast<double>(i) / static_cast<double>(files.size()), "copying the campaign into the session");
    job.throwIfCancelled();
    std::filesystem::create_directories((target / files[i]).parent_path());
    std::filesystem::copy_file(source / files[i], target / files[i]);
  }
}

}  // namespace

std::string utcNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

Session::Session(std::filesystem::path folder, std::unique_ptr<SessionLock> lock,
                 std::unique_ptr<SessionDatabase> database)
    : folder_(std::move(folder)), lock_(std::move(lock)), database_(std::move(database)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

bool Session::isSession(const std::filesystem::path& folder) {
  return std::filesystem::is_regular_file(folder / version_file);
}

bool Session::wasLeftOpen(const std::filesystem::path& folder) {
  return isSession(folder) && SessionLock::abandoned(folder);
}

Session Session::create(const std::filesystem::path& wanted) {
  const std::filesystem::path folder = std::filesystem::absolute(wanted);
  std::error_code error;
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder, error)) {
    throw InputError({folder, ""}, "is not empty; allowed: a new or an empty folder for a new session.");
  }
  std::filesystem::create_directories(folder / "campaigns", error);
  if (error) throw InputError({folder, ""}, fmt::format("cannot be made: {}.", error.message()));
  auto lock = std::make_unique<SessionLock>(folder);
  std::vector<std::string> messages;
  auto database = std::make_unique<SessionDatabase>(folder / database_file, messages);
  // The version file comes last: a session that was interrupted while it was made is not taken for one.
  writeFileAtomically(folder / version_file, fmt::format("{{\"format\":\"spindrift-session\",\"version\":{}}}\n",
                                                         SessionDatabase::newest_version));
  log(LogLevel::Info, "made session " + folder.string());
  return {folder, std::move(lock), std::move(database)};
}

namespace {

/// Lock, database, its journals and copies, campaigns: what a session writes to is in its folder. Throws InputError for
/// a link out of it, before anything is opened: a lock alone would empty the file that it leads to.
void refuseLinksOut(const std::filesystem::path& folder) {
  InsideFolder inside(folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_symlink()) (void)inside.path(entry.path().filename().string(), {folder, ""});
}

}  // namespace

Session Session::open(const std::filesystem::path& wanted) {
  const std::filesystem::path folder = std::filesystem::absolute(wanted);
  if (!isSession(folder)) {
    throw InputError({folder, ""}, fmt::format("is not a session; allowed: a folder with {}.", version_file));
  }
  refuseLinksOut(folder);
  const JsonNode root = JsonNode::read(folder / version_file);
  root.requireFormat("spindrift-session", SessionDatabase::newest_version);
  const int version = root.at("version").integer();
  auto lock = std::make_unique<SessionLock>(folder);
  if (!std::filesystem::exists(folder / database_file)) {
    throw InputError({folder, ""},
                     fmt::format("has lost its file {}; put it back from a copy of the session.", database_file));
  }
  std::vector<std::string> messages;
  auto database = std::make_unique<SessionDatabase>(folder / database_file, messages);
  if (version < SessionDatabase::newest_version) {
    writeFileAtomically(folder / version_file, fmt::format("{{\"format\":\"spindrift-session\",\"version\":{}}}\n",
                                                           SessionDatabase::newest_version));
  }
  const bool crashed = !lock->diedBefore().empty();
  RecoveryReport found = putInOrder(folder, *database, crashed);
  Session session(folder, std::move(lock), std::move(database));
  session.migration_messages_ = std::move(messages);
  if (crashed) session.recovery_messages_.push_back(found.sentence());
  for (std::string& finding : found.findings()) session.recovery_messages_.push_back(std::move(finding));
  log(LogLevel::Info, "opened session " + folder.string());
  return session;
}

namespace {

FileFingerprints filesOfSource(const std::filesystem::path& source, const JobContext& job) {
  try {
    return fingerprintsOfFiles(source, job);
  } catch (const std::filesystem::filesystem_error& failure) {
    throw InputError({source, ""}, fmt::format("cannot be read: {}.", failure.code().message()));
  }
}

}  // namespace

StagedCampaign::StagedCampaign(const std::filesystem::path& session_folder, const std::filesystem::path& source,
                               JobContext& job)
    : source_(source), name_(Campaign::read(source).name), files_(filesOfSource(source, job.part(0.0, 0.3))) {
  const std::filesystem::path parent = session_folder / "campaigns";
  copy_ = parent / (".importing-" + freshFolder(parent, name_).filename().string());
  std::error_code error;
  std::filesystem::remove_all(copy_, error);
  try {
    JobContext copying = job.part(0.3, 1.0);
    copyFolder(source, copy_, copying);
  } catch (const std::filesystem::filesystem_error& failure) {
    std::filesystem::remove_all(copy_, error);
    throw InputError({source, ""}, fmt::format("cannot be copied into the session: {}.", failure.code().message()));
  } catch (...) {
    std::filesystem::remove_all(copy_, error);
    throw;
  }
}

StagedCampaign::~StagedCampaign() {
  std::error_code ignored;
  if (!copy_.empty()) std::filesystem::remove_all(copy_, ignored);
}

std::int64_t Session::importCampaign(const std::filesystem::path& source, JobContext& job) {
  database_->requireInPlace();
  const std::string fingerprint = fingerprintOf(filesOfSource(source, job.part(0.0, 0.3)));
  for (const CampaignRecord& record : campaigns()) {
    if (record.fingerprint == fingerprint) return record.id;
  }
  StagedCampaign staged(folder_, source, job);
  return adoptCampaign(staged);
}

std::int64_t Session::adoptCampaign(StagedCampaign& staged) {
  database_->requireInPlace();
  const std::string fingerprint = fingerprintOf(staged.files_);
  for (const CampaignRecord& record : campaigns()) {
    if (record.fingerprint == fingerprint) return record.id;
  }
  const std::filesystem::path target = freshFolder(folder_ / "campaigns", staged.name_);
  try {
    std::filesystem::rename(staged.copy_, target);
  } catch (const std::filesystem::filesystem_error& failure) {
    throw InputError({staged.source_, ""},
                     fmt::format("cannot be copied into the session: {}.", failure.code().message()));
  }
  staged.copy_.clear();
  const std::int64_t id =
      database_->addCampaign(staged.name_, std::filesystem::relative(target, folder_).generic_string(), fingerprint);
  takeFiles(id, staged.files_);
  log(LogLevel::Info, fmt::format("imported campaign \"{}\" from {}", staged.name_, staged.source_.string()));
  return id;
}

std::int64_t Session::newCampaign(const std::string& name, const std::string& start_utc,
                                  const std::string& machine_json) {
  database_->requireInPlace();
  const std::filesystem::path target = freshFolder(folder_ / "campaigns", name);
  const nlohmann::json head = {
      {"format", "spindrift-campaign"}, {"version", 1}, {"name", name}, {"start_utc", start_utc}};
  writeFileAtomically(target / "campaign.json", head.dump(1) + "\n");
  writeFileAtomically(target / "machine.json", machine_json);
  try {
    (void)Campaign::read(target);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove_all(target, ignored);
    throw;
  }
  const FileFingerprints files = fingerprintsOfFiles(target, {});
  const std::int64_t id =
      database_->addCampaign(name, std::filesystem::relative(target, folder_).generic_string(), fingerprintOf(files));
  takeFiles(id, files);
  return id;
}

std::vector<CampaignRecord> Session::campaigns() const {
  std::vector<CampaignRecord> list = database_->campaigns();
  for (CampaignRecord& record : list) {
    record.folder = folder_ / record.folder;
    record.fingerprint = database_->fingerprint(record.id);
  }
  return list;
}

CampaignRecord Session::place(std::int64_t id) const {
  for (CampaignRecord& record : database_->campaigns()) {
    if (record.id != id) continue;
    record.folder = folder_ / record.folder;
    return record;
  }
  SPINDRIFT_ASSERT(false, "unknown campaign id");
  return {};
}

CampaignRecord Session::campaign(std::int64_t id) const {
  CampaignRecord record = place(id);
  record.fingerprint = database_->fingerprint(id);
  return record;
}

void Session::removeCampaign(std::int64_t id) {
  const CampaignRecord record = place(id);
  // The row goes first: a folder without a row is moved aside when the session is opened, a row without a folder would
  // be in the way.
  database_->removeCampaign(id);
  const std::filesystem::path target = freshFolder(folder_ / "removed", record.name);
  std::error_code error;
  std::filesystem::create_directories(target.parent_path(), error);
  std::filesystem::rename(record.folder, target, error);
  if (error) throw InputError({record.folder, ""}, fmt::format("cannot be moved away: {}.", error.message()));
}

CaptureList& Session::listOf(const CampaignRecord& record, const std::string& list) {
  const std::filesystem::path file = InsideFolder(record.folder).path("captures/" + list, {record.folder, ""});
  std::unique_ptr<CaptureList>& known = lists_[file];
  if (known == nullptr) known = std::make_unique<CaptureList>(file);
  return *known;
}

void Session::addCaptureRows(std::int64_t id, const std::string& list, const std::string& header,
                             const std::vector<std::string>& rows) {
  database_->requireInPlace();
  const CampaignRecord record = place(id);
  CaptureList& known = listOf(record, list);
  const std::string name = "captures/" + list;
  if (const std::optional<ListChange> change = known.changeFor(header, rows)) {
    // A row that is cut short is found when the session is opened, a list that is new is written atomically.
    const bool keep = change->from > 0 && !change->one_row;
    if (keep) database_->setPending(record.id, {name, *change});
    try {
      known.apply(*change);
    } catch (const InputError&) {
      if (keep) database_->dropPending(record.id, name);
      throw;
    }
  }
  recordFiles(*database_, record, filesNamedIn(record.folder, rows), {{name, known.hash()}});
}

void Session::setArrival(std::int64_t id, const std::string& name, const nlohmann::json& item) {
  database_->setArrival(id, name, item.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::optional<nlohmann::json> Session::arrival(std::int64_t id, const std::string& name) const {
  return database_->arrival(id, name);
}

std::vector<nlohmann::json> Session::arrivals(std::int64_t id) const {
  return database_->arrivals(id);
}

std::filesystem::path Session::recordsLog(std::int64_t id) {
  database_->requireInPlace();
  const CampaignRecord record = place(id);
  database_->setSetting(recordedLogKey(id), nlohmann::json(true).dump());
  if (std::filesystem::exists(record.folder / "log.csv")) recordFiles(*database_, record, {"log.csv"});
  return record.folder / "log.csv";
}

FileCheck Session::takeFiles(std::int64_t id, const FileFingerprints& found) {
  return spindrift::takeFiles(*database_, place(id), found);
}

std::string Session::machineKey(std::int64_t id) {
  return fmt::format("machine/{}", id);
}

std::string Session::clocksKey(std::int64_t id) {
  return fmt::format("time-offsets/{}", id);
}

nlohmann::json Session::inputs(std::int64_t id) const {
  nlohmann::json items = nlohmann::json::array();
  for (const Exclusion& exclusion : exclusions(id)) items.push_back(exclusion.item);
  // Nothing edited and edited back are the same.
  const nlohmann::json machine = setting(machineKey(id)).value_or(nlohmann::json());
  const nlohmann::json clocks = setting(clocksKey(id)).value_or(nlohmann::json());
  return {{"files", database_->fingerprint(id)},
          {"exclusions", items},
          {"machine", machine.empty() ? std::string() : Fingerprint().add(machine.dump()).text()},
          {"clocks", clocks.empty() ? nlohmann::json::object() : clocks}};
}

ResultOrigin Session::originOf(std::int64_t id, const std::string& kind, const nlohmann::json& options,
                               const nlohmann::json& made_from) const {
  ResultOrigin origin{id, kind, options, inputs(id)};
  origin.inputs.update(made_from);
  return origin;
}

std::optional<StoredResult> Session::keepResult(const ResultOrigin& origin, nlohmann::json payload) {
  const std::vector<CampaignRecord> all = database_->campaigns();
  if (std::none_of(all.begin(), all.end(), [&](const CampaignRecord& r) { return r.id == origin.campaign; })) return {};
  StoredResult result;
  result.campaign = origin.campaign;
  result.kind = origin.kind;
  result.payload = std::move(payload);
  result.provenance = {SPINDRIFT_VERSION, utcNow(),
                       Fingerprint().add(origin.inputs.dump()).add(origin.options.dump()).text(), origin.options,
                       origin.inputs};
  result.id = database_->addResult(result);
  return result;
}

std::optional<StoredResult> Session::latestResult(std::int64_t id, const std::string& kind) const {
  return database_->latestResult(id, kind);
}

std::optional<UnreadResult> Session::latestUnread(std::int64_t id, const std::string& kind) const {
  return database_->latestUnread(id, kind);
}

std::vector<StoredResult> Session::resultHeads(std::int64_t id, const std::string& kind) const {
  return database_->resultHeads(id, kind);
}

nlohmann::json Session::payload(std::int64_t result) const {
  return database_->payload(result);
}

std::vector<std::string> Session::resultKinds(std::int64_t id) const {
  return database_->resultKinds(id);
}

std::vector<StoredResult> Session::results(std::int64_t id) const {
  return database_->results(id, "");
}
void Session::removeResult(std::int64_t result) {
  database_->removeResult(result);
}

bool Session::isCurrent(const StoredResult& result) const {
  const nlohmann::json now = inputs(result.campaign);
  const nlohmann::json& then = result.provenance.inputs;
  return std::all_of(now.items().begin(), now.items().end(), [&](const auto& input) {
    return then.contains(input.key()) && then[input.key()] == input.value();
  });
}

void Session::exclude(std::int64_t id, const std::string& item, const std::string& reason) {
  exclude(id, std::vector<Exclusion>{{item, reason, {}}});
}
void Session::restore(std::int64_t id, const std::string& item) {
  exclude(id, std::vector<Exclusion>{{item, {}, {}}});
}
void Session::exclude(std::int64_t id, const std::vector<Exclusion>& items) {
  database_->exclude(id, items, utcNow());
}
std::vector<Exclusion> Session::exclusions(std::int64_t id) const {
  return database_->exclusions(id);
}

std::int64_t Session::addNote(std::int64_t id, const std::string& step, const std::string& text,
                              const std::string& item) {
  return addNote(id, {0, step, text, utcNow(), item});
}
std::int64_t Session::addNote(std::int64_t id, const Note& note) {
  return database_->addNote(id, note);
}
void Session::removeNote(std::int64_t note) {
  database_->removeNote(note);
}
std::vector<Note> Session::notes(std::int64_t id) const {
  return database_->notes(id);
}

void Session::setSetting(const std::string& key, const nlohmann::json& value) {
  // A sentence may carry what is no UTF-8, a path of the system for example.
  database_->setSetting(key, value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::optional<nlohmann::json> Session::setting(const std::string& key) const {
  return database_->setting(key);
}

}  // namespace spindrift
