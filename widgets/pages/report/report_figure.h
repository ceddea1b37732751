// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a report inside a text document: drawings as vector, pictures, each with its caption on the same page.
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <QTextFormat>
#include <QTextObjectInterface>
#include <memory>
#include <vector>

class QSvgRenderer;

namespace spindrift::gui {

/// A picture with its caption, kept on one page.
struct ReportFigure {
  QString svg;                                    ///< empty: an image
  mutable std::shared_ptr<QSvgRenderer> drawing;  ///< read when it is first drawn: most pages are not in sight
  QImage image;
  QString caption;
  QSizeF picture_size;
  double caption_height = 0.0;

  /// Works out the sizes: as drawn, made smaller where it would not fit.
  void measure();
};

/// Draws the figures of one document; the text holds an object of type `object_type` with the number of its figure.
class ReportFigures : public QObject, public QTextObjectInterface {
  Q_OBJECT
  Q_INTERFACES(QTextObjectInterface)
 public:
  static constexpr int object_type = QTextFormat::UserObject + 1;

  /// The format of the character that stands for a figure.
  [[nodiscard]] QTextCharFormat add(ReportFigure figure);

  QSizeF intrinsicSize(QTextDocument* document, int position, const QTextFormat& format) override;
  void drawObject(QPainter* painter, const QRectF& rect, QTextDocument* document, int position,
                  const QTextFormat& format) override;

 private:
  [[nodiscard]] const ReportFigure& figureOf(const QTextFormat& format) const;
  std::vector<ReportFigure> figures_;
};

/// What Qt's renderer does not know is put in other words: the halo of a text becomes white copies around it, clipping
/// is left out (nothing reaches beyond the axes), the font is the program's own.
[[nodiscard]] QByteArray drawingForQt(QString svg);

}  // namespace spindrift::gui
