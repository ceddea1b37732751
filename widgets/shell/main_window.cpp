// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/main_window.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QCoreApplication>
#include <QCryptographicHash>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/error.h"
#include "core/tasks/task_chain.h"
#include "core/tasks/task_options.h"
#include "core/workflows/log_campaign.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/parts.h"
#include "widgets/common/preferences.h"
#include "widgets/common/question.h"
#include "widgets/export/exportable.h"
#include "widgets/export/picture_habits.h"
#include "widgets/jobs/activity_dialog.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/jobs/task_run.h"
#include "widgets/pages/compensate/closed_loop_page.h"
#include "widgets/pages/plant/plant_page.h"
#include "widgets/services/connections_service.h"
#include "widgets/services/incoming_service.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/help_panel.h"
#include "widgets/shell/new_measurement_dialog.h"
#include "widgets/shell/page_area.h"
#include "widgets/shell/preferences_dialog.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/welcome_page.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/shown_units.h"
#include "widgets/theme/system_look.h"
#include "widgets/view3d/prepare.h"

namespace spindrift::gui {

namespace {

/// Shows what the session holds now. Why the task of the step failed is said as long as it would fail again: the list
/// of steps says so too, and a page that is opened again has no other way to know.
void fill(Page& page, const SessionModel& session) {
  page.refresh();
  const TaskGraph tasks = session.tasks();
  const std::string task = taskOfStep(tasks, page.step());
  if (task.empty()) return;
  const TaskStatus status = tasks.status(task);
  if (status.state == TaskState::Failed) page.callout()->show(Tone::Bad, coreSentence(status.reason));
}

}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent), workflow_(session_) {
  setWindowIcon(applicationIcon());
  setMinimumSize(1024, 700);
  registerPages(registry_);

  auto* centre = new QWidget;
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  stack_ = new QStackedWidget;
  column->addWidget(stack_, 1);
  job_bar_ = new JobBar(jobs_);
  column->addWidget(job_bar_);
  connect(job_bar_, &JobBar::activityWanted, this, &MainWindow::openActivity);
  setCentralWidget(centre);

  welcome_ = new WelcomePage;
  stack_->addWidget(welcome_);

  work_ = new QWidget;
  auto* work_line = new QHBoxLayout(work_);
  work_line->setContentsMargins(0, 0, 0, 0);
  work_line->setSpacing(0);
  steps_ = new StepList(workflow_);
  work_line->addWidget(steps_);
  auto* right = new QVBoxLayout;
  right->setSpacing(0);
  auto* top = new QFrame;
  top->setProperty("role", QStringLiteral("topBar"));
  auto* top_line = new QHBoxLayout(top);
  top_line->setContentsMargins(24, 6, 12, 6);
  top_line->setSpacing(8);
  session_name_ = new OneLine;
  session_name_->setProperty("role", QStringLiteral("secondaryText"));
  campaign_ = new QComboBox;
  campaign_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  campaign_->setAccessibleName(tr("Campaign"));
  campaign_->setToolTip(tr("The campaign at hand; a session may hold several"));
  campaign_->setMinimumWidth(240);
  top_line->addWidget(campaign_);
  top_line->addWidget(session_name_, 1);
  back_ = makeButton(tr("Back"), "chevron-left");
  next_ = makeButton(tr("Next"), "chevron-right");
  next_->setLayoutDirection(Qt::RightToLeft);
  top_line->addWidget(back_);
  top_line->addWidget(next_);
  right->addWidget(top);
  page_stack_ = new PageStack;
  right->addWidget(page_stack_, 1);
  work_line->addLayout(right, 1);
  help_ = new HelpPanel;
  connect(help_, &HelpPanel::closed, this, [this] { help_action_->trigger(); });
  work_line->addWidget(help_);
  stack_->addWidget(work_);
  plant_ = new PlantPage(session_, jobs_);
  stack_->addWidget(plant_);
  connect(plant_, &PlantPage::closed, this, &MainWindow::showSessionOrWelcome);
  live_compensation_ = new ClosedLoopPage(session_);
  stack_->addWidget(live_compensation_);
  connect(live_compensation_, &ClosedLoopPage::closed, this, &MainWindow::showSessionOrWelcome);
  connect(&ClosedLoopService::of(session_), &ClosedLoopService::asked, this, &MainWindow::openLiveCompensation);

  buildMenu();
  showHelp();
  followPreferences();
  watchConnections();

  connect(back_, &QPushButton::clicked, &workflow_, &Workflow::back);
  connect(next_, &QPushButton::clicked, &workflow_, &Workflow::next);
  connect(&workflow_, &Workflow::currentChanged, this, &MainWindow::showStep);
  connect(&workflow_, &Workflow::currentChanged, job_bar_, &JobBar::leaveFailure);
  connect(&workflow_, &Workflow::statusChanged, this, &MainWindow::offerNextSoon);
  connect(&jobs_, &JobRunner::changed, this, &MainWindow::offerNextSoon);
  connect(&session_, &SessionModel::sessionChanged, this, [this] {
    jobs_.cancelOfSession();  // of a session that nobody looks at any more
    verifyFiles();
    welcome_->offerRecovery({});
    refreshTitle();
    refreshCampaigns();
    showSessionOrWelcome();
  });
  connect(&session_, &SessionModel::campaignChanged, this, [this] {
    refreshCampaigns();
    // Nobody is taken away from the plant or from a machine that is being compensated because the campaign was read
    // again; only where another one was chosen.
    const bool other = shown_visit_ != session_.visit();
    shown_visit_ = session_.visit();
    if (other || session_.campaign() == nullptr || welcomeShown()) showSessionOrWelcome();
    showStep();
  });
  connect(&session_, &SessionModel::inputsChanged, this, &MainWindow::refreshPage);
  // Whoever asked for it: a page shows what is stored.
  connect(&session_, &SessionModel::resultChanged, this, &MainWindow::refreshPage);
  connect(campaign_, &QComboBox::activated, this, [this](int) {
    selectCampaign(campaign_->currentData().toLongLong());
    // What is shown is still that of the campaign at hand.
    refreshCampaigns();
  });
  connect(&session_, &SessionModel::storingFailed, this, &MainWindow::tell);
  connect(welcome_, &WelcomePage::demoChosen, this, [this](const QString& name) { startDemo(name); });
  connect(welcome_, &WelcomePage::recentChosen, this, &MainWindow::askAndOpen);
  connect(welcome_, &WelcomePage::openSession, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(
        this, tr("Open a session"),
        lastFolder(QStringLiteral("session"), QString::fromStdString(sessionsFolder().string())));
    if (folder.isEmpty()) return;
    rememberFolder(QStringLiteral("session"), QFileInfo(folder).absolutePath());
    askAndOpen(folder);
  });
  connect(welcome_, &WelcomePage::openCampaign, this, [this] {
    const QString folder = askForCampaign(tr("Open a campaign folder"));
    if (!folder.isEmpty()) askAndOpen(folder);
  });
  connect(welcome_, &WelcomePage::openPlant, this, &MainWindow::openPlant);
  connect(welcome_, &WelcomePage::newMeasurement, this, &MainWindow::newMeasurement);
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this,
          [this] { theme_button_->setIcon(icon(theme().kind == ThemeKind::Dark ? "sun" : "moon")); });

  QCoreApplication::instance()->installEventFilter(this);
  static QPointer<PictureHabits> of_all_windows;
  if (of_all_windows == nullptr) of_all_windows = new PictureHabits(QCoreApplication::instance());
  QSettings settings;
  const QStringList recent = recentSessions();
  setAcceptDrops(true);
  fillRecentMenu();
  if (!recent.isEmpty() && Session::wasLeftOpen(recent.front().toStdString())) welcome_->offerRecovery(recent.front());
  if (!restoreGeometry(settings.value(QStringLiteral("window")).toByteArray())) {
    // Frame and title bar need room too, where there are such.
    const QSize room = screen()->availableSize() - QSize(16, 48);
    const bool framed = QGuiApplication::platformName() != QStringLiteral("offscreen");
    resize(framed ? QSize(1440, 900).boundedTo(room) : QSize(1440, 900));
  }
  refreshTitle();
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  // Enter presses a button that has the focus, as Space does.
  if (event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    auto* button = qobject_cast<QAbstractButton*>(watched);
    if (button != nullptr && button->isEnabled() && (key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter) &&
        (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier) {
      button->click();
      return true;
    }
  }
  return QMainWindow::eventFilter(watched, event);
}

