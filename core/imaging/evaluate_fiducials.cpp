// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/evaluate_fiducials.h"

namespace spindrift {

InstrumentEvaluation evaluateFiducials(const Campaign& campaign, JobContext& /*job*/) {
  throw InputError({campaign.folder, ""}, "these captures cannot be evaluated by this version.");
}

}  // namespace spindrift
