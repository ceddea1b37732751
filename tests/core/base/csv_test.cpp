// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/csv.h"

#include <gmock/gmock.h>

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string complaint(const std::string& text, const std::function<void(const CsvTable&)>& use = {}) {
  try {
    const CsvTable table = CsvTable::parse(text, "log.csv");
    if (use) use(table);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Csv, ReadsCommentsCrlfByteOrderMarkQuotesAndBlanks) {
  const CsvTable table = CsvTable::parse(
      "\xef\xbb\xbf# a comment\r\ntime_s, name ,note\r\n0,a,\"x, \"\"y\"\"\"\r\n\r\n# more\n1.5e1, b ,\n", "t.csv");
  EXPECT_THAT(table.columnNames(), ElementsAre("time_s", "name", "note"));
  ASSERT_EQ(table.rowCount(), 2U);
  EXPECT_THAT(table.numbers("time_s"), ElementsAre(0.0, 15.0));
  EXPECT_EQ(table.text(0, 2), "x, \"y\"");
  EXPECT_EQ(table.text(1, 1), "b");
  EXPECT_TRUE(table.empty(1, 2));
  EXPECT_EQ(table.place(1).line, 6U);
}

TEST(Csv, NamesFileLineColumnAndValueOfABadNumber) {
  for (const std::string bad : {"x", "nan", "inf", "1.0.0", "0x10", ""}) {
    EXPECT_THAT(complaint("a,b\n1,2\n3," + bad + "\n", [](const CsvTable& t) { (void)t.numbers("b"); }),
                AllOf(HasSubstr("log.csv, line 3, column b"), HasSubstr("\"" + bad + "\""), HasSubstr("allowed")));
  }
}

TEST(Csv, SaysWhenNumbersAreWrittenWithADecimalComma) {
  EXPECT_THAT(complaint("time_s,value\n0,5,1,25\n"), HasSubstr("decimal comma"));
  EXPECT_THAT(complaint("time_s,value\n0,5,x\n"), AllOf(HasSubstr("line 2"), HasSubstr("3 fields instead of 2")));
}

TEST(Csv, RefusesWhatIsNoTable) {
  EXPECT_THAT(complaint(""), HasSubstr("is empty"));
  EXPECT_THAT(complaint("# only a comment\n"), HasSubstr("is empty"));
  EXPECT_THAT(complaint("a;b\n1;2\n"), HasSubstr("separated by semicolons"));
  EXPECT_THAT(complaint("a\tb\n1\t2\n"), HasSubstr("separated by tabs; allowed: commas"));
  EXPECT_THAT(complaint("a,a\n"), HasSubstr("appears twice"));
  EXPECT_THAT(complaint("a,,c\n"), HasSubstr("no name"));
  EXPECT_THAT(complaint(std::string("a,b\n1\0,2\n", 9)), HasSubstr("not a text file"));
  EXPECT_THAT(complaint("a,b\n\"x,2\n"), HasSubstr("not closed"));
  EXPECT_THAT(complaint("a,b\n1,2\n", [](const CsvTable& t) { (void)t.column("c"); }),
              AllOf(HasSubstr("column \"c\" is missing"), HasSubstr("a and b")));
  EXPECT_THROW((void)CsvTable::read("/nonexistent/file.csv"), InputError);
}

TEST(Csv, RefusesBytesThatAreNoUtf8) {
  for (const std::string bad : {"\xe4", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\x80", "\xe2\x82"})
    for (const std::string& text : {"a,b\n1," + bad + "\n", "a,b" + bad + "\n1,2\n", "a,b\n# " + bad + "\n1,2\n"})
      EXPECT_THAT(complaint(text), AllOf(HasSubstr("log.csv, line"), HasSubstr("not UTF-8"))) << text;
  EXPECT_EQ(complaint("a,b\n\xc3\xa4,\xf0\x9f\x98\x80\xe2\x82\xac\n"), "no complaint");
}

TEST(Csv, WritesNothingThatASpreadsheetRuns) {
  for (const std::string text : {"=1+1", "+1+cmd", "-x", "@sum", "\t=1", "'=1", "''=1"}) {
    const std::string field = csvField(text);
    EXPECT_THAT(field, AnyOf(StartsWith("'"), StartsWith("\"'"))) << text;
    EXPECT_EQ(CsvTable::parse("h\n" + field + "\n", "t").text(0, 0), text);
  }
  for (const std::string text : {"-1.5", "+2", "'quoted", "a=b"}) {
    EXPECT_EQ(csvField(text), text);
    EXPECT_EQ(CsvTable::parse("h\n" + text + "\n", "t").text(0, 0), text);
  }
}

TEST(Csv, WritesFieldsThatReadBack) {
  for (const std::string text : {"plain", "a,b", "say \"x\"", "#1", " # ", " padded ", "\ttab"}) {
    EXPECT_EQ(CsvTable::parse("h,i\n" + csvField(text) + ",1\n", "t").numbers("i").size(), 1U) << text;
    EXPECT_EQ(CsvTable::parse("h\n" + csvField(text) + "\n", "t").text(0, 0), text);
  }
  // A row is a line: what breaks one is kept as a blank.
  EXPECT_EQ(CsvTable::parse("h\n" + csvField("two\r\nlines") + "\n", "t").text(0, 0), "two  lines");
}

}  // namespace
}  // namespace spindrift
