// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/common/effect_titles.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QPainter>
#include <QRegularExpression>
#include <QStringList>
#include <QTableView>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/discrepancy/effect_titles.h"
#include "core/discrepancy/percent_text.h"
#include "core/machine/driver_words.h"
#include "core/reporting/discrepancy_report.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

QString coreText(const char* text) {
  return QCoreApplication::translate("core", text);
}

std::string translated(std::string_view english) {
  return coreText(std::string(english).c_str()).toStdString();
}

/// Titles of the effects of the user's, of the campaign at hand.
std::map<std::string, QString>& ownTitles() {
  static std::map<std::string, QString> titles;
  return titles;
}

}  // namespace

void knowOwnTitles(const nlohmann::json& document) {
  ownTitles().clear();
  if (!document.is_object() || !document.contains("effects")) return;
  for (const nlohmann::json& entry : document["effects"]) {
    const auto id = entry.find("id");
    const auto title = entry.find("title");
    if (id == entry.end() || title == entry.end() || !id->is_string() || !title->is_string()) continue;
    ownTitles()[id->get<std::string>()] = QString::fromStdString(title->get<std::string>());
  }
}

QString effectTitle(const std::string& id) {
  if (const auto own = ownTitles().find(id); own != ownTitles().end()) return own->second;
  const auto title = effectTitleOf(id);
  if (!title) return QString::fromStdString(id);
  const QString english = QString::fromStdString(std::string(title->pattern));
  const QString subject = QString::fromStdString(title->subject);
  const QString text = coreText(std::string(title->pattern).c_str());
  // A title that the catalogue puts together is found by its parts.
  if (text == english) return coreSentence(subject.isEmpty() ? english : english.arg(subject));
  return subject.isEmpty() ? text : text.arg(subject);
}

QString familyTitle(const std::string& family) {
  static const std::map<std::string, const char*> titles{
      {"ambient", QT_TRANSLATE_NOOP("Effect", "Room temperature")},
      {"artefact", QT_TRANSLATE_NOOP("Effect", "Artefact")},
      {"backlash", QT_TRANSLATE_NOOP("Effect", "Backlash")},
      {"ball_screw", QT_TRANSLATE_NOOP("Effect", "Ball screws")},
      {"column", QT_TRANSLATE_NOOP("Effect", "Column")},
      {"coolant", QT_TRANSLATE_NOOP("Effect", "Coolant")},
      {"crossbeam", QT_TRANSLATE_NOOP("Effect", "Crossbeam")},
      {"external_heat", QT_TRANSLATE_NOOP("Effect", "Heat from outside")},
      {"fixture", QT_TRANSLATE_NOOP("Effect", "Fixture")},
      {"frame", QT_TRANSLATE_NOOP("Effect", "Frame")},
      {"head", QT_TRANSLATE_NOOP("Effect", "Head")},
      {"heat_source", QT_TRANSLATE_NOOP("Effect", "Moving heat source")},
      {"instrument", QT_TRANSLATE_NOOP("Effect", "Instrument")},
      {"periodic", QT_TRANSLATE_NOOP("Effect", "Periodic errors")},
      {"rotary", QT_TRANSLATE_NOOP("Effect", "Rotary table")},
      {"scale", QT_TRANSLATE_NOOP("Effect", "Linear scales")},
      {"spindle", QT_TRANSLATE_NOOP("Effect", "Spindle")},
      {"squareness", QT_TRANSLATE_NOOP("Effect", "Squareness")},
      {"table", QT_TRANSLATE_NOOP("Effect", "Table")}};
  const auto found = titles.find(family);
  if (found != titles.end()) return QCoreApplication::translate("Effect", found->second);
  return sentenceStart(QString::fromStdString(family).replace(QLatin1Char('_'), QLatin1Char(' ')));
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
  const QString text = coreSentence(sentence);
  QString out;
  qsizetype done = 0;
  for (QRegularExpressionMatchIterator i = id.globalMatch(text); i.hasNext();) {
    const QRegularExpressionMatch match = i.next();
    out += text.mid(done, match.capturedStart() - done) + effectTitle(match.captured().toStdString());
    done = match.capturedEnd();
  }
  return out + text.mid(done);
}

