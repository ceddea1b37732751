// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/base/error.h"
#include "core/workflows/closed_loop.h"

namespace spindrift {
namespace {

Eigen::Vector3d place(const JsonNode& node) {
  std::vector<double> numbers;
  for (const JsonNode& each : node.items()) numbers.push_back(each.number());
  if (numbers.size() != 3) node.reject("[x, y, z] in mm");
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

LoopPlan LoopPlan::read(const std::filesystem::path& file) {
  return parse(JsonNode::read(file), file);
}

LoopPlan LoopPlan::parse(const JsonNode& root, const std::filesystem::path& file) {
  root.requireFormat("spindrift-loop-plan", 1);
  LoopPlan plan;
  plan.machine = MachineDescription::read(file.parent_path() / root.at("machine").name());
  if (const auto simulation = root.find("simulation"))
    plan.simulation = Scenario::read(file.parent_path() / simulation->name());
  const JsonNode control = root.at("control");
  (void)control.at("kind").oneOf({"linuxcnc"});
  plan.control.shell.peer = hostAndPort(control.stringOr("address", "127.0.0.1:5007"), 5007);
  plan.control.folder = std::filesystem::absolute(file.parent_path() / control.at("folder").name());
  const JsonNode temperatures = root.at("temperatures");
  for (const JsonNode& each : temperatures.items()) plan.temperatures.push_back(each.name());
  const JsonNode touches = root.at("touches");
  for (const JsonNode& each : touches.items()) {
    LoopTouch touch;
    touch.point = each.at("point").name();
    touch.component = *componentFromString(each.at("component").oneOf({"EX", "EY", "EZ"}));
    touch.before_mm = place(each.at("before_mm"));
    touch.target_mm = place(each.at("target_mm"));
    plan.touches.push_back(touch);
  }
  const JsonNode programme = root.at("programme");
  for (const JsonNode& each : programme.items())
    plan.programme.push_back({each.at("from_s").nonNegativeNumber(), each.at("spindle_rpm").nonNegativeNumber()});
  plan.reference_mm = place(root.at("reference_mm"));
  plan.safe_z_mm = root.at("safe_z_mm").number();
  plan.duration_s = root.at("duration_s").positiveNumber();
  const auto positive = [&](const char* key, double& value) {
    if (const auto given = root.find(key)) value = given->positiveNumber();
  };
  const auto from_zero = [&](const char* key, double& value) {
    if (const auto given = root.find(key)) value = given->nonNegativeNumber();
  };
  positive("clear_mm", plan.clear_mm);
  positive("feed_mm_min", plan.feed_mm_min);
  positive("touch_sigma_um", plan.touch_sigma_um);
  positive("measure_every_s", plan.measure_every_s);
  positive("shortest_s", plan.shortest_s);
  positive("action_limit_um", plan.action_limit_um);
  positive("patience_s", plan.patience_s);
  from_zero("discrepancy_s", plan.discrepancy_s);
  from_zero("identify_s", plan.identify_s);
  if (const auto limits = root.find("limits")) {
    for (const auto& [key, value] : {std::pair<const char*, double*>{"limit_um", &plan.limits.limit_um},
                                     {"rate_um_s", &plan.limits.rate_um_s},
                                     {"step_um", &plan.limits.step_um},
                                     {"oldest_s", &plan.limits.oldest_s}}) {
      if (const auto given = limits->find(key)) *value = given->positiveNumber();
    }
  }
  if (const auto accept = root.find("accept")) {
    if (accept->value().is_array()) {
      plan.accept.rule = LoopAcceptance::Rule::Listed;
      for (const JsonNode& each : accept->items()) plan.accept.ids.push_back(each.name());
    } else if (accept->value().is_string() && accept->oneOf({"named", "ask"}) == "ask") {
      plan.accept.rule = LoopAcceptance::Rule::Ask;
    } else if (!accept->value().is_string()) {
      accept->reject("\"named\", \"ask\" or a list of ids of effects");
    }
  }
  const auto silent = root.find("when_silent");
  plan.hold_when_silent = silent && silent->oneOf({"zero", "hold"}) == "hold";
  plan.validate();
  return plan;
}

void LoopPlan::validate() const {
  limits.validate();
  const auto refuse = [](const std::string& what) { throw InputError("The plan of the loop: " + what); };
  if (touches.empty()) refuse("there are no touches; allowed: at least one.");
  if (programme.empty()) refuse("there is no program; allowed: at least one speed.");
  for (const LoopTouch& touch : touches) {
    // It stands in a comment of the measuring programme, and comes back in what that prints.
    const auto plain = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
    };
    if (touch.point.empty() || !std::all_of(touch.point.begin(), touch.point.end(), plain))
      refuse(fmt::format("the name of the point \"{}\" cannot stand in a program; allowed: letters, digits, _, - and .",
                         touch.point));
    const Eigen::Vector3d way = touch.target_mm - touch.before_mm;
    const int axis = axisIndex(touch.component);
    if (isRotation(touch.component) || std::abs(std::abs(way[axis]) - way.norm()) > 1e-9 || way.norm() < 1e-3)
      refuse(fmt::format("touch {} {} does not run along its axis.", touch.point, toString(touch.component)));
  }
  for (std::size_t i = 1; i < programme.size(); ++i) {
    if (programme[i].from_s <= programme[i - 1].from_s)
      refuse(fmt::format("speeds out of order of time at {:g} s.", programme[i].from_s));
  }
  if (!(duration_s > 0.0)) refuse("the duration is not above zero.");
  if (discrepancy_s > 0.0 && !simulation) refuse("\"discrepancy_s\" without a simulation.");
  if (touch_sigma_um <= 0.0) refuse("\"touch_sigma_um\" is not above zero.");
}

std::string measuringProgram(const LoopPlan& plan) {
  std::string out = fmt::format("G21 G90 G94 G40 G49 G54\nM5\n(LOGOPEN,{})\nG0 Z{:.4f}\n", print_file, plan.safe_z_mm);
  for (const LoopTouch& touch : plan.touches) {
    const Eigen::Vector3d along = (touch.target_mm - touch.before_mm).normalized();
    const Eigen::Vector3d clear = touch.before_mm - plan.clear_mm * along;
    out += fmt::format(
        "G0 X{:.4f} Y{:.4f}\nG0 Z{:.4f}\nG0 X{:.4f} Y{:.4f} Z{:.4f}\nG38.2 X{:.4f} Y{:.4f} Z{:.4f} F{:g}\n"
        "(LOG,TOUCH {} {} #5061 #5062 #5063 #<_hal[offset-x.offset]> #<_hal[offset-y.offset]> "
        "#<_hal[offset-z.offset]>)\n"
        "G0 X{:.4f} Y{:.4f} Z{:.4f}\nG0 Z{:.4f}\n",
        clear.x(), clear.y(), clear.z(), touch.before_mm.x(), touch.before_mm.y(), touch.before_mm.z(),
        touch.target_mm.x(), touch.target_mm.y(), touch.target_mm.z(), plan.feed_mm_min, touch.point,
        toString(touch.component), clear.x(), clear.y(), clear.z(), plan.safe_z_mm);
  }
  return out + "(LOGCLOSE)\nM2\n";
}

}  // namespace spindrift
