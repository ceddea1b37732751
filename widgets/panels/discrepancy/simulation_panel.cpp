// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/simulation_panel.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPointer>
#include <QScrollArea>
#include <QSplitter>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/discrepancy/mechanism_choice.h"
#include "core/tasks/task_options.h"
#include "core/tasks/task_work.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/page_room.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/jobs/task_job.h"
#include "widgets/jobs/task_run.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/parameter_card.h"
#include "widgets/panels/discrepancy/put_in_dialog.h"
#include "widgets/panels/discrepancy/simulation_views.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/workflow/simulator_choice.h"

namespace spindrift::gui {
namespace {

namespace fs = std::filesystem;

constexpr int view_parameters = 0;
constexpr int view_history = 1;
constexpr int view_maps = 2;
constexpr int height_for_words = 440;

}  // namespace

SimulationPanel::SimulationPanel(PageContext context, QWidget* parent) : QWidget(parent), context_(std::move(context)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(8);
  head_ = new Card;
  auto* line = new WrapLayout;
  title_ = makeLabel(tr("Simulator"), "sectionTitle");
  title_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  line->addWidget(title_);
  head_->body()->addLayout(line);
  runs_ = new WrappedLabel;
  runs_->setProperty("role", QStringLiteral("secondaryText"));
  head_->body()->addWidget(runs_);
  choose_ = makeButton(tr("Choose simulator.json …"), "folder-open");
  choose_->setToolTip(tr("Take another description of a simulation that can be run"));
  search_ = makeButton(tr("Search with the simulator"), "play");
  search_->setToolTip(tr("Run the simulator and look for what is missing among its parameters as well"));
  put_ = makeButton(tr("Put it into the simulation …"), nullptr, "primary");
  views_ = new Segments({tr("Parameters"), tr("Over time"), tr("Over the table")}, tr("What is shown"));
  line->addWidget(views_);
  for (QPushButton* button : {choose_, search_, put_}) line->addWidget(button);
  column->addWidget(head_);
  callout_ = new Callout;
  column->addWidget(callout_);

  stack_ = new QStackedWidget;
  parameters_ = new ParameterCard;
  found_card_ = new Card(tr("What was found"));
  found_ = new QLabel;
  found_->setWordWrap(true);
  found_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  found_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(found_);
  found_scroll_ = scroll;
  figures_ = new RowsModel(
      {tr("Residual / %1").arg(unitText("um")), tr("Before"), tr("After"), tr("Fitted term"), tr("Noise")}, this);
  figure_table_ = makeTable(figures_, tr("Figures before and after"));
  stretchColumn(figure_table_, 0);
  figure_table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  found_card_->body()->addWidget(figure_table_);
  found_card_->body()->addWidget(scroll, 1);
  stack_->addWidget(makeSplitter(stack_, parameters_, found_card_, 3, 2));
  history_ = new SimulationHistory;
  stack_->addWidget(history_);
  column->addWidget(stack_, 1);

  connect(choose_, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, tr("Choose the simulator"), {}, tr("Simulator (*.json)"));
    if (!file.isEmpty()) chooseSimulator(file);
  });
  connect(search_, &QPushButton::clicked, this, &SimulationPanel::search);
  connect(put_, &QPushButton::clicked, this, &SimulationPanel::askForFolder);
  connect(parameters_, &ParameterCard::ticksChanged, this, [this] {
    showCallout();
    updateButtons();
  });
  connect(views_, &Segments::chosen, this, &SimulationPanel::showView);
  connect(history_, &SimulationHistory::hovered, this, &SimulationPanel::hovered);
  connect(&context_.jobs, &JobRunner::started, this, &SimulationPanel::updateButtons);
  connect(&context_.jobs, &JobRunner::finished, this, &SimulationPanel::updateButtons);
  connect(&context_.session, &SessionModel::workChanged, this, &SimulationPanel::updateButtons);
}

QTableView* SimulationPanel::parameterTable() const {
  return parameters_->table();
}

const SimulationUpdate* SimulationPanel::update() const {
  if (story_ == nullptr || !story_->update) return nullptr;
  const std::string version = stored_.provenance.options.value("version", "");
  // An update that wrote a version counts while that version is the one at hand.
  return version.empty() || version == simulator_ ? &*story_->update : nullptr;
}

