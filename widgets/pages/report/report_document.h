// SPDX-License-Identifier: GPL-3.0-or-later
// The HTML report as pages: the same layout on screen and in the PDF, figures as vector.
//
// Lengths in px of a page of A4 at 96 dpi.
#pragma once

#include <QString>
#include <QTextDocument>
#include <memory>
#include <vector>

#include "core/base/job_context.h"
#include "widgets/pages/report/report_builder.h"
#include "widgets/pages/report/report_style.h"

class QPainter;

namespace spindrift::gui {

class ReportDocument {
 public:
  /// Throws InputError if the text is no report. On any thread of Qt; the document stays on it, as its fonts do.
  explicit ReportDocument(const QString& html);
  ~ReportDocument();

  static constexpr int page_width = report_style::page_width;
  static constexpr int page_height = report_style::page_height;

  [[nodiscard]] const QString& title() const { return outline_.title; }
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
  [[nodiscard]] int figureCount() const { return outline_.figures; }
  [[nodiscard]] int tableCount() const { return outline_.tables; }

 private:
  void keepHeadingsWithText();

  ReportOutline outline_;
  std::unique_ptr<QTextDocument> document_;
};

}  // namespace spindrift::gui
