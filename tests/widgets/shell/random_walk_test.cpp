// SPDX-License-Identifier: GPL-3.0-or-later
// A user who does anything in any order through the controls of the window, also while work goes on: after every
// stretch what is shown is what is stored and what the report tells, what is called current is what would come out now,
// and undoing everything gives the first state.
//
// SPINDRIFT_WALK_ACTIONS and SPINDRIFT_WALK_SEED of the environment walk longer or shorter and elsewhere.
#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTableView>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <cmath>
#include <map>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/machine/observation.h"
#include "core/reporting/report_parts.h"
#include "core/tasks/steps.h"
#include "core/tasks/task_options.h"
#include "core/workflows/compensation_workflow.h"
#include "tests/widgets/support/select_campaign.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/compensate/compensate_page.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/kinematics/nine_parameter_page.h"
#include "widgets/pages/machine/machine_page.h"
#include "widgets/pages/report/report_page.h"
#include "widgets/pages/verify/verify_page.h"
#include "widgets/panels/discrepancy/effect_editor.h"
#include "widgets/panels/discrepancy/effects_panel.h"
#include "widgets/panels/discrepancy/noise_panel.h"
#include "widgets/panels/machine/artefact_editor.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {
namespace {

constexpr int actions_in_the_suite = 1000;
constexpr int between_looks = 10;

class RandomWalk : public StoryTest {
 protected:
  void SetUp() override {
    StoryTest::SetUp();
    // Whatever is asked is answered: a text is given, a question mostly with yes.
    answer_.setInterval(10);
    QObject::connect(&answer_, &QTimer::timeout, window_.get(), [this] {
      if (auto* text = qobject_cast<QInputDialog*>(QApplication::activeModalWidget())) {
        text->setTextValue(QStringLiteral("disturbed"));
        text->accept();
      } else if (auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        const bool yes = random_.index(3) > 0;
        for (QAbstractButton* button : question->buttons()) {
          if ((question->buttonRole(button) == QMessageBox::RejectRole) == yes) continue;
          button->click();
          break;
        }
      }
    });
    answer_.start();
  }

  SessionModel& session() { return window_->session(); }

  // Controls ---------------------------------------------------------------------------------------------------------
  template <class Control>
  std::vector<Control*> controls() {
    std::vector<Control*> all;
    for (auto* control : window_->currentPage()->findChildren<Control*>())
      if (control->isVisible() && control->isEnabled()) all.push_back(control);
    return all;
  }
  template <class Control>
  Control* anyOf(const std::vector<Control*>& all) {
    return all.empty() ? nullptr : all[random_.index(all.size())];
  }
  QAction* action(QKeySequence::StandardKey key) {
    for (QAction* action : window_->findChildren<QAction*>())
      if (action->shortcuts().contains(QKeySequence(key))) return action;
    return nullptr;
  }
  /// Presses a button of the page by its text, if it can be pressed.
  bool press(const char* text) {
    for (auto* button : controls<QPushButton>()) {
      if (!button->text().endsWith(QString::fromUtf8(text))) continue;
      button->click();
      return true;
    }
    return false;
  }
  static void type(QLineEdit* edit, const QString& text) {
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, text);
  }
  void go(StepId step) {
    QTest::mouseClick(window_->stepList()->button(step), Qt::LeftButton);
    (void)window_->currentPage();
  }
  [[nodiscard]] QString number() { return QString::number(1 + random_.index(90)); }

