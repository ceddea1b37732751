// SPDX-License-Identifier: Apache-2.0
#include "core/plant/plant_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>

#include <soci/soci.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/base/utc_time.h"
#include "core/plant/plant_connection.h"
#include "core/plant/plant_schema.h"

namespace spindrift {
namespace {

/// What two clocks may differ by without a word, s: what is measured lasts longer.
constexpr double clock_tolerance_s = 60.0;
/// How far ahead of the store's clock a campaign may start, s.
constexpr double future_tolerance_s = 300.0;

/// Of a standing s: nothing of its kind was published of the campaign since.
constexpr std::string_view in_force =
    "not exists (select 1 from standing t where t.campaign_id = s.campaign_id and t.kind = s.kind and t.id > s.id)";

nlohmann::json parsedText(const std::string& text, const std::string& address) {
  nlohmann::json out = deepestJson(text) <= most_levels_of_json ? nlohmann::json::parse(text, nullptr, false)
                                                                : nlohmann::json(nlohmann::json::value_t::discarded);
  if (out.is_discarded()) throw InputError({address, ""}, "the plant store holds a value that is not JSON.");
  return out;
}

}  // namespace

PlantStore::PlantStore(std::unique_ptr<PlantConnection> connection, const PlantOpening& opening)
    : connection_(std::move(connection)) {
  checkVersion();
  findRole(opening.as);
  checkClock(opening);
}

PlantStore::PlantStore(PlantStore&&) noexcept = default;
PlantStore& PlantStore::operator=(PlantStore&&) noexcept = default;
PlantStore::~PlantStore() = default;

std::string PlantStore::address() const {
  return connection_->address().text();
}

PlantStore PlantStore::make(const PlantAddress& address, const PlantOpening& opening) {
  auto connection = std::make_unique<PlantConnection>(address, true, false);
  if (const int version = plantSchemaVersion(*connection); version < newest_plant_schema) migratePlant(*connection);
  return {std::move(connection), opening};
}

PlantStore PlantStore::open(const PlantAddress& address, const PlantOpening& opening) {
  return {std::make_unique<PlantConnection>(address, false, opening.as == PlantRole::Reader), opening};
}

PlantStore PlantStore::openOrMake(const PlantAddress& address, const PlantOpening& opening) {
  return address.kind == PlantAddress::Kind::Sqlite && opening.as != PlantRole::Reader ? make(address, opening)
                                                                                       : open(address, opening);
}

void PlantStore::checkVersion() {
  const int version = plantSchemaVersion(*connection_);
  if (version == newest_plant_schema) return;
  const SourcePlace place{address(), ""};
  if (version == 0)
    throw InputError(place,
                     "holds no plant store, or none that this role may see; its owner makes one with plant init.");
  if (version > newest_plant_schema)
    throw InputError(place, fmt::format("has schema version {}; allowed: 1 to {}. A newer program has changed it: "
                                        "install the newer version.",
                                        version, newest_plant_schema));
  throw InputError(place, fmt::format("has schema version {}, older than this program's {}; its owner brings it up to "
                                      "date with plant init.",
                                      version, newest_plant_schema));
}

void PlantStore::findRole(PlantRole at_most) {
  PlantRole allowed = PlantRole::Reader;
  if (connection_->postgres()) {
    int writes = 0;
    int owns = 0;
    connection_->guarded([&] {
      connection_->sql() << "select has_table_privilege('plant.campaign', 'insert')::int, pg_has_role(current_user, "
                            "(select tableowner from pg_catalog.pg_tables where schemaname = 'plant' and tablename = "
                            "'campaign'), 'member')::int",
          soci::into(writes), soci::into(owns);
    });
    allowed = owns != 0 ? PlantRole::Owner : writes != 0 ? PlantRole::Writer : PlantRole::Reader;
  } else {
    const std::string file = connection_->address().file.string();
    struct stat found {};
    if (::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) == 0 && ::stat(file.c_str(), &found) == 0)
      allowed = found.st_uid == ::geteuid() || ::geteuid() == 0 ? PlantRole::Owner : PlantRole::Writer;
  }
  role_ = std::min(allowed, at_most);
}

