// SPDX-License-Identifier: GPL-3.0-or-later
// Against a stand-in that has the traps of linuxcncrsh, and a `halcmd` of a few lines; the real control is in
// tests/core/control.
#include "core/connect/linuxcnc_source.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "core/connect/connections.h"
#include "core/connect/hal_commands.h"
#include "core/connect/linuxcnc_shell.h"
#include "core/connect/source_runner.h"
#include "tests/core/connect/collected.h"
#include "tests/core/connect/small_shell.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

LinuxcncOptions quick(const SmallShell& shell) {
  LinuxcncOptions options;
  options.url = shell.url();
  options.interval_s = 0.02;
  options.answer_s = 0.5;
  return options;
}

/// `halcmd` in a folder that stands first in PATH, for as long as this lives.
class SmallHal {
 public:
  SmallHal() : path_(std::getenv("PATH")) {
    const std::filesystem::path file = folder_.write("halcmd", R"(#!/bin/sh
n=0
speed=1500
while read -r command name value; do
  n=$((n+1))
  case "$command $name" in
    "getp spindle.0.speed-out") echo $speed ;;
    "getp motion.motion-enabled") echo TRUE ;;
    "gets t-spindle") echo 31.25 ;;
    "getp die") exit 1 ;;
    "getp hang") sleep 5 ;;
    "sets t-spindle") ;;
    "show pin") echo "motmod float OUT 1500 spindle.0.speed-out ==> l-rpm"; echo; echo "motmod bit IN FALSE probe" ;;
    "show sig") echo "float 31.25 t-spindle" ;;
    *) echo "<stdin>:$n: '$name' not found" >&2 ;;
  esac
done
)");
    std::filesystem::permissions(file, std::filesystem::perms(0755));
    ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  ~SmallHal() { ::setenv("PATH", path_.c_str(), 1); }

 private:
  TempFolder folder_;
  std::string path_;
};

TEST(Linuxcnc, ReadsPositionsAndStateInAnyPieces) {
  SmallShell shell;
  shell.hold("user_linear_units", "MM");
  shell.hold("abs_act_pos", "1.500000 -2.250000 0.000000 0.000000 0.000000 0.000000");
  shell.hold("joint_pos 2", "2 -7.125000");
  shell.hold("flood", "ON");
  shell.hold("spindle 0", "0 FORWARD");
  for (const bool pieces : {false, true}) {
    SmallShell::Manners manners;
    manners.pieces = pieces;
    shell.set(manners);
    const auto source = makeLinuxcncSource(quick(shell));
    source->connect({});
    Collected sink;
    source->subscribe({"position.x", "position.y", "joint.2", "flood", "spindle", "mist", "position.w"}, sink, {});
    EXPECT_EQ(source->unit("position.x"), "MILLIMETER");
    EXPECT_EQ(source->unit("flood"), "");
    ASSERT_EQ(sink.notes.size(), 1U);
    EXPECT_THAT(sink.notes[0], AllOf(HasSubstr("position.w"), HasSubstr("position.x")));
    ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 6; }));
    EXPECT_EQ(sink.values(0).at(0), 1.5);
    EXPECT_EQ(sink.values(1).at(0), -2.25);
    EXPECT_EQ(sink.values(2).at(0), -7.125);
    EXPECT_EQ(sink.records[3].text, "ON");
    EXPECT_EQ(sink.records[4].text, "FORWARD");
    EXPECT_EQ(sink.records[5].quality, Quality::Unavailable);  // a NAK is no fault of the connection
    EXPECT_EQ(sink.notes.size(), 2U);
    EXPECT_THAT(sink.notes.back(), HasSubstr("refuses \"get mist\""));
  }
  // Nothing that a reader has no business with: no enable, no mode, no `get spindle` without its number.
  for (const std::string& said : shell.heard()) {
    EXPECT_THAT(said, Not(HasSubstr("enable")));
    EXPECT_NE(said, "get spindle");
    if (said.starts_with("set ")) {
      EXPECT_THAT(said, ::testing::AnyOf("set echo off", "set verbose on"));
    }
  }
}

TEST(Linuxcnc, WhatWouldCrashTheShellIsNeverSent) {
  SmallShell shell;
  LinuxcncShell client({{"127.0.0.1", shell.port()}, "EMC", 0.5});
  client.connect({});
  for (const char* request : {"spindle", "brake", "spindle_override"})
    EXPECT_THROW((void)client.get(request), std::invalid_argument);
  EXPECT_THROW((void)client.set("mdi " + std::string(300, 'G')), std::invalid_argument);
  EXPECT_THROW((void)client.set("mdi G0 X1\r\nset machine off"), std::invalid_argument);
  EXPECT_TRUE(client.set("mode manual"));  // still connected
  shell.hold("refuse machine", "");
  EXPECT_FALSE(client.set("machine on"));
  shell.hold("error", "Can't do that in ESTOP");
  EXPECT_THAT(client.errors(), ElementsAre("Can't do that in ESTOP"));
  EXPECT_THAT(client.errors(), IsEmpty());
}

