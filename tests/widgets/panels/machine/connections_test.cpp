// SPDX-License-Identifier: GPL-3.0-or-later
// The real window against real peers on loopback: an MTConnect agent and the broker mosquitto. Pictures of the pages go
// where SPINDRIFT_TEST_PICTURES says, to be looked at.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QLineEdit>
#include <QTabWidget>
#include <QTableWidget>

#include "core/base/atomic_file.h"
#include "core/connect/genicam_camera.h"
#include "core/imaging/image.h"
#include "core/thermal/thermal_model.h"
#include "tests/core/connect/broker.h"
#include "tests/core/connect/small_agent.h"
#include "tests/widgets/support/page_test.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/capture/new_capture_page.h"
#include "widgets/pages/compensate/log_compensate_page.h"
#include "widgets/pages/machine/machine_page.h"
#include "widgets/pages/thermal/warm_up_page.h"
#include "widgets/panels/capture/arriving_panel.h"
#include "widgets/panels/capture/camera_panel.h"
#include "widgets/panels/capture/machine_state_line.h"
#include "widgets/panels/common/fields_dialog.h"
#include "widgets/panels/compensate/live_compensation_panel.h"
#include "widgets/panels/machine/connections_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/services/connections_service.h"
#include "widgets/services/incoming_service.h"

namespace spindrift::gui {
namespace {

using spindrift::testing::Broker;
using spindrift::testing::Publisher;
using spindrift::testing::SmallAgent;

class ConnectionsTest : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    RunnerOptions quick;
    quick.first_pause_s = 0.1;
    quick.longest_pause_s = 0.2;
    service().setRunnerOptions(quick);
    service().setPace(50);
  }
  ConnectionsService& service() { return ConnectionsService::of(window_->session()); }

  ConnectionsPanel* panel() {
    if (window_->session().campaign() == nullptr) {
      auto session = std::make_unique<Session>(Session::create(folder_ / "session"));
      const std::int64_t id = session->newCampaign(
          "new", utcNow(), R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
        "axes":[{"name":"X","travel_mm":[0,400]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,400]}]})");
      window_->session().adopt(std::move(session), id);
    }
    auto* machine = go<MachinePage>(StepId::Machine);
    auto* tabs = machine->findChild<QTabWidget*>(QStringLiteral("machineTabs"));
    tabs->setCurrentIndex(3);
    EXPECT_EQ(tabs->tabText(3), QStringLiteral("Connections"));
    return machine->connections();
  }
  /// Types an address and presses the button, as a user does.
  void lookAt(ConnectionsPanel* page, const std::string& url) {
    page->address()->setText(QString::fromStdString(url));
    QTest::mouseClick(page->lookButton(), Qt::LeftButton);
    ASSERT_TRUE(waitForJobs(*window_, 60));
  }
  static void tick(ConnectionsPanel* page, const QString& item, bool on = true) {
    const int row = page->items()->rowOf(item);
    ASSERT_GE(row, 0) << item.toStdString();
    page->items()->setData(page->items()->index(row, 0), on ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole);
    QCoreApplication::processEvents();
  }
  static QString cell(ConnectionsPanel* page, int row, int column) {
    return page->columns()->item(row, column)->text();
  }
  static bool waitUntil(const std::function<bool()>& done, int patience_ms = 15000) {
    return QTest::qWaitFor(done, patience_ms);
  }
  /// Light and dark, where somebody wants to look at them.
  void picture(const QString& name, QWidget* of = nullptr) {
    const QString folder = qEnvironmentVariable("SPINDRIFT_TEST_PICTURES");
    if (folder.isEmpty()) return;
    for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
      window_->setTheme(kind);
      QTest::qWait(300);
      (of == nullptr ? window_.get() : of)
          ->grab()
          .save(QDir(folder).filePath(
              name + (kind == ThemeKind::Dark ? QStringLiteral("-dark.png") : QStringLiteral("-light.png"))));
    }
  }
};

