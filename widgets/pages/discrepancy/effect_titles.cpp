// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/discrepancy/effect_titles.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QStringList>
#include <QTableView>
#include <array>
#include <cmath>

#include "widgets/plots/plot.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

struct Title {
  const char* stem;  ///< id without its last part, or the whole id
  const char* text;  ///< %1: the last part as a capital letter or as it stands
};

// In the order of the catalogue.
constexpr std::array<Title, 32> titles{{
    {"spindle.growth.z", QT_TRANSLATE_NOOP("Effect", "growth of the spindle along Z")},
    {"spindle.centrifugal.z", QT_TRANSLATE_NOOP("Effect", "shortening of the spindle by its speed along Z")},
    {"spindle.drift", QT_TRANSLATE_NOOP("Effect", "drift of the spindle along %1")},
    {"head.tilt", QT_TRANSLATE_NOOP("Effect", "tilt of the head about %1")},
    {"column.bending.a", QT_TRANSLATE_NOOP("Effect", "bending of the column towards Y")},
    {"column.bending.b", QT_TRANSLATE_NOOP("Effect", "bending of the column towards X")},
    {"column.expansion.z", QT_TRANSLATE_NOOP("Effect", "expansion of the column along Z")},
    {"ball_screw.expansion", QT_TRANSLATE_NOOP("Effect", "thermal expansion of the %1 ball screw")},
    {"ball_screw.nonuniform", QT_TRANSLATE_NOOP("Effect", "uneven expansion of the %1 ball screw")},
    {"scale.expansion", QT_TRANSLATE_NOOP("Effect", "expansion of the %1 scale")},
    {"table.expansion.xy", QT_TRANSLATE_NOOP("Effect", "expansion of the table")},
    {"frame.rotation", QT_TRANSLATE_NOOP("Effect", "rotation of the frame about %1")},
    {"squareness.drift.c0y", QT_TRANSLATE_NOOP("Effect", "drift of the squareness of Y to X")},
    {"crossbeam.sag.z", QT_TRANSLATE_NOOP("Effect", "sag of the crossbeam")},
    {"ambient.drift", QT_TRANSLATE_NOOP("Effect", "drift with the room temperature along %1")},
    {"instrument.warm_up", QT_TRANSLATE_NOOP("Effect", "warm-up of the instrument along %1")},
    {"fixture.slip", QT_TRANSLATE_NOOP("Effect", "slip of point %1 in its fixture")},
    {"periodic.pitch", QT_TRANSLATE_NOOP("Effect", "periodic error of the %1 ball screw")},
    {"backlash", QT_TRANSLATE_NOOP("Effect", "backlash of %1")},
    {"coolant.shock", QT_TRANSLATE_NOOP("Effect", "shock by the coolant along %1")},
    {"external_heat.a", QT_TRANSLATE_NOOP("Effect", "heat from outside that bends the column towards Y")},
    {"external_heat.b", QT_TRANSLATE_NOOP("Effect", "heat from outside that bends the column towards X")},
    {"external_heat.z", QT_TRANSLATE_NOOP("Effect", "heat from outside that acts along Z")},
    {"heat_source.position", QT_TRANSLATE_NOOP("Effect", "spindle heat that depends on the position of %1")},
    {"rotary.drift.x0c", QT_TRANSLATE_NOOP("Effect", "drift of the rotary table along X")},
    {"rotary.drift.y0c", QT_TRANSLATE_NOOP("Effect", "drift of the rotary table along Y")},
    {"rotary.drift.z0t", QT_TRANSLATE_NOOP("Effect", "drift of the rotary table along Z")},
    {"rotary.tilt.a0c", QT_TRANSLATE_NOOP("Effect", "tilt of the rotary table about X")},
    {"rotary.tilt.b0c", QT_TRANSLATE_NOOP("Effect", "tilt of the rotary table about Y")},
    {"rotary.tilt.c0c", QT_TRANSLATE_NOOP("Effect", "rotation of the rotary table about Z")},
    {"rotary.expansion.r0t", QT_TRANSLATE_NOOP("Effect", "radial growth of the rotary table")},
    {"artefact.expansion", QT_TRANSLATE_NOOP("Effect", "expansion of the artefact")},
}};

QString translated(const char* text) {
  return QCoreApplication::translate("Effect", text);
}

QString superscript(int number) {
  static const QString digits = QString::fromUtf8("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString text = number < 0 ? QString(QChar(0x207B)) : QString();
  for (const QChar c : QString::number(std::abs(number))) text += digits[c.digitValue()];
  return text;
}

}  // namespace

QString effectTitle(const std::string& id) {
  const QString whole = QString::fromStdString(id);
  const qsizetype dot = whole.lastIndexOf(QLatin1Char('.'));
  const QString stem = dot < 0 ? whole : whole.left(dot);
  const QString last = dot < 0 ? QString() : whole.mid(dot + 1);
  for (const Title& title : titles) {
    if (whole == QLatin1String(title.stem)) return translated(title.text);
    // The id of a point may hold dots of its own.
    const bool slip = qstrcmp(title.stem, "fixture.slip") == 0 && whole.startsWith(QLatin1String("fixture.slip."));
    if (slip) return translated(title.text).arg(whole.mid(13));
    if (stem != QLatin1String(title.stem)) continue;
    // Rotations a, b, c are about X, Y, Z.
    const qsizetype about = QStringLiteral("abc").indexOf(last);
    return translated(title.text)
        .arg(about >= 0 && last.size() == 1 ? QString(QLatin1Char("XYZ"[about])) : last.toUpper());
  }
  return whole;
}

QString effectTitles(const std::vector<std::string>& ids, const QString& last_word) {
  QString text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0) text += i + 1 == ids.size() ? QLatin1Char(' ') + last_word + QLatin1Char(' ') : QStringLiteral(", ");
    text += effectTitle(ids[i]);
  }
  return text;
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
  if (!std::isfinite(p)) return QStringLiteral("–");
  if (p < 1e-12) return QStringLiteral("< 10") + superscript(-12);
  if (p >= 0.001) return QString::number(p, 'g', 2);
  const int exponent = static_cast<int>(std::floor(std::log10(p)));
  return QStringLiteral("%1×10").arg(QString::number(p / std::pow(10.0, exponent), 'f', 0)) + superscript(exponent);
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
