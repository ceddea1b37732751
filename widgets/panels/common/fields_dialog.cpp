// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/common/fields_dialog.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/base/text.h"
#include "widgets/common/editor_table.h"
#include "widgets/common/parts.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

/// Numbers of a list keep their point: commas part them.
QString textOf(const nlohmann::json& value, bool in_list = false) {
  if (value.is_number()) {
    const QString text = QString::fromStdString(exactNumber(value.get<double>()));
    return in_list ? text : shownNumbers(text);
  }
  if (value.is_string()) return QString::fromStdString(value.get<std::string>());
  if (value.is_null()) return {};
  if (value.is_array()) {
    QStringList numbers;
    for (const nlohmann::json& each : value) numbers << textOf(each, true);
    return numbers.join(QStringLiteral(", "));
  }
  if (!value.is_object()) return QString::fromStdString(value.dump());
  QStringList words;
  for (const auto& [word, number] : value.items())
    words << QString::fromStdString(word) + QLatin1Char('=') + textOf(number, true);
  return words.join(QStringLiteral(", "));
}

/// What is not of the form WORD=NUMBER stays text, so that the reader can say what is wrong with it.
nlohmann::json wordsOf(const QString& text) {
  nlohmann::json words = nlohmann::json::object();
  for (const QString& part : text.split(QLatin1Char(','), Qt::SkipEmptyParts)) {
    const qsizetype cut = part.lastIndexOf(QLatin1Char('='));
    if (cut <= 0) return text.toStdString();
    words[part.left(cut).trimmed().toStdString()] = numberOrText(part.mid(cut + 1).trimmed());
  }
  return words;
}

}  // namespace

FieldsDialog::FieldsDialog(const QString& title, const QString& told, nlohmann::json object,
                           std::vector<FormField> fields, std::function<QString(const nlohmann::json&)> accept,
                           QWidget* parent)
    : QDialog(parent), object_(std::move(object)), fields_(std::move(fields)), accept_(std::move(accept)) {
  setWindowTitle(title);
  setAttribute(Qt::WA_DeleteOnClose);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 16, 24, 16);
  column->setSpacing(12);
  column->addWidget(makeLabel(title, "sectionTitle"));
  auto* text = makeLabel(told, "instruction");
  text->setWordWrap(true);
  column->addWidget(text);
  auto* grid = new QGridLayout;
  grid->setSpacing(8);
  for (const FormField& field : fields_) {
    auto* edit = new QLineEdit(textOf(object_.value(field.key, nlohmann::json())));
    edit->setAccessibleName(field.label);
    edit->setPlaceholderText(field.hint);
    edit->setMinimumWidth(320);
    const int row = grid->rowCount();
    auto* label = new QLabel(field.label);
    label->setBuddy(edit);
    grid->addWidget(label, row, 0);
    grid->addWidget(edit, row, 1);
    edits_.push_back(edit);
  }
  column->addLayout(grid);
  refusal_ = new Callout;
  refusal_->hide();
  column->addWidget(refusal_);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch();
  auto* cancel = makeButton(tr("Cancel"), nullptr);
  auto* take = makeButton(tr("Take over"), nullptr, "primary");
  take->setDefault(true);
  buttons->addWidget(cancel);
  buttons->addWidget(take);
  column->addLayout(buttons);
  setMinimumWidth(560);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(take, &QPushButton::clicked, this, &FieldsDialog::accept);
}

QLineEdit* FieldsDialog::field(const std::string& key) const {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (fields_[i].key == key) return edits_[i];
  }
  return nullptr;
}

void FieldsDialog::accept() {
  nlohmann::json edited = object_;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const QString text = edits_[i]->text().trimmed();
    if (text.isEmpty()) {
      edited.erase(fields_[i].key);
      continue;
    }
    switch (fields_[i].kind) {
      case FormField::Kind::Text:
        edited[fields_[i].key] = text.toStdString();
        break;
      case FormField::Kind::Number:
        edited[fields_[i].key] = numberOrText(text);
        break;
      case FormField::Kind::Numbers: {
        nlohmann::json& numbers = edited[fields_[i].key] = nlohmann::json::array();
        for (const QString& part : text.split(QLatin1Char(','))) numbers.push_back(numberOrText(part.trimmed()));
        break;
      }
      case FormField::Kind::Words:
        edited[fields_[i].key] = wordsOf(text);
        break;
    }
  }
  const QString refused = accept_(edited);
  if (refused.isEmpty()) {
    QDialog::accept();
  } else {
    refusal_->show(Tone::Bad, refused);
  }
}

}  // namespace spindrift::gui
