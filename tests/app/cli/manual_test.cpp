// SPDX-License-Identifier: GPL-3.0-or-later
// The manual tells the truth: every example is run again and every number compared. And it is complete: each effect
// with its figure, each command.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/discrepancy/catalogue.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

struct Example {
  std::string chapter;
  std::vector<std::string> command;  ///< without the name of the program
  std::vector<std::string> told;     ///< lines below it
};

std::vector<Example> examplesOf(const std::filesystem::path& chapter) {
  std::vector<Example> examples;
  bool console = false;
  for (const std::string& line : linesOf(chapter)) {
    if (line.starts_with("```")) {
      console = line == "```console";
    } else if (console && line.starts_with("$ spindrift-cli ")) {
      examples.push_back({chapter.filename().string(), splitList(std::string_view(line).substr(16), ' '), {}});
    } else if (console && !examples.empty()) {
      examples.back().told.push_back(line);
    }
  }
  return examples;
}

/// Equal, or numbers that another processor may round otherwise in their last digit.
bool sameWord(std::string told, std::string got) {
  if (told == got) return true;
  for (std::string* word : {&told, &got}) {
    if (word->starts_with("−")) word->replace(0, std::string("−").size(), "-");
    while (!word->empty() && (word->back() == ',' || word->back() == ')')) word->pop_back();
    while (!word->empty() && word->front() == '(') word->erase(0, 1);
  }
  double a = 0.0, b = 0.0;
  if (!parseNumber(told, a) || !parseNumber(got, b)) return false;
  const std::size_t dot = told.find('.');
  const double last_digit = dot == std::string::npos ? 1.0 : std::pow(10.0, -double(told.size() - dot - 1));
  return dot != std::string::npos && std::abs(a - b) <= 1.5 * last_digit;
}

/// A line of the manual against one of the program; "..." at its end stands for the rest.
bool sameLine(const std::string& told, const std::string& got) {
  std::istringstream a(told), b(got);
  std::string expected, word;
  while (a >> expected) {
    if (expected == "..." || expected == "(...)") return true;
    if (!(b >> word) || !sameWord(expected, word)) return false;
  }
  return !(b >> word);
}

/// Which line of the manual the program did not say; empty if it said them all, in order.
std::string firstUntrue(const std::vector<std::string>& told, const std::vector<std::string>& got) {
  std::size_t at = 0;
  bool skipping = false;
  for (const std::string& line : told) {
    if (line == "...") {
      skipping = true;
      continue;
    }
    if (skipping)
      while (at < got.size() && !sameLine(line, got[at])) ++at;
    if (at >= got.size() || !sameLine(line, got[at])) return line;
    ++at;
    skipping = false;
  }
  return skipping || at == got.size() ? std::string() : "the program says more: " + got[at];
}

TEST(Manual, ComparesAsItShould) {
  EXPECT_TRUE(sameLine("EX  −0.12 ± 0.03 µm", "EX −0.13 ± 0.03 µm"));
  EXPECT_FALSE(sameLine("EX  −0.12 ± 0.03 µm", "EX −0.15 ± 0.03 µm"));
  EXPECT_FALSE(sameLine("24 cycles", "25 cycles"));
  EXPECT_FALSE(sameLine("EX 1.0", "EX 1.0 µm"));
  EXPECT_TRUE(sameLine("H: 3 touches (...)", "H: 3 touches (in 5 ms)"));
  EXPECT_EQ(firstUntrue({"a", "...", "c"}, {"a", "b", "b", "c"}), "");
  EXPECT_EQ(firstUntrue({"a", "...", "d"}, {"a", "b", "c"}), "d");
  EXPECT_NE(firstUntrue({"a"}, {"a", "b"}), "");
}

TEST(Manual, ExamplesAreWhatTheProgramSays) {
  const std::filesystem::path sources = sourceFolder();
  const TempFolder folder;
  std::filesystem::create_directory_symlink(sources / "resources/scenarios", folder / "scenarios");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  std::vector<std::filesystem::path> chapters;
  for (const auto& entry : std::filesystem::directory_iterator(sources / "resources/manual"))
    if (entry.is_regular_file()) chapters.push_back(entry.path());
  std::sort(chapters.begin(), chapters.end());
  int count = 0;
  for (const std::filesystem::path& chapter : chapters) {
    for (const Example& example : examplesOf(chapter)) {
      const Outcome outcome = runCli(example.command);
      EXPECT_EQ(outcome.status, 0) << example.chapter << ": " << outcome.error;
      std::istringstream stream(outcome.output);
      std::vector<std::string> got;
      for (std::string line; std::getline(stream, line);) got.push_back(line);
      EXPECT_EQ(firstUntrue(example.told, got), "")
          << example.chapter << ": spindrift-cli " << joinedList(example.command, "") << "\n"
          << outcome.output;
      ++count;
    }
  }
  std::filesystem::current_path(before);
  EXPECT_GE(count, 14);
}

