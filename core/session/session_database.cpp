// SPDX-License-Identifier: Apache-2.0
#include "core/session/session_database.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <typeinfo>

#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>

#include "core/base/error.h"
#include "core/base/inside_folder.h"
#include "core/base/log.h"
#include "core/base/untrusted_text.h"

namespace spindrift {

struct SessionDatabase::Connection {
  mutable soci::session sql;
  struct stat identity {};  ///< of the file when it was opened
};

namespace {

/// Schema of version 1. Later versions add a function to `migrations` and never change an older one.
void makeVersion1(soci::session& sql) {
  sql << "create table campaign (id integer primary key, name text not null, folder text not null unique, "
         "fingerprint text not null, imported_utc text not null)";
  sql << "create table result (id integer primary key, campaign integer not null references campaign(id) on delete "
         "cascade, kind text not null, program_version text not null, created_utc text not null, inputs_fingerprint "
         "text "
         "not null, options text not null, payload text not null)";
  sql << "create index result_by_kind on result (campaign, kind, id)";
  sql << "create table exclusion (campaign integer not null references campaign(id) on delete cascade, item text not "
         "null, reason text not null, created_utc text not null, primary key (campaign, item))";
  sql << "create table note (id integer primary key, campaign integer not null references campaign(id) on delete "
         "cascade, "
         "step text not null, text text not null, created_utc text not null)";
  sql << "create table setting (name text primary key, value text not null)";
}

/// Version 2: a note may be about one item, such as a capture.
void makeVersion2(soci::session& sql) {
  sql << "alter table note add column item text not null default ''";
}

/// Version 3: what a result was made from, by name, and what was in each file of a campaign.
void makeVersion3(soci::session& sql) {
  sql << "alter table result add column inputs text not null default '{}'";
  sql << "create table file (campaign integer not null references campaign(id) on delete cascade, name text not null, "
         "content text not null, counts integer not null, primary key (campaign, name))";
}

/// Version 4: what arrived has a row each; it stood in one setting a campaign ("incoming/<id>"). What is about to be
/// written into a list.
void makeVersion4(soci::session& sql) {
  sql << "create table arrival (id integer primary key, campaign integer not null references campaign(id) on delete "
         "cascade, name text not null, item text not null, unique (campaign, name))";
  sql << "create table pending_list (campaign integer not null references campaign(id) on delete cascade, list text "
         "not "
         "null, from_byte integer not null, text text not null, primary key (campaign, list))";
  std::vector<std::pair<long long, std::string>> journals;
  const soci::rowset<soci::row> rows =
      (sql.prepare
       << "select cast(c.id as text), s.value from campaign c join setting s on s.name = 'incoming/' || c.id");
  for (const soci::row& row : rows) journals.emplace_back(std::stoll(row.get<std::string>(0)), row.get<std::string>(1));
  for (const auto& [campaign, text] : journals) {
    if (deepestJson(text) > most_levels_of_json) continue;
    const nlohmann::json journal = nlohmann::json::parse(text, nullptr, false);
    if (!journal.is_array()) continue;
    for (const nlohmann::json& entry : journal) {
      if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string()) continue;
      const std::string name = entry["name"].get<std::string>();
      const std::string item = entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
      sql << "insert or replace into arrival (campaign, name, item) values (:c, :n, :i)", soci::use(campaign),
          soci::use(name), soci::use(item);
    }
  }
  sql << "delete from setting where name in (select 'incoming/' || id from campaign)";
}

using Migration = void (*)(soci::session&);
constexpr Migration migrations[] = {makeVersion1, makeVersion2, makeVersion3, makeVersion4};
static_assert(std::size(migrations) == SessionDatabase::newest_version);

/// What a user gets back to the older program with. Throws InputError if it cannot be written; an older copy of the
/// same version stands for the same data and is replaced.
std::filesystem::path keepCopy(const std::filesystem::path& file, int version) {
  const std::filesystem::path copy = file.string() + fmt::format(".version-{}", version);
  const std::filesystem::path working = copy.string() + ".writing";
  std::error_code error;
  std::filesystem::copy_file(file, working, std::filesystem::copy_options::overwrite_existing, error);
  if (!error) std::filesystem::rename(working, copy, error);
  if (!error) return copy;
  std::error_code ignored;
  std::filesystem::remove(working, ignored);
  throw InputError({file, ""}, fmt::format("is of version {} and cannot be copied before it is changed: {}; make room "
                                           "beside it or open it with the older program.",
                                           version, error.message()));
}

/// What a failing disk leaves is found before anything is read from it or written to it. The first statement on the
/// database has taken back what a crash left half done.
void requireSound(soci::session& sql, const std::filesystem::path& file) {
  std::string answer;
  sql << "pragma quick_check(1)", soci::into(answer);
  if (answer == "ok") return;
  throw InputError({file, ""},
                   fmt::format("the session's database is damaged ({}); take it from a copy of the session. "
                               "The captures in the folder campaigns are not touched by that.",
                               answer));
}

/// The file gives back what removed results took. One of an older program is laid out anew once.
void shrinkFromNowOn(soci::session& sql) {
  int mode = 0;
  sql << "pragma auto_vacuum", soci::into(mode);
  if (mode == 1) return;
  try {
    sql << "pragma auto_vacuum = full";
    sql << "vacuum";
  } catch (const soci::soci_error& failure) {
    // No room for the second copy that this takes for a moment: another time.
    log(LogLevel::Warning, std::string("the session's database stays as large as it is: ") + failure.what());
  }
}

/// Runs `body` and turns what SOCI throws into the sentence a user gets.
template <typename Body>
auto guarded(const std::filesystem::path& file, Body body) -> decltype(body()) {
  try {
    return body();
  } catch (const soci::soci_error& error) {
    throw InputError({file, ""}, fmt::format("the session's database cannot be used: {}.", error.get_error_message()));
  } catch (const std::bad_cast&) {
    throw InputError({file, ""}, "the session's database holds a value of another kind than its column.");
  } catch (const std::invalid_argument&) {
    throw InputError({file, ""}, "the session's database holds a key that is not a number.");
  } catch (const std::out_of_range&) {
    throw InputError({file, ""}, "the session's database holds a key that is too large.");
  }
}

/// JSON of a column.
nlohmann::json parsed(const std::filesystem::path& file, std::string_view text, std::string_view what) {
  nlohmann::json out;
  if (deepestJson(text) <= most_levels_of_json)
    out = nlohmann::json::parse(text, nullptr, false);
  else
    out = nlohmann::json(nlohmann::json::value_t::discarded);
  if (out.is_discarded())
    throw InputError({file, ""}, fmt::format("the session's database holds {} that is not JSON.", what));
  return out;
}

}  // namespace

