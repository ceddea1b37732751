// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/machine/machine_page.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QSplitter>
#include <QStyledItemDelegate>
#include <QTabWidget>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <iterator>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/machine/observation_plausibility.h"
#include "core/machine/sensor_role.h"
#include "core/machine/stated_role.h"
#include "core/workflows/fit_campaign.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/editor_table.h"
#include "widgets/common/parts.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/panels/machine/artefact_editor.h"
#include "widgets/panels/machine/connections_panel.h"
#include "widgets/services/connections_service.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
QStringList machineFindings(const MachineDescription& machine) {
  QStringList findings;
  QStringList no_resolution;
  QStringList no_bearing;
  for (const LinearAxis& axis : machine.axes) {
    const QString name = QString::fromStdString(axis.name);
    if (!axis.resolution_um) no_resolution << name;
    if (axis.drive_type == "ball_screw" && !axis.fixed_bearing_mm) no_bearing << name;
  }
  const auto listed = [](QStringList names) {
    const QString last = names.takeLast();
    return names.isEmpty() ? last : MachinePage::tr("%1 and %2").arg(names.join(QStringLiteral(", ")), last);
  };
  if (!no_resolution.isEmpty()) {
    findings << MachinePage::tr("No resolution is stated for %1: verdicts against the resolution are left out.")
                    .arg(listed(no_resolution));
  }
  if (!no_bearing.isEmpty()) {
    findings << MachinePage::tr("No fixed bearing is stated for the %1 ball screw: its expansion has no reference.")
                    .arg(listed(no_bearing));
  }
  for (const std::string& outside : pointsOutsideTravel(machine)) findings << coreSentence(outside);
  return findings;
}

namespace {

/// Shows the words that machine.json has for kinds in the language of the window; what is typed stays what the file
/// says.
class KindWords : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  [[nodiscard]] QString displayText(const QVariant& value, const QLocale&) const override {
    const QString word = value.toString();
    for (const auto& [written, shown] : {std::pair{"ball_screw", MachinePage::tr("ball screw")},
                                         {"rotary_encoder", MachinePage::tr("rotary encoder")},
                                         {"linear_scale", MachinePage::tr("linear scale")},
                                         {"fiducial", MachinePage::tr("fiducial")},
                                         {"hole", MachinePage::tr("hole")},
                                         {"ball", MachinePage::tr("ball")},
                                         {"surface", MachinePage::tr("surface")}}) {
      if (word == QLatin1String(written)) return shown;
    }
    return word;
  }
};

}  // namespace

