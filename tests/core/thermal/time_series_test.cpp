// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/time_series.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& text, const TimeSeriesOptions& options = {}) {
  try {
    static_cast<void>(parseTimeSeries(text, "log.csv", options));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TimeSeries, ReadsColumnsOfAnyUnitAndKeepsGapsMissing) {
  const TimeSeries s = parseTimeSeries(
      "time_min,T_a_K,spindle_rpm,ez_um,remark\n0,293.15,0,1,start\n1,,100,2,\n3,294.15,100,,end\n", "log.csv");
  ASSERT_EQ(s.time_s.size(), 3U);
  EXPECT_DOUBLE_EQ(s.time_s[2], 180.0);
  EXPECT_NEAR(s.at("T_a_K").values[0], 20.0, 1e-9);
  EXPECT_TRUE(std::isnan(s.at("T_a_K").values[1]));
  EXPECT_NEAR(s.valueAt(s.at("T_a_K"), 60.0), 20.0 + 1.0 / 3.0, 1e-9);
  EXPECT_DOUBLE_EQ(s.valueAt(s.at("spindle_rpm"), 59.0), 0.0);
  EXPECT_EQ(s.find("remark"), nullptr);
  EXPECT_THAT(s.notes, ::testing::Contains(HasSubstr("remark")));
}

/// A file of several blocks of lines is read as its text is, and its first error is told with its line.
/// A name says the unit that the values have, and what asks by the name of the file finds it all the same.
TEST(TimeSeries, AConvertedTemperatureIsNamedByItsUnit) {
  const TimeSeries s = parseTimeSeries("time_s,T_b_degF,T_c_K,T_c_degC\n0,68,303.15,25\n1,86,304.15,26\n", "log.csv");
  EXPECT_EQ(s.names(), (std::vector<std::string>{"T_b_degC", "T_c_K_degC", "T_c_degC"}));
  EXPECT_NEAR(s.at("T_b_degC").values[1], 30.0, 1e-9);
  EXPECT_EQ(s.find("T_b_degF"), s.find("T_b_degC"));
  EXPECT_EQ(s.find("T_b_K"), s.find("T_b_degC"));
  EXPECT_NEAR(s.at("T_c_K").values[0], 30.0, 1e-9);
  EXPECT_NEAR(s.at("T_c_degC").values[0], 25.0, 1e-9);
  EXPECT_EQ(s.find("T_d_degF"), nullptr);
  TimeSeriesOptions celsius;
  celsius.temperature_unit = "degC";
  EXPECT_NEAR(parseTimeSeries("time_s,T_b_degF\n0,20\n", "log.csv", celsius).at("T_b_degC").values[0], 20.0, 1e-9);
}

TEST(TimeSeries, ALongFileIsReadAsItsText) {
  const spindrift::testing::TempFolder folder;
  std::string text = "time_s,T_a_degC,ez_um,remark\n";
  for (int k = 0; k < 60000; ++k)
    text += fmt::format("{},{:.3f},{},{}\n", k, 20.0 + 1e-3 * (k % 977), k % 7 == 0 ? "" : fmt::format("{}", k % 31),
                        k % 5000 == 0 ? "\"a, b\"" : "");
  std::ofstream(folder / "log.csv") << text;
  const TimeSeries of_file = readTimeSeries(folder / "log.csv");
  const TimeSeries of_text = parseTimeSeries(text, "log.csv");
  ASSERT_EQ(of_file.time_s.size(), 60000U);
  EXPECT_EQ(of_file.time_s, of_text.time_s);
  EXPECT_EQ(of_file.notes, of_text.notes);
  ASSERT_EQ(of_file.signals.size(), 2U);
  EXPECT_EQ(of_file.at("T_a_degC").values, of_text.at("T_a_degC").values);
  EXPECT_DOUBLE_EQ(of_file.at("ez_um").values[59999], 59999 % 31);
  EXPECT_TRUE(std::isnan(of_file.at("ez_um").values[7]));
  std::ofstream(folder / "log.csv", std::ios::app) << "59998,20,1,\n60000,20,1,\n";
  try {
    static_cast<void>(readTimeSeries(folder / "log.csv"));
    ADD_FAILURE() << "a clock that runs back is read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("line 60002"));
    EXPECT_THAT(error.what(), HasSubstr("the clock jumps back from 59999 to 59998"));
  }
}

TEST(TimeSeries, RefusesWhatCannotBeMeant) {
  EXPECT_THAT(refusal("time_s,a_um\n0,1\n10,2\n5,3\n"),
              HasSubstr("line 4, column time_s: the clock jumps back from 10 to 5"));
  EXPECT_THAT(refusal("time_s,a_um\n0,1\n10,nan\n"), HasSubstr("empty field"));
  EXPECT_THAT(refusal("time_s,a_um\n0,1\n10,x\n"), HasSubstr("\"x\" is not a number"));
  EXPECT_THAT(refusal("second,a_um\n0,1\n"), HasSubstr("no time column"));
  EXPECT_THAT(refusal("time_s,T_a_degC\n0,293\n10,294\n"), HasSubstr("kelvin"));
  EXPECT_THAT(refusal("time_s,T_a_degC,T_b_degC\n0,70,68\n10,71,69\n"), HasSubstr("Fahrenheit"));
  TimeSeriesOptions fahrenheit;
  fahrenheit.temperature_unit = "degF";
  EXPECT_NEAR(parseTimeSeries("time_s,T_a_degC\n0,68\n", "log.csv", fahrenheit).at("T_a_degC").values[0], 20.0, 1e-9);
}