QString MainWindow::askForCampaign(const QString& title) {
  const QString kind = QStringLiteral("campaign");
  const QString folder = QFileDialog::getExistingDirectory(this, title, lastFolder(kind));
  // Campaigns stand beside one another.
  if (!folder.isEmpty()) rememberFolder(kind, QFileInfo(folder).absolutePath());
  return folder;
}

MainWindow::~MainWindow() {
  finishRecording();
  jobs_.cancelAll();
  // Pages hold references to what stands below them in this class.
  for (const auto& [entry, page] : pages_) delete page;
}

void MainWindow::showSessionOrWelcome() {
  fillRecentMenu();  // folders may have gone meanwhile
  stack_->setCurrentWidget(session_.isOpen() && session_.campaign() != nullptr ? work_
                                                                               : static_cast<QWidget*>(welcome_));
}

void MainWindow::openPlant() {
  stack_->setCurrentWidget(plant_);
  plant_->refresh();
}

void MainWindow::openLiveCompensation() {
  stack_->setCurrentWidget(live_compensation_);
  live_compensation_->refresh();
}

bool MainWindow::welcomeShown() const {
  return stack_->currentWidget() == welcome_;
}

void MainWindow::showStep() {
  if (session_.campaign() == nullptr) {
    page_ = nullptr;
    arrival_ = Arrival::Done;
    return;
  }
  const PageRegistry::Entry* entry = registry_.find(workflow_.current(), session_);
  Page*& page = pages_[entry];
  if (page == nullptr) {
    PageContext context{session_, jobs_, undo_, workflow_, [this](const QString& text) { job_bar_->setHint(text); }};
    page = entry->factory(std::move(context), page_stack_->makePlace());
  }
  page_ = page;
  back_->setEnabled(workflow_.canGoBack());
  next_->setEnabled(workflow_.canGoNext());
  job_bar_->setHint({});
  if (help_action_->isChecked()) help_->showStep(workflow_.current());
  arrival_ = Arrival::Place;
  if (page_stack_->holds(page)) {
    while (arrival_ != Arrival::Done) arrive();
  } else {
    arriveSoon();
  }
}

