// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/artefact_fields.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <cmath>

#include "core/base/text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/editor_table.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

QString shownValue(const nlohmann::json& value) {
  if (value.is_number()) return shownNumbers(QString::fromStdString(exactNumber(value.get<double>())));
  return value.is_string() ? QString::fromStdString(value.get<std::string>()) : QString();
}

QColor toneOfFinding(const ArtefactFinding& f) {
  return theme().tone(f.wrong ? Tone::Bad : Tone::Attention);
}

bool isText(const std::string& key) {
  return key == "id" || key == "material" || key == "serial_number" || key == "reference_hole";
}

}  // namespace

void markCells(QTableWidget* table, const std::vector<ArtefactFinding>& findings, const std::string& key,
               int first_column) {
  const QSignalBlocker quiet(table);
  for (int row = 0; row < table->rowCount(); ++row) {
    for (int column = 0; column < table->columnCount(); ++column) {
      if (QTableWidgetItem* item = table->item(row, column)) {
        item->setData(Qt::ForegroundRole, {});
        item->setIcon({});
        item->setToolTip({});
      }
    }
  }
  for (const ArtefactFinding& f : findings) {
    if (f.key != key || f.row < 0) continue;
    QTableWidgetItem* item = table->item(f.row, std::max(0, f.column) + first_column);
    if (item == nullptr) continue;
    item->setForeground(toneOfFinding(f));
    item->setIcon(icon("alert", toneOfFinding(f)));
    item->setToolTip(coreSentence(f.sentence));
  }
}

ArtefactFields::ArtefactFields(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* form = new QGridLayout;
  form->setSpacing(8);
  for (const int title : {0, 2}) {  // titles have room for a line where the pane is wide
    form->setColumnStretch(title, 2);
    form->setColumnStretch(title + 1, 3);
  }
  addField(form, 0, 0, tr("Name"), "id", 1, tr("As the touches name it"));
  addField(form, 0, 1, tr("Serial number"), "serial_number", 1, tr("Goes into the report"));
  addField(form, 1, 0, tr("Material"), "material", 1, tr("Goes into the report"));
  addField(form, 1, 1, tr("Expansion / (µm/(m·K))"), "expansion_um_per_m_K", 1, tr("Steel 11.5, Invar 1.2"));
  addField(form, 2, 0, tr("Temperature / °C"), "temperature_degC", 1, tr("Of the artefact, where no sensor says it"));
  addField(form, 2, 1, tr("Certificate ± / µm"), "certificate_uncertainty_um", 1,
           tr("Standard uncertainty of a calibrated position"));
  addField(form, 3, 0, tr("Hole diameter / mm"), "hole_diameter_mm", 1, {});
  addField(form, 3, 1, tr("Reference hole"), "reference_hole", 1, tr("H1, H2, …"));
  addField(form, 4, 0, tr("Reference at / mm"), "reference_in_table_mm", 3,
           tr("x, y, z of the reference hole from the centre of the rotary axis at 0°"));
  addField(form, 4, 1, tr("Direction at 0°"), "direction_at_c0", 3, tr("Along the bar, from H1 on"));
  column->addLayout(form);
  features_ = makeEditor({}, tr("Holes or balls"));
  column->addWidget(features_, 1);
  auto* buttons = new QHBoxLayout;
  auto* add = makeButton(tr("Add row"), "plus");
  auto* remove = makeButton(tr("Remove row"), "trash");
  buttons->addWidget(add);
  buttons->addWidget(remove);
  buttons->addStretch();
  column->addLayout(buttons);
  connect(add, &QPushButton::clicked, this, &ArtefactFields::addFeature);
  makeRemoving(remove, features_, [this] {
    showDistances();
    Q_EMIT edited();
  });
  connect(features_, &QTableWidget::itemChanged, this, [this] {
    if (filling_) return;
    showDistances();
    Q_EMIT edited();
  });
}

