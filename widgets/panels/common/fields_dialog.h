// SPDX-License-Identifier: GPL-3.0-or-later
// A small form over some members of a JSON object: empty fields are left out of it, and nothing is taken over that the
// caller refuses.
#pragma once

#include <QDialog>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

class QLineEdit;

namespace spindrift::gui {

class Callout;

struct FormField {
  enum class Kind {
    Text,
    Number,
    Words,    ///< "ACTIVE=1, READY=0" for {"ACTIVE":1,"READY":0}
    Numbers,  ///< "0, 0, 640, 480" for [0,0,640,480]
  };
  std::string key;
  QString label;
  QString hint;  ///< stands in the field while it is empty
  Kind kind = Kind::Text;
};

class FieldsDialog : public QDialog {
  Q_OBJECT
 public:
  /// `accept` gets the object as edited and returns why it is refused, or nothing: then the dialog closes.
  FieldsDialog(const QString& title, const QString& told, nlohmann::json object, std::vector<FormField> fields,
               std::function<QString(const nlohmann::json&)> accept, QWidget* parent = nullptr);
  [[nodiscard]] QLineEdit* field(const std::string& key) const;
  void accept() override;

 private:
  nlohmann::json object_;
  std::vector<FormField> fields_;
  std::vector<QLineEdit*> edits_;
  std::function<QString(const nlohmann::json&)> accept_;
  Callout* refusal_;
};

}  // namespace spindrift::gui
