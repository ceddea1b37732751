// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/report_builder.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextTable>
#include <QXmlStreamReader>
#include <algorithm>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "widgets/pages/report/report_style.h"

namespace spindrift::gui {

using namespace report_style;

namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("ReportDocument", text);
}

/// A text in runs of normal and small print.
struct Words {
  struct Run {
    QString text;
    bool small = false;
  };
  std::vector<Run> runs;

  Words() = default;
  explicit Words(const QString& text) : runs{{text, false}} {}
  [[nodiscard]] QString plain() const {
    QString whole;
    for (const Run& run : runs) whole += run.text;
    return whole;
  }
};

/// Walks through the report and writes it into the document.
class Builder {
 public:
  Builder(QTextDocument& document, ReportFigures& figures) : figures_(figures), cursor_(&document) {}

  ReportOutline build(QString main) {
    // Drawings are taken out first; the rest is read as XML.
    takeDrawings(main);
    static const QRegularExpression image(QStringLiteral("<img ([^>]*[^/])>"));
    main.replace(image, QStringLiteral("<img \\1/>"));
    xml_.addData(QStringLiteral("<main>") + main + QStringLiteral("</main>"));
    // Nothing is laid out before everything is there.
    cursor_.beginEditBlock();
    while (!xml_.atEnd()) {
      if (xml_.readNext() != QXmlStreamReader::StartElement) continue;
      element();
    }
    signatures();
    cursor_.endEditBlock();
    if (xml_.hasError()) {
      throw InputError("the report cannot be laid out as pages: " + xml_.errorString().toStdString());
    }
    return std::move(report_);
  }

 private:
  void element() {
    const QString name = xml_.name().toString();
    if (name == QLatin1String("h1")) {
      report_.title = text();
      block(Words(report_.title), pageFont(20, QFont::DemiBold), ink, 0, 2);
    } else if (name == QLatin1String("h2")) {
      report_.sections.push_back(heading(words(), 15, 22));
    } else if (name == QLatin1String("h3")) {
      heading(words(), 12, 12);
    } else if (name == QLatin1String("p")) {
      paragraph();
    } else if (name == QLatin1String("table")) {
      table();
    } else if (name == QLatin1String("figure")) {
      figure();
    }
  }

  /// Drawings may hold drawings: the outermost ones are taken.
  void takeDrawings(QString& main) {
    static const QRegularExpression tag(QStringLiteral("<svg\\b|</svg>"));
    qsizetype from = -1;
    int depth = 0;
    for (qsizetype at = 0;;) {
      const auto match = tag.match(main, at);
      if (!match.hasMatch()) return;
      at = match.capturedEnd();
      const bool opens = main.at(match.capturedStart() + 1) != QLatin1Char('/');
      if (opens && depth++ == 0) from = match.capturedStart();
      if (opens || depth == 0 || --depth > 0) continue;
      drawings_.push_back(main.mid(from, at - from));
      const QString place = QStringLiteral("<drawing n=\"%1\"/>").arg(drawings_.size() - 1);
      main.replace(from, at - from, place);
      at = from + place.size();
    }
  }

  /// The text of the present element, what stands in <small> apart; blanks as a browser shows them.
  Words words() {
    Words out;
    int small = 0;
    for (int depth = 1; depth > 0 && !xml_.atEnd();) {
      switch (xml_.readNext()) {
        case QXmlStreamReader::StartElement:
          ++depth;
          if (xml_.name() == QLatin1String("small")) ++small;
          break;
        case QXmlStreamReader::EndElement:
          --depth;
          if (xml_.name() == QLatin1String("small")) --small;
          break;
        case QXmlStreamReader::Characters:
          static const QRegularExpression blanks(QStringLiteral("[ \\t\\r\\n]+"));
          out.runs.push_back({xml_.text().toString().replace(blanks, QStringLiteral(" ")), small > 0});
          break;
        default:
          break;
      }
    }
    return out;
  }

  QString text() { return words().plain().trimmed(); }

  /// Small print one size down and soft.
  void insert(QTextCursor& at, const Words& words, const QFont& font, const QColor& colour) {
    for (const Words::Run& run : words.runs) {
      QTextCharFormat look;
      look.setFont(run.small ? pageFont(std::max(small_px - 1, font.pixelSize() - 3)) : font);
      look.setForeground(run.small ? soft : colour);
      at.insertText(run.text, look);
    }
  }

  void startBlock(const QTextBlockFormat& format) {
    if (fresh_) {
      cursor_.setBlockFormat(format);
      fresh_ = false;
    } else {
      cursor_.insertBlock(format);
    }
  }

