// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/quantity_box.h"

#include <utility>

#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

/// What is typed in another unit is no round number of the unit of files.
constexpr int exact_decimals = 9;

}  // namespace

QuantityBox::QuantityBox(QString unit, int decimals, QWidget* parent)
    : QDoubleSpinBox(parent), unit_(std::move(unit)), decimals_(decimals) {
  followUnits();
  connect(&UnitsNotifier::instance(), &UnitsNotifier::changed, this, &QuantityBox::followUnits);
}

void QuantityBox::followUnits() {
  const QSignalBlocker quiet(this);
  const double kept = value();
  const ShownUnit unit = shownUnit(unit_);
  setDecimals(unit.converted() ? exact_decimals : decimals_);
  setSuffix(QLatin1Char(' ') + unit.name);
  setValue(kept);
}

void QuantityBox::setUnit(const QString& unit) {
  unit_ = unit;
  followUnits();
}

QString QuantityBox::typed(QString text) const {
  if (text.startsWith(prefix())) text.remove(0, prefix().size());
  if (text.endsWith(suffix())) text.chop(suffix().size());
  return text.trimmed();
}

QString QuantityBox::textFromValue(double value) const {
  const ShownUnit unit = shownUnit(unit_);
  return unit.converted() ? locale().toString(unit.shown(value), 'f', unit.decimals(decimals_))
                          : QDoubleSpinBox::textFromValue(value);
}

double QuantityBox::valueFromText(const QString& text) const {
  const ShownUnit unit = shownUnit(unit_);
  if (!unit.converted() || (!specialValueText().isEmpty() && text == specialValueText()))
    return QDoubleSpinBox::valueFromText(text);
  return unit.stored(typedNumber(typed(text)).value_or(unit.shown(value())));
}

QValidator::State QuantityBox::validate(QString& text, int& at) const {
  const ShownUnit unit = shownUnit(unit_);
  if (!unit.converted() || (!specialValueText().isEmpty() && text == specialValueText()))
    return QDoubleSpinBox::validate(text, at);
  const auto number = typedNumber(typed(text));
  if (!number) return typed(text).isEmpty() ? QValidator::Intermediate : QValidator::Invalid;
  const double value = unit.stored(*number);
  return value >= minimum() && value <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
}

}  // namespace spindrift::gui