/// What is typed and answered there is English too, and has been run above.
TEST(Manual, TheGermanChaptersHaveTheSameExamples) {
  const std::filesystem::path english = sourceFolder() / "resources/manual";
  const auto blocksOf = [](const std::filesystem::path& chapter) {
    std::vector<std::string> lines;
    bool console = false;
    for (const std::string& line : linesOf(chapter)) {
      if (line.starts_with("```")) console = line == "```console";
      if (console) lines.push_back(line);
    }
    return lines;
  };
  int chapters = 0;
  for (const auto& entry : std::filesystem::directory_iterator(english)) {
    if (!entry.is_regular_file()) continue;
    const std::filesystem::path german = english / "de" / entry.path().filename();
    ASSERT_TRUE(std::filesystem::exists(german)) << german;
    EXPECT_EQ(blocksOf(german), blocksOf(entry.path())) << german;
    ++chapters;
  }
  EXPECT_GE(chapters, 10);
}

/// What stands between ` in the running text, and the numbers outside of them with a point, sorted.
std::pair<std::vector<std::string>, std::vector<std::string>> factsOf(const std::filesystem::path& chapter) {
  std::vector<std::string> codes, numbers;
  bool block = false;
  bool code = false;
  std::string word;
  for (const std::string& line : linesOf(chapter)) {
    if (line.starts_with("```")) block = !block;
    if (block || line.starts_with("```")) continue;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto digit = [&](std::size_t at) {
        return at < line.size() && std::isdigit(static_cast<unsigned char>(line[at]));
      };
      if (line[i] == '`') {
        if (code) codes.push_back(word);
        code = !code;
        word.clear();
      } else if (code) {
        word += line[i];
      } else if (digit(i) && (i == 0 || !std::isalnum(static_cast<unsigned char>(line[i - 1])))) {
        while (digit(i) || (i < line.size() && (line[i] == '.' || line[i] == ',') && digit(i + 1)))
          word += line[i] == ',' ? '.' : line[i], ++i;
        numbers.push_back(word);
        word.clear();
        --i;
      }
    }
  }
  std::sort(codes.begin(), codes.end());
  std::sort(numbers.begin(), numbers.end());
  return {codes, numbers};
}

/// A value that changed in one language changed in the other; commands, files and keys are the same in both.
TEST(Manual, TheGermanTextTellsTheSameNumbersAndCommands) {
  const std::filesystem::path english = sourceFolder() / "resources/manual";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(english)) {
    if (!entry.is_regular_file()) continue;
    const auto told = factsOf(entry.path());
    auto german = factsOf(english / "de" / entry.path().filename());
    std::replace(german.first.begin(), german.first.end(), std::string("hldk"), std::string("ltdk"));  // as it is typed
    std::sort(german.first.begin(), german.first.end());
    EXPECT_EQ(german.first, told.first) << entry.path().filename();
    EXPECT_EQ(german.second, told.second) << entry.path().filename();
    count += told.first.size() + told.second.size();
  }
  EXPECT_GT(count, 150U);
}

TEST(Manual, HoldsEveryEffectWithItsFigureAndEveryCommand) {
  const TempFolder folder;
  const std::string html = (folder / "manual.html").string();
  ASSERT_EQ(runCli({"manual", "--out", html}).status, 0);
  const std::string text = textOf(html);
  std::size_t figures = 0;
  for (std::size_t at = text.find("<figure>"); at != std::string::npos; at = text.find("<figure>", at + 1)) ++figures;
  EXPECT_EQ(figures, everyEffect().size());
  const auto holds = [&](const std::string& part) { return text.find(part) != std::string::npos; };
  for (const Effect& effect : everyEffect()) EXPECT_TRUE(holds("shape of " + escapedXml(effect.id) + "<")) << effect.id;
  for (const char* part : {"<h2>Microscope and coded fiducials</h2>", "<h2>Glossary</h2>", "<h3>thermal replay</h3>",
                           "<h3>manual</h3>", "<td>EC0Y_urad</td>", "<pre>", "<h2>Files</h2>",
                           "A file is complete when it has not changed for this time in s (default: 1)"})
    EXPECT_TRUE(holds(part)) << part;
  const std::string pdf = (folder / "manual.pdf").string();
  ASSERT_EQ(runCli({"manual", "--out", pdf}).status, 0);
  EXPECT_TRUE(textOf(pdf).starts_with("%PDF-"));
  EXPECT_EQ(textOf(pdf).find("Signatures"), std::string::npos);
  expectBadInput({"manual", "--out", (folder / "manual.txt").string()}, {"manual.txt", ".html or .pdf"});
}

}  // namespace
}  // namespace spindrift::testing
