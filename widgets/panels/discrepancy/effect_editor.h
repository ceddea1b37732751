// SPDX-License-Identifier: GPL-3.0-or-later
// The form for one effect of the user's: every key of an entry of effects.json is a field, and what is wrong with it is
// said below it. What is checked, and how, is known to the core library alone; this knows which field a place in the
// file belongs to.
#pragma once

#include <QWidget>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/machine/component.h"

class QComboBox;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;
class QVBoxLayout;

namespace spindrift::gui {

class Callout;

class EffectEditor : public QWidget {
  Q_OBJECT
 public:
  explicit EffectEditor(QWidget* parent = nullptr);
  /// Fills the form; keys that it does not know are kept.
  void setEntry(const nlohmann::json& entry);
  /// As it stands, valid or not.
  [[nodiscard]] nlohmann::json entry() const;
  /// Columns of the log that can be drivers.
  void setColumns(const QStringList& columns);
  /// Shows a sentence below the field of `place` ("shape[0].EX", "drivers[1]"); takes away all others. False: there is
  /// no such field.
  bool showProblem(const std::string& place, const QString& sentence);
  void clearProblems();
  /// The sentence that is shown below a field; empty: none.
  [[nodiscard]] QString problemAt(const std::string& field) const;

  /// Where that sentence is; null: nowhere.
  [[nodiscard]] QWidget* problemWidget() const;
  /// The field it is about is the one that is being typed in.
  [[nodiscard]] bool problemHasFocus() const;

  [[nodiscard]] QLineEdit* id() const { return id_; }
  [[nodiscard]] QLineEdit* title() const { return title_; }
  [[nodiscard]] QLineEdit* drivers() const { return drivers_; }
  [[nodiscard]] QComboBox* dynamics() const { return dynamics_; }
  [[nodiscard]] QLineEdit* expression(std::size_t gain, Component component) const;
  [[nodiscard]] std::size_t gainCount() const { return gains_.size(); }
  [[nodiscard]] QPushButton* addGainButton() const { return add_gain_; }

 Q_SIGNALS:
  void edited();

 private:
  struct Field {
    QWidget* control = nullptr;
    QVBoxLayout* below = nullptr;  ///< where the sentence goes
    Callout* problem = nullptr;    ///< made when it is needed
  };
  struct Gain {
    QWidget* box = nullptr;
    QLineEdit* unit = nullptr;
    std::array<QLineEdit*, 6> expression{};
  };
  void addField(QVBoxLayout* column, const std::string& key, const QString& name, QWidget* control,
                const QString& tip = {});
  QLineEdit* addLine(QVBoxLayout* column, const std::string& key, const QString& name, const QString& placeholder,
                     const QString& tip = {});
  void addGain(const nlohmann::json& column);
  void removeGain(std::size_t gain);
  void rebuildGains(const nlohmann::json& shape);
  [[nodiscard]] nlohmann::json shapeJson() const;
  [[nodiscard]] const Field* marked() const;
  void touched();

  nlohmann::json entry_;  ///< as it was given
  std::map<std::string, Field> fields_;
  QLineEdit* id_;
  QLineEdit* title_;
  QPlainTextEdit* physics_;
  QLineEdit* drivers_;
  QComboBox* column_;
  QComboBox* dynamics_;
  QWidget* lag_;
  QLineEdit* lag_from_;
  QLineEdit* lag_to_;
  QComboBox* sign_;
  QLineEdit* contains_;
  QPlainTextEdit* references_;
  QVBoxLayout* shape_column_;
  QPushButton* add_gain_;
  std::vector<Gain> gains_;
  bool filling_ = false;
};

}  // namespace spindrift::gui
