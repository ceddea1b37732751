// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/models/session_model.h"

namespace spindrift::gui {

/// Makes it the campaign at hand at once, without the job of the window: for what happens in the middle of others.
inline void selectCampaign(SessionModel& session, std::int64_t campaign) {
  JobContext job;
  session.take(session.reading(campaign).read(job));
}

}  // namespace spindrift::gui
