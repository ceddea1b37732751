// SPDX-License-Identifier: Apache-2.0
#include "core/probing/evaluate_touches.h"

namespace spindrift {

InstrumentEvaluation evaluateTouches(const Campaign& campaign, JobContext& /*job*/) {
  throw InputError({campaign.folder, ""}, "these captures cannot be evaluated by this version.");
}

}  // namespace spindrift
