// SPDX-License-Identifier: GPL-3.0-or-later
// A box for a quantity that is kept in the unit of files and typed in the unit on screen.
#pragma once

#include <QDoubleSpinBox>
#include <QString>

namespace spindrift::gui {

/// value(), the range and the step have the unit of files; what is read and typed, the suffix included, that of the
/// preferences.
class QuantityBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  /// `unit` as in files ("um"), `decimals` in this unit.
  QuantityBox(QString unit, int decimals, QWidget* parent = nullptr);

  [[nodiscard]] QString textFromValue(double value) const override;
  [[nodiscard]] double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& at) const override;
  /// Of another quantity; the number of the unit of files stays.
  void setUnit(const QString& unit);

 private:
  /// Without prefix and suffix.
  [[nodiscard]] QString typed(QString text) const;
  void followUnits();

  QString unit_;
  int decimals_;
};

}  // namespace spindrift::gui
