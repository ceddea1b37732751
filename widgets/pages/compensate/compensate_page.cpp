// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/compensate/compensate_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QPlainTextEdit>
#include <QSpinBox>
#include <QSplitter>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/tasks/task_options.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/services/closed_loop_service.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr auto compensation_result = "compensation";
constexpr std::array<const char*, 3> axis_words{"X", "Y", "Z"};

}  // namespace

CompensatePage::CompensatePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Compensate, parent),
      places_([this] { refresh(); }),
      options_(session(), context().undo, [this] {
        refresh();
        compute();
      }) {
  auto* live_button = makeButton(tr("Live …"), nullptr);
  live_button->setToolTip(tr("Measure, model and compensate at the control, while the machine works"));
  connect(live_button, &QPushButton::clicked, this, [this] { ClosedLoopService::of(session()).ask(); });
  addAction(live_button);
  export_ = makeButton(tr("Export files …"), "export");
  addAction(export_);
  compute_ = makeButton(tr("Calculate the compensation"), nullptr, "primary");
  addAction(compute_);

  stack_ = new QStackedWidget;
  empty_ = new EmptyState("compensate", {}, {});
  stack_->addWidget(empty_);
  auto* work = new QWidget;
  auto* column = new QVBoxLayout(work);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(12);
  auto* head = new Card;
  auto* choices = new QHBoxLayout;
  choices->setSpacing(8);
  source_ = new QComboBox;
  source_->setAccessibleName(tr("Model to compensate with"));
  state_ = new QComboBox;
  state_->setAccessibleName(tr("Thermal state to compensate"));
  state_->setMinimumWidth(88);
  positions_ = new QSpinBox;
  positions_->setRange(2, 51);
  positions_->setAccessibleName(tr("Positions along each axis in the files"));
  positions_->setToolTip(tr("Positions along each axis in the grid and the tables"));
  choices->addWidget(new QLabel(tr("Model")));
  choices->addWidget(source_, 2);
  choices->addWidget(new QLabel(tr("State")));
  choices->addWidget(state_, 1);
  auto* file_choices = new WrapLayout;
  file_choices->addWidget(new QLabel(tr("Positions")));
  file_choices->addWidget(positions_);
  file_choices->addWidget(new QLabel(tr("At / mm")));
  for (std::size_t i = 0; i < 3; ++i) {
    reference_[i] = new QDoubleSpinBox;
    reference_[i]->setDecimals(1);
    reference_[i]->setPrefix(QString::fromLatin1(axis_words[i]) + QLatin1Char(' '));
    reference_[i]->setAccessibleName(tr("Reference position %1 of the tables in mm").arg(axis_words[i]));
    reference_[i]->setButtonSymbols(QAbstractSpinBox::NoButtons);
    reference_[i]->setMinimumWidth(84);
    file_choices->addWidget(reference_[i]);
  }
  fanuc_ = new QComboBox;
  fanuc_->addItem(tr("not tried"), -1);
  fanuc_->addItem(tr("+ moves to +"), static_cast<int>(FanucStep::Positive));
  fanuc_->addItem(tr("+ moves to −"), static_cast<int>(FanucStep::Negative));
  fanuc_->setAccessibleName(tr("Direction in which a positive value of Fanuc pitch error data moves the axis"));
  fanuc_->setToolTip(tr(
      "Public documents do not say which way a positive value of Fanuc pitch error data moves the axis. Set one value "
      "of 10 detection units on the control, move over its section in the positive direction with an indicator on the "
      "axis, and see whether it goes further than before (+ moves to +) or less far (+ moves to −)."));
  file_choices->addWidget(new QLabel(tr("Fanuc")));
  file_choices->addWidget(fanuc_);
  head->body()->addLayout(choices);
  auto* tiles = new QHBoxLayout;
  tiles->setSpacing(24);
  before_ = new NumberTile(tr("Measured before, rms"));
  after_ = new NumberTile(tr("Expected with the correction, rms"));
  expected_ = new NumberTile(tr("Uncertainty of the correction"));
  largest_ = new NumberTile(tr("Largest correction"));
  for (NumberTile* tile : {before_, after_, expected_, largest_}) tiles->addWidget(tile, 1);
  head->body()->addLayout(tiles);
  model_ = makeLabel({}, "secondaryText");
  model_->setWordWrap(true);
  head->body()->addWidget(model_);
  column->addWidget(head);

  auto* left = new Card;
  tabs_ = makeTabs(left);
  points_ = new RowsModel({tr("Point"), tr("X / µm"), tr("Y / µm"), tr("Z / µm"), tr("Remains / µm")}, this);
  point_table_ = makeTable(points_, tr("Correction at each point"), tr("Corrections appear here."));
  stretchColumn(point_table_, 0);
  tabs_->addTab(point_table_, tr("Correction at the points"));
  auto* files = new QWidget;
  auto* files_column = new QVBoxLayout(files);
  files_column->setContentsMargins(0, 8, 0, 0);
  files_column->addLayout(file_choices);
  files_ = new RowsModel({tr("File"), tr("What it holds")}, this);
  files_column->setSpacing(8);
  file_table_ = makeSentenceTable(files_, tr("Files for the control"), tr("Files appear here."));
  files_column->addWidget(file_table_, 4);
  convention_ = new WrappedLabel;
  convention_->setProperty("role", QStringLiteral("instruction"));
  files_column->addWidget(convention_);
  preview_ = new QPlainTextEdit;
  preview_->setReadOnly(true);
  preview_->setMinimumHeight(80);
  preview_->setLineWrapMode(QPlainTextEdit::NoWrap);
  preview_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  preview_->setAccessibleName(tr("Beginning of the file"));
  files_column->addWidget(preview_, 4);
  tabs_->addTab(files, tr("Files and their signs"));
  left->body()->addWidget(tabs_, 1);

  auto* right = new Card;
  auto* view_line = new WrapLayout;
  arrows_ = new Segments({tr("Correction"), tr("Measured"), tr("Remains")}, tr("What the arrows show"));
  view_line->addWidget(arrows_);
  machine_ = new QCheckBox(tr("Machine"));
  view_line->addWidget(machine_);
  right->body()->addLayout(view_line);
  view_ = new View3D;
  view_->setMachineVisible(false);
  view_->setEmptyText(tr("Arrows at the points will appear here"), tr("Calculate the compensation."));
  right->body()->addWidget(view_, 1);
  column->addWidget(makeSplitter(work, left, right, 6, 6), 1);
  stack_->addWidget(work);
  content()->addWidget(stack_, 1);
  showHints(view_);

  connect(compute_, &QPushButton::clicked, this, &CompensatePage::compute);
  connect(export_, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(
        this, tr("Folder for the files"), QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
    if (!folder.isEmpty()) exportFiles(folder);
  });
  connect(source_, &QComboBox::activated, this, [this](int) {
    options_.change(tr("choose the model to compensate with"), [this](CompensationChoice& o) {
      o.source = static_cast<CompensationSource>(source_->currentData().toInt());
    });
  });
  connect(state_, &QComboBox::activated, this, [this](int) {
    options_.change(tr("choose the state to compensate"),
                    [this](CompensationChoice& o) { o.state = state_->currentText().toStdString(); });
  });
  connect(positions_, &QSpinBox::editingFinished, this, [this] {
    if (positions_->value() != request().positions) {
      options_.change(tr("change the positions of the files"),
                      [this](CompensationChoice& o) { o.positions = positions_->value(); });
    }
  });
  connect(fanuc_, &QComboBox::activated, this, [this](int) {
    options_.change(tr("state the direction of Fanuc pitch error data"), [this](CompensationChoice& o) {
      const int chosen = fanuc_->currentData().toInt();
      o.fanuc = chosen < 0 ? std::optional<FanucStep>() : static_cast<FanucStep>(chosen);
    });
  });
  for (QDoubleSpinBox* box : reference_) {
    connect(box, &QDoubleSpinBox::editingFinished, this, [this] {
      if (options_.filling() || !plan_) return;
      const Eigen::Vector3d& shown = plan_->reference_mm;
      const Eigen::Vector3d asked(reference_[0]->value(), reference_[1]->value(), reference_[2]->value());
      if ((asked - shown).cwiseAbs().maxCoeff() > 0.05) {
        options_.change(tr("change the reference position of the tables"),
                        [&](CompensationChoice& o) { o.reference_mm = asked; });
      }
    });
  }
  connect(arrows_, &Segments::chosen, this, [this](int) { showView(); });
  connect(machine_, &QCheckBox::toggled, this, [this](bool on) {
    view_->setMachineVisible(on);
    view_->resetCamera(StandardView::Isometric);
  });
  connect(view_, &View3D::pointPicked, this, [this](const QString& id) {
    const int row = points_->rowOf(id);
    if (row >= 0) point_table_->selectRow(row);
  });
  connect(point_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) { view_->setSelected(points_->idAt(now.row())); });
  connect(file_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex&) { showFiles(); });
}

