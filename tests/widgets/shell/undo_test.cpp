// SPDX-License-Identifier: GPL-3.0-or-later
// Undo as the user meets it: everything that was done by a control is taken back by the one command, where it was done;
// what was typed and not applied is a step like any other and is lost by nothing.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QInputDialog>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPointer>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTabWidget>
#include <QTableView>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <QToolTip>

#include "core/base/atomic_file.h"
#include "core/tasks/task_options.h"
#include "tests/core/probing/probing_machines.h"
#include "tests/widgets/support/select_campaign.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/machine/machine_page.h"
#include "widgets/pages/report/report_page.h"
#include "widgets/panels/discrepancy/effect_editor.h"
#include "widgets/panels/discrepancy/effects_panel.h"
#include "widgets/panels/machine/artefact_editor.h"
#include "widgets/panels/machine/artefact_fields.h"
#include "widgets/panels/scanning/artefact_designer.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/teaching/what_if_window.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr auto a_reading = "M3/P2/EZ";

class UndoTest : public StoryTest {
 protected:
  SessionModel& session() { return window_->session(); }

  QAction* action(QKeySequence::StandardKey key) {
    for (QAction* action : window_->findChildren<QAction*>())
      if (action->shortcuts().contains(QKeySequence(key))) return action;
    ADD_FAILURE() << "no such action";
    return nullptr;
  }
  void undo() {
    ASSERT_TRUE(action(QKeySequence::Undo)->isEnabled()) << "there is nothing to undo";
    action(QKeySequence::Undo)->trigger();
    settle();
  }
  void redo() {
    ASSERT_TRUE(action(QKeySequence::Redo)->isEnabled()) << "there is nothing to redo";
    action(QKeySequence::Redo)->trigger();
    settle();
  }
  void settle() {
    wait();
    QTest::qWait(5);
    (void)window_->currentPage();
  }
  [[nodiscard]] int steps() { return window_->undoStack().index(); }

  static QPushButton* button(const QWidget* in, const char* text) {
    for (auto* button : in->findChildren<QPushButton*>())
      if (button->text().endsWith(QString::fromUtf8(text)) && !button->isHidden()) return button;
    ADD_FAILURE() << "no button " << text;
    return nullptr;
  }
  void press(const QWidget* in, const char* text) {
    QPushButton* found = button(in, text);
    ASSERT_NE(found, nullptr);
    ASSERT_TRUE(found->isEnabled()) << text;
    found->click();
    settle();
  }
  static QTableWidget* table(const QWidget* in, const char* name) {
    for (auto* table : in->findChildren<QTableWidget*>())
      if (table->accessibleName() == QLatin1String(name)) return table;
    ADD_FAILURE() << "no table " << name;
    return nullptr;
  }
  static QLineEdit* line(const QWidget* in, const char* name) {
    for (auto* edit : in->findChildren<QLineEdit*>())
      if (edit->accessibleName() == QLatin1String(name)) return edit;
    ADD_FAILURE() << "no line " << name;
    return nullptr;
  }
  static void type(QLineEdit* edit, const char* text) {
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, QString::fromLatin1(text));
  }
  static std::vector<QString> cells(const QTableWidget* table) {
    std::vector<QString> all;
    for (int row = 0; row < table->rowCount(); ++row)
      for (int c = 0; c < table->columnCount(); ++c)
        all.push_back(table->item(row, c) == nullptr ? QString() : table->item(row, c)->text());
    return all;
  }
  /// The next question for a text is answered.
  void answer(const QString& text) {
    QTimer::singleShot(50, window_.get(), [this, text] {
      auto* asked = window_->findChild<QInputDialog*>();
      ASSERT_NE(asked, nullptr) << "nothing is asked";
      asked->setTextValue(text);
      asked->accept();
    });
  }
  MachinePage* machinePage() {
    window_->workflow().goTo(StepId::Machine);
    settle();
    return page<MachinePage>();
  }
  ArtefactEditor* artefacts() {
    auto made = std::make_unique<Session>(Session::create(folder_ / "session"));
    const std::int64_t id = made->newCampaign("new", "2026-01-31T08:00:00Z", probing_test::holeMachineText());
    session().adopt(std::move(made), id);
    MachinePage* page = machinePage();
    page->findChild<QTabWidget*>(QStringLiteral("machineTabs"))->setCurrentIndex(1);
    return page->artefacts();
  }
  /// Opens the session at hand again, as after the end of the program.
  void reopen() {
    const QString folder = QString::fromStdString(session().folder().string());
    window_->closeSession();
    window_->open(folder);
    settle();
  }
  /// What was typed into a window beside the pages, which is closed, has to be there again after all that can come
  /// between; `expect_kept` and `expect_empty` open it and look: of this campaign, and of another one.
  void throughEverything(const std::function<QWidget*(const std::string& when)>& expect_kept,
                         const std::function<QWidget*()>& expect_empty) {
    const std::int64_t first = session().campaignId();
    const auto look = [&](const char* when) {
      selectCampaign(session(), first);
      settle();
      expect_kept(when)->close();
      settle();
    };
    look("closed");
    const std::filesystem::path other = folder_ / "other";
    std::filesystem::copy(session().campaign()->folder, other, std::filesystem::copy_options::recursive);
    (void)folder_.write("other/note.txt", "so that its content is another");
    QPointer<QWidget> open = expect_kept("before another campaign");
    window_->addCampaign(QString::fromStdString(other.string()));
    settle();
    ASSERT_NE(session().campaignId(), first);
    EXPECT_TRUE(open == nullptr || !open->isVisible()) << "it would be kept for the other campaign";
    expect_empty()->close();
    settle();
    look("another campaign");
    reopen();
    look("the session opened again");
    // What a crash leaves is what is on the disk while the window is open.
    open = expect_kept("before the crash");
    const std::filesystem::path crashed = folder_ / "crashed";
    std::filesystem::copy(session().folder(), crashed, std::filesystem::copy_options::recursive);
    window_->open(QString::fromStdString(crashed.string()));
    settle();
    ASSERT_EQ(session().folder(), crashed);
    look("a crash");
  }
};

