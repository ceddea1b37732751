// SPDX-License-Identifier: GPL-3.0-or-later
// thermal identify and thermal track on a log made here: a spindle that heats up, a first-order growth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

class Thermal : public ::testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(3);
    const auto noise = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
    std::string text = "time_s,spindle_rpm,T_nose_degC,growth_um\n";
    double heat = 0.0;
    double growth = 0.0;
    double rpm = 0.0;
    for (int k = 0; k < 600; ++k) {
      if (k % 40 == 0) rpm = 1000.0 * static_cast<double>(random() % 7);
      heat += 30.0 / 600.0 * (rpm / 300.0 - heat);
      growth += 30.0 / 900.0 * (rpm / 150.0 - growth);
      text += std::to_string(30 * k) + ',' + std::to_string(rpm) + ',' + std::to_string(20.0 + heat + 0.03 * noise()) +
              ',' + std::to_string(growth + 0.1 * noise()) + '\n';
    }
    log = folder.write("log.csv", text);
  }
  [[nodiscard]] std::vector<std::string> identify(const std::string& inputs = "spindle_rpm") const {
    return {"thermal", "identify", log.string(), "--output", "growth_um",  "--inputs",
            inputs,    "--train",  "0:12000",    "--test",   "12000:18000"};
  }
  void expectRefused(std::vector<std::string> words, const std::vector<std::string>& parts) {
    words.insert(words.end(), {"--json", (folder / "j.json").string(), "--prediction", (folder / "p.csv").string()});
    expectBadInput(words, parts);
    EXPECT_FALSE(std::filesystem::exists(folder / "j.json") || std::filesystem::exists(folder / "p.csv"));
  }

  TempFolder folder;
  std::filesystem::path log;
};

TEST_F(Thermal, IdentifyAndTrackGiveTheKeysOfTheContract) {
  auto words = identify();
  const std::string model = (folder / "model.json").string();
  const std::string prediction = (folder / "prediction.csv").string();
  words.insert(words.end(), {"--model-out", model, "--prediction", prediction});
  const nlohmann::json j = jsonOf(words);
  EXPECT_EQ(j["inputs"], nlohmann::json::array({"spindle_rpm"}));
  for (const char* range : {"train", "test"}) {
    for (const char* key : {"fit_percent", "p2p", "rmse"}) EXPECT_TRUE(j[range][key].is_number()) << range << key;
  }
  EXPECT_GT(j["test"]["fit_percent"].get<double>(), 80.0);
  for (const char* key : {"model", "step_response", "elapsed_ms"}) EXPECT_TRUE(j.contains(key)) << key;
  const auto lines = linesOf(prediction);
  EXPECT_TRUE(lines.front().starts_with("time_s,measured,predicted")) << lines.front();
  EXPECT_EQ(lines.size(), 601U);
  for (const char* update : {"gain", "arx"}) {
    const Outcome tracked = runCli(
        {"thermal", "track", log.string(), "--model", model, "--update", update, "--interval", "3600", "--json", "-"});
    EXPECT_TRUE(tracked.status == 0 || tracked.status == 1) << tracked.error;
    EXPECT_NE(tracked.output.find("fit_percent"), std::string::npos);
    EXPECT_NE(tracked.output.find("p2p"), std::string::npos);
  }
}

