// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/effect_editor.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QStyle>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/text.h"
#include "widgets/common/editor_table.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr int two_lines_px = 64;

std::string trimmed(const QString& text) {
  return text.trimmed().toStdString();
}

/// "spindle_rpm^1.5, T_a_degC + T_b_degC" -> ["spindle_rpm^1.5", ["T_a_degC", "T_b_degC"]].
nlohmann::json driversFrom(const QString& text) {
  static const QRegularExpression together(QStringLiteral("\\s\\+\\s"));
  nlohmann::json out = nlohmann::json::array();
  for (const QString& alternative : text.split(QLatin1Char(','))) {
    const QStringList inputs = alternative.trimmed().split(together);
    if (inputs.size() == 1) {
      out.push_back(trimmed(inputs.front()));
      continue;
    }
    nlohmann::json list = nlohmann::json::array();
    for (const QString& input : inputs) list.push_back(trimmed(input));
    out.push_back(std::move(list));
  }
  return out;
}

QString driversText(const nlohmann::json& drivers) {
  QStringList out;
  if (!drivers.is_array()) return {};
  for (const nlohmann::json& alternative : drivers) {
    QStringList inputs;
    for (const nlohmann::json& input : alternative.is_array() ? alternative : nlohmann::json::array({alternative}))
      if (input.is_string()) inputs << QString::fromStdString(input.get<std::string>());
    out << inputs.join(QStringLiteral(" + "));
  }
  return out.join(QStringLiteral(", "));
}

QString textOf(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return {};
  return found->is_string() ? QString::fromStdString(found->get<std::string>()) : QString::fromStdString(found->dump());
}

nlohmann::json listFrom(const QString& text, QChar separator) {
  nlohmann::json out = nlohmann::json::array();
  for (const QString& part : text.split(separator, Qt::SkipEmptyParts))
    if (!part.trimmed().isEmpty()) out.push_back(trimmed(part));
  return out;
}

QString listText(const nlohmann::json& object, const char* key, const QString& separator) {
  QStringList out;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return {};
  for (const nlohmann::json& item : *found)
    if (item.is_string()) out << QString::fromStdString(item.get<std::string>());
  return out.join(separator);
}

void setOrErase(nlohmann::json& object, const char* key, nlohmann::json value) {
  if (value.empty()) {
    object.erase(key);
  } else {
    object[key] = std::move(value);
  }
}

QPlainTextEdit* makeText(const QString& placeholder) {
  auto* edit = new QPlainTextEdit;
  edit->setPlaceholderText(placeholder);
  edit->setTabChangesFocus(true);
  edit->setFixedHeight(two_lines_px);
  return edit;
}

QString shapeKey(std::size_t gain, std::string_view key) {
  return QStringLiteral("shape[%1].%2").arg(gain).arg(QLatin1String(key.data(), static_cast<qsizetype>(key.size())));
}

}  // namespace

/// A bound of the time constant; where there is none, pale words in its place would mean nothing.
static void askFor(QLineEdit& bound, bool lag) {
  bound.setEnabled(lag);
  bound.setPlaceholderText(lag ? EffectEditor::tr("as the data allow") : QString());
}

