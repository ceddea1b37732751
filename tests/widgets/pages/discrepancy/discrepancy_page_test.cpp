// SPDX-License-Identifier: GPL-3.0-or-later
// The discrepancy page in the real window: search, see the verdict, add, undo, look at every tab, export.
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/common/words.h"

#include <QComboBox>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTabWidget>
#include <QTableView>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/machine/observation.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/common/table_angle.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/gap_bars.h"
#include "widgets/panels/discrepancy/gap_panel.h"
#include "widgets/panels/discrepancy/next_panel.h"
#include "widgets/panels/discrepancy/noise_panel.h"
#include "widgets/panels/discrepancy/remainder_panel.h"
#include "widgets/panels/discrepancy/what_panel.h"
#include "widgets/panels/discrepancy/where_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/shell/help_panel.h"
#include "widgets/shell/tour.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

class DiscrepancyPageTest : public StoryTest {
 protected:
  /// `stated`: the sigma that the readings say they have, over what they scatter.
  void search(Hidden hidden, double stated = 1.0) {
    const std::filesystem::path campaign = writeStoryCampaign(folder_, hidden);
    ObservationSet readings = ObservationSet::read(campaign / "observations.csv");
    for (Observation& o : readings.rows) o.sigma *= stated;
    readings.write(campaign / "observations.csv");
    open(campaign, StepId::Discrepancy);
    page_ = page<DiscrepancyPage>();
    ASSERT_NE(page_, nullptr);
    EXPECT_EQ(state(), StepState::NotStarted);
    QTest::mouseClick(page_->primaryButton(), Qt::LeftButton);
    wait();
    ASSERT_NE(page_->story(), nullptr) << page_->callout()->sentence().toStdString();
    EXPECT_EQ(state(), hidden == Hidden::Oscillation ? StepState::Attention : StepState::Current);
  }
  [[nodiscard]] StepState state() const { return window_->workflow().status(StepId::Discrepancy).state; }
  [[nodiscard]] QString verdict() const { return page_->verdict()->text(); }
  DiscrepancyPage* page_ = nullptr;
};

TEST_F(DiscrepancyPageTest, NamesTheHiddenEffectAddsItAndUndoes) {
  search(Hidden::SpindleGrowth);
  EXPECT_TRUE(verdict().contains(QStringLiteral("growth of the spindle along Z"))) << verdict().toStdString();
  EXPECT_TRUE(verdict().startsWith(QStringLiteral("The simulation lacks")));
  const double before = page_->story()->gap.rms_before_um;
  EXPECT_TRUE(std::isnan(page_->story()->gap.rms_after_um)) << "nothing has been added yet";
  EXPECT_TRUE(page_->gap()->plot(true)->empty());
  EXPECT_FALSE(page_->removeButton()->isVisible());

  QTest::mouseClick(page_->addButton(), Qt::LeftButton);
  wait();
  ASSERT_EQ(page_->story()->added.size(), 1U);
  EXPECT_EQ(page_->story()->added.front(), "spindle.growth.z");
  EXPECT_TRUE(verdict().startsWith(QStringLiteral("With growth of the spindle"))) << verdict().toStdString();
  EXPECT_EQ(page_->tabs()->currentWidget(), page_->gap());
  // The gap closes down to the noise, also on what was held out. 6 um rms in one of three components.
  EXPECT_GT(before, 1.5);
  EXPECT_LT(page_->story()->gap.rms_after_um, 0.5);
  EXPECT_LT(page_->story()->gap.heldout_rms_after_um, 0.6);
  EXPECT_NEAR(page_->story()->gap.noise_um, 0.4, 0.08);
  const auto lines = page_->gap()->plot(true)->series();
  ASSERT_EQ(lines.size(), 2U);
  // What was measured stays where it is; only the line moves.
  EXPECT_EQ(lines[1].y, page_->gap()->plot(false)->series().at(1).y);
  EXPECT_NE(lines[0].y, page_->gap()->plot(false)->series().at(0).y);
  const QString figures = page_->gap()->bars()->accessibleDescription();
  EXPECT_EQ(figures.count(QStringLiteral("peak-to-peak")), 2) << figures.toStdString();
  EXPECT_EQ(figures.count(QStringLiteral("variation explained")), 2) << figures.toStdString();
  EXPECT_EQ(page_->gap()->view(false)->colourScale(), page_->gap()->view(true)->colourScale());
  // The maps are worked out beside the window.
  EXPECT_TRUE(QTest::qWaitFor([this] { return page_->gap()->view(true)->points().size() == 6U; }, 2000));
  // The map starts where the gap is largest; on the same scale there is hardly anything left of it afterwards.
  const auto largest = [&](bool after) {
    double value = 0.0;
    for (const ViewPoint& p : page_->gap()->view(after)->points())
      value = std::max(value, std::abs(p.value.value_or(0)));
    return value;
  };
  EXPECT_GT(largest(false), 4.0);
  EXPECT_LT(largest(true), 1.5);
  const double worst = largest(false);
  page_->gap()->moment()->setValue(page_->gap()->moment()->value() == 0 ? 1 : 0);
  EXPECT_TRUE(QTest::qWaitFor([&] { return largest(false) < worst; }, 2000)) << "worked out beside the window";
  EXPECT_FALSE(page_->addButton()->isVisible()) << "nothing more is proposed";

  EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("add growth of the spindle along Z"));
  window_->undoStack().undo();
  wait();
  EXPECT_TRUE(page_->story()->added.empty());
  EXPECT_TRUE(page_->gap()->plot(true)->empty());
  EXPECT_EQ(state(), StepState::Current);
  window_->undoStack().redo();
  wait();
  EXPECT_EQ(page_->story()->added.size(), 1U);
}

