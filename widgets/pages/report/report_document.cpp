// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/report_document.h"

#include <QAbstractTextDocumentLayout>
#include <QCoreApplication>
#include <QImage>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QRegularExpression>
#include <QSaveFile>
#include <QSvgRenderer>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextObjectInterface>
#include <QTextTable>
#include <QXmlStreamReader>
#include <array>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "widgets/theme/fonts.h"

namespace spindrift::gui {
namespace {

constexpr int side_margin = 68;  // 18 mm
constexpr int top_margin = 76;
constexpr int bottom_margin = 84;
constexpr int text_width = ReportDocument::page_width - 2 * side_margin;
constexpr int text_height = ReportDocument::page_height - top_margin - bottom_margin;
constexpr int text_px = 12;
constexpr int small_px = 10;
constexpr int pdf_dpi = 1200;
constexpr double screen_dpi = 96.0;

// A printed page is not of the theme: always ink on white.
const QColor ink(0x1f, 0x29, 0x33);
const QColor soft(0x52, 0x60, 0x6d);
const QColor line_colour(0xd9, 0xde, 0xe4);
const QColor accent(0x0b, 0x72, 0x85);

/// Around a text, px of the drawing.
constexpr std::array<std::pair<double, double>, 8> halo_offsets{
    {{-1.2, 0.0}, {1.2, 0.0}, {0.0, -1.2}, {0.0, 1.2}, {-0.9, -0.9}, {0.9, -0.9}, {-0.9, 0.9}, {0.9, 0.9}}};

constexpr int figure_object = QTextFormat::UserObject + 1;
constexpr int figure_property = QTextFormat::UserProperty + 1;

QString translated(const char* text) {
  return QCoreApplication::translate("ReportDocument", text);
}

QFont pageFont(int px, QFont::Weight weight = QFont::Normal) {
  QFont font = printFont(px, weight);
  font.setHintingPreference(QFont::PreferNoHinting);
  return font;
}

/// Width and height that a drawing states of itself.
QSizeF drawnSize(const QString& svg) {
  QXmlStreamReader xml(svg);
  if (!xml.readNextStartElement()) return {};
  const QXmlStreamAttributes attributes = xml.attributes();
  return {attributes.value(QStringLiteral("width")).toDouble(), attributes.value(QStringLiteral("height")).toDouble()};
}

QByteArray forQtSvg(QString svg);

/// A picture with its caption, kept on one page.
struct Figure {
  QString svg;                                    ///< empty: an image
  mutable std::shared_ptr<QSvgRenderer> drawing;  ///< read when it is first drawn: most pages are not in sight
  QImage image;
  QString caption;
  QSizeF picture_size;
  double caption_height = 0.0;

  /// Works out the sizes: as drawn, made smaller where it would not fit.
  void measure() {
    picture_size = svg.isEmpty() ? QSizeF(image.size()) / 2.0 : drawnSize(svg);
    if (picture_size.isEmpty()) {
      picture_size = {static_cast<double>(text_width), 40.0};
    } else {
      const double most_height = 0.62 * text_height;
      picture_size *= std::min({text_width / picture_size.width(), most_height / picture_size.height(), 1.0});
    }
    caption_height = QFontMetricsF(pageFont(small_px))
                         .boundingRect(QRectF(0, 0, text_width, 1000), Qt::TextWordWrap, caption)
                         .height();
  }
};

/// What Qt's renderer does not know is put in other words: the halo of a text becomes white copies around it, clipping
/// is left out (nothing reaches beyond the axes), the font is the program's own.
QByteArray forQtSvg(QString svg) {
  static const QRegularExpression clip(QStringLiteral("<clipPath.*?</clipPath>"),
                                       QRegularExpression::DotMatchesEverythingOption);
  static const QRegularExpression clip_use(QStringLiteral(" clip-path=\"[^\"]*\""));
  static const QRegularExpression halo(
      QStringLiteral("<text x=\"([^\"]+)\" y=\"([^\"]+)\"([^>]*?) stroke=\"#ffffff\" stroke-width=\"3\" "
                     "paint-order=\"stroke\" stroke-linejoin=\"round\">([^<]*)</text>"));
  static const QRegularExpression family(QStringLiteral("font-family=\"[^\"]*\""));
  svg.remove(clip);
  svg.remove(clip_use);
  for (auto match = halo.match(svg); match.hasMatch(); match = halo.match(svg, match.capturedStart())) {
    const double x = match.captured(1).toDouble();
    const double y = match.captured(2).toDouble();
    const auto copy = [&](double dx, double dy, const char* fill) {
      return QStringLiteral("<text x=\"%1\" y=\"%2\"%3%4>%5</text>")
          .arg(x + dx)
          .arg(y + dy)
          .arg(QLatin1String(fill), match.captured(3), match.captured(4));
    };
    QString texts;
    for (const auto& [dx, dy] : halo_offsets) texts += copy(dx, dy, " fill=\"#ffffff\"");
    svg.replace(match.capturedStart(), match.capturedLength(), texts + copy(0.0, 0.0, ""));
  }
  svg.replace(family, QStringLiteral("font-family=\"%1\"").arg(printFont(text_px).family()));
  return svg.toUtf8();
}

class FigureObject : public QObject, public QTextObjectInterface {
  Q_OBJECT
  Q_INTERFACES(QTextObjectInterface)
 public:
  std::vector<Figure> figures;

