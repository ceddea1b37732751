// SPDX-License-Identifier: GPL-3.0-or-later
// Capturing in the real window: a new measurement of each instrument from a watched folder, a camera, a plan.
#include <QElapsedTimer>
#include <QInputDialog>
#include <QTabWidget>
#include <QTableView>
#include <QTimer>
#include <filesystem>
#include <map>

#include "core/base/atomic_file.h"
#include "core/base/units.h"
#include "core/imaging/artwork.h"
#include "core/imaging/camera.h"
#include "core/imaging/image.h"
#include "core/probing/touch.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/core/probing/probing_machines.h"
#include "tests/widgets/support/page_test.h"
#include "tests/widgets/support/select_campaign.h"
#include "tests/widgets/support/video.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/capture/new_capture_page.h"
#include "widgets/pages/imaging/fiducial_capture_page.h"
#include "widgets/pages/probing/touch_capture_page.h"
#include "widgets/pages/scanning/scan_capture_page.h"
#include "widgets/panels/capture/arriving_panel.h"
#include "widgets/panels/capture/camera_panel.h"
#include "widgets/panels/capture/live_touch_panel.h"
#include "widgets/panels/capture/plan_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/services/incoming_service.h"

namespace spindrift::gui {
namespace {

using namespace probing_test;

constexpr const char* mill_text =
    R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
"axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,150]}],
"points":[{"id":"F1","kind":"fiducial","x_mm":20,"y_mm":30,"z_mm":0},
{"id":"A1","kind":"surface","x_mm":0,"y_mm":50,"z_mm":0}]})";

/// `turned_deg`: of the spindle, and the camera with it.
GrayImage picture(std::uint64_t seed, double blur_px = 1.0, double turned_deg = 0.0,
                  const FiducialPattern& pattern = standardPattern()) {
  MicroscopeScene scene;
  scene.width_px = 640;
  scene.height_px = 480;
  scene.map = poseAt(640, 480, 2.0, 0.1 + turned_deg * rad_per_deg, {0, 0}, {319.5, 239.5});
  scene.blur_sigma_px = blur_px;
  return renderFiducial(pattern, scene, seed);
}

class CapturePages : public PageTest {
 protected:
  void newMeasurement(const std::string& machine) {
    std::filesystem::create_directories(folder_ / "watched");
    auto session = std::make_unique<Session>(Session::create(folder_ / "session"));
    const std::int64_t id = session->newCampaign("new", "2026-01-31T08:00:00Z", machine);
    window_->session().adopt(std::move(session), id);
    service().setPace(20, 0.1, 0.5);
  }
  IncomingService& service() { return IncomingService::of(window_->session()); }
  void put(const std::string& name, const std::string& bytes) { folder_.write("watched/" + name, bytes); }
  [[nodiscard]] QString watched() const { return QString::fromStdString((folder_ / "watched").string()); }
  IncomingState stateOf(const std::string& name) {
    for (const IncomingItem& i : service().items()) {
      if (i.name == name) return i.state;
    }
    return IncomingState::Waiting;
  }
  void waitFor(const std::function<bool()>& what, const char* reason) {
    EXPECT_TRUE(QTest::qWaitFor(what, 20000)) << reason << ": " << service().problem().toStdString();
  }
  ArrivingPanel* arriving() { return window_->currentPage()->findChild<ArrivingPanel*>(); }
};

