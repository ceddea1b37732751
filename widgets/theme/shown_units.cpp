// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/shown_units.h"

#include <QLocale>
#include <QRegularExpression>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/base/unit_text.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr double mm_per_inch = 25.4;
constexpr double um_per_microinch = 0.0254;
constexpr double urad_per_arcsecond = 1e6 * 3.14159265358979323846 / (180.0 * 3600.0);
constexpr double fahrenheit_per_kelvin = 1.8;
constexpr double fahrenheit_of_0_degC = 32.0;

// Jobs make sentences in their threads.
std::atomic<int> choice_bits = 0;

int bitsOf(const UnitChoice& c) {
  return (c.inches ? 1 : 0) | (c.arcseconds ? 2 : 0) | (c.fahrenheit ? 4 : 0);
}

const QString number_pattern = QStringLiteral("[-+\u2212]?\\d+(?:[.,]\\d+)?(?:[eE][-+\u2212]?\\d+)?");
const QString unit_pattern = QStringLiteral("(?:µm|µrad|mm|°C|K)(?:[²³⁴])?(?:[/·](?:\\([^()]*\\)|[A-Za-zµ°]+[²³⁴]?))*");

std::optional<double> numberOf(QString text) {
  text.replace(QChar(0x2212), QLatin1Char('-'));
  text.replace(QLatin1Char(','), QLatin1Char('.'));
  bool good = false;
  const double value = text.toDouble(&good);
  return good ? std::optional(value) : std::nullopt;
}

/// One number of a text in another unit, its sign and its way to be written kept.
QString convertedNumber(const QString& text, const ShownUnit& unit, bool difference) {
  const auto value = numberOf(text);
  if (!value) return text;
  const double shown = difference ? unit.factor * *value : unit.shown(*value);
  const qsizetype power = text.indexOf(QLatin1Char('e'), 0, Qt::CaseInsensitive);
  const qsizetype point = std::max(text.indexOf(QLatin1Char('.')), text.indexOf(QLatin1Char(',')));
  const qsizetype end = power < 0 ? text.size() : power;
  const int decimals = point < 0 ? 0 : static_cast<int>(end - point - 1);
  const QString sign = text.startsWith(QLatin1Char('+')) && shown >= 0 ? QStringLiteral("+") : QString();
  if (power >= 0) return sign + decimalText(shown, 'e', decimals);
  return sign + decimalText(shown, 'f', unit.decimals(decimals));
}

QString convertedNumbers(const QString& chain, const ShownUnit& unit, bool difference) {
  static const QRegularExpression number(number_pattern);
  QString out;
  qsizetype from = 0;
  for (auto i = number.globalMatch(chain); i.hasNext();) {
    const QRegularExpressionMatch m = i.next();
    const QString between = chain.mid(from, m.capturedStart() - from);
    out += between + convertedNumber(m.captured(), unit, difference || between.contains(QChar(0xb1)));
    from = m.capturedEnd();
  }
  return out + chain.mid(from);
}

struct TitleParts {
  QString head, open, unit, close;
};

TitleParts partsOf(const QString& title) {
  static const QRegularExpression border(QStringLiteral("\\s/\\s"));
  const qsizetype at = title.lastIndexOf(border);
  if (at < 0) return {title, {}, {}, {}};
  TitleParts parts{title.left(at + 3), {}, title.mid(at + 3), {}};
  if (parts.unit.startsWith(QLatin1Char('(')) && parts.unit.endsWith(QLatin1Char(')'))) {
    parts.open = QStringLiteral("(");
    parts.close = QStringLiteral(")");
    parts.unit = parts.unit.mid(1, parts.unit.size() - 2);
  }
  return parts;
}

}  // namespace

UnitChoice shownUnits() {
  const int bits = choice_bits;
  return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
}

void setShownUnits(const UnitChoice& choice) {
  if (choice_bits.exchange(bitsOf(choice)) != bitsOf(choice)) Q_EMIT UnitsNotifier::instance().changed();
}

UnitsNotifier& UnitsNotifier::instance() {
  static UnitsNotifier notifier;
  return notifier;
}

FileUnits::FileUnits() : before_(shownUnits()) {
  choice_bits = 0;
}

FileUnits::~FileUnits() {
  choice_bits = bitsOf(before_);
}

int ShownUnit::decimals(int decimals) const {
  return std::max(0, decimals - static_cast<int>(std::floor(std::log10(factor))));
}

