// SPDX-License-Identifier: GPL-3.0-or-later
// The frame of every command: --json, progress, exit status. Each commands_<domain>.cpp registers its commands here and
// calls functions of core; it computes nothing itself.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/job_context.h"

namespace spindrift::cli {

/// Exit status as in FORMATS.md.
enum ExitStatus { Done = 0, NotGoodEnough = 1, BadInput = 2, InternalFailure = 3 };

/// What a command gives back: JSON for `--json`, a summary for people, 0 or 1 (not good enough; the summary says why),
/// and sentences that must be seen also where the summary is not: on standard error.
struct CommandResult {
  nlohmann::json json = nlohmann::json::object();
  std::string summary;
  int exit_status = Done;
  std::vector<std::string> warnings = {};
};

/// Checks of an option's number, in words of ours.
[[nodiscard]] CLI::Validator positiveNumber();
[[nodiscard]] CLI::Validator nonNegativeNumber();
[[nodiscard]] CLI::Validator numberBetween(double least, double most);
/// Check of an option's word.
[[nodiscard]] CLI::Validator oneOf(std::vector<std::string> words);

/// What is wrong with how the program was called, as one sentence of ours.
[[nodiscard]] std::string usageSentence(const CLI::App& app, const CLI::ParseError& error);

/// The result with sentences about what was left out, under "notes" and as lines for people.
[[nodiscard]] CommandResult noted(CommandResult result, const std::vector<std::string>& notes);

/// Shared by all commands of one run of the program.
struct CommandLine {
  std::function<CommandResult(JobContext&)> selected;  ///< set by the subcommand that was given
  std::string json_file;                               ///< "", "-" or a path
};

/// Adds a subcommand with `--json`; returns it so that the caller adds its options. `run` is called after parsing.
CLI::App* addCommand(CLI::App& parent, CommandLine& line, const std::string& name, const std::string& description,
                     std::function<CommandResult(JobContext&)> run);

/// Runs the selected command: progress on standard error if that is a terminal, JSON and summary as FORMATS.md says,
/// errors as one sentence on standard error. Returns the exit status.
int runSelected(CommandLine& line);

/// Adds --reference: man page, completion of bash or Markdown of everything that was added to the program, printed
/// before anything else is asked for. To be called last. `summary` and `see_also` as in ProgramReference.
void addReference(CLI::App& app, const std::string& summary, const std::vector<std::string>& see_also);
/// The same as Markdown, of everything that was added so far.
[[nodiscard]] std::string referenceMarkdown(const CLI::App& app);

void addCaptureCommands(CLI::App& app, CommandLine& line);
void addCompensationCommands(CLI::App& app, CommandLine& line);
void addConnectCommands(CLI::App& app, CommandLine& line);
void addDiscrepancyCommands(CLI::App& app, CommandLine& line);
void addEvaluateCommands(CLI::App& app, CommandLine& line);
void addImagingCommands(CLI::App& app, CommandLine& line);
void addKinematicsCommands(CLI::App& app, CommandLine& line);
void addLoopCommands(CLI::App& app, CommandLine& line);
void addPlantCommands(CLI::App& app, CommandLine& line);
void addProbingCommands(CLI::App& app, CommandLine& line);
void addReportingCommands(CLI::App& app, CommandLine& line);
void addScanningCommands(CLI::App& app, CommandLine& line);
void addSessionCommands(CLI::App& app, CommandLine& line);
void addSimulationCommands(CLI::App& app, CommandLine& line);
void addTeachingCommands(CLI::App& app, CommandLine& line);
void addThermalCommands(CLI::App& app, CommandLine& line);
void addThermalReplayCommands(CLI::App& thermal, CommandLine& line);

}  // namespace spindrift::cli