  int block(const Words& words, const QFont& font, const QColor& colour, double above, double below) {
    QTextBlockFormat format;
    format.setTopMargin(above);
    format.setBottomMargin(below);
    startBlock(format);
    insert(cursor_, words, font, colour);
    return cursor_.block().blockNumber();
  }

  int heading(const Words& words, int px, double above) {
    const int number = block(words, pageFont(px, QFont::DemiBold), ink, above, 4);
    report_.headings.push_back(number);
    return number;
  }

  void paragraph() {
    const QString kind = xml_.attributes().value(QStringLiteral("class")).toString();
    const Words content = words();
    if (kind.startsWith(QLatin1String("verdict"))) {
      verdict(content, kind.section(QLatin1Char(' '), 1));
    } else if (report_.subtitle.isEmpty() && report_.sections.empty()) {
      report_.subtitle = content.plain().trimmed();
      block(content, pageFont(text_px), soft, 0, 6);
      rule();
    } else {
      block(content, pageFont(text_px), ink, 3, 3);
    }
  }

  /// A line in the accent colour below the title.
  void rule() {
    QTextTableFormat format;
    format.setBorder(0);
    format.setCellPadding(0);
    format.setCellSpacing(0);
    format.setWidth(QTextLength(QTextLength::PercentageLength, 100));
    format.setBottomMargin(14);
    QTextTable* made = cursor_.insertTable(1, 1, format);
    QTextTableCellFormat cell;
    cell.setTopBorder(2);
    cell.setTopBorderStyle(QTextFrameFormat::BorderStyle_Solid);
    cell.setTopBorderBrush(accent);
    cell.setFontPointSize(1);
    made->cellAt(0, 0).setFormat(cell);
    leave();
  }

  void verdict(const Words& content, const QString& kind) {
    const QColor colour = kind == QLatin1String("good")        ? QColor(0x2b, 0x7a, 0x3d)
                          : kind == QLatin1String("attention") ? QColor(0x9a, 0x67, 0x00)
                          : kind == QLatin1String("bad")       ? QColor(0xb4, 0x23, 0x18)
                                                               : soft;
    QTextTableFormat format;
    format.setBorder(0);
    format.setCellPadding(7);
    format.setCellSpacing(0);
    format.setTopMargin(6);
    format.setBottomMargin(6);
    format.setWidth(QTextLength(QTextLength::PercentageLength, 100));
    QTextTable* made = cursor_.insertTable(1, 1, format);
    QTextTableCellFormat cell;
    cell.setBackground(QColor(0xf4, 0xf6, 0xf8));
    cell.setLeftBorder(4);
    cell.setLeftBorderStyle(QTextFrameFormat::BorderStyle_Solid);
    cell.setLeftBorderBrush(colour);
    cell.setLeftPadding(12);
    made->cellAt(0, 0).setFormat(cell);
    QTextCursor at = made->cellAt(0, 0).firstCursorPosition();
    insert(at, content, pageFont(text_px, QFont::DemiBold), ink);
    leave();
  }

  /// The cursor behind the table that was just made; the empty block there is used by what comes next.
  void leave() {
    cursor_.movePosition(QTextCursor::End);
    fresh_ = true;
  }

  void table() {
    const bool facts = xml_.attributes().value(QStringLiteral("class")) == QLatin1String("facts");
    QString caption;
    std::vector<std::vector<Words>> rows;
    int header_rows = 0;
    std::set<int> text_columns;
    while (!(xml_.readNext() == QXmlStreamReader::EndElement && xml_.name() == QLatin1String("table"))) {
      if (xml_.atEnd()) return;
      if (xml_.tokenType() != QXmlStreamReader::StartElement) continue;
      if (xml_.name() == QLatin1String("caption")) {
        caption = text();
      } else if (xml_.name() == QLatin1String("tr")) {
        rows.emplace_back();
      } else if (xml_.name() == QLatin1String("th") || xml_.name() == QLatin1String("td")) {
        if (xml_.name() == QLatin1String("th")) header_rows = 1;
        if (xml_.attributes().value(QStringLiteral("class")) == QLatin1String("text"))
          text_columns.insert(static_cast<int>(rows.back().size()));
        rows.back().push_back(words());
      }
    }
    if (rows.empty() || rows.front().empty()) return;
    if (!facts) ++report_.tables;
    if (!caption.isEmpty()) {
      report_.headings.push_back(block(Words(caption), pageFont(small_px), soft, 8, 2));
    }
    insertRows(rows, header_rows, facts, text_columns);
  }

