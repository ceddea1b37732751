// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <regex>
#include <stop_token>
#include <string_view>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/printed_number.h"
#include "core/base/program_reference.h"
#include "core/base/text.h"

namespace spindrift::cli {
namespace {

/// One line on the terminal that is written over; cleared at the end.
class TerminalProgress final : public ProgressSink {
 public:
  ~TerminalProgress() override {
    if (shown_) std::fputs("\r\033[K", stderr);
  }
  void report(double fraction, std::string_view stage) override {
    const std::scoped_lock lock(mutex_);
    const int percent = static_cast<int>(fraction * 100.0);
    if (shown_ && percent == last_percent_ && stage == last_stage_) return;
    last_percent_ = percent;
    last_stage_ = std::string(stage);
    shown_ = true;
    std::fprintf(stderr, "\r\033[K%3d %%  %s", percent, last_stage_.c_str());
    std::fflush(stderr);
  }

 private:
  std::mutex mutex_;
  bool shown_ = false;
  int last_percent_ = -1;
  std::string last_stage_;
};

std::stop_source& interruption() {
  static std::stop_source source;
  return source;
}

void onInterrupt(int) {
  // request_stop without registered callbacks only sets an atomic flag.
  interruption().request_stop();
  std::signal(SIGINT, SIG_DFL);
}

bool isCampaign(const std::filesystem::path& folder) {
  std::error_code unreadable;
  return std::filesystem::exists(folder / "campaign.json", unreadable);
}

/// A measurement is written once: no result may replace what a command reads, nor go into the folder of a campaign.
void refuseToWriteOverMeasurements(const CLI::App& command) {
  constexpr std::array results{"--json", "--out",  "--csv",        "--svg",       "--png",
                               "--pdf",  "--html", "--prediction", "--model-out", "--overlay"};
  std::vector<std::filesystem::path> inputs;
  for (const CLI::Option* option : command.get_options()) {
    if (std::any_of(results.begin(), results.end(), [&](const char* name) { return option->check_name(name); }))
      continue;
    for (const std::string& text : option->results()) {
      std::error_code none;
      if (!text.empty() && std::filesystem::exists(text, none))
        inputs.push_back(std::filesystem::weakly_canonical(text));
    }
  }
  for (const char* name : results) {
    const CLI::Option* target = command.get_option_no_throw(name);
    if (target == nullptr || target->empty()) continue;
    const std::string& text = target->results().front();
    if (text == "-") {
      if (std::string_view(name) == "--json") continue;
      throw InputError({text, ""}, fmt::format("{} writes no standard output; allowed: a file.", name));
    }
    const std::filesystem::path file = std::filesystem::weakly_canonical(text);
    for (const std::filesystem::path& input : inputs) {
      if (file == input && !std::filesystem::is_directory(input))
        throw InputError({text, ""},
                         fmt::format("{} would be written over what the command reads; allowed: another file.", name));
      const auto [end, ignored] = std::mismatch(input.begin(), input.end(), file.begin(), file.end());
      if (isCampaign(input) && end == input.end())
        throw InputError({text, ""}, fmt::format("{} lies in the campaign folder, which is never altered; allowed: a "
                                                 "file elsewhere.",
                                                 name));
    }
    if (std::string_view(name) == "--out") continue;  // may be what a recording or a simulation makes
    for (std::filesystem::path folder = file.parent_path(); folder != folder.parent_path();
         folder = folder.parent_path()) {
      if (isCampaign(folder))
        throw InputError({text, ""},
                         fmt::format("{} lies in the campaign folder {}, which is never altered; allowed: a "
                                     "file elsewhere.",
                                     name, folder.string()));
    }
  }
}

}  // namespace

namespace {

CLI::Validator numberThat(const std::string& allowed, const std::function<bool(double)>& accepts,
                          const std::string& description = "NUMBER") {
  CLI::Validator check;
  check.description(description);
  check.operation([allowed, accepts](const std::string& text) {
    double value = 0.0;
    if (parseNumber(text, value) && accepts(value)) return std::string();
    return fmt::format("{} is not allowed; allowed: {}.", text, allowed);
  });
  return check;
}

}  // namespace

CLI::Validator positiveNumber() {
  return numberThat("a number greater than zero", [](double v) { return v > 0.0; });
}

CLI::Validator nonNegativeNumber() {
  return numberThat("zero or a positive number", [](double v) { return v >= 0.0; });
}

CLI::Validator numberBetween(double least, double most) {
  const std::string range = fmt::format("{} to {}", printed(least), printed(most));
  return numberThat(
      range, [least, most](double v) { return v >= least && v <= most; }, range);
}

CLI::Validator oneOf(std::vector<std::string> words) {
  CLI::Validator check;
  check.description(fmt::format("{{{}}}", fmt::join(words, ",")));
  check.operation([words = std::move(words)](const std::string& text) {
    if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
    return fmt::format("{} is not allowed; allowed: {}.", text, joinedList(words, "or"));
  });
  return check;
}

std::string usageSentence(const CLI::App& app, const CLI::ParseError& error) {
  std::string command;
  const CLI::App* last = &app;
  while (!last->get_subcommands().empty()) {
    last = last->get_subcommands().front();
    command += last->get_name() + " ";
  }
  // What CLI11 says, and what is said in its place.
  const std::string said = error.what();
  std::smatch parts;
  static const std::regex subcommand("A subcommand is required"), required("(.*) is required"),
      extras("The following arguments? (?:was|were) not expected: (.*)"), conversion("Could not convert: (.*?) = (.*)"),
      missing("(.*): (\\d+) required (.*) missing");
  if (std::regex_match(said, subcommand))
    return fmt::format("a command is missing; allowed: those that {}--help lists.", command);
  if (std::regex_match(said, parts, required))
    return fmt::format("{} is missing; {}--help says what it is.", parts.str(1), command);
  if (std::regex_match(said, parts, extras))
    return fmt::format("{} is not allowed; allowed: what {}--help lists.", parts.str(1), command);
  if (std::regex_match(said, parts, conversion)) {
    const CLI::Option* option = last->get_option_no_throw(parts.str(1));
    const bool whole = option != nullptr && option->get_type_name().find("INT") != std::string::npos;
    return fmt::format("{}: {} is not allowed; allowed: {}.", parts.str(1), parts.str(2),
                       whole ? "a whole number" : "a number");
  }
  if (std::regex_match(said, parts, missing))
    return fmt::format("{} has too few values; allowed: {}.", parts.str(1), parts.str(3));
  return said.ends_with('.') ? said : said + ".";
}

namespace {

/// CLI11 says kind and check of a value in one: "TEXT:{none,huber}", "FLOAT:NUMBER", "FILE".
ProgramOption optionOf(const CLI::Option& option) {
  ProgramOption out;
  out.description = option.get_description();
  out.required = option.get_required();
  if (option.get_positional()) {
    out.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() == 0) return out;
  const std::string otherwise = option.get_default_str();
  if (!otherwise.empty() && otherwise != "\"\"" && otherwise != "[]" &&
      out.description.find("efault") == std::string::npos)
    out.description += fmt::format(" (default: {})", otherwise);
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  const std::size_t brace = type.find('{');
  if (brace != std::string::npos && type.ends_with('}'))
    out.allowed = splitList(std::string_view(type).substr(brace + 1, type.size() - brace - 2));
  if (option.get_positional()) return out;
  // "FROM:TO" is a name; "S:NUMBER" and "INT:1 to 9" are a name and its check.
  const std::string check = colon == std::string::npos ? std::string() : type.substr(colon + 1);
  const bool checked = !out.allowed.empty() || check == "NUMBER" || check.find(" to ") != std::string::npos;
  out.value = checked ? type.substr(0, colon) : type;
  if (out.value == "FLOAT") out.value = "NUMBER";
  if (out.value == "INT" || out.value == "UINT") out.value = "N";
  if (out.value.empty()) out.value = "VALUE";
  return out;
}

ProgramCommand commandOf(const CLI::App& app) {
  ProgramCommand out{app.get_name(), app.get_description()};
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? out.arguments : out.options).push_back(optionOf(*option));
  for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
    out.commands.push_back(commandOf(*one));
  return out;
}

}  // namespace