TEST_F(ConnectionsTest, AMachineIsListedMappedSeenAndRecorded) {
  SmallAgent agent;
  agent.observe("T1", "31.5", localUtc());
  agent.observe("S1", "600", localUtc());
  agent.observe("EXEC", "READY", localUtc());
  ConnectionsPanel* page = panel();
  EXPECT_FALSE(page->recordButton()->isEnabled());
  picture(QStringLiteral("connections-empty"));

  lookAt(page, agent.url());
  ASSERT_EQ(page->sources()->rows().size(), 1U);
  ASSERT_EQ(page->items()->rows().size(), 6U) << page->state()->sentence().toStdString();
  EXPECT_EQ(page->items()->rows()[1].cells[1].text, QStringLiteral("31.5"));
  EXPECT_EQ(page->items()->rows()[1].cells[2].text, QStringLiteral("CELSIUS"));
  for (const char* item : {"T1", "S1", "EXEC"}) tick(page, QString::fromLatin1(item));
  ASSERT_EQ(page->columns()->rowCount(), 3);
  EXPECT_EQ(cell(page, 0, 0), QStringLiteral("T_spindle_degC"));
  EXPECT_EQ(cell(page, 1, 0), QStringLiteral("spindle_rpm"));
  // Every change can be undone, and what cannot be is refused with its reason.
  window_->undoStack().undo();
  EXPECT_EQ(page->columns()->rowCount(), 2);
  window_->undoStack().redo();
  EXPECT_EQ(page->columns()->rowCount(), 3);
  page->columns()->item(2, 0)->setText(QStringLiteral("spindle_rpm"));
  QCoreApplication::processEvents();
  EXPECT_EQ(page->state()->tone(), Tone::Bad);
  EXPECT_TRUE(page->state()->sentence().contains(QStringLiteral("spindle_rpm")));
  EXPECT_EQ(cell(page, 2, 0), QStringLiteral("EXEC"));
  page->columns()->item(2, 0)->setText(QStringLiteral("running"));
  QCoreApplication::processEvents();
  EXPECT_EQ(cell(page, 2, 0), QStringLiteral("running"));
  auto* role = qobject_cast<QComboBox*>(page->columns()->cellWidget(0, 6));
  ASSERT_NE(role, nullptr);
  role->setCurrentIndex(role->findData(QStringLiteral("spindle_housing")));
  Q_EMIT role->activated(role->currentIndex());
  QCoreApplication::processEvents();
  EXPECT_EQ(service().description()["columns"][0].value("role", ""), "spindle_housing")
      << service().description().dump();

  // Live, without writing anything.
  QTest::mouseClick(page->liveButton(), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return cell(page, 0, 1) == QStringLiteral("31.50 °C"); }))
      << page->state()->sentence().toStdString();
  EXPECT_EQ(cell(page, 0, 3), QStringLiteral("good"));
  EXPECT_EQ(cell(page, 1, 1), QStringLiteral("600 rpm"));
  EXPECT_EQ(window_->jobBar()->connections(), QStringLiteral("Live"));
  EXPECT_FALSE(std::filesystem::exists(window_->session().campaign()->path("log.csv")));
  EXPECT_FALSE(page->plot()->empty());

  QTest::mouseClick(page->recordButton(), Qt::LeftButton);
  ASSERT_TRUE(service().recording()) << page->state()->sentence().toStdString();
  ASSERT_TRUE(waitUntil([&] { return service().snapshot().rows > 0; }));
  EXPECT_EQ(window_->jobBar()->connections(), QStringLiteral("Recording"));
  // The role that was stated is the machine's.
  const auto& sensors = window_->session().campaign()->machine.temperature_sensors;
  ASSERT_EQ(sensors.size(), 1U);
  EXPECT_EQ(sensors[0].role, SensorRole::SpindleHousing);
  for (int i = 0; i < 8; ++i) {
    agent.observe("T1", std::to_string(31.5 + 0.1 * i), localUtc());
    QTest::qWait(300);
  }
  picture(QStringLiteral("connections-recording"));

  // Capture and warm-up know the state of the machine; a lost source is said on every page.
  go<Page>(StepId::Capture);
  MachineStateLine* line = nullptr;
  for (auto* each : window_->currentPage()->findChildren<MachineStateLine*>()) {
    if (each->isVisible()) line = each;
  }
  ASSERT_NE(line, nullptr);
  EXPECT_TRUE(line->sentence().contains(QStringLiteral("still turning (600 rpm): wait")))
      << line->sentence().toStdString();
  EXPECT_TRUE(service().machineAt(localUtc() - service().startUtc()).contains(QStringLiteral("spindle 600 rpm")));
  picture(QStringLiteral("connections-capture-wait"));
  agent.observe("S1", "0", localUtc());
  ASSERT_TRUE(
      waitUntil([&] { return line->sentence().contains(QStringLiteral("The machine stands still: spindle 0 rpm")); }));
  EXPECT_EQ(line->tone(), Tone::Good);

  auto* warm_up = go<WarmUpPage>(StepId::WarmUp);
  ASSERT_TRUE(waitUntil([&] { return !warm_up->temperatures()->empty(); }));
  EXPECT_EQ(warm_up->temperatures()->series()[0].name, QStringLiteral("spindle"));
  EXPECT_GT(warm_up->temperatures()->series()[0].y.back(), 32.0);
  agent.stop();
  ASSERT_TRUE(waitUntil([&] { return window_->jobBar()->connections().endsWith(QStringLiteral("lost")); }));
  const auto said = [&](const QString& words) {
    const auto& messages = window_->jobBar()->log().messages();
    return std::any_of(messages.begin(), messages.end(), [&](const Message& m) { return m.text.contains(words); });
  };
  EXPECT_TRUE(said(QStringLiteral("127.0.0.1 is lost")));
  picture(QStringLiteral("connections-warm-up-lost"));
  agent.start();
  ASSERT_TRUE(waitUntil([&] { return window_->jobBar()->connections() == QStringLiteral("Recording"); }));
  EXPECT_TRUE(said(QStringLiteral("is there again")));

  // Ended, the log is the campaign's, and what was made before it turned outdated.
  const std::string before = window_->session().inputsKey();
  page = panel();
  QTest::mouseClick(page->recordButton(), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return window_->session().campaign()->log.has_value(); }));
  EXPECT_EQ(window_->session().campaign()->log->signal("spindle_rpm")->front(), 600.0);
  EXPECT_EQ(window_->session().campaign()->log->at("spindle_rpm", 1e6), 0.0);
  EXPECT_NE(window_->session().inputsKey(), before);
  EXPECT_TRUE(window_->jobBar()->connections().isEmpty());

  // Opened again the connections are there, and the campaign's log is what was recorded.
  const QString folder = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->openSession(folder);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  page = panel();
  EXPECT_EQ(page->columns()->rowCount(), 3);
  EXPECT_EQ(page->sources()->rows().size(), 1U);
  EXPECT_FALSE(service().running());
  EXPECT_FALSE(said(QStringLiteral("are not what they were")));
  exportAll();
}

