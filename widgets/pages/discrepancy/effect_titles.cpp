// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/discrepancy/effect_titles.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QRegularExpression>
#include <QStringList>
#include <QTableView>
#include <cmath>

#include "core/discrepancy/effect_titles.h"
#include "core/reporting/report_wording.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("Effect", text);
}

}  // namespace

QString effectTitle(const std::string& id) {
  const auto title = effectTitleOf(id);
  if (!title) return QString::fromStdString(id);
  const QString text = translated(std::string(title->pattern).c_str());
  return title->subject.empty() ? text : text.arg(QString::fromStdString(title->subject));
}

QString effectTitles(const std::vector<std::string>& ids, const QString& last_word) {
  QString text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0) text += i + 1 == ids.size() ? QLatin1Char(' ') + last_word + QLatin1Char(' ') : QStringLiteral(", ");
    text += effectTitle(ids[i]);
  }
  return text;
}

QString titledSentence(const std::string& sentence) {
  static const QRegularExpression id(QStringLiteral("[a-z_]+(?:\\.\\w+)+"));
  const QString text = QString::fromStdString(sentence);
  QString out;
  qsizetype done = 0;
  for (QRegularExpressionMatchIterator i = id.globalMatch(text); i.hasNext();) {
    const QRegularExpressionMatch match = i.next();
    out += text.mid(done, match.capturedStart() - done) + effectTitle(match.captured().toStdString());
    done = match.capturedEnd();
  }
  return out + text.mid(done);
}

QString sentenceStart(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString sizeText(double value, const QString& unit) {
  if (!std::isfinite(value)) return QStringLiteral("–");
  const double magnitude = std::abs(value);
  QString text = QString::number(value, 'f', magnitude < 9.95 ? 2 : magnitude < 99.5 ? 1 : 0);
  text.replace(QLatin1Char('-'), QChar(0x2212));
  return unit.isEmpty() ? text : text + QLatin1Char(' ') + unit;
}

QString probabilityText(double p) {
  return QString::fromStdString(probabilityInWords(p));
}

QString spanText(double from_s, double to_s, double whole_s) {
  const TimeUnit unit = timeUnit(whole_s);
  return QStringLiteral("%1–%2 %3")
      .arg(from_s / unit.seconds, 0, 'f', 1)
      .arg(to_s / unit.seconds, 0, 'f', 1)
      .arg(unit.name);
}

QString clockText(double time_s) {
  const auto minutes = static_cast<int>(std::lround(time_s / 60.0));
  if (minutes < 60) return QCoreApplication::translate("Effect", "%1 min").arg(minutes);
  return QCoreApplication::translate("Effect", "%1 h %2 min")
      .arg(minutes / 60)
      .arg(minutes % 60, 2, 10, QLatin1Char('0'));
}

QString pointsText(const std::vector<std::string>& points, std::size_t all) {
  if (points.size() == all && all > 1) return QCoreApplication::translate("Effect", "all %1").arg(all);
  QStringList names;
  for (const std::string& p : points) names << QString::fromStdString(p);
  if (names.size() <= 2) return names.join(QStringLiteral(", "));
  return QCoreApplication::translate("Effect", "%1 of %2").arg(names.size()).arg(all);
}

QString componentName(Component component) {
  return QString::fromStdString(std::string(toString(component)));
}

QString componentUnit(Component component) {
  return QString::fromStdString(std::string(unitOf(component)));
}

QString legendText(const std::vector<std::pair<int, QString>>& names) {
  QStringList parts;
  for (const auto& [colour, name] : names) {
    const auto index = static_cast<std::size_t>(colour) % theme().series.size();
    parts << QString::fromUtf8("<span style=\"color:%1\">●</span>&nbsp;%2")
                 .arg(theme().series[index].name(), name.toHtmlEscaped());
  }
  return parts.join(QStringLiteral("&nbsp;&nbsp; "));
}

void stretchColumn(QTableView* table, int column) {
  table->horizontalHeader()->setStretchLastSection(false);
  table->horizontalHeader()->setMinimumSectionSize(40);
  table->horizontalHeader()->setSectionResizeMode(column, QHeaderView::Stretch);
  table->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

}  // namespace spindrift::gui
