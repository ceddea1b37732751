// SPDX-License-Identifier: GPL-3.0-or-later
// A program whose answer is a known formula, and all that may go wrong with a program.
#include "core/simulator/program_simulator.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "core/base/text.h"
#include "tests/core/simulator/small_simulator.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::expectOneSentence;
using testing::failure;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::observation;
using testing::parameter;
using testing::refusal;

bool isGone(const std::string& process) {
  std::ifstream stat("/proc/" + process + "/stat");
  std::string text;
  std::getline(stat, text);
  return text.empty() || text.find(") Z ") != std::string::npos;
}

/// The processes whose numbers the program wrote are no more, or will be in a moment.
void expectGone(const fs::path& numbers) {
  const std::vector<std::string> processes = splitList(readFile(numbers), '\n');
  EXPECT_EQ(processes.size(), 2u);
  for (const std::string& process : processes) {
    for (int i = 0; i < 100 && !isGone(process); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(isGone(process));
  }
}

/// EX = a t / 3600 + b, EY = a^2 at point P1; `mode` is what goes wrong.
class ProgramSimulatorTest : public testing::SimulatorTest {
 protected:
  ProgramSimulatorTest() {
    temp.write("sim/values.txt.in", "a {{a}}\nb {{b*1e-3 + 0*a}}\nmode {{mode}}\n");
    temp.write("sim/run.sh", script());
    json = {{"format", "spindrift-simulator"},
            {"version", 1},
            {"kind", "command"},
            {"templates", nlohmann::json::array({"values.txt.in"})},
            {"include", nlohmann::json::array({"run.sh"})},
            {"run", nlohmann::json::parse(R"([["sh", "run.sh"]])")},
            {"result", "simulation.csv"},
            {"time_limit_s", 30},
            {"parameters", nlohmann::json::array({parameter("a", 2, -10, 10), parameter("b", 500, 0, 1000),
                                                  parameter("mode", 0, 0, 20)})}};
    at.rows = {observation("P1", Component::EX, 0), observation("P1", Component::EX, 1800),
               observation("P1", Component::EY, 7200), observation("P1", Component::EX, 9000),
               observation("P2", Component::EX, 0)};
  }

  [[nodiscard]] std::string script() const {
    return fmt::format(
        R"(echo run >> {0}/count
mode=$(awk '$1=="mode"{{print $2}}' values.txt)
case $mode in
  1) echo "no licence left"; exit 3;;
  2) echo $$ > {0}/pid; sleep 60 & echo $! >> {0}/pid; wait;;
  3) exit 0;;
  4) printf 'time_s,point,component,predicted\n0,P1,EX,nan\n' > simulation.csv; exit 0;;
  6) : > simulation.csv; exit 0;;
  7) kill -SEGV $$;;
  8) sleep 0.3;;
  9) echo $OMP_NUM_THREADS >> {0}/threads;;
  10) echo '# spoiled' >> run.sh; echo spoiled >> values.txt;;
esac
awk -v mode=$mode '$1=="a"{{a=$2}} $1=="b"{{b=$2}} END{{
  print "time_s,point,component,predicted"
  for (t = 0; t <= (mode == 5 ? 3600 : 7200); t += 3600) {{
    printf "%d,P1,EX,%.9g\n", t, a * t / 3600 + b
    printf "%d,P1,EY,%.9g\n", t, a * a
  }} }}' values.txt > simulation.csv
)",
        temp.path().string());
  }
  [[nodiscard]] std::unique_ptr<ProgramSimulator> open() const {
    return std::make_unique<ProgramSimulator>(openSimulatorFile(temp.write("sim/simulator.json", json.dump(1))), log);
  }
  [[nodiscard]] std::size_t timesRun() const {
    const fs::path file = temp / "count";
    return fs::exists(file) ? splitList(readFile(file), '\n').size() : 0;
  }
  [[nodiscard]] std::string failureOf(double mode) const {
    return failure([&] { (void)open()->run({{"mode", mode}}, at, {}); });
  }
  /// What opening says after a change of simulator.json.
  [[nodiscard]] std::string refusalOf(const char* pointer, const nlohmann::json& value) const {
    nlohmann::json changed = json;
    changed[nlohmann::json::json_pointer(pointer)] = value;
    const fs::path file = temp.write("sim/simulator.json", changed.dump(1));
    return refusal([&] { ProgramSimulator(openSimulatorFile(file), log); });
  }

  nlohmann::json json;
  std::optional<OperatingLog> log;
  ObservationSet at;
};

