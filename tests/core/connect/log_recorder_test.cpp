// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/connect/log_recorder.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/connect/recording.h"
#include "core/machine/operating_log.h"
#include "tests/support/child_process.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double t0 = 1769846400.0;

/// A source "a" with the given columns, item i for column i.
Connections mapping(const std::vector<std::string>& names) {
  Connections out;
  out.sources.push_back({"a", "mtconnect", "http://127.0.0.1:1", nullptr});
  for (const std::string& name : names) {
    ColumnMapping column;
    column.column = name;
    column.address = "item" + std::to_string(out.columns.size());
    column.item = static_cast<std::uint32_t>(out.columns.size());
    column.reduction = OperatingLog::isTemperature(name) ? Reduction::Mean : Reduction::Last;
    out.columns.push_back(column);
  }
  out.settle_s = 2.0;
  return out;
}

Arrival value(std::uint32_t item, double time_s, double number) {
  Record record;
  record.item = item;
  record.time_s = t0 + time_s;
  record.value = number;
  return {0, record};
}

Arrival word(std::uint32_t item, double time_s, const std::string& text) {
  Record record;
  record.item = item;
  record.time_s = t0 + time_s;
  record.quality = text == "UNAVAILABLE" ? Quality::Unavailable : Quality::Text;
  record.text = text;
  return {0, record};
}

Arrival said(Notice::Kind kind, double time_s, const std::string& text = "because") {
  return {0, Notice{kind, t0 + time_s - 1.0, t0 + time_s, text}};
}

std::size_t rowsIn(const std::filesystem::path& file) {
  return OperatingLog::read(file).time_s().size();
}

TEST(LogRecorder, StatesHoldAndTemperaturesAreWrittenBeforeTheyChange) {
  const TempFolder folder;
  Connections c = mapping({"spindle_rpm", "T_a_degC"});
  c.columns[1].dead_band = 0.5;
  c.longest_s = 1000.0;
  LogRecorder recorder(c, folder / "log.csv", t0, t0);
  recorder.take(said(Notice::Kind::Connected, 0.0));
  for (int i = 0; i < 100; ++i) {
    recorder.take(value(0, i + 0.5, i < 50 ? 0.0 : 6000.0));
    recorder.take(value(1, i + 0.5, i < 70 ? 20.0 + 0.001 * i : 22.0));
    recorder.advance(t0 + i + 0.6);
  }
  recorder.finish(t0 + 100.0);
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_LT(log.time_s().size(), 10U);
  EXPECT_EQ(log.at("spindle_rpm", 50.5), 0.0);
  EXPECT_EQ(log.at("spindle_rpm", 51.0), 6000.0);
  EXPECT_NEAR(log.at("T_a_degC", 69.5), 20.07, 0.01);
  EXPECT_NEAR(log.at("T_a_degC", 72.5), 22.0, 1e-9);
  EXPECT_NEAR(log.time_s().back(), 100.0, 1e-9);
  EXPECT_EQ(recorder.status().columns[1].records, 100U);
}

TEST(LogRecorder, ReductionsWeighByTime) {
  const TempFolder folder;
  Connections c = mapping({"T_a_degC", "feed_x_mm_min", "peak", "low"});
  c.columns[1].reduction = Reduction::MeanAbsolute;
  c.columns[2].reduction = Reduction::Max;
  c.columns[3].reduction = Reduction::Min;
  LogRecorder recorder(c, folder / "log.csv", t0, t0);
  for (std::uint32_t i = 0; i < 4; ++i) {
    recorder.take(value(i, 0.0, 10.0));
    recorder.take(value(i, 0.75, -30.0));  // a quarter of the second
  }
  recorder.finish(t0 + 1.0);
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_NEAR(log.at("T_a_degC", 1.0), 0.0, 1e-9);
  EXPECT_NEAR(log.at("feed_x_mm_min", 1.0), 15.0, 1e-9);
  EXPECT_NEAR(log.at("peak", 1.0), 10.0, 1e-9);
  EXPECT_NEAR(log.at("low", 1.0), -30.0, 1e-9);
}

TEST(LogRecorder, HeldStatesAreConfirmedWhileTheSourceIsThereAndNotAfterwards) {
  const TempFolder folder;
  Connections c = mapping({"coolant"});
  c.longest_s = 10.0;
  LogRecorder recorder(c, folder / "log.csv", t0, t0);
  recorder.take(said(Notice::Kind::Connected, 0.0));
  recorder.take(value(0, 0.1, 1.0));
  recorder.advance(t0 + 60.0);
  const std::uint64_t rows = recorder.status().rows;
  EXPECT_GE(rows, 5U);
  recorder.take(said(Notice::Kind::Lost, 60.0));
  recorder.advance(t0 + 200.0);
  EXPECT_EQ(recorder.status().rows, rows);
  recorder.take(said(Notice::Kind::Resumed, 200.0));
  recorder.take(said(Notice::Kind::Missed, 200.0, "it was off"));
  recorder.advance(t0 + 300.0);
  EXPECT_EQ(recorder.status().rows, rows);  // unknown until something comes
  recorder.take(value(0, 300.5, 0.0));
  recorder.finish(t0 + 303.0);
  EXPECT_THAT(readFile(folder / "log.csv"),
              HasSubstr("# a: values between 199.000 s and 200.000 s may be missing: it was off"));
  EXPECT_EQ(OperatingLog::read(folder / "log.csv").at("coolant", 302.0), 0.0);
}

