// SPDX-License-Identifier: Apache-2.0
// The report of a campaign of a session: the window and the command line make the same one, from what the session
// keeps, and file it in the same place.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/tasks/campaign_state.h"
#include "core/workflows/report_workflow.h"

namespace spindrift {

/// Everything a report is made of, copied: to be worked on by any thread.
struct ReportTask {
  std::shared_ptr<const Campaign> campaign;  ///< with the effects as edited; what was excluded is marked
  ReportOptions options;
  std::filesystem::path folder;  ///< of the session
  std::string name;              ///< of the files in it, without their ending

  /// Of the graph's campaign as it is now. Writes the effects as edited into the session's folder.
  [[nodiscard]] static ReportTask of(const TaskGraph& graph, const ExcludedItems& excluded);
  /// Writes the report as HTML and PDF into the session; returns the payload of its result: file, pdf, bytes, figures,
  /// tables. Throws InputError and Cancelled; the files of an earlier report stay then.
  [[nodiscard]] nlohmann::json run(JobContext& job) const;
};

}  // namespace spindrift
