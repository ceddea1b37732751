// SPDX-License-Identifier: Apache-2.0
#include "core/plant/plant_schema.h"

#include <fmt/format.h>

#include <iterator>
#include <string>

#include <soci/soci.h>

namespace spindrift {
namespace {

/// One statement for both: {id} is a number that the database gives, never twice.
void run(PlantConnection& c, std::string statement) {
  const std::string id =
      c.postgres() ? "bigint generated always as identity primary key" : "integer primary key autoincrement";
  for (std::size_t at; (at = statement.find("{id}")) != std::string::npos;) statement.replace(at, 4, id);
  c.sql() << statement;
}

/// Machines, campaigns, results.
void makeVersion1(PlantConnection& c) {
  run(c,
      "create table machine (id {id}, name text not null unique, description text not null, every_days double "
      "precision not null default 0)");
  run(c,
      "create table machine_event (id {id}, machine_id bigint not null references machine(id), time_s double precision "
      "not null, kind text not null, note text not null, author text not null, entered_s double precision not null, "
      "unique (machine_id, time_s, kind, note))");
  run(c,
      "create table campaign (id {id}, machine_id bigint not null references machine(id), fingerprint text not null, "
      "name text not null, start_s double precision not null, program_version text not null, publisher text not null, "
      "published_s double precision not null, clock_offset_s double precision not null, unique (machine_id, "
      "fingerprint))");
  run(c, "create index campaign_by_time on campaign (machine_id, start_s)");
  run(c,
      "create table capture (campaign_id bigint not null references campaign(id), address text not null, sha256 text "
      "not null, primary key (campaign_id, address, sha256))");
  run(c,
      "create table result (id {id}, campaign_id bigint not null references campaign(id), content_key text not null, "
      "kind text not null, program_version text not null, created_utc text not null, inputs_fingerprint text not null, "
      "options text not null, verdict text not null, covariance text not null, model text not null, publisher text not "
      "null, published_s double precision not null, unique (campaign_id, content_key))");
  // Lists read verdicts from here alone: rows of results are as wide as their models.
  run(c, "create index result_verdicts on result (campaign_id, id, verdict)");
  run(c,
      "create table parameter (result_id bigint not null references result(id), place integer not null, state text not "
      "null, name text not null, value double precision not null, sigma double precision not null, primary key "
      "(result_id, place))");
}

/// Batches: the plan, its queue of chunks, who tried what, and each result once.
void makeVersion2(PlantConnection& c) {
  run(c,
      "create table batch (id {id}, plan_sha256 text not null unique, plan text not null, name text not null, program "
      "text not null, items bigint not null, lease_s double precision not null, retries integer not null, "
      "cancelled integer not null default 0, submitted_s double precision not null, submitter text not null)");
  run(c,
      "create table chunk (batch_id bigint not null references batch(id), chunk_no bigint not null, first_item bigint "
      "not null, items bigint not null, state text not null default 'ready' check (state in "
      "('ready','running','done','failed')), attempt integer not null default 0, failures integer not null default 0, "
      "worker text not null default '', lease_until_s double precision not null default 0, error text not null default "
      "'', primary key (batch_id, chunk_no))");
  run(c, "create index chunk_open on chunk (batch_id, chunk_no) where state in ('ready', 'running')");
  run(c,
      "create table attempt (batch_id bigint not null, chunk_no bigint not null, attempt integer not null, worker text "
      "not null, engine text not null, started_s double precision not null, ended_s double precision not null default "
      "0, outcome text not null default '', error text not null default '', work_s double precision not null default "
      "0, primary key (batch_id, chunk_no, attempt))");
  run(c,
      "create table item_result (batch_id bigint not null, item bigint not null, attempt integer not null, work_s "
      "double precision not null, failed integer not null default 0, answer text not null, primary key (batch_id, "
      "item))");
}

/// Which result of a kind holds: the last that was published as the one that does, also where the store had it already.
/// A row for every change, never changed: who says what holds stays known.
void makeVersion3(PlantConnection& c) {
  run(c,
      "create table standing (id {id}, campaign_id bigint not null references campaign(id), kind text not null, "
      "result_id bigint not null references result(id), verdict text not null, publisher text not null, published_s "
      "double precision not null)");
  run(c, "create index standing_of_kind on standing (campaign_id, kind, id, result_id)");
  // Lists read verdicts from here alone: rows of results are as wide as their models.
  run(c, "drop index result_verdicts");
  run(c, "create index standing_verdicts on standing (campaign_id, id, verdict)");
  run(c,
      "insert into standing (campaign_id, kind, result_id, verdict, publisher, published_s) select campaign_id, kind, "
      "id, verdict, publisher, published_s from result order by id");
}

using Migration = void (*)(PlantConnection&);
constexpr Migration migrations[] = {makeVersion1, makeVersion2, makeVersion3};
static_assert(std::size(migrations) == newest_plant_schema);

bool hasTable(PlantConnection& c, const std::string& name) {
  int found = 0;
  if (c.postgres())
    c.sql() << "select count(*)::int from pg_catalog.pg_tables where schemaname = 'plant' and tablename = :n "
               "and has_schema_privilege(schemaname, 'usage')",
        soci::use(name), soci::into(found);
  else
    c.sql() << "select count(*) from sqlite_master where type = 'table' and name = :n", soci::use(name),
        soci::into(found);
  return found > 0;
}

int versionOf(PlantConnection& c) {
  if (!hasTable(c, "plant_schema")) return 0;
  int version = 0;
  c.sql() << "select version from plant_schema", soci::into(version);
  return version;
}

/// Readers and writers are groups of the server; each person's role becomes a member of one of them.
void grantRights(PlantConnection& c) {
  soci::session& sql = c.sql();
  sql << "do $$ declare r text; begin foreach r in array array['plant_reader', 'plant_writer'] loop "
         "if not exists (select from pg_catalog.pg_roles where rolname = r) then "
         "if (select rolcreaterole or rolsuper from pg_catalog.pg_roles where rolname = current_user) then "
         "execute format('create role %I nologin', r); else continue; end if; end if; "
         "execute format('grant usage on schema plant to %I', r); "
         "execute format('grant select on all tables in schema plant to %I', r); "
         "if r = 'plant_writer' then "
         "grant insert on machine, machine_event, campaign, capture, result, parameter, standing, attempt, "
         "item_result to plant_writer; "
         "grant update (every_days, description) on machine to plant_writer; "
         "grant update (cancelled) on batch to plant_writer; "
         "grant update (state, attempt, failures, worker, lease_until_s, error) on chunk to plant_writer; "
         "grant update (ended_s, outcome, error, work_s) on attempt to plant_writer; "
         "end if; end loop; end $$";
}

}  // namespace

int plantSchemaVersion(PlantConnection& c) {
  return c.guarded([&] { return versionOf(c); });
}

void migratePlant(PlantConnection& c) {
  c.writing([&] {
    if (c.postgres()) {
      long long locked = 0;
      c.sql() << "select 1 from pg_advisory_xact_lock(7301742)", soci::into(locked);
      c.sql() << "create schema if not exists plant";
    }
    int version = versionOf(c);
    if (version >= newest_plant_schema) return;
    if (version == 0) {
      c.sql() << "create table plant_schema (version integer not null)";
      c.sql() << "insert into plant_schema (version) values (0)";
    }
    while (version < newest_plant_schema) migrations[version++](c);
    c.sql() << fmt::format("update plant_schema set version = {}", newest_plant_schema);
    if (c.postgres()) grantRights(c);
  });
}

}  // namespace spindrift