TEST_F(DiscrepancyPageTest, SentencesNameEffectsByTheirTitles) {
  EXPECT_EQ(titledSentence("not decided: heat_source.position.x and 3.5 of simulation.csv (spindle.growth.z)."),
            QStringLiteral("not decided: %1 and 3.5 of simulation.csv (growth of the spindle along Z).")
                .arg(effectTitle("heat_source.position.x")));
}

TEST_F(DiscrepancyPageTest, OfSeveralProposalsTheFirstIsMarked) {
  auto story = std::make_shared<DiscrepancyStory>();
  for (const char* id : {"ball_screw.expansion.z", "ball_screw.expansion.x", "spindle.drift.y"}) {
    FoundEffect e;
    e.id = id;
    story->effects.push_back(e);
  }
  WhatPanel panel;
  panel.show(story);
  EXPECT_EQ(panel.chosen(), "ball_screw.expansion.z");
  auto with_one = std::make_shared<DiscrepancyStory>(*story);
  with_one->effects.front().forced = true;
  WhatPanel other;
  other.show(with_one);
  EXPECT_EQ(other.chosen(), "ball_screw.expansion.x");
}

TEST_F(DiscrepancyPageTest, UndecidedIsNotSaidToBeOutsideTheCatalogue) {
  auto story = std::make_shared<DiscrepancyStory>();
  story->verdict = DiscrepancyVerdict::Unknown;
  story->decided = false;
  story->message = "10 observations leave too little; measure more states.";
  NextPanel panel;
  panel.show(story);
  QStringList texts;
  for (const QLabel* label : panel.findChildren<QLabel*>()) texts << label->text();
  EXPECT_TRUE(texts.join(QLatin1Char(' ')).contains(QStringLiteral("measure more states")));
  EXPECT_FALSE(texts.join(QLatin1Char(' ')).contains(QStringLiteral("No effect of the catalogue fits")));
}

TEST_F(DiscrepancyPageTest, TableViewAndPlotShowTheSamePlace) {
  search(Hidden::SpindleGrowth);
  WherePanel* where = page_->where();
  ASSERT_GT(where->placeTable()->model()->rowCount(), 0);
  EXPECT_EQ(where->component(), Component::EZ);
  EXPECT_FALSE(where->plot()->empty());
  const QString first = where->view()->selected();
  EXPECT_EQ(first.toStdString(), where->point());
  // Points coloured by excess: the growth of the spindle is the same for all of them.
  for (const ViewPoint& p : where->view()->points()) {
    EXPECT_GT(p.value.value(), 1.0) << p.id.toStdString();
    EXPECT_TRUE(p.used) << p.id.toStdString();
  }
  // From the table to view and plot.
  const QModelIndex row = where->pointTable()->model()->index(4, 0);
  where->pointTable()->scrollTo(row);
  QTest::mouseClick(where->pointTable()->viewport(), Qt::LeftButton, {}, where->pointTable()->visualRect(row).center());
  EXPECT_EQ(where->point(), "P5");
  EXPECT_EQ(where->view()->selected(), QStringLiteral("P5"));
  // From the view to the table: N picks the next point.
  QTest::keyClick(where->view(), Qt::Key_N);
  EXPECT_EQ(where->point(), "P6");
  EXPECT_EQ(where->pointTable()->currentIndex().data().toString(), QStringLiteral("P6"));
  // Adding the effect keeps the place and the point.
  QTest::mouseClick(page_->addButton(), Qt::LeftButton);
  wait();
  const auto holds_point = [&](const DisagreementPlace& p) {
    return p.component == Component::EZ && std::find(p.points.begin(), p.points.end(), "P6") != p.points.end();
  };
  const auto& places = page_->story()->where;
  const int place = where->placeTable()->currentIndex().row();
  if (std::any_of(places.begin(), places.end(), holds_point)) {
    ASSERT_GE(place, 0);
    EXPECT_TRUE(holds_point(places[static_cast<std::size_t>(place)]));
  }
  EXPECT_EQ(where->point(), "P6");
  EXPECT_EQ(where->plot()->series().size(), 3U) << "after adding beside before";
  window_->undoStack().undo();
  wait();
  // Residuals over time: the noise band and one value a state.
  const auto series = where->plot()->series();
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[1].x.size(), 24U);
}

