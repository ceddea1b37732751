// SPDX-License-Identifier: GPL-3.0-or-later
// The list of effects in the real window: look, search, switch off; write, check, take over, remove, load and save
// effects of one's own; the search uses them; everything can be undone.
#include "widgets/panels/discrepancy/effects_panel.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/common/parts.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/panels/discrepancy/effect_editor.h"
#include "widgets/panels/discrepancy/effect_picture.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

/// What the spindle does, written by the user.
constexpr auto own_growth = R"({"format":"spindrift-effects","version":1,"built_in":false,"effects":[
  {"id":"quill.growth","title":"growth of the quill","physics":"The quill warms up with the spindle and grows.",
   "drivers":["spindle_rpm"],"dynamics":"lag","tau_s":[300,20000],
   "shape":[{"gain_unit":"um","EZ":"1"}]},
  {"id":"bed.slope","title":"slope of the bed","drivers":["T_ambient_degC"],"dynamics":"lag",
   "shape":[{"gain_unit":"um_per_m","EZ":"1e-3*x"}]}]})";

class EffectsPanelTest : public StoryTest {
 protected:
  void openEffects(Hidden hidden = Hidden::SpindleGrowth) {
    open(writeStoryCampaign(folder_, hidden), StepId::Discrepancy);
    page_ = page<DiscrepancyPage>();
    ASSERT_NE(page_, nullptr);
    EXPECT_EQ(page_->effects(), nullptr) << "made when it is first shown";
    QTest::mouseClick(page_->effectsButton(), Qt::LeftButton);
    panel_ = page_->effects();
    ASSERT_NE(panel_, nullptr);
    settle();
    ASSERT_GT(panel_->listing().effects.size(), 10U);
  }
  void settle() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return !panel_->busy(); }, 10'000));
  }
  void search() {
    QTest::mouseClick(page_->primaryButton(), Qt::LeftButton);
    wait();
    ASSERT_NE(page_->story(), nullptr) << page_->callout()->sentence().toStdString();
  }
  void showEffects() {
    page_->showEffects(true);
    settle();
  }
  [[nodiscard]] int shown() const {
    int count = 0;
    for (int f = 0; f < panel_->tree()->topLevelItemCount(); ++f) {
      for (int i = 0; i < panel_->tree()->topLevelItem(f)->childCount(); ++i)
        if (!panel_->tree()->topLevelItem(f)->child(i)->isHidden()) ++count;
    }
    return count;
  }
  void setChecked(const char* id, bool on) {
    ASSERT_NE(panel_->itemOf(id), nullptr) << id;
    panel_->itemOf(id)->setCheckState(0, on ? Qt::Checked : Qt::Unchecked);
    settle();
  }
  [[nodiscard]] nlohmann::json choiceOfResult() const {
    return window_->session().latest("discrepancy")->provenance.options.value("discrepancy", nlohmann::json());
  }
  static void type(QLineEdit* field, const QString& text) {
    field->setFocus();
    field->clear();
    QTest::keyClicks(field, text);
  }
  /// Pictures for people to look at, where the environment names a folder for them.
  void picture(const char* name) {
    settle();
    const QString folder = qEnvironmentVariable("SPINDRIFT_TEST_PICTURES");
    if (folder.isEmpty()) return;
    window_->resize(1280, 800);
    for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
      window_->setTheme(kind);
      QTest::qWait(50);
      window_->grab().save(QStringLiteral("%1/%2-%3.png")
                               .arg(folder, QString::fromLatin1(name),
                                    kind == ThemeKind::Light ? QStringLiteral("light") : QStringLiteral("dark")));
    }
  }
  DiscrepancyPage* page_ = nullptr;
  EffectsPanel* panel_ = nullptr;
};

