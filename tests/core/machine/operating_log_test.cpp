// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/operating_log.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "core/base/csv.h"
#include "core/base/error.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;

TEST(OperatingLog, StatesHoldAndTemperaturesAreInterpolated) {
  const testing::TempFolder folder;
  const auto log = OperatingLog::read(folder.write(
      "log.csv", "time_s,spindle_rpm,T_room_degC,note,extra\n0,1000,20,idle,1\n100,3000,24,run,2\n200,0,22,idle,3\n"));
  EXPECT_DOUBLE_EQ(log.at("spindle_rpm", 99.9), 1000.0);
  EXPECT_DOUBLE_EQ(log.at("spindle_rpm", 100.0), 3000.0);
  EXPECT_DOUBLE_EQ(log.at("T_room_degC", 50.0), 22.0);
  EXPECT_DOUBLE_EQ(log.at("T_room_degC", -10.0), 20.0);
  EXPECT_DOUBLE_EQ(log.at("T_room_degC", 1e6), 22.0);
  EXPECT_THAT(log.names(), ElementsAre("spindle_rpm", "T_room_degC", "extra"));
  EXPECT_THAT(log.temperatureNames(), ElementsAre("T_room_degC"));
}

TEST(OperatingLog, GapsAreFilledByTheRuleOfTheSignal) {
  const testing::TempFolder folder;
  const auto log = OperatingLog::read(
      folder.write("log.csv", "time_s,spindle_rpm,T_room_degC\n0,,\n10,500,20\n20,,\n40,,26\n50,0,\n"));
  EXPECT_THAT(*log.signal("spindle_rpm"), ElementsAre(500, 500, 500, 500, 0));
  EXPECT_THAT(*log.signal("T_room_degC"), ElementsAre(20, 20, 22, 26, 26));
}

TEST(OperatingLog, ExtraColumnsOfAnyContentNeverMakeItUnreadable) {
  const testing::TempFolder folder;
  const auto log = OperatingLog::read(folder.write("log.csv",
                                                   "time_s,alarm,spindle_rpm,program,load\n0,0,1000,\"O1, a\",1\n"
                                                   "1,E-stop,2000,7,\n2,nan,0,inf,1e999\n3,,0,-,2\n"));
  EXPECT_THAT(log.names(), ElementsAre("spindle_rpm", "load"));
  EXPECT_THAT(*log.signal("spindle_rpm"), ElementsAre(1000, 2000, 0, 0));
  EXPECT_THAT(*log.signal("load"), ElementsAre(1, 1, 1, 2));
}

TEST(OperatingLog, AWordAmongNumbersIsAValueThatIsNotKnown) {
  const testing::TempFolder folder;
  const auto file =
      folder.write("log.csv", "time_s,flow,load,state,power\n0,4,1,on,9\n1,fail,inf,,1e999\n2,,3,off,8\n3,6,4,5,7\n");
  const auto log = OperatingLog::read(file);
  EXPECT_THAT(log.names(), ElementsAre("flow", "load", "power"));
  EXPECT_THAT(*log.signal("flow"), ElementsAre(4, 4, 4, 6));
  EXPECT_THAT(*log.signal("load"), ElementsAre(1, 1, 3, 4));
  EXPECT_THAT(*log.signal("power"), ElementsAre(9, 9, 8, 7));
  EXPECT_THAT(OperatingLog::remarks(file),
              ElementsAre("The column state of the log was left out: \"on\" in line 2 and 1 more of its fields are no "
                          "numbers."));
}

