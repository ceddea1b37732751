// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/report_file.h"

#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/base/error.h"

namespace spindrift {

bool isReportPdf(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending != ".pdf" && ending != ".html" && ending != ".htm")
    throw InputError({file, ""}, "is neither HTML nor PDF by its ending; allowed: a name that ends in .html or .pdf.");
  return ending == ".pdf";
}

std::size_t writeReportFile(const Report& report, const std::string& file, const JobContext& job) {
  const std::string bytes = isReportPdf(file) ? pdfOf(report, job).bytes : htmlOf(report);
  writeFileAtomically(file, bytes);
  return bytes.size();
}

}  // namespace spindrift