bool CompensatePage::hasSource(CompensationSource source) const {
  if (source != CompensationSource::CompletedModel) return session().state("fit").there;
  return !session().effects().added.empty();
}

CompensationRequest CompensatePage::request() const {
  return CompensationTaskOptions::of(*session().session(), session().campaignId(),
                                     hasSource(CompensationSource::NineParameters))
      .request();
}

void CompensatePage::fillChoices() {
  const CompensationRequest r = request();
  source_->clear();
  if (hasSource(CompensationSource::CompletedModel)) {
    source_->addItem(tr("Completed simulation"), static_cast<int>(CompensationSource::CompletedModel));
  }
  if (hasSource(CompensationSource::NineParameters)) {
    source_->addItem(tr("Nine parameters"), static_cast<int>(CompensationSource::NineParameters));
    source_->addItem(tr("Higher order"), static_cast<int>(CompensationSource::HigherOrder));
  }
  source_->setCurrentIndex(std::max(0, source_->findData(static_cast<int>(r.source))));
  const auto campaign = session().campaign();
  const auto places =
      places_.ask(session().observations(), r.state, [campaign, asked = r.state](const ObservationSet& observations) {
        Places found;
        found.states = observations.states();
        if (found.states.size() > 1) found.states.erase(found.states.begin());  // the reference
        found.state = asked.empty() ? warmestState(observations) : asked;
        if (std::find(found.states.begin(), found.states.end(), found.state) == found.states.end())
          found.state = found.states.empty() ? std::string() : found.states.back();
        found.reference_mm = usualReference(campaign->machine, observations, found.state);
        return found;
      });
  if (places != nullptr) {
    state_->clear();
    for (const std::string& state : places->states) state_->addItem(QString::fromStdString(state));
    state_->setCurrentIndex(state_->findText(QString::fromStdString(places->state)));
  }
  positions_->setValue(r.positions);
  fanuc_->setCurrentIndex(fanuc_->findData(r.fanuc_step ? static_cast<int>(*r.fanuc_step) : -1));
  const std::optional<Eigen::Vector3d> reference_mm =
      r.reference_mm || places == nullptr ? r.reference_mm : places->reference_mm;
  for (std::size_t i = 0; i < 3; ++i) {
    const LinearAxis* axis = campaign->machine.findAxis(axis_words[i]);
    reference_[i]->setVisible(axis != nullptr);
    if (axis == nullptr) continue;
    reference_[i]->setRange(axis->travel_mm[0], axis->travel_mm[1]);
    if (reference_mm) reference_[i]->setValue((*reference_mm)[static_cast<Eigen::Index>(i)]);
  }
}