QString SimulationPanel::versionMade() const {
  const std::string version = stored_.id != 0 ? stored_.provenance.options.value("version", "") : std::string();
  return version.empty() ? QString() : fromCore(simulatorFile(context_.session, version).string());
}

bool SimulationPanel::current() const {
  return context_.session.campaign() != nullptr && stored_.id != 0 && context_.session.tasks().holds(stored_);
}

void SimulationPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  openSoon();
}

void SimulationPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

void SimulationPanel::arrange() {
  // In a low window the words beside the figures are a tip.
  found_scroll_->setVisible(figures_->rowCount() == 0 || roomOnPage(*this) >= height_for_words);
  found_card_->setToolTip(found_scroll_->isVisibleTo(this) ? QString() : found_->text());
}

QLabel* SimulationPanel::runs() const {
  return runs_;
}

void SimulationPanel::refresh() {
  SessionModel& session = context_.session;
  if (session.campaign() == nullptr) return;
  if (shown_visit_ != session.visit()) {
    shown_visit_ = session.visit();
    failure_.clear();
    searched_ = {};
    story_.reset();
    shown_result_ = 0;
    stored_ = {};
  }
  const std::string simulator = currentSimulator(session);
  if (simulator != simulator_) {
    failure_.clear();
    parameters_->forgetTicks();
  }
  simulator_ = simulator;
  load();
  openSoon();
  showParameters();
  showFound();
  showFigures();
  showCallout();
  const bool rows = update() != nullptr && !story_->rows.empty();
  history_->show(rows ? story_->rows : std::vector<DiscrepancyReportRow>());
  maps_stale_ = true;
  views_->setVisible(rows);
  if (!rows) views_->setCurrent(view_parameters);
  showView(views_->current());
  updateButtons();
}

void SimulationPanel::load() {
  stored_ = simulationResult(context_.session, simulator_);
  if (stored_.id == shown_result_) return;
  shown_result_ = stored_.id;
  parameters_->forgetTicks();
  story_.reset();
  if (stored_.id == 0) return;
  try {
    story_ = std::make_shared<const SimulationStory>(
        SimulationStory::parse(context_.session.session()->payload(stored_.id)));
  } catch (const InputError& e) {
    failure_ = coreSentence(e.what());
  }
}

void SimulationPanel::openSoon() {
  SessionModel& session = context_.session;
  const auto campaign = session.campaign();
  if (!isVisible() || campaign == nullptr) return;
  const std::string key = std::to_string(session.visit()) + " " + simulator_;
  if (key == opened_key_) return;
  opened_key_ = key;
  opened_ = {};
  const auto observations = session.observations();
  if (simulator_.empty() || !observations) {
    opening_.forget();
    showParameters();
    return;
  }
  // A snapshot: the page may show another campaign by then.
  opening_.ask([this, file = simulatorFile(session, simulator_), campaign, observations] {
    OpenedSimulator read = OpenedSimulator::read(file, *campaign, *observations);
    return [this, read = std::move(read)] {
      opened_ = read;
      showParameters();
      showFound();
      showCallout();
      updateButtons();
    };
  });
}

void SimulationPanel::chooseSimulator(const QString& file) {
  SessionModel& session = context_.session;
  const std::string name = placeName(*session.session(), file.toStdString());
  opened_key_.clear();  // it may have changed on the disk
  if (name == simulator_) {
    refresh();
    return;
  }
  context_.undo.push(new OptionsCommand(session, tr("choose the simulator"), simulatorKey(session.campaignId()), name,
                                        [panel = QPointer(this)] {
                                          if (panel != nullptr) panel->simulatorChanged();
                                        }));
}

void SimulationPanel::simulatorChanged() {
  refresh();
}

void SimulationPanel::fail(const QString& sentence) {
  failure_ = sentence;
  refresh();
}

bool SimulationPanel::searching() const {
  return context_.session.isRunning("simulation");
}

void SimulationPanel::search() {
  if (searching() || simulator_.empty() || !context_.session.observations()) return;
  failure_.clear();
  const auto found = std::make_shared<std::shared_ptr<const DiscrepancyRun>>();
  runTask(context_.session, context_.jobs, "simulation",
          {.take = [found](const TaskGiven& given) { *found = given.result.as<DiscrepancyRun>(); },
           .done =
               [this, found] {
                 const SessionModel& session = context_.session;
                 if (const StoredResult* stored = session.latest("simulation"))
                   searched_ = {session.visit(), stored->id, *found};
                 refresh();
               },
           .failed = [this](const QString& sentence) { fail(sentence); },
           .cancelled = [this] { refresh(); }});
}