TEST(OperatingLog, BadInputIsNamed) {
  const testing::TempFolder folder;
  const auto complaint = [&](const char* text) -> std::string {
    try {
      (void)OperatingLog::read(folder.write("log.csv", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(complaint("spindle_rpm\n1\n"), ::testing::HasSubstr("\"time_s\" is missing"));
  EXPECT_THAT(complaint("time_s,spindle_rpm\n0,1\n-1,1\n"), ::testing::HasSubstr("line 3, column time_s"));
  EXPECT_THAT(complaint("time_s,T_a_degC\n0,nan\n"), ::testing::HasSubstr("column T_a_degC"));
  EXPECT_THAT(complaint("time_s,spindle_rpm\n0,1\n1,oops\n"), ::testing::HasSubstr("\"oops\""));
  EXPECT_THAT(complaint("time_s\n"), ::testing::HasSubstr("no rows"));
}

TEST(OperatingLog, TemperaturesInAnotherUnitAreNotTakenForDegC) {
  const testing::TempFolder folder;
  const auto read = [&](const char* rows) {
    return OperatingLog::read(folder.write("log.csv", std::string("time_s,T_a_degC,T_b_degC\n") + rows));
  };
  EXPECT_THAT(testing::refusal([&] { (void)read("0,20,293\n10,20,294\n20,20,295\n"); }),
              ::testing::AllOf(::testing::HasSubstr("column T_b_degC"), ::testing::HasSubstr("looks like kelvin")));
  EXPECT_THAT(read("0,68,70\n10,68,75\n").doubtOfTemperatureUnit(), ::testing::HasSubstr("T_a_degC begins at 68.0"));
  EXPECT_EQ(read("0,20,70\n10,20,75\n").doubtOfTemperatureUnit(), "") << "a hot motor beside a room";
  EXPECT_EQ(read("0,,\n10,,\n").doubtOfTemperatureUnit(), "");
}

TEST(OperatingLog, TimesThatAreRepeatedAreTold) {
  const testing::TempFolder folder;
  const auto remarks = [&](const char* rows) {
    return OperatingLog::remarks(folder.write("log.csv", std::string("time_s,a\n") + rows));
  };
  EXPECT_THAT(remarks("0,1\n5,2\n5,3\n5,4\n"),
              ElementsAre("The log repeats the time of the row before 2 times; the last row of one time holds."));
  EXPECT_THAT(remarks("0,1\n5,2\n6,3\n"), ElementsAre());
}

/// What reading it complains of, or "accepted".
std::string complaintOf(const std::string& text) {
  const testing::TempFolder folder;
  try {
    (void)OperatingLog::read(folder.write("log.csv", text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Longer than a block of the reader, with lines of very different length, words, quotes and comments.
std::string longLog(const std::string& line_end) {
  std::string text =
      "\xef\xbb\xbf"
      "# begun" +
      line_end + "time_s,T_room_degC,note,load,\"program, number\"" + line_end;
  for (int row = 0; row < 30000; ++row) {
    text += fmt::format("{},{},{},{},\"{}\"{}", row, row % 7 == 0 ? "" : fmt::format("{:.2f}", 20.0 + 1e-4 * row),
                        row % 5 == 0 ? "\"said \"\"späť\"\", twice\"" : "", 0.5 * row, row % 3, line_end);
    if (row % 1000 == 0) text += "# " + std::string(static_cast<std::size_t>(row) * 11, 'x') + "ä€😀" + line_end;
  }
  return text;
}

TEST(OperatingLog, ALongLogIsReadAsATableIs) {
  for (const std::string line_end : {"\n", "\r\n"}) {
    const testing::TempFolder folder;
    std::string text = longLog(line_end);
    text.resize(text.size() - line_end.size());  // the last line need not end
    const CsvTable table = CsvTable::parse(text, "log.csv");
    const OperatingLog log = OperatingLog::read(folder.write("log.csv", text));
    EXPECT_THAT(log.names(), ElementsAre("T_room_degC", "load", "program, number"));
    EXPECT_EQ(log.time_s(), table.numbers("time_s"));
    EXPECT_EQ(*log.signal("load"), table.numbers("load"));
    EXPECT_EQ(*log.signal("program, number"), table.numbers("program, number"));
    ASSERT_EQ(log.signal("T_room_degC")->size(), 30000U);
    EXPECT_DOUBLE_EQ(log.signal("T_room_degC")->at(12345), 21.23);
  }
}

TEST(OperatingLog, AFaultFarDownALongLogIsNamedWithItsLine) {
  const std::string good = longLog("\n");
  const auto line = std::count(good.begin(), good.end(), '\n') + 1;
  const auto at = [&](const std::string& column) { return fmt::format("log.csv, line {}, column {}", line, column); };
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_THAT(complaintOf(good + "30000,warm,,1,1\n"), AllOf(HasSubstr(at("T_room_degC")), HasSubstr("\"warm\"")));
  EXPECT_THAT(complaintOf(good + "5,20,,1,1\n"), AllOf(HasSubstr(at("time_s")), HasSubstr("from 29999 to 5;")));
  EXPECT_THAT(complaintOf(good + ",20,,1,1\n"), AllOf(HasSubstr(at("time_s")), HasSubstr("\"\" is not a number")));
  EXPECT_THAT(complaintOf(good + "30000,20,1,5,\n"), HasSubstr("accepted"));
  EXPECT_THAT(complaintOf(good + "30000,20,1\n"), HasSubstr(fmt::format("line {}: 3 fields instead of 5", line)));
  EXPECT_THAT(complaintOf(good + "30000,\"20,1\n"), HasSubstr(fmt::format("line {}: a quoted field", line)));
  EXPECT_THAT(complaintOf(good + "30000,\xe4,,1,1\n"), HasSubstr(fmt::format("line {}: the byte 0xE4", line)));
  EXPECT_THAT(complaintOf(good + std::string("30000,\0,,1,1\n", 13)), HasSubstr("not a text file"));
}

TEST(OperatingLog, OfSeveralFaultsTheSameIsToldWhateverItsLine) {
  using ::testing::HasSubstr;
  // Bytes, then rows, then the time, then the columns from left to right.
  const std::string fill(600000, '#');
  const std::string faults = "time_s,T_a_degC,T_b_degC\n0,1,oops\n1,bad,2\n";
  EXPECT_THAT(complaintOf(faults), HasSubstr("line 3, column T_a_degC"));
  EXPECT_THAT(complaintOf(faults + "0,1,2\n"), HasSubstr("line 4, column time_s"));
  EXPECT_THAT(complaintOf(faults + "0,1,2\n2,2\n"), HasSubstr("line 5: 2 fields"));
  EXPECT_THAT(complaintOf(faults + "0,1,2\n2,2\n" + fill + "\n# \xe4\n"), HasSubstr("line 7: the byte"));
  EXPECT_THAT(complaintOf(faults + "0,1,2\n2,2\n# \xe4\n" + fill + std::string("\n\0", 2)), HasSubstr("zero bytes"));
  EXPECT_THAT(complaintOf("T_a_degC\noops\n1,2\n"), HasSubstr("line 3: 2 fields"));
  EXPECT_THAT(complaintOf("T_a_degC\noops\n"), HasSubstr("\"time_s\" is missing"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(OperatingLog, ReadingNeedsLittleMoreMemoryThanTheNumbers) {
  constexpr int rows = 40000;
  constexpr int signals = 60;
  std::string line;
  for (int k = 0; k < signals; ++k) line += fmt::format(",{:.3f}", 20.0 + 0.37 * k);
  std::string text = "time_s";
  for (int k = 0; k < signals; ++k) text += fmt::format(",T_{}_degC", k);
  text += '\n';
  for (int row = 0; row < rows; ++row) text += fmt::format("{}{}\n", row, line);
  const testing::TempFolder folder;
  const std::filesystem::path file = folder.write("log.csv", text);
  // In a process of its own, whose peak begins with what it has now; what the text takes stays taken.
  const auto peak_kB = [] {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    return used.ru_maxrss;
  };
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto before = peak_kB();
    const OperatingLog log = OperatingLog::read(file);
    const double grown = 1024.0 * static_cast<double>(peak_kB() - before);
    ::_exit(log.names().size() == signals && grown < 1.3 * 8.0 * rows * (signals + 1) ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}
#endif

}  // namespace
}  // namespace spindrift