EffectEditor::EffectEditor(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 8, 0);
  column->setSpacing(8);
  id_ = addLine(column, "id", tr("Id"), QStringLiteral("pointing.collimation"),
                tr("A stable name in lower case; results, models and reports use it"));
  title_ = addLine(column, "title", tr("Title"), tr("collimation error of the tube"),
                   tr("What people call it, as it stands in a sentence"));
  physics_ = makeText(tr("What happens in the machine, in one sentence"));
  addField(column, "physics", tr("Physics"), physics_);

  column->addWidget(makeLabel(tr("What drives it"), "sectionTitle"));
  auto* driver_line = new QWidget;
  auto* driver_row = new QHBoxLayout(driver_line);
  driver_row->setContentsMargins(0, 0, 0, 0);
  driver_row->setSpacing(8);
  drivers_ = new QLineEdit;
  drivers_->setAccessibleName(tr("Drivers"));
  drivers_->setPlaceholderText(tr("none: constant"));
  column_ = new QComboBox;
  column_->setAccessibleName(tr("Add a column of the log"));
  column_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  column_->setMinimumContentsLength(12);
  driver_row->addWidget(drivers_, 1);
  driver_row->addWidget(column_);
  addField(column, "drivers", tr("Drivers"), driver_line,
           tr("Columns of log.csv, with a power if need be (spindle_rpm^1.5). A comma separates alternatives; a plus "
              "sign between spaces joins inputs that act together, each with a gain of its own."));
  dynamics_ = new QComboBox;
  dynamics_->addItem(tr("none: at once"), QStringLiteral("none"));
  dynamics_->addItem(tr("first-order time constant"), QStringLiteral("lag"));
  dynamics_->addItem(tr("step at an unknown time"), QStringLiteral("step"));
  dynamics_->addItem(tr("pulse at an unknown time"), QStringLiteral("pulse"));
  dynamics_->setAccessibleName(tr("Dynamics"));
  addField(column, "dynamics", tr("Dynamics"), dynamics_);
  lag_ = new QWidget;
  auto* lag_row = new QHBoxLayout(lag_);
  lag_row->setContentsMargins(0, 0, 0, 0);
  lag_row->setSpacing(8);
  lag_from_ = new QLineEdit;
  lag_from_->setAccessibleName(tr("Shortest time constant / s"));
  lag_to_ = new QLineEdit;
  lag_to_->setAccessibleName(tr("Longest time constant / s"));
  lag_row->addWidget(lag_from_, 1);
  lag_row->addWidget(new QLabel(tr("to")));
  lag_row->addWidget(lag_to_, 1);
  lag_row->addWidget(new QLabel(QStringLiteral("s")));
  addField(column, "tau_s", tr("Time constant"), lag_);

  column->addWidget(makeLabel(tr("Shape: deviation of the tool for a gain of one"), "sectionTitle"));
  auto* told =
      makeLabel(tr("Expressions in x, y, z / mm, c / rad, dirx, diry, dirz (direction of approach, ±1); EX, EY, "
                   "EZ in µm, EA, EB, EC in µrad. An empty field is zero."),
                "secondaryText");
  told->setWordWrap(true);
  column->addWidget(told);
  auto* shape = new QWidget;
  shape_column_ = new QVBoxLayout(shape);
  shape_column_->setContentsMargins(0, 0, 0, 0);
  shape_column_->setSpacing(8);
  column->addWidget(shape);
  fields_["shape"] = {shape, shape_column_, nullptr};
  add_gain_ = makeButton(tr("Add a gain"), "plus");
  add_gain_->setToolTip(tr("One more amplitude that is fitted by itself, with expressions of its own"));
  auto* add_line = new QHBoxLayout;
  add_line->addWidget(add_gain_);
  add_line->addStretch(1);
  column->addLayout(add_line);
  sign_ = new QComboBox;
  sign_->addItem(tr("either"), 0);
  sign_->addItem(tr("positive for more of the driver"), 1);
  sign_->addItem(tr("negative for more of the driver"), -1);
  sign_->setAccessibleName(tr("Sign of the first gain"));
  addField(column, "sign", tr("Sign of gain 1"), sign_);
  contains_ =
      addLine(column, "contains", tr("Contains"), tr("ids of simpler effects, separated by commas"),
              tr("Effects that are special cases of this one; they are named instead where they are sufficient"));
  references_ = makeText(tr("Where the physics is described, one a line"));
  addField(column, "references", tr("References"), references_);
  column->addStretch(1);

  connect(physics_, &QPlainTextEdit::textChanged, this, &EffectEditor::touched);
  connect(references_, &QPlainTextEdit::textChanged, this, &EffectEditor::touched);
  for (QLineEdit* edit : {drivers_, lag_from_, lag_to_})
    connect(edit, &QLineEdit::textEdited, this, &EffectEditor::touched);
  connect(sign_, &QComboBox::activated, this, &EffectEditor::touched);
  connect(dynamics_, &QComboBox::currentIndexChanged, this, [this] {
    const bool lag = dynamics_->currentData().toString() == QLatin1String("lag");
    for (QLineEdit* edit : {lag_from_, lag_to_}) askFor(*edit, lag);
    touched();
  });
  connect(column_, &QComboBox::activated, this, [this](int index) {
    if (index > 0) {
      const QString before = drivers_->text().trimmed();
      drivers_->setText(before.isEmpty() ? column_->itemText(index)
                                         : before + QStringLiteral(", ") + column_->itemText(index));
      touched();
    }
    column_->setCurrentIndex(0);
  });
  connect(add_gain_, &QPushButton::clicked, this, [this] {
    addGain({{"gain_unit", "um"}});
    touched();
  });
  setColumns({});
}