QString SimulationPanel::proposedFolder() const {
  const fs::path folder = context_.session.folder() / "simulations";
  const std::string name = fileNameOf(fromCore(context_.session.campaign()->name)).toStdString();
  for (int version = 2;; ++version) {
    const fs::path proposed = folder / (name + "-" + std::to_string(version));
    if (!fs::exists(proposed)) return fromCore(proposed.string());
  }
}

void SimulationPanel::askForFolder() {
  const QString folder = askForVersionFolder(this, proposedFolder(), opened_.runs);
  if (!folder.isEmpty()) putInto(folder);
}

QString SimulationPanel::whyNotPut() const {
  const std::vector<std::string> ticked = parameters_->ticked();
  // Before a search what it finds is put in.
  const bool searched = story_ != nullptr && current();
  if (ticked.empty() && (searched || parameters_->ticksAreTheUsers())) {
    return searched && story_->effects.empty() && !parameters_->ticksAreTheUsers()
               ? tr("Nothing was found that could be put in. Tick a parameter in the column Put in to put it in all "
                    "the "
                    "same.")
               : tr("Tick what is to be put in, in the column Put in.");
  }
  if (!parameters_->ticksAreTheUsers()) return {};
  return told(whyNotTogether(ticked, opened_.parameters, opened_.windows,
                             story_ != nullptr ? story_->twins : decltype(story_->twins)()));
}

void SimulationPanel::putInto(const QString& folder) {
  if (searching() || simulator_.empty() || !context_.session.observations()) return;
  if (const QString why = whyNotPut(); !why.isEmpty()) {
    callout_->show(Tone::Attention, why);
    return;
  }
  failure_.clear();
  const fs::path target = fs::absolute(folder.toStdString()).lexically_normal();
  const fs::path within =
      target.lexically_relative(fs::absolute(context_.session.campaign()->folder).lexically_normal());
  if (!within.empty() && *within.begin() != "..") {
    fail(tr("%1 lies in the campaign folder, which is never written to; choose another place.").arg(folder));
    return;
  }
  const std::string version = placeName(*context_.session.session(), target / "simulator.json");
  // Anything else is searched anew, as part of the job.
  const bool kept = searched_.run != nullptr && searched_.visit == context_.session.visit() &&
                    searched_.result == stored_.id && current();
  IntoSimulationOptions into;
  if (parameters_->ticksAreTheUsers()) into.mechanisms = parameters_->ticked();
  const PendingResult pending = context_.session.begin("simulation");
  const ResultWork work = [this, task = SimulationTask::of(context_.session.tasks(), context_.session.taskInputs()),
                           campaign_id = pending.origin.campaign, target, version, into,
                           before = kept ? searched_.run : nullptr](JobContext& progress) -> Worked {
    const auto run = std::make_shared<const DiscrepancyRun>(task.putInto(target, into, before.get(), progress));
    Worked worked{SimulationStory::of(*run).json(), {}};
    if (run->update->status != FitStatus::Converged) return worked;
    worked.options = {{"version", version}, {"written", simulatorFingerprint(target / "simulator.json")}};
    // The version is that of the campaign it was made from, whichever is at hand by then.
    worked.stored = [this, campaign_id, version, mechanisms = run->update->mechanisms] {
      context_.undo.push(
          new OptionsCommand(context_.session, tr("put %1 into the simulation").arg(fromCore(joinedList(mechanisms))),
                             simulatorKey(campaign_id), version,
                             [panel = QPointer(this)] {
                               if (panel != nullptr) panel->simulatorChanged();
                             }),
          campaign_id);
    };
    return worked;
  };
  context_.jobs.run(taskJob(context_.session, pending, tr("Putting it into the simulation"), work,
                            {.done = [this] { refresh(); },
                             .failed = [this](const QString& sentence) { fail(sentence); },
                             .cancelled = [this] { refresh(); }}));
}

QString SimulationPanel::titleOf(const FoundEffect& effect) const {
  for (const SimulatorParameter& p : opened_.parameters)
    if (p.id() == effect.id) return p.what.empty() ? fromCore(p.name) : coreSentence(p.what);
  return !effect.title.empty() ? fromCore(effect.title) : effectTitle(effect.id);
}

