// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign of a session of the desktop program, for commands that also take the folder of a campaign: they run the
// same tasks as the window, re-use what still holds, and file what they work out where the window does.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/job_context.h"
#include "core/tasks/task_chain.h"

namespace spindrift::cli {

/// Whether a folder is that of a session.
[[nodiscard]] bool isSession(const std::filesystem::path& folder);

class SessionSource {
 public:
  /// `campaign`: its name; empty: the one that was at hand last. Files are held against what results were made from.
  /// Throws InputError.
  SessionSource(const std::filesystem::path& folder, const std::string& campaign, JobContext& job);

  [[nodiscard]] CampaignTasks& tasks() { return tasks_; }
  [[nodiscard]] const CampaignState& state() const { return tasks_.state(); }

 private:
  Session session_;
  CampaignTasks tasks_;
};

}  // namespace spindrift::cli