TEST_F(Thermal, SeveralOutputsGoIntoOneModelThatPredictsAsEachAlone) {
  // The nose temperature is a second output here: it follows the speed with another lag.
  const std::string model = (folder / "both.json").string();
  const std::string prediction = (folder / "both.csv").string();
  const std::vector<std::string> both = {
      "thermal",     "identify",    log.string(), "--output",     "growth_um,T_nose_degC",
      "--inputs",    "spindle_rpm", "--train",    "0:12000",      "--test",
      "12000:18000", "--model-out", model,        "--prediction", prediction};
  const nlohmann::json j = jsonOf(both);
  ASSERT_EQ(j["outputs"].size(), 2U);
  EXPECT_EQ(j["model"]["outputs"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "growth_um" : "T_nose_degC";
    EXPECT_EQ(j["outputs"][i]["output"], name);
    EXPECT_GT(j["outputs"][i]["test"]["fit_percent"].get<double>(), 80.0) << name;
    const nlohmann::json alone = jsonOf({"thermal", "identify", log.string(), "--output", name, "--inputs",
                                         "spindle_rpm", "--train", "0:12000", "--test", "12000:18000"});
    EXPECT_NEAR(j["outputs"][i]["test"]["rmse"].get<double>(), alone["test"]["rmse"].get<double>(), 1e-12);
    for (const nlohmann::json& input : alone["model"]["inputs"]) EXPECT_EQ(input["name"], "spindle_rpm");
  }
  // Those of the two outputs differ where their training does (its beginning may be left out); none is there twice.
  std::set<std::string> inputs;
  for (const nlohmann::json& input : j["model"]["inputs"]) inputs.insert(input.dump());
  EXPECT_EQ(inputs.size(), j["model"]["inputs"].size()) << "inputs are shared";
  EXPECT_EQ(linesOf(prediction).front(),
            "time_s,measured_growth_um,predicted_growth_um,measured_T_nose_degC,predicted_T_nose_degC");
  // The model file is what the compensator loads, unless an output is none that a machine can be compensated by.
  expectBadInput({"thermal", "compensate", log.string(), "--model", model}, {"T_nose_degC", "allowed: \"um\""});
  auto alone = identify();
  alone.insert(alone.end(), {"--model-out", model});
  ASSERT_EQ(runCli(alone).status, 0);
  const nlohmann::json compensated = jsonOf({"thermal", "compensate", log.string(), "--model", model});
  EXPECT_NE(compensated.dump().find("growth_um"), std::string::npos);
  expectBadInput({"thermal", "identify", log.string(), "--output", "growth_um,growth_um", "--train", "0:12000",
                  "--test", "12000:18000"},
                 {"growth_um", "twice"});
}

TEST_F(Thermal, IsoTestTakesARangeAndAWindow) {
  std::mt19937 random(5);
  std::string text = "time_s,spindle_rpm,X_um\n";
  for (int k = 0; k < 2400; ++k) {
    const int rpm = k < 120 || k >= 1200 ? (k >= 1300 ? 3000 : 0) : 1500;  // two steps of speed
    text += std::to_string(10 * k) + ',' + std::to_string(rpm) + ',' +
            std::to_string(8.0 * (k < 120 ? 0.0 : -std::expm1(-(k - 120) / 200.0)) +
                           0.3 * (static_cast<double>(random() % 2001) / 1000.0 - 1.0)) +
            '\n';
  }
  const std::string file = folder.write("steps.csv", text).string();
  const std::vector<std::string> test = {"thermal", "iso230-3", file, "--test", "spindle"};
  expectBadInput(test, {"several steps", "--range"});
  std::vector<std::string> one = test;
  one.insert(one.end(), {"--range", "0:12500"});
  const nlohmann::json level = jsonOf(one);
  EXPECT_EQ(level["window_s"], 120.0);
  EXPECT_NEAR(level["components"][0]["at_end"].get<double>(), 8.0, 0.3);
  one.insert(one.end(), {"--window", "0"});
  const nlohmann::json single = jsonOf(one);
  EXPECT_GT(single["components"][0]["standard_uncertainty"].get<double>(),
            1.3 * level["components"][0]["standard_uncertainty"].get<double>());
  // What noise adds to the range of single readings is taken off.
  EXPECT_NEAR(single["components"][0]["range"].get<double>(), level["components"][0]["range"].get<double>(), 0.5);
  one.back() = "-1";
  expectBadInput(one, {"--window"});
}

TEST_F(Thermal, TheAxisTestNamesTheFileWithTooFewReadings) {
  const std::string file = folder
                               .write("observations.csv",
                                      "time_s,state,point,x_mm,y_mm,z_mm,component,value,sigma,instrument\n"
                                      "0,M0,A,10,0,0,EX,1.0,0.5,probe\n60,M1,A,10,0,0,EX,2.0,0.5,probe\n")
                               .string();
  expectBadInput({"thermal", "iso230-3", "--test", "axis", "--observations", file},
                 {"observations.csv", "readings of the axis: 2", "allowed"});
}

TEST_F(Thermal, TrackDrawsAndTakesAContext) {
  auto words = identify();
  const std::string model = (folder / "model.json").string();
  words.insert(words.end(), {"--model-out", model});
  ASSERT_EQ(runCli(words).status, 0);
  const std::string svg = (folder / "track.svg").string();
  const std::vector<std::string> track = {"thermal", "track", log.string(), "--model", model, "--interval", "1800"};
  words = track;
  words.insert(words.end(), {"--context", "T_nose_degC", "--svg", svg});
  EXPECT_EQ(jsonOf(words)["sweep"].size(), 7U);
  EXPECT_TRUE(textOf(svg).starts_with("<svg"));
  words = track;
  words.insert(words.end(), {"--context", "T_nose_degC", "--update", "gain"});
  expectBadInput(words, {"--context", "kalman"});
  words = track;
  words.insert(words.end(), {"--context", "growth_um"});
  expectBadInput(words, {"growth_um", "--context"});
  words.back() = "pos_z_mm";
  expectBadInput(words, {"pos_z_mm"});
}

TEST_F(Thermal, NothingMeasuredInTheTestRangeIsUsed) {
  const nlohmann::json honest = jsonOf(identify());
  const std::string prediction = (folder / "a.csv").string();
  auto words = identify();
  words.insert(words.end(), {"--prediction", prediction});
  ASSERT_NE(runCli(words).status, 2);
  std::vector<std::string> lines = linesOf(log);
  for (std::size_t k = 401; k < lines.size(); ++k) lines[k] = lines[k].substr(0, lines[k].rfind(',') + 1) + "1000";
  writeLines(log, lines);
  words.back() = (folder / "b.csv").string();
  ASSERT_NE(runCli(words).status, 2);
  const auto a = linesOf(folder / "a.csv");
  const auto b = linesOf(folder / "b.csv");
  ASSERT_EQ(a.size(), b.size());
  const auto predicted = [](const std::string& line) {
    const std::size_t second = line.find(',', line.find(',') + 1);
    return line.substr(second, line.find(',', second + 1) - second);
  };
  for (std::size_t k = 1; k < a.size(); ++k) ASSERT_EQ(predicted(a[k]), predicted(b[k])) << k;
}

TEST_F(Thermal, BadLogsAreRefusedInOneSentence) {
  expectRefused(identify("no_such_column"), {"log.csv", "no_such_column"});
  expectRefused(identify("growth_um"), {"growth_um"});
  auto words = identify();
  words[8] = "0:1";
  expectRefused(words, {"log.csv", "allowed"});
  words[8] = "zero:12000";
  expectRefused(words, {"zero"});
  words[8] = "12000:0";
  expectRefused(words, {"12000"});
  const std::string good = textOf(log);
  setField(log, 50, "time_s", "3");
  expectRefused(identify(), {"log.csv", "line 50", "jumps back"});
  writeText(log, good);
  setField(log, 60, "spindle_rpm", "fast");
  expectRefused(identify(), {"log.csv", "line 60", "fast"});
  writeText(log, good);
  edit(log, "time_s", "t");
  expectRefused(identify(), {"log.csv", "time_s", "allowed"});
}

TEST_F(Thermal, ConstantCopiedAndIdenticalInputsAreNamed) {
  const std::string good = textOf(log);
  std::vector<std::string> lines = linesOf(log);
  const auto field = [&lines](std::size_t k, int which) {
    std::size_t from = 0;
    for (int i = 0; i < which; ++i) from = lines[k].find(',', from) + 1;
    return lines[k].substr(from, lines[k].find(',', from) - from);
  };
  const auto rewrite = [&](const std::function<std::string(std::size_t)>& row, const std::string& header) {
    std::vector<std::string> out = {header};
    for (std::size_t k = 1; k < lines.size(); ++k) out.push_back(row(k));
    writeLines(log, out);
  };
  const std::string header = lines[0];
  for (const char* method : {"response", "arx", "oe"}) {
    // A constant input: refused where it is asked for, dropped with its reason where it was only a candidate.
    rewrite([&](std::size_t k) { return field(k, 0) + ",1000," + field(k, 2) + ',' + field(k, 3); }, header);
    auto words = identify();
    words.insert(words.end(), {"--method", method});
    expectRefused(words, {"spindle_rpm", "constant", "range"});
    // A copy of the output.
    rewrite([&](std::size_t k) { return field(k, 0) + ',' + field(k, 1) + ',' + field(k, 3) + ',' + field(k, 3); },
            header);
    words = identify("T_nose_degC");
    words.insert(words.end(), {"--method", method});
    expectRefused(words, {"T_nose_degC", "growth_um", "copy"});
    // Two identical sensors: one is enough for the averaged lags, the others cannot tell them apart.
    rewrite([&](std::size_t k) { return field(k, 0) + ',' + field(k, 2) + ',' + field(k, 2) + ',' + field(k, 3); },
            "time_s,T_twin_degC,T_nose_degC,growth_um");
    words = identify("T_nose_degC,T_twin_degC");
    words.insert(words.end(), {"--method", method});
    if (std::string(method) == "response") {
      const nlohmann::json j = jsonOf(words);
      EXPECT_EQ(j["inputs"], nlohmann::json::array({"T_nose_degC"}));
      EXPECT_NE(j.dump().find("identical to T_nose_degC"), std::string::npos);
    } else {
      expectRefused(words, {"T_twin_degC", "identical", "T_nose_degC"});
    }
  }
  rewrite([&](std::size_t k) { return field(k, 0) + ",1000," + field(k, 2) + ',' + field(k, 3); }, header);
  EXPECT_NE(jsonOf(identify("auto")).dump().find("constant in the training range"), std::string::npos);
}

TEST_F(Thermal, KelvinAndFahrenheitAreAskedAboutAndConverted) {
  const nlohmann::json honest = jsonOf(identify("T_nose_degC"));
  std::vector<std::string> lines = linesOf(log);
  const auto inUnit = [&](double factor, double offset) {
    std::vector<std::string> out = lines;
    for (std::size_t k = 1; k < out.size(); ++k) {
      const std::size_t from = out[k].find(',', out[k].find(',') + 1) + 1;
      const std::size_t to = out[k].find(',', from);
      const double value = std::stod(out[k].substr(from, to - from));
      out[k] = out[k].substr(0, from) + std::to_string(factor * value + offset) + out[k].substr(to);
    }
    writeLines(log, out);
  };
  for (const auto& [unit, factor, offset, word] :
       {std::tuple{"K", 1.0, 273.15, "kelvin"}, {"degF", 1.8, 32.0, "Fahrenheit"}}) {
    inUnit(factor, offset);
    expectRefused(identify("T_nose_degC"), {"T_nose_degC", word, "--temperature-unit"});
    auto words = identify("T_nose_degC");
    words.insert(words.end(), {"--temperature-unit", unit});
    EXPECT_NEAR(jsonOf(words)["test"]["rmse"].get<double>(), honest["test"]["rmse"].get<double>(), 1e-3) << unit;
  }
}

TEST_F(Thermal, RunsOfMissingValuesAreCountedAndTheTextNanIsRefused) {
  for (std::size_t line = 100; line < 140; ++line) setField(log, line, "T_nose_degC", "");
  const nlohmann::json j = jsonOf(identify("spindle_rpm,T_nose_degC"));
  EXPECT_NE(j["notes"].dump().find("40 of 600 values of T_nose_degC are missing"), std::string::npos) << j["notes"];
  EXPECT_GT(j["test"]["fit_percent"].get<double>(), 80.0);
  setField(log, 100, "T_nose_degC", "nan");
  expectRefused(identify("spindle_rpm,T_nose_degC"), {"line 100", "T_nose_degC", "empty"});
}

TEST_F(Thermal, FiftySamplesAreTooFew) {
  auto lines = linesOf(log);
  lines.resize(51);
  writeLines(log, lines);
  for (const char* method : {"response", "arx", "oe"}) {
    auto words = identify("T_nose_degC");
    words[8] = "0:900";
    words[10] = "900:1500";
    words.insert(words.end(), {"--method", method});
    expectRefused(words, {"growth_um", "30 samples", "allowed", "longer"});
  }
}

TEST_F(Thermal, AnUnstableFitIsNamedAndNotRecommended) {
  auto lines = linesOf(log);
  for (std::size_t k = 1; k < lines.size(); ++k)
    lines[k] = lines[k].substr(0, lines[k].rfind(',') + 1) +
               std::to_string(std::exp(static_cast<double>(k) / 100.0) + (k % 7 == 0 ? 0.002 : 0.0));
  writeLines(log, lines);
  auto words = identify();
  words.insert(words.end(), {"--order", "2,2,1"});
  const nlohmann::json j = jsonOf(words, 1);
  EXPECT_NE(j["notes"].dump().find("unstable"), std::string::npos) << j["notes"];
  EXPECT_NE(j["notes"].dump().find("do not compensate"), std::string::npos) << j["notes"];
  for (const auto& pole : j["structure"]["poles"])
    EXPECT_LT(std::hypot(pole[0].get<double>(), pole[1].get<double>()), 1.0);
}

TEST_F(Thermal, CompensateSaysWhenItsModelWasNotGoodEnough) {
  // A growth that turns its sign after training: no model of the training rows can be right there.
  auto lines = linesOf(log);
  for (std::size_t k = 401; k < lines.size(); ++k) {
    const std::size_t at = lines[k].rfind(',') + 1;
    lines[k] = lines[k].substr(0, at) + std::to_string(-std::stod(lines[k].substr(at)));
  }
  const std::string good_log = textOf(log);
  writeLines(log, lines);
  const std::string bad = (folder / "bad.json").string();
  auto words = identify();
  words.insert(words.end(), {"--model-out", bad});
  ASSERT_EQ(runCli(words).status, 1);
  const nlohmann::json verdict = nlohmann::json::parse(textOf(bad)).at("outputs").at(0).at("verdict");
  EXPECT_EQ(verdict["good_enough"], false);
  EXPECT_NE(verdict["reason"].get<std::string>().find("no better than"), std::string::npos);
  const Outcome warned = runCli({"thermal", "compensate", log.string(), "--model", bad, "--json", "-"});
  EXPECT_NE(warned.error.find("growth_um was called not good enough"), std::string::npos) << warned.error;
  EXPECT_EQ(std::count(warned.error.begin(), warned.error.end(), '\n'), 1) << "one sentence";
  EXPECT_EQ(warned.json().at("warnings").size(), 1U);
  // The result file of identify, joined models and the window carry the same verdict; a good model says nothing.
  writeText(log, good_log);
  const std::string good = (folder / "good.json").string();
  words = identify();
  words.insert(words.end(), {"--model-out", good});
  ASSERT_EQ(runCli(words).status, 0);
  EXPECT_EQ(nlohmann::json::parse(textOf(good)).at("outputs").at(0).at("verdict").at("good_enough"), true);
  const Outcome quiet = runCli({"thermal", "compensate", log.string(), "--model", good, "--json", "-"});
  EXPECT_EQ(quiet.error, "");
  EXPECT_TRUE(quiet.json().at("warnings").empty());
  // A model of an earlier version, without a verdict, is still read.
  nlohmann::json old = nlohmann::json::parse(textOf(good));
  old["outputs"][0].erase("verdict");
  writeText(good, old.dump());
  EXPECT_EQ(runCli({"thermal", "compensate", log.string(), "--model", good}).status, 0);
}

TEST_F(Thermal, CompensationIsJudgedOnRowsThatTrainedNothing) {
  // After training the growth goes the other way about its mean but is small: over all rows the model still seems to
  // help.
  const std::string model = (folder / "model.json").string();
  auto words = identify();
  words.insert(words.end(), {"--model-out", model});
  ASSERT_EQ(runCli(words).status, 0);
  auto lines = linesOf(log);
  const double to_s = nlohmann::json::parse(textOf(model)).at("train_s").at(1).get<double>();
  const auto valueAt = [&](std::size_t k) { return std::stod(lines[k].substr(lines[k].rfind(',') + 1)); };
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t k = 1; k < lines.size() && std::stod(lines[k]) < to_s; ++k, count += 1.0) sum += valueAt(k);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    if (std::stod(lines[k]) < to_s) continue;
    const double moved = sum / count - 0.2 * (valueAt(k) - sum / count);
    lines[k] = lines[k].substr(0, lines[k].rfind(',') + 1) + std::to_string(moved);
  }
  writeLines(log, lines);
  const Outcome outcome = runCli({"thermal", "compensate", log.string(), "--model", model, "--json", "-"});
  const nlohmann::json output = outcome.json().at("outputs").at(0);
  ASSERT_LT(output.at("unseen").at("reduction_percent").get<double>(), 0.0);
  EXPECT_EQ(outcome.status, 1);
}