  // What a user does -------------------------------------------------------------------------------------------------
  /// Any box, number or check mark of the page.
  void fiddle() {
    switch (random_.index(4)) {
      case 0:
        if (auto* box = anyOf(controls<QComboBox>()); box != nullptr && !box->isEditable()) {
          box->setFocus();
          QTest::keyClick(box, random_.index(2) == 0 ? Qt::Key_Down : Qt::Key_Up);
          what_ = "choose " + box->accessibleName().toStdString();
        }
        break;
      case 1:
        if (auto* spin = anyOf(controls<QAbstractSpinBox>())) {
          spin->setFocus();
          QTest::keyClick(spin, random_.index(2) == 0 ? Qt::Key_Down : Qt::Key_Up);
          QTest::keyClick(spin, Qt::Key_Return);
          what_ = "turn " + spin->accessibleName().toStdString();
        }
        break;
      case 2:
        if (auto* check = anyOf(controls<QCheckBox>())) {
          check->click();
          what_ = "check " + check->text().toStdString();
        }
        break;
      default:
        if (auto* tabs = anyOf(controls<QTabWidget>())) {
          const int tab = static_cast<int>(random_.index(static_cast<std::size_t>(tabs->count())));
          // What is connected is another test's.
          if (tabs->isTabVisible(tab) && tabs->objectName() != QLatin1String("machineTabs")) tabs->setCurrentIndex(tab);
          what_ = "look at a tab";
        }
    }
  }

  void editMachine() {
    go(StepId::Machine);
    auto* page = this->page<MachinePage>();
    auto* tabs = page->findChild<QTabWidget*>(QStringLiteral("machineTabs"));
    const std::size_t what = random_.index(10);
    tabs->setCurrentIndex(what < 6 ? 0 : what < 8 ? 1 : 2);
    what_ = "machine: ";
    QTableWidget* points = nullptr;
    for (auto* table : page->findChildren<QTableWidget*>())
      if (table->accessibleName() == QLatin1String("Measuring points")) points = table;
    switch (what) {
      case 0: {
        for (QLineEdit* line : controls<QLineEdit>())
          if (line->accessibleName() == QLatin1String("Name of the machine"))
            type(line, QStringLiteral("mill ") + number());
        what_ += "name";
        break;
      }
      case 1:
        if (points->rowCount() > 6) {
          points->item(points->rowCount() - 1, 2)->setText(number());
          what_ += "coordinate";
        }
        break;
      case 2:
        (void)press("Add point");
        what_ += "add point";
        break;
      case 3:
        if (points->rowCount() > 6) points->setCurrentCell(points->rowCount() - 1, 0);
        if (points->rowCount() > 6) (void)press("Remove point");
        what_ += "remove point";
        break;
      case 4:
        (void)press(random_.index(3) == 0 ? "Back to machine.json" : "Apply changes");
        what_ += "apply or back";
        break;
      case 5:
        (void)press(random_.index(2) == 0 ? "Discard" : "Show it");
        what_ += "discard or show";
        break;
      case 6: {
        constexpr std::array buttons{"Hole bar", "Balls", "Add stylus", "Remove stylus", "Remove"};
        const char* text = buttons[random_.index(buttons.size())];
        if (std::string_view(text) == "Remove stylus" && page->artefacts()->styli()->rowCount() > 0)
          page->artefacts()->styli()->setCurrentCell(0, 0);
        (void)press(text);
        what_ += text;
        break;
      }
      case 7:
        (void)press(random_.index(3) == 0 ? "Discard" : "Apply artefacts");
        what_ += "apply artefacts";
        break;
      default:
        (void)press(what == 8 ? "Confirm all" : "Apply changes");
        what_ += "roles";
    }
  }

  void note() {
    NotesDialog* dialog = window_->openNotes();
    const int rows = dialog->rows()->rowCount();
    if (rows > 0 && random_.index(2) == 0) {
      const int row = static_cast<int>(random_.index(static_cast<std::size_t>(rows)));
      dialog->findChild<QTableView*>()->setCurrentIndex(dialog->rows()->index(row, 0));
      dialog->removeButton()->click();
      what_ = "remove a note";
    } else {
      QTest::keyClicks(dialog->text(), QStringLiteral("note ") + number());
      dialog->addButton()->click();
      what_ = "add a note";
    }
    EXPECT_EQ(static_cast<std::size_t>(dialog->rows()->rowCount()), session().notes().size());
    dialog->close();
  }