  QSizeF intrinsicSize(QTextDocument*, int, const QTextFormat& format) override {
    const Figure& f = figures[static_cast<std::size_t>(format.intProperty(figure_property))];
    return {static_cast<double>(text_width), f.picture_size.height() + f.caption_height + 14.0};
  }
  void drawObject(QPainter* painter, const QRectF& rect, QTextDocument*, int, const QTextFormat& format) override {
    const Figure& f = figures[static_cast<std::size_t>(format.intProperty(figure_property))];
    const QRectF area(rect.topLeft() + QPointF(0, 4), f.picture_size);
    if (!f.svg.isEmpty()) {
      if (f.drawing == nullptr) f.drawing = std::make_shared<QSvgRenderer>(forQtSvg(f.svg));
      f.drawing->render(painter, area);
    } else {
      painter->drawImage(area, f.image);
    }
    painter->save();
    painter->setFont(pageFont(small_px));
    painter->setPen(soft);
    painter->drawText(QRectF(rect.left(), area.bottom() + 4, text_width, f.caption_height + 2), Qt::TextWordWrap,
                      f.caption);
    painter->restore();
  }
};

}  // namespace

/// Walks through the report and writes it into the document.
class ReportDocument::Builder {
 public:
  Builder(ReportDocument& report, FigureObject& objects)
      : report_(report), objects_(objects), cursor_(report.document_.get()) {}

  void build(QString main) {
    // Drawings are taken out first; the rest is read as XML.
    static const QRegularExpression drawing(QStringLiteral("<svg\\b.*?</svg>"),
                                            QRegularExpression::DotMatchesEverythingOption);
    for (auto match = drawing.match(main); match.hasMatch(); match = drawing.match(main, match.capturedStart())) {
      drawings_.push_back(match.captured());
      main.replace(match.capturedStart(), match.capturedLength(),
                   QStringLiteral("<drawing n=\"%1\"/>").arg(drawings_.size() - 1));
    }
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
  }

 private:
  void element() {
    const QString name = xml_.name().toString();
    if (name == QLatin1String("h1")) {
      report_.title_ = text();
      block(report_.title_, pageFont(20, QFont::DemiBold), ink, 0, 2);
    } else if (name == QLatin1String("h2")) {
      report_.sections_.push_back(heading(text(), 15, 22));
    } else if (name == QLatin1String("h3")) {
      heading(text(), 12, 12);
    } else if (name == QLatin1String("p")) {
      paragraph();
    } else if (name == QLatin1String("table")) {
      table();
    } else if (name == QLatin1String("figure")) {
      figure();
    }
  }

  QString text() { return xml_.readElementText(QXmlStreamReader::IncludeChildElements).simplified(); }

  void startBlock(const QTextBlockFormat& format) {
    if (fresh_) {
      cursor_.setBlockFormat(format);
      fresh_ = false;
    } else {
      cursor_.insertBlock(format);
    }
  }

  int block(const QString& words, const QFont& font, const QColor& colour, double above, double below) {
    QTextBlockFormat format;
    format.setTopMargin(above);
    format.setBottomMargin(below);
    startBlock(format);
    QTextCharFormat look;
    look.setFont(font);
    look.setForeground(colour);
    cursor_.insertText(words, look);
    return cursor_.block().blockNumber();
  }

  int heading(const QString& words, int px, double above) {
    const int number = block(words, pageFont(px, QFont::DemiBold), ink, above, 4);
    report_.headings_.push_back(number);
    return number;
  }

  void paragraph() {
    const QString kind = xml_.attributes().value(QStringLiteral("class")).toString();
    const QString words = text();
    if (kind.startsWith(QLatin1String("verdict"))) {
      verdict(words, kind.section(QLatin1Char(' '), 1));
    } else if (report_.subtitle_.isEmpty() && report_.sections_.empty()) {
      report_.subtitle_ = words;
      block(words, pageFont(text_px), soft, 0, 6);
      rule();
    } else {
      block(words, pageFont(text_px), ink, 3, 3);
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

  void verdict(const QString& words, const QString& kind) {
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
    QTextCharFormat look;
    look.setFont(pageFont(text_px, QFont::DemiBold));
    look.setForeground(ink);
    made->cellAt(0, 0).firstCursorPosition().insertText(words, look);
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
    std::vector<QStringList> rows;
    int header_rows = 0;
    std::set<qsizetype> text_columns;
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
          text_columns.insert(rows.back().size());
        rows.back() << text();
      }
    }
    if (rows.empty() || rows.front().isEmpty()) return;
    if (!facts) ++report_.tables_;
    if (!caption.isEmpty()) {
      report_.headings_.push_back(block(caption, pageFont(small_px), soft, 8, 2));
    }
    insertRows(rows, header_rows, facts, text_columns);
  }

