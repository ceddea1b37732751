// SPDX-License-Identifier: GPL-3.0-or-later
// The table of files is what the program reads: each reader's keys and columns stand in it with what holds without
// them, nothing else does, and its examples are taken as they stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/machine/component.h"
#include "core/machine/machine_description.h"
#include "core/probing/printed_text.h"
#include "core/workflows/file_reference.h"
#include "tests/fuzz/readers.h"
#include "tests/support/source_folder.h"

namespace spindrift::testing {
namespace {

const std::filesystem::path& sources() {
  static const std::filesystem::path folder = sourceFolder();
  return folder;
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

/// Which files a source reads, by the ids of the table.
const std::map<std::string, std::vector<std::string>>& filesOfReaders() {
  static const std::map<std::string, std::vector<std::string>> all = {
      {"core/connect/connections.cpp", {"connections"}},
      {"core/connect/genicam_source.cpp", {"connections"}},
      {"core/discrepancy/effect_model.cpp", {"error-model"}},
      {"core/discrepancy/own_effects.cpp", {"effects"}},
      {"core/finite_elements/fe_deviation.cpp", {"observe"}},
      {"core/finite_elements/fe_map.cpp", {"finite-elements"}},
      {"core/imaging/fiducial_captures.cpp", {"fiducials"}},
      {"core/imaging/pattern.cpp", {"pattern"}},
      {"core/machine/campaign.cpp", {"campaign"}},
      {"core/machine/machine_description.cpp", {"machine"}},
      {"core/machine/observation.cpp", {"observations", "covariances"}},
      {"core/machine/simulation_table.cpp", {"simulation"}},
      {"core/plant/batch_plan.cpp", {"batch"}},
      {"core/probing/artefact_certificate.cpp", {"machine"}},
      {"core/probing/cycle_studies.cpp", {"reference-record"}},
      {"core/probing/printed_text.cpp", {"printed-text"}},
      {"core/probing/touch.cpp", {"touches"}},
      {"core/scanning/scan_evaluation.cpp", {"machine"}},
      {"core/scanning/scan_list.cpp", {"scans"}},
      {"core/simulation/scenario.cpp", {"scenario"}},
      {"core/simulation/scenario_instruments.cpp", {"scenario"}},
      {"core/simulation/scenario_simulator.cpp", {"simulator", "scenario"}},
      {"core/simulator/log_tables.cpp", {"simulator"}},
      {"core/simulator/program_simulator.cpp", {"simulator", "observe"}},
      {"core/simulator/sensitivity_table.cpp", {"simulator", "sensitivities"}},
      {"core/simulator/simulator_file.cpp", {"simulator"}},
      {"core/thermal/thermal_model.cpp", {"thermal-model"}},
      {"core/workflows/closed_loop_plan.cpp", {"loop-plan"}},
      {"core/workflows/exercise.cpp", {"exercise"}},
      {"core/workflows/measurement_plan.cpp", {"plan"}},
      {"widgets/recording/recording.cpp", {"recording"}},
      // Not found by how they ask: names are compared with those that are there.
      {"core/machine/operating_log.cpp", {"log"}},
      {"core/scanning/cloud_file.cpp", {"cloud"}},
  };
  return all;
}

/// What a reader asks for, in the ways in which it is asked.
const char* const asked =
    R"re((?:at|find|has|numberOr|stringOr|booleanOr|column|hasColumn|numbers|optionalNumber|optionalPositive|optionalColumn)re"
    R"re(|nonNegative|positive|from_zero|partOf|numbersOr|parseList<\w+>|text|textOf|number|readCount|readPositive)re"
    R"re(|readNonNegative|readNumbers|path)\((?:\w+, )?"([a-z]\w*)")re";

const FileFormat& fileOf(const std::string& id) {
  for (const FileFormat& format : fileFormats()) {
    if (format.id == id) return format;
  }
  throw std::logic_error(id + " is not in the table of files");
}

/// All names in the paths of its keys.
std::set<std::string> namesOf(const FileFormat& format) {
  std::set<std::string> names;
  for (const FileKey& key : format.keys) names.merge(matches(key.path, R"((\w+))"));
  return names;
}

TEST(FilesChapter, HoldsEveryKeyAndColumnThatIsRead) {
  std::size_t keys = 0;
  for (const std::filesystem::path& file : readersInCore()) {
    const std::string name = std::filesystem::relative(file, sources()).string();
    const std::set<std::string> read = matches(readFile(file), asked);
    if (read.empty()) continue;
    ASSERT_TRUE(filesOfReaders().contains(name)) << name << " reads files of which the table does not know";
    std::set<std::string> known = {"format", "version"};
    for (const std::string& id : filesOfReaders().at(name)) known.merge(namesOf(fileOf(id)));
    for (const std::string& key : read) {
      ++keys;
      EXPECT_TRUE(known.contains(key)) << name << " reads \"" << key << "\", which is not in the table";
    }
  }
  EXPECT_GT(keys, 300U);
}

TEST(FilesChapter, HoldsNothingThatIsNotRead) {
  std::map<std::string, std::string> texts;  // of a file, all that reads it
  for (const auto& [source, ids] : filesOfReaders()) {
    if (!std::filesystem::exists(sources() / source)) continue;
    for (const std::string& id : ids) texts[id] += readFile(sources() / source);
  }
  const std::regex letter("([xyz])(?=_|$)");
  std::size_t keys = 0;
  for (const FileFormat& format : fileFormats()) {
    const auto text = texts.find(format.id);
    if (text == texts.end() || format.id == "log" || format.id == "cloud") continue;
    for (const FileKey& key : format.keys) {
      if (key.path.find("NAME") != std::string::npos && key.name() == "NAME") continue;
      ++keys;
      const std::string name = key.name();
      const std::string pattern = std::regex_replace(name, letter, "{}");
      EXPECT_TRUE(text->second.find('"' + name + '"') != std::string::npos ||
                  text->second.find('"' + pattern + '"') != std::string::npos || componentFromString(name).has_value())
          << format.id << ": nothing reads " << key.path;
      if (!key.required()) continue;
      EXPECT_TRUE(text->second.find("at(\"" + name + "\")") != std::string::npos ||
                  text->second.find("column(\"" + name + "\")") != std::string::npos ||
                  text->second.find("numbers(\"" + name + "\")") != std::string::npos ||
                  std::regex_search(text->second, std::regex("(needs|parseList)[^;]*\"" + name + "\"")))
          << format.id << ": " << key.path << " is not required";
    }
  }
  EXPECT_GT(keys, 400U);
}

TEST(FilesChapter, NamesEveryFormatThatIsRead) {
  const std::string chapter = filesMarkdown();
  std::size_t formats = 0;
  for (const std::filesystem::path& file : readersInCore()) {
    for (const std::string& format : matches(readFile(file), R"re(requireFormat\("(spindrift-[a-z-]+)")re")) {
      ++formats;
      EXPECT_NE(chapter.find('(' + format + ')'), std::string::npos) << file << " reads " << format;
    }
  }
  EXPECT_GT(formats, 12U);
  EXPECT_THROW((void)filesMarkdown("no such file"), InputError);
  EXPECT_EQ(filesMarkdown("machine").find("## campaign.json"), std::string::npos);
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
  for (const FileFormat& file : fileFormats()) {
    if (file.example.empty()) continue;
    const struct {
      std::string format;
      std::string json;
    } example{file.format, file.example};
    EXPECT_EQ(JsonNode::parse(example.json, file.file).at("format").name(), example.format);
    if (example.format == "spindrift-recording") continue;  // recordings_test
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
