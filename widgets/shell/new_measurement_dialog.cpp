// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/new_measurement_dialog.h"

#include <QFile>
#include <QFileDialog>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/base/error.h"
#include "core/machine/machine_description.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/parts.h"

static void loadScenarios() {
  Q_INIT_RESOURCE(scenarios);
}

namespace spindrift::gui {
namespace {

/// The machine of one of the scenarios that come with the program, without what belongs to its data alone.
nlohmann::json machineOf(const char* scenario, const QString& name) {
  loadScenarios();
  QFile file(QStringLiteral(":/scenarios/%1.json").arg(QLatin1String(scenario)));
  if (!file.open(QIODevice::ReadOnly)) return {};
  nlohmann::json machine = nlohmann::json::parse(file.readAll().toStdString()).at("machine");
  machine["name"] = name.toStdString();
  if (machine.contains("profiler")) machine["profiler"].erase("calibration_cloud");
  return machine;
}

}  // namespace

NewMeasurementDialog::NewMeasurementDialog(const std::optional<nlohmann::json>& at_hand, QWidget* parent)
    : QDialog(parent) {
  setWindowTitle(tr("New measurement"));
  setMinimumSize(620, 460);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 16, 24, 16);
  column->setSpacing(12);
  column->addWidget(makeLabel(tr("Which machine is measured?"), "sectionTitle"));
  auto* about =
      makeLabel(tr("Choose the one that is most alike: travels, chain, points and artefacts are edited on the "
                   "page Machine. A machine.json of earlier measurements saves that work."),
                "instruction");
  about->setWordWrap(true);
  column->addWidget(about);
  choices_ = new QListWidget;
  choices_->setAccessibleName(tr("Machines to begin with"));
  column->addWidget(choices_, 1);
  note_ = makeLabel({}, "secondaryText");
  note_->setWordWrap(true);
  column->addWidget(note_);
  auto* form = new QHBoxLayout;
  form->addWidget(new QLabel(tr("Name")));
  name_ = new QLineEdit;
  name_->setAccessibleName(tr("Name of the machine"));
  form->addWidget(name_, 1);
  column->addLayout(form);
  problem_ = new Callout;
  column->addWidget(problem_);
  auto* buttons = new QHBoxLayout;
  auto* from_file = makeButton(tr("From a file …"), "folder-open");
  from_file->setAutoDefault(false);
  auto* cancel = makeButton(tr("Cancel"), nullptr);
  cancel->setAutoDefault(false);
  start_ = makeButton(tr("Begin"), nullptr, "primary");
  start_->setDefault(true);
  buttons->addWidget(from_file);
  buttons->addStretch();
  buttons->addWidget(cancel);
  buttons->addWidget(start_);
  column->addLayout(buttons);

  if (at_hand) {
    add({tr("The machine of this session: %1").arg(QString::fromStdString(at_hand->value("name", std::string()))),
         tr("As it is now, with its points and artefacts."), *at_hand});
  }
  add({tr("Three-axis mill, fiducials under a microscope"),
       tr("Vertical spindle, table moves in X and Y; five fiducials."), machineOf("fiducials", tr("three-axis mill"))});
  add({tr("Five-axis machining centre, hole bar and touch probe"),
       tr("Vertical spindle, swivelling and turning table; a bar with seven holes."),
       machineOf("hole_bar", tr("five-axis machining centre"))});
  add({tr("Horizontal machining centre, balls and star stylus"), tr("Horizontal spindle; four balls, five styli."),
       machineOf("ball_artefact", tr("horizontal machining centre"))});
  add({tr("Gantry, free-form artefacts under a laser profiler"),
       tr("Crossbeam that carries the profiler; four artefacts."), machineOf("scans", tr("gantry milling machine"))});
  connect(choices_, &QListWidget::currentRowChanged, this, &NewMeasurementDialog::showChoice);
  connect(choices_, &QListWidget::itemDoubleClicked, this, &QDialog::accept);
  connect(from_file, &QPushButton::clicked, this, [this] {
    const QString file =
        QFileDialog::getOpenFileName(this, tr("Choose the machine description"), {}, tr("Machine (*.json)"));
    if (!file.isEmpty()) takeFile(file);
  });
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(start_, &QPushButton::clicked, this, &QDialog::accept);
  connect(name_, &QLineEdit::textChanged, this,
          [this](const QString& text) { start_->setEnabled(!text.trimmed().isEmpty()); });
  choices_->setCurrentRow(0);
}

void NewMeasurementDialog::add(Choice choice) {
  if (choice.machine.is_null()) return;
  choices_->addItem(choice.title);
  all_.push_back(std::move(choice));
}

void NewMeasurementDialog::takeFile(const QString& file) {
  try {
    const MachineDescription machine = MachineDescription::read(file.toStdString());
    problem_->set(Tone::Neutral, {});
    add({tr("%1 (from a file)").arg(shownName(machine.name)), file, machine.source});
    choices_->setCurrentRow(choices_->count() - 1);
  } catch (const InputError& e) {
    problem_->show(Tone::Bad, coreSentence(e.what()));
  }
}

void NewMeasurementDialog::showChoice() {
  const int row = choices_->currentRow();
  if (row < 0) return;
  const Choice& choice = all_[static_cast<std::size_t>(row)];
  note_->setText(choice.note);
  name_->setText(QString::fromStdString(choice.machine.value("name", std::string())));
}

nlohmann::json NewMeasurementDialog::machine() const {
  const int row = choices_->currentRow();
  if (row < 0) return {};
  nlohmann::json machine = all_[static_cast<std::size_t>(row)].machine;
  machine["name"] = name_->text().trimmed().toStdString();
  return machine;
}

}  // namespace spindrift::gui