TEST_F(EffectsPanelTest, ListsFiltersAndDraws) {
  openEffects();
  const int all = shown();
  EXPECT_EQ(all, static_cast<int>(panel_->listing().effects.size()));
  panel_->choose("spindle.growth.z");
  settle();
  ASSERT_FALSE(panel_->picture()->empty());
  EXPECT_NEAR(panel_->picture()->shape()->largest, 1.0, 1e-9);
  for (const char* word : {"spindle.growth.z", "Formula", "Driven by", "spindle speed¹·⁵", "Dynamics"})
    EXPECT_TRUE(panel_->details()->text().contains(QString::fromUtf8(word))) << word;
  picture("list");
  type(panel_->searchField(), QStringLiteral("ball screw"));
  EXPECT_GT(shown(), 0);
  EXPECT_LT(shown(), all / 2);
  EXPECT_FALSE(panel_->itemOf("ball_screw.expansion.x")->isHidden());
  EXPECT_TRUE(panel_->itemOf("spindle.growth.z")->isHidden());
  // A driver is found too; what nobody has is found nowhere.
  type(panel_->searchField(), QStringLiteral("feed_x"));
  EXPECT_FALSE(panel_->itemOf("ball_screw.expansion.x")->isHidden());
  type(panel_->searchField(), QStringLiteral("xylophone"));
  EXPECT_EQ(shown(), 0);
  panel_->searchField()->clear();
  EXPECT_EQ(shown(), all);
  // Every effect can be drawn, or says why not.
  for (const Effect& effect : panel_->listing().effects) {
    panel_->choose(effect.id);
    settle();
    EXPECT_EQ(panel_->chosen(), effect.id);
    EXPECT_FALSE(panel_->picture()->empty()) << effect.id << panel_->picture()->accessibleDescription().toStdString();
  }
  panel_->choose("frame.rotation.c");
  picture("rotation");
  panel_->choose("fixture.slip.P2");
  picture("slip");
  for (const Exportable& item : page_->exportables()) {
    const std::string file = (folder_ / ("x." + item.formats.front().toStdString())).string();
    ASSERT_NO_THROW(item.write(QString::fromStdString(file)));
    EXPECT_GT(std::filesystem::file_size(file), 100U);
  }
}

TEST_F(EffectsPanelTest, TheMenuOpensIt) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  window_->openEffects();
  page_ = page<DiscrepancyPage>();
  ASSERT_NE(page_, nullptr);
  ASSERT_NE(page_->effects(), nullptr);
  EXPECT_TRUE(page_->effects()->isVisible());
  QTest::mouseClick(page_->effectsButton(), Qt::LeftButton);
  EXPECT_FALSE(page_->effects()->isVisible());
}

TEST_F(EffectsPanelTest, WhatIsSwitchedOffIsLeftOutOfTheNextSearch) {
  openEffects();
  setChecked("spindle.growth.z", false);
  setChecked("backlash.x", false);  // these data could not show it anyway
  EXPECT_TRUE(panel_->itemOf("spindle.growth.z")->toolTip(1).startsWith(QStringLiteral("switched off")));
  EXPECT_EQ(page_->story(), nullptr) << "nothing is searched before it is asked for";
  search();
  EXPECT_FALSE(panel_->isVisible()) << "the answer is in front";
  EXPECT_EQ(choiceOfResult().at("rejected"), nlohmann::json({"spindle.growth.z", "backlash.x"}));
  for (const FoundEffect& e : page_->story()->effects) EXPECT_NE(e.id, "spindle.growth.z");
  // Switched on again: what was found is outdated, and undo brings it back without a search.
  showEffects();
  setChecked("spindle.growth.z", true);
  EXPECT_EQ(page_->callout()->tone(), Tone::Outdated);
  EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("consider growth of the spindle along Z again"));
  window_->undoStack().undo();
  settle();
  EXPECT_EQ(panel_->itemOf("spindle.growth.z")->checkState(0), Qt::Unchecked);
  EXPECT_NE(page_->callout()->tone(), Tone::Outdated);
  window_->undoStack().undo();
  window_->undoStack().undo();
  settle();
  EXPECT_EQ(panel_->itemOf("spindle.growth.z")->checkState(0), Qt::Checked);
}

TEST_F(EffectsPanelTest, AFamilyIsOneStepOfUndo) {
  openEffects();
  QTreeWidgetItem* family = panel_->itemOf("ball_screw.expansion.x")->parent();
  family->setCheckState(0, Qt::Unchecked);
  settle();
  const int before = window_->undoStack().count();
  EXPECT_EQ(before, 1);
  EXPECT_EQ(window_->session().effects().rejected.size(), static_cast<std::size_t>(family->childCount()));
  window_->undoStack().undo();
  settle();
  EXPECT_TRUE(window_->session().effects().rejected.empty());
  EXPECT_EQ(family->checkState(0), Qt::Checked);
}

