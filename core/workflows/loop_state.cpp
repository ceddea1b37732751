// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/loop_state.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/csv_rows.h"
#include "core/base/error.h"
#include "core/base/inside_folder.h"
#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/machine/operating_log.h"
#include "core/workflows/loop_models.h"

namespace spindrift {
namespace {

nlohmann::json listed(const Eigen::VectorXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

Eigen::VectorXd vectorOf(const JsonNode& node) {
  const std::vector<double> values = node.numbers();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd matrixOf(const JsonNode& node, Eigen::Index size) {
  const Eigen::VectorXd values = vectorOf(node);
  if (values.size() != size * size) node.reject(fmt::format("{} numbers", size * size));
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), size, size);
}

LoopStage stageOf(const JsonNode& node) {
  const std::string name =
      node.oneOf({std::string(toString(LoopStage::None)), std::string(toString(LoopStage::Simulation)),
                  std::string(toString(LoopStage::WithEffect)), std::string(toString(LoopStage::Identified))});
  for (const LoopStage each : {LoopStage::Simulation, LoopStage::WithEffect, LoopStage::Identified}) {
    if (name == toString(each)) return each;
  }
  return LoopStage::None;
}

const std::vector<double>& signalOf(const OperatingLog& log, const std::string& name) {
  if (const std::vector<double>* values = log.signal(name)) return *values;
  throw InputError({log.file(), "header"},
                   fmt::format("column \"{}\" is missing; found: {}.", name, joinedList(log.names())));
}

/// {"EX": 1.2} as JSON of a result has it; NaN where nothing stands.
Eigen::Vector3d componentsOf(const JsonNode& node) {
  Eigen::Vector3d out = Eigen::Vector3d::Constant(std::nan(""));
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto found = node.find(toString(static_cast<Component>(axis)))) out[axis] = found->number();
  }
  return out;
}

/// What the data depend on: with another of these, what was measured means something else.
std::string fingerprint(const LoopPlan& plan) {
  std::string text = plan.machine.source.dump();
  for (const std::string& column : plan.temperatures) text += "\n" + column;
  for (const LoopTouch& touch : plan.touches)
    text += fmt::format("\n{} {} {} {} {}", touch.point, toString(touch.component), touch.target_mm.x(),
                        touch.target_mm.y(), touch.target_mm.z());
  text += fmt::format("\n{} {} {}", plan.reference_mm.x(), plan.reference_mm.y(), plan.reference_mm.z());
  text += plan.simulation ? "\n" + plan.simulation->name : "";
  return sha256(text);
}

LoopResult resultOf(const JsonNode& node) {
  LoopResult out;
  for (const JsonNode& each : node.at("effects").items()) out.effects.push_back(each.string());
  out.verdict = node.at("verdict").string();
  out.losses = node.at("losses").integer();
  out.resumed = node.at("resumed").integer();
  out.largest_step_um = node.at("largest_step_um").number();
  out.largest_rate_um_s = node.at("largest_rate_um_s").number();
  for (const JsonNode& each : node.at("stages").items())
    out.stages.emplace_back(each.at("from_s").number(), stageOf(each.at("stage")));
  for (const JsonNode& each : node.at("cycles").items()) {
    LoopCycle cycle;
    cycle.time_s = each.at("time_s").number();
    cycle.stage = stageOf(each.at("stage"));
    cycle.why = each.at("why").string();
    cycle.without_um = componentsOf(each.at("without_um"));
    cycle.with_um = componentsOf(each.at("with_um"));
    cycle.predicted_um = componentsOf(each.at("predicted_um"));
    cycle.sigma_um = componentsOf(each.at("sigma_um"));
    out.cycles.push_back(cycle);
  }
  for (const JsonNode& each : node.at("events").items())
    out.events.push_back({each.at("time_s").number(), each.at("text").string()});
  return out;
}

}  // namespace

nlohmann::json LoopState::json(const LoopPlan& plan) const {
  nlohmann::json out = {{"format", "spindrift-loop-state"},
                        {"version", 1},
                        {"plan", fingerprint(plan)},
                        {"time_s", time_s},
                        {"began_unix_s", began_unix_s},
                        {"stage", toString(stage)},
                        {"next_cycle_s", next_cycle_s},
                        {"why", why},
                        {"searched", searched},
                        {"tried", tried},
                        {"ours", ours},
                        {"measuring", measuring},
                        {"rehomed", rehomed},
                        {"result", result.json()},
                        {"models", models}};
  if (tool) out["tool"] = *tool;
  if (home_mm) out["home_mm"] = listed(*home_mm);
  return out;
}

LoopState LoopState::read(const std::filesystem::path& file, const LoopPlan& plan) {
  const JsonNode root = JsonNode::read(file);
  root.requireFormat("spindrift-loop-state", 1);
  LoopState out;
  if (root.at("plan").string() != fingerprint(plan))
    throw InputError(
        fmt::format("{} belongs to a loop with another plan (machine, touches, temperatures or "
                    "simulation); allowed: the plan it was begun with, or a new folder.",
                    file.string()));
  if (root.at("result").at("completed").boolean())
    throw InputError(
        fmt::format("{} belongs to a loop that has reached its end; allowed: a new or empty folder.", file.string()));
  out.time_s = root.at("time_s").number();
  out.began_unix_s = root.at("began_unix_s").number();
  out.stage = stageOf(root.at("stage"));
  out.next_cycle_s = root.at("next_cycle_s").number();
  out.why = root.at("why").string();
  out.searched = root.at("searched").boolean();
  const JsonNode tried = root.at("tried");
  if (tried.integer() < 0) tried.reject("a number of cycles");
  out.tried = static_cast<std::size_t>(tried.integer());
  out.ours = root.at("ours").boolean();
  if (const auto measuring = root.find("measuring")) out.measuring = measuring->boolean();
  out.rehomed = root.at("rehomed").boolean();
  if (const auto tool = root.find("tool")) out.tool = tool->integer();
  if (const auto home = root.find("home_mm")) out.home_mm = home->vector3();
  out.result = resultOf(root.at("result"));
  out.models = root.at("models").value();
  return out;
}