SessionDatabase::SessionDatabase(const std::filesystem::path& file, std::vector<std::string>& messages)
    : file_(file), connection_(std::make_unique<Connection>()) {
  guarded(file_, [&] {
    soci::session& sql = connection_->sql;
    std::error_code ignored;
    const bool there = std::filesystem::exists(file_, ignored);
    sql.open(soci::sqlite3, fmt::format("db=\"{}\" timeout=5", file_.string()));
    sql << "pragma foreign_keys = on";
    sql << "pragma synchronous = full";
    int version = 0;
    sql << "pragma user_version", soci::into(version);
    if (version > newest_version) {
      throw InputError({file_, ""},
                       fmt::format("has version {}; allowed: 1 to {}. It was made by a newer program; open "
                                   "it there or install the newer version.",
                                   version, newest_version));
    }
    // What is no database of a session, or an empty one, is never made one: its campaigns would stand in no list.
    if (version < 0 || (there && version == 0))
      throw InputError({file_, ""}, "is empty or no database of a session; put it back from a copy of the session.");
    requireSound(sql, file_);
    if (version < newest_version) {
      const int before = version;
      const std::filesystem::path copy = before > 0 ? keepCopy(file_, before) : std::filesystem::path();
      soci::transaction transaction(sql);
      while (version < newest_version) migrations[version++](sql);
      sql << fmt::format("pragma user_version = {}", newest_version);
      transaction.commit();
      if (before > 0) {
        messages.push_back(fmt::format("The session was brought from version {} to {}; the old database is kept as {}.",
                                       before, newest_version, copy.filename().string()));
      }
    }
    shrinkFromNowOn(sql);
    if (::stat(file_.c_str(), &connection_->identity) != 0) throw InputError({file_, ""}, "cannot be opened.");
  });
}