TEST_F(EffectsPanelTest, AnEffectIsCheckedWhileItIsTypedAndTheSearchNamesIt) {
  openEffects();
  panel_->newEffect();
  EffectEditor* editor = panel_->editor();
  ASSERT_NE(editor, nullptr);
  EXPECT_FALSE(panel_->acceptButton()->isEnabled());
  // An id of the catalogue, an unknown driver, a wrong expression: one sentence with its place below the field.
  type(editor->id(), QStringLiteral("spindle.growth.z"));
  type(editor->expression(0, Component::EZ), QStringLiteral("1"));
  settle();
  EXPECT_TRUE(editor->problemAt("id").contains(QStringLiteral("effects.json")));
  EXPECT_TRUE(editor->problemAt("id").contains(QStringLiteral("$.effects[0].id")));
  EXPECT_FALSE(panel_->acceptButton()->isEnabled());
  type(editor->id(), QStringLiteral("quill.growth"));
  type(editor->drivers(), QStringLiteral("spindel_rpm"));
  settle();
  EXPECT_TRUE(editor->problemAt("id").isEmpty());
  EXPECT_TRUE(editor->problemAt("drivers").contains(QStringLiteral("\"spindel_rpm\" is not a column of log.csv")))
      << editor->problemAt("drivers").toStdString();
  type(editor->drivers(), QStringLiteral("spindle_rpm"));
  type(editor->expression(0, Component::EZ), QStringLiteral("1 + sinus(x)"));
  settle();
  EXPECT_TRUE(editor->problemAt("drivers").isEmpty());
  const QString wrong = editor->problemAt("shape[0].EZ");
  EXPECT_TRUE(wrong.contains(QStringLiteral("$.effects[0].shape[0].EZ"))) << wrong.toStdString();
  EXPECT_TRUE(wrong.contains(QStringLiteral("sinus"))) << wrong.toStdString();
  EXPECT_FALSE(panel_->acceptButton()->isEnabled());
  picture("editor-wrong");
  // Not finite at a point that was measured: only the observations show it.
  type(editor->expression(0, Component::EZ), QStringLiteral("1/(x-50)"));
  settle();
  EXPECT_TRUE(editor->problemAt("shape[0].EZ").contains(QStringLiteral("P1")))
      << editor->problemAt("shape[0].EZ").toStdString();
  type(editor->expression(0, Component::EZ), QStringLiteral("1"));
  editor->dynamics()->setCurrentIndex(1);
  type(editor->title(), QStringLiteral("growth of the quill"));
  settle();
  EXPECT_TRUE(editor->problemAt("shape[0].EZ").isEmpty());
  EXPECT_FALSE(panel_->editorPicture()->empty());
  EXPECT_EQ(panel_->editorState()->tone(), Tone::Good) << panel_->editorState()->sentence().toStdString();
  ASSERT_TRUE(panel_->acceptButton()->isEnabled());
  picture("editor-right");
  QTest::mouseClick(panel_->acceptButton(), Qt::LeftButton);
  settle();
  EXPECT_FALSE(panel_->editing());
  ASSERT_NE(panel_->itemOf("quill.growth"), nullptr);
  EXPECT_EQ(panel_->chosen(), "quill.growth");
  EXPECT_EQ(panel_->tree()->topLevelItem(0), panel_->itemOf("quill.growth")->parent()) << "one's own first";
  picture("own");
  // Without the catalogue the search has it alone to name.
  EXPECT_TRUE(panel_->builtIn()->isChecked());
  QTest::mouseClick(panel_->builtIn(), Qt::LeftButton, {}, QPoint(12, panel_->builtIn()->height() / 2));
  settle();
  EXPECT_EQ(panel_->listing().effects.size(), 1U);
  search();
  ASSERT_EQ(page_->story()->effects.size(), 1U);
  EXPECT_EQ(page_->story()->effects.front().id, "quill.growth");
  EXPECT_TRUE(page_->verdict()->text().contains(QStringLiteral("growth of the quill")))
      << page_->verdict()->text().toStdString();
  EXPECT_EQ(choiceOfResult().at("effects").at("effects").size(), 1U);
  EXPECT_EQ(window_->workflow().status(StepId::Discrepancy).state, StepState::Current);
  // What follows knows it too: the model it was added to, the corrections and the report.
  QTest::mouseClick(page_->addButton(), Qt::LeftButton);
  wait();
  ASSERT_EQ(page_->story()->added, std::vector<std::string>{"quill.growth"});
  for (const StepId step : {StepId::Compensate, StepId::Report}) {
    window_->workflow().goTo(step);
    window_->currentPage()->runAll();
    wait();
    // The corrections say which sensors were taken for which.
    EXPECT_EQ(window_->workflow().status(step).state,
              step == StepId::Compensate ? StepState::Attention : StepState::Current)
        << stepTitle(step).toStdString() << ": " << window_->currentPage()->callout()->sentence().toStdString();
  }
  window_->workflow().goTo(StepId::Discrepancy);
  window_->undoStack().undo();
  wait();
  // The campaign folder is as it was.
  EXPECT_FALSE(std::filesystem::exists(window_->session().campaign()->folder / "effects.json"));
  // Undo: the built-in ones again, then without the new one.
  showEffects();
  window_->undoStack().undo();
  settle();
  EXPECT_GT(panel_->listing().effects.size(), 10U);
  EXPECT_EQ(window_->workflow().status(StepId::Discrepancy).state, StepState::Outdated);
  window_->undoStack().undo();
  settle();
  EXPECT_EQ(panel_->itemOf("quill.growth"), nullptr);
  EXPECT_TRUE(window_->session().effects().effects.is_null());
  window_->undoStack().redo();
  settle();
  EXPECT_NE(panel_->itemOf("quill.growth"), nullptr);
}

