// SPDX-License-Identifier: GPL-3.0-or-later
// Menu and switches of the window, and the small dialogs behind them.
#include <QAction>
#include <QClipboard>
#include <QFileDialog>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QToolButton>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/reporting/report_language.h"
#include "core/workflows/manual.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/common/preferences.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/panels/scanning/artefact_designer.h"
#include "widgets/shell/diagnostics.h"
#include "widgets/shell/help_panel.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/manual_window.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/welcome_page.h"
#include "widgets/teaching/exercise_dialog.h"
#include "widgets/teaching/what_if_window.h"
#include "widgets/theme/icons.h"

namespace spindrift::gui {

void MainWindow::openManual(const QString& file) {
  if (file.isEmpty()) {
    tell(tr("The manual is not installed; \"spindrift-cli manual --out manual.pdf\" writes it."));
    return;
  }
  auto* manual = new ManualWindow(file, this);
  manual->setAttribute(Qt::WA_DeleteOnClose);
  manual->show();
}

void MainWindow::openTranslatedManual() {
  if (const QString brought = manualFile(currentLanguage()); !brought.isEmpty()) {
    openManual(brought);
    return;
  }
  Job job;
  job.title = tr("Setting the manual");
  job.queue = JobQueue::Reading;
  job.work = [this, file = translatedManualFile()](JobContext& context) -> std::function<void()> {
    writeTranslatedManual(file, context);
    return [this, file] { openManual(file); };
  };
  job.failed = [this](const QString& sentence) { tell(sentence); };
  jobs().run(std::move(job));
}

void MainWindow::buildMenu() {
  const auto add = [this](QMenu* menu, const QString& text, const char* icon_name, const QKeySequence& keys,
                          auto&& what) {
    QAction* action = menu->addAction(icon(icon_name), text);
    action->setShortcut(keys);
    connect(action, &QAction::triggered, this, what);
    return action;
  };
  const auto no_session = [this] { return session_.campaign() == nullptr ? tr("Open a session first.") : QString(); };
  QMenu* session_menu = menuBar()->addMenu(tr("&Session"));
  add(session_menu, tr("&New measurement …"), "plus", QKeySequence::New, [this] { newMeasurement(); });
  add(session_menu, tr("&Open session …"), "folder-open", QKeySequence::Open,
      [this] { Q_EMIT welcome_->openSession(); });
  add(session_menu, tr("Open &campaign folder …"), "folder-open", QKeySequence(tr("Ctrl+Shift+O")),
      [this] { Q_EMIT welcome_->openCampaign(); });
  need(add(session_menu, tr("&Add a campaign to this session …"), "plus", QKeySequence(tr("Ctrl+Shift+A")),
           [this] {
             const QString folder = askForCampaign(tr("Choose the campaign folder to be added"));
             if (!folder.isEmpty()) addCampaign(folder);
           }),
       [this] { return session_.isOpen() ? QString() : tr("Open a session first."); });
  add(session_menu, tr("Open &log …"), "folder-open", QKeySequence(tr("Ctrl+L")), [this] {
    const QString kind = QStringLiteral("log");
    const QString file =
        QFileDialog::getOpenFileName(this, tr("Open a log over time"), lastFolder(kind), tr("Log (*.csv)"));
    if (file.isEmpty()) return;
    rememberFolder(kind, file);
    if (maySessionBeLeft()) openLog(file);
  });
  recent_menu_ = session_menu->addMenu(icon("clock"), tr("&Recent sessions"));
  connect(session_menu, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
  addSampleMenu(session_menu->addMenu(icon("play"), tr("Sample &data")));
  session_menu->addSeparator();
  need(add(session_menu, tr("&Export …"), "export", QKeySequence(tr("Ctrl+E")),
           [this] {
             exportTo(lastFolder(QStringLiteral("export"),
                                 QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation)));
           }),
       [this, no_session] {
         if (page_ == nullptr) return no_session();
         return page_->exportables().empty() ? tr("This page has nothing to export yet.") : QString();
       });
  need(add(session_menu, tr("&Print this page …"), "report", QKeySequence::Print,
           [this] { askAndPrint([this](QPrinter& printer) { printPage(printer); }); }),
       no_session);
  need(add(session_menu, tr("Print the repor&t …"), "report", {},
           [this] { askAndPrint([this](QPrinter& printer) { printReportOn(printer); }); }),
       [this, no_session] {
         if (session_.campaign() == nullptr) return no_session();
         return reportFile().empty() ? tr("The report has not been written yet; the page Report does.") : QString();
       });
  session_menu->addSeparator();
  add(session_menu, tr("First &screen"), "home", QKeySequence(tr("Ctrl+H")), [this] {
    if (maySessionBeLeft()) closeSession();
  });
  add(session_menu, tr("&Quit"), "x", QKeySequence::Quit, [this] { close(); });

  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  undo_.setPlace([this] { return undoPlace(); });
  QAction* undo = add(edit, tr("&Undo"), "undo", QKeySequence::Undo, [this] { undo_.undo(); });
  need(undo, [this] { return undo_.stack().canUndo() ? QString() : tr("There is nothing to undo."); });
  QAction* redo = add(edit, tr("&Redo"), "redo", {}, [this] { undo_.redo(); });
  // Of the platform, and the other one that hands know.
  redo->setShortcuts({QKeySequence(QKeySequence::Redo), QKeySequence(Qt::CTRL | Qt::Key_Y)});
  need(redo, [this] { return undo_.stack().canRedo() ? QString() : tr("There is nothing to redo."); });
  edit->addSeparator();
  need(add(edit, tr("&Notes …"), "note", QKeySequence(tr("Ctrl+M")), [this] { openNotes(); }), no_session);
  add(edit, tr("&Preferences …"), "settings", QKeySequence(tr("Ctrl+,")), [this] { openPreferences(); });
  add(edit, tr("&Jobs and messages …"), "in-progress", QKeySequence(tr("Ctrl+J")), [this] { openActivity(); });

  QMenu* go = menuBar()->addMenu(tr("&Go"));
  palette_action_ = add(go, tr("&Find a command …"), "menu", QKeySequence(tr("Ctrl+K")), [this] { findCommand(); });
  go->addSeparator();
  const auto end_of_steps = [this, no_session](bool can, const QString& why) {
    const QString first = no_session();
    return first.isEmpty() && !can ? why : first;
  };
  need(add(go, tr("&Back"), "chevron-left", QKeySequence(tr("Alt+Left")), [this] { workflow_.back(); }),
       [this, end_of_steps] { return end_of_steps(workflow_.canGoBack(), tr("This is the first step.")); });
  need(add(go, tr("&Next"), "chevron-right", QKeySequence(tr("Alt+Right")), [this] { workflow_.next(); }),
       [this, end_of_steps] { return end_of_steps(workflow_.canGoNext(), tr("This is the last step.")); });
  go->addSeparator();
  int number = 1;
  for (const StepId step : all_steps) {
    need(add(go, stepTitle(step), stepIcon(step), QKeySequence(QStringLiteral("Ctrl+%1").arg(number++)),
             [this, step] {
               workflow_.goTo(step);
               showSessionOrWelcome();
             }),
         no_session);
  }
  go->addSeparator();
  add(go, tr("&Plant"), "machine", QKeySequence(tr("Ctrl+Shift+P")), [this] { openPlant(); });
  add(go, tr("&Compensate: live"), "compensate", QKeySequence(tr("Ctrl+Shift+L")), [this] { openLiveCompensation(); });
  need(add(go, tr("&Run the step, or go on"), "play", QKeySequence(tr("Ctrl+Return")),
           [this] {
             if (QPushButton* button = dueButton()) button->click();
           }),
       [this, no_session] {
         if (page_ == nullptr) return no_session();
         const QPushButton* button = dueButton();
         if (button == nullptr) return tr("This page has nothing to run.");
         if (button->isEnabled()) return QString();
         return button->toolTip().isEmpty() ? tr("Something that it needs is missing on the page.") : button->toolTip();
       });

  QAction* all_steps_action =
      add(go, tr("Run &all steps"), "play", QKeySequence(tr("Ctrl+Shift+Return")), [this] { runAllSteps(); });
  need(all_steps_action, no_session);
  QAction* outdated_action =
      add(go, tr("Run what is &outdated"), "outdated", QKeySequence(tr("Ctrl+Shift+R")), [this] { runOutdated(); });
  need(outdated_action, [this] { return nothingOutdated(); });
  steps_->addActions({all_steps_action, outdated_action});
  steps_->setContextMenuPolicy(Qt::ActionsContextMenu);

  QMenu* view = menuBar()->addMenu(tr("&View"));
  add(view, tr("&Light or dark"), "moon", QKeySequence(tr("Ctrl+D")),
      [this] { setTheme(theme().kind == ThemeKind::Dark ? ThemeKind::Light : ThemeKind::Dark); });
  QMenu* tools = menuBar()->addMenu(tr("&Tools"));
  add(tools, tr("&Artefact designer …"), "scan", QKeySequence(tr("Ctrl+Shift+D")), [this] { openDesigner(); });
  need(add(tools, tr("&Effects of this machine …"), "table", QKeySequence(tr("Ctrl+Shift+E")),
           [this] { openEffects(); }),
       no_session);
  QMenu* help = menuBar()->addMenu(tr("&Help"));
  help_action_ = add(help, tr("Help &beside the step"), "help", QKeySequence(Qt::Key_F1), [this] {
    QSettings().setValue(QStringLiteral("help"), help_action_->isChecked());
    showHelp();
  });
  help_action_->setCheckable(true);
  help_action_->setChecked(QSettings().value(QStringLiteral("help"), false).toBool());
  const bool translated = offeredReportLanguage() && !manualChapters(offeredReportLanguage()->code).empty();
  add(help, tr("&Manual …"), "note", QKeySequence(Qt::SHIFT | Qt::Key_F1),
      [this, translated] { translated ? openTranslatedManual() : openManual(manualFile(QStringLiteral("en"))); });
  if (translated)
    add(help, tr("Manual in En&glish …"), "note", {}, [this] { openManual(manualFile(QStringLiteral("en"))); });
  add(help, tr("What's &new …"), "info", {}, [this] { showNews(); });
  help->addSeparator();
  add(help, tr("&What if …"), "model", QKeySequence(tr("Ctrl+Shift+W")), [this] { openWhatIf(); });
  add(help, tr("&Exercise: find the missing effect …"), "target", QKeySequence(tr("Ctrl+Shift+X")),
      [this] { openExercise(); });
  help->addSeparator();
  add(help, tr("&Copy diagnostics"), "table", {}, [this] {
    QGuiApplication::clipboard()->setText(diagnosticsText());
    tell(tr("Version, platform and the last messages are in the clipboard; folders and names are left out."));
  });
  add(help, tr("&Save the log …"), "export", {}, [this] {
    const QString file =
        QFileDialog::getSaveFileName(this, tr("Save the log"), QStringLiteral("spindrift-log.txt"), tr("Text (*.txt)"));
    if (!file.isEmpty()) saveLog(file);
  });
  help->addSeparator();
  add(help, tr("&About Spindrift"), "info", {}, [this] { about(); });

  auto* corner = new QWidget;
  auto* line = new QHBoxLayout(corner);
  line->setContentsMargins(0, 0, 8, 0);
  line->setSpacing(4);
  const auto tool = [&](const char* icon_name, const QString& name, auto&& what) {
    auto* button = new QToolButton;
    button->setIcon(icon(icon_name));
    button->setIconSize({sizes::icon, sizes::icon});
    button->setToolTip(name);
    button->setAccessibleName(name);
    connect(button, &QToolButton::clicked, this, what);
    line->addWidget(button);
    return button;
  };
  auto* undo_button = tool("undo", tr("Undo"), [this] { undo_.undo(); });
  auto* redo_button = tool("redo", tr("Redo"), [this] { undo_.redo(); });
  const auto say_what = [this, undo, redo, undo_button, redo_button] {
    undo->setEnabled(undo_.stack().canUndo());
    redo->setEnabled(undo_.stack().canRedo());
    undo_button->setEnabled(undo->isEnabled());
    redo_button->setEnabled(redo->isEnabled());
    undo->setText((tr("&Undo") + QLatin1Char(' ') + undo_.undoText()).trimmed());
    redo->setText((tr("&Redo") + QLatin1Char(' ') + undo_.redoText()).trimmed());
    undo_button->setToolTip(undo->isEnabled() ? tr("Undo: %1").arg(undo_.undoText()) : tr("Undo"));
    redo_button->setToolTip(redo->isEnabled() ? tr("Redo: %1").arg(undo_.redoText()) : tr("Redo"));
  };
  say_what();
  connect(&undo_.group(), &QUndoGroup::indexChanged, this, say_what);
  connect(&undo_.group(), &QUndoGroup::activeStackChanged, this, say_what);
  tool("export", tr("Export pictures and tables of this page"), [this] {
    exportTo(lastFolder(QStringLiteral("export"), QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation)));
  });
  theme_button_ = tool(theme().kind == ThemeKind::Dark ? "sun" : "moon", tr("Light or dark"),
                       [this] { setTheme(theme().kind == ThemeKind::Dark ? ThemeKind::Light : ThemeKind::Dark); });
  menuBar()->setCornerWidget(corner);
}