void CompensatePage::refresh() {
  if (session().campaign() == nullptr) return;
  if (noticeCampaign()) {
    state_->clear();
    plan_.reset();
    showPlan();
  }
  callout()->setAction({}, {});
  const bool possible = session().observations() != nullptr && (hasSource(CompensationSource::NineParameters) ||
                                                                hasSource(CompensationSource::CompletedModel));
  compute_->setEnabled(possible && canRun(compensation_result));
  if (!possible) {
    plan_.reset();
    export_->setEnabled(false);
    empty_->setTexts(
        tr("There is no model to compensate with yet"),
        tr("Fit the nine parameters (Model), or add a missing effect to the simulation (Discrepancy). Then "
           "this page says what would be commanded at each point and writes the files for the control."));
    callout()->set(Tone::Neutral, {});
    stack_->setCurrentIndex(0);
    return;
  }
  stack_->setCurrentIndex(1);
  options_.fill([this] { fillChoices(); });
  const ShownTask stored = shown(compensation_result, tr("Reading the compensation"));
  if (stored.reading) return;
  plan_ = stored.as<CompensationPlan>();
  showPlan();
  if (!stored.state.there) {
    callout()->show(Tone::Accent, tr("Choose model and state, then press Calculate the compensation."));
    return;
  }
  if (!stored.state.current) {
    callout()->show(Tone::Outdated, tr("Changed since the compensation was calculated: %1.").arg(stored.state.changed));
    callout()->setAction(tr("Calculate again"), [this] { compute(); });
  } else {
    // A correction from a model that does not describe the state must not be given away unnoticed.
    QStringList warnings;
    if (plan_)
      for (const std::string& w : plan_->warnings) warnings << coreSentence(w);
    callout()->set(warnings.isEmpty() ? Tone::Neutral : Tone::Attention, warnings.join(QLatin1Char(' ')));
    if (plan_ && !plan_->richer_model.empty()) {
      callout()->setAction(tr("Use the higher order"), [this] {
        options_.change(tr("choose the model to compensate with"),
                        [](CompensationChoice& o) { o.source = CompensationSource::HigherOrder; });
      });
    }
  }
}