void MainWindow::arriveSoon() {
  QMetaObject::invokeMethod(
      this,
      [this] {
        arrive();
        if (arrival_ != Arrival::Done) arriveSoon();
      },
      Qt::QueuedConnection);
}

void MainWindow::arrive() {
  switch (std::exchange(arrival_, Arrival::Done)) {
    case Arrival::Done:
      return;
    case Arrival::Place:
      if (!page_stack_->holds(page_)) {
        page_stack_->add(page_);
        restoreSplitters(*page_);
        for (const QTabWidget* tabs : page_->findChildren<QTabWidget*>())
          connect(tabs, &QTabWidget::currentChanged, this, &MainWindow::offerNextSoon);
      }
      page_stack_->show(page_);
      arrival_ = Arrival::Fill;
      return;
    case Arrival::Fill:
      fill(*page_, session_);
      offerNextSoon();
      return;
  }
}

void MainWindow::runAllSteps() {
  running_all_ = true;
  run_last_.reset();
  goOnRunning();
}

void MainWindow::goOnRunning() {
  if (!running_all_ || jobs_.busy() || arriving()) return;
  QPushButton* due = dueButton();
  if (due != nullptr && due->isEnabled() && due == next_) {
    due->click();
  } else if (due != nullptr && due->isEnabled() && run_last_ != workflow_.current()) {
    run_last_ = workflow_.current();
    due->click();
  } else {
    running_all_ = false;
    const StepId step = workflow_.current();
    tell(step == StepId::Report && workflow_.status(step).state == StepState::Current
             ? tr("All steps are done and the report is written.")
             : tr("Step %1 needs your review before you continue.").arg(stepTitle(step)));
  }
}

QString MainWindow::nothingOutdated() {
  if (session_.campaign() == nullptr) return tr("Open a session first.");
  return OutdatedChain().next(session_.tasks()) ? QString() : tr("Nothing that was calculated is outdated.");
}

void MainWindow::runOutdated() {
  if (const QString why = nothingOutdated(); !why.isEmpty()) {
    tell(why);
    return;
  }
  spindrift::gui::runOutdated(session_, jobs_, {.done = [this] {
                                QStringList steps;
                                for (const StepId step : all_steps) {
                                  const std::string task = taskOfStep(session_.tasks(), step);
                                  if (task.empty()) continue;
                                  const TaskStatus status = session_.tasks().status(task);
                                  if (status.result != 0 && !status.current) steps << stepTitle(step);
                                }
                                tell(steps.isEmpty() ? tr("What was outdated has been run: all results are current.")
                                                     : tr("Still outdated: %1.").arg(steps.join(QStringLiteral(", "))));
                              }});
}

