// SPDX-License-Identifier: GPL-3.0-or-later
// The closed loop on a control.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/discrepancy/percent_text.h"
#include "core/workflows/closed_loop.h"
#include "core/workflows/closed_loop_demo.h"
#include "core/workflows/machine_beside_control.h"

namespace spindrift::cli {
namespace {

struct LoopArguments {
  std::string plan;
  std::string out;
  std::string example;
  bool demo = false;
  bool dry = false;
  bool yes = false;
  LoopDemoOptions options;
};

/// Asked once: what was agreed to is not asked for again.
ApprovedProgram::Confirm operatorConfirms(bool yes) {
  auto agreed = std::make_shared<bool>(yes);
  return [agreed](const DryRun& run) {
    if (*agreed) return true;
    if (::isatty(STDIN_FILENO) == 0) return false;
    std::cerr << fmt::format("The machine will be switched on, homed and moved: {}.\nType yes to agree: ",
                             run.summary());
    std::string answer;
    std::getline(std::cin, answer);
    *agreed = answer == "yes";
    return *agreed;
  };
}

/// A line from the keyboard; empty at its end, or when the loop ends.
std::string answer(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd keyboard{STDIN_FILENO, POLLIN, 0};
    if (::poll(&keyboard, 1, 200) <= 0) continue;
    std::string line;
    std::getline(std::cin, line);
    return line;
  }
  return {};
}

/// Each name is accepted or rejected.
std::vector<std::string> chosenByOperator(const DiscrepancyResult& found, const std::stop_token& stop) {
  std::vector<std::string> ids;
  for (const FoundEffect& effect : found.effects) {
    std::cerr << fmt::format("\nThe simulation lacks {} (confidence {}{}). Type yes to add it: ", effect.id,
                             percentText(effect.confidence),
                             effect.rivals.empty() ? "" : ", not to be told from " + joinedList(effect.rivals));
    if (answer(stop) == "yes") ids.push_back(effect.id);
  }
  return ids;
}

/// What the channel does, every few seconds and when it changes between active and off.
class StatusLine {
 public:
  void operator()(const LoopStatus& status, const LoopResult& result) {
    const auto now = std::chrono::steady_clock::now();
    if (status.active == active_ && now - said_ < std::chrono::seconds(10)) return;
    active_ = status.active;
    said_ = now;
    std::cerr << fmt::format("{:.2f} h, {} cycles, {} | {}\n", status.time_s / 3600.0, result.cycles.size(),
                             status.channel, status.control.sentence);
  }