void PlantStore::checkClock(const PlantOpening& opening) {
  const double here_s = opening.clock ? opening.clock() : systemNow();
  if (connection_->postgres()) {
    clock_offset_s_ = here_s - connection_->now();
  } else {
    double newest_s = 0.0;
    connection_->guarded(
        [&] { connection_->sql() << "select coalesce(max(published_s), 0.0) from campaign", soci::into(newest_s); });
    clock_offset_s_ = std::min(0.0, here_s - newest_s);
  }
  if (std::abs(clock_offset_s_) <= clock_tolerance_s) return;
  warnings_.push_back(
      fmt::format("The clock of this computer is {:.0f} s {} that of the plant store; set it right, or "
                  "campaigns that start here get a wrong place in trends.",
                  std::abs(clock_offset_s_), clock_offset_s_ > 0.0 ? "ahead of" : "behind"));
}

void PlantStore::require(PlantRole needed, std::string_view what) const {
  if (role_ >= needed) return;
  throw InputError({address(), ""},
                   fmt::format("the role here is {}, and {} needs {} {}; nothing was stored.", toString(role_), what,
                               needed == PlantRole::Owner ? "an" : "a", toString(needed)));
}

// Writing -----------------------------------------------------------------------------------------------------------

/// The statements of one publishing, each prepared once: over a network, and beside others, what counts is how often
/// the server is asked.
class PlantStore::Publishing {
 public:
  Publishing(soci::session& sql, double now_s, double clock_offset_s)
      : sql_(sql),
        now_s_(now_s),
        clock_offset_s_(clock_offset_s),
        insert_campaign_(
            (sql.prepare << "insert into campaign (machine_id, fingerprint, name, start_s, program_version, publisher, "
                            "published_s, clock_offset_s) values (:m, :f, :n, :s, :v, :p, :t, :o) on conflict "
                            "(machine_id, fingerprint) do nothing returning id",
             soci::use(machine_), soci::use(campaign_.fingerprint), soci::use(campaign_.name),
             soci::use(campaign_.start_s), soci::use(campaign_.program_version), soci::use(campaign_.publisher),
             soci::use(now_s_), soci::use(clock_offset_s_), soci::into(id_))),
        insert_result_((
            sql.prepare << "insert into result (campaign_id, content_key, kind, program_version, created_utc, "
                           "inputs_fingerprint, options, verdict, covariance, model, publisher, published_s) values "
                           "(:c, :k, :d, :v, :t, :f, :o, :w, :x, :m, :p, :q) on conflict (campaign_id, content_key) do "
                           "nothing returning id",
            soci::use(campaign_id_), soci::use(key_), soci::use(result_.kind), soci::use(result_.program_version),
            soci::use(result_.created_utc), soci::use(result_.inputs_fingerprint), soci::use(options_),
            soci::use(result_.verdict), soci::use(covariance_), soci::use(model_), soci::use(campaign_.publisher),
            soci::use(now_s_), soci::into(id_))),
        insert_standing_(
            (sql.prepare << "insert into standing (campaign_id, kind, result_id, verdict, publisher, published_s) "
                            "select r.campaign_id, r.kind, r.id, r.verdict, :p, :q from result r where r.campaign_id = "
                            ":c and r.content_key = :k and r.id <> coalesce((select s.result_id from standing s where "
                            "s.campaign_id = r.campaign_id and s.kind = r.kind order by s.id desc limit 1), 0) "
                            "returning id",
             soci::use(campaign_.publisher), soci::use(now_s_), soci::use(campaign_id_), soci::use(key_),
             soci::into(standing_))) {}

  void publish(const PlantCampaign& campaign, PublishCount& count) {
    campaign_ = campaign;
    machine_ = machineOf(campaign);
    id_ = 0;
    // Somebody else may be publishing it at this moment: then this waits for them, and it is there.
    if (insert_campaign_.execute(true)) {
      ++count.campaigns_new;
      campaign_id_ = id_;
    } else {
      ++count.campaigns_there;
      sql_ << "select id from campaign where machine_id = :m and fingerprint = :f", soci::use(machine_),
          soci::use(campaign_.fingerprint), soci::into(campaign_id_);
    }
    addCaptures();
    for (const PlantResult& result : campaign.results) {
      result_ = result;
      key_ = result.key();
      options_ = result.options.dump();
      covariance_ = result.covariance.dump();
      model_ = result.model.dump();
      const bool added = insert_result_.execute(true);
      ++(added ? count.results_new : count.results_there);
      if (added) addParameters(id_);
      // What is published holds, be it new or one that held before.
      if (insert_standing_.execute(true) && !added) ++count.results_again;
    }
  }