QPushButton* MainWindow::dueButton() {
  if (currentPage() == nullptr) return nullptr;
  offerNext();
  return next_->property("role").toString() == QLatin1String("primary") ? next_ : page_->primaryButton();
}

void MainWindow::offerNextSoon() {
  if (offer_queued_) return;
  offer_queued_ = true;
  QMetaObject::invokeMethod(
      this,
      [this] {
        offer_queued_ = false;
        offerNext();
        goOnRunning();
      },
      Qt::QueuedConnection);
}

void MainWindow::offerNext() {
  if (page_ == nullptr || arrival_ != Arrival::Done || session_.campaign() == nullptr || jobs_.busy()) return;
  QPushButton* run = page_->primaryButton();
  const auto isPrimary = [](const QPushButton& button) {
    return button.property("role").toString() == QLatin1String("primary");
  };
  // What a result asks for, such as an effect to be added, comes before going on.
  const auto buttons = page_->findChildren<QPushButton*>();
  const bool asked = std::any_of(buttons.begin(), buttons.end(), [&](const QPushButton* b) {
    return b != run && b->isVisible() && b->isEnabled() && isPrimary(*b);
  });
  const TaskGraph tasks = session_.tasks();
  const StepState state = workflow_.status(workflow_.current()).state;
  const std::string task = taskOfStep(tasks, workflow_.current());
  const bool done = state == StepState::Current ||
                    (state == StepState::Attention && !task.empty() && tasks.status(task).state == TaskState::Current);
  const bool go_on = workflow_.canGoNext() && !asked && (run == nullptr || !run->isEnabled() || done);
  const auto show = [&](QPushButton* button, bool primary) {
    if (button != nullptr && isPrimary(*button) != primary) setRole(button, primary ? "primary" : "secondary");
  };
  show(run, !asked && !go_on);
  show(next_, go_on);
}

Page* MainWindow::currentPage() {
  while (arrival_ != Arrival::Done) arrive();
  return page_;
}

void MainWindow::refreshPage() {
  if (refresh_queued_) return;
  refresh_queued_ = true;
  QMetaObject::invokeMethod(
      this,
      [this] {
        refresh_queued_ = false;
        if (arrival_ != Arrival::Done) return;  // It is filled anyway.
        if (page_ != nullptr && session_.campaign() != nullptr) fill(*page_, session_);
        offerNextSoon();
      },
      Qt::QueuedConnection);
}

void MainWindow::refreshTitle() {
  setWindowTitle(session_.isOpen() ? tr("%1 – Spindrift").arg(session_.name()) : QStringLiteral("Spindrift"));
  session_name_->setText(session_.isOpen() ? tr("Session %1").arg(session_.name()) : QString());
  session_name_->setToolTip(QString::fromStdString(session_.folder().string()));
}

void MainWindow::refreshCampaigns() {
  campaign_->clear();
  for (const CampaignRecord& record : session_.campaigns()) {
    campaign_->addItem(shownName(record.name), QVariant::fromValue<qlonglong>(record.id));
    if (record.id == session_.campaignId()) campaign_->setCurrentIndex(campaign_->count() - 1);
  }
}

void MainWindow::remember(const QString& folder) {
  QSettings settings;
  QStringList recent = settings.value(QStringLiteral("recent")).toStringList();
  recent.removeAll(folder);
  recent.prepend(folder);
  while (recent.size() > 8) recent.removeLast();
  settings.setValue(QStringLiteral("recent"), recent);
  fillRecentMenu();
}

namespace {

/// Of all that is opened or chosen the last is wanted.
constexpr auto chosen_key = "campaign";

}  // namespace

void MainWindow::selectCampaign(std::int64_t id) {
  jobs_.cancel(reading_);
  if (!session_.isOpen()) return;
  if (id == session_.campaignId()) {
    // Who chooses it wants to see it, wherever the window has gone meanwhile.
    showSessionOrWelcome();
    showStep();
    return;
  }
  try {
    Job job;
    job.work = [this, reading = session_.reading(id)](JobContext& context) -> std::function<void()> {
      auto read = std::make_shared<ReadCampaign>(reading.read(context));
      return [this, read] { session_.take(std::move(*read)); };
    };
    job.title = tr("Reading %1").arg(QString::fromStdString(session_.session()->campaign(id).name));
    job.queue = JobQueue::Campaign;
    job.key = chosen_key;
    job.abandonable = true;
    reading_ = jobs_.run(std::move(job));
  } catch (const InputError& e) {
    tell(coreSentence(e.what()));
  }
}

