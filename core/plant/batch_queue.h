// SPDX-License-Identifier: Apache-2.0
// The queue of a batch in the plant store. The database is the truth; engines only place processes.
//
// Items are claimed in chunks. Each claim raises the chunk's attempt, its fencing token: what is stored under an older
// token is dropped, so that every item has exactly one answer, whoever was frozen, killed or overtaken. A claim holds
// for a lease, which a heartbeat extends; a chunk whose lease has run out is claimed by anybody. Claims take FOR UPDATE
// SKIP LOCKED on PostgreSQL and the write lock on SQLite.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/plant/batch_plan.h"
#include "core/plant/plant_store.h"

namespace spindrift {

struct BatchClaim {
  std::int64_t batch = 0;
  std::int64_t chunk = 0;
  std::int64_t first_item = 0;
  std::int64_t items = 0;
  int attempt = 0;        ///< the fencing token
  bool last_try = false;  ///< what fails now has failed for good
};

struct ItemAnswer {
  std::int64_t item = 0;
  double work_s = 0.0;
  bool failed = false;  ///< `answer` is {"error":"sentence"}
  nlohmann::json answer;
};

enum class ChunkOutcome {
  Done,
  Failed,    ///< to be tried again, as long as there are retries
  Released,  ///< given back politely; does not count
};

struct BatchState {
  std::int64_t id = 0;
  std::string name;
  std::string work;
  std::string program;
  std::string submitter;
  bool cancelled = false;
  std::int64_t items = 0;
  std::int64_t answered = 0;      ///< items with an answer, failed ones among them
  std::int64_t failed_items = 0;  ///< with an error in place of an answer, or in a chunk that has failed for good
  std::int64_t chunks = 0;
  std::int64_t open = 0;     ///< chunks that are to be worked on
  std::int64_t running = 0;  ///< of them, those that a worker holds whose lease has not run out
  std::int64_t free = 0;     ///< and those that can be claimed
  std::int64_t failed = 0;   ///< chunks that failed for good
  std::int64_t attempts = 0;
  std::int64_t lost = 0;     ///< attempts whose worker vanished
  double work_s = 0.0;       ///< time spent on answers that count
  double spent_s = 0.0;      ///< time of all attempts that ended, the lost ones too
  double remaining_s = 0.0;  ///< about what the rest takes on as many workers as run now; 0: not known
  std::string error;         ///< of a chunk that failed for good
  [[nodiscard]] bool finished() const { return open == 0; }
  /// Something is open and nobody works on it.
  [[nodiscard]] bool idle() const { return open > 0 && running == 0 && !cancelled; }
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
};

class BatchQueue {
 public:
  explicit BatchQueue(PlantStore& store) : store_(store) {}

  /// The same plan submitted twice is one batch: its number is returned. Throws InputError: not an owner.
  std::int64_t submit(const BatchPlan& plan);
  /// By its number, or the newest of a name. Throws InputError with what there is.
  [[nodiscard]] std::int64_t find(const std::string& number_or_name);
  [[nodiscard]] BatchPlan plan(std::int64_t batch);
  [[nodiscard]] BatchState state(std::int64_t batch);
  [[nodiscard]] std::vector<BatchState> all();
  /// Names of those that hold a claim now.
  [[nodiscard]] std::vector<std::string> workers(std::int64_t batch);
  /// Nothing is claimed any more; what runs is dropped at its next heartbeat.
  void cancel(std::int64_t batch);
  /// Goes on after a cancellation, and tries again what has failed for good; items with an error in place of an answer
  /// are tried again for the owner alone, for their answers are taken back.
  void resume(std::int64_t batch);

  /// Nothing if no chunk is free. Throws InputError if this program is not that of the batch.
  [[nodiscard]] std::optional<BatchClaim> claim(std::int64_t batch, const std::string& worker,
                                                const std::string& engine);
  /// Extends the lease. False: the claim does not hold any more.
  [[nodiscard]] bool extend(const BatchClaim& claim);
  /// One transaction, which may be repeated when nobody knows whether it counted. False: the claim did not hold any
  /// more and nothing was stored.
  bool finish(const BatchClaim& claim, ChunkOutcome outcome, const std::vector<ItemAnswer>& answers,
              const std::string& error, double spent_s);
  /// The same, and the next claim in the same transaction: half of what a short chunk costs.
  struct Finished {
    bool held = false;
    std::optional<BatchClaim> next;
  };
  [[nodiscard]] Finished finishAndClaim(const BatchClaim& claim, ChunkOutcome outcome,
                                        const std::vector<ItemAnswer>& answers, const std::string& error,
                                        double spent_s, const std::string& worker, const std::string& engine);
  /// What a worker that is known to be dead had claimed is free at once; counts as a failure.
  void releaseDead(std::int64_t batch, const std::string& worker);
  /// In order of the items.
  void answers(std::int64_t batch, const std::function<void(const ItemAnswer&)>& each);

 private:
  // Within a transaction.
  [[nodiscard]] std::optional<BatchClaim> claimWithin(std::int64_t batch, const std::string& worker,
                                                      const std::string& engine, double now_s);
  [[nodiscard]] bool finishWithin(const BatchClaim& claim, ChunkOutcome outcome, const std::vector<ItemAnswer>& answers,
                                  const std::string& error, double spent_s, double now_s);
  PlantStore& store_;
};

}  // namespace spindrift
