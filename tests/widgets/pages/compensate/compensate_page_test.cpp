// SPDX-License-Identifier: GPL-3.0-or-later
// The compensation page in the real window: from a completed model to files, with the signs of FORMATS.md.
#include "widgets/pages/compensate/compensate_page.h"

#include <fmt/format.h>

#include <QComboBox>
#include <QFile>
#include <QPushButton>
#include <QTableView>
#include <QTest>
#include <filesystem>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/tasks/task_options.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

class CompensatePageTest : public StoryTest {
 protected:
  void addGrowth() {
    open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Compensate);
    EXPECT_EQ(window_->workflow().status(StepId::Compensate).state, StepState::Blocked);
    EXPECT_FALSE(window_->currentPage()->primaryButton()->isEnabled());
    window_->workflow().goTo(StepId::Discrepancy);
    auto* discrepancy = page<DiscrepancyPage>();
    discrepancy->runAll();
    wait();
    QTest::mouseClick(discrepancy->addButton(), Qt::LeftButton);
    wait();
    window_->workflow().goTo(StepId::Compensate);
    page_ = page<CompensatePage>();
    ASSERT_NE(page_, nullptr);
  }
  /// Goes to the page and lets it work out the corrections.
  void workOut() {
    window_->workflow().goTo(StepId::Compensate);
    page_ = page<CompensatePage>();
    page_->runAll();
    wait();
    ASSERT_NE(page_->plan(), nullptr) << page_->callout()->sentence().toStdString();
  }
  CompensatePage* page_ = nullptr;
};

TEST_F(CompensatePageTest, CorrectsWhatWasMeasuredAndWritesFiles) {
  addGrowth();
  EXPECT_EQ(window_->workflow().status(StepId::Compensate).state, StepState::NotStarted);
  QTest::mouseClick(page_->primaryButton(), Qt::LeftButton);
  wait();
  ASSERT_NE(page_->plan(), nullptr) << page_->callout()->sentence().toStdString();
  EXPECT_EQ(window_->workflow().status(StepId::Compensate).state, StepState::Attention);
  // State M10, in the middle of the run: growth of 9 um (1 - exp(-(12000 - 1800) / 2400)).
  page_->stateBox()->setCurrentIndex(page_->stateBox()->findText(QStringLiteral("M10")));
  Q_EMIT page_->stateBox()->activated(page_->stateBox()->currentIndex());
  wait();
  const CompensationPlan& plan = *page_->plan();
  EXPECT_EQ(plan.state, "M10");
  ASSERT_EQ(plan.points.size(), 6U);
  const double growth = 9.0 * (1.0 - std::exp(-(12030.0 - 1800.0) / 2400.0));
  for (const CompensationPoint& p : plan.points) {
    EXPECT_NEAR(p.correction_um.z(), -growth, 0.5) << p.point;  // compensation = -deviation
    EXPECT_GT(p.sigma_um.z(), 0.0);
    EXPECT_LT(std::abs(*p.remains_um[2]), 5 * 0.4);
  }
  EXPECT_GT(plan.rms_before_um, 3.0);
  EXPECT_LT(plan.rms_after_um, 0.8);
  EXPECT_EQ(page_->view()->arrows().size(), 6U);
  EXPECT_EQ(page_->pointTable()->model()->rowCount(), 6);

  const QString folder = QString::fromStdString((folder_ / "control").string());
  page_->exportFiles(folder);
  EXPECT_EQ(page_->callout()->tone(), Tone::Good) << page_->callout()->sentence().toStdString();
  for (const CompensationFile& f : plan.files) {
    EXPECT_EQ(readFile(folder_ / "control" / f.name), f.content);
    EXPECT_FALSE(f.convention.empty());
  }
  // The grid holds corrections (minus the deviation) ...
  std::istringstream grid(readFile(folder_ / "control" / "compensation_grid.csv"));
  std::string line;
  int rows = 0;
  while (std::getline(grid, line)) {
    if (line.empty() || line[0] == '#' || line[0] == 'x') continue;
    std::vector<double> v;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) v.push_back(std::stod(field));
    ASSERT_EQ(v.size(), 10U);  // the last says whether it is extrapolated
    EXPECT_NEAR(v[5], -growth, 0.5);
    ++rows;
  }
  EXPECT_EQ(rows, 11 * 11 * 11);
  // ... the screw table of Z where the axis really is, in mm.
  std::istringstream screw(readFile(folder_ / "control" / "linuxcnc_Z.comp"));
  double nominal = 0.0;
  double forward = 0.0;
  double reverse = 0.0;
  screw >> nominal >> forward >> reverse;
  EXPECT_NEAR(forward - nominal, growth * 1e-3, 5e-4);
  EXPECT_EQ(forward, reverse);
  // A table as simulation knows only its points: the page says what the grid holds.
  EXPECT_FALSE(plan.limitation.empty());

  // What does not hold any more is not given to the machine.
  const Observation one = window_->session().observations()->rows.back();
  window_->undoStack().push(new ExcludeCommand(
      window_->session(),
      {QString::fromStdString(fmt::format("{}/{}/{}", one.state, one.point, toString(one.component)))},
      QStringLiteral("test")));
  wait();
  EXPECT_EQ(page_->callout()->tone(), Tone::Outdated);
  const QString late = QString::fromStdString((folder_ / "late").string());
  page_->exportFiles(late);
  EXPECT_EQ(page_->callout()->tone(), Tone::Outdated) << page_->callout()->sentence().toStdString();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "late"));
  window_->undoStack().undo();
  wait();
  page_->exportFiles(late);
  EXPECT_EQ(page_->callout()->tone(), Tone::Good) << page_->callout()->sentence().toStdString();
}