TEST_F(ProgramSimulatorTest, GivesTheFormulaAtTheObservations) {
  const auto simulator = open();
  const SimulatorRun own = simulator->run({}, at, {});
  EXPECT_DOUBLE_EQ(own.predicted[0], 0.5);
  EXPECT_DOUBLE_EQ(own.predicted[1], 1.5) << "linear between rows";
  EXPECT_DOUBLE_EQ(own.predicted[2], 4.0);
  EXPECT_TRUE(std::isnan(own.predicted[3])) << "never beyond the rows";
  EXPECT_TRUE(std::isnan(own.predicted[4]));
  EXPECT_EQ(own.rows.size(), 6u);
  EXPECT_GT(own.elapsed_s, 0.0);
  const SimulatorRun other = simulator->run({{"simulation.a", 3}, {"b", 0}}, at, {});
  EXPECT_DOUBLE_EQ(other.predicted[1], 1.5);
  EXPECT_DOUBLE_EQ(other.predicted[2], 9.0);
  EXPECT_EQ(foldersLeft(), 0u);
  EXPECT_FALSE(fs::exists(temp / "sim/simulation.csv"));
}

TEST_F(ProgramSimulatorTest, RunsTheProgramOnceForTheSameInput) {
  const auto simulator = open();
  const SimulatorRun first = simulator->run({{"a", 1.0 / 3.0}}, at, {});
  const SimulatorRun second = simulator->run({{"a", 1.0 / 3.0}}, at, {});
  EXPECT_EQ(timesRun(), 1u);
  EXPECT_EQ(second.elapsed_s, 0.0);
  EXPECT_EQ(first.predicted[1], second.predicted[1]);
  const SimulatorRun later = open()->run({{"a", 1.0 / 3.0}}, at, {});
  EXPECT_EQ(timesRun(), 1u) << "kept on the disk";
  EXPECT_EQ(later.elapsed_s, 0.0);
  EXPECT_EQ(first.predicted[1], later.predicted[1]) << "to the last digit";
  temp.write("sim/run.sh", script() + "# another program\n");
  (void)simulator->run({{"a", 1.0 / 3.0}}, at, {});
  EXPECT_EQ(timesRun(), 2u);
  for (const auto& entry : fs::directory_iterator(temp / "cache/simulator")) {
    std::ofstream(entry.path()) << "time_s,point\n1";  // damaged
  }
  EXPECT_DOUBLE_EQ(open()->run({{"a", 1.0 / 3.0}}, at, {}).predicted[1], first.predicted[1]);
  EXPECT_EQ(timesRun(), 3u);
}

TEST_F(ProgramSimulatorTest, TwoThreadsThatAskForTheSameRunItOnce) {
  const auto simulator = open();
  std::vector<SimulatorRun> runs(4);
  {
    std::vector<std::jthread> pool;
    for (SimulatorRun& run : runs) pool.emplace_back([&] { run = simulator->run({{"mode", 8}}, at, {}); });
  }
  EXPECT_EQ(timesRun(), 1u);
  for (const SimulatorRun& run : runs) EXPECT_DOUBLE_EQ(run.predicted[1], 1.5);
}

TEST_F(ProgramSimulatorTest, RunsSetsAtTheSameTimeAndTellsWhichFailed) {
  setenv("SPINDRIFT_THREADS", "4", 1);
  const auto simulator = open();
  std::vector<ParameterValues> sets;
  for (int i = 0; i < 8; ++i) sets.push_back({{"a", i}, {"mode", i == 3 ? 1 : 0}});
  const SimulatorRuns out = runAll(*simulator, sets, at, {}, "runs");
  unsetenv("SPINDRIFT_THREADS");
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_EQ(out.failed[i].empty(), i != 3) << out.failed[i];
    if (i == 3) continue;
    EXPECT_DOUBLE_EQ(out.runs[i].predicted[2], static_cast<double>(i * i));
  }
  EXPECT_TRUE(out.runs[3].predicted.empty());
  EXPECT_EQ(timesRun(), 8u);
}

TEST_F(ProgramSimulatorTest, GivesTheProgramOneThreadAndCopiesOfItsFiles) {
  const auto simulator = open();
  (void)simulator->run({{"mode", 9}}, at, {});
  EXPECT_EQ(readFile(temp / "threads"), "1\n");
  EXPECT_DOUBLE_EQ(simulator->run({{"mode", 10}}, at, {}).predicted[1], 1.5);
  EXPECT_EQ(readFile(temp / "sim/run.sh"), script()) << "a program that writes into its files spoils copies";
}

