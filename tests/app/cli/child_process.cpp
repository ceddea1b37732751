// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "tests/support/temp_folder.h"

namespace spindrift::testing {

nlohmann::json Outcome::json() const {
  nlohmann::json parsed = nlohmann::json::parse(output, nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << output.substr(0, 400) << error;
  if (parsed.is_discarded() || !parsed.is_object()) return nlohmann::json::object();
  return parsed;
}

Outcome runCli(const std::vector<std::string>& arguments) {
  const TempFolder folder;
  const std::string out = (folder / "out").string();
  const std::string err = (folder / "err").string();
  std::vector<std::string> words = {SPINDRIFT_CLI};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const int out_handle = ::open(out.c_str(), O_WRONLY | O_CREAT, 0600);
    const int err_handle = ::open(err.c_str(), O_WRONLY | O_CREAT, 0600);
    if (out_handle >= 0 && err_handle >= 0 && ::dup2(out_handle, STDOUT_FILENO) >= 0 &&
        ::dup2(err_handle, STDERR_FILENO) >= 0) {
      ::execv(pointers.front(), pointers.data());
    }
    ::_exit(127);
  }
  Outcome outcome;
  int status = 0;
  if (child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  outcome.output = textOf(out);
  outcome.error = textOf(err);
  return outcome;
}

nlohmann::json jsonOf(std::vector<std::string> arguments, int status) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const Outcome outcome = runCli(arguments);
  EXPECT_EQ(outcome.status, status) << outcome.error << outcome.output.substr(0, 400);
  EXPECT_EQ(outcome.error, "");
  return outcome.json();
}

void expectBadInput(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
  std::string command;
  for (const std::string& a : arguments) command += a + ' ';
  const Outcome outcome = runCli(arguments);
  EXPECT_EQ(outcome.status, 2) << command << '\n' << outcome.error << outcome.output.substr(0, 400);
  EXPECT_EQ(outcome.output, "") << command;
  const std::string& text = outcome.error;
  EXPECT_TRUE(text.starts_with("spindrift-cli: ")) << command << '\n' << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << command << '\n' << text;
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << command << '\n' << text;
}

void expectEstimates(const nlohmann::json& parameters, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    ASSERT_TRUE(parameters.contains(name)) << name << " in " << parameters.dump();
    const nlohmann::json& p = parameters[name];
    ASSERT_TRUE(p.contains("value") && p.contains("standard_uncertainty")) << name << p.dump();
    if (p["value"].is_null()) continue;
    EXPECT_TRUE(p["value"].is_number()) << name << p.dump();
    ASSERT_TRUE(p["standard_uncertainty"].is_number()) << name << p.dump();
    EXPECT_GE(p["standard_uncertainty"].get<double>(), 0.0) << name;
  }
}

std::map<std::string, std::string> contentOf(const std::filesystem::path& folder) {
  std::map<std::string, std::string> content;
  if (!std::filesystem::exists(folder)) return content;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    content[entry.path().string()] = entry.is_regular_file() ? textOf(entry.path()) : std::string();
  }
  return content;
}

void copyCampaign(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::remove_all(to);
  std::filesystem::copy(from, to, std::filesystem::copy_options::recursive);
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

void edit(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string text = textOf(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from << " is not in " << file;
  text.replace(at, from.size(), to);
  writeText(file, text);
}

std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::istringstream stream(textOf(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void writeLines(const std::filesystem::path& file, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  writeText(file, text);
}

namespace {

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

void setField(const std::filesystem::path& file, std::size_t line, const std::string& column,
              const std::string& value) {
  std::vector<std::string> lines = linesOf(file);
  ASSERT_LE(line, lines.size());
  const std::vector<std::string> names = fieldsOf(lines.front());
  const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
  ASSERT_LT(at, names.size()) << column;
  std::vector<std::string> fields = fieldsOf(lines[line - 1]);
  fields[at] = value;
  std::string text;
  for (std::size_t i = 0; i < fields.size(); ++i) text += (i > 0 ? "," : "") + fields[i];
  lines[line - 1] = text;
  writeLines(file, lines);
}

}  // namespace spindrift::testing