void CompensatePage::compute() {
  runTask("compensation", {.failed = [this](const QString& sentence) {
            plan_.reset();
            showPlan();
            showFailure(sentence);
          }});
}

void CompensatePage::exportFiles(const QString& folder) {
  if (!plan_) return;
  if (const ResultState state = session().state(compensation_result); !state.current) {
    callout()->show(Tone::Outdated,
                    tr("No file was written. Changed since the compensation was calculated: %1.").arg(state.changed));
    callout()->setAction(tr("Calculate again"), [this] { compute(); });
    return;
  }
  if (const std::string harm = plan_->harm(); !harm.empty()) {
    callout()->setAction({}, {});
    callout()->show(Tone::Bad, tr("No file was written. %1").arg(coreSentence(harm)));
    return;
  }
  try {
    QDir().mkpath(folder);
    for (const CompensationFile& f : plan_->files) {
      writeFileAtomically((QDir(folder).filePath(QString::fromStdString(f.name))).toStdString(), f.content);
    }
    callout()->setAction({}, {});
    callout()->show(Tone::Good, tr("Files written to %1: %2").arg(folder).arg(plan_->files.size()));
  } catch (const std::exception& e) {
    callout()->setAction({}, {});
    callout()->show(Tone::Bad, coreSentence(e.what()));
  }
}

std::vector<Exportable> CompensatePage::exportables() {
  std::vector<Exportable> items;
  if (!plan_) return items;
  items.push_back(exportableOf(tr("Corrections at the points"), points_));
  items.push_back(exportableOf(tr("Corrections on the machine"), view_));
  if (!plan_->harm().empty() || !session().state(compensation_result).current) return items;
  for (const CompensationFile& f : plan_->files) {
    const QString name = QString::fromStdString(f.name);
    items.push_back({name.section(QLatin1Char('.'), 0, 0),
                     {name.section(QLatin1Char('.'), -1)},
                     [content = f.content](const QString& file) { writeFileAtomically(file.toStdString(), content); }});
  }
  return items;
}

}  // namespace spindrift::gui
