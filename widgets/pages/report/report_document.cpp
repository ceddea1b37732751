// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/report_document.h"

#include <QAbstractTextDocumentLayout>
#include <QCoreApplication>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <QTextBlock>
#include <QTextCursor>

#include "core/base/error.h"
#include "widgets/pages/report/report_style.h"

namespace spindrift::gui {

using namespace report_style;

namespace {

constexpr int pdf_dpi = 1200;
constexpr double screen_dpi = 96.0;

QString translated(const char* text) {
  return QCoreApplication::translate("ReportDocument", text);
}

}  // namespace

ReportDocument::ReportDocument(const QString& html) : document_(std::make_unique<QTextDocument>()) {
  const qsizetype from = html.indexOf(QLatin1String("<main>"));
  const qsizetype to = html.lastIndexOf(QLatin1String("</main>"));
  if (from < 0 || to < from) throw InputError("this is no report of Spindrift; write the report again.");
  document_->setUndoRedoEnabled(false);
  document_->setUseDesignMetrics(true);
  document_->setDocumentMargin(0);
  document_->setDefaultFont(pageFont(text_px));
  auto* figures = new ReportFigures;
  figures->setParent(document_.get());
  document_->documentLayout()->registerHandler(ReportFigures::object_type, figures);
  outline_ = buildReport(html.mid(from + 6, to - from - 6), *document_, *figures);
  document_->setPageSize({text_width, text_height});
  keepHeadingsWithText();
}

ReportDocument::~ReportDocument() = default;

void ReportDocument::keepHeadingsWithText() {
  constexpr double least_room = 110.0;
  const QAbstractTextDocumentLayout* layout = document_->documentLayout();
  (void)layout->documentSize();
  for (std::size_t i = 0; i < outline_.headings.size(); ++i) {
    QTextBlock block = document_->findBlockByNumber(outline_.headings[i]);
    const QRectF box = layout->blockBoundingRect(block);
    const int page = static_cast<int>(box.top() / text_height);
    // Headings that follow one another (a section and the caption of its table) stay together: the last one counts.
    QTextBlock last = block;
    while (i + 1 < outline_.headings.size()) {
      QTextBlock next = last.next();
      while (next.isValid() && next.text().trimmed().isEmpty()) next = next.next();
      if (!next.isValid() || next.blockNumber() != outline_.headings[i + 1]) break;
      last = next;
      ++i;
    }
    bool alone = layout->blockBoundingRect(last).bottom() + least_room > (page + 1.0) * text_height;
    for (QTextBlock next = last.next(); next.isValid() && !alone; next = next.next()) {
      if (next.text().trimmed().isEmpty()) continue;
      // A figure that did not fit leaves its heading behind.
      alone = static_cast<int>(layout->blockBoundingRect(next).top() / text_height) > page;
      break;
    }
    if (!alone || box.top() - page * text_height < 1.0) continue;
    QTextCursor cursor(block);
    QTextBlockFormat format = block.blockFormat();
    format.setPageBreakPolicy(QTextFormat::PageBreak_AlwaysBefore);
    cursor.setBlockFormat(format);
    // Laid out again as a whole: bit by bit Qt 6.4 loses text between tables.
    document_->markContentsDirty(0, document_->characterCount());
    (void)layout->documentSize();
  }
}

int ReportDocument::pageCount() const {
  return document_->pageCount();
}

std::vector<ReportDocument::Heading> ReportDocument::sections() const {
  std::vector<Heading> out;
  for (const int number : outline_.sections) {
    const QTextBlock block = document_->findBlockByNumber(number);
    const double top = document_->documentLayout()->blockBoundingRect(block).top();
    out.push_back({block.text(), static_cast<int>(top / text_height)});
  }
  return out;
}

void ReportDocument::drawPage(QPainter& painter, int page) const {
  painter.save();
  painter.fillRect(QRect(0, 0, page_width, page_height), Qt::white);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing | QPainter::SmoothPixmapTransform);
  painter.setFont(pageFont(small_px));
  painter.setPen(soft);
  const QRectF head(side_margin, 36, text_width, 20);
  const QRectF foot(side_margin, page_height - 52, text_width, 20);
  if (page > 0) {
    painter.drawText(head, Qt::AlignLeft | Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(outline_.title, Qt::ElideRight, text_width - 120));
    painter.drawText(head, Qt::AlignRight | Qt::AlignVCenter, QStringLiteral("Spindrift " SPINDRIFT_VERSION));
    painter.setPen(QPen(line_colour, 1));
    painter.drawLine(head.bottomLeft() + QPointF(0, 4), head.bottomRight() + QPointF(0, 4));
  }
  painter.setPen(QPen(line_colour, 1));
  painter.drawLine(foot.topLeft() - QPointF(0, 4), foot.topRight() - QPointF(0, 4));
  painter.setPen(soft);
  painter.drawText(foot, Qt::AlignLeft | Qt::AlignVCenter,
                   painter.fontMetrics().elidedText(outline_.subtitle, Qt::ElideRight, text_width - 120));
  painter.drawText(foot, Qt::AlignRight | Qt::AlignVCenter, translated("Page %1 of %2").arg(page + 1).arg(pageCount()));
  const QRectF area(0, static_cast<double>(page) * text_height, text_width, text_height);
  painter.translate(side_margin, top_margin - area.top());
  painter.setClipRect(area, Qt::IntersectClip);
  QAbstractTextDocumentLayout::PaintContext context;
  context.clip = area;
  context.palette.setColor(QPalette::Text, ink);
  document_->documentLayout()->draw(&painter, context);
  painter.restore();
}

void ReportDocument::writePdf(const QString& file, const JobContext& job) const {
  QSaveFile target(file);
  if (!target.open(QIODevice::WriteOnly)) {
    throw InputError({file.toStdString(), ""},
                     "the PDF could not be written: " + target.errorString().toStdString() + ".");
  }
  {
    QPdfWriter writer(&target);
    writer.setPageSize(QPageSize(QPageSize::A4));
    writer.setPageMargins({0, 0, 0, 0});
    writer.setResolution(pdf_dpi);
    writer.setTitle(outline_.title);
    writer.setCreator(QStringLiteral("Spindrift " SPINDRIFT_VERSION));
    QPainter painter(&writer);
    painter.scale(pdf_dpi / screen_dpi, pdf_dpi / screen_dpi);
    for (int page = 0; page < pageCount(); ++page) {
      job.report(static_cast<double>(page) / pageCount(), "pages");
      job.throwIfCancelled();
      if (page > 0) writer.newPage();
      drawPage(painter, page);
    }
  }
  if (!target.commit()) {
    throw InputError({file.toStdString(), ""},
                     "the PDF could not be written: " + target.errorString().toStdString() + ".");
  }
}

}  // namespace spindrift::gui