TEST(LogRecorder, WordsUnitsAndNonsense) {
  const TempFolder folder;
  Connections c = mapping({"coolant", "T_a_degC", "pos_x_mm"});
  c.columns[0].values = {{"ON", 1.0}, {"OFF", 0.0}};
  LogRecorder recorder(c, folder / "log.csv", t0, t0);
  recorder.take(said(Notice::Kind::Connected, 0.0));
  recorder.take({0, ItemUnits{{"", "FAHRENHEIT", "CELSIUS"}}});
  recorder.take(word(0, 0.1, "ON"));
  recorder.take(value(1, 0.1, 212.0));
  recorder.take(value(2, 0.1, 5.0));
  recorder.take(word(0, 1.1, "BROKEN"));
  recorder.take(word(0, 1.2, "BROKEN"));
  recorder.take(word(1, 1.2, "warm"));
  recorder.take(value(1, 1.3, std::numeric_limits<double>::infinity()));
  recorder.take(word(0, 2.1, "OFF"));
  recorder.take(word(0, 3.1, "UNAVAILABLE"));
  recorder.finish(t0 + 5.0);
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_NEAR(log.at("T_a_degC", 1.0), 100.0, 1e-6);
  EXPECT_EQ(log.at("coolant", 1.0), 1.0);
  EXPECT_EQ(log.at("coolant", 3.0), 0.0);
  EXPECT_EQ(recorder.status().columns[0].refused, 2U);
  EXPECT_EQ(recorder.status().columns[2].records, 0U);
  EXPECT_THAT(recorder.status().sentences, Contains(HasSubstr("\"BROKEN\"")));
  EXPECT_THAT(recorder.status().sentences, Contains(HasSubstr("CELSIUS, which cannot become mm")));
  // Each said once.
  EXPECT_EQ(recorder.status().sentences.size(), 3U);
}

TEST(LogRecorder, OneThatWouldBeginLaterWritesNothing) {
  const TempFolder folder;
  EXPECT_THAT(refusal([&] { LogRecorder(mapping({"S"}), folder / "log.csv", t0 + 1e6, t0); }), HasSubstr("begins at"));
  EXPECT_FALSE(std::filesystem::exists(folder / "log.csv"));
  LogRecorder recorder(mapping({"S"}), folder / "log.csv", t0, t0);
  recorder.finish(t0 + 1.0);
}

TEST(LogRecorder, WhatDoesNotChangeIsWrittenOnce) {
  const TempFolder folder;
  LogRecorder recorder(mapping({"T_a_degC"}), folder / "log.csv", t0, t0);
  recorder.take(said(Notice::Kind::Connected, 0.0));
  // Means over intervals that the readings cut differently are not the same in the last digit.
  for (int i = 0; i < 300; ++i) {
    recorder.take(value(0, 0.1 + 0.173 * i, 98.6));
    recorder.advance(t0 + 0.173 * i);
  }
  recorder.finish(t0 + 55.0);
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_NEAR(log.at("T_a_degC", 30.0), 98.6, 1e-9);
  EXPECT_LE(recorder.status().rows, 2U);
}

TEST(LogRecorder, LateValuesAreNotLost) {
  const TempFolder folder;
  LogRecorder recorder(mapping({"S", "U"}), folder / "log.csv", t0, t0);
  recorder.take(said(Notice::Kind::Connected, 0.0));
  for (int i = 0; i < 30; ++i) {
    recorder.take(value(0, i + 0.5, i));
    recorder.advance(t0 + i + 0.6);
  }
  for (int i = 0; i < 30; ++i) recorder.take(value(1, i + 0.25, 100 + i));  // a network that was paused
  EXPECT_GT(recorder.status().late, 20U);
  EXPECT_TRUE(std::filesystem::exists(folder / "log.late.csv"));
  recorder.finish(t0 + 31.0);
  EXPECT_FALSE(std::filesystem::exists(folder / "log.late.csv"));
  const OperatingLog log = OperatingLog::read(folder / "log.csv");  // time does not run backwards
  for (int i = 0; i < 30; ++i) EXPECT_EQ(log.at("U", i + 1.0), 100 + i) << i;
  for (int i = 0; i < 30; ++i) EXPECT_EQ(log.at("S", i + 1.0), i) << i;
}

