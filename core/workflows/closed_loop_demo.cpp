// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/closed_loop_demo.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/utc_time.h"
#include "core/control/private_control.h"
#include "core/workflows/machine_beside_control.h"

namespace spindrift {
namespace {

const Eigen::Vector3d corner_mm{300.0, 300.0, -300.0};

/// A vertical machining centre with an inside corner on its table.
nlohmann::json machineJson() {
  nlohmann::json points = nlohmann::json::array();
  const auto add = [&](const char* id, double x, double y, double z) {
    points.push_back({{"id", id}, {"kind", "surface"}, {"x_mm", x}, {"y_mm", y}, {"z_mm", z}});
  };
  add("F1", 260, 260, -300);
  add("F2", 160, 260, -300);
  add("F3", 260, 160, -300);
  add("W1", 300, 260, -280);
  add("W2", 300, 260, -230);
  add("V1", 260, 300, -280);
  const auto axis = [](const char* name, double from, double to, double bearing) {
    return nlohmann::json{{"name", name},
                          {"travel_mm", {from, to}},
                          {"drive", {{"type", "ball_screw"}, {"pitch_mm", 10}, {"fixed_bearing_mm", bearing}}},
                          {"scale", "rotary_encoder"},
                          {"datum_mm", from}};
  };
  return {{"format", "spindrift-machine"},
          {"version", 1},
          {"name", "vertical machining centre"},
          {"chain", "V [w-X'-Y'-b-Z-t]"},
          {"axes", {axis("X", 0, 500, 500), axis("Y", 0, 450, 0), axis("Z", -400, 0, 0)}},
          {"spindle", {{"axis", "Z"}, {"max_rpm", 6000}}},
          {"table", {{"centre_mm", {250, 225}}}},
          {"column", {{"base_mm", -580}}},
          {"points", points}};
}

nlohmann::json scenarioJson(const nlohmann::json& effects, const nlohmann::json& physics, double hours) {
  return {{"format", "spindrift-scenario"},
          {"version", 1},
          {"name", "closed loop"},
          {"seed", 11},
          {"duration_s", 3600.0 * hours},
          {"machine", machineJson()},
          {"physics", physics},
          {"environment", {{"temperature_degC", 20}, {"day_amplitude_K", 1.0}, {"day_phase_h", 2}, {"weather_K", 0.2}}},
          {"effects", effects}};
}

/// What the user's simulation knows.
nlohmann::json simulationJson(double hours) {
  return scenarioJson({{"spindle.growth.z", {{"on", true}, {"size", 1}}},
                       {"spindle.drift.y", {{"on", true}, {"size", 1}}},
                       {"column.expansion.z", {{"on", true}, {"size", 1}}}},
                      {{"expansion", 1.01}, {"friction", 0.99}}, hours);
}

/// What the machine does.
nlohmann::json truthJson(double hours) {
  return scenarioJson({{"spindle.growth.z", {{"on", true}, {"size", 1}}},
                       {"spindle.drift.y", {{"on", true}, {"size", 1}}},
                       {"column.expansion.z", {{"on", true}, {"size", 1}}},
                       {"spindle.drift.x", {{"on", true}, {"size", 1.5}}}},
                      nlohmann::json::object(), hours);
}

Scenario scenarioOf(const nlohmann::json& scenario) {
  return Scenario::parse(JsonNode::parse(scenario.dump(), "closed loop"), "closed loop");
}

/// A LinuxCNC for the plan's machine, whose time runs `factor` times faster than the clock.
void writeControl(const LoopPlan& plan, double factor, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  ControlConfiguration configuration;
  configuration.corner_mm = corner_mm;
  configuration.temperatures = plan.temperatures;
  configuration.max_velocity_mm_s = 400.0;
  configuration.max_acceleration_mm_s2 = 5000.0;
  // In the machine's time 0.2 um/s, and the machine's time runs faster.
  configuration.speed_mm_s = std::min(0.1, 1.5e-3 * plan.limits.rate_um_s * factor);
  configuration.acceleration_mm_s2 = 10.0 * configuration.speed_mm_s;
  writeControlConfiguration(plan.machine, configuration, folder);
}

struct Child {
  pid_t id = -1;
  ~Child() {
    if (id <= 0) return;
    ::kill(id, SIGKILL);
    int status = 0;
    ::waitpid(id, &status, 0);
  }
};

/// Connects, or says that the control does not come.
void waitForControl(LinuxcncControl& control) {
  std::string why;
  for (int i = 0; i < 100; ++i) {
    try {
      control.connect({});
      return;
    } catch (const ConnectionError& error) {
      why = error.what();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  throw InputError("The control does not start: " + why);
}

/// In the namespaces: control, machine beside it, loop.
std::string runInside(const LoopDemoOptions& options) {
  const std::filesystem::path folder = "/tmp/control";
  LoopPlan plan = demoPlan(options.hours);
  plan.control.folder = folder;
  writeControl(plan, options.factor, folder);

  Child machine;
  machine.id = ::fork();
  if (machine.id == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    int status = 0;
    try {
      BesideControlOptions beside;
      beside.scenario = demoTruth(options.hours);
      beside.factor = options.factor;
      beside.reference_mm = plan.reference_mm;
      beside.truth = options.folder / "truth.csv";
      beside.duration_s = 3600.0 * options.hours * 1.2;
      runBesideControl(beside, [] { return false; });
    } catch (const std::exception&) {
      status = 1;
    }
    ::_exit(status);
  }
  LinuxcncProcess process(folder);
  LinuxcncControl control(plan.control);
  waitForControl(control);
  LoopOperator who;
  who.confirm = [](const DryRun&) { return true; };
  plan.accept.rule = LoopAcceptance::Rule::Ask;
  who.choose = [](const DiscrepancyResult& found, const std::stop_token&) {
    std::vector<std::string> ids;
    for (const FoundEffect& effect : found.effects) ids.push_back(effect.id);
    return ids;
  };
  JobContext job;
  const LoopResult result = runClosedLoop(plan, control, who, options.folder / "campaign", job, {}, [](double) {
    return *parseUtc("2026-01-31T08:00:00Z");
  });  // the same every time
  writeFileAtomically(options.folder / "report.html", htmlOf(result.report("Closed loop")));
  return {};
}

}  // namespace

LoopPlan demoPlan(double hours) {
  LoopPlan plan;
  plan.machine = MachineDescription::parse(JsonNode::parse(machineJson().dump(), "machine.json"), "machine.json");
  plan.temperatures = {"T_spindle_degC",     "T_housing_degC", "T_column_front_degC",
                       "T_column_rear_degC", "T_table_degC",   "T_ambient_degC"};
  constexpr double before_mm = 0.25, behind_mm = 0.6;
  for (const MachinePoint& point : plan.machine.points) {
    const int axis = point.id[0] == 'F' ? 2 : point.id[0] == 'W' ? 0 : 1;
    const double towards = axis == 2 ? -1.0 : 1.0;
    LoopTouch touch{point.id, static_cast<Component>(axis), point.position_mm, point.position_mm};
    touch.before_mm[axis] -= towards * before_mm;
    touch.target_mm[axis] += towards * behind_mm;
    plan.touches.push_back(touch);
  }
  plan.safe_z_mm = -290.0;
  plan.clear_mm = 5.0;
  plan.reference_mm = {280.0, 280.0, -290.0};
  plan.programme = {{0.0, 0.0},        {1500.0, 4500.0}, {4500.0, 0.0},     {6000.0, 6000.0},
                    {9600.0, 2000.0},  {11400.0, 0.0},   {13500.0, 5000.0}, {17100.0, 3000.0},
                    {19500.0, 6000.0}, {22200.0, 0.0},   {24000.0, 4000.0}, {27000.0, 1500.0}};
  plan.duration_s = 3600.0 * hours;
  plan.measure_every_s = 600.0;
  plan.shortest_s = 400.0;
  plan.action_limit_um = 3.0;
  plan.discrepancy_s = 0.36 * plan.duration_s;
  plan.identify_s = 0.65 * plan.duration_s;
  plan.simulation = scenarioOf(simulationJson(hours));
  return plan;
}

Scenario demoTruth(double hours) {
  return scenarioOf(truthJson(hours));
}

void writeLoopExample(const std::filesystem::path& folder, double hours, double factor) {
  std::filesystem::create_directories(folder);
  const LoopPlan plan = demoPlan(hours);
  const auto list = [](const Eigen::Vector3d& v) { return nlohmann::json{v.x(), v.y(), v.z()}; };
  nlohmann::json out = {{"format", "spindrift-loop-plan"},
                        {"version", 1},
                        {"machine", "machine.json"},
                        {"simulation", "simulation.json"},
                        {"control", {{"kind", "linuxcnc"}, {"address", "127.0.0.1:5007"}, {"folder", "control"}}},
                        {"temperatures", plan.temperatures},
                        {"touches", nlohmann::json::array()},
                        {"programme", nlohmann::json::array()},
                        {"reference_mm", list(plan.reference_mm)},
                        {"safe_z_mm", plan.safe_z_mm},
                        {"clear_mm", plan.clear_mm},
                        {"feed_mm_min", plan.feed_mm_min},
                        {"touch_sigma_um", plan.touch_sigma_um},
                        {"duration_s", plan.duration_s},
                        {"measure_every_s", plan.measure_every_s},
                        {"shortest_s", plan.shortest_s},
                        {"action_limit_um", plan.action_limit_um},
                        {"discrepancy_s", plan.discrepancy_s},
                        {"identify_s", plan.identify_s},
                        {"accept", "named"},
                        {"when_silent", "zero"},
                        {"limits",
                         {{"limit_um", plan.limits.limit_um},
                          {"rate_um_s", plan.limits.rate_um_s},
                          {"step_um", plan.limits.step_um},
                          {"oldest_s", plan.limits.oldest_s}}}};
  for (const LoopTouch& touch : plan.touches)
    out["touches"].push_back({{"point", touch.point},
                              {"component", toString(touch.component)},
                              {"before_mm", list(touch.before_mm)},
                              {"target_mm", list(touch.target_mm)}});
  for (const LoopSpeed& speed : plan.programme)
    out["programme"].push_back({{"from_s", speed.from_s}, {"spindle_rpm", speed.spindle_rpm}});
  writeFileAtomically(folder / "plan.json", out.dump(1) + "\n");
  writeFileAtomically(folder / "machine.json", machineJson().dump(1) + "\n");
  writeFileAtomically(folder / "simulation.json", simulationJson(hours).dump(1) + "\n");
  writeFileAtomically(folder / "truth.json", truthJson(hours).dump(1) + "\n");
  writeControl(plan, factor, folder / "control");
}

std::vector<LoopJudgement> judgeLoop(const nlohmann::json& loop, const std::filesystem::path& truth) {
  const CsvTable table = CsvTable::read(truth);
  const std::vector<double> time = table.numbers("time_s");
  std::array<std::vector<double>, 3> e, c;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    e[axis] = table.numbers(fmt::format("e{}_um", "xyz"[axis]));
    c[axis] = table.numbers(fmt::format("c{}_um", "xyz"[axis]));
  }
  if (loop["cycles"].empty()) return {};
  const double zero_s = loop["cycles"][0]["time_s"].get<double>();
  // What comes after is the fading of the end.
  const double end_s = loop.contains("ended_s") && loop["ended_s"].is_number()
                           ? loop["ended_s"].get<double>()
                           : loop["events"].back()["time_s"].get<double>();
  const auto row = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), zero_s) - time.begin());
  std::vector<LoopJudgement> out;
  for (std::size_t s = 0; s < loop["stages"].size(); ++s) {
    LoopJudgement each;
    each.stage = loop["stages"][s]["stage"].get<std::string>();
    each.from_s = loop["stages"][s]["from_s"].get<double>();
    each.to_s = s + 1 < loop["stages"].size() ? loop["stages"][s + 1]["from_s"].get<double>() : end_s;
    double count = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
      if (time[i] < each.from_s || time[i] >= each.to_s) continue;
      count += 1.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double without = e[axis][i] - e[axis][row];
        const double with = without + c[axis][i] - c[axis][row];
        each.without_um[static_cast<Eigen::Index>(axis)] += without * without;
        each.with_um[static_cast<Eigen::Index>(axis)] += with * with;
      }
    }
    each.without_um = (each.without_um / std::max(1.0, count)).cwiseSqrt();
    each.with_um = (each.with_um / std::max(1.0, count)).cwiseSqrt();
    out.push_back(each);
  }
  return out;
}

