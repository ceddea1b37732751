// SPDX-License-Identifier: GPL-3.0-or-later
// The HTML report as pages: the same layout on screen and in the PDF, figures as vector.
//
// Reads what HtmlDocument of core/reporting writes (headings, paragraphs, verdicts, tables, figures with inline SVG or
// embedded pictures); an element it does not know becomes plain text. Lengths in px of a page of A4 at 96 dpi.
#pragma once

#include <QString>
#include <QTextDocument>
#include <memory>
#include <vector>

#include "core/base/job_context.h"

class QPainter;

namespace spindrift::gui {

class ReportDocument {
 public:
  /// Throws InputError if the text is no report. On any thread of Qt; the document stays on it, as its fonts do.
  explicit ReportDocument(const QString& html);
  ~ReportDocument();

  static constexpr int page_width = 794;
  static constexpr int page_height = 1123;

  [[nodiscard]] const QString& title() const { return title_; }
  [[nodiscard]] int pageCount() const;
  /// One page with header and footer, always black on white.
  void drawPage(QPainter& painter, int page) const;
  /// Throws InputError if the file cannot be written, and Cancelled between two pages; no file is left then.
  void writePdf(const QString& file, const JobContext& job = {}) const;

  struct Heading {
    QString text;
    int page = 0;
  };
  /// Sections in order, with the page each begins on.
  [[nodiscard]] std::vector<Heading> sections() const;
  [[nodiscard]] int figureCount() const { return figures_; }
  [[nodiscard]] int tableCount() const { return tables_; }

 private:
  class Builder;
  void keepHeadingsWithText();

  QString title_;
  QString subtitle_;
  std::unique_ptr<QTextDocument> document_;
  std::vector<int> headings_;  ///< block numbers, sections and subsections
  std::vector<int> sections_;
  int figures_ = 0;
  int tables_ = 0;
};

}  // namespace spindrift::gui
