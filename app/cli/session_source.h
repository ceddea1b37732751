// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign of a session of the desktop program, for commands that also take the folder of a campaign: they ask the
// same tasks as the window, re-use what still holds, and file what they work out where the window does.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/job_context.h"
#include "core/tasks/campaign_state.h"

namespace spindrift::cli {

/// Whether a folder is that of a session.
[[nodiscard]] bool isSession(const std::filesystem::path& folder);

class SessionSource {
 public:
  /// `campaign`: its name; empty: the one that was at hand last. Files are held against what results were made from.
  /// Throws InputError.
  SessionSource(const std::filesystem::path& folder, const std::string& campaign, JobContext& job);

  [[nodiscard]] TaskGraph tasks() const { return state_.tasks(session_, ledger_); }
  [[nodiscard]] const CampaignState& state() const { return state_; }
  /// Files a result that was made from `origin`, and takes it as the latest.
  void keep(const ResultOrigin& origin, const nlohmann::json& payload);
  /// Evaluates the captures, unless the evaluation that the session keeps still holds: then false.
  bool evaluate(JobContext& job);

 private:
  Session session_;
  CampaignState state_;
  TaskLedger ledger_;
};

}  // namespace spindrift::cli