TEST_F(ProgramSimulatorTest, TellsInOneSentenceWhyARunFailed) {
  (void)open()->run({}, at, {});
  const std::vector<std::pair<double, std::string>> cases{{1, "ended with status 3 and said \"no licence left\""},
                                                          {2, "was not done after 1 s"},
                                                          {3, "left no simulation.csv"},
                                                          {4, "\"nan\" is not a number"},
                                                          {6, "is empty"},
                                                          {7, "was ended by signal 11"}};
  std::size_t kept = 0;
  for (const auto& [mode, reason] : cases) {
    json["time_limit_s"] = mode == 2 ? 1 : 30;
    const std::string said = failureOf(mode);
    expectOneSentence(said);
    EXPECT_THAT(said, AllOf(HasSubstr("\"sh run.sh\""), HasSubstr(reason), HasSubstr(fmt::format("mode = {}", mode)),
                            HasSubstr("kept in " + (temp / "runs").string())));
    EXPECT_EQ(foldersLeft(), ++kept) << "the folder that the sentence names";
  }
  expectGone(temp / "pid");
  for (const auto& entry : fs::directory_iterator(temp / "runs")) {
    EXPECT_TRUE(fs::exists(entry.path() / "simulator.log"));
    EXPECT_TRUE(fs::exists(entry.path() / "values.txt"));
    EXPECT_FALSE(fs::exists(entry.path() / "run.sh")) << "only log and input";
  }
  json["run"] = nlohmann::json::parse(R"([["no_such_program", "-i"]])");
  const std::string missing = failureOf(0);
  expectOneSentence(missing);
  EXPECT_THAT(missing, AllOf(HasSubstr("\"no_such_program -i\" cannot be started"), HasSubstr("No such file")));
  json["run"] = nlohmann::json::parse(R"([["true"]])");
  EXPECT_THAT(failureOf(0), HasSubstr("left no simulation.csv"));
}

TEST_F(ProgramSimulatorTest, KeepsFewFoldersAndNoLinks) {
  const fs::path outside = temp.write("outside/precious.txt", "precious");
  temp.write("sim/run.sh", fmt::format("ln -s {0} link.txt; ln -s {1} linked; mkdir -p deep/deeper; rm values.txt; "
                                       "ln -s {0} values.txt; exit 3\n",
                                       outside.string(), outside.parent_path().string()));
  const auto simulator = open();
  std::string last;
  for (int run = 0; run < 25; ++run) last = failure([&] { (void)simulator->run({{"a", 0.1 * run}}, at, {}); });
  EXPECT_EQ(foldersLeft(), 20u);
  EXPECT_EQ(readFile(outside), "precious");
  bool named = false;
  for (const auto& entry : fs::directory_iterator(temp / "runs")) {
    named = named || last.find(entry.path().string()) != std::string::npos;
    for (const auto& inside : fs::recursive_directory_iterator(entry.path())) {
      EXPECT_FALSE(inside.is_symlink()) << inside.path();
      EXPECT_FALSE(inside.is_directory()) << inside.path();
    }
  }
  EXPECT_TRUE(named) << "the newest stays: " << last;
}

TEST_F(ProgramSimulatorTest, FailsWhereTheNumberOfPredictionsChanges) {
  const auto simulator = open();
  (void)simulator->run({}, at, {});
  const std::string said = failure([&] { (void)simulator->run({{"mode", 5}}, at, {}); });
  expectOneSentence(said);
  EXPECT_THAT(said, HasSubstr("gave 4 predictions where it gave 6 with other values"));
  EXPECT_DOUBLE_EQ(simulator->run({{"a", 1}}, at, {}).predicted[2], 1.0) << "and goes on";
}

TEST_F(ProgramSimulatorTest, ATemplateWithoutAFiniteValueFails) {
  temp.write("sim/values.txt.in", "a {{1/a}}\nb {{b}}\nmode {{mode}}\n");
  const auto simulator = open();
  const std::string said = failure([&] { (void)simulator->run({{"a", 0}}, at, {}); });
  expectOneSentence(said);
  EXPECT_THAT(said, AllOf(HasSubstr("{{1/a}}"), HasSubstr("a = 0")));
  EXPECT_EQ(timesRun(), 0u);
}

