// SPDX-License-Identifier: GPL-3.0-or-later
// The editor of artefacts and styli in the real window.
#include <QLineEdit>
#include <QTabWidget>
#include <QTableWidget>

#include "tests/core/probing/probing_machines.h"
#include "tests/widgets/support/page_test.h"
#include "tests/widgets/support/select_campaign.h"
#include "widgets/common/parts.h"
#include "widgets/pages/machine/machine_page.h"
#include "widgets/panels/machine/artefact_editor.h"
#include "widgets/panels/machine/artefact_fields.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

class ArtefactEditorTest : public PageTest {
 protected:
  ArtefactEditor* editor(const std::string& machine) {
    auto session = std::make_unique<Session>(Session::create(folder_ / "session"));
    const std::int64_t id = session->newCampaign("new", "2026-01-31T08:00:00Z", machine);
    window_->session().adopt(std::move(session), id);
    auto* page = go<MachinePage>(StepId::Machine);
    page->findChild<QTabWidget*>(QStringLiteral("machineTabs"))->setCurrentIndex(1);
    return page->artefacts();
  }
  static void type(QLineEdit* edit, const char* text) {
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, QString::fromLatin1(text));
    QTest::keyClick(edit, Qt::Key_Return);
  }
};

TEST_F(ArtefactEditorTest, ABarIsChangedSeenAppliedAndUndone) {
  ArtefactEditor* editor = this->editor(probing_test::holeMachineText());
  ASSERT_TRUE(editor->findings().empty()) << editor->findings().front().sentence;
  EXPECT_EQ(editor->fields()->features()->rowCount(), 7);
  EXPECT_EQ(editor->view()->points().size(), 7U);
  EXPECT_FALSE(editor->applyButton()->isEnabled());
  const Eigen::Vector3d before = editor->view()->points()[2].position_mm;
  editor->fields()->features()->item(2, 1)->setText(QStringLiteral("110.5"));
  EXPECT_NEAR((editor->view()->points()[2].position_mm - before).norm(), 9.5, 1e-9) << "the picture follows at once";
  type(editor->fields()->field("expansion_um_per_m_K"), "1.2");
  type(editor->fields()->field("material"), "Invar");
  type(editor->fields()->field("certificate_uncertainty_um"), "0.3");
  EXPECT_TRUE(editor->applyButton()->isEnabled()) << editor->verdict()->sentence().toStdString();
  QTest::mouseClick(editor->applyButton(), Qt::LeftButton);
  const Artefact& bar = window_->session().campaign()->machine.artefacts.front();
  EXPECT_DOUBLE_EQ(bar.nominal_positions_mm[2], 110.5);
  EXPECT_DOUBLE_EQ(*bar.expansion_um_per_m_K, 1.2);
  EXPECT_DOUBLE_EQ(*bar.certificate_uncertainty_um, 0.3);
  EXPECT_EQ(window_->session().campaign()->machine.source["artefacts"][0]["material"], "Invar");
  EXPECT_FALSE(editor->applyButton()->isEnabled());
  window_->undoStack().undo();
  EXPECT_DOUBLE_EQ(window_->session().campaign()->machine.artefacts.front().nominal_positions_mm[2], 101.0);
  // What is given away is a machine description that can be read.
  exportAll();
}

