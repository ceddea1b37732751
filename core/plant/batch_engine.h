// SPDX-License-Identifier: Apache-2.0
// Engines place processes; all of them run the same worker, and the store says what is done.
//
//   local   N processes on this computer; one that dies is replaced, and what it had claimed is free at once
//   slurm   an array of tasks, each the engine above with one process until nothing is free. Slurm may lose what it was
//           given: a controller that is killed forgets what it had not saved yet (5 s), holds tasks that it started
//           twice, takes some for running that have ended, and never starts one again whose process was killed. So the
//           store alone says what is open, and a guard gives Slurm what is missing: a process that waits
//           (runThroughSlurm), or a sweep, a job after the array
//
// Workers end with the process that placed them; what they hold they give back.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
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
  double poll_s = 0.5;       ///< how often the store is asked how far the batch is
  bool stay = true;          ///< until nothing is open; false: until nothing is free, others may still be working
  /// What claims are stored under; "slurm": this process is a task of Slurm, and its one worker has the task's name.
  std::string engine = "local";
};

struct EngineReport {
  int started = 0;  ///< processes, or tasks that were given to Slurm
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
  int round = 1;               ///< in a row that brought no answer
  int rounds = 10;             ///< at most
  std::int64_t answered = -1;  ///< when the last round was given; -1: there was none
  double lease_s = 30.0;
  /// A task that Slurm takes for running is taken away when it has claimed nothing for as long while something was
  /// free.
  double grace_s = 30.0;
  double patience_s = 600.0;  ///< how long a controller that is away is waited for
  std::string program;        ///< spindrift-cli as all nodes see it
};

/// What Slurm holds of a batch.
struct SlurmTasks {
  std::vector<std::string> running;
  int waiting = 0;     ///< will begin by themselves
  std::string reason;  ///< of one that waits, in Slurm's words
  /// Will not begin, or not soon: held, or requeued for later.
  std::vector<std::string> stuck;
};

/// The name of all jobs of a batch: it differs from those of other stores.
[[nodiscard]] std::string slurmName(const PlantAddress& address, std::int64_t batch);

/// Nothing if Slurm is not on this computer or its controller does not answer within `patience_s`.
[[nodiscard]] std::optional<SlurmTasks> tasksInSlurm(const PlantAddress& address, std::int64_t batch,
                                                     double patience_s = 20.0);

/// Gives Slurm the tasks that are missing, and a sweep after them. Returns the number of the array job, "" if none is
/// missing. Throws InputError: sbatch is not there, or refuses (with what it said).
[[nodiscard]] std::string giveToSlurm(const PlantAddress& address, std::int64_t batch, const SlurmOptions& options);

/// Waits until nothing is open, and gives Slurm what is missing as often as that takes. Throws InputError: Slurm does
/// not take the batch, or is away for too long. `refused`: the tasks of `rounds` rounds brought no answer.
[[nodiscard]] EngineReport runThroughSlurm(const PlantAddress& address, std::int64_t batch, const SlurmOptions& options,
                                           JobContext& job);

}  // namespace spindrift