SessionDatabase::~SessionDatabase() = default;

void SessionDatabase::requireInPlace() const {
  struct stat now {};
  const struct stat& then = connection_->identity;
  if (::stat(file_.c_str(), &now) == 0 && now.st_ino == then.st_ino && now.st_dev == then.st_dev) return;
  throw InputError({file_.parent_path(), ""},
                   "is not there any more (removed, renamed, or the network folder is gone). Nothing was stored; bring "
                   "the folder back and do the last step again.");
}

template <typename Body>
auto SessionDatabase::writing(Body body) const -> decltype(body()) {
  requireInPlace();
  return guarded(file_, std::move(body));
}

std::int64_t SessionDatabase::addCampaign(const std::string& name, const std::string& folder,
                                          const std::string& fingerprint) {
  return writing([&] {
    const std::string now = utcNow();
    soci::session& sql = connection_->sql;
    sql << "insert into campaign (name, folder, fingerprint, imported_utc) values (:n, :f, :p, :t)", soci::use(name),
        soci::use(folder), soci::use(fingerprint), soci::use(now);
    long long id = 0;
    sql << "select last_insert_rowid()", soci::into(id);
    return static_cast<std::int64_t>(id);
  });
}

void SessionDatabase::setFiles(std::int64_t id, const KnownFiles& files) {
  writing([&] {
    fingerprints_.erase(id);
    const long long key = id;
    soci::session& sql = connection_->sql;
    soci::transaction transaction(sql);
    std::string name;
    std::string content;
    int counts = 1;
    soci::statement insert =
        (sql.prepare << "insert into file (campaign, name, content, counts) values (:c, :n, :f, :k) on conflict "
                        "(campaign, name) do update set content = excluded.content, counts = excluded.counts",
         soci::use(key), soci::use(name), soci::use(content), soci::use(counts));
    for (const auto& [named, file] : files) {
      name = named;
      content = file.content;
      counts = file.counts ? 1 : 0;
      insert.execute(true);
      sql << "delete from pending_list where campaign = :c and list = :n", soci::use(key), soci::use(name);
    }
    sql << "update campaign set fingerprint = '' where id = :i", soci::use(key);
    transaction.commit();
  });
}

KnownFiles SessionDatabase::files(std::int64_t id) const {
  return guarded(file_, [&] {
    const long long key = id;
    KnownFiles found;
    const soci::rowset<soci::row> rows =
        (connection_->sql.prepare << "select name, content, counts from file where campaign = :c", soci::use(key));
    for (const soci::row& row : rows) found[row.get<std::string>(0)] = {row.get<std::string>(1), row.get<int>(2) != 0};
    return found;
  });
}

std::optional<KnownFile> SessionDatabase::file(std::int64_t id, const std::string& name) const {
  return guarded(file_, [&]() -> std::optional<KnownFile> {
    const long long key = id;
    std::string content;
    int counts = 0;
    soci::session& sql = connection_->sql;
    sql << "select content, counts from file where campaign = :c and name = :n", soci::use(key), soci::use(name),
        soci::into(content), soci::into(counts);
    if (!sql.got_data()) return std::nullopt;
    return KnownFile{content, counts != 0};
  });
}

std::string SessionDatabase::fingerprint(std::int64_t id) const {
  if (const auto made = fingerprints_.find(id); made != fingerprints_.end()) return made->second;
  std::string& made = fingerprints_[id];
  made = guarded(file_, [&] {
    const long long key = id;
    std::string kept;
    connection_->sql << "select fingerprint from campaign where id = :i", soci::use(key), soci::into(kept);
    return kept;
  });
  if (made.empty()) made = fingerprintOf(files(id));
  return made;
}

void SessionDatabase::keepFingerprint(std::int64_t id) {
  writing([&] {
    const long long key = id;
    const std::string made = fingerprint(id);
    connection_->sql << "update campaign set fingerprint = :p where id = :i and fingerprint = ''", soci::use(made),
        soci::use(key);
  });
}