TEST_F(ConnectionsTest, ClosingWhileItRecordsLeavesAWholeLog) {
  SmallAgent agent;
  agent.observe("S1", "600", localUtc());
  ConnectionsPanel* page = panel();
  lookAt(page, agent.url());
  tick(page, QStringLiteral("S1"));
  QTest::mouseClick(page->recordButton(), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return service().snapshot().rows > 0; }));
  const std::filesystem::path folder = window_->session().folder();
  const std::filesystem::path log = window_->session().campaign()->path("log.csv");
  window_->close();
  EXPECT_FALSE(service().running());
  const std::string text = readFile(log);
  EXPECT_THAT(text, ::testing::HasSubstr("recording ends at"));
  EXPECT_EQ(text.back(), '\n');
  window_.reset();
  const Session session = Session::open(folder);
  EXPECT_TRUE(Campaign::read(session.campaigns().front().folder).log.has_value());
}

TEST_F(ConnectionsTest, ABrokerIsListedAndAnAddressWithoutAPeerIsSaid) {
  Broker broker;
  Publisher publisher(broker);
  publisher.publish("hall/room", R"({"temperature":21.25,"unit":"degC"})", true);
  publisher.publish("mill/spindle/speed", "1200", true);
  ConnectionsPanel* page = panel();
  lookAt(page, broker.url());
  ASSERT_GE(page->items()->rows().size(), 2U) << page->state()->sentence().toStdString();
  QString temperature;
  for (const Row& row : page->items()->rows()) {
    if (row.id.contains(QStringLiteral("temperature"))) temperature = row.id;
  }
  tick(page, temperature);
  ASSERT_EQ(page->columns()->rowCount(), 1);
  EXPECT_EQ(cell(page, 0, 0), QStringLiteral("T_temperature_degC"));
  page->columns()->item(0, 0)->setText(QStringLiteral("T_room_degC"));
  QCoreApplication::processEvents();
  QTest::mouseClick(page->liveButton(), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return cell(page, 0, 1) == QStringLiteral("21.25 °C"); }))
      << page->state()->sentence().toStdString();
  broker.stop();
  ASSERT_TRUE(waitUntil([&] { return cell(page, 0, 3) == QStringLiteral("lost"); }));
  EXPECT_EQ(page->state()->tone(), Tone::Bad);
  broker.start();
  Publisher again(broker);
  ASSERT_TRUE(waitUntil([&] {
    again.publish("hall/room", R"({"temperature":22.5})");
    return cell(page, 0, 1) == QStringLiteral("22.50 °C");
  }));
  EXPECT_EQ(cell(page, 0, 3), QStringLiteral("good"));
  service().stop();

  lookAt(page, "http://127.0.0.1:1");
  EXPECT_TRUE(page->state()->sentence().contains(QStringLiteral("http://127.0.0.1:1")));
  EXPECT_EQ(page->state()->tone(), Tone::Bad);
  lookAt(page, "ftp://x");
  EXPECT_TRUE(page->state()->sentence().contains(QStringLiteral("http://")));
}

