// SPDX-License-Identifier: GPL-3.0-or-later
// The one window: steps at the left, the page in the middle, the job bar at the bottom, menu and switches at the top.
#pragma once

#include <QMainWindow>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "widgets/jobs/job_runner.h"
#include "widgets/models/session_model.h"
#include "widgets/pages/page.h"
#include "widgets/workflow/workflow.h"

class QAction;
class QComboBox;
class QLabel;
class QMenu;
class QPrinter;
class QPushButton;
class QStackedWidget;
class QToolButton;

namespace spindrift {
struct Exercise;
}

namespace spindrift::gui {

class ActivityDialog;
class ArtefactDesigner;
class ExerciseDialog;
class HelpPanel;
class JobBar;
class NotesDialog;
class PageStack;
class ClosedLoopPage;
class PlantPage;
class StepList;
class WelcomePage;
class WhatIfWindow;
class WindowDraft;
class Badge;
struct Command;

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  // What the menu does, without dialogs (the command line, the tour and the tests use these).
  void openSession(const QString& folder);
  /// Makes a new session in the user's folder and imports the campaign (in the background).
  void openCampaign(const QString& folder);
  /// Copies a campaign into the session that is open (in the background) and shows it; the others stay.
  void addCampaign(const QString& folder);
  /// Shows another campaign of the session once it has been read (in the background); until then the one at hand stays.
  /// That one: what is being read is not wanted any more.
  void selectCampaign(std::int64_t id);
  void openLog(const QString& file);  ///< a CSV with columns over time becomes a campaign of its own
  /// Opens a folder of either kind.
  void open(const QString& folder);
  void startDemo(const QString& name, bool small = false);
  void closeSession();
  void setTheme(ThemeKind kind);
  void exportTo(const QString& folder);  ///< opens the export dialog with this folder

  [[nodiscard]] SessionModel& session() { return session_; }
  [[nodiscard]] JobRunner& jobs() { return jobs_; }
  [[nodiscard]] QUndoStack& undoStack() { return undo_.stack(); }
  [[nodiscard]] Workflow& workflow() { return workflow_; }
  /// The page of the step at hand, complete; null without a campaign.
  [[nodiscard]] Page* currentPage();
  /// True until the page of the step at hand stands there complete.
  [[nodiscard]] bool arriving() const { return arrival_ != Arrival::Done; }
  [[nodiscard]] WelcomePage* welcome() const { return welcome_; }
  [[nodiscard]] StepList* stepList() const { return steps_; }
  [[nodiscard]] JobBar* jobBar() const { return job_bar_; }
  [[nodiscard]] QPushButton* nextButton() const { return next_; }
  [[nodiscard]] QPushButton* backButton() const { return back_; }
  /// Pressed by Ctrl+Return: Next where it is what to do next, else the button that runs the page; null: there is none.
  [[nodiscard]] QPushButton* dueButton();
  [[nodiscard]] bool welcomeShown() const;
  [[nodiscard]] HelpPanel* help() const { return help_; }
  [[nodiscard]] QAction* helpAction() const { return help_action_; }
  void saveLog(const QString& file);  ///< what `diagnosticsText` says, by a file
  /// A new session with an empty campaign of this machine (machine.json), at the step Machine.
  void startMeasurement(const nlohmann::json& machine);
  NotesDialog* openNotes();  ///< null if nothing is open
  void openManual(const QString& file);
  /// The manual in the language of the window: set by a job the first time.
  void openTranslatedManual();
  void openEffects();  ///< the list of effects of the step Discrepancy
  /// Runs every result of the campaign that does not hold any more, and says what stays outdated.
  void runOutdated();
  void openPlant();  ///< many machines; works without a session
  [[nodiscard]] PlantPage* plant() const { return plant_; }
  void openLiveCompensation();  ///< the closed loop at the control; works without a session
  [[nodiscard]] ClosedLoopPage* liveCompensation() const { return live_compensation_; }
  /// Errors set by hand on the machine of the campaign at hand, or on a standard one.
  WhatIfWindow* openWhatIf();
  ArtefactDesigner* openDesigner();
  ExerciseDialog* openExercise();  ///< stays open beside the work
  /// Makes the campaign of an exercise and opens it as a session of its own.
  void startExercise(const Exercise& exercise);
  ActivityDialog* openActivity();  ///< jobs and messages; stays open beside the work
  /// Everything that could be asked for now, and what cannot, with the reason.
  [[nodiscard]] std::vector<Command> commands();
  void openPreferences();
  void findCommand();  ///< opens the list of commands
  /// Files and folders that were dropped: opened, or taken into the campaign as captures; else one sentence says why
  /// not.
  void take(const QStringList& files);
  /// The campaign of a demo as plain files in a new folder inside `folder` (in the background).
  void writeSample(const std::string& demo, const QString& folder);
  void showNews();
  /// After an update, and only once.
  void showNewsIfDue();
  /// What the page at hand shows, in the light theme. Throws InputError.
  void printPage(QPrinter& printer);
  /// The report of the campaign as the page Report has it. Throws InputError.
  void printReportOn(QPrinter& printer);
  void showHelpOn(StepId step);  ///< beside the page, or in a window of its own where no page is shown