  void leaveOut() {
    go(StepId::Discrepancy);
    auto* page = this->page<DiscrepancyPage>();
    what_ = "leave out";
    NoisePanel* noise = page->noise();
    if (page->story() != nullptr && noise != nullptr && noise->readingTable()->model()->rowCount() > 0) {
      page->tabs()->setCurrentWidget(noise);
      noise->showReadings(true);
      noise->readingTable()->selectRow(
          static_cast<int>(random_.index(static_cast<std::size_t>(noise->readingTable()->model()->rowCount()))));
      noise->excludeButton()->click();
      what_ += " in the list of readings";
      return;
    }
    // Readings that are no outliers are listed nowhere; captures are taken out like this.
    const QString item = QStringLiteral("M%1/P%2/EZ").arg(1 + random_.index(5)).arg(1 + random_.index(6));
    const bool out = session().excluded().contains(item);
    window_->undoStack().push(new ExcludeCommand(session(), {item}, out ? QString() : QStringLiteral("disturbed")));
  }

  void editEffect() {
    go(StepId::Discrepancy);
    auto* page = this->page<DiscrepancyPage>();
    page->showEffects(true);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !page->effects()->busy(); }, 5000));
    what_ = "effect: ";
    if (!page->effects()->editing()) {
      (void)press("New effect …");
      what_ += "new";
      return;
    }
    switch (random_.index(5)) {
      case 0:
      case 1:
        type(page->effects()->editor()->id(), QStringLiteral("own.effect") + number());
        break;
      case 2:
        type(page->effects()->editor()->expression(0, Component::EX), QStringLiteral("1e-3 * y"));
        break;
      case 3:
        (void)press("Cancel");
        break;
      default:
        EXPECT_TRUE(QTest::qWaitFor([&] { return !page->effects()->busy(); }, 5000));
        (void)press("Apply");
    }
    what_ += "edit";
  }

  /// To the first state of every campaign and back again.
  void undoEverything() {
    const std::int64_t at_hand = session().campaignId();
    for (const auto& [id, state] : first_) {
      wait();
      selectCampaign(session(), id);
      wait();
      const nlohmann::json before = stateOf(id);
      const int most = window_->undoStack().count();
      int undone = 0;
      for (; undone < most && action(QKeySequence::Undo)->isEnabled(); ++undone) action(QKeySequence::Undo)->trigger();
      wait();
      EXPECT_FALSE(action(QKeySequence::Undo)->isEnabled());
      const nlohmann::json now = stateOf(id);
      EXPECT_EQ(now, state) << nlohmann::json::diff(state, now).dump();
      for (; undone > 0 && action(QKeySequence::Redo)->isEnabled(); --undone) action(QKeySequence::Redo)->trigger();
      wait();
      const nlohmann::json after = stateOf(id);
      EXPECT_EQ(after, before) << nlohmann::json::diff(before, after).dump();
    }
    wait();
    selectCampaign(session(), at_hand);
    wait();
  }

  void reopen() {
    undoEverything();
    const QString folder = QString::fromStdString(session().folder().string());
    wait();
    window_->closeSession();
    window_->open(folder);
    wait();
    (void)window_->currentPage();
    ASSERT_NE(session().campaign(), nullptr);
    rememberFirst();
    what_ = "close and open again";
  }

  void act() {
    const std::size_t what = random_.index(100);
    what_ = "nothing";
    if (what < 22) {
      fiddle();
    } else if (what < 30) {
      editMachine();
    } else if (what < 36) {
      note();
    } else if (what < 42) {
      leaveOut();
    } else if (what < 46) {
      editEffect();
    } else if (what < 55) {  // the main button of a page, or what it offers
      static constexpr std::array steps{StepId::WarmUp, StepId::Model,      StepId::Model,      StepId::Model,
                                        StepId::Verify, StepId::Verify,     StepId::Compensate, StepId::Compensate,
                                        StepId::Report, StepId::Discrepancy};
      go(steps[random_.index(steps.size())]);
      QPushButton* button = window_->currentPage()->primaryButton();
      if (button != nullptr && button->isVisible() && button->isEnabled()) button->click();
      what_ = "press on " + stepTitle(window_->workflow().current()).toStdString();
      if (random_.index(6) == 0) {
        window_->runOutdated();
        what_ += ", run what is outdated";
      }
    } else if (what < 57) {
      go(StepId::Discrepancy);
      what_ = press(random_.index(2) == 0 ? "Add to the model" : "Remove from the model") ? "add or remove" : "look";
    } else if (what < 60) {
      go(StepId::WarmUp);
      what_ = press(random_.index(2) == 0 ? "The instrument was warm" : "Take the statement back") ? "warm" : "look";
    } else if (what < 62) {
      go(StepId::Model);
      what_ = press(random_.index(2) == 0 ? "Model over time" : "Model of a state") ? "switch the model" : "look";
    } else if (what < 65) {
      go(StepId::Report);
      QLineEdit* name = page<ReportPage>()->operatorName();
      type(name, QStringLiteral("Operator ") + number());
      QTest::keyClick(name, Qt::Key_Return);
      what_ = "operator";
    } else if (what < 77) {
      if (QAction* undo = action(QKeySequence::Undo); undo->isEnabled()) undo->trigger();
      what_ = "undo";
    } else if (what < 84) {
      if (QAction* redo = action(QKeySequence::Redo); redo->isEnabled()) redo->trigger();
      what_ = "redo";
    } else if (what < 88) {  // another campaign, in the middle of whatever goes on
      for (auto* box : window_->findChildren<QComboBox*>())
        if (box->accessibleName() == QLatin1String("Campaign") && box->isVisible()) {
          box->setFocus();
          QTest::keyClick(box, random_.index(2) == 0 ? Qt::Key_Down : Qt::Key_Up);
        }
      what_ = "campaign";
    } else if (what < 96) {
      go(all_steps[random_.index(all_steps.size())]);
      what_ = "go to " + stepTitle(window_->workflow().current()).toStdString();
    } else if (what < 97) {
      reopen();
    } else {  // let some of it happen
      QTest::qWait(static_cast<int>(random_.index(40)));
      what_ = "wait";
    }
    if (random_.index(3) == 0) QTest::qWait(1);
  }

  // What must hold ---------------------------------------------------------------------------------------------------
  /// Everything that undo is answerable for.
  nlohmann::json stateOf(std::int64_t campaign) {
    const Session& store = *session().session();
    nlohmann::json state = store.inputs(campaign);
    nlohmann::json reasons = nlohmann::json::array();
    for (const Exclusion& e : store.exclusions(campaign)) reasons.push_back(e.item + ": " + e.reason);
    state["reasons"] = reasons;
    nlohmann::json notes = nlohmann::json::array();
    for (const Note& n : store.notes(campaign)) notes.push_back({n.id, n.step, n.item, n.text, n.created_utc});
    state["notes"] = notes;
    for (const char* key :
         {option_keys::nine_parameters, option_keys::cycles, option_keys::scan_model, option_keys::thermal,
          option_keys::over_time, option_keys::discrepancy, option_keys::compensation, option_keys::verify,
          option_keys::report, option_keys::plan, option_keys::warm_statement, option_keys::simulator,
          option_keys::connections, option_keys::operator_name, "draft/machine", "draft/artefacts", "draft/effect"})
      state[key] = store.setting(campaignKey(key, campaign)).value_or(nlohmann::json());
    return state;
  }
  void rememberFirst() {
    for (const CampaignRecord& record : session().campaigns()) first_[record.id] = stateOf(record.id);
  }

  /// What is shown is what is stored.
  void checkShown() {
    Page* now = window_->currentPage();
    if (auto* page = qobject_cast<NineParameterPage*>(now); page != nullptr) {
      const StoredResult* stored = session().latest("fit");
      EXPECT_TRUE(page->fit() != nullptr || !session().state("fit").current);
      for (int i = 0; page->fit() != nullptr && i < nine_parameter_count; ++i) {
        ASSERT_NE(stored, nullptr);
        const std::string name(nine_parameter_names[static_cast<std::size_t>(i)]);
        const nlohmann::json& value = stored->payload.at("parameters").at(name).at("value");
        EXPECT_EQ(page->fit()->determined(i) ? nlohmann::json(page->fit()->parameters[i]) : nlohmann::json(), value)
            << name;
      }
      ++shown_;
    }
    if (auto* page = qobject_cast<CompensatePage*>(now); page != nullptr && page->plan() != nullptr) {
      const StoredResult* stored = session().latest("compensation");
      ASSERT_NE(stored, nullptr);
      EXPECT_EQ(page->plan()->json(), stored->payload);
      ++shown_;
    }
    if (auto* page = qobject_cast<DiscrepancyPage*>(now); page != nullptr && page->story() != nullptr) {
      const StoredResult* stored = session().latest("discrepancy");
      ASSERT_NE(stored, nullptr);
      EXPECT_EQ(page->story()->json(), stored->payload);
      ++shown_;
    }
    if (auto* page = qobject_cast<VerifyPage*>(now); page != nullptr && page->result() != nullptr) {
      const StoredResult* stored = session().latest("verify");
      ASSERT_NE(stored, nullptr);
      EXPECT_EQ(page->result()->json().at("components"), stored->payload.at("components"));
      ++shown_;
    }
    if (auto* page = qobject_cast<MachinePage*>(now)) {
      const nlohmann::json draft = session().draft("machine");
      nlohmann::json base = session().campaign()->machine.source;
      for (const char* key : {"artefacts", "styli"}) base.erase(key);
      const bool typed = draft.is_object() && draft.at("base") == base;
      const std::string name =
          typed ? draft.at("typed").at("name").get<std::string>() : session().campaign()->machine.name;
      QLineEdit* field = nullptr;
      for (auto* line : page->findChildren<QLineEdit*>())
        if (line->accessibleName() == QLatin1String("Name of the machine")) field = line;
      ASSERT_NE(field, nullptr);
      EXPECT_EQ(field->text().toStdString(), name);
      ++shown_;
    }
    if (auto* page = qobject_cast<ReportPage*>(now)) {
      EXPECT_EQ(page->operatorName()->text().toStdString(),
                ReportTaskOptions::of(*session().session(), session().campaignId()).operator_name);
    }
  }

  /// A report that is called current was written from what there is, and tells it.
  void checkReport(const TaskGraph& tasks) {
    if (!tasks.status("report").current) return;
    ++current_reports_;
    const StoredResult& stored = *session().latest("report");
    const nlohmann::json& inputs = stored.provenance.inputs;
    EXPECT_EQ(inputs.at("exclusions").size(), session().excluded().size());
    const StoredResult* plan = session().latest("compensation");
    // What does not hold any more is told as such, and is another input than while it held.
    const std::string of_plan = plan == nullptr ? "" : plan->provenance.inputs_fingerprint;
    EXPECT_EQ(inputs.at("compensation") == of_plan, plan == nullptr || tasks.holds(*plan));
    const std::string html = readFile(session().folder() / stored.payload.at("file").get<std::string>());
    const auto tells = [&](const std::string& text) { return html.find(text) != std::string::npos; };
    for (const Note& note : session().notes()) EXPECT_TRUE(tells(note.text)) << note.text;
    for (const auto& [item, reason] : session().excluded()) EXPECT_TRUE(tells(item.toStdString()));
    const ReportTaskOptions asked = ReportTaskOptions::of(*session().session(), session().campaignId());
    EXPECT_TRUE(tells(asked.operator_name)) << asked.operator_name;
    EXPECT_TRUE(tells(session().campaign()->machine.name));
    // The numbers of what is shown are those that are reported.
    for (const LargestChange& change : largestChanges(*session().observations()))
      EXPECT_TRUE(tells(withUncertainty(change.value, change.sigma, ""))) << toString(change.component);
    EXPECT_TRUE(tells(inputs.at("files").get<std::string>())) << "the fingerprint of the campaign";
  }

  void check() {
    wait();
    QTest::qWait(5);
    wait();
    ASSERT_NE(session().campaign(), nullptr);
    const TaskGraph tasks = session().tasks();
    // The list of steps says what the tasks say.
    const CaptureCounts counts = CaptureCounts::of(tasks);
    for (const StepId step : all_steps) {
      const StepReport report = stepReport(tasks, step, counts);
      EXPECT_EQ(window_->workflow().status(step).state, report.state) << toString(step);
      EXPECT_EQ(window_->stepList()->button(step)->accessibleDescription().toStdString(), report.sentence);
    }
    // What is called current is what comes out now, worked out without the graph.
    const auto set = session().observations();
    ASSERT_TRUE(set);
    const NineParameterOptions options =
        chosen<NineParameterChoice>(*session().session(), session().campaignId()).options();
    if (tasks.status("fit").current) {
      ++current_fits_;
      const NineParameterFit now = fitNineParameters(*set, options);
      const nlohmann::json stored = session().latest("fit")->payload.at("parameters");
      for (int i = 0; i < nine_parameter_count; ++i) {
        const nlohmann::json& value =
            stored.at(std::string(nine_parameter_names[static_cast<std::size_t>(i)])).at("value");
        if (value.is_null()) continue;
        EXPECT_NEAR(value.get<double>(), now.parameters[i], 1e-9 + 1e-9 * std::abs(now.parameters[i]));
      }
    }
    if (tasks.status("compensation").current) {
      ++current_plans_;
      JobContext job;
      const CompensationRequest request =
          CompensationTaskOptions::of(*session().session(), session().campaignId(), true).request();
      const nlohmann::json now = planCompensation(*session().campaign(), *set, request, job).json();
      const nlohmann::json& stored = session().latest("compensation")->payload;
      EXPECT_EQ(now.at("rms_after_um"), stored.at("rms_after_um"));
      EXPECT_EQ(now.at("rms_before_um"), stored.at("rms_before_um"));
    }
    checkReport(tasks);
    checkShown();
    EXPECT_FALSE(window_->jobs().busy());
  }

  Random random_{static_cast<std::uint64_t>(17 + qEnvironmentVariableIntValue("SPINDRIFT_WALK_SEED"))};
  QTimer answer_;
  std::map<std::int64_t, nlohmann::json> first_;
  std::string what_;
  int shown_ = 0;
  int current_fits_ = 0;
  int current_plans_ = 0;
  int current_reports_ = 0;
};