TEST_F(CapturePages, WhatIsDroppedOntoTheWindowIsCheckedLikeWhatArrives) {
  newMeasurement(mill_text);
  const auto message = [&] { return window_->jobBar()->message().toStdString(); };
  const auto file = [&](const char* name) { return QString::fromStdString((folder_ / name).string()); };
  folder_.write("M0_F1_rotation_0.png", encodePng(picture(2)));
  folder_.write("broken.png", "no picture");
  window_->take({file("M0_F1_rotation_0.png")});
  waitFor([&] { return message().find("0 of 1") != std::string::npos; }, "without a plan");
  EXPECT_NE(message().find("There is no plan"), std::string::npos) << message();
  auto* page = go<NewCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  window_->workflow().goTo(StepId::Machine);
  folder_.write("again_M0_F1_rotation_0.png", encodePng(picture(3)));
  window_->take({file("again_M0_F1_rotation_0.png"), file("broken.png")});
  waitFor([&] { return message().find("1 of 2") != std::string::npos; }, "one good, one broken");
  EXPECT_NE(message().find("broken.png: "), std::string::npos) << message();
  EXPECT_EQ(window_->workflow().current(), StepId::Capture);
  EXPECT_EQ(stateOf("again_M0_F1_rotation_0.png"), IncomingState::Accepted);
  EXPECT_TRUE(service().done().contains("M0_F1_rotation_0"));
  window_->take({file("again_M0_F1_rotation_0.png")});
  waitFor([&] { return message().find("0 of 1") != std::string::npos; }, "the same once more");
}

// A picture of a camera is in memory alone until it was looked at.
TEST_F(CapturePages, PicturesThatWereTakenStayWithTheirCampaign) {
  newMeasurement(mill_text);
  auto* page = go<NewCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  const std::int64_t first = window_->session().campaignId();
  const std::int64_t second = window_->session().session()->newCampaign("second", "2026-02-01T08:00:00Z", mill_text);
  for (int i = 0; i < 3; ++i)
    service().take(QStringLiteral("picture"), std::make_shared<const GrayImage>(picture(2 + i)));
  selectCampaign(window_->session(), second);
  EXPECT_EQ(incomingJournal(*window_->session().session(), first).size(), 3U);
  EXPECT_EQ(incomingJournal(*window_->session().session(), second).size(), 0U);
}

TEST_F(CapturePages, APictureThatCannotBeStoredIsSaid) {
  newMeasurement(mill_text);
  auto* page = go<NewCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  service().take(QStringLiteral("picture"), std::make_shared<const GrayImage>(picture(2)));
  std::filesystem::rename(folder_ / "session", folder_ / "away");  // a network folder that is gone
  const QString said = service().finishPictures();
  EXPECT_TRUE(said.contains(QStringLiteral("cannot be stored: 1"))) << said.toStdString();
  EXPECT_TRUE(said.contains(QStringLiteral("is not there any more"))) << said.toStdString();
  EXPECT_FALSE(service().problem().isEmpty());
}

TEST_F(CapturePages, WhatArrivesWhileTheFolderIsGoneIsStoredWhenItIsBack) {
  newMeasurement(mill_text);
  auto* page = go<NewCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  ASSERT_TRUE(service().start(watched()).isEmpty());
  std::filesystem::rename(folder_ / "session", folder_ / "away");  // a disk that was pulled out
  put("M0_F1_rotation_0.png", encodePng(picture(2)));
  service().take(QStringLiteral("picture"), std::make_shared<const GrayImage>(picture(3, 1.0, 90.0)));
  waitFor([&] { return service().problem().contains(QStringLiteral("is not there any more")); }, "it is said");
  waitFor([&] { return !service().items().empty(); }, "the file is listed");
  QTest::qWait(1200);  // it is tried again meanwhile
  EXPECT_FALSE(std::filesystem::exists(folder_ / "session")) << "nothing is stored in a folder that was made anew";
  EXPECT_EQ(stateOf("M0_F1_rotation_0.png"), IncomingState::Waiting);
  EXPECT_TRUE(service().done().empty());
  std::filesystem::rename(folder_ / "away", folder_ / "session");
  const auto journal = [&] { return incomingJournal(*window_->session().session(), window_->session().campaignId()); };
  waitFor([&] { return journal().size() == 2; }, "both are stored");
  waitFor([&] { return service().idle(); }, "nothing waits");
  for (const IncomingItem& item : journal()) {
    EXPECT_NE(item.state, IncomingState::Waiting) << item.name;
    EXPECT_TRUE(std::filesystem::exists(window_->session().campaign()->path(item.stored))) << item.name;
  }
  EXPECT_FALSE(service().done().empty());
  EXPECT_TRUE(service().problem().isEmpty()) << service().problem().toStdString();
}