 private:
  bool active_ = false;
  std::chrono::steady_clock::time_point said_{};
};

CommandResult runLoop(const LoopArguments& arguments, JobContext& job) {
  CommandResult result;
  if (arguments.demo) {
    LoopDemoOptions options = arguments.options;
    options.folder = arguments.out;
    result.json = runLoopDemo(options);
    result.summary =
        loopDemoSummary(result.json) + fmt::format("Report: {}\n", (options.folder / "report.html").string());
    return result;
  }
  if (!arguments.example.empty()) {
    writeLoopExample(arguments.example, arguments.options.hours, arguments.options.factor);
    result.summary = fmt::format(
        "Written to {0}: plan, machine, simulation, the true machine, and a LinuxCNC in {0}/control. To close its "
        "loop:\n"
        "  cd {0}/control && linuxcnc -r spindrift.ini\n"
        "  spindrift-cli virtual-machine {0}/truth.json --truth {0}/truth.csv --factor {1:g}\n"
        "  spindrift-cli loop {0}/plan.json --out {0}/campaign\n",
        arguments.example, arguments.options.factor);
    return result;
  }
  if (arguments.plan.empty())
    throw InputError("A plan is missing; allowed: loop PLAN.json, loop --demo, or loop --example DIR.");
  const LoopPlan plan = LoopPlan::read(arguments.plan);
  if (arguments.dry) {
    const Eigen::Vector3d start{plan.touches.front().before_mm.x(), plan.touches.front().before_mm.y(), plan.safe_z_mm};
    const DryRun run = dryRun(measuringProgram(plan), plan.machine, start);
    result.summary = "A measuring cycle would move: " + run.summary() + "\n";
    for (const ProgramIssue& issue : run.issues) result.summary += fmt::format("line {}: {}\n", issue.line, issue.what);
    result.json["issues"] = run.issues.size();
    result.json["moves"] = run.moves.size();
    if (!run.good()) result.exit_status = NotGoodEnough;
    return result;
  }
  if (arguments.out.empty())
    throw InputError("--out is missing; allowed: a new or empty folder, or that of this loop.");
  LinuxcncControl control(plan.control);
  LoopOperator who;
  who.confirm = operatorConfirms(arguments.yes);
  // Without somebody at the keyboard nobody accepts anything.
  if (::isatty(STDIN_FILENO) != 0) who.choose = chosenByOperator;
  try {
    const LoopResult loop = runClosedLoop(plan, control, who, arguments.out, job, StatusLine());
    result.json = loop.json();
    result.summary = loop.summary();
    writeFileAtomically(std::filesystem::path(arguments.out) / "report.html", htmlOf(loop.report("Closed loop")));
  } catch (const ConnectionError& error) {
    throw InputError(error.what());
  }
  return result;
}

struct MachineArguments {
  std::string scenario;
  std::string truth;
  double hours = 8.0;
  BesideControlOptions options;
};

CommandResult runMachine(const MachineArguments& arguments, JobContext& job) {
  BesideControlOptions options = arguments.options;
  options.scenario = Scenario::read(arguments.scenario);
  options.truth = arguments.truth;
  options.duration_s = 3600.0 * arguments.hours;
  runBesideControl(options, [&job] { return job.cancelled(); });
  return {};
}

}  // namespace

void addLoopCommands(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<LoopArguments>();
  CLI::App* loop = addCommand(app, line, "loop", "Measure, model and compensate on a control, live",
                              [arguments](JobContext& job) { return runLoop(*arguments, job); });
  loop->add_option("PLAN", arguments->plan, "Plan (JSON, format spindrift-loop-plan)");
  loop->add_option("--out", arguments->out,
                   "Folder for campaign and report: new or empty, or that of an interrupted loop, which is continued")
      ->type_name("DIR");
  loop->add_flag(
      "--demo", arguments->demo,
      "Run the demonstration: a virtual machine with a LinuxCNC control of its own (package linuxcnc-uspace; as root)");
  loop->add_option("--example", arguments->example,
                   "Write the demonstration as files (plan, machine, simulation, LinuxCNC configuration) and exit")
      ->type_name("DIR");
  loop->add_flag("--dry-run", arguments->dry, "List the planned moves without moving");
  loop->add_flag("--yes", arguments->yes,
                 "Confirm that the operator is at the machine and agrees to the planned moves");
  loop->add_option("--factor", arguments->options.factor,
                   "Demonstration and example: ratio of machine time to real time")
      ->check(positiveNumber())
      ->capture_default_str();
  loop->add_option("--hours", arguments->options.hours, "Demonstration and example: duration in hours of machine time")
      ->check(positiveNumber())
      ->capture_default_str();

  auto machine = std::make_shared<MachineArguments>();
  CLI::App* beside =
      addCommand(app, line, "virtual-machine", "Run the virtual machine beside a LinuxCNC control of this computer",
                 [machine](JobContext& job) { return runMachine(*machine, job); });
  beside->add_option("SCENARIO", machine->scenario, "Scenario (JSON, format spindrift-scenario)")->required();
  beside
      ->add_option("--truth", machine->truth,
                   "Write the true deviations and the applied compensation, for assessment only, to this file")
      ->required()
      ->type_name("FILE");
  beside->add_option("--factor", machine->options.factor, "Ratio of machine time to real time")
      ->check(positiveNumber())
      ->capture_default_str();
  beside->add_option("--hours", machine->hours, "Hours of machine time")
      ->check(positiveNumber())
      ->capture_default_str();
}

}  // namespace spindrift::cli