TEST_F(DiscrepancyPageTest, SaysUnknownWithoutAName) {
  search(Hidden::Oscillation);
  EXPECT_EQ(page_->story()->verdict, DiscrepancyVerdict::Unknown);
  EXPECT_TRUE(verdict().contains(QStringLiteral("no effect of the catalogue explains"))) << verdict().toStdString();
  EXPECT_FALSE(page_->addButton()->isVisible());
  EXPECT_TRUE(page_->story()->effects.empty());
}

TEST_F(DiscrepancyPageTest, SaysNoneWhereNothingIsMissing) {
  search(Hidden::Nothing);
  EXPECT_EQ(page_->story()->verdict, DiscrepancyVerdict::None);
  EXPECT_EQ(verdict(), QStringLiteral("Measured and simulated agree within the noise."));
  EXPECT_EQ(page_->where()->placeTable()->model()->rowCount(), 0);
}

TEST_F(DiscrepancyPageTest, NothingMissingInReadingsThatScatterFarMoreThanTheyStateIsNoGoodNews) {
  search(Hidden::Nothing, 0.1);
  EXPECT_EQ(page_->story()->verdict, DiscrepancyVerdict::None);
  EXPECT_EQ(verdict(), QStringLiteral("Nothing stands out of the scatter of the readings, which is large."));
  QStringList texts;
  for (const QLabel* label : page_->findChildren<QLabel*>()) texts << label->text();
  EXPECT_TRUE(
      texts.join(QLatin1Char('|')).contains(QStringLiteral(" times as much as their stated σ: what is smaller")))
      << texts.join(QLatin1Char('|')).toStdString();
}

TEST_F(DiscrepancyPageTest, LeavingAnEffectOutSearchesAgainWithoutIt) {
  search(Hidden::SpindleGrowth);
  page_->tabs()->setCurrentWidget(page_->what());
  EXPECT_EQ(page_->what()->chosen(), "spindle.growth.z");
  QTest::mouseClick(page_->what()->rejectButton(), Qt::LeftButton);
  wait();
  for (const FoundEffect& e : page_->story()->effects) EXPECT_NE(e.id, "spindle.growth.z");
  window_->undoStack().undo();
  wait();
  EXPECT_TRUE(verdict().contains(QStringLiteral("growth of the spindle along Z")));
}

TEST_F(DiscrepancyPageTest, TurnsOutdatedAndComesBackAfterReopening) {
  search(Hidden::SpindleGrowth);
  QTest::mouseClick(page_->addButton(), Qt::LeftButton);
  wait();
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QStringLiteral("M3/P2/EX")}, QStringLiteral("chip on the ball")));
  EXPECT_EQ(state(), StepState::Outdated);
  QTest::qWait(20);
  EXPECT_EQ(page_->callout()->tone(), Tone::Outdated);
  window_->undoStack().undo();
  EXPECT_EQ(state(), StepState::Current);
  const QString before = verdict();
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(session);
  wait();
  window_->workflow().goTo(StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  EXPECT_EQ(state(), StepState::Current);
  EXPECT_EQ(verdict(), before);
  EXPECT_FALSE(page_->gap()->plot(true)->empty());
}

TEST_F(DiscrepancyPageTest, AnOutlyingReadingIsLookedAtExcludedAndBroughtBack) {
  const std::filesystem::path campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth);
  ObservationSet set = ObservationSet::read(campaign / "observations.csv");
  const auto spoiled = std::find_if(set.rows.begin(), set.rows.end(), [](const Observation& o) {
    return o.state == "M9" && o.point == "P4" && o.component == Component::EY;
  });
  ASSERT_NE(spoiled, set.rows.end());
  spoiled->value += 8.0;  // 20 sigma
  set.write(campaign / "observations.csv");
  open(campaign, StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  page_->runAll();
  wait();
  ASSERT_NE(page_->story(), nullptr) << page_->callout()->sentence().toStdString();
  ASSERT_EQ(page_->story()->outliers.size(), 1U);
  const OutlyingObservation& outlier = page_->story()->outliers.front();
  EXPECT_EQ(outlier.row, static_cast<std::size_t>(spoiled - set.rows.begin()));
  EXPECT_EQ(outlier.state, "M9");
  EXPECT_EQ(outlier.point, "P4");
  EXPECT_EQ(outlier.component, Component::EY);
  EXPECT_GT(outlier.deviation, 5.0);

  NoisePanel* noise = page_->noise();
  page_->tabs()->setCurrentWidget(noise);
  noise->showReadings(true);
  ASSERT_EQ(noise->readingTable()->model()->rowCount(), 1);
  EXPECT_EQ(noise->chosenItems(), QStringList{QStringLiteral("M9/P4/EY")});
  EXPECT_FALSE(noise->readingPlot()->empty());
  EXPECT_TRUE(noise->readingPlot()->moment().has_value());
  EXPECT_EQ(page_->where()->point(), "P4") << "the other tabs show its series";
  EXPECT_EQ(page_->remainder()->component(), Component::EY);

  page_->excludeReadings(QStringLiteral("chip on the ball"));
  EXPECT_EQ(state(), StepState::Outdated);
  wait();
  EXPECT_TRUE(noise->chosenAreExcluded());
  EXPECT_TRUE(noise->excludeButton()->text().contains(QStringLiteral("Bring back")));
  page_->runAll();
  wait();
  EXPECT_TRUE(page_->story()->outliers.empty());
  ASSERT_EQ(noise->readingTable()->model()->rowCount(), 1) << "it is listed still, or nobody could bring it back";
  noise->readingTable()->selectRow(0);
  QTest::mouseClick(noise->excludeButton(), Qt::LeftButton);
  EXPECT_TRUE(window_->session().excluded().empty());
  window_->undoStack().undo();
  EXPECT_EQ(window_->session().excluded().size(), 1U);
}