TEST_F(UndoTest, AButtonThatHasNothingToRemoveSaysSo) {
  const auto expectSaid = [&](const QWidget* in, QTableWidget* table, const char* text) {
    const auto before = cells(table);
    table->setCurrentCell(-1, -1);
    QToolTip::hideText();
    press(in, text);
    EXPECT_EQ(QToolTip::text(), QStringLiteral("Choose a row of the table first.")) << text;
    EXPECT_EQ(cells(table), before) << text;
  };
  ArtefactEditor* editor = artefacts();
  expectSaid(editor, editor->styli(), "Remove stylus");
  expectSaid(editor->fields(), editor->fields()->features(), "Remove row");
  MachinePage* page = machinePage();
  page->findChild<QTabWidget*>(QStringLiteral("machineTabs"))->setCurrentIndex(0);
  expectSaid(page, table(page, "Measuring points"), "Remove point");
  EXPECT_EQ(steps(), 0);
}

TEST_F(UndoTest, APointThatIsRemovedOrAddedComesBackAndGoes) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  MachinePage* page = machinePage();
  QTableWidget* points = table(page, "Measuring points");
  const auto before = cells(points);
  points->setCurrentCell(1, 0);
  press(page, "Remove point");
  const auto removed = cells(points);
  ASSERT_EQ(removed.size(), before.size() - 5);
  EXPECT_EQ(steps(), 1);
  press(page, "Add point");
  EXPECT_EQ(steps(), 2) << "one step, not one for every cell";
  undo();
  EXPECT_EQ(cells(points), removed);
  undo();
  EXPECT_EQ(cells(points), before);
  EXPECT_FALSE(button(page, "Apply changes")->isEnabled()) << "nothing is left to apply";
  redo();
  EXPECT_EQ(cells(points), removed);
  EXPECT_TRUE(button(page, "Apply changes")->isEnabled());
}