TEST_F(Thermal, CompensationIsMinusThePredictedDeviation) {
  const std::string model = (folder / "model.json").string();
  const std::string out = (folder / "out.csv").string();
  auto words = identify();
  words.insert(words.end(), {"--model-out", model});
  ASSERT_EQ(runCli(words).status, 0);
  const nlohmann::json j = jsonOf({"thermal", "compensate", log.string(), "--model", model, "--out", out});
  EXPECT_NE(j["sign_convention"].get<std::string>().find("minus the predicted deviation"), std::string::npos);
  // The compensator begins at rest while this spindle begins cold: not more than this.
  EXPECT_GT(j["outputs"][0]["reduction_percent"].get<double>(), 30.0);
  // What it is worth is what it does on rows that it was not identified from.
  const nlohmann::json& unseen = j["outputs"][0]["unseen"];
  EXPECT_GT(unseen["rows"].get<int>(), 100);
  EXPECT_LT(unseen["rows"].get<std::size_t>(), linesOf(log).size() - 1);
  EXPECT_GT(unseen["rms_before"].get<double>(), unseen["rms_after"].get<double>());
  EXPECT_NE(j["unseen"].get<std::string>().find("rows outside"), std::string::npos) << j["unseen"];
  // The same log is one under another name, another log is one under the same name.
  const auto copy = folder / "another.csv";
  writeText(copy, textOf(log));
  const nlohmann::json same = jsonOf({"thermal", "compensate", copy.string(), "--model", model});
  EXPECT_EQ(same["unseen"], j["unseen"]);
  std::filesystem::create_directory(folder / "other");
  const auto namesake = folder / "other" / log.filename();
  writeText(namesake, textOf(log) + "\n");
  const nlohmann::json other = jsonOf({"thermal", "compensate", namesake.string(), "--model", model});
  EXPECT_NE(other["unseen"].get<std::string>().find("no row of this log trained it"), std::string::npos);
  // A deviation that has moved since training is an error of the compensation, not its constant.
  auto moved = linesOf(log);
  const double to_s = nlohmann::json::parse(textOf(model)).at("train_s").at(1).get<double>();
  for (std::size_t k = 1; k < moved.size(); ++k) {
    if (std::stod(moved[k]) < to_s) continue;
    const std::size_t at = moved[k].rfind(',') + 1;
    moved[k] = moved[k].substr(0, at) + std::to_string(100.0 + std::stod(moved[k].substr(at)));
  }
  writeLines(log, moved);
  const nlohmann::json after = runCli({"thermal", "compensate", log.string(), "--model", model, "--json", "-"}).json();
  EXPECT_NEAR(after["outputs"][0]["unseen"]["rms_after"].get<double>(), 100.0, 10.0);
  // The spindle has grown upwards: the command goes down.
  const auto lines = linesOf(out);
  double lowest = 0.0;
  double highest = 0.0;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const double value = std::stod(lines[k].substr(lines[k].rfind(',') + 1));
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  EXPECT_LT(lowest, -10.0);
  EXPECT_LT(highest, 2.0);
  EXPECT_NE(runCli({"thermal", "compensate", "--help"}).output.find("minus the predicted deviation"),
            std::string::npos);
}