void ArtefactFields::addField(QGridLayout* form, int row, int column, const QString& title, const std::string& key,
                              int parts, const QString& tip) {
  auto* label = new QLabel(keptTogether(title));
  label->setWordWrap(true);  // titles of some languages are long
  label->setToolTip(tip);
  labels_[key] = label;
  form->addWidget(label, row, 2 * column);
  auto* line = new QHBoxLayout;
  line->setSpacing(4);
  for (int k = 0; k < parts; ++k) {
    auto* edit = new QLineEdit;
    edit->setAccessibleName(parts > 1 ? QStringLiteral("%1, %2").arg(title, QString(QLatin1Char("xyz"[k]))) : title);
    edit->setMinimumWidth(parts > 1 ? 50 : 62);
    edit->setMinimumHeight(sizes::control_height);
    edit->setToolTip(tip);
    connect(edit, &QLineEdit::editingFinished, this, [this, edit] {
      if (!edit->isModified() || filling_) return;
      edit->setModified(false);
      Q_EMIT edited();
    });
    fields_[key].push_back(edit);
    line->addWidget(edit, 1);
  }
  form->addLayout(line, row, 2 * column + 1);
}

QLineEdit* ArtefactFields::field(const char* key, int column) const {
  return fields_.at(key).at(static_cast<std::size_t>(column));
}

void ArtefactFields::show(const nlohmann::json& artefact) {
  filling_ = true;
  holes_ = artefact.value("kind", "") == "hole_bar";
  for (const auto& [key, edits] : fields_) {
    const bool of_holes = key == "hole_diameter_mm" || key == "reference_hole" || key == "reference_in_table_mm" ||
                          key == "direction_at_c0";
    labels_[key]->setVisible(holes_ || !of_holes);
    const nlohmann::json value = artefact.value(key, nlohmann::json());
    for (std::size_t k = 0; k < edits.size(); ++k) {
      edits[k]->setVisible(holes_ || !of_holes);
      if (edits.size() == 1) {
        edits[k]->setText(shownValue(value));
      } else {
        edits[k]->setText(value.is_array() && k < value.size() ? shownValue(value[k]) : QString());
      }
    }
  }
  features_->clear();
  features_->setRowCount(0);
  if (holes_) {
    features_->setColumnCount(2);
    features_->setHorizontalHeaderLabels({tr("Hole"), tr("Calibrated position along the bar / mm")});
    const nlohmann::json list = artefact.value("nominal_positions_mm", nlohmann::json::array());
    features_->setRowCount(static_cast<int>(list.size()));
    for (int row = 0; row < features_->rowCount(); ++row) {
      setText(features_, row, 1, shownValue(list[static_cast<std::size_t>(row)]));
    }
  } else {
    features_->setColumnCount(6);
    features_->setHorizontalHeaderLabels(
        {tr("Ball"), tr("Ø / mm"), tr("x / mm"), tr("y / mm"), tr("z / mm"), tr("Distance to ball 1 / mm")});
    features_->horizontalHeaderItem(5)->setToolTip(tr("Distance from the first ball"));
    const nlohmann::json list = artefact.value("balls", nlohmann::json::array());
    features_->setRowCount(static_cast<int>(list.size()));
    for (int row = 0; row < features_->rowCount(); ++row) {
      const nlohmann::json& ball = list[static_cast<std::size_t>(row)];
      setText(features_, row, 0, shownValue(ball.value("id", nlohmann::json())));
      setText(features_, row, 1, shownValue(ball.value("diameter_mm", nlohmann::json())));
      const nlohmann::json at = ball.value("certified_mm", nlohmann::json::array());
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        setText(features_, row, 2 + k, i < at.size() ? shownValue(at[i]) : QString());
      }
    }
  }
  filling_ = false;
  showDistances();
}