 private:
  /// As many rows in one statement as stand in `items`, prepared once for each number of them.
  template <typename Item>
  struct Rows {
    long long owner = 0;
    std::vector<Item> items;
    std::vector<int> places;
    std::unique_ptr<soci::statement> insert;
  };
  static constexpr std::size_t most_rows = 100;

  /// `columns` rows of (:a0, :b0), (:a1, :b1), ...
  static std::string values(const std::vector<std::string>& columns, std::size_t rows) {
    std::string text;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t c = 0; c < columns.size(); ++c)
        text += (c > 0 ? ", :" : i > 0 ? ", (:" : "(:") + columns[c] + std::to_string(i);
      text += ")";
    }
    return text;
  }

  long long machineOf(const PlantCampaign& campaign) {
    const auto known = machines_.find(campaign.machine);
    if (known != machines_.end()) return known->second;
    const std::string description = campaign.description.dump();
    sql_ << "insert into machine (name, description) values (:n, :d) on conflict (name) do nothing",
        soci::use(campaign.machine), soci::use(description);
    long long machine = 0;
    sql_ << "select id from machine where name = :n", soci::use(campaign.machine), soci::into(machine);
    return machines_[campaign.machine] = machine;
  }

  void addCaptures() {
    for (std::size_t from = 0; from < campaign_.captures.size(); from += most_rows) {
      const std::size_t count = std::min(most_rows, campaign_.captures.size() - from);
      Rows<PlantCapture>& rows = captures_[count];
      rows.items.resize(count);
      if (!rows.insert) {
        rows.insert = std::make_unique<soci::statement>(sql_);
        rows.insert->alloc();
        for (PlantCapture& c : rows.items) {
          rows.insert->exchange(soci::use(rows.owner));
          rows.insert->exchange(soci::use(c.address));
          rows.insert->exchange(soci::use(c.sha256));
        }
        rows.insert->prepare("insert into capture (campaign_id, address, sha256) values " +
                             values({"c", "a", "s"}, count) + " on conflict do nothing");
        rows.insert->define_and_bind();
      }
      rows.owner = campaign_id_;
      std::copy_n(campaign_.captures.begin() + static_cast<std::ptrdiff_t>(from), count, rows.items.begin());
      rows.insert->execute(true);
    }
  }

  void addParameters(long long result) {
    for (std::size_t from = 0; from < result_.parameters.size(); from += most_rows) {
      const std::size_t count = std::min(most_rows, result_.parameters.size() - from);
      Rows<PlantParameter>& rows = parameters_[count];
      rows.items.resize(count);
      rows.places.resize(count);
      if (!rows.insert) {
        rows.insert = std::make_unique<soci::statement>(sql_);
        rows.insert->alloc();
        for (std::size_t i = 0; i < count; ++i) {
          PlantParameter& p = rows.items[i];
          rows.insert->exchange(soci::use(rows.owner));
          rows.insert->exchange(soci::use(rows.places[i]));
          rows.insert->exchange(soci::use(p.state));
          rows.insert->exchange(soci::use(p.name));
          rows.insert->exchange(soci::use(p.value));
          rows.insert->exchange(soci::use(p.standard_uncertainty));
        }
        rows.insert->prepare("insert into parameter (result_id, place, state, name, value, sigma) values " +
                             values({"r", "i", "s", "n", "v", "u"}, count));
        rows.insert->define_and_bind();
      }
      rows.owner = result;
      for (std::size_t i = 0; i < count; ++i) {
        rows.places[i] = static_cast<int>(from + i);
        rows.items[i] = result_.parameters[from + i];
      }
      rows.insert->execute(true);
    }
  }

  soci::session& sql_;
  double now_s_;
  double clock_offset_s_;
  PlantCampaign campaign_;
  PlantResult result_;
  std::string key_, options_, covariance_, model_;
  long long machine_ = 0;
  long long campaign_id_ = 0;
  long long id_ = 0;
  long long standing_ = 0;
  std::map<std::string, long long> machines_;
  std::map<std::size_t, Rows<PlantCapture>> captures_;
  std::map<std::size_t, Rows<PlantParameter>> parameters_;
  soci::statement insert_campaign_;
  soci::statement insert_result_;
  soci::statement insert_standing_;
};