TEST_F(RandomWalk, KeepsItsPromises) {
  const int asked = qEnvironmentVariableIntValue("SPINDRIFT_WALK_ACTIONS");
  const int actions = asked > 0 ? asked : actions_in_the_suite;
  const std::filesystem::path campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth, true, {6, 60});
  // Something to be left out by its control.
  ObservationSet set = ObservationSet::read(campaign / "observations.csv");
  for (Observation& o : set.rows)
    if (o.component == Component::EY && (o.state == "M2" || o.state == "M3") && o.point == "P3") o.value += 30.0;
  set.write(campaign / "observations.csv");
  open(campaign, StepId::Model);
  const std::filesystem::path other = folder_ / "other";
  std::filesystem::copy(session().campaign()->folder, other, std::filesystem::copy_options::recursive);
  (void)folder_.write("other/note.txt", "so that its content is another");
  window_->addCampaign(QString::fromStdString(other.string()));
  wait();
  ASSERT_EQ(session().campaigns().size(), 2U);
  rememberFirst();

  std::string trace;
  for (int i = 0; i < actions && !HasFailure(); ++i) {
    act();
    trace += (i > 0 ? ", " : "") + what_;
    if (i % between_looks == between_looks - 1) check();
  }
  EXPECT_FALSE(HasFailure()) << "after: " << trace;
  // Otherwise nothing would have been looked at.
  for (const int looked_at : {current_fits_, current_plans_, current_reports_, shown_}) EXPECT_GT(looked_at, 0);
  RecordProperty("current_fits", current_fits_);
  RecordProperty("current_plans", current_plans_);
  RecordProperty("current_reports", current_reports_);
  RecordProperty("shown", shown_);

  undoEverything();
  EXPECT_FALSE(HasFailure()) << "after: " << trace;
}

}  // namespace
}  // namespace spindrift::gui