TEST_F(DiscrepancyPageTest, NoiseAndRemainderAreShownForEveryComponent) {
  search(Hidden::SpindleGrowth);
  ASSERT_EQ(page_->noise()->noiseTable()->model()->rowCount(), 3);
  EXPECT_TRUE(page_->noise()->facts()->text().contains(QStringLiteral("Clock")));
  ASSERT_EQ(page_->remainder()->componentTable()->model()->rowCount(), 3);
  EXPECT_FALSE(page_->remainder()->plot()->empty());
  const QAbstractItemModel* candidates = page_->what()->candidateTable()->model();
  ASSERT_GT(candidates->rowCount(), 0);
  EXPECT_LE(candidates->rowCount(), 10);
  ASSERT_FALSE(page_->story()->effects.empty());
  const QString named = sentenceStart(effectTitle(page_->story()->effects.front().id));
  bool marked = false;
  for (int row = 0; row < candidates->rowCount(); ++row) {
    if (candidates->index(row, 0).data().toString() != named) continue;
    marked = candidates->index(row, 2).data().toString() == QStringLiteral("named");
  }
  EXPECT_TRUE(marked) << named.toStdString() << " is not marked among the candidates";
}

TEST_F(DiscrepancyPageTest, AnotherSessionShowsItsOwnStory) {
  search(Hidden::SpindleGrowth);
  const QString before = verdict();
  // The other session has a result with the same id.
  const testing::TempFolder other;
  window_->open(QString::fromStdString(writeStoryCampaign(other, Hidden::Nothing).string()));
  wait();
  window_->workflow().goTo(StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  EXPECT_EQ(page_->story(), nullptr);
  page_->runAll();
  wait();
  EXPECT_EQ(verdict(), QStringLiteral("Measured and simulated agree within the noise."));
  EXPECT_NE(verdict(), before);
}

TEST_F(DiscrepancyPageTest, CancelLeavesEverythingAsItWas) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  page_->runAll();
  window_->jobs().cancel();
  wait();
  EXPECT_EQ(page_->story(), nullptr);
  EXPECT_EQ(state(), StepState::NotStarted);
  EXPECT_TRUE(page_->primaryButton()->isEnabled());
}

TEST_F(DiscrepancyPageTest, SaysWhatIsMissingWithoutASimulation) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth, false), StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  ASSERT_NE(page_, nullptr);
  EXPECT_FALSE(page_->primaryButton()->isEnabled());
  EXPECT_EQ(state(), StepState::Blocked);
  bool said = false;
  for (const QLabel* label : page_->findChildren<QLabel*>()) {
    said = said || (label->isVisible() && label->text().contains(QStringLiteral("simulation.csv")));
  }
  EXPECT_TRUE(said);
}