ShownUnit shownUnit(const QString& unit) {
  ShownUnit out;
  const QString printed = QString::fromStdString(printedUnit(unit.toStdString()));
  const UnitChoice choice = shownUnits();
  out.name = printed;
  if (choice == UnitChoice{}) return out;
  if (printed == QStringLiteral("°C")) {
    if (choice.fahrenheit) out = {QStringLiteral("°F"), fahrenheit_per_kelvin, fahrenheit_of_0_degC};
    return out;
  }
  out.name.clear();
  static const QRegularExpression words(QStringLiteral("([A-Za-zµ°]+)([²³⁴]?)|([^A-Za-zµ°]+)"));
  bool below = false;
  bool small_lengths = false;
  for (auto i = words.globalMatch(printed); i.hasNext();) {
    const QRegularExpressionMatch m = i.next();
    if (!m.captured(3).isEmpty()) {
      below = below || m.captured(3).contains(QLatin1Char('/'));
      out.name += m.captured(3);
      continue;
    }
    QString word = m.captured(1);
    const qsizetype raised = QStringLiteral("²³⁴").indexOf(m.captured(2));
    const int power = (below ? -1 : 1) * (m.captured(2).isEmpty() ? 1 : static_cast<int>(raised) + 2);
    double factor = 1.0;
    if (choice.inches && word == QStringLiteral("µm")) {
      small_lengths = small_lengths || !below;
      word = QStringLiteral("µin");
      factor = 1.0 / um_per_microinch;
    } else if (choice.inches && word == QStringLiteral("mm")) {
      word = QStringLiteral("in");
      factor = 1.0 / mm_per_inch;
    } else if (choice.inches && below && small_lengths && word == QStringLiteral("m")) {
      word = QStringLiteral("in");
      factor = 1000.0 / mm_per_inch;
    } else if (choice.arcseconds && word == QStringLiteral("µrad")) {
      word = QStringLiteral("arcsec");
      factor = 1.0 / urad_per_arcsecond;
    } else if (choice.fahrenheit && (word == QStringLiteral("K") || word == QStringLiteral("°C"))) {
      word = QStringLiteral("°F");
      factor = fahrenheit_per_kelvin;
    }
    out.name += word + m.captured(2);
    out.factor *= std::pow(factor, power);
  }
  // µm/m: the factors cancel but for rounding.
  if (std::abs(out.factor - 1.0) < 1e-12) out.factor = 1.0;
  return out;
}

QString shownTitle(const QString& title) {
  const TitleParts parts = partsOf(title);
  return parts.unit.isEmpty() ? title : parts.head + parts.open + shownUnit(parts.unit).name + parts.close;
}

ShownUnit unitOfTitle(const QString& title) {
  const TitleParts parts = partsOf(title);
  return parts.unit.isEmpty() ? ShownUnit{} : shownUnit(parts.unit);
}

QString fileUnitOfTitle(const QString& title) {
  return partsOf(title).unit;
}

QString onScreen(const QString& text) {
  if (shownUnits() == UnitChoice{}) return text;
  // Numbers that belong together ("3.1 ± 0.2", "0.6 to 1.2", "x 1.0, y 2.0"), a blank and their unit.
  static const QRegularExpression quantity(
      QStringLiteral(
          "(?<![\\w.,/"
          "])(%1(?:(?:\\s?±\\s?|\\s(?:to|bis|and|und|or|oder|by|×|x|→)\\s|\\s?[–…]\\s?|,\\s(?:[xyzXYZ]\\s)?)%1)*"
          "|\\(%1(?:,\\s%1)*\\))([\\s\u00a0]?)(%2)(?![\\w/²³⁴°])")
          .arg(number_pattern, unit_pattern));
  // Of these the first numbers may be something else ("in cycle 3, 12.4 µm").
  static const QRegularExpression doubtful(QStringLiteral(",\\s(?![xyzXYZ])|\\s(?:and|und|or|oder|by|x)\\s"));
  static const QRegularExpression whole_number(QStringLiteral("(?<![\\d.,])\\d+(?![\\d.,]*\\d)"));
  QString out;
  qsizetype from = 0;
  for (auto i = quantity.globalMatch(text); i.hasNext();) {
    const QRegularExpressionMatch m = i.next();
    const QString chain = m.captured(1);
    const ShownUnit unit = shownUnit(m.captured(3));
    out += text.mid(from, m.capturedStart() - from);
    from = m.capturedEnd();
    const bool sure = chain.startsWith(QLatin1Char('(')) || !doubtful.match(chain).hasMatch() ||
                      !whole_number.match(chain).hasMatch();
    if (!sure) {
      out += m.captured();
      continue;
    }
    const bool difference = out.trimmed().endsWith(QChar(0xb1));
    out += convertedNumbers(chain, unit, difference) + (m.captured(2).isEmpty() ? QStringLiteral(" ") : m.captured(2)) +
           unit.name;
  }
  return out + text.mid(from);
}

bool isNumbers(const QString& text) {
  static const QRegularExpression numbers(
      QStringLiteral("\\A[<>≤≥≈±(\\s]*%1(?:[\\s,;±–…/()]+%1)*[)\\s]*\\z").arg(number_pattern));
  return numbers.match(text).hasMatch();
}

QString cellOnScreen(const QString& text, const QString& unit) {
  if (shownUnits() == UnitChoice{}) return text;
  const QString sentence = onScreen(text);
  if (sentence != text || unit.isEmpty()) return sentence;
  const ShownUnit shown = shownUnit(unit);
  const QString printed = QString::fromStdString(printedUnit(unit.toStdString()));
  static const QRegularExpression digit(QStringLiteral("\\d"));
  if (shown.name == printed || !digit.match(text).hasMatch()) return text;
  if (isNumbers(text)) return convertedNumbers(text, shown, text.startsWith(QChar(0xb1)));
  return text + QLatin1Char(' ') + printed;
}

}  // namespace spindrift::gui
