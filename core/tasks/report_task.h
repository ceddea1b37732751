// SPDX-License-Identifier: Apache-2.0
// The report of a campaign of a session: the window and the command line make the same one, from what the session
// keeps, and file it in the same place.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/reporting/report_language.h"
#include "core/tasks/campaign_state.h"
#include "core/workflows/report_workflow.h"

namespace spindrift {

/// The files of a report, by their names in the session's folder.
struct WrittenReport {
  std::string html, pdf;
  std::size_t bytes = 0;  ///< of the HTML
  int figures = 0;
  int tables = 0;
  /// The same in another language, where the program that wrote it has one.
  struct Translation {
    std::string language;  ///< ISO 639-1
    std::string html, pdf;
  };
  std::optional<Translation> translation;
  /// Payload of its result: file, pdf, bytes, figures, tables, and translations: a language -> file, pdf.
  [[nodiscard]] nlohmann::json json() const;
};

/// Everything a report is made of, copied: to be worked on by any thread.
struct ReportTask {
  /// With the effects as edited and the captures that were excluded; `run` marks what was of its own observations.
  std::shared_ptr<const Campaign> campaign;
  ReportOptions options;
  std::filesystem::path folder;  ///< of the session
  std::string name;              ///< of the files in it, without their ending

  /// Of the graph's campaign as it is now. Writes the effects as edited into the session's folder.
  [[nodiscard]] static ReportTask of(const TaskGraph& graph, const ExcludedItems& excluded);
  /// Writes the report as HTML and PDF into the session, in English and in the language that the program offers.
  /// Throws InputError and Cancelled; the files of an earlier report stay then.
  [[nodiscard]] WrittenReport run(JobContext& job) const;
  /// What stays as it is in every language.
  [[nodiscard]] ReportNames namesThatPeopleGave() const;
};

}  // namespace spindrift