TEST_F(DiscrepancyPageTest, AClickSelectsTheSameEverywhere) {
  search(Hidden::SpindleGrowth);
  ASSERT_FALSE(page_->story()->where.empty());
  // A value in the plot of the gap: the machine is shown at its time, and the other tab marks it.
  page_->tabs()->setCurrentWidget(page_->gap());
  wait();
  Plot* plot = page_->gap()->plot(false);
  const Series& measured = plot->series()[1];
  const std::size_t at = measured.x.size() / 2;
  const QPoint pixel = plot->pixelOf(measured.x[at], measured.y[at]).toPoint();
  page_->gap()->moment()->setValue(0);
  QTest::mouseClick(plot->childAt(pixel), Qt::LeftButton, {}, pixel);
  EXPECT_EQ(page_->gap()->moment()->value(), static_cast<int>(at));
  ASSERT_TRUE(plot->moment().has_value());
  EXPECT_NEAR(*plot->moment(), measured.x[at], 0.1);
  ASSERT_TRUE(page_->where()->plot()->moment().has_value());
  EXPECT_NEAR(*page_->where()->plot()->moment(), *plot->moment(), 1e-9);
  // Nothing near: nothing happens.
  QTest::mouseClick(plot->childAt(pixel), Qt::LeftButton, {}, QPoint(2, 2));
  EXPECT_EQ(page_->gap()->moment()->value(), static_cast<int>(at));

  // A point on the machine of the gap: the tables follow.
  Q_EMIT page_->gap()->view(false)->pointPicked(QStringLiteral("P3"));
  EXPECT_EQ(page_->where()->point(), "P3");
  const QModelIndex row = page_->where()->pointTable()->currentIndex();
  EXPECT_EQ(row.siblingAtColumn(0).data().toString(), QStringLiteral("P3"));
  EXPECT_EQ(page_->where()->view()->selected(), QStringLiteral("P3"));

  // And the other way round: a row of the table, then a place.
  page_->tabs()->setCurrentWidget(page_->where());
  wait();
  page_->where()->pointTable()->selectRow(1);
  EXPECT_EQ(page_->gap()->point(), page_->where()->point());
  const int last = page_->gap()->moment()->maximum();
  page_->gap()->moment()->setValue(last);
  page_->where()->placeTable()->clearSelection();
  page_->where()->placeTable()->setCurrentIndex({});
  page_->where()->placeTable()->selectRow(0);
  const DisagreementPlace& place = page_->story()->where.front();
  ASSERT_TRUE(page_->where()->plot()->moment().has_value());
  const double time_s = *page_->where()->plot()->moment() * timeUnit(28800.0).seconds;
  EXPECT_GE(time_s, place.from_s - 1300.0);
  EXPECT_LE(time_s, place.to_s + 1300.0);
  EXPECT_LT(page_->gap()->moment()->value(), last);
  page_->tabs()->setCurrentWidget(page_->gap());
  wait();
  EXPECT_EQ(page_->gap()->view(false)->selected().toStdString(), page_->where()->point());
  EXPECT_NEAR(*page_->gap()->plot(false)->moment(), *page_->where()->plot()->moment(), 1e-9);
}

TEST_F(DiscrepancyPageTest, ExportsPicturesAndTables) {
  search(Hidden::SpindleGrowth);
  QTest::mouseClick(page_->addButton(), Qt::LeftButton);
  wait();
  const auto items = page_->exportables();
  EXPECT_GE(items.size(), 12U);
  const QString folder = QString::fromStdString((folder_ / "out").string());
  std::filesystem::create_directories(folder_ / "out");
  for (const Exportable& item : items) {
    const QString file = folder + QLatin1Char('/') + fileNameOf(item.name) + QLatin1Char('.') + item.formats.front();
    item.write(file);
    EXPECT_GT(QFileInfo(file).size(), 20) << file.toStdString();
  }
}

TEST_F(DiscrepancyPageTest, ShowsOneSideOfTheGapWhereBothHaveNoRoom) {
  search(Hidden::SpindleGrowth);
  QTest::mouseClick(page_->addButton(), Qt::LeftButton);
  wait();
  GapPanel* gap = page_->gap();
  page_->tabs()->setCurrentWidget(gap);
  window_->resize(1920, 1080);
  QTest::qWait(50);
  EXPECT_FALSE(gap->sides()->isVisible());
  EXPECT_TRUE(gap->plot(false)->isVisible());
  EXPECT_TRUE(gap->plot(true)->isVisible());
  window_->resize(1280, 800);
  if (!window_->help()->isVisible()) window_->helpAction()->trigger();
  QTest::qWait(50);
  ASSERT_TRUE(gap->sides()->isVisible());
  EXPECT_LE(gap->minimumSizeHint().width(), gap->width());
  for (const int side : {0, 1}) {
    gap->sides()->setCurrent(side);
    Q_EMIT gap->sides()->chosen(side);
    QTest::qWait(20);
    EXPECT_EQ(gap->plot(false)->isVisible() || gap->view(false)->isVisible(), side == 0);
    EXPECT_EQ(gap->plot(true)->isVisible() || gap->view(true)->isVisible(), side == 1);
  }
  if (const QString folder = qEnvironmentVariable("SPINDRIFT_PICTURES"); !folder.isEmpty())
    window_->grab().save(folder + QStringLiteral("/gap_one_side.png"));
}

/// EX of P1 ... P3 six times, with the table at 0° and at 90° in turn: 1 um there, 5 um here.
std::shared_ptr<DiscrepancyStory> storyAtTwoAngles() {
  auto story = std::make_shared<DiscrepancyStory>();
  for (int p = 0; p < 3; ++p) {
    DiscrepancySeries s;
    s.point = "P" + std::to_string(p + 1);
    s.component = Component::EX;
    const Eigen::Vector3d at(100.0 + 50.0 * (p % 2), 100.0 + 50.0 * (p / 2), 0.0);
    s.places = {{0.0, at}, {90.0, {-at.y(), at.x(), 0.0}}};
    for (int i = 0; i < 6; ++i) {
      s.place.push_back(static_cast<std::size_t>(i % 2));
      s.time_s.push_back(600.0 * i);
      s.value.push_back(i % 2 == 0 ? 1.0 : 5.0);
      s.simulated.push_back(0.0);
      s.held_out.push_back(false);
    }
    s.noise = 0.2;
    story->series.push_back(s);
  }
  return story;
}