PublishCount PlantStore::publish(std::span<const PlantCampaign> campaigns) {
  require(PlantRole::Writer, "publishing");
  // The clock of the store, as far as one is known: a campaign from a computer whose clock is wrong is told from one
  // that lies in the future.
  const double now_s = connection_->postgres() ? connection_->now() : systemNow();
  for (const PlantCampaign& campaign : campaigns) {
    if (campaign.start_s > now_s + future_tolerance_s)
      throw InputError(
          fmt::format("The campaign {} of {} starts at {}, which is {:.0f} s after the clock of the plant "
                      "store; set the clock of the computer that measured right, or start_utc in "
                      "campaign.json. Nothing was stored.",
                      campaign.name, campaign.machine, utcText(campaign.start_s), campaign.start_s - now_s));
  }
  return connection_->writing([&] {
    PublishCount count;
    Publishing publishing(connection_->sql(), now_s, clock_offset_s_);
    for (const PlantCampaign& campaign : campaigns) publishing.publish(campaign, count);
    return count;
  });
}

std::int64_t PlantStore::machineId(const std::string& name) {
  long long id = 0;
  connection_->sql() << "select id from machine where name = :n", soci::use(name), soci::into(id);
  if (connection_->sql().got_data()) return id;
  std::vector<std::string> names;
  for (const PlantMachine& m : machines()) names.push_back(m.name);
  throw InputError({address(), ""},
                   fmt::format("holds no machine \"{}\"; allowed: {}.", name,
                               names.empty() ? "none yet, publish a campaign of it first" : shortenedList(names)));
}

void PlantStore::addEvent(const MachineEvent& event) {
  require(PlantRole::Writer, "entering an event");
  const auto& kinds = eventKinds();
  if (std::find(kinds.begin(), kinds.end(), event.kind) == kinds.end())
    throw InputError(fmt::format("\"{}\" is not a kind of event; allowed: {}.", event.kind, joinedList(kinds, "or")));
  connection_->writing([&] {
    const long long machine = machineId(event.machine);
    const double now_s = systemNow();
    connection_->sql() << "insert into machine_event (machine_id, time_s, kind, note, author, entered_s) values (:m, "
                          ":t, :k, :n, :a, :e) on conflict (machine_id, time_s, kind, note) do nothing",
        soci::use(machine), soci::use(event.time_s), soci::use(event.kind), soci::use(event.note),
        soci::use(event.author), soci::use(now_s);
  });
}