void MainWindow::openSession(const QString& folder) {
  Job job;
  job.title = tr("Opening %1").arg(QDir(folder).dirName());
  job.queue = JobQueue::Campaign;
  job.key = chosen_key;
  job.work = [this, folder](JobContext& context) -> std::function<void()> {
    prepareOpenGl();
    auto loaded = std::make_shared<LoadedSession>(
        loadSession(std::make_unique<Session>(Session::open(folder.toStdString())), 0, context));
    return [this, folder, loaded] {
      finishRecording();
      session_.adopt(std::move(*loaded));
      remember(folder);
      workflow_.goTo(StepId::Machine);
      const Session& session = *session_.session();
      for (const std::string& message : session.migrationMessages()) tell(coreSentence(message));
      for (const std::string& message : session.recoveryMessages()) tell(coreSentence(message));
    };
  };
  job.failed = [this](const QString& sentence) { tell(sentence); };
  jobs_.run(std::move(job));
}

/// Files are held against what the session knows of them, in the background: results of a campaign whose files were
/// changed by another program must not look current.
void MainWindow::verifyFiles() {
  if (!session_.isOpen()) return;
  Job job;
  job.title = tr("Checking files for changes");
  job.quiet = true;
  job.queue = JobQueue::Files;
  job.key = "files";
  job.work = [this, campaigns = session_.campaigns(),
              session = session_.sessionNumber()](JobContext& context) -> std::function<void()> {
    std::vector<std::pair<CampaignRecord, FileFingerprints>> found;
    for (const CampaignRecord& record : campaigns)
      found.emplace_back(record, fingerprintsOfFiles(record.folder, context));
    return [this, session, found] {
      if (session != session_.sessionNumber()) return;
      for (const auto& [record, files] : found) {
        // Captured meanwhile: what was read is no longer what there is.
        const std::vector<CampaignRecord> now = session_.campaigns();
        const bool same = std::any_of(now.begin(), now.end(), [&record = record](const CampaignRecord& r) {
          return r.id == record.id && r.fingerprint == record.fingerprint;
        });
        if (!same) continue;
        const FileCheck check = session_.takeFiles(record.id, files);
        if (!check.same())
          tell(tr("Files of the campaign %1 have changed since its results were calculated: %2.")
                   .arg(shownName(record.name), QString::fromStdString(check.sentence())));
      }
    };
  };
  job.failed = [this](const QString& sentence) { tell(sentence); };
  jobs_.run(std::move(job));
}

/// What is connected, and what is lost, is said on every page.
void MainWindow::watchConnections() {
  ConnectionsService& service = ConnectionsService::of(session_);
  connect(&service, &ConnectionsService::changed, this, &MainWindow::showConnections);
  connect(&service, &ConnectionsService::told, this,
          [this](Tone tone, const QString& sentence) { job_bar_->setMessage(tone, sentence); });
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, &MainWindow::showConnections);
  connect(&ClosedLoopService::of(session_), &ClosedLoopService::changed, this, &MainWindow::showConnections);
  connect(job_bar_, &JobBar::connectionsWanted, this, [this] {
    if (ClosedLoopService::of(session_).running()) {
      openLiveCompensation();
      return;
    }
    if (session_.campaign() == nullptr) return;
    workflow_.goTo(StepId::Machine);
    if (auto* tabs = currentPage()->findChild<QTabWidget*>(QStringLiteral("machineTabs")))
      tabs->setCurrentIndex(tabs->count() - 1);
  });
}

/// The log is whole and known before its session goes.
void MainWindow::finishRecording() {
  ConnectionsService::of(session_).finishNow();
}

void MainWindow::showConnections() {
  const ConnectionsService& service = ConnectionsService::of(session_);
  const ClosedLoopService& loop = ClosedLoopService::of(session_);
  if (!service.running() && !loop.running()) {
    job_bar_->setConnections(Tone::Neutral, {}, {});
    return;
  }
  QStringList lost;
  for (const LiveSource& source : service.snapshot().sources) {
    if (source.status.state == SourceStatus::State::Lost) lost << QString::fromStdString(source.name);
  }
  const QString problem = coreSentence(service.snapshot().problem);
  if (!problem.isEmpty()) {
    job_bar_->setConnections(Tone::Bad, tr("Not written"), problem);
  } else if (!lost.isEmpty()) {
    job_bar_->setConnections(
        Tone::Bad, lost.size() == 1 ? tr("%1 lost").arg(lost.front().left(24)) : tr("%1 sources lost").arg(lost.size()),
        service.lost());
  } else if (loop.running()) {
    const LoopStatus& status = loop.snapshot().status;
    job_bar_->setConnections(status.active ? Tone::Good : Tone::Attention,
                             status.active ? tr("Compensating") : tr("Compensation off"),
                             QString::fromStdString(status.channel));
  } else if (service.recording()) {
    job_bar_->setConnections(Tone::Good, tr("Recording"),
                             tr("%n rows of log.csv", nullptr, static_cast<int>(service.snapshot().rows)));
  } else {
    job_bar_->setConnections(Tone::Good, tr("Live"), tr("Connected; nothing is written"));
  }
}