TEST(GapPanelTest, ShowsWhatWasMeasuredAtOneAngleOfTheTable) {
  const auto story = storyAtTwoAngles();
  const MachineDescription machine;
  GapPanel panel;
  panel.resize(1400, 800);
  panel.setVisible(true);
  panel.show(story, &machine);
  const auto measured = [&] { return panel.plot(false)->series().at(1).y; };
  const auto shown = [&] {
    QStringList titles;
    for (const QLabel* label : panel.findChildren<QLabel*>()) titles << label->text();
    return titles.join(QLatin1Char('|'));
  };
  ASSERT_EQ(panel.moment()->maximum(), 5) << "three moments at each angle";
  EXPECT_EQ(panel.moment()->value(), 1) << "where most is left";
  EXPECT_EQ(measured(), std::vector<double>(3, 5.0));
  EXPECT_TRUE(shown().contains(QString::fromUtf8("table at 90°"))) << shown().toStdString();
  panel.moment()->setValue(0);
  EXPECT_EQ(measured(), std::vector<double>(3, 1.0));
  EXPECT_TRUE(shown().contains(QString::fromUtf8("table at 0°"))) << shown().toStdString();
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const std::vector<ViewPoint>& points = panel.view(false)->points();
        return points.size() == 3U && points.front().position_mm.x() > 0.0 && points.front().value == 1.0;
      },
      2000));
}

TEST(WherePanelTest, ShowsWhatWasMeasuredAtOneAngleOfTheTable) {
  const auto story = storyAtTwoAngles();
  for (DiscrepancySeries& s : story->series) {
    // As the mean over both angles: where no point ever stood.
    s.position_mm = 0.5 * (s.places[0].position_mm + s.places[1].position_mm);
    s.rms_before = s.excess_before = std::sqrt(13.0);
    s.significant = true;
  }
  DisagreementPlace place;
  place.component = Component::EX;
  place.points = {"P1", "P2", "P3"};
  place.to_s = 3000.0;
  place.excess_um = 3.6;
  story->where = {place};
  const MachineDescription machine;
  WherePanel panel;
  panel.resize(1400, 800);
  panel.setVisible(true);
  panel.show(story, &machine);
  ASSERT_TRUE(panel.angleChoice()->isVisible());
  const auto excess = [&] { return panel.pointTable()->model()->index(0, 4).data().toString().toDouble(); };
  EXPECT_EQ(panel.angleChoice()->chosen(), 90.0) << "the place shows most there";
  EXPECT_LT(panel.view()->points().front().position_mm.x(), 0.0) << "turned with the table";
  EXPECT_NEAR(*panel.view()->points().front().value, 5.0, 0.01);
  EXPECT_EQ(panel.plot()->series().at(1).y, std::vector<double>(3, 5.0));
  EXPECT_NEAR(excess(), 5.0, 0.06);
  panel.angleChoice()->setCurrentIndex(0);
  Q_EMIT panel.angleChoice()->activated(0);
  EXPECT_EQ(panel.view()->points().front().position_mm, story->series.front().places.front().position_mm);
  EXPECT_NEAR(*panel.view()->points().front().value, std::sqrt(1.0 - 0.04), 0.01);
  EXPECT_EQ(panel.plot()->series().at(1).y, std::vector<double>(3, 1.0));
  EXPECT_NEAR(excess(), 1.0, 0.06);
  QStringList titles;
  for (const QLabel* label : panel.findChildren<QLabel*>()) titles << label->text();
  EXPECT_EQ(titles.filter(QString::fromUtf8("table at 0°")).size(), 2) << titles.join('|').toStdString();
}

TEST(RemainderPanelTest, DrawsWhatWasMeasuredAtOneAngleOfTheTable) {
  const auto story = storyAtTwoAngles();
  for (DiscrepancySeries& s : story->series) s.explained = s.remaining = s.value;
  RemainderPanel remainder;
  remainder.show(story);
  WhatPanel what;
  what.show(story);
  what.choose("P1", Component::EX);
  for (const Plot* plot : {remainder.plot(), what.findChild<Plot*>()}) {
    for (const Series& line : plot->series()) {
      if (line.style != SeriesStyle::Points && line.colour != 0) continue;
      EXPECT_EQ(line.y, std::vector<double>(3, 5.0)) << line.name.toStdString();
    }
  }
}

TEST(DiscrepancyStoryTest, ReadsBackWhatItWrote) {
  const testing::TempFolder folder;
  const Campaign campaign = Campaign::read(writeStoryCampaign(folder, Hidden::SpindleGrowth));
  DiscrepancyOptions options;
  options.accept = {"spindle.growth.z"};
  JobContext job;
  const DiscrepancyStory story = tellDiscrepancy(campaign, *campaign.observations, options, job);
  const DiscrepancyStory again = DiscrepancyStory::parse(story.json());
  EXPECT_EQ(again.json(), story.json());
  EXPECT_EQ(again.series.size(), 18U);
  EXPECT_THROW((void)DiscrepancyStory::parse({{"format", "else"}}), InputError);
  // Constants make residuals zero in the mean over the rows that were fitted.
  const DiscrepancySeries* s = again.find("P2", Component::EZ);
  ASSERT_NE(s, nullptr);
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < s->value.size(); ++i) {
    if (s->held_out[i]) continue;
    before += s->value[i] - s->simulated[i] - s->constant_before;
    after += s->value[i] - s->completed[i] - s->constant_after;
  }
  EXPECT_NEAR(before, 0.0, 1e-9);
  EXPECT_NEAR(after / 18.0, 0.0, 1e-6);
}