void MainWindow::about() {
  QMessageBox::about(this, tr("About Spindrift"),
                     tr("<h3>Spindrift %1</h3><p>Thermal errors of machine tools: measure, understand, compensate.</p>"
                        "<p>GPL-3.0-or-later; the core library Apache-2.0.</p>")
                         .arg(QStringLiteral(SPINDRIFT_VERSION)));
}

void MainWindow::showHelp() {
  help_->setVisible(help_action_->isChecked());
  if (help_action_->isChecked()) help_->showStep(workflow_.current());
}

void MainWindow::saveLog(const QString& file) {
  try {
    writeFileAtomically(file.toStdString(), diagnosticsText().toStdString());
    tell(tr("The log was saved as %1. Folders and names are left out of it.").arg(file));
  } catch (const InputError& e) {
    tell(coreSentence(e.what()));
  }
}

void MainWindow::openEffects() {
  if (session_.campaign() == nullptr) {
    tell(tr("Open a session first; which effects there can be depends on its machine."));
    return;
  }
  workflow_.goTo(StepId::Discrepancy);
  if (auto* page = qobject_cast<DiscrepancyPage*>(currentPage())) page->showEffects(true);
}

template <class Window>
Window* MainWindow::openBeside(const std::string& name, const std::function<Window*(WindowDraft)>& make) {
  for (auto* window : findChildren<Window*>(Qt::FindDirectChildrenOnly)) {
    if (!window->isVisible() || !window->draft().atHand()) continue;
    window->raise();
    window->activateWindow();
    return window;
  }
  Window* window = make(WindowDraft(session_, name));
  window->setAttribute(Qt::WA_DeleteOnClose);
  connect(&session_, &SessionModel::campaignChanged, window, [window] {
    if (window->draft().ofCampaign() && !window->draft().atHand()) window->close();
  });
  window->show();
  return window;
}