ActivityDialog* MainWindow::openActivity() {
  if (activity_ == nullptr) activity_ = new ActivityDialog(jobs_, job_bar_->log(), this);
  activity_->show();
  activity_->raise();
  return activity_;
}

/// After the job bar has had its word about the job that ended.
void MainWindow::tell(const QString& sentence) {
  QMetaObject::invokeMethod(
      this, [this, sentence] { job_bar_->setMessage(sentence); }, Qt::QueuedConnection);
}

namespace {

/// A new campaign begins with the goals the user prefers. They are kept with it: the command line judges by them, too.
void giveGoals(Session& session, std::int64_t campaign) {
  const Preferences wanted = preferences();
  auto options = chosen<VerifyOptions>(session, campaign);
  if (wanted.goal_um == options.request.goal_um && wanted.goal_urad == options.request.goal_urad) return;
  options.request.goal_um = wanted.goal_um;
  options.request.goal_urad = wanted.goal_urad;
  session.setSetting(campaignKey(VerifyOptions::key, campaign), optionsJson(options));
}

}  // namespace

void MainWindow::importInBackground(const QString& title, std::function<std::filesystem::path(JobContext&)> source,
                                    const QString& name) {
  const std::filesystem::path folder = newSessionFolder(name);
  Job job;
  job.title = title;
  job.work = [this, source = std::move(source), folder](JobContext& context) -> std::function<void()> {
    prepareOpenGl();
    JobContext first = context.part(0.0, 0.8);
    const std::filesystem::path campaign_folder = source(first);
    auto session = std::make_shared<std::unique_ptr<Session>>();
    try {
      *session = std::make_unique<Session>(Session::create(folder));
      JobContext second = context.part(0.8, 1.0);
      const std::int64_t id = (*session)->importCampaign(campaign_folder, second);
      giveGoals(**session, id);
      auto loaded = std::make_shared<LoadedSession>(loadSession(std::move(*session), id));
      return [this, loaded, folder] {
        const QString work = session_.isOpen() ? jobs_.firstOf(JobQueue::Work) : QString();
        if (!work.isEmpty()) {  // begun while this ran
          remember(QString::fromStdString(folder.string()));
          tell(tr("%1 is imported. \"%2\" is still running here, so it is not opened: it stands among the recent "
                  "sessions.")
                   .arg(QString::fromStdString(folder.filename().string()), work));
          return;
        }
        finishRecording();
        session_.adopt(std::move(*loaded));
        remember(QString::fromStdString(folder.string()));
        workflow_.goTo(StepId::Machine);
        showStep();
      };
    } catch (...) {
      session->reset();
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
      throw;
    }
  };
  job.failed = [this](const QString& sentence) { job_bar_->setMessage(sentence); };
  jobs_.run(std::move(job));
}

void MainWindow::openCampaign(const QString& folder) {
  const std::filesystem::path path = folder.toStdString();
  importInBackground(
      tr("Importing %1").arg(QDir(folder).dirName()), [path](JobContext&) { return path; }, QDir(folder).dirName());
}

void MainWindow::addCampaign(const QString& folder) {
  if (!session_.isOpen()) {
    tell(tr("Open a session first; a campaign is added to it."));
    return;
  }
  const std::filesystem::path session_folder = session_.folder();
  Job job;
  job.title = tr("Adding %1").arg(QDir(folder).dirName());
  job.work = [this, session_folder,
              source = std::filesystem::path(folder.toStdString())](JobContext& context) -> std::function<void()> {
    auto staged = std::make_shared<StagedCampaign>(session_folder, source, context);
    return [this, session_folder, staged] {
      if (session_.folder() != session_folder) return;  // another one was opened meanwhile
      try {
        const std::int64_t id = session_.session()->adoptCampaign(*staged);
        giveGoals(*session_.session(), id);
        // Whoever adds it goes on with it.
        const nlohmann::json name = session_.campaignSetting(option_keys::operator_name, nullptr);
        if (!name.is_null()) session_.setSetting(campaignKey(option_keys::operator_name, id), name);
        selectCampaign(id);
        refreshCampaigns();
      } catch (const InputError& e) {
        tell(coreSentence(e.what()));
      }
    };
  };
  job.failed = [this](const QString& sentence) { tell(sentence); };
  jobs_.run(std::move(job));
}