void SessionDatabase::setPending(std::int64_t id, const PendingList& pending) {
  writing([&] {
    const long long key = id;
    const auto from = static_cast<long long>(pending.change.from);
    connection_->sql << "insert or replace into pending_list (campaign, list, from_byte, text) values (:c, :l, :f, :t)",
        soci::use(key), soci::use(pending.list), soci::use(from), soci::use(pending.change.text);
  });
}

void SessionDatabase::dropPending(std::int64_t id, const std::string& list) {
  writing([&] {
    const long long key = id;
    connection_->sql << "delete from pending_list where campaign = :c and list = :l", soci::use(key), soci::use(list);
  });
}

std::vector<SessionDatabase::PendingList> SessionDatabase::pending(std::int64_t id) const {
  return guarded(file_, [&] {
    const long long key = id;
    std::vector<PendingList> found;
    const soci::rowset<soci::row> rows =
        (connection_->sql.prepare << "select list, cast(from_byte as text), text from pending_list where campaign = :c",
         soci::use(key));
    for (const soci::row& row : rows)
      found.push_back(
          {row.get<std::string>(0), {std::stoull(row.get<std::string>(1)), row.get<std::string>(2), false}});
    return found;
  });
}

void SessionDatabase::setArrival(std::int64_t id, const std::string& name, const std::string& json) {
  writing([&] {
    const long long key = id;
    connection_->sql
        << "insert into arrival (campaign, name, item) values (:c, :n, :i) on conflict (campaign, name) do "
           "update set item = excluded.item",
        soci::use(key), soci::use(name), soci::use(json);
  });
}

std::optional<nlohmann::json> SessionDatabase::arrival(std::int64_t id, const std::string& name) const {
  return guarded(file_, [&]() -> std::optional<nlohmann::json> {
    const long long key = id;
    std::string item;
    soci::session& sql = connection_->sql;
    sql << "select item from arrival where campaign = :c and name = :n", soci::use(key), soci::use(name),
        soci::into(item);
    if (!sql.got_data()) return std::nullopt;
    return parsed(file_, item, "an arrival");
  });
}

std::vector<nlohmann::json> SessionDatabase::arrivals(std::int64_t id) const {
  return guarded(file_, [&] {
    const long long key = id;
    std::vector<nlohmann::json> found;
    const soci::rowset<soci::row> rows =
        (connection_->sql.prepare << "select item from arrival where campaign = :c order by id", soci::use(key));
    for (const soci::row& row : rows) found.push_back(parsed(file_, row.get<std::string>(0), "an arrival"));
    return found;
  });
}

std::vector<CampaignRecord> SessionDatabase::campaigns() const {
  std::vector<CampaignRecord> found = guarded(file_, [&] {
    std::vector<CampaignRecord> list;
    const soci::rowset<soci::row> rows =
        (connection_->sql.prepare << "select cast(id as text), name, folder, fingerprint, imported_utc from campaign "
                                     "order by id");
    for (const soci::row& row : rows) {
      list.push_back({std::stoll(row.get<std::string>(0)), row.get<std::string>(1), row.get<std::string>(2),
                      row.get<std::string>(3), row.get<std::string>(4)});
    }
    return list;
  });
  // Whoever made this file may be somebody else: only folders right inside campaigns are ever touched.
  InsideFolder session(file_.parent_path());
  for (const CampaignRecord& record : found) {
    const std::filesystem::path named(record.folder);
    const std::filesystem::path folder = session.path(named.string(), {file_, ""});
    std::error_code none;
    if (named != named.lexically_normal() || named.parent_path() != "campaigns" || named.filename().empty() ||
        std::filesystem::is_symlink(folder, none))
      throw InputError({file_, ""}, fmt::format("keeps the campaign \"{}\" in \"{}\"; allowed: a folder in campaigns.",
                                                record.name, named.string()));
  }
  return found;
}

void SessionDatabase::removeCampaign(std::int64_t id) {
  writing([&] {
    const long long key = id;
    connection_->sql << "delete from campaign where id = :i", soci::use(key);
  });
}