TEST(TimeSeries, AWordAmongNumbersOfAnotherSignalIsMissing) {
  const TimeSeries s =
      parseTimeSeries("time_s,ez_um,flow,alarm\n0,1,4,none\n10,2,fail,E7\n20,3,6,0\n30,4,1e999,0\n", "log.csv");
  ASSERT_EQ(s.at("flow").values.size(), 4U);
  EXPECT_TRUE(std::isnan(s.at("flow").values[1]));
  EXPECT_EQ(s.at("flow").values[2], 6.0);
  EXPECT_THAT(s.notes, ::testing::Contains(HasSubstr("2 of 4 values of flow are missing")));
  const TimeSeries words = parseTimeSeries("time_s,ez_um,alarm\n0,1,none\n10,2,E7\n20,3,0\n", "log.csv");
  EXPECT_EQ(words.signals.size(), 1U);
  EXPECT_THAT(words.notes, ::testing::Contains(HasSubstr("Column alarm holds text")));
}

TEST(TimeSeries, FindsOutliersStepsAndGaps) {
  std::string text = "time_s,a_um\n";
  for (int i = 0; i < 200; ++i) {
    if (i >= 90 && i < 100) continue;
    const double value = 0.01 * std::sin(i * 1.7) + (i >= 150 ? 2.0 : 0.0) + (i == 50 ? 3.0 : 0.0);
    text += fmt::format("{},{}\n", 10 * i, value);
  }
  const TimeSeries s = parseTimeSeries(text, "log.csv");
  const SignalQuality q = signalQuality(s, s.at("a_um"));
  EXPECT_EQ(q.outliers, 1U);
  ASSERT_EQ(q.steps_at_s.size(), 1U);
  EXPECT_DOUBLE_EQ(q.steps_at_s[0], 1500.0);
  EXPECT_DOUBLE_EQ(q.longest_gap_s, 110.0);
}

TEST(TimeSeries, AveragingKeepsSlowAndRemovesFastContent) {
  std::string text = "time_s,a_um\n";
  // 0.3 um at a period of 7 s would alias to slow waves if every sixtieth sample were simply picked.
  for (int i = 0; i < 6000; ++i) text += fmt::format("{},{}\n", i, 0.001 * i + 0.3 * std::sin(2.0 * M_PI * i / 7.0));
  const TimeSeries s = parseTimeSeries(text, "log.csv");
  const TimeSeries slow = resampled(s, 60.0, 0.0);
  double worst = 0.0;
  for (std::size_t i = 1; i + 1 < slow.time_s.size(); ++i)
    worst = std::max(worst, std::abs(slow.signals[0].values[i] - 0.001 * slow.time_s[i]));
  EXPECT_LT(worst, 0.012);
}

TEST(TimeSeries, WhatHoldsUntilTheNextRowActsFromItsTimeOn) {
  // 1000 rpm from 90 s to 210 s, rows at any time; what acts from 60 to 120 s is half of it.
  const TimeSeries s = parseTimeSeries(
      "time_s,spindle_rpm,T_a_degC\n0,0,20\n13,0,20\n55,0,20\n90,-1000,20\n91,-1000,20\n200,-1000,20\n210,0,20\n240,0,"
      "20\n",
      "log.csv");
  const TimeSeries slow = resampled(s, 60.0, 1e300);
  const std::vector<double>& rpm = slow.at("spindle_rpm").values;
  ASSERT_EQ(rpm.size(), 5U);
  for (const auto& [at, value] : {std::pair{0U, 0.0}, {1U, 500.0}, {2U, 1000.0}, {3U, 500.0}, {4U, 0.0}})
    EXPECT_NEAR(rpm[at], value, 1e-9) << at;
}

TEST(TimeSeries, MergesSparseResultsAtTheNearestRow) {
  const TimeSeries fast = parseTimeSeries("time_s,T_a_degC\n0,20\n10,21\n20,22\n", "fast.csv");
  const TimeSeries sparse = parseTimeSeries("time_s,ez_um\n11,5\n500,6\n", "probe.csv");
  const TimeSeries both = merged(fast, sparse, 4.0);
  EXPECT_DOUBLE_EQ(both.at("ez_um").values[1], 5.0);
  EXPECT_TRUE(std::isnan(both.at("ez_um").values[0]));
  EXPECT_THAT(both.notes, ::testing::Contains(HasSubstr("1 values of ez_um")));
  EXPECT_THROW(static_cast<void>(merged(fast, fast, 1.0)), InputError);
}

}  // namespace
}  // namespace spindrift