TEST_F(CapturePages, ANewFiducialMeasurementFillsFromAWatchedFolder) {
  newMeasurement(mill_text);
  auto* page = go<NewCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  EXPECT_EQ(page->arriving()->plan()->rows()->rowCount(), 5 * 19);
  EXPECT_TRUE(page->arriving()->plan()->sentence().contains(QStringLiteral("Now M0: F1, rotation 0")));
  page->arriving()->watch(QStringLiteral("/nowhere/at/all"));
  EXPECT_EQ(page->arriving()->state()->tone(), Tone::Bad);
  page->arriving()->watch(watched());
  // A blurred one is asked for again while the operator still stands there.
  put("M0_F1_rotation_0.png", encodePng(picture(1, 9.0)));
  waitFor([&] { return stateOf("M0_F1_rotation_0.png") == IncomingState::Retake; }, "blurred image");
  EXPECT_TRUE(page->arriving()->retake()->sentence().contains(QStringLiteral("Take M0_F1_rotation_0 again")))
      << page->arriving()->retake()->sentence().toStdString();
  put("again_M0_F1_rotation_0.png", encodePng(picture(2)));
  waitFor([&] { return stateOf("again_M0_F1_rotation_0.png") == IncomingState::Accepted; }, "second image");
  // With the first capture the page of the instrument is there, and capturing goes on while one looks elsewhere.
  EXPECT_NE(go<FiducialCapturePage>(StepId::Capture), nullptr);
  EXPECT_TRUE(service().running());
  EXPECT_TRUE(service().retakes().isEmpty());
  window_->workflow().goTo(StepId::Machine);
  put("b.png", encodePng(picture(3, 1.0, 90.0)));
  waitFor([&] { return stateOf("b.png") == IncomingState::Accepted; }, "while another page is shown");
  auto* captures = go<FiducialCapturePage>(StepId::Capture);
  auto* tabs = captures->findChild<QTabWidget*>(QStringLiteral("captureTabs"));
  tabs->setCurrentIndex(1);
  ArrivingPanel* panel = arriving();
  ASSERT_NE(panel, nullptr);
  EXPECT_EQ(panel->arrived()->rowCount(), 3);
  EXPECT_FALSE(panel->arrived()->rows().front().cells.front().picture.isNull()) << "thumbnail";
  EXPECT_EQ(panel->plan()->rows()->rows()[1].cells[2].text, QStringLiteral("captured"));
  panel->service().stop();
  // Everything is there when the session is opened again.
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(session);
  ASSERT_TRUE(waitForJobs(*window_, 20));
  EXPECT_EQ(service().items().size(), 3U);
  EXPECT_EQ(service().done().size(), 2U);
  EXPECT_EQ(service().folder(), watched());
  // And when the program is started again; watching finds the same files and says of them what it said before.
  const auto said = [this] {
    std::map<std::string, std::pair<IncomingState, std::string>> all;
    for (const IncomingItem& i : service().items()) all[i.name] = {i.state, i.plan_item};
    return all;
  };
  const auto before = said();
  EXPECT_EQ(before.at("M0_F1_rotation_0.png").first, IncomingState::Retake);
  window_->closeSession();
  window_ = std::make_unique<MainWindow>();
  window_->resize(1280, 800);
  window_->show();
  window_->open(session);
  ASSERT_TRUE(waitForJobs(*window_, 20));
  go<FiducialCapturePage>(StepId::Capture)->findChild<QTabWidget*>(QStringLiteral("captureTabs"))->setCurrentIndex(1);
  EXPECT_EQ(arriving()->arrived()->rowCount(), 3);
  EXPECT_EQ(said(), before);
  service().setPace(20, 0.1, 0.5);
  arriving()->watch(watched());
  QTest::qWait(100);
  waitFor([&] { return service().idle(); }, "watched again");
  EXPECT_EQ(said(), before);
  if (qEnvironmentVariableIsSet("SPINDRIFT_PICTURES"))
    window_->grab().save(qEnvironmentVariable("SPINDRIFT_PICTURES") + QStringLiteral("/arriving.png"));
  window_->closeSession();
  window_->open(session);
  ASSERT_TRUE(waitForJobs(*window_, 20));
  EXPECT_EQ(said(), before) << "the journal";
}