TEST(LogRecorder, GoesOnWithItsLogAndRefusesAnother) {
  const TempFolder folder;
  const Connections c = mapping({"S"});
  {
    LogRecorder recorder(c, folder / "log.csv", t0, t0);
    recorder.take(value(0, 0.5, 1.0));
    recorder.finish(t0 + 1.0);
  }
  {
    std::ofstream torn(folder / "log.csv", std::ios::app);
    torn << "77.0";  // the power failed
  }
  {
    LogRecorder recorder(c, folder / "log.csv", t0 + 500.0, t0 + 10.0);  // the log keeps its own start
    EXPECT_EQ(recorder.startUtc(), t0);
    recorder.take(value(0, 10.5, 2.0));
    recorder.finish(t0 + 11.0);
    EXPECT_THAT(recorder.status().sentences, Contains(HasSubstr("was incomplete")));
  }
  EXPECT_EQ(OperatingLog::read(folder / "log.csv").at("S", 11.0), 2.0);
  EXPECT_THAT(refusal([&] {
                LogRecorder other(mapping({"S", "U"}), folder / "log.csv", t0, t0 + 20.0);
              }),
              HasSubstr("has the columns \"time_s,S\""));
  EXPECT_THAT(refusal([&] { LogRecorder early(c, folder / "log.csv", t0, t0 + 3.0); }), HasSubstr("ends at"));
  LogRecorder first(c, folder / "log.csv", t0, t0 + 20.0);
  EXPECT_THAT(refusal([&] { LogRecorder second(c, folder / "log.csv", t0, t0 + 20.0); }), HasSubstr("another program"));
}

TEST(LogRecorder, RotatesAndEachFileStandsAlone) {
  const TempFolder folder;
  Connections c = mapping({"S", "held"});
  c.rotate_mb = 0.002;
  c.longest_s = 1e9;
  LogRecorder recorder(c, folder / "log.csv", t0, t0);
  recorder.take(value(1, 0.5, 7.0));
  for (int i = 0; i < 1000; ++i) {
    recorder.take(value(0, i + 0.5, i));
    recorder.advance(t0 + i + 0.6);
  }
  recorder.finish(t0 + 1000.0);
  EXPECT_GE(recorder.status().rotations, 3U);
  std::size_t values = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const OperatingLog log = OperatingLog::read(entry.path());
    values += log.time_s().size();
    EXPECT_EQ(log.at("held", log.time_s().back()), 7.0);
  }
  EXPECT_GE(values, 1000U);
}

TEST(LogRecorder, AFullDiskLosesNothing) {
  const TempFolder folder;
  const std::string answer = inChildProcess([&]() -> std::string {
    Connections c = mapping({"S"});
    c.settle_s = 0.0;
    LogRecorder recorder(c, folder / "log.csv", t0, t0);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4000, RLIM_INFINITY};
    ::setrlimit(RLIMIT_FSIZE, &small);
    for (int i = 0; i < 1000; ++i) {
      recorder.take(value(0, i + 0.5, i));
      recorder.advance(t0 + i + 1.1);
    }
    const std::string problem = recorder.status().problem;
    if (recorder.status().backlog < 500) return "the limit was not felt";
    const std::string text = readFile(folder / "log.csv");
    if (!text.ends_with('\n')) return "half a line stands at the end";
    const rlimit wide{RLIM_INFINITY, RLIM_INFINITY};
    ::setrlimit(RLIMIT_FSIZE, &wide);
    recorder.advance(t0 + 1010.0);
    if (recorder.status().backlog != 0) return "not written again";
    recorder.finish(t0 + 1010.0);
    return problem;
  });
  EXPECT_THAT(answer, HasSubstr("cannot be written"));
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(log.at("S", i + 1.0), i);
}

TEST(LogRecorder, KilledAtAnyMomentTheLogIsWhole) {
  const TempFolder folder;
  Connections c = mapping({"S"});
  c.settle_s = 0.0;
  std::size_t before = 0;
  for (int round = 0; round < 3; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      LogRecorder recorder(c, folder / "log.csv", t0, t0 + 1e6 * round);
      for (int i = 0;; ++i) {
        recorder.take(value(0, 1e6 * round + i + 0.5, i));
        recorder.advance(t0 + 1e6 * round + i + 1.1);
      }
    }
    for (int i = 0; i < 500; ++i) {
      ::usleep(10000);
      std::error_code none;
      if (std::filesystem::file_size(folder / "log.csv", none) > (before + 1) * 20000 + 100 && !none) break;
    }
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    before = rowsIn(folder / "log.csv") / 1000;
    ASSERT_GT(before, 0U);
  }
}

}  // namespace
}  // namespace spindrift::testing