 protected:
  void closeEvent(QCloseEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void buildMenu();
  /// The action is for what is there only: `why_not` says what is missing, empty: nothing.
  void need(QAction* action, std::function<QString()> why_not);
  [[nodiscard]] QString whyNot(const QAction* action) const;
  /// The step and the tabs that are shown now, for what is done there.
  [[nodiscard]] UndoPlace undoPlace();
  /// The window that keeps its draft (WindowDraft) of this name for the campaign at hand: the one that is open, or a
  /// new one, which closes when another campaign is chosen.
  template <class Window>
  Window* openBeside(const std::string& name, const std::function<Window*(WindowDraft)>& make);
  void addCommandsOf(const QMenu& menu, const QString& where, std::vector<Command>& commands);
  [[nodiscard]] static QStringList recentSessions();
  void fillRecentMenu();
  [[nodiscard]] std::filesystem::path reportFile();  ///< as PDF; empty: none was written
  void addSampleMenu(QMenu* menu);
  /// Asks before anything is lost with the session that is open (another is to be opened, or none): work that runs,
  /// pictures that cannot be stored. True: go ahead.
  [[nodiscard]] bool maySessionBeLeft();
  /// What would be lost, one sentence each; empty: nothing.
  [[nodiscard]] QStringList lostWithSession();
  void askAndOpen(const QString& folder);
  /// Asks for a printer and prints with `print`.
  void askAndPrint(const std::function<void(QPrinter&)>& print);
  void showStep();
  /// The one button to press next: that which runs the step, or Next where nothing is left to be done.
  void offerNext();
  void offerNextSoon();
  /// Presses what is to be pressed next, until the report is written or a step needs its user.
  void runAllSteps();
  void goOnRunning();
  /// Why there is nothing outdated that could be run; empty: there is.
  [[nodiscard]] QString nothingOutdated();
  void arrive();
  void arriveSoon();
  void refreshTitle();
  void showSessionOrWelcome();
  void refreshPage();
  void refreshCampaigns();
  void remember(const QString& folder);
  void newMeasurement();
  void showHelp();
  /// Look, numbers and goals as the user and the system want them, now and when that changes.
  void followPreferences();
  void applyLook(ThemeKind kind);
  [[nodiscard]] QString askForCampaign(const QString& title);
  void restoreSplitters(Page& page);
  void tell(const QString& sentence);
  void about();
  void verifyFiles();
  void watchConnections();
  void showConnections();
  void finishRecording();
  void importInBackground(const QString& title, std::function<std::filesystem::path(JobContext&)> source,
                          const QString& name);

  SessionModel session_;
  JobRunner jobs_;
  CampaignUndo undo_{session_};
  Workflow workflow_;
  PageRegistry registry_;
  std::map<const PageRegistry::Entry*, Page*> pages_;
  Page* page_ = nullptr;
  /// What is still to be done until the page at hand stands there complete: one thing a turn of the event loop, so that
  /// none is long.
  enum class Arrival { Done, Place, Fill } arrival_ = Arrival::Done;
  bool refresh_queued_ = false;
  bool offer_queued_ = false;
  bool running_all_ = false;
  std::optional<StepId> run_last_;  ///< of all steps that are run

  QStackedWidget* stack_;
  WelcomePage* welcome_;
  PlantPage* plant_;
  ClosedLoopPage* live_compensation_;
  QWidget* work_;
  PageStack* page_stack_;
  StepList* steps_;
  JobBar* job_bar_;
  ActivityDialog* activity_ = nullptr;
  ExerciseDialog* exercise_ = nullptr;
  QLabel* session_name_;
  QComboBox* campaign_;
  QToolButton* theme_button_;
  HelpPanel* help_;
  QAction* help_action_ = nullptr;
  QAction* palette_action_ = nullptr;
  QMenu* recent_menu_ = nullptr;
  std::map<const QAction*, std::function<QString()>> needs_;
  QPushButton* next_;
  QPushButton* back_;
  std::int64_t shown_visit_ = -1;  ///< of the campaign that the window went to last
  int reading_ = 0;                ///< the job that reads a campaign
};

}  // namespace spindrift::gui