std::int64_t SessionDatabase::addResult(const StoredResult& result) {
  return writing([&] {
    const long long campaign = result.campaign;
    const std::string options = result.provenance.options.dump();
    const std::string inputs = result.provenance.inputs.dump();
    const std::string payload = result.payload.dump();
    soci::session& sql = connection_->sql;
    sql << "insert into result (campaign, kind, program_version, created_utc, inputs_fingerprint, inputs, options, "
           "payload) values (:c, :k, :v, :t, :f, :i, :o, :p)",
        soci::use(campaign), soci::use(result.kind), soci::use(result.provenance.program_version),
        soci::use(result.provenance.created_utc), soci::use(result.provenance.inputs_fingerprint), soci::use(inputs),
        soci::use(options), soci::use(payload);
    long long id = 0;
    sql << "select last_insert_rowid()", soci::into(id);
    return static_cast<std::int64_t>(id);
  });
}

std::vector<StoredResult> SessionDatabase::results(std::int64_t campaign, const std::string& kind) const {
  std::vector<StoredResult> list;
  for (const UnreadResult& result : selectResults(campaign, kind, "order by id")) list.push_back(result.read());
  return list;
}

std::optional<UnreadResult> SessionDatabase::latestUnread(std::int64_t campaign, const std::string& kind) const {
  std::vector<UnreadResult> list = selectResults(campaign, kind, "order by id desc limit 1");
  if (list.empty()) return std::nullopt;
  return std::move(list.front());
}

std::optional<StoredResult> SessionDatabase::latestResult(std::int64_t campaign, const std::string& kind) const {
  const std::optional<UnreadResult> found = latestUnread(campaign, kind);
  return found ? std::optional(found->read()) : std::nullopt;
}

std::vector<StoredResult> SessionDatabase::resultHeads(std::int64_t campaign, const std::string& kind) const {
  std::vector<StoredResult> list;
  for (UnreadResult& result : selectResults(campaign, kind, "order by id", false))
    list.push_back(std::move(result.head));
  return list;
}

StoredResult UnreadResult::read() const {
  StoredResult result = head;
  result.payload = parsed(database, payload, "a result");
  return result;
}

nlohmann::json SessionDatabase::payload(std::int64_t result) const {
  return guarded(file_, [&] {
    const long long key = result;
    std::string text = "null";
    connection_->sql << "select payload from result where id = :i", soci::use(key), soci::into(text);
    return parsed(file_, text, "a result");
  });
}

std::vector<std::string> SessionDatabase::resultKinds(std::int64_t campaign) const {
  return guarded(file_, [&] {
    const long long key = campaign;
    std::vector<std::string> kinds;
    const soci::rowset<std::string> rows =
        (connection_->sql.prepare << "select distinct kind from result where campaign = :c", soci::use(key));
    for (const std::string& kind : rows) kinds.push_back(kind);
    return kinds;
  });
}

std::vector<UnreadResult> SessionDatabase::selectResults(std::int64_t campaign, const std::string& kind,
                                                         const char* order, bool with_payload) const {
  return guarded(file_, [&] {
    const long long key = campaign;
    std::vector<UnreadResult> list;
    const soci::rowset<soci::row> rows =
        (connection_->sql.prepare << std::string("select cast(id as text), kind, program_version, created_utc, "
                                                 "inputs_fingerprint, inputs, options") +
                                         (with_payload ? ", payload" : ", 'null'") +
                                         std::string(" from result where campaign = :c and (:k1 = '' or kind = :k2) ") +
                                         order,
         soci::use(key), soci::use(kind), soci::use(kind));
    for (const soci::row& row : rows) {
      StoredResult result;
      result.id = std::stoll(row.get<std::string>(0));
      result.campaign = campaign;
      result.kind = row.get<std::string>(1);
      result.provenance.program_version = row.get<std::string>(2);
      result.provenance.created_utc = row.get<std::string>(3);
      result.provenance.inputs_fingerprint = row.get<std::string>(4);
      result.provenance.inputs = parsed(file_, row.get<std::string>(5), "inputs");
      result.provenance.options = parsed(file_, row.get<std::string>(6), "options");
      // Of what somebody else wrote nobody knows what it was made from.
      for (nlohmann::json* part : {&result.provenance.inputs, &result.provenance.options})
        if (!part->is_object()) *part = nlohmann::json::object();
      list.push_back({std::move(result), row.get<std::string>(7), file_});
    }
    return list;
  });
}

