// SPDX-License-Identifier: Apache-2.0
// The work on one item of a batch (batch_plan.h says which works there are): the same functions that the commands of
// these names call, so that an answer in the store is what the command says alone.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/plant/batch_plan.h"

namespace spindrift {

/// Works out one item. Throws InputError (the item's data), Cancelled (asked to stop), or anything else.
[[nodiscard]] nlohmann::json workOut(const BatchPlan& plan, std::int64_t item, JobContext& job);

/// Runs a program and gives what it printed. Throws InputError: it cannot be started, or ended otherwise than with 0 or
/// 1; Cancelled: the job was cancelled, and the program is ended with all it started.
[[nodiscard]] std::string outputOf(const std::vector<std::string>& command, const JobContext& job);

}  // namespace spindrift