TEST_F(UndoTest, WhatIsTypedIntoOnePlaceIsOneStep) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  MachinePage* page = machinePage();
  QLineEdit* name = line(page, "Name of the machine");
  const QString before = name->text();
  type(name, "mill");
  EXPECT_EQ(steps(), 1);
  QTableWidget* points = table(page, "Measuring points");
  const QString x = points->item(0, 2)->text();
  points->item(0, 2)->setText(QStringLiteral("1"));
  points->item(0, 2)->setText(QStringLiteral("12"));
  points->item(0, 3)->setText(QStringLiteral("34"));
  EXPECT_EQ(steps(), 3);
  undo();
  EXPECT_EQ(points->item(0, 2)->text(), QStringLiteral("12"));
  undo();
  EXPECT_EQ(points->item(0, 2)->text(), x);
  EXPECT_EQ(name->text(), QStringLiteral("mill"));
  undo();
  EXPECT_EQ(name->text(), before);
  EXPECT_FALSE(action(QKeySequence::Undo)->isEnabled());
}

TEST_F(UndoTest, WhatIsDiscardedOrAppliedComesBackAsItWasTyped) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  MachinePage* page = machinePage();
  QLineEdit* name = line(page, "Name of the machine");
  const QString before = name->text();
  type(name, "mill");
  press(page, "Discard");
  EXPECT_EQ(name->text(), before);
  undo();
  EXPECT_EQ(name->text(), QStringLiteral("mill"));
  press(page, "Apply changes");
  EXPECT_EQ(session().campaign()->machine.name, "mill");
  EXPECT_FALSE(button(page, "Apply changes")->isEnabled());
  undo();
  EXPECT_EQ(session().campaign()->machine.name, before.toStdString());
  EXPECT_EQ(name->text(), QStringLiteral("mill"));
  EXPECT_TRUE(button(page, "Apply changes")->isEnabled());
  redo();
  EXPECT_EQ(session().campaign()->machine.name, "mill");
  // Back to the file, with something typed.
  type(name, "lathe");
  press(page, "Back to machine.json");
  EXPECT_EQ(name->text(), before);
  undo();
  EXPECT_EQ(name->text(), QStringLiteral("lathe"));
  EXPECT_EQ(session().campaign()->machine.name, "mill");
  while (window_->undoStack().canUndo()) undo();
  EXPECT_EQ(name->text(), before);
  EXPECT_FALSE(session().machineEdited());
}

TEST_F(UndoTest, RowsOfArtefactsAndStyliComeBack) {
  ArtefactEditor* editor = artefacts();
  const auto styli = cells(editor->styli());
  editor->styli()->setCurrentCell(0, 0);
  press(editor, "Remove stylus");
  EXPECT_LT(cells(editor->styli()).size(), styli.size());
  undo();
  EXPECT_EQ(cells(editor->styli()), styli);
  EXPECT_FALSE(editor->applyButton()->isEnabled());
  auto* choice = editor->findChild<QComboBox*>();
  const int count = choice->count();
  press(editor, "Remove");
  EXPECT_EQ(choice->count(), count - 1);
  undo();
  EXPECT_EQ(choice->count(), count);
  const auto features = cells(editor->fields()->features());
  editor->fields()->features()->item(2, 1)->setText(QStringLiteral("110.5"));
  press(editor, "Discard");
  EXPECT_EQ(cells(editor->fields()->features()), features);
  undo();
  EXPECT_EQ(editor->fields()->features()->item(2, 1)->text(), QStringLiteral("110.5"));
  undo();
  EXPECT_EQ(cells(editor->fields()->features()), features);
  EXPECT_EQ(steps(), 0);
}

