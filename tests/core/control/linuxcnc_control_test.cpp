// SPDX-License-Identifier: GPL-3.0-or-later
// Against the real control, each in namespaces of its own. Skipped where the package is absent or the right is missing.
#include "core/control/linuxcnc_control.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/connect/linuxcnc_shell.h"
#include "core/connect/linuxcnc_source.h"
#include "core/control/compensation_channel.h"
#include "core/machine/compensation.h"
#include "tests/core/control/private_configuration.h"

namespace spindrift::testing {
namespace {

/// Collects what is wrong in a process that cannot use EXPECT.
class Wrong {
 public:
  void unless(bool good, const std::string& what) {
    if (!good) said_ += what + "; ";
  }
  [[nodiscard]] std::string said() const { return said_; }

 private:
  std::string said_;
};

const char* const touch_floor =
    "G21 G90 G94\n(LOGOPEN,touches.txt)\nG0 Z-20\nG0 X100 Y50\nG0 Z-99.7\nG38.2 Z-101 F60\n(LOG,TOUCH #5061 #5062 "
    "#5063)\nG0 Z-99.7\n(LOGCLOSE)\nM2\n";

double touchedZ(const std::vector<std::string>& lines) {
  std::istringstream words(lines.at(0));
  std::string touch;
  double x = 0.0, y = 0.0, z = 0.0;
  words >> touch >> x >> y >> z;
  return z;
}

std::string said(const std::function<void()>& body) {
  try {
    body();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class LinuxcncReal : public OnPrivateControl {};

TEST_F(LinuxcncReal, TheSourceReadsWhatTheControlIs) {
  EXPECT_EQ(isolated(
                [] {
                  Wrong wrong;
                  RunningControl running;
                  running.control->close();  // its one connection
                  LinuxcncOptions options;
                  options.url = "linuxcnc://127.0.0.1:5007";
                  options.interval_s = 0.05;
                  const auto source = makeLinuxcncSource(options);
                  source->connect({});
                  const std::vector<DataItem> items = source->list(0.1, {});
                  wrong.unless(items.size() > 200, fmt::format("{} items", items.size()));
                  Collected sink;
                  source->subscribe({"position.x", "flood", "machine", "spindle", "joint.2", "hal:T-spindle-degC",
                                     "hal:motion.motion-enabled", "hal:nowhere"},
                                    sink, {});
                  (void)pollUntil(*source, sink, [&] { return sink.records.size() >= 16; });
                  wrong.unless(source->unit("position.x") == "MILLIMETER", "unit " + source->unit("position.x"));
                  wrong.unless(sink.records.size() >= 16, "records");
                  wrong.unless(sink.records.at(0).value == 0.0 && sink.records.at(1).text == "OFF" &&
                                   sink.records.at(2).text == "OFF" && sink.records.at(3).text == "OFF",
                               "words");
                  wrong.unless(sink.values(5).at(0) == 20.0, "temperature");
                  wrong.unless(sink.values(6).at(0) == 0.0, "off");
                  wrong.unless(sink.records.at(7).quality == Quality::Unavailable && sink.notes.size() == 1,
                               "a pin that is not there");
                  // Killed: a loss that is said, and a connection again when it is back.
                  running.process->kill();
                  std::string lost;
                  for (int i = 0; i < 300 && lost.empty(); ++i) lost = said([&] { source->poll(0.02, sink); });
                  running.start();
                  running.control->close();
                  const std::string again = said([&] {
                    source->connect({});
                    source->subscribe({"position.x", "hal:T-spindle-degC"}, sink, {});
                    (void)pollUntil(*source, sink, [&] { return sink.records.size() >= 30; });
                  });
                  wrong.unless(again.empty(), again);
                  wrong.unless(sink.missings.size() == 1, "what was missed");
                  return wrong.said();
                },
                {}, 60.0),
            "");
}

TEST_F(LinuxcncReal, ItsStatesAreUnderstoodAndSaid) {
  using Condition = ControlState::Condition;
  EXPECT_EQ(isolated(
                [] {
                  Wrong wrong;
                  RunningControl running;
                  LinuxcncControl& control = *running.control;
                  for (const ControlFinding& finding : control.check())
                    wrong.unless(finding.good, finding.what + ": " + finding.sentence);
                  wrong.unless(control.state().condition == Condition::EmergencyStop, "emergency stop");
                  wrong.unless(has(said([&] { control.switchOn(false); }), "not confirmed"), "switched on unasked");
                  wrong.unless(control.state().condition == Condition::EmergencyStop, "still in emergency stop");
                  wrong.unless(has(said([&] { control.start(running.approved(touch_floor)); }), "emergency stop"),
                               "started in e-stop");
                  control.switchOn(true);
                  wrong.unless(control.state().ready(), control.state().sentence);
                  wrong.unless(has(said([&] {
                                     (void)ApprovedProgram::approve("G0 X400\nM2\n", threeAxisMill(), {0, 0, 0},
                                                                    [](const DryRun&) { return true; });
                                   }),
                                   "outside the travel"),
                               "outside");
                  wrong.unless(has(said([&] {
                                     (void)ApprovedProgram::approve("G0 X4\nM2\n", threeAxisMill(), {0, 0, 0},
                                                                    [](const DryRun&) { return false; });
                                   }),
                                   "not confirmed"),
                               "unconfirmed");
                  control.start(running.approved("G21 G90\nG1 X100 F1200\nM2\n"));
                  wrong.unless(control.state().condition == Condition::Busy, "busy");
                  wrong.unless(has(said([&] { control.start(running.approved("G0 X0\nM2\n")); }), "is running"),
                               "started while busy");
                  control.abort();
                  wrong.unless(waitUntil([&] { return control.state().ready(); }, 5.0), "aborted");
                  // No contact: the words of the control.
                  (void)running.run("G21 G90\nG0 Z-50\nG38.2 Z-60 F600\nM2\n");
                  const std::vector<std::string> words = control.messages();
                  wrong.unless(!words.empty() && has(words[0], "G38.2"), "a touch without contact is said");
                  running.process->kill();
                  const bool gone =
                      waitUntil([&] { return control.state().condition == Condition::Unreachable; }, 10.0);
                  wrong.unless(gone, "killed: " + control.state().sentence);
                  running.start();
                  wrong.unless(running.control->state().condition == Condition::EmergencyStop, "restarted");
                  return wrong.said();
                },
                {}, 90.0),
            "");
}

TEST_F(LinuxcncReal, TouchesComeWithTheErrorAndWithoutItOnceCompensated) {
  EXPECT_EQ(
      isolated(
          [] {
            Wrong wrong;
            RunningControl running;
            LinuxcncControl& control = *running.control;
            HalCommands truth;
            truth.start();
            control.switchOn(true);
            const auto um = [&](double z) { return 1e3 * (z + 100.0); };
            const double without = um(touchedZ(running.run(touch_floor)));
            wrong.unless(std::abs(without) < 1.1, fmt::format("no error: {} um", without));
            truth.setSignals({{"error-z", -0.05}});  // the tool is 50 um longer: a probe reads +50
            const double with = um(touchedZ(running.run(touch_floor)));
            wrong.unless(std::abs(with - 50.0) < 1.1, fmt::format("error: {} um", with));
            control.openChannel(false);
            const auto applied = [&] {
              CompensationStatus status;
              for (int i = 0; i < 200 && !(status.watched && std::abs(status.applied_um.z() - 50.0) < 0.01); ++i) {
                status = control.compensate({0.0, 0.0, 50.0});
                ::usleep(50000);
              }
              return status.watched && std::abs(status.applied_um.z() - 50.0) < 0.01;
            };
            // While it is kept alive; the position that the control shows does not know of it.
            const auto touched = [&] {
              control.start(running.approved(touch_floor));
              while (!control.state().ready()) {
                (void)control.compensate({0.0, 0.0, 50.0});
                ::usleep(50000);
              }
              return um(touchedZ(control.printed()));
            };
            wrong.unless(applied(), "not applied");
            const double compensated = touched();
            wrong.unless(std::abs(compensated) < 1.1, fmt::format("compensated: {} um", compensated));
            // The operator switches the machine off. The channel is opened anew, as a driver does that comes back.
            control.close();
            {
              LinuxcncShell operators({});
              operators.connect({});
              wrong.unless(operators.set("enable EMCTOO") && operators.set("machine off"), "the operator is refused");
            }
            control.connect({});
            wrong.unless(waitUntil([&] { return control.state().condition == ControlState::Condition::Off; }, 5.0),
                         "off: " + control.state().sentence);
            control.switchOn(true);
            control.openChannel(false);
            wrong.unless(applied(), "not applied after off and on");
            const double again = touched();
            wrong.unless(std::abs(again) < 1.1, fmt::format("compensated after off and on: {} um", again));
            return wrong.said();
          },
          {}, 60.0),
      "");
}

/// What the drives add after the driver has fallen silent for long enough.
std::string silence(bool hold, double expected_um) {
  Wrong wrong;
  RunningControl running;
  running.control->switchOn(true);
  running.control->openChannel(hold);
  for (int i = 0; i < 100; ++i) {
    if (std::abs(running.control->compensate({0.0, 0.0, 20.0}).applied_um.z() - 20.0) < 0.01) break;
    ::usleep(50000);
  }
  HalCommands watch;
  watch.start();
  const auto applied = [&] {
    double value = 0.0;
    (void)parseNumber(watch.read({"offset-z.offset"}).at(0).value_or(""), value);
    return 1e3 * value;
  };
  wrong.unless(std::abs(applied() - 20.0) < 0.1, "applied before");
  running.control->close();  // as a kill does
  double last = applied(), largest_step = 0.0;
  for (int i = 0; i < 50; ++i) {
    ::usleep(100000);
    const double now = applied();
    largest_step = std::max(largest_step, std::abs(now - last));
    last = now;
  }
  wrong.unless(std::abs(last - expected_um) < 0.1, fmt::format("{} um after silence", last));
  // 20 um/s in the control: no more than that in a tenth of a second, with a busy machine's delays.
  wrong.unless(largest_step < 10.0, fmt::format("a step of {} um", largest_step));
  // Back: from where it stands.
  running.control->connect({});
  running.control->openChannel(hold);
  wrong.unless(std::abs(running.control->compensation().wanted_um.z() - expected_um) < 0.1, "goes on from there");
  wrong.unless(running.control->compensation().watched, "watched again");
  return wrong.said();
}

TEST_F(LinuxcncReal, SilenceFadesToZero) {
  EXPECT_EQ(isolated([] { return silence(false, 0.0); }, {}, 60.0), "");
}

TEST_F(LinuxcncReal, SilenceHoldsWhereThatWasChosen) {
  EXPECT_EQ(isolated([] { return silence(true, 20.0); }, {}, 60.0), "");
}

/// 0.5 um per mm along Z.
class LongScrew final : public ErrorModel {
 public:
  explicit LongScrew(double sign) : sign_(sign) {}
  [[nodiscard]] std::string description() const override { return "a screw that grew"; }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& q, Component component) const override {
    return {component == Component::EZ ? sign_ * 0.5 * q.position_mm.z() : 0.0, 0.0};
  }

 private:
  double sign_;
};

/// Reading of the floor at -100 mm, um off, where the screw is 0.5 um per mm too long and a table was loaded.
std::string touchedWithTable(LinuxcncTable table, double sign, double least_um, double most_um) {
  Wrong wrong;
  ControlConfiguration configuration = cornerInTheMiddle();
  configuration.compensation_file[2] = "z.comp";
  configuration.compensation_type = static_cast<int>(table);
  RunningControl running(configuration, [&](const std::filesystem::path& folder) {
    writeFileAtomically(folder / "z.comp", linuxcncCompensation(LongScrew(sign), threeAxisMill(), "Z",
                                                                Eigen::Vector3d::Zero(), 11, {}, table));
  });
  HalCommands truth;
  truth.start();
  truth.setPin("tip-z.gain0", "1.0005");
  running.control->switchOn(true);
  const double um = 1e3 * (touchedZ(running.run(touch_floor)) + 100.0);
  wrong.unless(um >= least_um && um <= most_um, fmt::format("{:.1f} um", um));
  return wrong.said();
}

TEST_F(LinuxcncReal, StaticTablesOfBothTypesTakeTheErrorAway) {
  EXPECT_EQ(isolated([] { return touchedWithTable(LinuxcncTable::ActualPositions, 1.0, -1.1, 0.1); }, {}, 60.0), "");
  EXPECT_EQ(isolated([] { return touchedWithTable(LinuxcncTable::Trim, 1.0, -1.1, 0.1); }, {}, 60.0), "");
}

TEST_F(LinuxcncReal, ATableWithItsSignTurnedWouldDoubleTheError) {
  EXPECT_EQ(isolated([] { return touchedWithTable(LinuxcncTable::ActualPositions, -1.0, 98.0, 101.0); }, {}, 60.0), "");
  EXPECT_EQ(isolated([] { return touchedWithTable(LinuxcncTable::Trim, -1.0, 98.0, 101.0); }, {}, 60.0), "");
}

TEST_F(LinuxcncReal, TheControlLimitsWhatItIsTold) {
  EXPECT_EQ(isolated(
                [] {
                  Wrong wrong;
                  ControlConfiguration configuration = cornerInTheMiddle();
                  configuration.limit_mm = 0.03;
                  configuration.speed_mm_s = 0.1;
                  RunningControl running(configuration);
                  running.control->switchOn(true);
                  running.control->openChannel(false);
                  CompensationStatus status;
                  for (int i = 0; i < 40; ++i) {
                    status = running.control->compensate({0.0, 0.0, -500.0});
                    ::usleep(50000);
                  }
                  wrong.unless(std::abs(status.applied_um.z() + 30.0) < 0.01,
                               fmt::format("{} um", status.applied_um.z()));
                  return wrong.said();
                },
                {}, 60.0),
            "");
}

}  // namespace
}  // namespace spindrift::testing