TEST_F(CapturePages, TheSentenceNamesABadCaptureAndItsButtonGoesThere) {
  std::filesystem::create_directories(folder_ / "kept/captures");
  folder_.write("kept/campaign.json",
                R"({"format":"spindrift-campaign","version":1,"name":"kept","start_utc":"2026-01-31T08:00:00Z"})");
  folder_.write("kept/machine.json", mill_text);
  std::string list = "time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,spindle_deg,image\n";
  for (int i = 0; i < 3; ++i) {
    const std::string name = "captures/r" + std::to_string(i) + ".png";
    folder_.write("kept/" + name, encodePng(picture(static_cast<std::uint64_t>(i), i == 1 ? 9.0 : 1.0, 120.0 * i)));
    list += std::to_string(10 * i) + ",M0,F1,rotation," + std::to_string(i) + ",20,30,0," + std::to_string(120 * i) +
            "," + name + "\n";
  }
  folder_.write("kept/captures/fiducials.csv", list);
  open(folder_ / "kept");
  auto* page = go<FiducialCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  press();
  EXPECT_TRUE(page->callout()->sentence().contains(QStringLiteral("(F1 in state M0, rotation 1)")))
      << page->callout()->sentence().toStdString();
  page->select(QStringLiteral("captures/r2.png"));
  EXPECT_EQ(page->pickedItem(), QStringLiteral("captures/r2.png"));
  QTest::mouseClick(page->callout()->findChild<QPushButton*>(), Qt::LeftButton);
  EXPECT_EQ(page->pickedItem(), QStringLiteral("captures/r1.png"));
}

TEST_F(CapturePages, SeveralCapturesAreLeftOutAndBroughtBackAtOnce) {
  std::filesystem::create_directories(folder_ / "kept/captures");
  folder_.write("kept/campaign.json",
                R"({"format":"spindrift-campaign","version":1,"name":"kept","start_utc":"2026-01-31T08:00:00Z"})");
  folder_.write("kept/machine.json", mill_text);
  std::string list = "time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,spindle_deg,image\n";
  for (int i = 0; i < 4; ++i) {
    const std::string name = "captures/r" + std::to_string(i) + ".png";
    folder_.write("kept/" + name, encodePng(picture(static_cast<std::uint64_t>(i), 1.0, 90.0 * i)));
    list += std::to_string(10 * i) + ",M0,F1,rotation," + std::to_string(i) + ",20,30,0," + std::to_string(90 * i) +
            "," + name + "\n";
  }
  folder_.write("kept/captures/fiducials.csv", list);
  open(folder_ / "kept");
  auto* page = go<FiducialCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  QTableView* captures = nullptr;
  for (auto* table : page->findChildren<QTableView*>())
    if (table->accessibleName() == QLatin1String("Captures")) captures = table;
  ASSERT_NE(captures, nullptr);
  const auto button = [&]() -> QPushButton* {
    for (auto* b : page->findChildren<QPushButton*>())
      if (b->text().contains(QStringLiteral("Exclude")) || b->text().contains(QStringLiteral("Bring back"))) return b;
    return nullptr;
  };
  const auto choose = [&](int rows) {
    captures->clearSelection();
    for (int row = 0; row < rows; ++row)
      captures->selectionModel()->select(captures->model()->index(row, 0),
                                         QItemSelectionModel::Select | QItemSelectionModel::Rows);
  };
  choose(3);
  ASSERT_NE(button(), nullptr);
  EXPECT_TRUE(button()->text().endsWith(QStringLiteral("Exclude 3 captures …"))) << button()->text().toStdString();
  QTimer::singleShot(50, window_.get(), [this] {
    auto* asked = window_->findChild<QInputDialog*>();
    ASSERT_NE(asked, nullptr);
    asked->setTextValue(QStringLiteral("the lamp was off"));
    asked->accept();
  });
  button()->click();
  ASSERT_TRUE(waitForJobs(*window_, 20));
  EXPECT_EQ(window_->session().excluded().size(), 3U);
  EXPECT_EQ(window_->undoStack().count(), 1);
  choose(3);
  EXPECT_TRUE(button()->text().endsWith(QStringLiteral("Bring back 3 captures"))) << button()->text().toStdString();
  button()->click();
  ASSERT_TRUE(waitForJobs(*window_, 20));
  EXPECT_TRUE(window_->session().excluded().empty());
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 20));
  EXPECT_EQ(window_->session().excluded().size(), 3U);
  choose(4);
  EXPECT_TRUE(button()->text().endsWith(QStringLiteral("Exclude 4 captures …"))) << "one of them is in";
}