nlohmann::json runLoopDemo(const LoopDemoOptions& options) {
  if (!(options.factor >= 1.0 && options.factor <= 200.0))
    throw InputError(fmt::format("The speed factor is {:g}; allowed: 1 to 200.", options.factor));
  if (!(options.hours >= 0.5 && options.hours <= 48.0))
    throw InputError(fmt::format("{:g} h of machine time; allowed: 0.5 to 48 h.", options.hours));
  if (const std::string why = whyNoPrivateControl(); !why.empty())
    throw InputError(fmt::format("The demonstration needs a control of its own: {}.", why));
  if (std::filesystem::exists(options.folder) && !std::filesystem::is_empty(options.folder))
    throw InputError(fmt::format("{} is not empty; allowed: a new or empty folder.", options.folder.string()));
  std::filesystem::create_directories(options.folder);
  LoopDemoOptions inside = options;
  inside.folder = std::filesystem::absolute(options.folder);
  const double limit_s = 3600.0 * options.hours / options.factor * 1.5 + 60.0;
  const std::string said = isolated([&inside] { return runInside(inside); }, {inside.folder}, limit_s);
  if (!said.empty()) throw InputError(said.starts_with("exception: ") ? said.substr(11) : said);
  nlohmann::json out = JsonNode::read(inside.folder / "campaign" / "loop.json").value();
  out["truth"] = nlohmann::json::array();
  for (const LoopJudgement& each : judgeLoop(out, inside.folder / "truth.csv")) {
    nlohmann::json entry = {{"stage", each.stage}, {"from_s", each.from_s}, {"to_s", each.to_s}};
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(toString(static_cast<Component>(axis)));
      entry["rms_without_um"][name] = each.without_um[axis];
      entry["rms_with_um"][name] = each.with_um[axis];
    }
    out["truth"].push_back(entry);
  }
  return out;
}

std::string loopDemoSummary(const nlohmann::json& json) {
  std::string out =
      fmt::format("{} measuring cycles; verdict of the discrepancy: {}; added: {}\n", json["measurements"].get<int>(),
                  json["verdict"].get<std::string>(), json["effects"].dump());
  for (const nlohmann::json& stage : json["truth"]) {
    out += fmt::format("{:.2f} to {:.2f} h, {}: true rms at the tool point", stage["from_s"].get<double>() / 3600.0,
                       stage["to_s"].get<double>() / 3600.0, stage["stage"].get<std::string>());
    for (const char* name : {"EX", "EY", "EZ"}) {
      const double without = stage["rms_without_um"][name].get<double>();
      const double with = stage["rms_with_um"][name].get<double>();
      out +=
          fmt::format(" {} {:.1f} → {:.1f} µm ({:.0f} %)", name, without, with, 100.0 * with / std::max(1e-9, without));
    }
    out += "\n";
  }
  return out;
}

}  // namespace spindrift