void PlantStore::setInterval(const std::string& machine, double every_days) {
  require(PlantRole::Writer, "setting an interval");
  if (!(every_days >= 0.0) || every_days > 36'500.0)
    throw InputError(fmt::format("An interval of {} days is not allowed; allowed: 0 (not said) to 36500.", every_days));
  connection_->writing([&] {
    const long long id = machineId(machine);
    connection_->sql() << "update machine set every_days = :d where id = :m", soci::use(every_days), soci::use(id);
  });
}

// Reading -----------------------------------------------------------------------------------------------------------

std::vector<PlantMachine> PlantStore::machines() {
  return connection_->guarded([&] {
    std::vector<PlantMachine> list;
    long long id = 0;
    long long campaigns = 0;
    PlantMachine m;
    const std::string query = fmt::format(
        "select m.id, m.name, m.every_days, count(c.id), coalesce(min(c.start_s), 0.0), "
        "coalesce(max(c.start_s), 0.0), coalesce((select s.verdict from standing s where s.verdict <> '' and "
        "s.campaign_id = (select k.id from campaign k where k.machine_id = m.id order by k.start_s desc, "
        "k.id desc limit 1) and {} order by s.id desc limit 1), '') from machine m left join campaign c on "
        "c.machine_id = m.id group by m.id, m.name, m.every_days order by m.name",
        in_force);
    soci::statement select =
        (connection_->sql().prepare << query, soci::into(id), soci::into(m.name), soci::into(m.every_days),
         soci::into(campaigns), soci::into(m.first_s), soci::into(m.last_s), soci::into(m.last_verdict));
    select.execute();
    while (select.fetch()) {
      m.id = id;
      m.campaigns = static_cast<std::size_t>(campaigns);
      list.push_back(m);
    }
    return list;
  });
}

PlantMachine PlantStore::machine(const std::string& name) {
  for (const PlantMachine& m : machines()) {
    if (m.name == name) return m;
  }
  return connection_->guarded([&]() -> PlantMachine {
    (void)machineId(name);
    throw InputError({address(), ""}, fmt::format("holds no machine \"{}\".", name));
  });
}

std::vector<PlantListing> PlantStore::campaigns(const std::string& machine) {
  return connection_->guarded([&] {
    std::vector<PlantListing> list;
    long long id = 0;
    int results = 0;
    PlantListing c;
    if (!machine.empty()) (void)machineId(machine);
    const std::string query = fmt::format(
        "select c.id, m.name, c.name, c.start_s, c.program_version, c.publisher, c.fingerprint, coalesce("
        "(select s.verdict from standing s where s.campaign_id = c.id and s.verdict <> '' and {} order by "
        "s.id desc limit 1), ''), (select count(*) from result r where r.campaign_id = c.id) from campaign c "
        "join machine m on m.id = c.machine_id where (:a = '' or m.name = :b) order by m.name, c.start_s, "
        "c.id",
        in_force);
    soci::statement select =
        (connection_->sql().prepare << query, soci::use(machine), soci::use(machine), soci::into(id),
         soci::into(c.machine), soci::into(c.name), soci::into(c.start_s), soci::into(c.program_version),
         soci::into(c.publisher), soci::into(c.fingerprint), soci::into(c.verdict), soci::into(results));
    select.execute();
    while (select.fetch()) {
      c.id = id;
      c.results = results;
      list.push_back(c);
    }
    return list;
  });
}

std::map<std::string, std::vector<double>> PlantStore::starts() {
  return connection_->guarded([&] {
    std::map<std::string, std::vector<double>> found;
    std::string machine;
    double start_s = 0.0;
    soci::statement select =
        (connection_->sql().prepare << "select m.name, c.start_s from campaign c join machine m on m.id "
                                       "= c.machine_id order by c.machine_id, c.start_s",
         soci::into(machine), soci::into(start_s));
    select.execute();
    while (select.fetch()) found[machine].push_back(start_s);
    return found;
  });
}

std::vector<MachineEvent> PlantStore::events(const std::string& machine) {
  return connection_->guarded([&] {
    std::vector<MachineEvent> list;
    const long long id = machineId(machine);
    MachineEvent e;
    e.machine = machine;
    soci::statement select =
        (connection_->sql().prepare << "select time_s, kind, note, author from machine_event where "
                                       "machine_id = :m order by time_s, id",
         soci::use(id), soci::into(e.time_s), soci::into(e.kind), soci::into(e.note), soci::into(e.author));
    select.execute();
    while (select.fetch()) list.push_back(e);
    return list;
  });
}

std::vector<TrendName> PlantStore::trendNames(const std::string& machine) {
  return connection_->guarded([&] {
    std::vector<TrendName> list;
    const long long id = machineId(machine);
    long long values = 0;
    TrendName n;
    soci::statement select =
        (connection_->sql().prepare
             << "select r.kind, p.name, count(distinct r.campaign_id) from campaign c join result r "
                "on r.campaign_id = c.id join parameter p on p.result_id = r.id where "
                "c.machine_id = :m group by r.kind, p.name order by r.kind, p.name",
         soci::use(id), soci::into(n.kind), soci::into(n.name), soci::into(values));
    select.execute();
    while (select.fetch()) {
      n.values = static_cast<std::size_t>(values);
      list.push_back(n);
    }
    return list;
  });
}

std::vector<TrendPoint> PlantStore::trend(const std::string& machine, const std::string& kind, const std::string& name,
                                          const std::string& state) {
  return connection_->guarded([&] {
    std::vector<TrendPoint> list;
    const long long machine_id = machineId(machine);
    long long id = 0;
    TrendPoint p;
    soci::statement select =
        (connection_->sql().prepare
             << "select c.id, c.name, c.start_s, p.value, p.sigma from campaign c join result r on r.id = (select "
                "s.result_id from standing s where s.campaign_id = c.id and s.kind = :k order by s.id desc limit 1) "
                "join parameter p on p.result_id = r.id and "
                "p.place = (select max(q.place) from parameter q where q.result_id = r.id and q.name = :n and (:s = '' "
                "or q.state = :t)) where c.machine_id = :m order by c.start_s, c.id",
         soci::use(kind), soci::use(name), soci::use(state), soci::use(state), soci::use(machine_id), soci::into(id),
         soci::into(p.campaign_name), soci::into(p.time_s), soci::into(p.value), soci::into(p.standard_uncertainty));
    select.execute();
    while (select.fetch()) {
      p.campaign = id;
      list.push_back(p);
    }
    return list;
  });
}

std::optional<PlantModel> PlantStore::newestModel(const std::string& machine) {
  return connection_->guarded([&]() -> std::optional<PlantModel> {
    const long long id = machineId(machine);
    PlantModel m;
    std::string text;
    const std::string query = fmt::format(
        "select c.name, c.start_s, r.kind, r.model from campaign c join standing s on s.campaign_id = c.id "
        "join result r on r.id = s.result_id where c.machine_id = :m and r.model <> 'null' and {} order by "
        "c.start_s desc, s.id desc limit 1",
        in_force);
    connection_->sql() << query, soci::use(id), soci::into(m.campaign_name), soci::into(m.time_s), soci::into(m.kind),
        soci::into(text);
    if (!connection_->sql().got_data()) return std::nullopt;
    m.model = parsedText(text, address());
    return m;
  });
}

PlantCampaign PlantStore::campaign(std::int64_t wanted) {
  return connection_->guarded([&] {
    const long long id = wanted;
    soci::session& sql = connection_->sql();
    PlantCampaign c;
    std::string description;
    sql << "select m.name, m.description, c.name, c.start_s, c.fingerprint, c.program_version, c.publisher from "
           "campaign "
           "c join machine m on m.id = c.machine_id where c.id = :i",
        soci::use(id), soci::into(c.machine), soci::into(description), soci::into(c.name), soci::into(c.start_s),
        soci::into(c.fingerprint), soci::into(c.program_version), soci::into(c.publisher);
    if (!sql.got_data())
      throw InputError({address(), ""},
                       fmt::format("holds no campaign {}; allowed: a number that plant list shows.", id));
    c.description = parsedText(description, address());
    PlantCapture capture;
    soci::statement captures =
        (sql.prepare << "select address, sha256 from capture where campaign_id = :i order by address, sha256",
         soci::use(id), soci::into(capture.address), soci::into(capture.sha256));
    captures.execute();
    while (captures.fetch()) c.captures.push_back(capture);
    std::vector<long long> keys;
    {
      long long key = 0;
      PlantResult r;
      std::string options;
      std::string covariance;
      std::string model;
      soci::statement results =
          (sql.prepare
               << "select id, kind, program_version, created_utc, inputs_fingerprint, options, verdict, covariance, "
                  "model from result where campaign_id = :i order by id",
           soci::use(id), soci::into(key), soci::into(r.kind), soci::into(r.program_version), soci::into(r.created_utc),
           soci::into(r.inputs_fingerprint), soci::into(options), soci::into(r.verdict), soci::into(covariance),
           soci::into(model));
      results.execute();
      while (results.fetch()) {
        keys.push_back(key);
        r.options = parsedText(options, address());
        r.covariance = parsedText(covariance, address());
        r.model = parsedText(model, address());
        c.results.push_back(r);
      }
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
      PlantParameter p;
      soci::statement parameters =
          (sql.prepare << "select state, name, value, sigma from parameter where result_id = :r order by place",
           soci::use(keys[i]), soci::into(p.state), soci::into(p.name), soci::into(p.value),
           soci::into(p.standard_uncertainty));
      parameters.execute();
      while (parameters.fetch()) c.results[i].parameters.push_back(p);
    }
    return c;
  });
}

}  // namespace spindrift