TEST_F(CapturePages, NothingOfTheSessionBeforeIsSeenOrCanBeExcluded) {
  newMeasurement(mill_text);
  const auto plan = [this] {
    auto* empty = go<NewCapturePage>(StepId::Capture);
    ASSERT_NE(empty, nullptr);
    empty->setInstrument(Instrument::Microscope);
    empty->arriving()->plan()->makePlan();
  };
  plan();
  put("M0_F1_rotation_0.png", encodePng(picture(1)));
  ASSERT_TRUE(service().start(watched(), {}).isEmpty());
  waitFor([&] { return stateOf("M0_F1_rotation_0.png") == IncomingState::Accepted; }, "first session");
  auto* page = go<FiducialCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  ASSERT_FALSE(page->pickedItem().isEmpty());
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {page->pickedItem()}, QStringLiteral("a drop on the glass")));
  ASSERT_TRUE(waitForJobs(*window_, 20));
  service().stop();
  // A second session begins with the same numbers for campaign and results.
  auto session = std::make_unique<Session>(Session::create(folder_ / "second"));
  const std::int64_t id = session->newCampaign("second", "2026-02-01T08:00:00Z", mill_text);
  ASSERT_EQ(id, window_->session().campaignId());
  window_->session().adopt(std::move(session), id);
  service().setPace(20, 0.1, 0.5);
  plan();
  std::filesystem::create_directories(folder_ / "other");
  ASSERT_TRUE(service().start(QString::fromStdString((folder_ / "other").string()), {}).isEmpty());
  folder_.write("other/M0_F1_rotation_1.png", encodePng(picture(2)));
  waitFor([&] { return stateOf("M0_F1_rotation_1.png") == IncomingState::Accepted; }, "second session");
  page = go<FiducialCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(page->findChild<QTabWidget*>(QStringLiteral("captureTabs"))->currentIndex(), 1) << "capturing goes on";
  EXPECT_TRUE(page->pickedItem().contains(QStringLiteral("rotation_1"))) << page->pickedItem().toStdString();
  for (const Callout* callout : page->findChildren<Callout*>())
    EXPECT_FALSE(callout->sentence().contains(QStringLiteral("drop on the glass")));
  for (const auto* button : page->findChildren<QPushButton*>()) EXPECT_NE(button->text(), QStringLiteral("Bring back"));
}

TEST_F(CapturePages, ThePlanCanBeUndone) {
  newMeasurement(mill_text);
  auto* page = go<NewCapturePage>(StepId::Capture);
  page->setInstrument(Instrument::Profiler);
  page->arriving()->plan()->makePlan();
  EXPECT_EQ(page->arriving()->plan()->rows()->rowCount(), 5);
  window_->undoStack().undo();
  EXPECT_EQ(page->arriving()->plan()->rows()->rowCount(), 0);
  window_->undoStack().redo();
  EXPECT_EQ(page->arriving()->plan()->rows()->rowCount(), 5);
  page->setInstrument(Instrument::TouchProbe);
  page->arriving()->plan()->makePlan();  // the mill has no artefact
  EXPECT_TRUE(page->arriving()->plan()->sentence().contains(QStringLiteral("artefacts")));
}

