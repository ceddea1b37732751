// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/export/print.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QPainter>
#include <QPrinter>
#include <algorithm>

#include "core/base/error.h"
#include "widgets/report/report_pages.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

void begin(QPainter& painter, QPrinter& printer) {
  if (painter.begin(&printer)) return;
  const QString name = printer.outputFileName().isEmpty() ? printer.printerName() : printer.outputFileName();
  throw InputError(QCoreApplication::translate("Print", "Nothing can be printed to \"%1\".").arg(name).toStdString());
}

/// As large as `room` allows, in its middle across and at its top.
QRect fitted(const QSize& picture, const QRect& room) {
  const QSize size = picture.scaled(room.size(), Qt::KeepAspectRatio);
  return {QPoint(room.left() + (room.width() - size.width()) / 2, room.top()), size};
}

}  // namespace

void printPicture(QPrinter& printer, const QImage& picture, const QString& heading) {
  QPainter painter;
  begin(painter, printer);
  QRect room = painter.viewport();
  QFont font = textFont(sizes::font_body);
  font.setPointSizeF(10.0);
  painter.setFont(font);
  painter.setPen(Qt::black);
  const int line = painter.fontMetrics().height();
  painter.drawText(QRect(room.left(), room.top(), room.width(), line), Qt::AlignLeft | Qt::AlignVCenter, heading);
  room.setTop(room.top() + 2 * line);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(fitted(picture.size(), room), picture);
}

void printReport(QPrinter& printer, ReportPages& pages, int dpi) {
  constexpr double points_per_inch = 96.0;
  const int first = printer.fromPage() > 0 ? printer.fromPage() - 1 : 0;
  const int last = printer.toPage() > 0 ? std::min(printer.toPage(), pages.pageCount()) - 1 : pages.pageCount() - 1;
  QPainter painter;
  begin(painter, printer);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  for (int page = first; page <= last; ++page) {
    QImage picture;
    QEventLoop loop;
    QObject waiting;
    QObject::connect(&pages, &ReportPages::pageDrawn, &waiting, [&](int drawn, const QImage& made) {
      if (drawn != page) return;
      picture = made;
      loop.quit();
    });
    pages.draw(page, {ReportPages::page_width, ReportPages::page_height}, dpi / points_per_inch);
    loop.exec();
    if (page > first) printer.newPage();
    painter.drawImage(fitted(picture.size(), painter.viewport()), picture);
  }
}

}  // namespace spindrift::gui