MachinePage::MachinePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Machine, parent),
      draft_(context().session, context().undo, "machine", [this] { refresh(); }) {
  discard_ = makeButton(tr("Discard"), "undo");
  apply_ = makeButton(tr("Apply changes"), nullptr, "primary");
  original_ = makeButton(tr("Back to machine.json"), "restore");
  addAction(original_);
  addAction(discard_);
  addAction(apply_);

  auto* card = new Card;
  auto* form = new QGridLayout;
  form->setSpacing(8);
  name_ = new QLineEdit;
  name_->setAccessibleName(tr("Name of the machine"));
  chain_ = new QLineEdit;
  chain_->setAccessibleName(tr("Kinematic chain"));
  chain_->setToolTip(tr(
      "From the workpiece w over the bed b to the tool t (ISO 10791-1); ' marks an axis that carries the workpiece"));
  form->addWidget(new QLabel(tr("Name")), 0, 0);
  form->addWidget(name_, 0, 1);
  form->addWidget(new QLabel(tr("Chain")), 0, 2);
  form->addWidget(chain_, 0, 3);
  form->setColumnStretch(1, 1);
  form->setColumnStretch(3, 1);
  card->body()->addLayout(form);
  card->body()->addWidget(makeLabel(tr("Linear axes"), "sectionTitle"));
  axes_ = makeEditor({tr("Axis"), tr("From\n/ mm"), tr("To\n/ mm"), tr("Resolution\n/ µm"), tr("Drive"),
                      tr("Pitch\n/ mm"), tr("Fixed bearing\n/ mm"), tr("Position from")},
                     tr("Linear axes"));
  for (const int column : {4, 7}) axes_->setItemDelegateForColumn(column, new KindWords(axes_));
  card->body()->addWidget(axes_, 2);
  auto* points_title = new QHBoxLayout;
  points_title->setSpacing(8);
  points_title->addWidget(makeLabel(tr("Measuring points"), "sectionTitle"), 1);
  auto* add = makeButton(tr("Add point"), "plus");
  auto* remove = makeButton(tr("Remove point"), "trash");
  points_title->addWidget(add);
  points_title->addWidget(remove);
  card->body()->addLayout(points_title);
  points_ = makeEditor({tr("Point"), tr("Kind"), tr("x / mm"), tr("y / mm"), tr("z / mm")}, tr("Measuring points"),
                       tr("No measuring point yet."));
  points_->setItemDelegateForColumn(1, new KindWords(points_));
  card->body()->addWidget(points_, 3);
  auto* suggesting = new WrapLayout;
  suggest_count_ = new QSpinBox;
  suggest_count_->setRange(3, 20);
  suggest_count_->setValue(6);
  suggest_count_->setAccessibleName(tr("How many points to suggest"));
  suggest_goal_ = new QComboBox;
  suggest_goal_->addItem(tr("best heat map"), static_cast<int>(PlacementCriterion::I));
  suggest_goal_->addItem(tr("best parameters"), static_cast<int>(PlacementCriterion::D));
  suggest_goal_->setAccessibleName(tr("What the points shall be best for"));
  suggest_ = makeButton(tr("Suggest points"), "target");
  suggest_->setToolTip(
      tr("Chooses, from a lattice over the table, where so many fiducials determine the nine parameters best: smallest "
         "mean variance of the heat map (I-optimal) or smallest confidence region of the parameters (D-optimal)"));
  auto* number = new QLabel(tr("Number"));
  number->setBuddy(suggest_count_);
  suggesting->addWidget(number);
  suggesting->addWidget(suggest_count_);
  suggesting->addWidget(suggest_goal_);
  suggesting->addWidget(suggest_);
  card->body()->addLayout(suggesting);

  auto* picture = new Card(tr("How it is built"));
  view_ = new View3D;
  view_->setMinimumWidth(190);  // beside the help
  view_->setEmptyText(tr("The machine will appear here"), tr("Give its chain and the travel of its axes."));
  picture->body()->addWidget(view_, 1);
  auto* tabs = makeTabs(this);
  tabs->setObjectName(QStringLiteral("machineTabs"));
  tabs->addTab(makeSplitter(nullptr, card, picture, 8, 5), tr("Axes and points"));
  artefacts_ = new ArtefactEditor(context());
  tabs->addTab(artefacts_, tr("Artefacts and styli"));
  tabs->addTab(makeSensorTab(), tr("Temperature sensors"));
  connections_tab_ = new QWidget;
  (new QVBoxLayout(connections_tab_))->setContentsMargins(0, 0, 0, 0);
  tabs->addTab(connections_tab_, tr("Connections"));
  content()->addWidget(tabs, 1);
  // Each tab has its own changes to apply.
  connect(tabs, &QTabWidget::currentChanged, this, [this, tabs](int index) {
    if (tabs->widget(index) == connections_tab_) makeConnections();
    const bool description = index == 0 || index == 2;
    apply_->setVisible(description);
    discard_->setVisible(description);
  });

  connect(name_, &QLineEdit::textEdited, this, &MachinePage::markTyped);
  connect(chain_, &QLineEdit::textEdited, this, &MachinePage::markTyped);
  connect(axes_, &QTableWidget::itemChanged, this, &MachinePage::markTyped);
  connect(points_, &QTableWidget::itemChanged, this, &MachinePage::markTyped);
  connect(points_, &QTableWidget::currentCellChanged, this,
          [this](int row) { view_->setSelected(textAt(points_, row, 0)); });
  connect(view_, &View3D::pointPicked, this, [this](const QString& id) {
    for (int row = 0; row < points_->rowCount(); ++row) {
      if (textAt(points_, row, 0) == id) points_->setCurrentCell(row, 0);
    }
  });
  connect(add, &QPushButton::clicked, this, [this] {
    filling_ = true;
    const int row = points_->rowCount();
    points_->insertRow(row);
    setText(points_, row, 0, QStringLiteral("F%1").arg(row + 1));
    setText(points_, row, 1, QStringLiteral("fiducial"));
    for (int c = 2; c < 5; ++c) setText(points_, row, c, QStringLiteral("0"));
    filling_ = false;
    points_->setCurrentCell(row, 2);
    markEdited(tr("add a point"));
  });
  makeRemoving(remove, points_, [this] { markEdited(tr("remove a point")); });
  connect(suggest_, &QPushButton::clicked, this, &MachinePage::suggestPoints);
  connect(apply_, &QPushButton::clicked, this, &MachinePage::apply);
  connect(discard_, &QPushButton::clicked, this, &MachinePage::discard);
  connect(original_, &QPushButton::clicked, this, [this] {
    context().undo.push(new ApplyCommand(session(), draft_.name(),
                                         std::make_unique<MachineCommand>(session(), nlohmann::json::object())));
  });
}