TEST_F(ConnectionsTest, ACaptureSaysWhatTheMachineDidWhenItWasTaken) {
  SmallAgent agent;
  agent.observe("S1", "450", localUtc());
  agent.observe("T1", "24.25", localUtc());
  ConnectionsPanel* page = panel();
  lookAt(page, agent.url());
  tick(page, QStringLiteral("S1"));
  tick(page, QStringLiteral("T1"));
  QTest::mouseClick(page->recordButton(), Qt::LeftButton);
  ASSERT_TRUE(
      waitUntil([&] { return service().snapshot().columns[1].known && service().snapshot().columns[0].known; }));
  auto* capture = go<NewCapturePage>(StepId::Capture);
  ArrivingPanel* arriving = capture->arriving();
  IncomingService::of(window_->session()).setPace(50, 0.1, 1.0);
  const std::filesystem::path folder = folder_ / "arriving";
  std::filesystem::create_directories(folder);
  arriving->watch(QString::fromStdString(folder.string()));
  QTest::qWait(1200);  // times of files are of whole seconds here and there
  writeFileAtomically(folder / "M0_F1.png", encodePng(GrayImage(640, 480, 90)));
  ASSERT_TRUE(waitUntil([&] {
    const auto& items = IncomingService::of(window_->session()).items();
    return !items.empty() && items.front().state != IncomingState::Waiting;
  }));
  ASSERT_TRUE(waitUntil([&] { return !arriving->arrived()->rows().empty(); }));
  const QString found = arriving->arrived()->rows().front().cells.back().text;
  EXPECT_TRUE(found.contains(QStringLiteral("Machine: spindle 450 rpm, spindle 24.25 °C"))) << found.toStdString();
  picture(QStringLiteral("connections-capture-row"));
}

TEST_F(ConnectionsTest, ACameraByGenicamIsShown) {
  enableFakeCamera();
  (void)panel();
  auto* capture = go<NewCapturePage>(StepId::Capture);
  CameraPanel* camera = capture->camera();
  capture->findChild<QTabWidget*>()->setCurrentWidget(camera);
  camera->open(QStringLiteral("genicam:no such camera"));
  ASSERT_TRUE(waitUntil([&] { return camera->state()->tone() == Tone::Bad; }));
  EXPECT_TRUE(camera->state()->sentence().contains(QStringLiteral("no such camera")));
  camera->open(QStringLiteral("genicam:Fake_1"));
  ASSERT_TRUE(waitUntil([&] { return camera->frames() >= 3; })) << camera->state()->sentence().toStdString();
  EXPECT_TRUE(camera->running());
  camera->close();
  EXPECT_FALSE(camera->running());
}

TEST_F(ConnectionsTest, LinesAndRegistersAreAddedByTheirAddress) {
  ConnectionsPanel* page = panel();
  lookAt(page, "tcp://127.0.0.1:1");
  lookAt(page, "modbus://127.0.0.1:1");
  ASSERT_EQ(page->sources()->rows().size(), 2U) << page->state()->sentence().toStdString();
  EXPECT_EQ(page->sources()->rows()[1].id, QStringLiteral("127.0.0.1 2"));
  // The second is the one that is shown.
  page->tick(QStringLiteral("nonsense"), true);
  EXPECT_EQ(page->columns()->rowCount(), 0);
  EXPECT_EQ(page->state()->tone(), Tone::Bad);
  EXPECT_TRUE(page->state()->sentence().contains(QStringLiteral("nonsense")));
  page->tick(QStringLiteral("input:0:int16"), true);
  ASSERT_EQ(page->columns()->rowCount(), 1) << page->state()->sentence().toStdString();
  page->columns()->setCurrentCell(0, 0);
  FieldsDialog* dialog = page->editColumn();
  ASSERT_NE(dialog, nullptr);
  dialog->field("column")->setText(QStringLiteral("T_bed_degC"));
  dialog->field("scale")->setText(QStringLiteral("ten"));
  dialog->accept();
  EXPECT_TRUE(dialog->isVisible());  // refused, and nothing is lost
  EXPECT_FALSE(service().description()["columns"][0].contains("scale"));
  dialog->field("scale")->setText(QStringLiteral("0.1"));
  picture(QStringLiteral("connections-column"), dialog);
  dialog->accept();
  EXPECT_EQ(service().description()["columns"][0]["scale"], 0.1);
  EXPECT_EQ(cell(page, 0, 0), QStringLiteral("T_bed_degC"));
  window_->undoStack().undo();
  EXPECT_FALSE(service().description()["columns"][0].contains("scale"));
}

