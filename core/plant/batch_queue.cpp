// SPDX-License-Identifier: Apache-2.0
#include "core/plant/batch_queue.h"

#include <fmt/format.h>

#include <algorithm>

#include <soci/soci.h>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/plant/plant_connection.h"
#include "core/plant/publish.h"

namespace spindrift {
namespace {

/// "1 h 20 min", "45 s"
std::string duration(double s) {
  if (s < 120.0) return fmt::format("{:.0f} s", s);
  if (s < 7200.0) return fmt::format("{:.0f} min", s / 60.0);
  return fmt::format("{:.1f} h", s / 3600.0);
}

}  // namespace

nlohmann::json BatchState::json() const {
  return {{"id", id},
          {"name", name},
          {"work", work},
          {"program", program},
          {"submitter", submitter},
          {"cancelled", cancelled},
          {"items", items},
          {"answered", answered},
          {"failed_items", failed_items},
          {"chunks", chunks},
          {"open_chunks", open},
          {"running_chunks", running},
          {"free_chunks", free},
          {"failed_chunks", failed},
          {"attempts", attempts},
          {"lost_attempts", lost},
          {"work_s", jsonNumber(work_s)},
          {"spent_s", jsonNumber(spent_s)},
          {"remaining_s", remaining_s > 0.0 ? nlohmann::json(remaining_s) : nlohmann::json()},
          {"error", error.empty() ? nlohmann::json() : nlohmann::json(error)}};
}

std::string BatchState::summary() const {
  std::string text = fmt::format("batch {} \"{}\" ({}): {} of {}", id, name, work, answered, countOf(items, "item"));
  if (failed_items > 0) text += fmt::format(", {} failed", failed_items);
  if (cancelled) text += ", cancelled";
  if (idle()) text += ", nothing works on it";
  if (running > 0) text += fmt::format(", {} running", countOf(running, "chunk"));
  text += fmt::format("; {} of work", duration(work_s));
  if (lost > 0) text += fmt::format(", {} lost", countOf(lost, "attempt"));
  if (remaining_s > 0.0) text += fmt::format(", about {} left", duration(remaining_s));
  if (!error.empty()) text += "\nfailed for good: " + error;
  return text + "\n";
}

std::int64_t BatchQueue::submit(const BatchPlan& plan) {
  store_.require(PlantRole::Owner, "starting a batch");
  PlantConnection& c = store_.connection();
  const std::string text = plan.json().dump();
  const std::string key = sha256(text + SPINDRIFT_VERSION);
  const double now_s = c.now();
  return c.writing([&] {
    soci::session& sql = c.sql();
    const long long items = plan.items();
    const std::string submitter = plantPublisher();
    const std::string program = SPINDRIFT_VERSION;
    soci::statement insert =
        (sql.prepare << "insert into batch (plan_sha256, plan, name, program, items, lease_s, retries, submitted_s, "
                        "submitter) values (:k, :p, :n, :v, :i, :l, :r, :t, :s) on conflict (plan_sha256) do nothing",
         soci::use(key), soci::use(text), soci::use(plan.name), soci::use(program), soci::use(items),
         soci::use(plan.lease_s), soci::use(plan.retries), soci::use(now_s), soci::use(submitter));
    insert.execute(true);
    const bool made = insert.get_affected_rows() == 1;
    long long id = 0;
    sql << "select id from batch where plan_sha256 = :k", soci::use(key), soci::into(id);
    if (made) {
      long long no = 0;
      long long first = 0;
      long long count = 0;
      soci::statement add =
          (sql.prepare << "insert into chunk (batch_id, chunk_no, first_item, items) values (:b, :c, :f, "
                          ":n)",
           soci::use(id), soci::use(no), soci::use(first), soci::use(count));
      for (; first < items; first += plan.chunk, ++no) {
        count = std::min<long long>(plan.chunk, items - first);
        add.execute(true);
      }
    }
    return static_cast<std::int64_t>(id);
  });
}

std::int64_t BatchQueue::find(const std::string& number_or_name) {
  PlantConnection& c = store_.connection();
  return c.guarded([&] {
    long long id = 0;
    c.sql() << "select id from batch where name = :n or cast(id as text) = :m order by id desc limit 1",
        soci::use(number_or_name), soci::use(number_or_name), soci::into(id);
    if (c.sql().got_data()) return static_cast<std::int64_t>(id);
    std::vector<std::string> names;
    for (const BatchState& s : all()) names.push_back(fmt::format("{} ({})", s.id, s.name));
    throw InputError({store_.address(), ""}, fmt::format("holds no batch \"{}\"; allowed: {}.", number_or_name,
                                                         names.empty() ? "none yet" : shortenedList(names)));
  });
}

BatchPlan BatchQueue::plan(std::int64_t batch) {
  PlantConnection& c = store_.connection();
  const std::string text = c.guarded([&] {
    const long long id = batch;
    std::string found;
    c.sql() << "select plan from batch where id = :i", soci::use(id), soci::into(found);
    return found;
  });
  return BatchPlan::parse(text, "plan of the batch");
}

BatchState BatchQueue::state(std::int64_t batch) {
  PlantConnection& c = store_.connection();
  return c.guarded([&] {
    soci::session& sql = c.sql();
    const long long id = batch;
    BatchState s;
    s.id = batch;
    std::string plan;
    int cancelled = 0;
    long long items = 0;
    sql << "select name, program, submitter, cancelled, items, plan from batch where id = :i", soci::use(id),
        soci::into(s.name), soci::into(s.program), soci::into(s.submitter), soci::into(cancelled), soci::into(items),
        soci::into(plan);
    if (!sql.got_data()) throw InputError({store_.address(), ""}, fmt::format("holds no batch {}.", batch));
    s.cancelled = cancelled != 0;
    s.items = items;
    s.work = BatchPlan::parse(plan, "plan of the batch").work;
    long long chunks = 0;
    long long open = 0;
    long long free = 0;
    long long failed = 0;
    const double now_s = c.now();
    long long in_failed = 0;
    sql << "select count(*), coalesce(sum(case when state in ('ready', 'running') then 1 else 0 end), 0), "
           "coalesce(sum(case when state = 'ready' or (state = 'running' and lease_until_s < :t) then 1 else 0 end), "
           "0), "
           "coalesce(sum(case when state = 'failed' then 1 else 0 end), 0), cast(coalesce(sum(case when state = "
           "'failed' then items else 0 end), 0) as bigint), "
           "coalesce(max(case when state = 'failed' then error else '' end), '') from chunk where batch_id = :i",
        soci::use(now_s), soci::use(id), soci::into(chunks), soci::into(open), soci::into(free), soci::into(failed),
        soci::into(in_failed), soci::into(s.error);
    long long answered = 0;
    long long failed_items = 0;
    sql << "select count(*), coalesce(sum(failed), 0), coalesce(sum(work_s), 0.0) from item_result where batch_id = :i",
        soci::use(id), soci::into(answered), soci::into(failed_items), soci::into(s.work_s);
    long long attempts = 0;
    long long lost = 0;
    sql << "select count(*), coalesce(sum(case when outcome = 'lost' then 1 else 0 end), 0), coalesce(sum(case when "
           "work_s > 0 then work_s when ended_s > started_s then ended_s - started_s else 0.0 end), 0.0) from attempt "
           "where batch_id = :i",
        soci::use(id), soci::into(attempts), soci::into(lost), soci::into(s.spent_s);
    s.chunks = chunks;
    s.open = open;
    s.running = open - free;
    s.free = free;
    s.failed = failed;
    s.answered = answered;
    s.failed_items = failed_items + in_failed;
    s.attempts = attempts;
    s.lost = lost;
    if (s.running > 0 && answered > 0)
      s.remaining_s = s.work_s / static_cast<double>(answered) * static_cast<double>(items - answered - in_failed) /
                      static_cast<double>(s.running);
    return s;
  });
}

std::vector<BatchState> BatchQueue::all() {
  PlantConnection& c = store_.connection();
  const std::vector<long long> ids = c.guarded([&] {
    std::vector<long long> found;
    long long id = 0;
    soci::statement select = (c.sql().prepare << "select id from batch order by id desc", soci::into(id));
    select.execute();
    while (select.fetch()) found.push_back(id);
    return found;
  });
  std::vector<BatchState> states;
  for (const long long id : ids) states.push_back(state(id));
  return states;
}

std::vector<std::string> BatchQueue::workers(std::int64_t batch) {
  PlantConnection& c = store_.connection();
  const double now_s = c.now();
  return c.guarded([&] {
    const long long id = batch;
    std::vector<std::string> names;
    std::string name;
    soci::statement select = (c.sql().prepare << "select distinct worker from chunk where batch_id = :i and state = "
                                                 "'running' and lease_until_s >= :t",
                              soci::use(id), soci::use(now_s), soci::into(name));
    select.execute();
    while (select.fetch()) names.push_back(name);
    return names;
  });
}

void BatchQueue::cancel(std::int64_t batch) {
  store_.require(PlantRole::Writer, "cancelling a batch");
  PlantConnection& c = store_.connection();
  c.writing([&] {
    const long long id = batch;
    c.sql() << "update batch set cancelled = 1 where id = :i", soci::use(id);
  });
}

void BatchQueue::resume(std::int64_t batch) {
  store_.require(PlantRole::Writer, "resuming a batch");
  PlantConnection& c = store_.connection();
  c.writing([&] {
    const long long id = batch;
    c.sql() << "update batch set cancelled = 0 where id = :i", soci::use(id);
    c.sql() << "update chunk set state = 'ready', failures = 0, error = '' where batch_id = :i and state = 'failed'",
        soci::use(id);
    if (store_.role() < PlantRole::Owner) return;
    // Items with an error in place of an answer: their chunks are worked out again as a whole.
    c.sql() << "update chunk set state = 'ready', failures = 0, error = '' where batch_id = :i and state = 'done' and "
               "exists (select 1 from item_result r where r.batch_id = chunk.batch_id and r.failed = 1 and r.item >= "
               "chunk.first_item and r.item < chunk.first_item + chunk.items)",
        soci::use(id);
    c.sql() << "delete from item_result where batch_id = :i and exists (select 1 from chunk k where k.batch_id = "
               "item_result.batch_id and k.state = 'ready' and item_result.item >= k.first_item and item_result.item < "
               "k.first_item + k.items)",
        soci::use(id);
  });
}

std::optional<BatchClaim> BatchQueue::claim(std::int64_t batch, const std::string& worker, const std::string& engine) {
  store_.require(PlantRole::Writer, "working on a batch");
  PlantConnection& c = store_.connection();
  const double now_s = c.now();
  return c.writing([&] { return claimWithin(batch, worker, engine, now_s); });
}

std::optional<BatchClaim> BatchQueue::claimWithin(std::int64_t batch, const std::string& worker,
                                                  const std::string& engine, double now_s) {
  PlantConnection& c = store_.connection();
  soci::session& sql = c.sql();
  const long long id = batch;
  std::string program;
  int cancelled = 0;
  int retries = 0;
  double lease_s = 0.0;
  sql << "select program, cancelled, retries, lease_s from batch where id = :i", soci::use(id), soci::into(program),
      soci::into(cancelled), soci::into(retries), soci::into(lease_s);
  if (!sql.got_data()) throw InputError({store_.address(), ""}, fmt::format("holds no batch {}.", batch));
  if (program != SPINDRIFT_VERSION)
    throw InputError(
        fmt::format("Batch {} was started with program version {}, this worker has {}; allowed: workers of "
                    "the same version, for results of two versions do not mix.",
                    batch, program, SPINDRIFT_VERSION));
  if (cancelled != 0) return std::nullopt;
  for (;;) {
    long long no = 0;
    long long first = 0;
    long long items = 0;
    int attempt = 0;
    int failures = 0;
    std::string state;
    // What this worker holds without knowing it (its last transaction counted, and nobody told it) comes first.
    sql << "select chunk_no, first_item, items, attempt, failures, 'ready' from chunk where batch_id = :i and state = "
           "'running' and worker = :w and lease_until_s >= :t",
        soci::use(id), soci::use(worker), soci::use(now_s), soci::into(no), soci::into(first), soci::into(items),
        soci::into(attempt), soci::into(failures), soci::into(state);
    if (!sql.got_data())
      sql << "select chunk_no, first_item, items, attempt, failures, state from chunk where batch_id = :i and (state = "
             "'ready' or (state = 'running' and lease_until_s < :t)) and state in ('ready', 'running') order by "
             "chunk_no "
             "limit 1" +
                 std::string(c.postgres() ? " for update skip locked" : ""),
          soci::use(id), soci::use(now_s), soci::into(no), soci::into(first), soci::into(items), soci::into(attempt),
          soci::into(failures), soci::into(state);
    if (!sql.got_data()) return std::nullopt;
    if (state == "running") {
      // Its worker has vanished.
      sql << "update attempt set ended_s = :t, outcome = 'lost' where batch_id = :i and chunk_no = :c and attempt = "
             ":a "
             "and outcome = ''",
          soci::use(now_s), soci::use(id), soci::use(no), soci::use(attempt);
      if (++failures > retries) {
        const std::string error =
            fmt::format("{} workers vanished over items {} to {}", failures, first, first + items - 1);
        sql << "update chunk set state = 'failed', failures = :f, error = :e where batch_id = :i and chunk_no = :c",
            soci::use(failures), soci::use(error), soci::use(id), soci::use(no);
        continue;
      }
    }
    ++attempt;
    const double until_s = now_s + lease_s;
    sql << "update chunk set state = 'running', attempt = :a, failures = :f, worker = :w, lease_until_s = :l where "
           "batch_id = :i and chunk_no = :c",
        soci::use(attempt), soci::use(failures), soci::use(worker), soci::use(until_s), soci::use(id), soci::use(no);
    sql << "insert into attempt (batch_id, chunk_no, attempt, worker, engine, started_s) values (:i, :c, :a, :w, :e, "
           ":t)",
        soci::use(id), soci::use(no), soci::use(attempt), soci::use(worker), soci::use(engine), soci::use(now_s);
    return BatchClaim{batch, no, first, items, attempt, failures >= retries};
  }
}

bool BatchQueue::extend(const BatchClaim& claim) {
  PlantConnection& c = store_.connection();
  const double now_s = c.now();
  return c.writing([&] {
    const long long id = claim.batch;
    const long long no = claim.chunk;
    int cancelled = 0;
    double lease_s = 0.0;
    c.sql() << "select cancelled, lease_s from batch where id = :i", soci::use(id), soci::into(cancelled),
        soci::into(lease_s);
    const double until_s = now_s + lease_s;
    soci::statement update =
        (c.sql().prepare
             << "update chunk set lease_until_s = :t where batch_id = :i and chunk_no = :c and attempt = :a and "
                "state = 'running'",
         soci::use(until_s), soci::use(id), soci::use(no), soci::use(claim.attempt));
    update.execute(true);
    return cancelled == 0 && update.get_affected_rows() == 1;
  });
}

bool BatchQueue::finish(const BatchClaim& claim, ChunkOutcome outcome, const std::vector<ItemAnswer>& answers,
                        const std::string& error, double spent_s) {
  PlantConnection& c = store_.connection();
  const double now_s = c.now();
  return c.writing([&] { return finishWithin(claim, outcome, answers, error, spent_s, now_s); });
}

BatchQueue::Finished BatchQueue::finishAndClaim(const BatchClaim& claim, ChunkOutcome outcome,
                                                const std::vector<ItemAnswer>& answers, const std::string& error,
                                                double spent_s, const std::string& worker, const std::string& engine) {
  PlantConnection& c = store_.connection();
  const double now_s = c.now();
  return c.writing([&] {
    Finished done;
    done.held = finishWithin(claim, outcome, answers, error, spent_s, now_s);
    done.next = claimWithin(claim.batch, worker, engine, now_s);
    return done;
  });
}

bool BatchQueue::finishWithin(const BatchClaim& claim, ChunkOutcome outcome, const std::vector<ItemAnswer>& answers,
                              const std::string& error, double spent_s, double now_s) {
  soci::session& sql = store_.connection().sql();
  const long long id = claim.batch;
  const long long no = claim.chunk;
  const std::string state = outcome == ChunkOutcome::Done                       ? "done"
                            : outcome == ChunkOutcome::Failed && claim.last_try ? "failed"
                                                                                : "ready";
  const int counts = outcome == ChunkOutcome::Failed ? 1 : 0;
  // The fence: locks the row; an older token stores nothing.
  soci::statement fence =
      (sql.prepare << "update chunk set state = :s, failures = failures + :f, error = :e, lease_until_s = 0 where "
                      "batch_id = :i and chunk_no = :c and attempt = :a and state = 'running'",
       soci::use(state), soci::use(counts), soci::use(error), soci::use(id), soci::use(no), soci::use(claim.attempt));
  fence.execute(true);
  if (fence.get_affected_rows() != 1) {
    // Stored by us before a commit that nobody answered?
    std::string was;
    int attempt = 0;
    sql << "select state, attempt from chunk where batch_id = :i and chunk_no = :c", soci::use(id), soci::use(no),
        soci::into(was), soci::into(attempt);
    return attempt == claim.attempt && was == state && state == "done";
  }
  if (outcome == ChunkOutcome::Done) {
    long long item = 0;
    double work_s = 0.0;
    int failed = 0;
    std::string answer;
    soci::statement insert =
        (sql.prepare
             << "insert into item_result (batch_id, item, attempt, work_s, failed, answer) values (:b, :i, :a, :w, "
                ":f, :t)",
         soci::use(id), soci::use(item), soci::use(claim.attempt), soci::use(work_s), soci::use(failed),
         soci::use(answer));
    for (const ItemAnswer& a : answers) {
      item = a.item;
      work_s = a.work_s;
      failed = a.failed ? 1 : 0;
      answer = a.answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
      insert.execute(true);
    }
  }
  const std::string word = outcome == ChunkOutcome::Done     ? "done"
                           : outcome == ChunkOutcome::Failed ? "failed"
                                                             : "released";
  sql << "update attempt set ended_s = :t, outcome = :o, error = :e, work_s = :s where batch_id = :i and chunk_no = :c "
         "and attempt = :a",
      soci::use(now_s), soci::use(word), soci::use(error), soci::use(spent_s), soci::use(id), soci::use(no),
      soci::use(claim.attempt);
  return true;
}

void BatchQueue::releaseDead(std::int64_t batch, const std::string& worker) {
  PlantConnection& c = store_.connection();
  c.writing([&] {
    const long long id = batch;
    // The next claim finds the lease run out, and counts.
    c.sql() << "update chunk set lease_until_s = 0 where batch_id = :i and worker = :w and state = 'running'",
        soci::use(id), soci::use(worker);
  });
}

void BatchQueue::answers(std::int64_t batch, const std::function<void(const ItemAnswer&)>& each) {
  PlantConnection& c = store_.connection();
  c.guarded([&] {
    const long long id = batch;
    long long item = 0;
    int failed = 0;
    std::string text;
    ItemAnswer a;
    soci::statement select =
        (c.sql().prepare << "select item, work_s, failed, answer from item_result where batch_id = :i order by item",
         soci::use(id), soci::into(item), soci::into(a.work_s), soci::into(failed), soci::into(text));
    select.execute();
    while (select.fetch()) {
      a.item = item;
      a.failed = failed != 0;
      a.answer = nlohmann::json::parse(text, nullptr, false);
      each(a);
    }
  });
}

}  // namespace spindrift