TEST_F(EffectsPanelTest, LoadEditRemoveSave) {
  openEffects();
  const std::string file = (folder_ / "mine.json").string();
  folder_.write("mine.json", own_growth);
  folder_.write("wrong.json", std::string(own_growth).replace(std::string(own_growth).find("1e-3*x"), 6, "1e-3*q"));
  panel_->loadFile(QString::fromStdString((folder_ / "wrong.json").string()));
  settle();
  EXPECT_EQ(panel_->callout()->tone(), Tone::Bad);
  EXPECT_TRUE(panel_->callout()->sentence().contains(QStringLiteral("$.effects[1].shape[0].EZ")))
      << panel_->callout()->sentence().toStdString();
  EXPECT_EQ(window_->undoStack().count(), 0);
  panel_->loadFile(QString::fromStdString(file));
  settle();
  ASSERT_EQ(panel_->listing().effects.size(), 2U);
  EXPECT_FALSE(panel_->builtIn()->isChecked());
  panel_->choose("bed.slope");
  settle();
  ASSERT_FALSE(panel_->picture()->empty());
  EXPECT_NEAR(panel_->picture()->shape()->largest, 0.5, 1e-9);
  picture("loaded");
  setChecked("bed.slope", false);
  // A new name goes with it into what is switched off.
  panel_->editEffect("bed.slope");
  settle();
  EXPECT_FALSE(panel_->acceptButton()->isEnabled()) << "nothing has been changed";
  EXPECT_EQ(panel_->editor()->drivers()->text(), QStringLiteral("T_ambient_degC"));
  type(panel_->editor()->id(), QStringLiteral("bed.tilt"));
  QTest::mouseClick(panel_->editor()->addGainButton(), Qt::LeftButton);
  ASSERT_EQ(panel_->editor()->gainCount(), 2U);
  type(panel_->editor()->expression(1, Component::EZ), QStringLiteral("1e-3*y"));
  settle();
  ASSERT_TRUE(panel_->acceptButton()->isEnabled()) << panel_->editorState()->sentence().toStdString();
  picture("editor-gains");
  QTest::mouseClick(panel_->acceptButton(), Qt::LeftButton);
  settle();
  EXPECT_EQ(window_->session().effects().rejected, std::vector<std::string>{"bed.tilt"});
  ASSERT_NE(panel_->listing().find("bed.tilt"), nullptr);
  EXPECT_EQ(panel_->listing().find("bed.tilt")->shape.size(), 2U);
  // Saved, and read again by the core library; never into the campaign.
  const std::string saved = (folder_ / "saved.json").string();
  panel_->saveFile(QString::fromStdString(saved));
  EXPECT_EQ(panel_->callout()->tone(), Tone::Good) << panel_->callout()->sentence().toStdString();
  EXPECT_EQ(OwnEffects::read(saved)->effects().size(), 2U);
  panel_->saveFile(QString::fromStdString((window_->session().campaign()->folder / "effects.json").string()));
  EXPECT_EQ(panel_->callout()->tone(), Tone::Bad);
  EXPECT_FALSE(std::filesystem::exists(window_->session().campaign()->folder / "effects.json"));
  panel_->removeEffect("bed.tilt");
  settle();
  EXPECT_EQ(panel_->itemOf("bed.tilt"), nullptr);
  EXPECT_TRUE(window_->session().effects().rejected.empty());
  panel_->removeEffect("quill.growth");
  settle();
  EXPECT_GT(panel_->listing().effects.size(), 10U) << "without any of one's own the built-in ones are used";
}

