// SPDX-License-Identifier: GPL-3.0-or-later
// Runs spindrift-cli as a child process and says what a caller sees of it: exit status, standard output and error.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace spindrift::testing {

struct Outcome {
  int status = -1;     ///< exit status; -1: the program did not end by itself
  std::string output;  ///< standard output
  std::string error;   ///< standard error

  /// Standard output as JSON; a failed expectation and an empty object if it is not.
  [[nodiscard]] nlohmann::json json() const;
};

/// Runs the program with these arguments and waits for its end.
[[nodiscard]] Outcome runCli(const std::vector<std::string>& arguments);

/// Expects status 0 (or `status`) and gives the JSON that `--json -` writes.
[[nodiscard]] nlohmann::json jsonOf(std::vector<std::string> arguments, int status = 0);

/// Expects exit status 2, nothing on standard output and one sentence that holds every one of `parts`.
void expectBadInput(const std::vector<std::string>& arguments, const std::vector<std::string>& parts);

/// Expects that no number of the tree is NaN or Infinity (they would be text or a syntax error) and that
/// `{value, standard_uncertainty}` pairs are numbers with a positive uncertainty, or null.
void expectEstimates(const nlohmann::json& parameters, const std::vector<std::string>& names);

/// Every file of a folder with its content: what must be equal before and after.
[[nodiscard]] std::map<std::string, std::string> contentOf(const std::filesystem::path& folder);

/// Copies a campaign, so that one file of the copy can be spoilt.
void copyCampaign(const std::filesystem::path& from, const std::filesystem::path& to);

[[nodiscard]] std::string textOf(const std::filesystem::path& file);
void writeText(const std::filesystem::path& file, const std::string& text);
/// Puts `to` in place of the first `from`; a failed expectation if there is none.
void edit(const std::filesystem::path& file, const std::string& from, const std::string& to);
/// Lines of a file without the newline.
[[nodiscard]] std::vector<std::string> linesOf(const std::filesystem::path& file);
void writeLines(const std::filesystem::path& file, const std::vector<std::string>& lines);
/// Puts a value into one field of a CSV file without quotes; `line` counts from 1, the header is line 1.
void setField(const std::filesystem::path& file, std::size_t line, const std::string& column, const std::string& value);

}  // namespace spindrift::testing