TEST_F(UndoTest, WhatWasTypedForAnotherStateIsSaidShownOrDiscarded) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  MachinePage* page = machinePage();
  QLineEdit* name = line(page, "Name of the machine");
  const QString before = name->text();
  type(name, "mill");
  // The machine becomes another meanwhile, as the connections do it.
  nlohmann::json machine = session().campaign()->machine.source;
  machine["name"] = "of the connections";
  window_->undoStack().push(new MachineCommand(session(), machine));
  settle();
  EXPECT_EQ(name->text(), QStringLiteral("of the connections"));
  EXPECT_TRUE(page->callout()->sentence().contains(QStringLiteral("another state")))
      << page->callout()->sentence().toStdString();
  EXPECT_TRUE(button(page, "Discard")->isEnabled());
  EXPECT_FALSE(button(page, "Apply changes")->isEnabled());
  press(page->callout(), "Show it");
  EXPECT_EQ(name->text(), QStringLiteral("mill"));
  EXPECT_TRUE(button(page, "Apply changes")->isEnabled());
  undo();
  EXPECT_EQ(name->text(), QStringLiteral("of the connections"));
  press(page, "Discard");
  EXPECT_FALSE(page->callout()->sentence().contains(QStringLiteral("another state")));
  while (window_->undoStack().canUndo()) undo();
  EXPECT_EQ(name->text(), before);
}

TEST_F(UndoTest, AnEffectThatIsBeingEditedIsLostByNothing) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Discrepancy);
  const std::int64_t first = session().campaignId();
  auto* page = this->page<DiscrepancyPage>();
  const auto effects = [&] {
    page->showEffects(true);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !page->effects()->busy(); }, 10'000));
    return page->effects();
  };
  press(effects(), "New effect …");
  type(page->effects()->editor()->id(), "quill.growth");
  type(page->effects()->editor()->expression(0, Component::EZ), "1 + x");
  EXPECT_EQ(steps(), 2);
  const auto expectOpen = [&](const char* when) {
    EXPECT_TRUE(QTest::qWaitFor([&] { return page->effects() != nullptr && !page->effects()->busy(); }, 10'000));
    ASSERT_TRUE(page->effects()->editing()) << when;
    EXPECT_EQ(page->effects()->editor()->id()->text(), QStringLiteral("quill.growth")) << when;
    EXPECT_EQ(page->effects()->editor()->expression(0, Component::EZ)->text(), QStringLiteral("1 + x")) << when;
    EXPECT_TRUE(page->effects()->hasUnsavedEdit()) << when;
    EXPECT_TRUE(page->effects()->acceptButton()->isEnabled()) << when;
  };
  // Another step, another campaign, the session opened again.
  window_->workflow().goTo(StepId::Model);
  settle();
  window_->workflow().goTo(StepId::Discrepancy);
  settle();
  expectOpen("another step");
  const std::filesystem::path other = folder_ / "other";
  std::filesystem::copy(session().campaign()->folder, other, std::filesystem::copy_options::recursive);
  (void)folder_.write("other/note.txt", "so that its content is another");
  window_->addCampaign(QString::fromStdString(other.string()));
  settle();
  window_->workflow().goTo(StepId::Discrepancy);
  settle();
  EXPECT_FALSE(page->effects()->editing()) << "it belongs to the other campaign";
  selectCampaign(session(), first);
  settle();
  expectOpen("another campaign");
  undo();
  EXPECT_EQ(page->effects()->editor()->expression(0, Component::EZ)->text(), QString());
  redo();
  expectOpen("redo");
  reopen();
  window_->workflow().goTo(StepId::Discrepancy);
  settle();
  expectOpen("the session opened again");
  // Cancelled, taken back, applied, taken back.
  press(page->effects(), "Cancel");
  EXPECT_FALSE(page->effects()->editing());
  undo();
  expectOpen("cancel taken back");
  press(page->effects(), "Apply");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !page->effects()->busy(); }, 10'000));
  EXPECT_NE(page->effects()->itemOf("quill.growth"), nullptr);
  EXPECT_FALSE(page->effects()->editing());
  EXPECT_EQ(steps(), 1);
  undo();
  expectOpen("apply taken back");
  EXPECT_EQ(page->effects()->itemOf("quill.growth"), nullptr);
}