WhatIfWindow* MainWindow::openWhatIf() {
  const auto campaign = session_.campaign();
  const MachineDescription machine = campaign != nullptr ? campaign->machine : standardMachine();
  for (auto* open : findChildren<WhatIfWindow*>(Qt::FindDirectChildrenOnly))
    if (open->draft().atHand() && open->model().machine().source != machine.source) open->close();  // it was edited
  return openBeside<WhatIfWindow>("what-if",
                                  [&](WindowDraft draft) { return new WhatIfWindow(machine, std::move(draft), this); });
}

ArtefactDesigner* MainWindow::openDesigner() {
  return openBeside<ArtefactDesigner>(
      "artefact-designer", [this](WindowDraft draft) { return new ArtefactDesigner(std::move(draft), this); });
}

ExerciseDialog* MainWindow::openExercise() {
  if (exercise_ == nullptr) {
    exercise_ = new ExerciseDialog(session_, jobs_, this);
    connect(exercise_, &ExerciseDialog::startWanted, this, [this](const Exercise& exercise) {
      if (maySessionBeLeft()) startExercise(exercise);
    });
    connect(exercise_, &ExerciseDialog::searchWanted, this, [this] {
      workflow_.goTo(StepId::Discrepancy);
      showSessionOrWelcome();
    });
  }
  exercise_->show();
  exercise_->raise();
  return exercise_;
}