  void insertRows(const std::vector<QStringList>& rows, int header_rows, bool facts,
                  const std::set<qsizetype>& text_columns = {}) {
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
      const QStringList& row = rows[static_cast<std::size_t>(r)];
      for (int c = 0; c < columns && c < row.size(); ++c) {
        const bool head = r < header_rows;
        QTextTableCell cell = made->cellAt(r, c);
        QTextTableCellFormat look;
        look.setBottomBorder(head ? 1.0 : 0.6);
        look.setBottomBorderStyle(QTextFrameFormat::BorderStyle_Solid);
        look.setBottomBorderBrush(head ? soft : line_colour);
        cell.setFormat(look);
        QTextCursor at = cell.firstCursorPosition();
        QTextBlockFormat align;
        align.setAlignment(c == 0 || facts || text_columns.contains(c) ? Qt::AlignLeft : Qt::AlignRight);
        at.setBlockFormat(align);
        QTextCharFormat letters;
        letters.setFont(pageFont(px, head ? QFont::DemiBold : QFont::Normal));
        letters.setForeground(facts && (c == 0 || head) ? soft : ink);
        at.insertText(row[c], letters);
      }
    }
    leave();
  }

  void figure() {
    Figure f;
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
    ++report_.figures_;
    f.measure();
    objects_.figures.push_back(std::move(f));
    QTextBlockFormat block_format;
    block_format.setTopMargin(4);
    block_format.setBottomMargin(4);
    startBlock(block_format);
    QTextCharFormat object;
    object.setObjectType(figure_object);
    object.setProperty(figure_property, static_cast<int>(objects_.figures.size()) - 1);
    object.setVerticalAlignment(QTextCharFormat::AlignBottom);
    cursor_.insertText(QString(QChar::ObjectReplacementCharacter), object);
  }

  /// Where people sign.
  void signatures() {
    report_.sections_.push_back(heading(translated("Signatures"), 15, 22));
    insertRows(
        {{translated("Measured by"), translated("Date"), translated("Signature")}, {QStringLiteral("\n\n"), {}, {}}}, 1,
        true);
    insertRows(
        {{translated("Checked by"), translated("Date"), translated("Signature")}, {QStringLiteral("\n\n"), {}, {}}}, 1,
        true);
  }

  ReportDocument& report_;
  FigureObject& objects_;
  QTextCursor cursor_;
  QXmlStreamReader xml_;
  QStringList drawings_;
  bool fresh_ = true;
};

ReportDocument::ReportDocument(const QString& html) : document_(std::make_unique<QTextDocument>()) {
  const qsizetype from = html.indexOf(QLatin1String("<main>"));
  const qsizetype to = html.lastIndexOf(QLatin1String("</main>"));
  if (from < 0 || to < from) throw InputError("this is no report of Spindrift; write the report again.");
  document_->setUndoRedoEnabled(false);
  document_->setUseDesignMetrics(true);
  document_->setDocumentMargin(0);
  document_->setDefaultFont(pageFont(text_px));
  auto* objects = new FigureObject;
  objects->setParent(document_.get());
  document_->documentLayout()->registerHandler(figure_object, objects);
  Builder(*this, *objects).build(html.mid(from + 6, to - from - 6));
  document_->setPageSize({text_width, text_height});
  keepHeadingsWithText();
}

ReportDocument::~ReportDocument() = default;

void ReportDocument::keepHeadingsWithText() {
  constexpr double least_room = 110.0;
  const QAbstractTextDocumentLayout* layout = document_->documentLayout();
  (void)layout->documentSize();
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    QTextBlock block = document_->findBlockByNumber(headings_[i]);
    const QRectF box = layout->blockBoundingRect(block);
    const int page = static_cast<int>(box.top() / text_height);
    // Headings that follow one another (a section and the caption of its table) stay together: the last one counts.
    QTextBlock last = block;
    while (i + 1 < headings_.size()) {
      QTextBlock next = last.next();
      while (next.isValid() && next.text().trimmed().isEmpty()) next = next.next();
      if (!next.isValid() || next.blockNumber() != headings_[i + 1]) break;
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
  for (const int number : sections_) {
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
                     painter.fontMetrics().elidedText(title_, Qt::ElideRight, text_width - 120));
    painter.drawText(head, Qt::AlignRight | Qt::AlignVCenter, QStringLiteral("Spindrift " SPINDRIFT_VERSION));
    painter.setPen(QPen(line_colour, 1));
    painter.drawLine(head.bottomLeft() + QPointF(0, 4), head.bottomRight() + QPointF(0, 4));
  }
  painter.setPen(QPen(line_colour, 1));
  painter.drawLine(foot.topLeft() - QPointF(0, 4), foot.topRight() - QPointF(0, 4));
  painter.setPen(soft);
  painter.drawText(foot, Qt::AlignLeft | Qt::AlignVCenter,
                   painter.fontMetrics().elidedText(subtitle_, Qt::ElideRight, text_width - 120));
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
    writer.setTitle(title_);
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

#include "report_document.moc"