TEST_F(UndoTest, NotesComeBackAsTheyWere) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  const auto notes = [&] {
    nlohmann::json all = nlohmann::json::array();
    for (const Note& n : session().notes()) all.push_back({n.id, n.step, n.item, n.text, n.created_utc});
    return all;
  };
  NotesDialog* dialog = window_->openNotes();
  QTest::keyClicks(dialog->text(), QStringLiteral("The door was open."));
  press(dialog, "Add the note");
  const nlohmann::json one = notes();
  ASSERT_EQ(one.size(), 1U);
  QTest::keyClicks(dialog->text(), QStringLiteral("Then it was closed."));
  press(dialog, "Add the note");
  const nlohmann::json two = notes();
  dialog->findChild<QTableView*>()->setCurrentIndex(dialog->rows()->index(0, 0));
  press(dialog, "Remove");
  const nlohmann::json rest = notes();
  dialog->close();
  undo();
  EXPECT_EQ(notes(), two) << "in its place, at its time";
  undo();
  EXPECT_EQ(notes(), one);
  undo();
  EXPECT_TRUE(notes().empty());
  for (int i = 0; i < 3; ++i) redo();
  EXPECT_EQ(notes(), rest);
}

TEST_F(UndoTest, ANoteThatIsBegunIsLostByNothing) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  NotesDialog* dialog = window_->openNotes();
  dialog->about()->setCurrentText(stepTitle(StepId::Capture));
  dialog->item()->setCurrentText(QString::fromLatin1(a_reading));
  QTest::keyClicks(dialog->text(), QStringLiteral("The door was"));
  dialog->close();
  throughEverything(
      [&](const std::string& when) -> QWidget* {
        dialog = window_->openNotes();
        EXPECT_EQ(dialog->text()->toPlainText(), QStringLiteral("The door was")) << when;
        EXPECT_EQ(dialog->about()->currentText(), stepTitle(StepId::Capture)) << when;
        EXPECT_EQ(dialog->item()->currentText(), QString::fromLatin1(a_reading)) << when;
        EXPECT_TRUE(dialog->addButton()->isEnabled()) << when;
        return dialog;
      },
      [&]() -> QWidget* {
        dialog = window_->openNotes();
        EXPECT_EQ(dialog->text()->toPlainText(), QString()) << "it belongs to the other campaign";
        return dialog;
      });
  dialog = window_->openNotes();
  QTest::keyClicks(dialog->text(), QStringLiteral(" open."));
  press(dialog, "Add the note");
  dialog->close();
  settle();
  ASSERT_EQ(session().notes().size(), 1U);
  EXPECT_EQ(session().notes().front().text, "The door was open.");
  EXPECT_EQ(session().notes().front().step, toString(StepId::Capture));
  EXPECT_EQ(session().notes().front().item, a_reading);
  dialog = window_->openNotes();
  EXPECT_EQ(dialog->text()->toPlainText(), QString()) << "added";
  dialog->close();
}

TEST_F(UndoTest, WhatIsAskedOfTheMachineIsLostByNothing) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  WhatIfWindow* window = window_->openWhatIf();
  QSlider* slider = window->slider("EC0Y_urad");
  slider->setSliderDown(true);
  slider->setSliderPosition(80);  // of 200 steps to 50 urad
  slider->setSliderDown(false);
  window->box("EXX_um_per_m")->setValue(3.5);
  window->box("EYY_um_per_m")->setValue(1.0);
  window->box("EYY_um_per_m")->setValue(0.0);
  const nlohmann::json asked = window->model().json();
  window->close();
  throughEverything(
      [&](const std::string& when) -> QWidget* {
        window = window_->openWhatIf();
        EXPECT_EQ(window->slider("EC0Y_urad")->value(), 80) << when;
        EXPECT_EQ(window->box("EC0Y_urad")->value(), 20.0) << when;
        EXPECT_EQ(window->box("EXX_um_per_m")->value(), 3.5) << when;
        EXPECT_EQ(window->model().json(), asked) << when;
        EXPECT_FALSE(window->machineView()->arrows().empty()) << when;
        return window;
      },
      [&]() -> QWidget* {
        window = window_->openWhatIf();
        EXPECT_EQ(window->slider("EC0Y_urad")->value(), 0) << "it belongs to the other campaign";
        EXPECT_TRUE(window->machineView()->arrows().empty());
        return window;
      });
  window = window_->openWhatIf();
  EXPECT_EQ(window_->openWhatIf(), window) << "two windows would keep each other's";
  nlohmann::json machine = session().campaign()->machine.source;
  machine["name"] = "another name";
  QPointer<WhatIfWindow> old = window;
  window_->undoStack().push(new MachineCommand(session(), machine));
  window = window_->openWhatIf();
  EXPECT_EQ(window->model().machine().name, "another name") << "the machine was edited";
  EXPECT_TRUE(old == nullptr || !old->isVisible());
  EXPECT_EQ(window->slider("EC0Y_urad")->value(), 80);
  press(window, "All to zero");
  window->close();
  settle();
  window = window_->openWhatIf();
  EXPECT_EQ(window->slider("EC0Y_urad")->value(), 0) << "nothing is kept of what was put back";
}