void MachinePage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  const MachineDescription& machine = campaign->machine;
  filling_ = true;
  name_->setText(shownName(machine.name));
  chain_->setText(QString::fromStdString(machine.chain.text()));
  for (QLineEdit* field : {name_, chain_}) field->setCursorPosition(0);  // one that is too long shows its beginning
  axes_->setRowCount(static_cast<int>(machine.axes.size()));
  for (int row = 0; row < axes_->rowCount(); ++row) {
    const LinearAxis& axis = machine.axes[static_cast<std::size_t>(row)];
    setText(axes_, row, 0, QString::fromStdString(axis.name));
    setText(axes_, row, 1, shownNumbers(QString::fromStdString(exactNumber(axis.travel_mm[0]))));
    setText(axes_, row, 2, shownNumbers(QString::fromStdString(exactNumber(axis.travel_mm[1]))));
    setText(axes_, row, 3, numberText(axis.resolution_um));
    setText(axes_, row, 4, QString::fromStdString(axis.drive_type));
    setText(axes_, row, 5, numberText(axis.pitch_mm));
    setText(axes_, row, 6, numberText(axis.fixed_bearing_mm));
    setText(axes_, row, 7, QString::fromStdString(axis.scale));
  }
  points_->setRowCount(static_cast<int>(machine.points.size()));
  std::vector<ViewPoint> shown;
  for (int row = 0; row < points_->rowCount(); ++row) {
    const MachinePoint& point = machine.points[static_cast<std::size_t>(row)];
    setText(points_, row, 0, QString::fromStdString(point.id));
    setText(points_, row, 1, QString::fromStdString(point.kind));
    for (int i = 0; i < 3; ++i)
      setText(points_, row, 2 + i, shownNumbers(QString::fromStdString(exactNumber(point.position_mm[i]))));
    ViewPoint v;
    v.id = v.label = QString::fromStdString(point.id);
    v.position_mm = point.position_mm;
    shown.push_back(v);
  }
  showSensors();
  const nlohmann::json draft = draft_.typed(base());
  const bool of_another = draft_.ofAnother(base());
  if (draft.is_object()) showTyped(draft);
  filling_ = false;
  draft_.shown(typed());
  view_->setMachine(machine);
  view_->setPoints(std::move(shown));
  view_->setCaption(shownName(machine.name));
  apply_->setEnabled(draft.is_object());
  discard_->setEnabled(draft.is_object() || of_another);
  original_->setVisible(session().machineEdited());
  artefacts_->refresh();
  if (connections_ != nullptr) connections_->refresh();
  callout()->setAction({}, {});
  if (draft.is_object()) {
    callout()->show(Tone::Attention, tr("What was typed here is not applied yet: apply the changes, or discard them."));
  } else if (of_another) {
    callout()->show(Tone::Attention,
                    tr("Something was typed here for another state of the machine. Show it, or discard it."));
    callout()->setAction(tr("Show it"), [this] {
      draft_.takeOver(base());
      refresh();
    });
  } else {
    showFindings();
  }
}

