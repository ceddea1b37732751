// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/error.h"

#include <gtest/gtest.h>

#include "core/base/csv.h"
#include "core/base/json_reader.h"

namespace spindrift {
namespace {

TEST(SourcePlace, LinesAreNumbersAndWordsAreMadeOfThem) {
  const SourcePlace cell = SourcePlace::atLine("log.csv", 12, "column time_s");
  EXPECT_EQ(cell.line, 12U);
  EXPECT_EQ(cell.words(), "line 12, column time_s");
  EXPECT_EQ(cell.prefix(), "log.csv, line 12, column time_s: ");
  EXPECT_EQ(SourcePlace::atLine("log.csv", 3).prefix(), "log.csv, line 3: ");
  EXPECT_EQ((SourcePlace{"machine.json", "$.axes[0]"}).prefix(), "machine.json, $.axes[0]: ");
  EXPECT_EQ((SourcePlace{"machine.json", ""}).prefix(), "machine.json: ");
  EXPECT_EQ(SourcePlace::atLine({}, 3).prefix(), "line 3: ") << "typed text has lines and no file";
  EXPECT_EQ(SourcePlace().prefix(), "");
}

TEST(InputError, SaysWhereWithANumberAndWhatWithoutThePlace) {
  const InputError wrong(SourcePlace::atLine("log.csv", 12, "column time_s"), "'a' is not allowed; allowed: a number.");
  EXPECT_EQ(wrong.where().line, 12U);
  EXPECT_EQ(wrong.where().place, "column time_s");
  EXPECT_EQ(wrong.sentence(), "'a' is not allowed; allowed: a number.");
  EXPECT_STREQ(wrong.what(), "log.csv, line 12, column time_s: 'a' is not allowed; allowed: a number.");
  EXPECT_EQ(InputError("No campaign is open.").sentence(), "No campaign is open.");
}

TEST(InputError, WhatItQuotesOfTheDataIsPrintable) {
  for (const InputError& error :
       {InputError("\"a\nb\xE4\" is not known."), InputError({}, "\"a\nb\xE4\" is not known.")}) {
    EXPECT_STREQ(error.what(), "\"a b\xEF\xBF\xBD\" is not known.");
    EXPECT_EQ(error.sentence(), error.what());
  }
}

TEST(InputError, ReadersStateTheLine) {
  try {
    const CsvTable table = CsvTable::parse("# a comment\ntime_s,x\n0,1\n1,b\n", "log.csv");
    (void)table.number(1, 1);
    FAIL() << "b is no number";
  } catch (const InputError& wrong) {
    EXPECT_EQ(wrong.where().line, 4U);
    EXPECT_EQ(wrong.where().place, "column x");
  }
  try {
    (void)JsonNode::parse("{\n  \"a\": 1,\n  \"b\": ]\n}", "machine.json");
    FAIL() << "] is no value";
  } catch (const InputError& wrong) {
    EXPECT_EQ(wrong.where().line, 3U);
  }
}

}  // namespace
}  // namespace spindrift