TEST_F(UndoTest, ADesignThatIsBegunIsLostByNothing) {
  const auto designer = [&] {
    for (QAction* action : window_->findChildren<QAction*>())
      if (action->text().contains(QStringLiteral("rtefact designer"))) action->trigger();
    return window_->findChild<ArtefactDesigner*>();
  };
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  ArtefactDesigner* window = designer();
  ASSERT_NE(window, nullptr);
  const double usual_mm = window->number("size x")->value();
  window->chooseSurface(1);
  window->number("size x")->setValue(17.5);
  window->number("noise")->setValue(0.75);
  window->number("step")->setValue(0.25);
  window->close();
  throughEverything(
      [&](const std::string& when) -> QWidget* {
        window = designer();
        EXPECT_EQ(window->surface().bumps.size(), 2U) << when;
        EXPECT_EQ(window->findChild<QComboBox*>()->currentIndex(), 1) << when;
        EXPECT_EQ(window->number("size x")->value(), 17.5) << when;
        EXPECT_EQ(window->surface().size_mm.x(), 17.5) << when;
        EXPECT_EQ(window->number("noise")->value(), 0.75) << when;
        EXPECT_EQ(window->number("step")->value(), 0.25) << when;
        return window;
      },
      [&]() -> QWidget* {
        window = designer();
        EXPECT_EQ(window->number("size x")->value(), usual_mm) << "it belongs to the other campaign";
        EXPECT_TRUE(window->surface().bumps.empty());
        return window;
      });
  window = designer();
  EXPECT_EQ(designer(), window) << "two windows would keep each other's";
}

TEST_F(UndoTest, WhatIsSetWithoutASessionIsKeptWithTheProgram) {
  WhatIfWindow* window = window_->openWhatIf();
  window->set("EC0Y_urad", 20.0);
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  EXPECT_TRUE(window->isVisible()) << "it is of no campaign";
  WhatIfWindow* of_campaign = window_->openWhatIf();
  EXPECT_NE(of_campaign, window);
  EXPECT_EQ(of_campaign->box("EC0Y_urad")->value(), 0.0);
  window->close();
  of_campaign->close();
  settle();
  window_ = std::make_unique<MainWindow>();
  window = window_->openWhatIf();
  EXPECT_EQ(window->box("EC0Y_urad")->value(), 20.0);
  window->reset();
  window->close();
  settle();
  EXPECT_EQ(window_->openWhatIf()->box("EC0Y_urad")->value(), 0.0);
}

TEST_F(UndoTest, ANoteMakesTheReportOutdatedAndItsUndoDoesNot) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Report);
  window_->currentPage()->runAll();
  settle();
  ASSERT_TRUE(session().state("report").current);
  NotesDialog* dialog = window_->openNotes();
  QTest::keyClicks(dialog->text(), QStringLiteral("The door was open."));
  press(dialog, "Add the note");
  dialog->close();
  settle();
  EXPECT_FALSE(session().state("report").current) << "the report does not tell the note";
  EXPECT_EQ(window_->workflow().status(StepId::Report).state, StepState::Outdated);
  undo();
  EXPECT_TRUE(session().state("report").current);
  EXPECT_EQ(window_->workflow().status(StepId::Report).state, StepState::Current);
}

