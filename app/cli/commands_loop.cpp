// SPDX-License-Identifier: GPL-3.0-or-later
// The closed loop on a control.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/workflows/closed_loop.h"
#include "core/workflows/closed_loop_demo.h"
#include "core/workflows/machine_beside_control.h"

namespace spindrift::cli {
namespace {

struct LoopArguments {
  std::string plan;
  std::string out;
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
  if (arguments.plan.empty()) throw InputError("A plan is missing; allowed: loop PLAN.json, or loop --demo.");
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
  if (arguments.out.empty()) throw InputError("--out is missing; allowed: a new or empty folder.");
  LinuxcncControl control(plan.control);
  LoopOperator who;
  who.confirm = operatorConfirms(arguments.yes);
  who.add = [](const DiscrepancyResult& found) {
    std::vector<std::string> ids;
    for (const FoundEffect& effect : found.effects) {
      if (effect.rivals.empty()) ids.push_back(effect.id);
    }
    return ids;
  };
  try {
    const LoopResult loop = runClosedLoop(plan, control, who, arguments.out, job);
    result.json = loop.json();
    result.summary = loop.summary();
    writeFileAtomically(std::filesystem::path(arguments.out) / "report.html", loop.report("Closed loop"));
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
  loop->add_option("--out", arguments->out, "Folder for campaign and report: new or empty")->type_name("DIR");
  loop->add_flag("--demo", arguments->demo,
                 "A virtual machine with physics beside a LinuxCNC of its own (package linuxcnc-uspace; as root)");
  loop->add_flag("--dry-run", arguments->dry, "List the planned moves without moving");
  loop->add_flag("--yes", arguments->yes, "The operator stands at the machine and agrees to what moves");
  loop->add_option("--factor", arguments->options.factor, "Demonstration: machine seconds per second")
      ->check(positiveNumber())
      ->capture_default_str();
  loop->add_option("--hours", arguments->options.hours, "Demonstration: hours of machine time")
      ->check(positiveNumber())
      ->capture_default_str();

  auto machine = std::make_shared<MachineArguments>();
  CLI::App* beside =
      addCommand(app, line, "virtual-machine", "Run the virtual machine beside a LinuxCNC control of this computer",
                 [machine](JobContext& job) { return runMachine(*machine, job); });
  beside->add_option("SCENARIO", machine->scenario, "Scenario (JSON, format spindrift-scenario)")->required();
  beside->add_option("--truth", machine->truth, "What only the judge may know: true deviations and compensations")
      ->required()
      ->type_name("FILE");
  beside->add_option("--factor", machine->options.factor, "Machine seconds per second")
      ->check(positiveNumber())
      ->capture_default_str();
  beside->add_option("--hours", machine->hours, "Hours of machine time")
      ->check(positiveNumber())
      ->capture_default_str();
}

}  // namespace spindrift::cli
