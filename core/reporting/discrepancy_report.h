// SPDX-License-Identifier: Apache-2.0
// The story of a discrepancy for people: verdict, effects with evidence, time courses before and after, points, places
// and steps. Deviations um or urad, times h. One self-contained file, or the same parts inside a larger report.
#pragma once

#include <string>

#include "core/discrepancy/discrepancy.h"
#include "core/reporting/html_document.h"

namespace spindrift {

/// Adds the story below the present section of a document.
void addDiscrepancyStory(HtmlDocument& document, const DiscrepancyInput& input, const DiscrepancyResult& result);

[[nodiscard]] std::string discrepancyReport(const std::string& campaign, const DiscrepancyInput& input,
                                            const DiscrepancyResult& result);

}  // namespace spindrift