TEST_F(Thermal, ALogAloneHasAReport) {
  const std::string result = (folder / "result.json").string();
  auto words = identify();
  words.insert(words.end(), {"--json", result});
  ASSERT_EQ(runCli(words).status, 0);
  const std::string html = (folder / "report.html").string();
  const Outcome written = runCli({"report", log.string(), "--thermal", result, "--out", html});
  ASSERT_EQ(written.status, 0) << written.error;
  const std::string text = textOf(html);
  for (const char* part : {"of a log alone", "Displacements of the log", "Model over time", "spindle speed"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("degC"), std::string::npos);
  expectBadInput({"report", log.string(), "--thermal", log.string(), "--out", html}, {"log.csv"});
  writeText(folder / "speeds.csv", "time_s,spindle_rpm\n0,0\n60,100\n");
  expectBadInput({"report", (folder / "speeds.csv").string(), "--out", html}, {"speeds.csv", "_um"});
}

TEST_F(Thermal, ArxSaysWhenItsEquationDoesNotFit) {
  auto words = identify();
  words.insert(words.end(), {"--order", "1,1,1"});  // noise at the output
  const nlohmann::json j = jsonOf(words);
  EXPECT_LT(j["structure"]["equation_whiteness_p_value"].get<double>(), 1e-3);
  EXPECT_NE(j["notes"].dump().find("not white"), std::string::npos);
}

}  // namespace
}  // namespace spindrift::testing