TEST_F(EffectsPanelTest, TheCampaignsOwnAreListedAndComeBack) {
  const std::filesystem::path campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth);
  folder_.write("campaign/effects.json", own_growth);
  folder_.write("campaign/campaign.json",
                R"({"format":"spindrift-campaign","version":1,"name":"small story","start_utc":"2026-03-01T08:00:00Z",)"
                R"("simulation":"simulation.csv","effects":"effects.json"})");
  open(campaign, StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  page_->showEffects(true);
  panel_ = page_->effects();
  settle();
  ASSERT_EQ(panel_->listing().effects.size(), 2U);
  panel_->removeEffect("bed.slope");
  settle();
  EXPECT_EQ(panel_->listing().effects.size(), 1U);
  EXPECT_EQ(readFile(campaign / "effects.json"), own_growth) << "the folder is never written to";
  // The edited ones come back with the session.
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(session);
  wait();
  window_->workflow().goTo(StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  page_->showEffects(true);
  panel_ = page_->effects();
  settle();
  EXPECT_EQ(panel_->listing().effects.size(), 1U);
  for (auto* button : panel_->findChildren<QPushButton*>()) {
    if (button->accessibleName() == QLatin1String("Back to the campaign's")) {
      ASSERT_TRUE(button->isVisible());
      QTest::mouseClick(button, Qt::LeftButton);
    }
  }
  settle();
  EXPECT_EQ(panel_->listing().effects.size(), 2U);
}

// A mount: its third axis is two degrees long beside two hundred, and refraction has no value at the horizon.
TEST(EffectPicture, ShortAxesAndPolesAreDrawn) {
  const auto own = OwnEffects::parse(R"({"format":"spindrift-effects","version":1,"effects":[
    {"id":"mount.refraction","shape":[{"gain_unit":"urad","EA":"tan(y*_pi/180) "}]},
    {"id":"mount.zero","shape":[{"gain_unit":"urad","EB":"0*x"}]}]})",
                                     "effects.json");
  const MachineDescription machine = MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"mount","chain":"V [w-X'-Y'-b-Z-t]","axes":[
        {"name":"X","travel_mm":[-180,180]},{"name":"Y","travel_mm":[-90,90]},{"name":"Z","travel_mm":[-1,1]}]})",
                      "machine.json"),
      "machine.json");
  EffectPicture picture;
  picture.resize(500, 300);
  const auto show = [&](std::size_t which) {
    picture.show(own->effects()[which].effect, machine);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !picture.busy(); }, 10'000));
  };
  show(0);
  ASSERT_FALSE(picture.empty());
  EXPECT_TRUE(picture.shape()->rotations);
  EXPECT_GT(picture.shape()->largest, 1.0);
  EXPECT_LT(picture.shape()->largest, 1e4);
  EXPECT_FALSE(picture.grab().isNull());
  const testing::TempFolder folder;
  picture.exportTo(QString::fromStdString((folder / "shape.svg").string()));
  EXPECT_NE(readFile(folder / "shape.svg").find("<svg"), std::string::npos);
  show(1);
  EXPECT_TRUE(picture.empty());
}

}  // namespace
}  // namespace spindrift::gui