void MainWindow::openLog(const QString& file) {
  const std::filesystem::path csv = file.toStdString();
  auto place = std::make_shared<QTemporaryDir>();
  const std::filesystem::path folder = std::filesystem::path(place->path().toStdString()) / "campaign";
  importInBackground(
      tr("Importing %1").arg(QFileInfo(file).fileName()),
      [place, csv, folder](JobContext&) {
        writeLogCampaign(csv, folder);
        return folder;
      },
      QFileInfo(file).completeBaseName());
}

void MainWindow::open(const QString& folder) {
  const QFileInfo file(folder);
  if (file.isFile() && file.suffix() == QLatin1String("json")) {
    open(file.absolutePath());  // what a file manager gives for a session or a campaign
  } else if (Session::isSession(folder.toStdString())) {
    openSession(folder);
  } else if (file.isFile()) {
    openLog(folder);
  } else {
    openCampaign(folder);
  }
}

void MainWindow::startDemo(const QString& name, bool small) {
  auto place = std::make_shared<QTemporaryDir>();
  const std::filesystem::path folder = std::filesystem::path(place->path().toStdString()) / "campaign";
  QString title = name;
  for (const Demo& demo : demos())
    if (demo.name == name.toStdString()) title = demo.title;
  importInBackground(
      tr("Running the virtual machine: %1").arg(title),
      [place, folder, small, demo = name.toStdString()](JobContext& job) {
        makeDemoCampaign(demo, folder, small, job);
        return folder;
      },
      QStringLiteral("demo_") + name);
}

void MainWindow::closeSession() {
  finishRecording();
  session_.close();
  page_ = nullptr;
  arrival_ = Arrival::Done;
  showSessionOrWelcome();
}

void MainWindow::setTheme(ThemeKind kind) {
  Preferences chosen = preferences();
  chosen.look = kind == ThemeKind::Dark ? Preferences::Look::Dark : Preferences::Look::Light;
  setPreferences(chosen);
  applyLook(kind);
}

void MainWindow::applyLook(ThemeKind kind) {
  if (kind == theme().kind) return;
  applyTheme(*static_cast<QApplication*>(QCoreApplication::instance()), kind);
  refreshPage();
}

void MainWindow::followPreferences() {
  PreferencesNotifier::instance().readAgain();
  setShownUnits(PreferencesNotifier::instance().now().units);
  connect(&PreferencesNotifier::instance(), &PreferencesNotifier::changed, this,
          [this](const Preferences& before, const Preferences& now) {
            if (now.look != before.look) applyLook(wantedTheme());
            setShownUnits(now.units);
            if (now.units != before.units)
              for (QWidget* shown : findChildren<QWidget*>()) shown->update();
            if (now.length_decimals != before.length_decimals || now.units != before.units) refreshPage();
          });
  connect(&SystemLook::instance(), &SystemLook::changed, this, [this] { applyLook(wantedTheme()); });
}

void MainWindow::openPreferences() {
  if (findChild<PreferencesDialog*>() == nullptr) (new PreferencesDialog(this))->open();
}