TEST_F(ProgramSimulatorTest, CancelEndsTheProgramAndAllThatItStarted) {
  const auto simulator = open();
  std::stop_source stop;
  std::chrono::steady_clock::time_point asked;
  std::jthread user([&] {
    while (!fs::exists(temp / "pid") || splitList(readFile(temp / "pid"), '\n').size() < 2) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    asked = std::chrono::steady_clock::now();
    stop.request_stop();
  });
  EXPECT_THROW((void)simulator->run({{"mode", 2}}, at, JobContext(stop.get_token(), nullptr)), Cancelled);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count(), 0.5);
  expectGone(temp / "pid");
  EXPECT_EQ(foldersLeft(), 0u);
}

TEST_F(ProgramSimulatorTest, RefusesValuesThatAreNotAllowed) {
  const auto simulator = open();
  const auto said = [&](const ParameterValues& values) {
    return refusal([&] { (void)simulator->run(values, at, {}); });
  };
  EXPECT_THAT(said({{"c", 1}}), AllOf(HasSubstr("no parameter \"c\""), HasSubstr("a, b or mode")));
  EXPECT_THAT(said({{"a", 11}}), HasSubstr("a cannot be 11; allowed: -10 to 10"));
  EXPECT_THAT(said({{"a", std::nan("")}}), HasSubstr("a cannot be nan"));
  EXPECT_EQ(timesRun(), 0u);
}

TEST_F(ProgramSimulatorTest, RefusesASimulatorThatIsNotAsDescribed) {
  const auto expect = [&](const char* pointer, const nlohmann::json& value, const std::string& reason) {
    const std::string said = refusalOf(pointer, value);
    expectOneSentence(said);
    EXPECT_THAT(said, HasSubstr(reason)) << pointer;
    EXPECT_THAT(said, HasSubstr("simulator.json")) << pointer;
  };
  expect("/format", "spindrift-effects", "allowed: \"spindrift-simulator\"");
  expect("/version", 2, "a newer file needs a newer program");
  expect("/kind", "ansys", "scenario, command, calculix or sensitivities");
  expect("/history", "none", "a list");
  expect("/parameters/1/name", "a", "each parameter once");
  expect("/parameters/1/name", "b c", "a letter and then");
  expect("/parameters/1/name", "sensor.b", "a letter and then");
  expect("/parameters/1/min", 2000, "$.parameters[1].min");
  expect("/parameters/1/value", 1001, "from \"min\" 0 to \"max\" 1000 of b");
  expect("/parameters/1/value", "5", "a number");
  expect("/parameters/1/standard_uncertainty", -1, "not negative");
  expect("/parameters/1/effects", nlohmann::json::array({"x", "x"}), "each effect once");
  expect("/templates/0", "../values.txt.in", "within the folder");
  expect("/templates/0", "/etc/passwd", "within the folder");
  expect("/templates/0", "missing.in", "a file in ");
  expect("/templates", nlohmann::json::array(), "at least one template");
  expect("/include/0", "a/../../run.sh", "within the folder");
  expect("/include/0", (temp / "sim/run.sh").string(), "within the folder");
  expect("/include", nlohmann::json::array({"run.sh", "run.sh"}), "beside another one");
  expect("/run", nlohmann::json::array(), "at least one command");
  expect("/run/0", nlohmann::json::array(), "a program and its arguments");
  expect("/run/0/0", "../run.sh", "within the folder");
  expect("/run/0/0", "/bin/sh", "within the folder");
  expect("/result", "../simulation.csv", "within the folder");
  expect("/result", "run.sh", "beside another one");
  expect("/time_limit_s", 0, "greater than zero");
  expect("/tables", nlohmann::json::parse(R"({"ROOM": {"column": "T_room_degC"}})"),
         "which this campaign does not have");
  expect("/tables", nlohmann::json::parse(R"({"SUN": {"window": ["a", "c"]}})"), "the name of a parameter");
  expect("/sensor_values", nlohmann::json::parse(R"({"sensor.T_room_degC.gain": 0.1})"), "a value of a sensor");
}

TEST_F(ProgramSimulatorTest, RefusesALinkOutOfItsFolder) {
  temp.write("outside/values.txt.in", "a\n{{a}}\n");
  std::filesystem::create_symlink(temp / "outside/values.txt.in", temp / "sim/link.in");
  std::filesystem::create_directory_symlink(temp / "outside", temp / "sim/linked");
  for (const char* pointer : {"/templates/0", "/include/0"}) {
    for (const char* name : {"link.in", "linked/values.txt.in"})
      EXPECT_THAT(refusalOf(pointer, name), AllOf(HasSubstr("simulator.json"), HasSubstr("by a link"))) << name;
  }
}