TEST_F(ArtefactEditorTest, WhatIsNotAppliedSurvivesPagesCampaignsAndSessions) {
  ArtefactEditor* editor = this->editor(probing_test::holeMachineText());
  const std::int64_t first = window_->session().campaignId();
  type(editor->fields()->field("material"), "Invar");
  editor->fields()->features()->item(2, 1)->setText(QStringLiteral("not a number"));
  const auto typed = [&] { return editor->fields()->features()->item(2, 1)->text(); };
  const auto material = [&] { return editor->fields()->field("material")->text(); };
  window_->workflow().goTo(StepId::WarmUp);
  window_->workflow().goTo(StepId::Machine);
  EXPECT_EQ(typed(), QStringLiteral("not a number"));
  EXPECT_EQ(material(), QStringLiteral("Invar"));
  EXPECT_TRUE(window_->session().campaign()->machine.artefacts.front().nominal_positions_mm.size() == 7U);

  const std::int64_t second =
      window_->session().session()->newCampaign("other", "2026-01-31T09:00:00Z", probing_test::holeMachineText());
  selectCampaign(window_->session(), second);
  window_->workflow().goTo(StepId::Machine);
  EXPECT_NE(typed(), QStringLiteral("not a number")) << "it belongs to the other campaign";
  EXPECT_FALSE(editor->applyButton()->isEnabled());
  selectCampaign(window_->session(), first);
  window_->workflow().goTo(StepId::Machine);
  EXPECT_EQ(typed(), QStringLiteral("not a number"));

  const QString folder = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(folder);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  window_->workflow().goTo(StepId::Machine);
  EXPECT_EQ(typed(), QStringLiteral("not a number"));
  EXPECT_EQ(material(), QStringLiteral("Invar"));
  editor->fields()->features()->item(2, 1)->setText(QStringLiteral("110.5"));
  QTest::mouseClick(editor->applyButton(), Qt::LeftButton);
  EXPECT_DOUBLE_EQ(window_->session().campaign()->machine.artefacts.front().nominal_positions_mm[2], 110.5);
  EXPECT_FALSE(editor->applyButton()->isEnabled()) << "applied: nothing is left to apply";
  // Every step is taken back as it was done: applied, typed.
  window_->undoStack().undo();
  EXPECT_DOUBLE_EQ(window_->session().campaign()->machine.artefacts.front().nominal_positions_mm[2], 101.0);
  EXPECT_EQ(typed(), QStringLiteral("110.5"));
  EXPECT_TRUE(editor->applyButton()->isEnabled());
  window_->undoStack().undo();
  EXPECT_EQ(typed(), QStringLiteral("not a number"));
  window_->undoStack().redo();
  window_->undoStack().redo();
  EXPECT_DOUBLE_EQ(window_->session().campaign()->machine.artefacts.front().nominal_positions_mm[2], 110.5);
  EXPECT_FALSE(editor->applyButton()->isEnabled());
}

TEST_F(ArtefactEditorTest, AWrongCellIsMarkedWithOneSentenceAndNothingIsApplied) {
  ArtefactEditor* editor = this->editor(probing_test::ballMachineText());
  ASSERT_TRUE(editor->findings().empty());
  EXPECT_EQ(editor->fields()->features()->item(1, 5)->text(), QStringLiteral("251.7936"));
  editor->fields()->features()->item(1, 3)->setText(QStringLiteral("thirty"));
  ASSERT_EQ(editor->findings().size(), 1U);
  EXPECT_EQ(editor->verdict()->tone(), Tone::Bad);
  EXPECT_TRUE(editor->verdict()->sentence().contains(QStringLiteral("\"thirty\"")));
  EXPECT_FALSE(editor->fields()->features()->item(1, 3)->toolTip().isEmpty());
  EXPECT_FALSE(editor->applyButton()->isEnabled());
  editor->fields()->features()->item(1, 3)->setText(QStringLiteral("30"));
  EXPECT_TRUE(editor->findings().empty());
  editor->styli()->item(2, 1)->setText(QStringLiteral("-2"));
  EXPECT_TRUE(editor->verdict()->sentence().contains(QStringLiteral("Stylus 3")));
  editor->styli()->item(2, 1)->setText(QStringLiteral("1.5"));
  QTest::mouseClick(editor->applyButton(), Qt::LeftButton);
  EXPECT_DOUBLE_EQ(window_->session().campaign()->machine.styli[2].radius_mm, 1.5);
}

TEST_F(ArtefactEditorTest, ANewArtefactIsMadeFromNothing) {
  ArtefactEditor* editor = this->editor(
      R"({"format":"spindrift-machine","version":1,"name":"bare","chain":"V [w-C2'-A'-X'-b-Y-Z-C1-t]",
"axes":[{"name":"X","travel_mm":[0,520]},{"name":"Y","travel_mm":[0,450]},{"name":"Z","travel_mm":[-60,400]}],
"rotary":[{"name":"C2","centre_mm":[251,203,-4]}]})");
  EXPECT_TRUE(editor->verdict()->sentence().contains(QStringLiteral("no artefact yet")));
  editor->addArtefact("balls");
  editor->addArtefact("hole_bar");
  EXPECT_TRUE(editor->findings().empty()) << editor->findings().front().sentence;
  QTest::mouseClick(editor->applyButton(), Qt::LeftButton);
  EXPECT_EQ(window_->session().campaign()->machine.artefacts.size(), 2U);
  EXPECT_EQ(window_->session().campaign()->machine.artefacts[1].nominal_positions_mm.size(), 3U);
}

}  // namespace
}  // namespace spindrift::gui