/// What follows from the cells and is not typed: names of holes, distances of balls.
void ArtefactFields::showDistances() {
  const QSignalBlocker quiet(features_);
  const auto fixed = [this](int row, int column, const QString& text) {
    setText(features_, row, column, text);
    features_->item(row, column)->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  };
  for (int row = 0; row < features_->rowCount(); ++row) {
    if (holes_) {
      fixed(row, 0, QStringLiteral("H%1").arg(row + 1));
      continue;
    }
    double squares = 0.0;
    bool known = true;
    for (int k = 0; k < 3; ++k) {
      const std::optional<double> here = typedNumber(textAt(features_, row, 2 + k));
      const std::optional<double> first = typedNumber(textAt(features_, 0, 2 + k));
      known = known && here && first;
      if (known) squares += (*here - *first) * (*here - *first);
    }
    fixed(row, 5, known ? decimalText(std::sqrt(squares), 'f', 4) : QStringLiteral("–"));
  }
}

nlohmann::json ArtefactFields::read(const nlohmann::json& before) const {
  nlohmann::json artefact = before;
  for (const auto& [key, edits] : fields_) {
    if (edits.front()->isHidden()) continue;
    if (edits.size() > 1) {
      bool any = false;
      nlohmann::json list = nlohmann::json::array();
      for (const QLineEdit* edit : edits) {
        any = any || !edit->text().trimmed().isEmpty();
        list.push_back(numberOrText(edit->text().trimmed()));
      }
      if (any || before.contains(key)) artefact[key] = list;
      continue;
    }
    const QString text = edits.front()->text().trimmed();
    if (text.isEmpty() && key != "id") {
      artefact.erase(key);
    } else {
      artefact[key] = isText(key) ? nlohmann::json(text.toStdString()) : numberOrText(text);
    }
  }
  nlohmann::json list = nlohmann::json::array();
  for (int row = 0; row < features_->rowCount(); ++row) {
    if (holes_) {
      list.push_back(numberOrText(textAt(features_, row, 1)));
      continue;
    }
    nlohmann::json ball = nlohmann::json::object();
    if (before.contains("balls") && row < static_cast<int>(before["balls"].size())) {
      ball = before["balls"][static_cast<std::size_t>(row)];
    }
    ball["id"] = textAt(features_, row, 0).toStdString();
    ball["diameter_mm"] = numberOrText(textAt(features_, row, 1));
    ball["certified_mm"] = {numberOrText(textAt(features_, row, 2)), numberOrText(textAt(features_, row, 3)),
                            numberOrText(textAt(features_, row, 4))};
    list.push_back(ball);
  }
  artefact[holes_ ? "nominal_positions_mm" : "balls"] = list;
  return artefact;
}

void ArtefactFields::mark(const std::vector<ArtefactFinding>& findings) {
  markCells(features_, findings, holes_ ? "nominal_positions_mm" : "balls", holes_ ? 1 : 0);
  for (const auto& [key, edits] : fields_) {
    for (std::size_t k = 0; k < edits.size(); ++k) {
      const ArtefactFinding* found = nullptr;
      for (const ArtefactFinding& f : findings) {
        if (f.key == key && (f.column < 0 || f.column == static_cast<int>(k))) found = &f;
      }
      QPalette palette = edits[k]->parentWidget() != nullptr ? edits[k]->parentWidget()->palette() : QPalette();
      if (found != nullptr) palette.setColor(QPalette::Text, toneOfFinding(*found));
      edits[k]->setPalette(palette);
      edits[k]->setToolTip(found != nullptr ? coreSentence(found->sentence) : labels_[key]->toolTip());
    }
  }
}

void ArtefactFields::addFeature() {
  filling_ = true;
  const int row = features_->rowCount();
  features_->insertRow(row);
  if (holes_) {
    setText(features_, row, 1, {});
  } else {
    setText(features_, row, 0, QStringLiteral("B%1").arg(row + 1));
    setText(features_, row, 1, row > 0 ? textAt(features_, row - 1, 1) : QStringLiteral("25"));
    for (int k = 0; k < 3; ++k) setText(features_, row, 2 + k, row == 0 ? QStringLiteral("0") : QString());
  }
  filling_ = false;
  showDistances();
  features_->setCurrentCell(row, holes_ ? 1 : 2);
  Q_EMIT edited();
}

}  // namespace spindrift::gui
