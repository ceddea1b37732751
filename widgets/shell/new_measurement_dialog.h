// SPDX-License-Identifier: GPL-3.0-or-later
// The machine of a new measurement: one like those the virtual machine has, the one at hand, or one from a file. What
// is chosen is a beginning: the Machine page edits it.
#pragma once

#include <QDialog>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace spindrift::gui {

class Callout;

class NewMeasurementDialog : public QDialog {
  Q_OBJECT
 public:
  /// `at_hand`: the machine of the campaign that is open (machine.json), offered first.
  explicit NewMeasurementDialog(const std::optional<nlohmann::json>& at_hand, QWidget* parent = nullptr);

  /// The chosen machine.json with the name that was typed.
  [[nodiscard]] nlohmann::json machine() const;
  [[nodiscard]] QListWidget* choices() const { return choices_; }
  [[nodiscard]] QLineEdit* name() const { return name_; }
  [[nodiscard]] QPushButton* startButton() const { return start_; }
  /// Adds the machine of a file to the choices and takes it. A file that is none is told in the dialog.
  void takeFile(const QString& file);

 private:
  struct Choice {
    QString title;
    QString note;
    nlohmann::json machine;
  };
  void add(Choice choice);
  void showChoice();

  std::vector<Choice> all_;
  QListWidget* choices_;
  QLabel* note_;
  QLineEdit* name_;
  Callout* problem_;
  QPushButton* start_;
};

}  // namespace spindrift::gui
