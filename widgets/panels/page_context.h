// SPDX-License-Identifier: GPL-3.0-or-later
// What pages and their panels work with; belongs to the window.
#pragma once

#include <QString>
#include <functional>

#include "widgets/commands/campaign_undo.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/models/session_model.h"
#include "widgets/workflow/workflow.h"

namespace spindrift::gui {

/// What every page and panel works with.
struct PageContext {
  SessionModel& session;
  JobRunner& jobs;
  CampaignUndo& undo;
  Workflow& workflow;
  std::function<void(const QString&)> hint;  ///< a short text at the bottom: the value under the cursor
};

}  // namespace spindrift::gui
