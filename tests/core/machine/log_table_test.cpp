// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/log_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr TimeColumn names_of_time[] = {{"time_s", 1.0}, {"time_min", 60.0}};

LogTable read(std::string_view text, bool nan_is_missing = false) {
  CsvRows rows(text, "log.csv");
  return LogTable::read(rows, names_of_time, nan_is_missing);
}

std::string complaint(std::string_view text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LogTable, ColumnsOfNumbersKeepTheirGapsAndColumnsOfWordsTheirPlace) {
  const LogTable table = read("a,time_min,note,b\n1,0,2,\n,1,stop,5\n3,1,nan,6\n");
  EXPECT_THAT(table.time_s, ElementsAre(0.0, 60.0, 60.0));
  EXPECT_EQ(table.repeated, 1U);
  ASSERT_EQ(table.columns.size(), 3U);
  const LogColumn& a = table.columns[0];
  EXPECT_EQ(a.name, "a");
  ASSERT_EQ(a.values.size(), 3U);
  EXPECT_TRUE(std::isnan(a.values[1]));
  EXPECT_EQ(a.numbers, 2U);
  EXPECT_EQ(a.missing, 1U);
  EXPECT_FALSE(a.words_at);
  const LogColumn& note = table.columns[1];
  ASSERT_TRUE(note.words_at);
  EXPECT_EQ(note.words_at->line, 3U);
  EXPECT_EQ(note.words, "stop");
  EXPECT_EQ(note.numbers, 1U);
  EXPECT_EQ(note.word_count, 2U);
  EXPECT_TRUE(note.values.empty());
}

TEST(LogTable, AWordAmongNumbersIsNoNumberAndLosesNoOther) {
  const LogTable table = read("time_s,a,b\n0,1,x\n1,inf,\n2,3,2\n");
  EXPECT_EQ(table.columns[0].words, "inf");
  ASSERT_EQ(table.columns[0].values.size(), 3U);
  EXPECT_TRUE(std::isnan(table.columns[0].values[1]));
  EXPECT_EQ(table.columns[0].values[2], 3.0);
  EXPECT_EQ(table.columns[1].values.size(), 3U) << "half of the fields that hold something are numbers";
}

TEST(LogTable, NanIsMissingOnlyWhereItIsAskedFor) {
  EXPECT_EQ(read("time_s,a\n0,nan\n1,2\n").columns[0].words, "nan");
  const LogTable table = read("time_s,a\n0,nan\n1,N/A\n2,2\n", true);
  EXPECT_EQ(table.columns[0].missing, 2U);
  EXPECT_EQ(table.columns[0].numbers, 1U);
}

TEST(LogTable, FaultsOfRowsAreToldBeforeThoseOfTheTime) {
  EXPECT_THAT(complaint("time_s,a\n5,1\n4,1\n6\n"), HasSubstr("line 4: 1 field"));
  EXPECT_THAT(complaint("time_s,a\n5,1\n4,1\n6,1\n"),
              HasSubstr("log.csv, line 3, column time_s: the clock jumps back from 5 to 4; allowed"));
  EXPECT_THAT(complaint("time_s,a\n,1\n"), HasSubstr("line 2, column time_s: \"\" is not a number"));
  EXPECT_THAT(complaint("time_s,a\n"), HasSubstr("holds no rows"));
  EXPECT_THAT(complaint("t,a\n0,1\n"), HasSubstr("there is no time column"));
}

TEST(Bridged, HoldsOrInterpolatesAndKeepsTheEnds) {
  constexpr double no = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> time{0, 10, 20, 40, 50};
  EXPECT_THAT(bridged(time, std::vector<double>{no, 500, no, no, 0}, true), ElementsAre(500, 500, 500, 500, 0));
  EXPECT_THAT(bridged(time, std::vector<double>{no, 20, no, 26, no}, false), ElementsAre(20, 20, 22, 26, 26));
  EXPECT_TRUE(std::isnan(bridged(time, std::vector<double>(5, no), true)[2]));
}

}  // namespace
}  // namespace spindrift