// --- the models' part

nlohmann::json LoopModels::state() const {
  nlohmann::json out;
  out["speeds"] = twin_ ? nlohmann::json(twin_->speeds()) : nlohmann::json::array();
  out["zero"] = nlohmann::json::object();
  for (const auto& [name, zero] : zero_)
    out["zero"][name] = {{"position_mm", listed(zero.position_mm)},
                         {"applied_mm", listed(zero.applied_mm)},
                         {"simulated_um", zero.simulated_um}};
  out["zero_reference_um"] = listed(zero_reference_um_);
  out["readings"] = nlohmann::json::array();
  for (std::size_t i = 0; i < observations_.rows.size(); ++i) {
    const Observation& o = observations_.rows[i];
    out["readings"].push_back(
        {{"time_s", o.time_s}, {"state", o.state}, {"value_um", o.value}, {"simulated_um", simulated_[i]}});
  }
  out["trust"] = nlohmann::json::array();
  for (const Trust& trust : trusted_)
    out["trust"].push_back({{"identified", trust.identified},
                            {"cycles", trust.cycles},
                            {"judged", trust.judged},
                            {"simulation_um2", trust.simulation_um2},
                            {"model_um2", trust.model_um2}});
  if (effect_file_) out["effects"] = effect_file_->filename().string();
  out["identified"] = nlohmann::json::array();
  for (const auto& [axis, each] : identified_)
    out["identified"].push_back({{"axis", axis},
                                 {"model", each.model.json()},
                                 {"filter", listed(each.filter.state())},
                                 {"covariance", listed(each.filter.covariance().reshaped())},
                                 {"told", listed(each.told)}});
  return out;
}

void LoopModels::restore(const JsonNode& state, const std::filesystem::path& log, const std::filesystem::path& folder,
                         double now_s) {
  if (twin_) {
    LoopTwin::Speeds speeds;
    for (const JsonNode& each : state.at("speeds").items()) {
      const std::vector<double> pair = each.numbers();
      if (pair.size() != 2) each.reject("[time in s, speed in rpm]");
      speeds.emplace_back(pair[0], pair[1]);
    }
    twin_->replay(speeds, now_s);
  }
  for (const auto& [name, zero] : state.at("zero").members()) {
    LoopReading& reading = zero_[name];
    reading.name = name;
    reading.position_mm = zero.at("position_mm").vector3();
    reading.applied_mm = zero.at("applied_mm").vector3();
    reading.simulated_um = zero.at("simulated_um").number();
  }
  zero_reference_um_ = state.at("zero_reference_um").vector3();
  const std::vector<JsonNode> readings = state.at("readings").items();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const LoopTouch& touch = plan_.touches[i % plan_.touches.size()];
    Observation row;
    row.time_s = readings[i].at("time_s").number();
    row.state = readings[i].at("state").string();
    row.point = touch.point;
    row.position_mm = touch.target_mm;
    row.component = touch.component;
    row.value = readings[i].at("value_um").number();
    row.sigma = plan_.touch_sigma_um;
    row.instrument = "probe";
    observations_.rows.push_back(row);
    simulated_.push_back(readings[i].at("simulated_um").number());
  }
  const std::vector<JsonNode> trust = state.at("trust").items();
  for (std::size_t axis = 0; axis < trusted_.size() && axis < trust.size(); ++axis)
    trusted_[axis] = {trust[axis].at("identified").boolean(), trust[axis].at("cycles").integer(),
                      trust[axis].at("judged").integer(), trust[axis].at("simulation_um2").number(),
                      trust[axis].at("model_um2").number()};
  if (CsvRows(log).next()) {
    const OperatingLog rows = OperatingLog::read(log);
    times_ = rows.time_s();
    columns_[0] = signalOf(rows, "spindle_rpm");
    for (std::size_t c = 0; c < plan_.temperatures.size(); ++c) columns_[c + 1] = signalOf(rows, plan_.temperatures[c]);
  }
  for (const JsonNode& each : state.at("identified").items()) {
    ThermalModel model = ThermalModel::parse(each.at("model"));
    const JsonNode axis = each.at("axis");
    if (axis.integer() < 0 || axis.integer() > 2) axis.reject("0, 1 or 2");
    if (model.outputs.size() != 1) each.at("model").reject("a model of one output");
    if (times_.empty()) each.reject("no model before the log has a row");
    const double left_um = model.outputs.front().noise_sigma;
    Identified found = identifiedFrom(std::move(model), left_um);
    const Eigen::VectorXd filter = vectorOf(each.at("filter"));
    found.filter.restore(filter, matrixOf(each.at("covariance"), filter.size()));
    const Eigen::VectorXd told = vectorOf(each.at("told"));
    if (told.size() == found.features.size()) found.told = told;
    identified_.insert_or_assign(axis.integer(), std::move(found));
  }
  if (const auto effects = state.find("effects"))
    effect_file_ = InsideFolder(folder).path(effects->name(), effects->place());
  if (!times_.empty()) refresh();
}

}  // namespace spindrift