void MainWindow::exportTo(const QString& folder) {
  if (page_ == nullptr) {
    job_bar_->setMessage(tr("Open a session first; then its pictures and tables can be exported."));
    return;
  }
  std::vector<Exportable> items = currentPage()->exportables();
  if (items.empty()) {
    job_bar_->setMessage(tr("This page has nothing to export yet."));
    return;
  }
  auto* dialog = new ExportDialog(std::move(items), folder, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

void MainWindow::newMeasurement() {
  const auto campaign = session_.campaign();
  NewMeasurementDialog dialog(campaign == nullptr ? std::nullopt : std::optional(campaign->machine.source), this);
  if (dialog.exec() == QDialog::Accepted && maySessionBeLeft()) startMeasurement(dialog.machine());
}

void MainWindow::startMeasurement(const nlohmann::json& machine) {
  try {
    const MachineDescription description =
        MachineDescription::parse(JsonNode::parse(machine.dump(), "machine.json"), "machine.json");
    auto session =
        std::make_unique<Session>(Session::create(newSessionFolder(QString::fromStdString(description.name))));
    const std::int64_t id = session->newCampaign(description.name, utcNow(), description.source.dump(1));
    giveGoals(*session, id);
    const QString folder = QString::fromStdString(session->folder().string());
    finishRecording();
    session_.adopt(std::move(session), id);
    remember(folder);
    workflow_.goTo(StepId::Machine);
    showStep();
  } catch (const InputError& e) {
    job_bar_->setMessage(coreSentence(e.what()));
  }
}

namespace {

constexpr auto borders_key = "bordersKey";

/// The borders of a page by what they separate when the page is new: the order of the splitters is not always the same,
/// and a border between two other areas, or of another direction, must not be taken for it.
QString splitterKey(const Page& page, const QSplitter& splitter) {
  QStringList areas;
  for (int i = 0; i < splitter.count(); ++i) {
    QStringList titles;
    for (const QLabel* label : splitter.widget(i)->findChildren<QLabel*>()) {
      if (label->property("role") == QStringLiteral("sectionTitle")) titles << label->text();
    }
    areas << titles.join(QLatin1Char('+'));
  }
  return QStringLiteral("borders/%1/%2-%3")
      .arg(QString::fromLatin1(page.metaObject()->className()).section(QLatin1Char(':'), -1),
           splitter.orientation() == Qt::Horizontal ? QStringLiteral("h") : QStringLiteral("v"),
           QString::fromLatin1(QCryptographicHash::hash(areas.join(QLatin1Char('|')).toUtf8(), QCryptographicHash::Md5)
                                   .toHex()
                                   .left(12)));
}

}  // namespace

void MainWindow::restoreSplitters(Page& page) {
  const QSettings settings;
  for (QSplitter* splitter : page.findChildren<QSplitter*>()) {
    const QString key = splitterKey(page, *splitter);
    splitter->setProperty(borders_key, key);
    QList<int> sizes;
    for (const QVariant& size : settings.value(key).toList()) sizes << size.toInt();
    if (!sizes.isEmpty() && sizes.size() == splitter->count()) splitter->setSizes(sizes);
  }
}

namespace {

QString stillRunning(const QString& job) {
  return MainWindow::tr(
             "\"%1\" is still running and will be cancelled; everything that was captured and every result "
             "that is done is kept.")
      .arg(job);
}

}  // namespace

QStringList MainWindow::lostWithSession() {
  QStringList lost;
  if (const QString pictures = IncomingService::of(session_).finishPictures(); !pictures.isEmpty()) lost << pictures;
  if (const QString work = jobs_.firstOf(JobQueue::Work); !work.isEmpty()) lost << stillRunning(work);
  return lost;
}

bool MainWindow::maySessionBeLeft() {
  if (!session_.isOpen()) return true;
  const QStringList lost = lostWithSession();
  return lost.isEmpty() || goAhead({tr("Another session"), lost.join(QLatin1Char('\n')), tr("Leave this session"),
                                    &Preferences::ask_before_quitting},
                                   this);
}

void MainWindow::askAndOpen(const QString& folder) {
  if (maySessionBeLeft()) open(folder);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QStringList lost = lostWithSession();
  if (ClosedLoopService::of(session_).running())
    lost.prepend(
        tr("A machine is being compensated. Quitting fades its compensation to zero and ends the loop; what was "
           "measured is kept."));
  if (!lost.isEmpty() &&
      !goAhead({tr("Quit"), lost.join(QLatin1Char('\n')), tr("Quit"), &Preferences::ask_before_quitting}, this)) {
    event->ignore();
    return;
  }
  for (const auto& [entry, page] : pages_) {
    if (page == nullptr) continue;
    for (const QSplitter* splitter : page->findChildren<QSplitter*>()) {
      const QString key = splitter->property(borders_key).toString();
      // Below one another for want of width: these are heights.
      if (key.contains(QStringLiteral("/h-")) != (splitter->orientation() == Qt::Horizontal)) continue;
      QVariantList sizes;
      for (const int size : splitter->sizes()) sizes << size;
      // What was never shown has no sizes that anybody chose.
      if (!sizes.isEmpty() && !sizes.contains(QVariant(0))) QSettings().setValue(key, sizes);
    }
  }
  QSettings().setValue(QStringLiteral("window"), saveGeometry());
  jobs_.cancelAll();
  finishRecording();
  event->accept();
}

}  // namespace spindrift::gui
