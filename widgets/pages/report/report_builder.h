// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the HTML that HtmlDocument of core/reporting makes (headings, paragraphs, verdicts, tables, figures with
// inline SVG or embedded pictures) into a text document; an element it does not know becomes plain text.
#pragma once

#include <QString>
#include <QTextDocument>
#include <vector>

#include "widgets/pages/report/report_figure.h"

namespace spindrift::gui {

/// What the report is made of, by numbers of blocks in the document.
struct ReportOutline {
  QString title;
  QString subtitle;
  std::vector<int> headings;  ///< sections, subsections and captions of tables: to be kept with what follows
  std::vector<int> sections;
  int figures = 0;
  int tables = 0;
};

/// `main`: what stands inside the <main> element. The document has to be empty; a place to sign is added at its end.
/// Throws InputError if the text is no report.
[[nodiscard]] ReportOutline buildReport(const QString& main, QTextDocument& document, ReportFigures& figures);

}  // namespace spindrift::gui
