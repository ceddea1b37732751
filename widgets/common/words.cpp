// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/words.h"

#include <QRegularExpression>

#include "core/base/unit_text.h"

namespace spindrift::gui {

QString sentenceStart(QString text) {
  if (!text.isEmpty() && text[0].script() == QChar::Script_Latin) text[0] = text[0].toUpper();
  return text;
}

QString keptTogether(QString text) {
  static const QString unit =
      QStringLiteral("(?:[µnm]?m|[µm]?rad|arcsec|µin|°[CF]?|%|K|N|W|V|[µm]?s|h|min|px|rpm|mm/min|1/min)(?!\\w)");
  static const QRegularExpression joints(
      QStringLiteral("(?<=\\d) (?=±|(?:%1))|(?<=±) (?=\\d)|(?<=\\b[xyzXYZ]) (?=[-\u2212]?\\d)|(?<= /) (?=\\(?%1)")
          .arg(unit));
  return text.replace(joints, QStringLiteral("\u00a0"));
}

QString unitText(std::string_view unit) {
  return QString::fromStdString(printedUnit(unit));
}

QString fileUnit(QString unit) {
  for (const char16_t micro : {u'\u00b5', u'\u03bc'}) unit.replace(QChar(micro), QLatin1Char('u'));
  return unit.replace(QStringLiteral("°C"), QStringLiteral("degC"));
}

QString printedTitle(const QString& title) {
  const QString border = QStringLiteral(" / ");
  const qsizetype at = title.lastIndexOf(border);
  if (at < 0) return title;
  const qsizetype unit = at + border.size();
  return title.left(unit) + unitText(title.mid(unit).toStdString());
}

QStringList printedTitles(QStringList titles) {
  for (QString& title : titles) title = printedTitle(title);
  return titles;
}

}  // namespace spindrift::gui