TEST_F(ConnectionsTest, NoSecretIsTakenIntoTheSession) {
  ConnectionsPanel* page = panel();
  lookAt(page, "mqtt://me:tellnobody@127.0.0.1:1");
  EXPECT_EQ(page->state()->tone(), Tone::Bad);
  EXPECT_FALSE(page->state()->sentence().contains(QStringLiteral("tellnobody")));
  EXPECT_TRUE(page->sources()->rows().empty());
  EXPECT_EQ(readFile(window_->session().folder() / "session.sqlite").find("tellnobody"), std::string::npos);

  // What a source needs beside its address: only where its secret is.
  lookAt(page, "mqtt://127.0.0.1:1");
  ASSERT_EQ(page->sources()->rows().size(), 1U);
  FieldsDialog* dialog = page->editSource();
  ASSERT_NE(dialog, nullptr);
  picture(QStringLiteral("connections-options"), dialog);
  dialog->field("user")->setText(QStringLiteral("me"));
  dialog->field("password_env")->setText(QStringLiteral("SPINDRIFT_TEST_PASSWORD"));
  dialog->accept();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  const nlohmann::json kept = service().description();
  EXPECT_EQ(kept["sources"][0]["password_env"], "SPINDRIFT_TEST_PASSWORD");
  // The variable is not set: said when it is needed.
  EXPECT_TRUE(page->state()->sentence().contains(QStringLiteral("SPINDRIFT_TEST_PASSWORD")))
      << page->state()->sentence().toStdString();
}

TEST_F(ConnectionsTest, APasswordInPlaceOfTheNameOfItsVariableIsNotKept) {
  ConnectionsPanel* page = panel();
  lookAt(page, "mqtt://127.0.0.1:1");
  FieldsDialog* dialog = page->editSource();
  ASSERT_NE(dialog, nullptr);
  dialog->field("password_env")->setText(QStringLiteral("tellnobody!"));
  dialog->accept();
  EXPECT_TRUE(dialog->isVisible());
  EXPECT_FALSE(service().description()["sources"][0].contains("password_env"));
  dialog->reject();
  EXPECT_EQ(readFile(window_->session().folder() / "session.sqlite").find("tellnobody"), std::string::npos);
}