  void insertRows(const std::vector<std::vector<Words>>& rows, int header_rows, bool facts,
                  const std::set<int>& text_columns = {}) {
    const int columns = static_cast<int>(rows.front().size());
    QTextTableFormat format;
    format.setBorder(0);
    format.setBorderCollapse(true);
    format.setCellPadding(3);
    format.setCellSpacing(0);
    format.setBottomMargin(14);  // the margin above a heading does not count below a table
    format.setHeaderRowCount(header_rows);
    format.setWidth(QTextLength(QTextLength::PercentageLength, 100));
    if (facts && columns == 2) {
      format.setColumnWidthConstraints(
          {QTextLength(QTextLength::PercentageLength, 32), QTextLength(QTextLength::PercentageLength, 68)});
    }
    if (facts && columns == 3) {
      format.setColumnWidthConstraints({QTextLength(QTextLength::PercentageLength, 42),
                                        QTextLength(QTextLength::PercentageLength, 18),
                                        QTextLength(QTextLength::PercentageLength, 40)});
    }
    QTextTable* made = cursor_.insertTable(static_cast<int>(rows.size()), columns, format);
    const int px = columns > 7 ? small_px - 1 : columns > 5 ? small_px : small_px + 1;
    for (int r = 0; r < static_cast<int>(rows.size()); ++r) {
      const std::vector<Words>& row = rows[static_cast<std::size_t>(r)];
      for (int c = 0; c < columns && c < static_cast<int>(row.size()); ++c) {
        const bool head = r < header_rows;
        QTextTableCell cell = made->cellAt(r, c);
        QTextTableCellFormat look;
        look.setBottomBorder(head ? 1.0 : 0.6);
        look.setBottomBorderStyle(QTextFrameFormat::BorderStyle_Solid);
        look.setBottomBorderBrush(head ? soft : line_colour);
        // Numbers end where the next column's words begin: keep them apart.
        if (c > 0 && text_columns.contains(c)) look.setLeftPadding(14);
        cell.setFormat(look);
        QTextCursor at = cell.firstCursorPosition();
        QTextBlockFormat align;
        align.setAlignment(c == 0 || facts || text_columns.contains(c) ? Qt::AlignLeft : Qt::AlignRight);
        at.setBlockFormat(align);
        insert(at, row[static_cast<std::size_t>(c)], pageFont(px, head ? QFont::DemiBold : QFont::Normal),
               facts && (c == 0 || head) ? soft : ink);
      }
    }
    leave();
  }

  void figure() {
    ReportFigure f;
    while (!(xml_.readNext() == QXmlStreamReader::EndElement && xml_.name() == QLatin1String("figure"))) {
      if (xml_.atEnd()) return;
      if (xml_.tokenType() != QXmlStreamReader::StartElement) continue;
      if (xml_.name() == QLatin1String("drawing")) {
        f.svg = drawings_[xml_.attributes().value(QStringLiteral("n")).toInt()];
      } else if (xml_.name() == QLatin1String("img")) {
        const QString source = xml_.attributes().value(QStringLiteral("src")).toString();
        f.image = QImage::fromData(QByteArray::fromBase64(source.section(QLatin1Char(','), 1).toLatin1()));
      } else if (xml_.name() == QLatin1String("figcaption")) {
        f.caption = text();
      }
    }
    ++report_.figures;
    f.measure();
    QTextBlockFormat block_format;
    block_format.setTopMargin(4);
    block_format.setBottomMargin(4);
    startBlock(block_format);
    cursor_.insertText(QString(QChar::ObjectReplacementCharacter), figures_.add(std::move(f)));
  }

  /// Where people sign.
  void signatures() {
    report_.sections.push_back(heading(Words(translated("Signatures")), 15, 22));
    for (const char* who :
         {QT_TRANSLATE_NOOP("ReportDocument", "Measured by"), QT_TRANSLATE_NOOP("ReportDocument", "Checked by")}) {
      insertRows({{Words(translated(who)), Words(translated("Date")), Words(translated("Signature"))},
                  {Words(QStringLiteral("\n\n")), Words(), Words()}},
                 1, true);
    }
  }

  ReportOutline report_;
  ReportFigures& figures_;
  QTextCursor cursor_;
  QXmlStreamReader xml_;
  QStringList drawings_;
  bool fresh_ = true;
};

}  // namespace

ReportOutline buildReport(const QString& main, QTextDocument& document, ReportFigures& figures) {
  return Builder(document, figures).build(main);
}

}  // namespace spindrift::gui