TEST_F(CompensatePageTest, FanucDirectionIsStatedKeptAndUndone) {
  addGrowth();
  page_->runAll();
  wait();
  QComboBox* box = page_->fanucBox();
  EXPECT_EQ(box->currentData().toInt(), -1) << "nobody has tried it";
  EXPECT_FALSE(page_->plan()->not_written.empty());
  box->setCurrentIndex(box->findData(static_cast<int>(FanucStep::Negative)));
  Q_EMIT box->activated(box->currentIndex());
  wait();
  page_->runAll();
  wait();
  EXPECT_TRUE(page_->plan()->not_written.empty());
  window_->undoStack().undo();
  wait();
  EXPECT_EQ(box->currentData().toInt(), -1);
}

TEST_F(CompensatePageTest, TurnsOutdatedWhenTheModelChangesAndComesBackWithUndo) {
  addGrowth();
  page_->runAll();
  wait();
  EXPECT_EQ(window_->workflow().status(StepId::Compensate).state, StepState::Attention);
  window_->workflow().goTo(StepId::Discrepancy);
  window_->undoStack().undo();  // take the effect out again
  wait();
  EXPECT_EQ(window_->workflow().status(StepId::Compensate).state, StepState::Blocked);
  window_->undoStack().redo();
  wait();
  EXPECT_EQ(window_->workflow().status(StepId::Compensate).state, StepState::Attention);
}

TEST_F(CompensatePageTest, NineParametersOfAStateCompensateToo) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Model);
  window_->session().setSetting("nine-parameter", {{"state", "M17"}});
  window_->currentPage()->runAll();
  wait();
  ASSERT_NO_FATAL_FAILURE(workOut());
  EXPECT_TRUE(page_->plan()->limitation.empty());
  EXPECT_EQ(page_->plan()->reference, "state M0");
  EXPECT_EQ(page_->plan()->state, "M17") << "the state that was fitted";
}

TEST_F(CompensatePageTest, WhyItFailedIsSaidWhenThePageIsOpenedAgainUntilItMayWork) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Model);
  window_->currentPage()->runAll();
  wait();
  const std::string key = window_->session().campaignKey(option_keys::compensation);
  window_->session().setSetting(key, {{"state", "M99"}});
  window_->workflow().goTo(StepId::Compensate);
  page_ = page<CompensatePage>();
  page_->runAll();
  wait();
  const QString why = page_->callout()->sentence();
  ASSERT_EQ(window_->workflow().status(StepId::Compensate).state, StepState::Attention) << why.toStdString();
  EXPECT_TRUE(why.contains(QStringLiteral("M99"))) << why.toStdString();
  window_->workflow().goTo(StepId::Model);
  wait();
  window_->workflow().goTo(StepId::Compensate);
  wait();
  EXPECT_EQ(page<CompensatePage>()->callout()->sentence(), why);
  window_->session().setSetting(key, {{"state", "M17"}});
  window_->workflow().goTo(StepId::Model);
  wait();
  window_->workflow().goTo(StepId::Compensate);
  wait();
  EXPECT_NE(page<CompensatePage>()->callout()->sentence(), why) << "with another state it may work";
}

TEST_F(CompensatePageTest, TheWarmestStateIsChosenFirst) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Model);
  window_->currentPage()->runAll();
  wait();
  ASSERT_NO_FATAL_FAILURE(workOut());
  const std::string warmest = warmestState(*window_->session().observations());
  EXPECT_EQ(page_->plan()->state, warmest);
  EXPECT_NE(warmest, "M23") << "the spindle has cooled down by then";
  bool shown = false;
  for (const QComboBox* box : page_->findChildren<QComboBox*>()) shown |= box->currentText().toStdString() == warmest;
  EXPECT_TRUE(shown);
}

TEST(WarmestState, IsTheOneFurthestFromTheFirst) {
  ObservationSet set;
  const auto add = [&](const char* state, const char* point, double value, ObservationUse use = ObservationUse::Fit) {
    Observation o;
    o.state = state;
    o.point = point;
    o.component = Component::EZ;
    o.value = value;
    o.sigma = 0.5;
    o.use = use;
    set.rows.push_back(o);
  };
  EXPECT_EQ(warmestState(set), "");
  add("M0", "P1", 100.0);
  EXPECT_EQ(warmestState(set), "M0");
  add("M0", "P2", 0.0);
  for (const char* point : {"P1", "P2"}) {
    const double zero = std::string(point) == "P1" ? 100.0 : 0.0;
    add("M1", point, zero - 9.0);
    add("M2", point, zero + 3.0);
    add("M3", point, zero + 20.0, ObservationUse::Exclude);
    add("M4", point, zero + 30.0, ObservationUse::Holdout);
  }
  EXPECT_EQ(warmestState(set), "M1");
}

TEST(PlanCompensation, RefusesWhatCannotBe) {
  const testing::TempFolder folder;
  const Campaign campaign = Campaign::read(writeStoryCampaign(folder, Hidden::Nothing));
  JobContext job;
  CompensationRequest request;
  request.source = CompensationSource::CompletedModel;
  EXPECT_THROW((void)planCompensation(campaign, *campaign.observations, request, job), InputError);
  request.source = CompensationSource::NineParameters;
  request.state = "M99";
  EXPECT_THROW((void)planCompensation(campaign, *campaign.observations, request, job), InputError);
  request.state.clear();
  request.positions = 1;
  EXPECT_THROW((void)planCompensation(campaign, *campaign.observations, request, job), InputError);
}

}  // namespace
}  // namespace spindrift::gui
