// SPDX-License-Identifier: Apache-2.0
// A report as a file: one HTML file or pages of a PDF, by the ending of its name.
#pragma once

#include <string>

#include "core/base/job_context.h"
#include "core/reporting/report.h"

namespace spindrift {

/// Whether a report in this file is pages (.pdf) or HTML (.html, .htm). Throws InputError for another ending.
[[nodiscard]] bool isReportPdf(const std::string& file);

/// Writes the report as its ending says and gives its size in bytes. Throws InputError: the ending, or a file that
/// cannot be written; Cancelled.
std::size_t writeReportFile(const Report& report, const std::string& file, const JobContext& job = {});

}  // namespace spindrift