TEST(DiscrepancyStoryTest, ReadsStoriesThatDidNotKeepTheRemainder) {
  const testing::TempFolder folder;
  const Campaign campaign = Campaign::read(writeStoryCampaign(folder, Hidden::Oscillation));
  JobContext job;
  const DiscrepancyStory story = tellDiscrepancy(campaign, *campaign.observations, {}, job);
  ASSERT_FALSE(story.series.front().remaining.empty());
  nlohmann::json json = story.json();
  EXPECT_EQ(DiscrepancyStory::parse(json).json(), json);
  json.erase("outliers");
  for (nlohmann::json& s : json["series"]) s.erase("remaining");
  const DiscrepancyStory old = DiscrepancyStory::parse(json);
  EXPECT_TRUE(old.series.front().remaining.empty());
  auto shared = std::make_shared<DiscrepancyStory>(old);
  RemainderPanel panel;
  panel.show(shared);
  EXPECT_FALSE(panel.plot()->empty()) << "what was measured is shown all the same";
  json["result"].erase("candidates");
  EXPECT_THROW((void)DiscrepancyStory::parse(json), InputError);
}

TEST(NoisePanelTest, ShowsShiftsWithTheirUncertainty) {
  auto story = std::make_shared<DiscrepancyStory>();
  story->noise = {{Component::EX, 1.32, 0.05, 0.8, 0.4, 7200.0}, {Component::EY, 0.87, 0.04, 0.0, 0.0, 0.0}};
  for (int state = 0; state < 5; ++state) {
    story->shifts.push_back({"M" + std::to_string(state), Component::EX, 3600.0 * state, 0.5 * state - 1.0, 0.2});
  }
  story->tail_dof = 4.0;
  story->clock_offset_s = 312.0;
  story->clock_offset_uncertainty_s = 40.0;
  NoisePanel panel;
  panel.show(story);
  EXPECT_EQ(panel.noiseTable()->model()->index(0, 1).data().toString(), QString::fromUtf8("1.32 ± 0.05"));
  EXPECT_EQ(panel.noiseTable()->model()->index(0, 3).data().toString(), QStringLiteral("40 % over 2.0 h"));
  EXPECT_EQ(panel.noiseTable()->model()->index(1, 2).data().toString(), QString::fromUtf8("–"));
  ASSERT_EQ(panel.shiftTable()->model()->rowCount(), 5);
  EXPECT_EQ(panel.shiftTable()->model()->index(0, 2).data().toString(), QString::fromUtf8("−1.00 ± 0.20"));
  ASSERT_EQ(panel.shiftPlot()->series().size(), 1U);
  EXPECT_EQ(panel.shiftPlot()->series().front().sigma.size(), 5U);
  EXPECT_TRUE(panel.facts()->text().contains(QString::fromUtf8("310 ± 40 s ahead")))
      << panel.facts()->text().toStdString();
  EXPECT_FALSE(panel.excludeButton()->isVisibleTo(&panel)) << "there is no reading";
}

TEST(RemainderPanelTest, SaysWhatRemainsBesideWhatIsNamed) {
  auto story = std::make_shared<DiscrepancyStory>();
  story->verdict = DiscrepancyVerdict::Unknown;
  story->remainder = {{Component::EX, 0.8, 44.0}, {Component::EY, 0.05, 2.0}};
  for (const Component c : {Component::EX, Component::EY}) {
    for (const char* point : {"P1", "P2"}) {
      DiscrepancySeries s;
      s.point = point;
      s.component = c;
      s.noise = 0.4;
      for (int i = 0; i < 8; ++i) {
        s.time_s.push_back(3600.0 * i);
        s.value.push_back(0.1 * i);
        s.simulated.push_back(0.0);
        s.remaining.push_back((point[1] == '2' ? 0.2 : 0.1) * i);
        s.held_out.push_back(false);
      }
      story->series.push_back(s);
    }
  }
  RemainderPanel panel;
  panel.show(story);
  EXPECT_EQ(panel.sentence()->text(), QString::fromUtf8("Nothing can be named: the remainder is 0.80 µm rms in EX."));
  EXPECT_EQ(panel.component(), Component::EX);
  EXPECT_EQ(panel.point(), "P2") << "where most remains";
  EXPECT_EQ(panel.plot()->series().size(), 3U) << "noise, remainder and measured; nothing is named";
  const QAbstractItemModel* rows = panel.componentTable()->model();
  EXPECT_EQ(rows->index(0, 4).data().toString(), QStringLiteral("0.80"));
  EXPECT_FALSE(rows->index(0, 4).data(Qt::DecorationRole).isNull()) << "clearly there";
  EXPECT_TRUE(rows->index(1, 4).data(Qt::DecorationRole).isNull()) << "may be noise";
  FoundEffect e;
  e.id = "spindle.growth.z";
  story->effects = {e};
  panel.show(story);
  EXPECT_EQ(panel.sentence()->text(),
            QString::fromUtf8("Apart from growth of the spindle along Z the remainder is 0.80 µm rms in EX."));
}