void addReference(CLI::App& app, const std::string& summary, const std::vector<std::string>& see_also) {
  app.add_option_function<std::string>(
         "--reference",
         [&app, summary, see_also](const std::string& format) {
           std::cout << referenceText({commandOf(app), SPINDRIFT_VERSION, summary, see_also}, format);
           throw CLI::Success();
         },
         "Print the reference of all commands: a man page, the completion of bash, or Markdown")
      ->type_name("FORMAT")
      ->check(oneOf({"man", "bash", "markdown"}));
}

std::string referenceMarkdown(const CLI::App& app) {
  return markdownReference({commandOf(app), SPINDRIFT_VERSION, {}, {}});
}

CommandResult noted(CommandResult result, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (!result.summary.empty() && result.summary.back() != '\n') result.summary += '\n';
    result.summary += "note: " + note + "\n";
    result.json["notes"].push_back(note);
  }
  return result;
}

CLI::App* addCommand(CLI::App& parent, CommandLine& line, const std::string& name, const std::string& description,
                     std::function<CommandResult(JobContext&)> run) {
  CLI::App* command = parent.add_subcommand(name, description);
  command
      ->add_option("--json", line.json_file, "Write the machine-readable result to FILE, or to standard output with -")
      ->type_name("FILE");
  command->callback([&line, command, run = std::move(run)] {
    line.selected = [command, run](JobContext& job) {
      refuseToWriteOverMeasurements(*command);
      return run(job);
    };
  });
  return command;
}

int runSelected(CommandLine& line) {
  // Names of files need not be UTF-8; what JSON cannot hold becomes U+FFFD.
  const auto text = [](const nlohmann::json& json) {
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  const bool json_to_stdout = line.json_file == "-";
  try {
    std::signal(SIGINT, onInterrupt);
    CommandResult result;
    {
      TerminalProgress progress;
      JobContext job(interruption().get_token(), ::isatty(STDERR_FILENO) != 0 ? &progress : nullptr);
      result = line.selected(job);
    }
    if (json_to_stdout) {
      std::cout << text(result.json) << '\n';
    } else {
      if (!line.json_file.empty()) writeFileAtomically(line.json_file, text(result.json) + "\n");
      std::cout << result.summary;
      if (!result.summary.empty() && !result.summary.ends_with('\n')) std::cout << '\n';
    }
    std::cout.flush();
    for (const std::string& warning : result.warnings) std::cerr << "spindrift-cli: warning: " << warning << '\n';
    if (!std::cout) throw InputError("standard output cannot be written: no space left, or it was closed.");
    return result.exit_status;
  } catch (const InputError& error) {
    std::cerr << "spindrift-cli: " << error.what() << '\n';
    return BadInput;
  } catch (const Cancelled&) {
    std::cerr << "spindrift-cli: cancelled; nothing was written\n";
    return NotGoodEnough;
  } catch (const std::exception& error) {
    std::cerr << "spindrift-cli: internal error: " << error.what() << '\n';
    return InternalFailure;
  }
}

}  // namespace spindrift::cli