void EffectEditor::addField(QVBoxLayout* column, const std::string& key, const QString& name, QWidget* control,
                            const QString& tip) {
  constexpr int name_width = 112;
  auto* field = new QVBoxLayout;
  field->setSpacing(4);
  auto* line = new QHBoxLayout;
  line->setSpacing(8);
  auto* label = new QLabel(name);
  label->setMinimumWidth(name_width);
  label->setToolTip(tip);
  control->setToolTip(tip);
  if (control->accessibleName().isEmpty()) control->setAccessibleName(name);
  line->addWidget(label, 0, Qt::AlignVCenter);
  line->addWidget(control, 1);
  field->addLayout(line);
  column->addLayout(field);
  fields_[key] = {control, field, nullptr};
}

QLineEdit* EffectEditor::addLine(QVBoxLayout* column, const std::string& key, const QString& name,
                                 const QString& placeholder, const QString& tip) {
  auto* edit = new QLineEdit;
  edit->setPlaceholderText(placeholder);
  addField(column, key, name, edit, tip);
  connect(edit, &QLineEdit::textEdited, this, &EffectEditor::touched);
  return edit;
}

void EffectEditor::setColumns(const QStringList& columns) {
  column_->clear();
  column_->addItem(tr("Add a column"));
  column_->addItems(columns);
  column_->setEnabled(!columns.isEmpty());
  int widest = 0;
  for (const QString& name : columns) widest = std::max(widest, column_->fontMetrics().horizontalAdvance(name));
  column_->view()->setMinimumWidth(widest + 48);
}

void EffectEditor::addGain(const nlohmann::json& column) {
  const std::size_t number = gains_.size();
  Gain gain;
  gain.box = new QFrame;
  gain.box->setProperty("role", QStringLiteral("card"));
  auto* body = new QVBoxLayout(gain.box);
  body->setContentsMargins(12, 8, 12, 8);
  body->setSpacing(4);
  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  head->addWidget(makeLabel(tr("Gain %1").arg(number + 1), "sectionTitle"));
  head->addStretch(1);
  head->addWidget(new QLabel(tr("Unit")));
  gain.unit = new QLineEdit(unitText(textOf(column, "gain_unit").toStdString()));
  gain.unit->setAccessibleName(tr("Unit of gain %1").arg(number + 1));
  gain.unit->setPlaceholderText(QStringLiteral("um"));
  gain.unit->setToolTip(tr("Of the gain alone, as it is written in results: um, urad, um_per_m"));
  gain.unit->setFixedWidth(112);
  head->addWidget(gain.unit);
  auto* remove = makeButton(tr("Remove gain"), "trash", "quiet");
  remove->setVisible(number > 0);
  head->addWidget(remove);
  body->addLayout(head);
  fields_[shapeKey(number, "gain_unit").toStdString()] = {gain.unit, body, nullptr};
  connect(gain.unit, &QLineEdit::textEdited, this, &EffectEditor::touched);
  connect(remove, &QPushButton::clicked, this, [this, number] { removeGain(number); });
  for (const Component c : all_components) {
    const std::string key(toString(c));
    auto* field = new QVBoxLayout;
    field->setSpacing(4);
    auto* line = new QHBoxLayout;
    line->setSpacing(8);
    auto* label = new QLabel(QStringLiteral("%1 / %2").arg(componentName(c), componentUnit(c)));
    label->setMinimumWidth(72);
    auto* edit = new QLineEdit(textOf(column, key.c_str()));
    edit->setAccessibleName(tr("%1 of gain %2").arg(componentName(c)).arg(number + 1));
    edit->setPlaceholderText(QStringLiteral("0"));
    line->addWidget(label);
    line->addWidget(edit, 1);
    field->addLayout(line);
    body->addLayout(field);
    gain.expression[static_cast<std::size_t>(c)] = edit;
    fields_[shapeKey(number, key).toStdString()] = {edit, field, nullptr};
    connect(edit, &QLineEdit::textEdited, this, &EffectEditor::touched);
  }
  fields_["shape[" + std::to_string(number) + "]"] = {gain.box, body, nullptr};
  shape_column_->addWidget(gain.box);
  gains_.push_back(gain);
}

