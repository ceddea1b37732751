// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/report_figure.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QRegularExpression>
#include <QSvgRenderer>
#include <QXmlStreamReader>
#include <algorithm>
#include <array>
#include <utility>

#include "widgets/pages/report/report_style.h"

namespace spindrift::gui {

using namespace report_style;

namespace {

/// Around a text, px of the drawing.
constexpr std::array<std::pair<double, double>, 8> halo_offsets{
    {{-1.2, 0.0}, {1.2, 0.0}, {0.0, -1.2}, {0.0, 1.2}, {-0.9, -0.9}, {0.9, -0.9}, {-0.9, 0.9}, {0.9, 0.9}}};

constexpr int figure_property = QTextFormat::UserProperty + 1;

/// Width and height that a drawing states of itself.
QSizeF drawnSize(const QString& svg) {
  QXmlStreamReader xml(svg);
  if (!xml.readNextStartElement()) return {};
  const QXmlStreamAttributes attributes = xml.attributes();
  return {attributes.value(QStringLiteral("width")).toDouble(), attributes.value(QStringLiteral("height")).toDouble()};
}

}  // namespace

QByteArray drawingForQt(QString svg) {
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

void ReportFigure::measure() {
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

QTextCharFormat ReportFigures::add(ReportFigure figure) {
  figures_.push_back(std::move(figure));
  QTextCharFormat object;
  object.setObjectType(object_type);
  object.setProperty(figure_property, static_cast<int>(figures_.size()) - 1);
  object.setVerticalAlignment(QTextCharFormat::AlignBottom);
  return object;
}

const ReportFigure& ReportFigures::figureOf(const QTextFormat& format) const {
  return figures_[static_cast<std::size_t>(format.intProperty(figure_property))];
}

QSizeF ReportFigures::intrinsicSize(QTextDocument*, int, const QTextFormat& format) {
  const ReportFigure& f = figureOf(format);
  return {static_cast<double>(text_width), f.picture_size.height() + f.caption_height + 14.0};
}

void ReportFigures::drawObject(QPainter* painter, const QRectF& rect, QTextDocument*, int, const QTextFormat& format) {
  const ReportFigure& f = figureOf(format);
  const QRectF area(rect.topLeft() + QPointF(0, 4), f.picture_size);
  if (!f.svg.isEmpty()) {
    if (f.drawing == nullptr) f.drawing = std::make_shared<QSvgRenderer>(drawingForQt(f.svg));
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

}  // namespace spindrift::gui