QString driverWords(const std::string& drivers) {
  QStringList parts;
  // Each input is a sentence of its own with the names of the file in it.
  for (const QString& part : QString::fromStdString(drivers).split(QStringLiteral(" + "), Qt::SkipEmptyParts)) {
    const std::string words = driversInWords(coreSentence(part).toStdString(), translated);
    parts << shownNumbers(QString::fromStdString(words));
  }
  return parts.join(QStringLiteral(" + "));
}

QString driverWords(const std::vector<std::vector<std::string>>& alternatives) {
  return QString::fromStdString(driversInWords(alternatives, translated));
}

QString formulaText(const std::string& formula) {
  return QString::fromStdString(formulaInSymbols(coreSentence(formula).toStdString()));
}

QString sizeText(double value, const QString& unit) {
  if (!std::isfinite(value)) return QStringLiteral("–");
  const double magnitude = std::abs(value);
  QString text = decimalText(value, 'f', magnitude < 9.95 ? 2 : magnitude < 99.5 ? 1 : 0);
  return unit.isEmpty() ? text : text + QLatin1Char(' ') + unitText(unit.toStdString());
}

QString probabilityText(double p) {
  return shownNumbers(QString::fromStdString(spindrift::probabilityText(p)));
}

QString percentOf(double probability) {
  return QString::fromStdString(percentText(probability));
}

QPixmap probabilityBar(double probability, double device_pixel_ratio) {
  constexpr QSize size(40, 8);
  QPixmap picture(size * device_pixel_ratio);
  picture.setDevicePixelRatio(device_pixel_ratio);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().border);
  painter.drawRoundedRect(QRectF(QPointF(0, 0), QSizeF(size)), 3, 3);
  const double width = std::isfinite(probability) ? std::clamp(probability, 0.0, 1.0) * size.width() : 0.0;
  painter.setBrush(theme().series[0]);
  if (width >= 1.0) painter.drawRoundedRect(QRectF(0, 0, width, size.height()), std::min(3.0, width / 2), 3);
  return picture;
}

QString withError(double value, double standard_uncertainty, const QString& unit) {
  return shownNumbers(QString::fromStdString(withUncertainty(value, standard_uncertainty, unit.toStdString())));
}

QString remainderText(const std::vector<ComponentRemainder>& remainder) {
  QStringList parts;
  for (const ComponentRemainder& r : remainder) {
    if (r.evidence < clear_evidence) continue;
    parts << QCoreApplication::translate("Effect", "%1 rms in %2")
                 .arg(sizeText(r.rms_um, componentUnit(r.component)), componentName(r.component));
  }
  if (parts.size() < 2) return parts.join(QString());
  const QString last = parts.takeLast();
  return QCoreApplication::translate("Effect", "%1 and %2").arg(parts.join(QStringLiteral(", ")), last);
}

QString spanText(double from_s, double to_s, double whole_s) {
  const TimeUnit unit = timeUnit(whole_s);
  return QStringLiteral("%1–%2 %3")
      .arg(decimalText(from_s / unit.seconds, 'f', 1))
      .arg(decimalText(to_s / unit.seconds, 'f', 1))
      .arg(unit.name);
}

QString clockText(double time_s) {
  const auto minutes = static_cast<int>(std::lround(time_s / 60.0));
  return QStringLiteral("%1:%2").arg(minutes / 60).arg(minutes % 60, 2, 10, QLatin1Char('0'));
}

QString pointsText(const std::vector<std::string>& points, std::size_t all) {
  if (points.size() == all && all > 1) return QCoreApplication::translate("Effect", "all %1").arg(all);
  QStringList names;
  for (const std::string& p : points) names << QString::fromStdString(p);
  if (names.size() <= 2) return names.join(QStringLiteral(", "));
  return QCoreApplication::translate("Effect", "%1 of %2").arg(names.size()).arg(all);
}

QString gainUnitText(const std::string& unit) {
  return QString::fromStdString(gainUnit(unit));
}

QString componentName(Component component) {
  return QString::fromStdString(std::string(toString(component)));
}

QString componentUnit(Component component) {
  return unitText(unitOf(component));
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
  wrapCells(table);
}

}  // namespace spindrift::gui