void EffectEditor::removeGain(std::size_t number) {
  nlohmann::json shape = shapeJson();
  shape.erase(number);
  // Later: the button that was pressed is one of those that go.
  QMetaObject::invokeMethod(
      this,
      [this, shape] {
        rebuildGains(shape);
        touched();
      },
      Qt::QueuedConnection);
}

void EffectEditor::rebuildGains(const nlohmann::json& shape) {
  std::erase_if(fields_, [](const auto& entry) { return entry.first.starts_with("shape["); });
  for (const Gain& gain : gains_) {
    shape_column_->removeWidget(gain.box);
    gain.box->hide();
    gain.box->deleteLater();
  }
  gains_.clear();
  if (shape.is_array()) {
    for (const nlohmann::json& column : shape)
      if (column.is_object()) addGain(column);
  }
  if (gains_.empty()) addGain({{"gain_unit", "um"}});
}

nlohmann::json EffectEditor::shapeJson() const {
  nlohmann::json shape = nlohmann::json::array();
  for (const Gain& gain : gains_) {
    nlohmann::json column{{"gain_unit", trimmed(fileUnit(gain.unit->text()))}};
    for (const Component c : all_components) {
      const std::string text = trimmed(gain.expression[static_cast<std::size_t>(c)]->text());
      if (!text.empty()) column[std::string(toString(c))] = text;
    }
    shape.push_back(std::move(column));
  }
  return shape;
}

void EffectEditor::setEntry(const nlohmann::json& entry) {
  filling_ = true;
  entry_ = entry.is_object() ? entry : nlohmann::json::object();
  clearProblems();
  id_->setText(textOf(entry_, "id"));
  title_->setText(textOf(entry_, "title"));
  physics_->setPlainText(textOf(entry_, "physics"));
  drivers_->setText(driversText(entry_.value("drivers", nlohmann::json())));
  const QString dynamics = textOf(entry_, "dynamics");
  dynamics_->setCurrentIndex(std::max(0, dynamics_->findData(dynamics)));
  const nlohmann::json bounds = entry_.value("tau_s", nlohmann::json());
  for (std::size_t i = 0; i < 2; ++i) {
    const nlohmann::json bound = bounds.is_array() && bounds.size() > i ? bounds[i] : nlohmann::json();
    // What was typed and is no number comes back as it was typed.
    (i == 0 ? lag_from_ : lag_to_)
        ->setText(bound.is_number()   ? shownNumbers(QString::fromStdString(exactNumber(bound.get<double>())))
                  : bound.is_string() ? QString::fromStdString(bound.get<std::string>())
                                      : QString());
  }
  const bool lag = dynamics_->currentData().toString() == QLatin1String("lag");
  for (QLineEdit* edit : {lag_from_, lag_to_}) askFor(*edit, lag);
  const nlohmann::json sign = entry_.value("sign", nlohmann::json(0));
  sign_->setCurrentIndex(sign.is_number() ? std::max(0, sign_->findData(static_cast<int>(sign.get<double>()))) : 0);
  contains_->setText(listText(entry_, "contains", QStringLiteral(", ")));
  references_->setPlainText(listText(entry_, "references", QStringLiteral("\n")));
  rebuildGains(entry_.value("shape", nlohmann::json()));
  filling_ = false;
}

