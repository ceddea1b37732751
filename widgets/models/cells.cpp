// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/models/cells.h"

#include <QCoreApplication>
#include <cmath>

#include "core/base/text.h"
#include "core/machine/parameter_meanings.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

Cell nameCell(const QString& text) {
  Cell cell{text};
  cell.bold = true;
  return cell;
}

Cell dashCell() {
  Cell cell{QStringLiteral("–")};
  cell.right = true;
  return cell;
}

Cell numberCell(double value, int decimals) {
  Cell cell = dashCell();
  if (!std::isfinite(value)) return cell;
  cell.text = decimalText(value, 'f', decimals);
  return cell;
}

Cell quantityCell(double value, double sigma) {
  Cell cell = dashCell();
  if (std::isfinite(value))
    cell.text = shownNumbers(QString::fromStdString(withUncertainty(value, sigma, ""))).trimmed();
  return cell;
}

Cell rightCell(const QString& text) {
  Cell cell{text.trimmed()};
  cell.right = true;
  return cell;
}

Cell toneCell(const QString& text, Tone tone) {
  Cell cell{text};
  cell.tone = tone;
  cell.icon = toneIcon(tone);
  return cell;
}

QString fromCore(const std::string& text) {
  return QString::fromStdString(text);
}

QString parameterTitle(const std::string& name) {
  const ErrorParameter* known = errorParameter(name);
  return QString::fromStdString(known != nullptr ? known->symbol : name.substr(0, name.find('_')));
}

QString parameterLabel(const std::string& name) {
  const ErrorParameter* known = errorParameter(name);
  if (known == nullptr || known->iso_symbol.empty() || known->iso_symbol == known->symbol) return parameterTitle(name);
  return QStringLiteral("%1 (%2)").arg(parameterTitle(name), QString::fromStdString(known->iso_symbol));
}

QString parameterUnit(const std::string& name) {
  const std::size_t at = name.find('_');
  if (at == std::string::npos) return {};
  QString unit = QString::fromStdString(name.substr(at + 1));
  return unitText(unit.replace(QStringLiteral("_per_"), QStringLiteral("/")).toStdString());
}

QString firstOf(const QStringList& names, qsizetype most) {
  const auto joined = [](const QStringList& some, const QString& last) {
    return some.isEmpty()
               ? last
               : QCoreApplication::translate("Cells", "%1 and %2").arg(some.join(QStringLiteral(", ")), last);
  };
  if (names.isEmpty()) return {};
  if (names.size() <= most) return joined(names.mid(0, names.size() - 1), names.back());
  return joined(names.mid(0, most), QCoreApplication::translate("Cells", "%1 more").arg(names.size() - most));
}

QString quantityText(double value, double sigma, const QString& unit) {
  if (!std::isfinite(value)) return QStringLiteral("–");
  return shownNumbers(QString::fromStdString(withUncertainty(value, sigma, unit.toStdString())));
}

}  // namespace spindrift::gui