TEST(WhatPanelTest, MarksTheNamedAmongTheCandidatesAndSaysWhatRemains) {
  auto story = std::make_shared<DiscrepancyStory>();
  story->verdict = DiscrepancyVerdict::Unknown;
  story->candidates = {{"head.tilt.a", 0.31}, {"backlash.y", 0.003}};
  story->remainder = {{Component::EX, 0.8, 44.0}};
  WhatPanel panel;
  panel.show(story);
  const QString empty = panel.effectTable()->property("emptyText").toString();
  EXPECT_TRUE(empty.startsWith(QString::fromUtf8("Nothing can be named: the remainder is 0.80 µm rms in EX")))
      << empty.toStdString();
  const QAbstractItemModel* rows = panel.candidateTable()->model();
  ASSERT_EQ(rows->rowCount(), 2);
  EXPECT_EQ(rows->index(0, 1).data().toString(), QStringLiteral("31 %"));
  EXPECT_EQ(rows->index(1, 1).data().toString(), QStringLiteral("< 1 %"));
  EXPECT_FALSE(rows->index(0, 1).data(Qt::DecorationRole).isNull()) << "a bar";
}

TEST(WhatPanelTest, ShowsRivalsAndLetsTheUserChooseOne) {
  auto story = std::make_shared<DiscrepancyStory>();
  story->verdict = DiscrepancyVerdict::Ambiguous;
  FoundEffect e;
  e.id = "column.bending.a";
  e.physics = "The column bends.";
  e.drivers = "T_ambient_degC (lag 3269 s)";
  e.rivals = {"ambient.drift.y", "frame.rotation.a"};
  e.confidence = 0.19;
  e.delta_bic = 298.0;
  e.parameters = {{"gain_um_per_m2_per_K", 116.0, 8.0}};
  story->effects = {e};
  WhatPanel panel;
  panel.resize(1100, 600);
  panel.show(story);
  panel.QWidget::show();
  const QAbstractItemModel* rows = panel.effectTable()->model();
  ASSERT_EQ(rows->rowCount(), 3);
  EXPECT_EQ(panel.chosen(), "column.bending.a");
  EXPECT_EQ(rows->index(2, 0).data().toString(), QStringLiteral("or: rotation of the frame about X"));
  panel.effectTable()->selectRow(1);
  EXPECT_EQ(panel.chosen(), "ambient.drift.y");
  EXPECT_FALSE(panel.chosenIsAdded());
  auto* rivals = panel.findChild<Callout*>();
  ASSERT_NE(rivals, nullptr);
  EXPECT_TRUE(rivals->sentence().contains(QStringLiteral("environmental temperature variation error along Y")));
  EXPECT_EQ(rivals->tone(), Tone::Attention);
}

TEST(EffectTitles, EveryIdOfTheCatalogueHasWords) {
  for (const char* id :
       {"spindle.growth.z", "spindle.drift.x", "head.tilt.a", "column.bending.b", "ball_screw.expansion.y",
        "frame.rotation.c", "fixture.slip.F3", "periodic.pitch.x", "backlash.y", "coolant.shock.z", "external_heat.z",
        "heat_source.position.y", "rotary.tilt.c0c", "artefact.expansion"}) {
    EXPECT_FALSE(effectTitle(id).contains(QLatin1Char('.'))) << id;
    EXPECT_FALSE(effectTitle(id).contains(QLatin1Char('%'))) << id;
  }
  EXPECT_EQ(effectTitle("ball_screw.expansion.y"), QStringLiteral("thermal expansion of the Y ball screw"));
  EXPECT_EQ(probabilityText(3e-5), QString::fromUtf8("3 × 10⁻⁵"));
}

/// Figures that ask for much height leave the panel where it is: it was laid out without end, one way and the other.
TEST_F(DiscrepancyPageTest, GapComesToRestWhateverItsFiguresAskFor) {
  search(Hidden::SpindleGrowth);
  page_->tabs()->setCurrentWidget(page_->gap());
  wait();
  class Resizes : public QObject {
   public:
    using QObject::QObject;
    int count = 0;
    bool eventFilter(QObject*, QEvent* event) override {
      count += event->type() == QEvent::Resize ? 1 : 0;
      return false;
    }
  };
  for (int height = 100; height <= 500; height += 25) {
    page_->gap()->bars()->setMinimumHeight(height);
    QTest::qWait(100);
    Resizes resizes;
    page_->gap()->installEventFilter(&resizes);
    QTest::qWait(100);
    page_->gap()->removeEventFilter(&resizes);
    EXPECT_EQ(resizes.count, 0) << height;
  }
}

}  // namespace
}  // namespace spindrift::gui
