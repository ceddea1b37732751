// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/evaluate_scans.h"

namespace spindrift {

InstrumentEvaluation evaluateScans(const Campaign& campaign, const std::string& /*scan_model*/, JobContext& /*job*/) {
  throw InputError({campaign.folder, ""}, "these captures cannot be evaluated by this version.");
}

}  // namespace spindrift