QWidget* MachinePage::makeSensorTab() {
  auto* card = new Card;
  auto* told = new QLabel(
      tr("Where a sensor sits decides which effects it can drive. What was read from the name of its column is to be "
         "confirmed or put right."));
  told->setWordWrap(true);
  card->body()->addWidget(told);
  sensors_ =
      makeEditor({tr("Column of the log"), tr("Place"), tr("Role"), tr("Known from")}, tr("Temperature sensors"));
  sensors_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  card->body()->addWidget(sensors_, 1);
  auto* buttons = new WrapLayout;
  auto* confirm = makeButton(tr("Confirm all"), "check");
  buttons->addWidget(confirm);
  card->body()->addLayout(buttons);
  connect(confirm, &QPushButton::clicked, this, [this] {
    for (int row = 0; row < sensors_->rowCount(); ++row) sayRoleIsStated(row);
    markEdited(tr("confirm the roles of the sensors"));
  });
  return card;
}

void MachinePage::showSensors() {
  const auto campaign = session().campaign();
  const MachineDescription& machine = campaign->machine;
  std::vector<std::string> columns;
  for (const TemperatureSensor& sensor : machine.temperature_sensors) columns.push_back(sensor.name);
  if (campaign->log) {
    for (const std::string& name : campaign->log->temperatureNames()) {
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
    }
  }
  sensors_->setRowCount(0);
  sensors_->setRowCount(static_cast<int>(columns.size()));
  int role_width = 0;
  for (int row = 0; row < sensors_->rowCount(); ++row) {
    const SensorReading reading = readSensor(machine.temperature_sensors, columns[static_cast<std::size_t>(row)]);
    setText(sensors_, row, 0, QString::fromStdString(reading.column));
    for (const TemperatureSensor& sensor : machine.temperature_sensors) {
      if (sensor.name == reading.column) setText(sensors_, row, 1, coreSentence(sensor.place));
    }
    auto* role = new QComboBox;
    role->setAccessibleName(tr("Role of %1").arg(QString::fromStdString(reading.column)));
    for (const std::string& name : sensorRoleNames()) {
      const std::string_view text = describe(*sensorRoleFromString(name));
      role->addItem(coreSentence(text), QString::fromStdString(name));
    }
    role->setCurrentIndex(static_cast<int>(reading.role));
    sensors_->setCellWidget(row, 2, role);
    const bool stated = reading.from == "machine.json";
    setText(sensors_, row, 3, stated ? tr("machine.json") : tr("its name: please confirm"));
    sensors_->item(row, 3)->setData(Qt::UserRole, stated);
    sensors_->item(row, 3)->setToolTip(coreSentence(reading.note));
    role_width = std::max(role_width, role->sizeHint().width());
    connect(role, &QComboBox::activated, this, [this, row] { stateRole(row); });
  }
  // The header's own mode looks at texts alone, not at the boxes in the cells.
  sensors_->horizontalHeader()->setSectionResizeMode(2, QHeaderView::Fixed);
  sensors_->horizontalHeader()->resizeSection(2, role_width);
}

void MachinePage::stateRole(int row) {
  sayRoleIsStated(row);
  markTyped();
}

void MachinePage::sayRoleIsStated(int row) {
  sensors_->item(row, 3)->setData(Qt::UserRole, true);
  if (textAt(sensors_, row, 3) != tr("machine.json")) sensors_->item(row, 3)->setText(tr("this page"));
}

void MachinePage::showFindings() {
  const QStringList findings = machineFindings(session().campaign()->machine);
  callout()->setAction({}, {});
  if (findings.isEmpty()) {
    callout()->show(Tone::Good, tr("The description is complete for everything Spindrift does with it."));
  } else {
    // A description that says less than it could is no fault: the step is done. A point out of reach is one.
    callout()->show(pointsOutsideTravel(session().campaign()->machine).empty() ? Tone::Accent : Tone::Attention,
                    findings.mid(0, 3).join(QLatin1Char(' ')) +
                        (findings.size() > 3 ? tr(" And %1 more.").arg(findings.size() - 3) : QString()));
  }
}

void MachinePage::markTyped() {
  markEdited(tr("change the description"));
}

void MachinePage::markEdited(const QString& what) {
  if (filling_) return;
  draft_.keep(what, base(), typed());
  apply_->setEnabled(true);
  discard_->setEnabled(true);
}

void MachinePage::discard() {
  draft_.discard();
  refresh();
}

nlohmann::json MachinePage::base() const {
  nlohmann::json machine = session().campaign()->machine.source;
  for (const char* key : {"artefacts", "styli"}) machine.erase(key);
  return machine;
}