TEST_F(ConnectionsTest, ACameraIsSetInTheWindowAndStaysSo) {
  enableFakeCamera();
  ConnectionsPanel* page = panel();
  lookAt(page, "genicam:Fake_1");
  ASSERT_EQ(page->sources()->rows().size(), 1U) << page->state()->sentence().toStdString();
  const auto shown = [&](const QString& item) {
    const int row = page->items()->rowOf(item);
    return row < 0 ? QString() : page->items()->rows()[static_cast<std::size_t>(row)].cells[1].text;
  };
  EXPECT_EQ(shown(QStringLiteral("width")), QStringLiteral("512"));
  EXPECT_GT(shown(QStringLiteral("frames")).toInt(), 0);
  const auto set = [&](const std::vector<std::pair<const char*, const char*>>& fields) {
    FieldsDialog* dialog = page->editSource();
    for (const auto& [key, text] : fields) dialog->field(key)->setText(QString::fromUtf8(text));
    dialog->accept();
    EXPECT_TRUE(waitForJobs(*window_, 60));
    return dialog;
  };
  set({{"exposure_us", "7000"}, {"gain", "3"}, {"region", "0, 0, 256, 128"}, {"trigger", "Software"}});
  const nlohmann::json kept = service().description()["sources"][0];
  EXPECT_EQ(kept["exposure_us"], 7000);
  EXPECT_EQ(kept["gain"], 3);
  EXPECT_EQ(kept["trigger"], "Software");
  EXPECT_EQ(kept["region"], (nlohmann::json{0, 0, 256, 128}));
  EXPECT_EQ(page->state()->tone(), Tone::Accent) << page->state()->sentence().toStdString();
  EXPECT_EQ(shown(QStringLiteral("exposure_us")), QStringLiteral("7000"));
  EXPECT_EQ(shown(QStringLiteral("gain")), QStringLiteral("3"));
  EXPECT_EQ(shown(QStringLiteral("width")), QStringLiteral("256"));
  EXPECT_EQ(shown(QStringLiteral("height")), QStringLiteral("128"));
  EXPECT_GT(shown(QStringLiteral("frames")).toInt(), 0);  // each of them was asked for
  // What the camera cannot do is said in its own range, what is no region before it is asked.
  set({{"exposure_us", "1e12"}});
  EXPECT_EQ(page->state()->tone(), Tone::Bad);
  EXPECT_TRUE(page->state()->sentence().contains(QStringLiteral("allowed"))) << page->state()->sentence().toStdString();
  FieldsDialog* dialog = set({{"region", "0, 0, 256"}});
  EXPECT_TRUE(dialog->isVisible());
  dialog->reject();
  EXPECT_EQ(service().description()["sources"][0]["region"], (nlohmann::json{0, 0, 256, 128}));
  window_->undoStack().undo();
  EXPECT_EQ(service().description()["sources"][0]["exposure_us"], 7000);
}

TEST_F(ConnectionsTest, TheCompensatorRunsLiveBesideTheMeasurement) {
  std::string csv = "time_s,T_spindle_degC,ez_um\n";
  for (int i = 0; i < 50; ++i) csv += std::to_string(10 * i) + ",25," + std::to_string(0.1 * i) + "\n";
  window_->openLog(QString::fromStdString(folder_.write("warm.csv", csv).string()));
  ASSERT_TRUE(waitForJobs(*window_, 60));
  ThermalModel model;
  model.inputs = {{"T_spindle_degC", SignalKind::Temperature, 1.0, 1.0, 20.0, 15.0, 45.0}};
  ThermalOutput output;
  output.name = "ez_um";
  output.unit = "um";
  output.terms = {{0, 5.0, 2.0}};
  model.outputs = {output};
  window_->session().storeResult("thermal", nlohmann::json::object(), {{"model", model.json()}});

  SmallAgent agent;
  agent.observe("T1", "30", localUtc());
  agent.observe("P1", "0.1 0.2 0.0215", localUtc());
  window_->session().setSetting(
      service().descriptionKey(),
      {{"format", "spindrift-connections"},
       {"version", 1},
       {"sources", {{{"name", "mill"}, {"kind", "mtconnect"}, {"url", agent.url()}, {"interval_s", 0.05}}}},
       {"columns",
        {{{"column", "T_spindle_degC"}, {"source", "mill"}, {"item", "T1"}},
         {{"column", "ez_um"}, {"source", "mill"}, {"item", "P1[2]"}}}}});
  auto* page = go<LogCompensatePage>(StepId::Compensate);
  auto* tabs = page->findChild<QTabWidget*>(QStringLiteral("compensatorTabs"));
  tabs->setCurrentIndex(1);
  EXPECT_TRUE(page->live()->state()->sentence().contains(QStringLiteral("Nothing is connected")));
  ASSERT_EQ(service().look(), QString());
  // At rest at 30 degC: 2 um/K over 20 degC, reached by the slew limit of a control.
  ASSERT_TRUE(waitUntil([&] { return page->live()->prediction()->value() == QStringLiteral("20.00 µm"); }, 30000))
      << page->live()->prediction()->value().toStdString() << page->live()->state()->sentence().toStdString();
  EXPECT_EQ(page->live()->measurement()->value(), QStringLiteral("21.50 µm"));
  EXPECT_EQ(page->live()->plot()->series().size(), 2U);
  EXPECT_EQ(page->live()->state()->tone(), Tone::Good);
  picture(QStringLiteral("connections-compensator"));
  agent.stop();
  ASSERT_TRUE(waitUntil([&] { return page->live()->measurement()->value() == QStringLiteral("–"); }));
}

}  // namespace
}  // namespace spindrift::gui
