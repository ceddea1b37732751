// SPDX-License-Identifier: Apache-2.0
// Engines place processes; all of them run the same worker, and the store says what is done.
//
//   local   N processes on this computer; one that dies is replaced, and what it had claimed is free at once
//   slurm   an array of pull tasks, each working until nothing is free, and a sweep after it that asks the store and
//           starts another round while chunks are open (at most `rounds`)
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/plant/batch_queue.h"

namespace spindrift {

struct EngineOptions {
  int processes = 0;  ///< 0: as many as this computer has processors
  /// What starts a worker; the number of the batch and the store's address are appended: PROGRAM batch work.
  std::vector<std::string> worker_command;
  double patience_s = 60.0;  ///< how long a store that is away is waited for
};

struct EngineReport {
  int started = 0;  ///< processes
  int killed = 0;   ///< ended by a signal
  bool stopped = false;
  std::string refused;  ///< why workers refuse to work; empty: they do not
  BatchState state;
};

/// Works on a batch until nothing is open, or the job is cancelled: then workers give back what they hold.
[[nodiscard]] EngineReport runLocally(const PlantAddress& address, std::int64_t batch, const EngineOptions& options,
                                      JobContext& job);

struct SlurmOptions {
  int tasks = 4;
  std::filesystem::path logs;  ///< folder that all nodes see
  int time_limit_min = 0;      ///< of one task; 0: that of the partition
  int round = 1;
  int rounds = 5;
  double lease_s = 30.0;
  std::string program;  ///< spindrift-cli as all nodes see it
};

/// Gives one round to Slurm and returns the number of its array job. Throws InputError: sbatch is not there, or refuses
/// (with what it said).
[[nodiscard]] std::string giveToSlurm(const PlantAddress& address, std::int64_t batch, const SlurmOptions& options);

}  // namespace spindrift