TEST_F(UndoTest, TheModelOverTimeIsTakenBack) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  settle();
  const Page* before = window_->currentPage();
  press(before, "Model over time");
  EXPECT_TRUE(session().modelOverTime());
  EXPECT_NE(window_->currentPage(), before);
  undo();
  EXPECT_FALSE(session().modelOverTime());
  EXPECT_EQ(window_->currentPage(), before);
  redo();
  EXPECT_TRUE(session().modelOverTime());
}

TEST_F(UndoTest, TheNameOfTheOperatorIsTakenBackAndBelongsToItsCampaign) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Report);
  settle();
  const std::int64_t first = session().campaignId();
  auto* page = this->page<ReportPage>();
  const auto give = [&](const char* name) {
    type(page->operatorName(), name);
    QTest::keyClick(page->operatorName(), Qt::Key_Return);
    page->operatorName()->clearFocus();
    settle();
  };
  const auto name = [&] { return ReportTaskOptions::of(*session().session(), session().campaignId()).operator_name; };
  give("A. Turner");
  EXPECT_EQ(name(), "A. Turner");
  const std::filesystem::path other = folder_ / "other";
  std::filesystem::copy(session().campaign()->folder, other, std::filesystem::copy_options::recursive);
  (void)folder_.write("other/note.txt", "so that its content is another");
  window_->addCampaign(QString::fromStdString(other.string()));
  settle();
  window_->workflow().goTo(StepId::Report);
  settle();
  EXPECT_EQ(name(), "A. Turner") << "a campaign that is added begins with the one who adds it";
  give("B. Miller");
  selectCampaign(session(), first);
  settle();
  EXPECT_EQ(name(), "A. Turner");
  undo();
  EXPECT_EQ(name(), "");
  EXPECT_EQ(page->operatorName()->text(), QString());
  selectCampaign(session(), session().campaigns().back().id);
  settle();
  EXPECT_EQ(name(), "B. Miller");
}

TEST_F(UndoTest, SaysWhereItActsAndGoesThere) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Report);
  settle();
  auto* report = page<ReportPage>();
  auto* tell = report->findChild<QCheckBox*>();
  tell->click();
  settle();
  MachinePage* machine = machinePage();
  auto* tabs = machine->findChild<QTabWidget*>(QStringLiteral("machineTabs"));
  tabs->setCurrentIndex(2);
  press(machine, "Confirm all");
  EXPECT_EQ(steps(), 2) << "all at once are one step";
  tabs->setCurrentIndex(0);
  window_->workflow().goTo(StepId::Compensate);
  settle();
  EXPECT_TRUE(action(QKeySequence::Undo)->text().endsWith(QStringLiteral("(Machine)")))
      << action(QKeySequence::Undo)->text().toStdString();
  undo();
  EXPECT_EQ(window_->workflow().current(), StepId::Machine);
  EXPECT_EQ(tabs->currentIndex(), 2);
  EXPECT_TRUE(action(QKeySequence::Undo)->text().endsWith(QStringLiteral("(Report)")))
      << action(QKeySequence::Undo)->text().toStdString();
  undo();
  EXPECT_EQ(window_->workflow().current(), StepId::Report);
  EXPECT_TRUE(tell->isChecked());
  window_->openPlant();
  redo();
  EXPECT_EQ(window_->workflow().current(), StepId::Report);
  EXPECT_TRUE(report->isVisible()) << "from a window of its own, too";
  redo();
  EXPECT_EQ(window_->workflow().current(), StepId::Machine);
}

TEST_F(UndoTest, ABatchIsLeftOutAtOnce) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Discrepancy);
  const QSignalSpy told(&session(), &SessionModel::inputsChanged);
  QStringList items;
  for (int state = 1; state < 24; ++state) items << QStringLiteral("M%1/P2/EZ").arg(state);
  window_->undoStack().push(new ExcludeCommand(session(), items, QStringLiteral("disturbed")));
  EXPECT_EQ(told.count(), 1);
  EXPECT_EQ(session().session()->exclusions(session().campaignId()).size(), 23U);
  undo();
  EXPECT_EQ(told.count(), 2);
  EXPECT_TRUE(session().session()->exclusions(session().campaignId()).empty());
}

}  // namespace
}  // namespace spindrift::gui