TEST(Linuxcnc, ASecondClientSilenceAndRefusalAreSaid) {
  SmallShell shell;
  shell.hold("flood", "OFF");
  const auto said = [&](const SmallShell::Manners& manners) -> std::string {
    shell.set(manners);
    LinuxcncShell client({{"127.0.0.1", shell.port()}, "tellnobody", 0.2});
    try {
      client.connect({});
      (void)client.get("flood");
    } catch (const ConnectionError& error) {
      EXPECT_FALSE(client.connected());
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(said({}), "");
  SmallShell::Manners manners;
  manners.mixed = true;
  EXPECT_THAT(said(manners), AllOf(HasSubstr("MACHINE OFF"), HasSubstr("can serve one only")));
  manners = {};
  manners.mute = true;
  EXPECT_THAT(said(manners), HasSubstr("does not answer within 0.2 s"));
  manners = {};
  manners.other_hello = "HELLO NAK tellnobody";
  EXPECT_THAT(said(manners), AllOf(HasSubstr("--connectpw"), Not(HasSubstr("tellnobody"))));
}

TEST(Linuxcnc, CrashAndRestartAreALossAndAReturn) {
  SmallShell shell;
  shell.hold("flood", "ON");
  SmallShell::Manners manners;
  manners.crash_after = 12;
  shell.set(manners);
  auto queue = std::make_shared<RecordQueue>();
  RunnerOptions options;
  options.first_pause_s = 0.05;
  SourceRunner runner(0, makeLinuxcncSource(quick(shell)), {"flood"}, queue, options);
  std::vector<Arrival> taken;
  int lost = 0, resumed = 0, missed = 0, values = 0;
  const auto count = [&] {
    queue->take(taken, 0.02);
    for (const Arrival& arrival : taken) {
      if (const auto* notice = std::get_if<Notice>(&arrival.what)) {
        lost += notice->kind == Notice::Kind::Lost ? 1 : 0;
        resumed += notice->kind == Notice::Kind::Resumed ? 1 : 0;
        missed += notice->kind == Notice::Kind::Missed ? 1 : 0;
      }
      values += std::holds_alternative<Record>(arrival.what) ? 1 : 0;
    }
  };
  ASSERT_TRUE(waitUntil([&] {
    count();
    return resumed >= 1 && values > 12;
  }));
  EXPECT_EQ(lost, 1);
  EXPECT_GE(missed, 1);
  shell.stop();
  ASSERT_TRUE(waitUntil([&] {
    count();
    return lost >= 2;
  }));
  shell.start();
  const int before = values;
  ASSERT_TRUE(waitUntil([&] {
    count();
    return values > before;
  }));
  EXPECT_TRUE(runner.stop());
}

TEST(Linuxcnc, PinsAndSignalsComeThroughHalcmdAloneWhereNothingElseIsWanted) {
  const SmallHal hal;
  SmallShell shell;
  const auto source = makeLinuxcncSource(quick(shell));
  source->connect({});
  Collected sink;
  source->subscribe({"hal:t-spindle", "hal:nowhere", "hal:spindle.0.speed-out", "hal:motion.motion-enabled"}, sink, {});
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 8; }));
  EXPECT_EQ(sink.values(0).at(0), 31.25);
  EXPECT_EQ(sink.records[1].quality, Quality::Unavailable);
  EXPECT_EQ(sink.values(2).at(0), 1500.0);
  EXPECT_EQ(sink.values(3).at(0), 1.0);
  ASSERT_EQ(sink.notes.size(), 1U);
  EXPECT_THAT(sink.notes[0], HasSubstr("\"nowhere\""));
  EXPECT_EQ(shell.connections(), 0);  // the one connection is left to whoever drives the control
}

TEST(Linuxcnc, ListsWhatItsPinsAre) {
  const SmallHal hal;
  SmallShell shell;
  shell.hold("user_linear_units", "INCH");
  shell.hold("abs_act_pos", "1.500000 -2.250000 0.000000");
  const auto source = makeLinuxcncSource(quick(shell));
  source->connect({});
  const std::vector<DataItem> items = source->list(0.1, {});
  std::vector<std::string> addresses;
  for (const DataItem& item : items) addresses.push_back(item.address);
  EXPECT_THAT(addresses, ElementsAre("position.x", "position.y", "position.z", "hal:spindle.0.speed-out", "hal:probe",
                                     "hal:t-spindle"));
  EXPECT_EQ(items[0].unit, "INCH");
  EXPECT_EQ(items[0].example, "1.500000");
}

TEST(Linuxcnc, AHalcmdThatDiesOrHangsIsSaidAndGone) {
  const SmallHal small;
  HalCommands hal(0.3);
  hal.start();
  EXPECT_EQ(hal.read({"spindle.0.speed-out"}).at(0), "1500");
  hal.setSignals({{"t-spindle", 20.0}});
  try {
    hal.setSignals({{"t-nobody", 20.0}});
    ADD_FAILURE();
  } catch (const ConnectionError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'t-nobody' not found"));
  }
  EXPECT_TRUE(hal.started());
  for (const char* fault : {"die", "hang"}) {
    hal.start();
    EXPECT_THROW((void)hal.read({fault}), ConnectionError);
    EXPECT_FALSE(hal.started());
    EXPECT_THROW((void)hal.read({"probe"}), ConnectionError);
  }
}

TEST(Linuxcnc, ItsAddressesAreCheckedWhenTheFileIsRead) {
  for (const char* wrong : {"position", "position.q", "joint.99", "joint.x", "hal:", "hal:a b", "hal:a\nsets b 1"})
    EXPECT_THROW(checkLinuxcncAddress(wrong), std::invalid_argument) << wrong;
  EXPECT_EQ(sourceForAddress("linuxcnc://127.0.0.1:5007").kind, "linuxcnc");
}

}  // namespace
}  // namespace spindrift::testing
