// SPDX-License-Identifier: Apache-2.0
// Markdown as blocks of a report: so a chapter that is written as text gets the look of a report, as HTML and on pages.
//
// What is understood: headings (#, ##, ###; the first is a section, the others are within it), paragraphs, lists (-
// and 1.), callouts (>), code (indented by four blanks, or between ```), tables (|), and figures on a line of their
// own,
// ![caption](name). *, **, ` within a text and the address of a [link](address) are taken away.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/reporting/report.h"

namespace spindrift {

/// The figure of a name; nothing: it is left out.
using FigureOfName = std::function<std::optional<Drawing>(const std::string& name)>;

/// Adds the blocks of `markdown` at the end of the report. Throws InputError for a table whose rows differ in length
/// and for a block of code that does not end.
void addMarkdown(Report& report, std::string_view markdown, const FigureOfName& figures = {});

}  // namespace spindrift
