// SPDX-License-Identifier: Apache-2.0
// The user action "find what the simulation lacks": campaign folder in, result and files out. Units as in FORMATS.md.
#pragma once

#include <filesystem>

#include "core/base/job_context.h"
#include "core/discrepancy/discrepancy.h"

namespace spindrift {

struct DiscrepancyRequest {
  std::filesystem::path campaign;
  std::filesystem::path observations;  ///< empty: the campaign's own, else its captures evaluated in memory
  DiscrepancyOptions options;
  std::filesystem::path model_out;   ///< empty: not written
  std::filesystem::path prediction;  ///< time_s,point,component,predicted of the completed model
  std::filesystem::path html;
};

struct DiscrepancyRun {
  DiscrepancyInput input;
  DiscrepancyResult result;
  std::vector<std::string> notes;  ///< what was left out and why

  /// The JSON of FORMATS.md; `gap` also holds peak-to-peak and fit, as the report has them.
  [[nodiscard]] nlohmann::json json() const;
};

/// The search on a campaign in memory, with the observations given in place of its own.
[[nodiscard]] DiscrepancyRun searchDiscrepancy(const Campaign& campaign, ObservationSet observations,
                                               const DiscrepancyOptions& options, JobContext& job);

/// Throws InputError; nothing is written then. The campaign folder is never written to.
[[nodiscard]] DiscrepancyRun runDiscrepancy(const DiscrepancyRequest& request, JobContext& job);

}  // namespace spindrift