nlohmann::json EffectEditor::entry() const {
  nlohmann::json out = entry_;
  out["id"] = trimmed(id_->text());
  const auto text = [&](const char* key, const QString& value) {
    setOrErase(out, key, value.trimmed().isEmpty() ? nlohmann::json() : nlohmann::json(trimmed(value)));
  };
  text("title", title_->text());
  text("physics", physics_->toPlainText());
  setOrErase(out, "drivers", drivers_->text().trimmed().isEmpty() ? nlohmann::json() : driversFrom(drivers_->text()));
  out["dynamics"] = dynamics_->currentData().toString().toStdString();
  nlohmann::json bounds = nlohmann::json::array();
  if (out["dynamics"] == "lag") {
    for (const QLineEdit* edit : {lag_from_, lag_to_})
      if (!edit->text().trimmed().isEmpty()) bounds.push_back(numberOrText(edit->text().trimmed()));
  }
  setOrErase(out, "tau_s", std::move(bounds));
  out["shape"] = shapeJson();
  if (const int sign = sign_->currentData().toInt(); sign != 0) {
    out["sign"] = sign;
  } else {
    out.erase("sign");
  }
  setOrErase(out, "contains", listFrom(contains_->text(), QLatin1Char(',')));
  setOrErase(out, "references", listFrom(references_->toPlainText(), QLatin1Char('\n')));
  return out;
}

QLineEdit* EffectEditor::expression(std::size_t gain, Component component) const {
  return gain < gains_.size() ? gains_[gain].expression[static_cast<std::size_t>(component)] : nullptr;
}

void EffectEditor::touched() {
  if (!filling_) Q_EMIT edited();
}

bool EffectEditor::showProblem(const std::string& place, const QString& sentence) {
  // The field whose key begins the place, the longest first: "shape[0].EX" before "shape[0]" before "shape".
  Field* found = nullptr;
  std::size_t longest = 0;
  for (auto& [key, field] : fields_) {
    if (!place.starts_with(key) || key.size() < longest) continue;
    if (place.size() > key.size() && place[key.size()] != '.' && place[key.size()] != '[') continue;
    found = &field;
    longest = key.size();
  }
  for (auto& [key, field] : fields_) {
    if (&field == found) continue;
    if (field.problem != nullptr) field.problem->set(Tone::Neutral, {});
    if (field.control->property("invalid").toBool()) {
      field.control->setProperty("invalid", false);
      field.control->style()->polish(field.control);
    }
  }
  if (found == nullptr) return false;
  if (found->problem == nullptr) {
    found->problem = new Callout;
    found->below->addWidget(found->problem);
  }
  found->problem->show(Tone::Bad, sentence);
  if (qobject_cast<QLineEdit*>(found->control) != nullptr && !found->control->property("invalid").toBool()) {
    found->control->setProperty("invalid", true);
    found->control->style()->polish(found->control);
  }
  return true;
}

void EffectEditor::clearProblems() {
  (void)showProblem({}, {});
}

QString EffectEditor::problemAt(const std::string& field) const {
  const auto found = fields_.find(field);
  if (found == fields_.end() || found->second.problem == nullptr || found->second.problem->isHidden()) return {};
  return found->second.problem->sentence();
}

const EffectEditor::Field* EffectEditor::marked() const {
  for (const auto& [key, field] : fields_)
    if (field.problem != nullptr && !field.problem->isHidden()) return &field;
  return nullptr;
}

QWidget* EffectEditor::problemWidget() const {
  const Field* field = marked();
  return field == nullptr ? nullptr : field->problem;
}

bool EffectEditor::problemHasFocus() const {
  const Field* field = marked();
  const QWidget* focus = focusWidget();
  return field != nullptr && focus != nullptr && (focus == field->control || field->control->isAncestorOf(focus));
}

}  // namespace spindrift::gui