TEST_F(CapturePages, TouchesAppearWhileTheControlWritesThem) {
  newMeasurement(holeMachineText());
  const MachineDescription machine = machineFrom(holeMachineText());
  VirtualRun run = runCycles(machine, 2, {}, 51);
  Touch good;
  for (Touch& t : run.list.touches) {
    if (t.cycle == "M1" && t.feature == "H4" && t.touch == 1 && t.c_deg == 0.0) {
      good = t;
      t.position_mm += 0.06 * t.approach;
    }
  }
  auto* page = go<NewCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  ArrivingPanel* panel = page->arriving();
  panel->plan()->makePlan();
  panel->watch(watched());
  const std::string text = run.list.csv();
  const std::size_t half = text.size() / 2 + 11;  // in the middle of a line
  put("touches.csv", text.substr(0, half));
  waitFor([&] { return service().touches() != nullptr && service().touches()->live().touches().size() > 10; }, "half");
  EXPECT_TRUE(service().touches()->waiting());
  EXPECT_TRUE(service().problem().isEmpty()) << service().problem().toStdString();
  // The page of the instrument has taken over.
  auto* touches = go<TouchCapturePage>(StepId::Capture);
  ASSERT_NE(touches, nullptr);
  touches->findChild<QTabWidget*>(QStringLiteral("captureTabs"))->setCurrentIndex(1);
  panel = arriving();
  const int before = panel->touches()->rows()->rowCount();
  EXPECT_GT(before, 10);
  put("touches.csv", text);
  waitFor([&] { return service().touches()->live().touches().size() == run.list.touches.size(); }, "all");
  EXPECT_EQ(panel->touches()->rows()->rowCount(), static_cast<int>(run.list.touches.size()));
  EXPECT_TRUE(panel->touches()->progressText().contains(QStringLiteral("Cycle M1")))
      << panel->touches()->progressText().toStdString();
  ASSERT_FALSE(service().retakes().isEmpty());
  EXPECT_TRUE(panel->retake()->sentence().contains(QStringLiteral("H4"))) << panel->retake()->sentence().toStdString();
  // Taken again: the control appends to its list.
  std::string more = text;
  double time = run.list.touches.back().time_s;
  TouchList again;
  for (const LiveTouch& live : service().touches()->live().touches()) {
    if (live.plausible || live.replaced) continue;
    Touch t = live.touch;
    if (t.touch == good.touch) t.position_mm = good.position_mm;
    t.time_s = time += 3.0;
    again.touches.push_back(t);
  }
  const std::string rows = again.csv();
  put("touches.csv", more + rows.substr(rows.find('\n') + 1));
  waitFor([&] { return service().retakes().isEmpty(); }, "taken again");
  service().stop();
  const TouchList there = TouchList::read(*window_->session().campaign()->captureList("touches.csv"));
  EXPECT_EQ(there.touches.size(), run.list.touches.size());
  press();
  EXPECT_EQ(touches->callout()->tone(), Tone::Good) << touches->callout()->sentence().toStdString();
}

TEST_F(CapturePages, ScansArriveAndCutOnesAreAskedForAgain) {
  newMeasurement(mill_text);
  auto* page = go<NewCapturePage>(StepId::Capture);
  page->setInstrument(Instrument::Profiler);
  page->arriving()->plan()->makePlan();
  page->arriving()->watch(watched());
  const auto cloud = [](int profiles) {
    std::string text = "x_mm,y_mm,z_mm\n";
    for (int j = 0; j < profiles; ++j) {
      for (int i = 0; i < 40; ++i) {
        text +=
            std::to_string(0.1 * i) + "," + std::to_string(0.1 * j) + "," + std::to_string(0.01 * i + 0.001 * j) + "\n";
      }
    }
    return text;
  };
  put("M0_A1.csv", cloud(60));
  waitFor([&] { return stateOf("M0_A1.csv") == IncomingState::Accepted; }, "first scan");
  put("M1_A1.csv", cloud(20));
  waitFor([&] { return stateOf("M1_A1.csv") == IncomingState::Retake; }, "cut scan");
  auto* scans = go<ScanCapturePage>(StepId::Capture);
  ASSERT_NE(scans, nullptr);
  EXPECT_EQ(scans->scans()->rowCount(), 1);
  EXPECT_EQ(service().retakes().size(), 1);
}

