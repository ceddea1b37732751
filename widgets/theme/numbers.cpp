// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/numbers.h"

#include <QLocale>
#include <QRegularExpression>
#include <cmath>

#include "core/base/text.h"

namespace spindrift::gui {
namespace {

const QChar true_minus(0x2212);

QString decimalPoint() {
  return QLocale().decimalPoint();
}

}  // namespace

QString decimalText(double value, char format, int digits) {
  // As people write it: powers of ten only where the number would be longer than they are.
  constexpr double long_number = 1e7;
  const bool plain = format == 'g' && std::abs(value) >= std::pow(10.0, digits) - 0.5 && std::abs(value) < long_number;
  QString text = plain ? QString::number(value, 'f', 0) : QString::number(value, format, digits);
  static const QRegularExpression zero(QStringLiteral("\\A-0(\\.0*)?\\z"));
  if (text.contains(zero)) text.remove(0, 1);  // a rounded zero has no sign
  text.replace(QLatin1Char('-'), true_minus);
  const QString point = decimalPoint();
  if (point != QLatin1String(".")) text.replace(QLatin1Char('.'), point);
  return text;
}

QString shownNumbers(QString text) {
  // A sign stands before a number and behind nothing that it could join or take away from.
  static const QRegularExpression sign(QStringLiteral(R"((?<![\w./\\"')\]}-])-(?=\d))"));
  if (text.contains(QLatin1Char('-'))) text.replace(sign, QString(true_minus));
  const QString point = decimalPoint();
  if (point == QLatin1String(".") || !text.contains(QLatin1Char('.'))) return text;
  // Neither part of a word, a path or a quoted text nor of a version such as 0.1.0.
  static const QRegularExpression number(QStringLiteral(R"((?<![\w./\\"])(\d+)\.(\d+)(?![\w/\\"]|\.\d))"));
  static const QRegularExpression power(QStringLiteral(R"((?<![\w./\\"])(\d+)\.(\d+)(e[+-]?\d+)(?![\w/\\"]))"));
  text.replace(power, QStringLiteral("\\1") + point + QStringLiteral("\\2\\3"));
  return text.replace(number, QStringLiteral("\\1") + point + QStringLiteral("\\2"));
}

std::optional<double> typedNumber(const QString& text) {
  QString plain = text.trimmed();
  plain.replace(true_minus, QLatin1Char('-'));
  if (plain.count(QLatin1Char(',')) == 1 && !plain.contains(QLatin1Char('.'))) {
    plain.replace(QLatin1Char(','), QLatin1Char('.'));
  }
  double value = 0.0;
  if (!parseNumber(plain.toStdString(), value)) return std::nullopt;
  return value;
}

QString plainNumbers(const QString& text) {
  const QString point = decimalPoint();
  if (point == QLatin1String(".")) return text;
  static const QRegularExpression numbers(
      QStringLiteral("\\A[-+\u2212<]? ?[\\d.,e+-]+( \u00b1 [\\d.,e+-]+)?( [^ \\d]+)?\\z"));
  if (!numbers.match(text).hasMatch()) return text;
  QString plain = text;
  return plain.replace(point, QLatin1String("."));
}

double roundedDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0})
    if (step * power <= value) return step * power;
  return power;
}

double roundStep(double at_least) {
  const double power = std::pow(10.0, std::floor(std::log10(at_least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= at_least) return step * power;
  return 10.0 * power;
}

double exaggerationFor(double shown_mm, double largest_um) {
  return largest_um > 0.0 ? roundedDown(shown_mm / (largest_um * 1e-3)) : 1000.0;
}

}  // namespace spindrift::gui
