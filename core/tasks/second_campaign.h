// SPDX-License-Identifier: Apache-2.0
// A campaign that the work on another one needs (before and after a compensation): as its session sees it, with the
// machine as edited, the clocks moved and what the user excluded left out, if it is one of the session's; else as its
// files say.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/tasks/campaign_state.h"
#include "core/tasks/task_work.h"

namespace spindrift {

class SecondCampaign {
 public:
  /// Takes what the session knows of it; the thread of the session. The campaign at hand may be its own second one: it
  /// is taken as it is at hand. Throws InputError.
  [[nodiscard]] static SecondCampaign of(const TaskGraph& graph, const TaskInputs& inputs,
                                         const std::filesystem::path& folder);

  struct Measured {
    std::shared_ptr<const Campaign> campaign;
    ObservationSet observations;  ///< what was taken while compensating included
  };
  /// Its own observations, those of an evaluation that still holds, or its captures evaluated. Any thread. Throws
  /// InputError, Cancelled.
  [[nodiscard]] Measured measured(JobContext& job) const;

 private:
  std::filesystem::path folder_;
  std::shared_ptr<const Campaign> campaign_;  ///< null: not of the session
  ExcludedItems excluded_;
  ClockOffsets clocks_;
  std::shared_ptr<const StoredEvaluation> evaluation_;  ///< null: none that holds
};

/// Of all that decides what SecondCampaign gives: content of files, machine, clocks and exclusions of a campaign of the
/// session other than `own` (whose inputs are those of its results anyway: empty). Of a folder outside it names, sizes
/// and times of its files and lists; images and clouds are taken to be written once.
[[nodiscard]] std::string fingerprintOfSecond(const Session& session, std::int64_t own,
                                              const std::filesystem::path& folder);

}  // namespace spindrift
