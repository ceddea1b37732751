// SPDX-License-Identifier: Apache-2.0
// One process that works on a batch: claim a chunk, work its items out, store, until nothing is free. The same on a
// desk and on a cluster.
//
// A heartbeat on a connection of its own extends the lease every third of it. A store that is away for a while is
// waited for: nothing that was worked out is lost by it. An item that takes longer than the plan allows is asked to
// stop; one that does not is left behind with its process, which ends with exit status `gave_up`.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "core/base/job_context.h"
#include "core/plant/batch_queue.h"

namespace spindrift {

/// The work on one item; `attempt` is that of its chunk.
using ItemWork = std::function<nlohmann::json(const BatchPlan& plan, std::int64_t item, int attempt, JobContext& job)>;

struct WorkerOptions {
  std::string engine = "local";
  std::string worker;        ///< empty: workerName()
  double budget_s = 0.0;     ///< no new chunk is claimed after this time; 0: no limit
  double patience_s = 60.0;  ///< how long a store that is away is waited for
  double patience_pause_s = 0.05;
  const std::atomic<bool>* stop = nullptr;  ///< asked to stop: what was claimed is given back
  ItemWork work;                            ///< empty: workOut
};

struct WorkerReport {
  std::int64_t chunks = 0;
  std::int64_t items = 0;
  std::int64_t dropped = 0;  ///< chunks whose claim did not hold any more
  bool stopped = false;
};

inline constexpr int gave_up = 75;  ///< exit status; Slurm requeues it

/// Names this process among all computers that share a store; the same again for a task that Slurm restarts.
[[nodiscard]] std::string workerName();

/// Throws InputError: another program version, files of the plan are not here, the store is away for too long.
WorkerReport workOnBatch(const PlantAddress& address, std::int64_t batch, const WorkerOptions& options);

}  // namespace spindrift