nlohmann::json MachinePage::typed() const {
  const auto cells = [](const QTableWidget* table) {
    nlohmann::json rows = nlohmann::json::array();
    for (int row = 0; row < table->rowCount(); ++row) {
      nlohmann::json line = nlohmann::json::array();
      for (int c = 0; c < table->columnCount(); ++c) line.push_back(textAt(table, row, c).toStdString());
      rows.push_back(std::move(line));
    }
    return rows;
  };
  nlohmann::json roles = nlohmann::json::object();
  for (int row = 0; row < sensors_->rowCount(); ++row) {
    const auto* role = qobject_cast<QComboBox*>(sensors_->cellWidget(row, 2));
    if (role == nullptr || !sensors_->item(row, 3)->data(Qt::UserRole).toBool()) continue;
    roles[textAt(sensors_, row, 0).toStdString()] = role->currentData().toString().toStdString();
  }
  return {{"name", name_->text().toStdString()},
          {"chain", chain_->text().toStdString()},
          {"axes", cells(axes_)},
          {"points", cells(points_)},
          {"roles", roles}};
}

void MachinePage::showTyped(const nlohmann::json& typed) {
  const auto fill = [](QTableWidget* table, const nlohmann::json& rows) {
    table->setRowCount(static_cast<int>(rows.size()));
    for (int row = 0; row < table->rowCount(); ++row) {
      const nlohmann::json& line = rows[static_cast<std::size_t>(row)];
      for (int c = 0; c < std::min(table->columnCount(), static_cast<int>(line.size())); ++c)
        setText(table, row, c, fromCore(line[static_cast<std::size_t>(c)].get<std::string>()));
    }
  };
  name_->setText(fromCore(typed.value("name", "")));
  chain_->setText(fromCore(typed.value("chain", "")));
  fill(axes_, typed.value("axes", nlohmann::json::array()));
  fill(points_, typed.value("points", nlohmann::json::array()));
  const nlohmann::json roles = typed.value("roles", nlohmann::json::object());
  for (int row = 0; row < sensors_->rowCount(); ++row) {
    const auto chosen = roles.find(textAt(sensors_, row, 0).toStdString());
    auto* role = qobject_cast<QComboBox*>(sensors_->cellWidget(row, 2));
    if (chosen == roles.end() || role == nullptr) continue;
    role->setCurrentIndex(std::max(0, role->findData(fromCore(chosen->get<std::string>()))));
    sayRoleIsStated(row);
  }
}

nlohmann::json MachinePage::edited() const {
  nlohmann::json machine = session().campaign()->machine.source;
  machine["name"] = keptName(name_->text(), session().campaign()->machine.name);
  machine["chain"] = chain_->text().toStdString();
  const auto setOrErase = [](nlohmann::json& object, const char* key, const QString& text, bool number) {
    if (text.isEmpty()) {
      object.erase(key);
    } else {
      object[key] = number ? numberOrText(text) : nlohmann::json(text.toStdString());
    }
  };
  nlohmann::json axes = nlohmann::json::array();
  for (int row = 0; row < axes_->rowCount(); ++row) {
    nlohmann::json axis = nlohmann::json::object();
    if (machine.contains("axes") && row < static_cast<int>(machine["axes"].size())) {
      axis = machine["axes"][static_cast<std::size_t>(row)];
    }
    axis["name"] = textAt(axes_, row, 0).toStdString();
    axis["travel_mm"] = {numberOrText(textAt(axes_, row, 1)), numberOrText(textAt(axes_, row, 2))};
    setOrErase(axis, "resolution_um", textAt(axes_, row, 3), true);
    nlohmann::json drive = axis.value("drive", nlohmann::json::object());
    setOrErase(drive, "type", textAt(axes_, row, 4), false);
    setOrErase(drive, "pitch_mm", textAt(axes_, row, 5), true);
    setOrErase(drive, "fixed_bearing_mm", textAt(axes_, row, 6), true);
    if (drive.empty()) {
      axis.erase("drive");
    } else {
      axis["drive"] = drive;
    }
    setOrErase(axis, "scale", textAt(axes_, row, 7), false);
    axes.push_back(axis);
  }
  machine["axes"] = axes;
  nlohmann::json points = nlohmann::json::array();
  for (int row = 0; row < points_->rowCount(); ++row) {
    points.push_back({{"id", textAt(points_, row, 0).toStdString()},
                      {"kind", textAt(points_, row, 1).toStdString()},
                      {"x_mm", numberOrText(textAt(points_, row, 2))},
                      {"y_mm", numberOrText(textAt(points_, row, 3))},
                      {"z_mm", numberOrText(textAt(points_, row, 4))}});
  }
  machine["points"] = points;
  for (int row = 0; row < sensors_->rowCount(); ++row) {
    if (!sensors_->item(row, 3)->data(Qt::UserRole).toBool()) continue;
    const std::string name = textAt(sensors_, row, 0).toStdString();
    stateSensorRole(machine, name,
                    qobject_cast<QComboBox*>(sensors_->cellWidget(row, 2))->currentData().toString().toStdString());
  }
  return machine;
}