TEST_F(ProgramSimulatorTest, RefusesATemplateWithUnknownNames) {
  const auto said = [&](const std::string& text) {
    temp.write("sim/values.txt.in", text);
    return refusal([&] { (void)open(); });
  };
  EXPECT_THAT(said("a\n{{h_ari*1e-3}}\n"), AllOf(HasSubstr("values.txt.in, line 2"), HasSubstr("names \"h_ari\"")));
  EXPECT_THAT(said("{{table:ROOM}}\n"), AllOf(HasSubstr("line 1"), HasSubstr("names no table")));
  EXPECT_THAT(said("{{a\n}}"), HasSubstr("is not closed on its line"));
  EXPECT_THAT(said("{{a**2}}"), HasSubstr("is not an expression"));
  EXPECT_THAT(said("{{}}"), HasSubstr("is not an expression"));
  EXPECT_THAT(said("{{a, b}}"), HasSubstr("is not an expression"));
  EXPECT_EQ(said("{{ a }} {{sqrt(abs(b))*_pi}} {{1.5e-3*a}}"), "");
}

TEST_F(ProgramSimulatorTest, WritesAVersionThatDiffersInItsValuesOnly) {
  const std::string text = R"({
 "format": "spindrift-simulator", "version": 1, "kind": "command",
 "templates": ["values.txt.in"], "include": ["run.sh"],
 "run": [["sh", "run.sh"]], "result": "simulation.csv",
 "mine": {"kept": 1.50},
 "parameters": [
  {"name": "a",    "value": 2.0, "standard_uncertainty": 1, "min": -10, "max": 10},
  {"name": "b",    "value": 5e2, "standard_uncertainty": 1, "min": 0, "max": 1000},
  {"name": "mode", "value": 0, "standard_uncertainty": 0, "min": 0, "max": 20}
 ]
}
)";
  const ProgramSimulator simulator(openSimulatorFile(temp.write("sim/simulator.json", text)), {});
  simulator.writeVersion({{"a", 2.25}}, temp / "out/v2", {{"what", "a was 2"}});
  EXPECT_EQ(readFile(temp / "sim/simulator.json"), text);
  std::string expected = text;
  expected.replace(expected.find("2.0,"), 3, "2.25");
  const std::string written = readFile(temp / "out/v2/simulator.json");
  const std::size_t history = written.find(",\n \"history\": [{\"what\":\"a was 2\"}]");
  ASSERT_NE(history, std::string::npos) << written;
  std::string without = written;
  without.erase(history, std::string(",\n \"history\": [{\"what\":\"a was 2\"}]").size());
  EXPECT_EQ(without, expected);
  const ProgramSimulator second(openSimulatorFile(temp / "out/v2/simulator.json"), {});
  EXPECT_DOUBLE_EQ(second.run({}, at, {}).predicted[2], 2.25 * 2.25);
  second.writeVersion({{"a", 3}}, temp / "out/v3", {{"what", "a was 2.25"}});
  const nlohmann::json third = nlohmann::json::parse(readFile(temp / "out/v3/simulator.json"));
  EXPECT_EQ(third["history"].size(), 2u);
  EXPECT_EQ(third["history"][1]["what"], "a was 2.25");

  EXPECT_THAT(refusal([&] { simulator.writeVersion({}, temp / "out/v2", {}); }), HasSubstr("is not empty"));
  EXPECT_EQ(readFile(temp / "out/v2/simulator.json"), written);
  EXPECT_THAT(refusal([&] { simulator.writeVersion({{"a", 99}}, temp / "out/v4", {}); }), HasSubstr("cannot be 99"));
  fs::create_directories(temp / "empty");
  simulator.writeVersion({}, temp / "empty", {{"what", "nothing"}});
  EXPECT_TRUE(fs::exists(temp / "empty/run.sh"));
  fs::remove(temp / "sim/run.sh");
  EXPECT_THAT(refusal([&] { simulator.writeVersion({}, temp / "new/deep/v5", {}); }), HasSubstr("cannot be copied"));
  EXPECT_FALSE(fs::exists(temp / "new")) << "nothing half-written";
}

}  // namespace
}  // namespace spindrift