QString SimulationPanel::told(std::string sentence) const {
  std::vector<const SimulatorParameter*> parameters;
  for (const SimulatorParameter& p : opened_.parameters)
    if (!p.what.empty() && p.what != p.name) parameters.push_back(&p);
  // A name may begin another.
  std::sort(parameters.begin(), parameters.end(),
            [](const auto* a, const auto* b) { return a->name.size() > b->name.size(); });
  for (const SimulatorParameter* p : parameters)
    for (std::size_t at = sentence.find(p->name); at != std::string::npos; at = sentence.find(p->name, at)) {
      sentence.replace(at, p->name.size(), p->what);
      at += p->what.size();
    }
  return sentenceStart(titledSentence(sentence));
}

void SimulationPanel::showHead() {
  const QString file = fromCore(simulator_);
  title_->setText(simulator_.empty() ? tr("No simulator") : fromCore(fs::path(simulator_).filename().string()));
  head_->setToolTip(file);
  runs_->setText(simulator_.empty()
                     ? tr("campaign.json names no simulation that can be run (\"simulator\": \"simulator.json\"). "
                          "Choose one: what is missing is then looked for among its parameters and put into it.")
                     : tr("%1%2 %3")
                           .arg(file, opened_.kind.isEmpty() ? QString() : tr(", %1.").arg(opened_.kind), opened_.runs)
                           .trimmed());
}

void SimulationPanel::showParameters() {
  showHead();
  parameters_->show(opened_, story_.get(), update());
}

void SimulationPanel::showFound() {
  found_card_->setVisible(story_ != nullptr);
  if (story_ == nullptr) {
    found_->clear();
    return;
  }
  QString html;
  for (const FoundEffect& e : story_->effects) {
    QString words = sentenceStart(driverWords(e.drivers));
    if (!words.isEmpty()) words += QLatin1Char('.');
    if (std::isfinite(e.confidence)) words += QLatin1Char(' ') + tr("Confidence %1.").arg(percentOf(e.confidence));
    if (!e.rivals.empty())
      words += QLatin1Char(' ') + tr("These data cannot distinguish it from %1.").arg(effectTitles(e.rivals, tr("or")));
    html +=
        QStringLiteral("<p><b>%1</b><br>%2</p>").arg(sentenceStart(titleOf(e)).toHtmlEscaped(), words.toHtmlEscaped());
  }
  if (story_->effects.empty()) html += QStringLiteral("<p>%1</p>").arg(told(story_->message).toHtmlEscaped());
  std::vector<std::string> warnings;
  if (const SimulationUpdate* done = update()) {
    warnings = done->warnings;
    html += QStringLiteral("<p>%1</p>")
                .arg(tr("%1 runs of the simulation to search, %2 to fit (%3 s).")
                         .arg(done->runs_to_search)
                         .arg(done->runs)
                         .arg(decimalText(done->elapsed_s, 'f', 0))
                         .toHtmlEscaped());
  } else {
    warnings = story_->warnings;
  }
  for (const std::string& w : warnings) html += QStringLiteral("<p>%1</p>").arg(told(w).toHtmlEscaped());
  found_->setText(onScreen(html));
}

void SimulationPanel::showFigures() {
  const SimulationUpdate* done = update();
  const bool there = done != nullptr && !story_->rows.empty();
  figure_table_->setVisible(there);
  std::vector<Row> rows;
  if (there) {
    const QString unit = unitText(story_->gap.rotations ? "urad" : "um");
    const auto line = [&](const QString& id, const QString& name, double before, double after, double term,
                          double noise) {
      Row row;
      row.id = id;
      row.cells.push_back({name});
      for (const double value : {before, after, term, noise}) {
        Cell cell{sizeText(value, {})};
        cell.right = true;
        cell.unit = unit;
        row.cells.push_back(std::move(cell));
      }
      row.cells[2].bold = true;
      rows.push_back(std::move(row));
    };
    const double none = std::nan("");
    figures_->setHeaders({tr("Residual / %1").arg(unit), tr("Before"), tr("After"), tr("Fitted term"), tr("Noise")});
    line(QStringLiteral("fit"), tr("rms, fitted"), done->rms_before_um, done->rms_after_um, done->rms_fitted_term_um,
         done->noise_um);
    line(QStringLiteral("heldout"), tr("rms, held out"), done->heldout_rms_before_um, done->heldout_rms_after_um,
         done->heldout_rms_fitted_term_um, done->noise_um);
    line(QStringLiteral("p2p"), tr("Peak to peak"), done->p2p_before_um, done->p2p_after_um, none, none);
  }
  figures_->setRows(std::move(rows));
  found_card_->setTitle(there ? tr("Before and after") : tr("What was found"));
  arrange();
}