void MachinePage::suggestPoints() {
  PlacementRequest request;
  request.lattice_nx = 9;
  request.lattice_ny = 7;
  request.options.count = suggest_count_->value();
  request.options.criterion = static_cast<PlacementCriterion>(suggest_goal_->currentData().toInt());
  run(tr("Choosing measuring points"),
      [this, machine = session().campaign()->machine, request](JobContext& job) -> std::function<void()> {
        const PlacementAnswer answer = placeFiducials(machine, request, job);
        return [this, machine, answer] {
          if (session().campaign()->machine.source == machine.source) return showSuggestion(answer);
          callout()->show(Tone::Attention, tr("The machine was changed meanwhile. Suggest the points again."));
        };
      });
}

void MachinePage::showSuggestion(const PlacementAnswer& answer) {
  if (answer.result.status != FitStatus::Converged) {
    callout()->show(Tone::Attention, coreSentence(answer.result.message));
    return;
  }
  int number = 1;
  const auto taken = [&](const QString& id) {
    for (int row = 0; row < points_->rowCount(); ++row) {
      if (textAt(points_, row, 0) == id) return true;
    }
    return false;
  };
  filling_ = true;
  for (const std::size_t index : answer.result.chosen) {
    const Eigen::Vector3d& at = answer.candidates_mm[index];
    while (taken(QStringLiteral("P%1").arg(number))) ++number;
    const int row = points_->rowCount();
    points_->insertRow(row);
    setText(points_, row, 0, QStringLiteral("P%1").arg(number));
    setText(points_, row, 1, QStringLiteral("fiducial"));
    for (int i = 0; i < 3; ++i) setText(points_, row, 2 + i, decimalText(at[i], 'f', 1));
  }
  filling_ = false;
  points_->scrollToBottom();
  markEdited(tr("suggest points"));
  callout()->show(
      Tone::Accent,
      tr("%n points added below. With them the heat map would be uncertain by %1 µm on average and %2 µm at "
         "worst (0.5 µm in X and Y, 1 µm in Z per fiducial). Apply the changes, or discard them.",
         nullptr, static_cast<int>(answer.result.chosen.size()))
          .arg(decimalText(answer.result.mean_sigma_um, 'f', 2))
          .arg(decimalText(answer.result.largest_sigma_um, 'f', 2)));
}

void MachinePage::apply() {
  const nlohmann::json machine = edited();
  try {
    (void)MachineDescription::parse(JsonNode::parse(machine.dump(), "machine as edited"), "machine as edited");
  } catch (const InputError& e) {
    callout()->show(Tone::Bad, coreSentence(e.what()));
    return;
  }
  context().undo.push(new ApplyCommand(session(), draft_.name(), std::make_unique<MachineCommand>(session(), machine)));
}

void MachinePage::makeConnections() {
  if (connections_ != nullptr) return;
  connections_ = new ConnectionsPanel(context());
  connections_tab_->layout()->addWidget(connections_);
  connections_->show();
  connections_->refresh();
}

std::vector<Exportable> MachinePage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Machine"), view_),
                                {tr("Machine description"), {QStringLiteral("json")}, [this](const QString& file) {
                                   writeFileAtomically(file.toStdString(), edited().dump(1) + "\n");
                                 }}};
  if (!ConnectionsService::of(session()).description()["sources"].empty()) makeConnections();
  if (connections_ == nullptr) return items;
  for (Exportable& item : connections_->exportables()) items.push_back(std::move(item));
  return items;
}

}  // namespace spindrift::gui
