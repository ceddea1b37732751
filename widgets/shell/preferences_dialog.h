// SPDX-License-Identifier: GPL-3.0-or-later
// Edit > Preferences: every change holds at once, there is nothing to apply.
#pragma once

#include <QDialog>
#include <utility>
#include <vector>

#include "widgets/common/preferences.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLineEdit;

namespace spindrift::gui {

class Callout;

/// Languages to choose from, as they call themselves, with what Preferences::language holds. The first is that of the
/// system.
[[nodiscard]] std::vector<std::pair<QString, QString>> languageChoices();

class PreferencesDialog : public QDialog {
  Q_OBJECT
 public:
  explicit PreferencesDialog(QWidget* parent = nullptr);

 private:
  void fill();
  void take();
  void takeFolder();

  bool filling_ = false;
  QComboBox* look_;
  QComboBox* language_;
  QComboBox* lengths_;
  QComboBox* angles_;
  QComboBox* temperatures_;
  QComboBox* decimals_;
  QLineEdit* folder_;
  Callout* problem_;
  QDoubleSpinBox* goal_um_;
  QDoubleSpinBox* goal_urad_;
  QCheckBox* quitting_;
  QCheckBox* discarding_;
};

}  // namespace spindrift::gui