void SimulationPanel::showCallout() {
  callout_->setAction({}, {});
  if (!failure_.isEmpty()) {
    callout_->show(Tone::Bad, failure_);
    return;
  }
  if (!opened_.error.isEmpty()) {
    callout_->show(Tone::Bad, opened_.error);
    return;
  }
  if (story_ == nullptr) {
    const QString why = parameters_->ticksAreTheUsers() ? whyNotPut() : QString();
    callout_->set(Tone::Attention, why);
    return;
  }
  if (!current()) {
    callout_->show(Tone::Outdated, tr("Observations, exclusions, the machine or the effects have changed since the "
                                      "simulator was searched with."));
    callout_->setAction(tr("Search again"), [this] { search(); });
    return;
  }
  if (const SimulationUpdate* done = update()) {
    callout_->show(done->status != FitStatus::Converged ? Tone::Bad
                   : done->as_well_as_fitted_term       ? Tone::Good
                                                        : Tone::Attention,
                   told(done->message));
    return;
  }
  if (const QString why = whyNotPut(); !why.isEmpty() && parameters_->ticksAreTheUsers()) {
    callout_->show(Tone::Attention, why);
  } else if (story_->verdict == DiscrepancyVerdict::None) {
    callout_->show(Tone::Good, tr("Measured and the simulator's own run agree within the noise."));
  } else if (story_->effects.empty()) {
    callout_->show(Tone::Attention, told(story_->message));
  } else {
    callout_->set(Tone::Neutral, {});  // the card tells it
  }
}

void SimulationPanel::showView(int index) {
  if (index == view_maps) {
    if (maps_ == nullptr) {
      maps_ = new SimulationMaps;
      stack_->addWidget(maps_);
      connect(maps_, &SimulationMaps::hovered, this, &SimulationPanel::hovered);
    }
    if (maps_stale_ && update() != nullptr) {
      maps_->show(story_, context_.session.campaign()->machine);
      maps_stale_ = false;
    }
    stack_->setCurrentWidget(maps_);
    return;
  }
  stack_->setCurrentIndex(index == view_history ? 1 : 0);
}

void SimulationPanel::updateButtons() {
  const bool idle = !searching();
  const bool usable = !simulator_.empty() && opened_.error.isEmpty();
  choose_->setEnabled(idle);
  search_->setVisible(!simulator_.empty());
  search_->setEnabled(idle && usable);
  put_->setVisible(!simulator_.empty() && update() == nullptr);
  const QString why = whyNotPut();
  put_->setEnabled(idle && usable && why.isEmpty());
  put_->setToolTip(!why.isEmpty() ? why
                   : story_ != nullptr && current()
                       ? tr("Fit the physical parameters on the simulator and write its new version to a new folder; "
                            "the present one stays as it is")
                       : tr("Search with the simulator, put in what is found and write its new version to a new "
                            "folder; the present one stays as it is"));
}

std::vector<Exportable> SimulationPanel::exportables() {
  std::vector<Exportable> items;
  if (parameters_->model()->rowCount() > 0)
    items.push_back(exportableOf(tr("Parameters of the simulator"), parameters_->model()));
  if (story_ == nullptr) return items;
  if (figures_->rowCount() > 0) {
    items.push_back(exportableOf(tr("Simulation before and after"), figures_));
    items.push_back(exportableOf(tr("Initial and updated simulation over time"), history_->plot()));
  }
  if (maps_ != nullptr && !maps_stale_) {
    for (const Exportable& item : maps_->exportables()) items.push_back(item);
  }
  items.push_back({tr("Search with the simulator"), {QStringLiteral("json")}, [story = story_](const QString& file) {
                     nlohmann::json out = story->result;
                     if (story->update) out["into_simulation"] = story->update->json();
                     writeFileAtomically(file.toStdString(), out.dump(2) + "\n");
                   }});
  return items;
}

}  // namespace spindrift::gui