TEST_F(CapturePages, ACameraShowsFocusAndTakesPictures) {
  newMeasurement(mill_text);
  auto* page = go<NewCapturePage>(StepId::Capture);
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  // The virtual microscope is focused while it films.
  std::vector<GrayImage> images;
  for (int k = 0; k < 12; ++k)
    images.push_back(picture(100 + static_cast<std::uint64_t>(k), k < 8 ? 4.0 - 0.4 * k : 1.0));
  const std::string video = (folder_ / "focus.avi").string();
  writeVideo(video, images, 10.0);
  page->findChild<QTabWidget*>()->setCurrentIndex(1);
  CameraPanel* camera = page->camera();
  camera->open(QStringLiteral("no such file.avi"));
  waitFor([&] { return camera->state()->tone() == Tone::Bad; }, "a camera that is none");
  // One that waits for its next picture keeps nobody waiting who closes it, and can be opened again.
  const std::string slow = (folder_ / "slow.avi").string();
  writeVideo(slow, images, 1.0);
  for (int time = 0; time < 2; ++time) {
    camera->open(QString::fromStdString(slow));
    waitFor([&] { return camera->frames() == 1; }, "first picture of a slow camera");
    QElapsedTimer closing;
    closing.start();
    camera->close();
    EXPECT_LT(closing.elapsed(), 300);
    EXPECT_FALSE(camera->running());
  }
  camera->open(QString::fromStdString(video));
  waitFor([&] { return camera->state()->sentence().contains(QStringLiteral("no more pictures")); }, "end of the video");
  ASSERT_GT(camera->frames(), 3);
  const Series& s = camera->sharpness()->series().front();
  EXPECT_GT(s.y.back(), 1.2 * s.y.front()) << "sharpness rises while focusing";
  EXPECT_TRUE(camera->verdict().good) << camera->verdict().sentence;
  EXPECT_GT(camera->verdict().decoded.subpatterns.size(), 3U);
  camera->take();
  waitFor([&] { return service().done().size() == 1; }, "picture taken");
  EXPECT_TRUE(service().done().contains("M0_F1_rotation_0"));
}

TEST_F(CapturePages, TheCampaignsOwnPatternIsReadFromTheFolderAndTheCamera) {
  newMeasurement(mill_text);
  const FiducialPattern own =
      makePattern({.rows = 7, .columns = 7, .first_row = 31, .first_column = 51, .pitch_um = 455.0});
  writeFileAtomically(window_->session().campaign()->path("pattern.json"), patternJson(own));
  auto* page = go<NewCapturePage>(StepId::Capture);
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  const std::string video = (folder_ / "own.avi").string();
  const GrayImage image = picture(1, 1.0, 0.0, own);
  writeVideo(video, std::vector<GrayImage>(6, image), 10.0);
  page->findChild<QTabWidget*>()->setCurrentIndex(1);
  CameraPanel* camera = page->camera();
  camera->open(QString::fromStdString(video));
  waitFor([&] { return camera->state()->sentence().contains(QStringLiteral("no more pictures")); }, "end of the video");
  EXPECT_TRUE(camera->verdict().good) << camera->verdict().sentence;
  ASSERT_FALSE(camera->verdict().decoded.subpatterns.empty());
  EXPECT_GE(camera->verdict().decoded.subpatterns.front().row, 31);
  camera->take();
  waitFor([&] { return service().done().contains("M0_F1_rotation_0"); }, "picture taken");
  ASSERT_TRUE(service().start(watched(), {}).isEmpty());
  put("M0_F1_rotation_1.png", encodePng(picture(2, 1.0, 90.0, own)));
  waitFor([&] { return stateOf("M0_F1_rotation_1.png") == IncomingState::Accepted; }, "an image of the own pattern");
  put("M0_F1_rotation_2.png", encodePng(picture(3, 1.0, 180.0)));
  waitFor([&] { return stateOf("M0_F1_rotation_2.png") == IncomingState::Retake; }, "one of the standard pattern");
}

}  // namespace
}  // namespace spindrift::gui
