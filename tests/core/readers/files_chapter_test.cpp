// SPDX-License-Identifier: GPL-3.0-or-later
// The chapter of the manual on files is what the program reads: every format, key and column that a reader asks for
// stands in it, and its examples are taken as they stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/machine/machine_description.h"
#include "core/probing/printed_text.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

const std::filesystem::path& sources() {
  static const std::filesystem::path folder = SPINDRIFT_SOURCE_DIR;
  return folder;
}

const std::string& chapter() {
  static const std::string text = readFile(sources() / "resources/manual/68-files.md");
  return text;
}

/// Sources in core that read files of users: neither what Spindrift keeps for itself (sessions, stored results, a
/// loop's state, the plant store) nor what it only writes.
std::vector<std::filesystem::path> readersInCore() {
  static const std::set<std::string> own = {
      "base",
      "tasks",
      "session",
      "reporting",
      "core/discrepancy/catalogue.cpp",
      "core/plant/batch_work.cpp",
      "core/plant/plant_types.cpp",
      "core/simulation/study_campaigns.cpp",
      "core/simulator/answer_store.cpp",
      "core/workflows/capture_intake.cpp",
      "core/workflows/capture_watch.cpp",
      "core/workflows/closed_loop.cpp",
      "core/workflows/closed_loop_demo.cpp",
      "core/workflows/incoming_journal.cpp",
      "core/workflows/loop_state.cpp",
      "core/workflows/report_sections.cpp",
      "core/workflows/touch_feed.cpp",
      "core/workflows/what_if.cpp",
  };
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sources() / "core")) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".cpp" || own.contains(file.parent_path().filename().string()) ||
        own.contains(std::filesystem::relative(file, sources()).string()))
      continue;
    const std::string text = readFile(file);
    if (text.find("JsonNode") != std::string::npos || text.find("CsvTable") != std::string::npos) files.push_back(file);
  }
  return files;
}

/// First groups of all matches.
std::set<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::set<std::string> out;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) out.insert((*at)[1].str());
  return out;
}

struct Example {
  std::string format;
  std::string json;
};

std::vector<Example> examples() {
  std::vector<Example> out;
  std::istringstream lines(chapter());
  std::string json;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (inside && line == "```") {
      inside = false;
      const JsonNode root = JsonNode::parse(json, "68-files.md");
      out.push_back({root.at("format").name(), json});
    } else if (inside) {
      json += line + "\n";
    } else if (line == "```json") {
      inside = true;
      json.clear();
    }
  }
  return out;
}

TEST(FilesChapter, NamesEveryFormatKeyAndColumnThatIsRead) {
  const std::set<std::string> words = matches(chapter(), R"(([A-Za-z0-9_]+))");
  std::size_t keys = 0;
  std::size_t formats = 0;
  for (const std::filesystem::path& file : readersInCore()) {
    const std::string text = readFile(file);
    const std::string name = std::filesystem::relative(file, sources()).string();
    for (
        const std::string& key : matches(
            text,
            R"re((?:at|find|has|numberOr|stringOr|booleanOr|column|hasColumn|numbers|optionalNumber|optionalPositive)re"
            R"re(|nonNegative|positive|from_zero|partOf|parseList<\w+>|text|number)\((?:\w+, )?"([a-z]\w*)")re")) {
      ++keys;
      EXPECT_TRUE(words.contains(key)) << name << " reads \"" << key << "\", of which the chapter says nothing";
    }
    for (const std::string& format : matches(text, R"re(requireFormat\("(spindrift-[a-z-]+)")re")) {
      ++formats;
      EXPECT_NE(chapter().find(format), std::string::npos) << name << " reads " << format;
    }
  }
  EXPECT_GT(keys, 300U);
  EXPECT_GT(formats, 12U);
}

TEST(FilesChapter, ExamplesAreTakenAsTheyStand) {
  static const std::map<std::string, std::string> reader_of = {{"spindrift-campaign", "campaign"},
                                                               {"spindrift-machine", "machine"},
                                                               {"spindrift-plan", "plan"},
                                                               {"spindrift-finite-elements", "fe_map"},
                                                               {"spindrift-effects", "effects"},
                                                               {"spindrift-error-model", "error_model"},
                                                               {"spindrift-connections", "connections"},
                                                               {"spindrift-batch", "batch_plan"},
                                                               {"spindrift-printed-text", ""}};
  std::size_t taken = 0;
  for (const Example& example : examples()) {
    ASSERT_TRUE(reader_of.contains(example.format)) << example.format;
    const std::string& name = reader_of.at(example.format);
    if (name.empty()) {
      const MachineDescription machine =
          MachineDescription::parse(JsonNode::parse(smallMachine(), "machine.json"), "machine.json");
      PrintedTextReader reader("printed.txt", JsonNode::parse(example.json, "template.json"), machine);
      EXPECT_FALSE(reader.read("CYCLE 1"));
      const auto touch = reader.read("T A1 B1 C0 D2 X10.5 Y20 Z-200 I0 J0 K-1 S5000");
      ASSERT_TRUE(touch);
      EXPECT_EQ(touch->feature, "H1");
      const auto next = reader.read("T A1 B1 C0 D3 X10.5 Y20 Z-200 I0 J0 K-1 S6500");
      ASSERT_TRUE(next);
      EXPECT_DOUBLE_EQ(next->time_s - touch->time_s, 1.5);
      ++taken;
      continue;
    }
    for (const auto& list : {machineReaders(), finiteElementReaders(), plantReaders(), wholeCoreReaders()}) {
      const auto reader = std::find_if(list.begin(), list.end(), [&](const Reader& one) { return one.name == name; });
      if (reader == list.end()) continue;
      EXPECT_EQ(sentenceOf(*reader, example.json), "") << example.format << "\n" << example.json;
      ++taken;
    }
  }
  EXPECT_EQ(taken, reader_of.size());
}

}  // namespace
}  // namespace spindrift::testing