void MainWindow::startExercise(const Exercise& exercise) {
  auto place = std::make_shared<QTemporaryDir>();
  const std::filesystem::path folder = std::filesystem::path(place->path().toStdString()) / "campaign";
  importInBackground(
      tr("Running the virtual machine: exercise %1").arg(exercise.seed),
      [place, folder, exercise](JobContext& job) {
        writeExercise(exercise, folder, job);
        return folder;
      },
      QStringLiteral("exercise_%1_%2")
          .arg(exercise.seed)
          .arg(QString::fromStdString(std::string(toString(exercise.level)))));
}

UndoPlace MainWindow::undoPlace() {
  const StepId step = workflow_.current();
  std::vector<std::pair<QPointer<QTabWidget>, QPointer<QWidget>>> shown;
  if (page_ != nullptr)
    for (auto* tabs : page_->findChildren<QTabWidget*>()) shown.emplace_back(tabs, tabs->currentWidget());
  return {stepTitle(step), [this, step, shown] {
            workflow_.goTo(step);
            showSessionOrWelcome();
            (void)currentPage();
            for (const auto& [tabs, tab] : shown)
              if (tabs && tab && tabs->isTabVisible(tabs->indexOf(tab))) tabs->setCurrentWidget(tab);
          }};
}

NotesDialog* MainWindow::openNotes() {
  if (session_.campaign() == nullptr) {
    tell(tr("Open a session first; notes belong to it."));
    return nullptr;
  }
  auto* dialog = new NotesDialog(session_, undo_, stepTitle(workflow_.current()),
                                 page_ != nullptr ? page_->pickedItem() : QString(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
  return dialog;
}

}  // namespace spindrift::gui