std::size_t SessionDatabase::countResults(std::int64_t campaign) const {
  return guarded(file_, [&] {
    const long long key = campaign;
    long long count = 0;
    connection_->sql << "select count(*) from result where campaign = :c", soci::use(key), soci::into(count);
    return static_cast<std::size_t>(count);
  });
}

void SessionDatabase::removeResult(std::int64_t id) {
  writing([&] {
    const long long key = id;
    connection_->sql << "delete from result where id = :i", soci::use(key);
  });
}

void SessionDatabase::exclude(std::int64_t campaign, const std::vector<Exclusion>& items, const std::string& now_utc) {
  writing([&] {
    const long long key = campaign;
    soci::session& sql = connection_->sql;
    soci::transaction transaction(sql);
    for (const Exclusion& e : items) {
      if (e.reason.empty()) {
        sql << "delete from exclusion where campaign = :c and item = :i", soci::use(key), soci::use(e.item);
        continue;
      }
      sql << "insert into exclusion (campaign, item, reason, created_utc) values (:c, :i, :r, :t) on conflict "
             "(campaign, item) do update set reason = excluded.reason, created_utc = excluded.created_utc",
          soci::use(key), soci::use(e.item), soci::use(e.reason), soci::use(now_utc);
    }
    transaction.commit();
  });
}

std::vector<Exclusion> SessionDatabase::exclusions(std::int64_t campaign) const {
  return guarded(file_,
                 [&] {
                   const long long key = campaign;
                   std::vector<Exclusion> list;
                   const soci::rowset<soci::row> rows =
                       (connection_->sql.prepare
                            << "select item, reason, created_utc from exclusion where campaign = :c order by item",
                        soci::use(key));
                   for (const soci::row& row : rows) {
                     list.push_back({row.get<std::string>(0), row.get<std::string>(1), row.get<std::string>(2)});
                   }
                   return list;
                 });
}

std::int64_t SessionDatabase::addNote(std::int64_t campaign, const Note& note) {
  return writing([&] {
    const long long key = campaign;
    soci::session& sql = connection_->sql;
    long long id = note.id;
    if (id == 0) {
      // Above all there are, and above those that are gone: time does not come back.
      const auto now = std::chrono::system_clock::now().time_since_epoch();
      long long last = 0;
      sql << "select coalesce(max(id), 0) from note", soci::into(last);
      id = std::max<long long>(last + 1, std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
    }
    sql << "insert into note (id, campaign, step, text, created_utc, item) values (:n, :c, :s, :x, :t, :i)",
        soci::use(id), soci::use(key), soci::use(note.step), soci::use(note.text), soci::use(note.created_utc),
        soci::use(note.item);
    return static_cast<std::int64_t>(id);
  });
}

void SessionDatabase::removeNote(std::int64_t id) {
  writing([&] {
    const long long key = id;
    connection_->sql << "delete from note where id = :i", soci::use(key);
  });
}

std::vector<Note> SessionDatabase::notes(std::int64_t campaign) const {
  return guarded(file_,
                 [&] {
                   const long long key = campaign;
                   std::vector<Note> list;
                   const soci::rowset<soci::row> rows =
                       (connection_->sql.prepare
                            << "select cast(id as text), step, text, created_utc, item from note where campaign = :c "
                               "order by id",
                        soci::use(key));
                   for (const soci::row& row : rows) {
                     list.push_back({std::stoll(row.get<std::string>(0)), row.get<std::string>(1),
                                     row.get<std::string>(2), row.get<std::string>(3), row.get<std::string>(4)});
                   }
                   return list;
                 });
}

void SessionDatabase::setSetting(const std::string& key, const std::string& json) {
  writing([&] {
    connection_->sql << "insert into setting (name, value) values (:n, :v) on conflict (name) do update set value = "
                        "excluded.value",
        soci::use(key), soci::use(json);
  });
}

std::optional<nlohmann::json> SessionDatabase::setting(const std::string& key) const {
  return guarded(file_, [&]() -> std::optional<nlohmann::json> {
    std::string value;
    soci::session& sql = connection_->sql;
    sql << "select value from setting where name = :n", soci::use(key), soci::into(value);
    if (!sql.got_data()) return std::nullopt;
    return parsed(file_, value, fmt::format("a setting ({})", key));
  });
}

}  // namespace spindrift
