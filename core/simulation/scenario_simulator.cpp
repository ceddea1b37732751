// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/scenario_simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/simulation/virtual_campaign.h"
#include "core/simulator/answer_cache.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

/// Causes that change the heat flow itself; their size is a factor.
constexpr std::string_view convection = "convection.speed";
constexpr std::string_view second_lag = "dynamics.second_lag";

/// Numbers that a scenario may leave out.
const std::vector<std::string>& knownKeys(const std::string& part) {
  static const std::vector<std::string> physics{"friction",         "screw_friction", "convection",
                                                "convection_speed", "spindle_mass",   "structure_mass",
                                                "screw_mass",       "conduction",     "expansion"};
  static const std::vector<std::string> environment{"temperature_degC",    "day_amplitude_K", "day_phase_h",
                                                    "ramp_K_per_h",        "weather_K",       "weather_hours",
                                                    "coolant_below_room_K"};
  static const std::vector<std::string> none;
  return part == "physics" ? physics : part == "environment" ? environment : none;
}

/// Where a parameter stands in the scenario.
struct Target {
  JsonPath path;
  std::string effect;  ///< id, of all that stands among the effects
  bool size = false;   ///< of that effect
};

/// The longest part of `rest` that ends with it or before a dot and that `fits`; empty if none does.
template <typename Fits>
std::string longestKey(const std::string& rest, const Fits& fits) {
  for (std::size_t end = rest.size(); end != std::string::npos && end > 0; end = rest.rfind('.', end - 1)) {
    std::string key = rest.substr(0, end);
    if (fits(key)) return key;
    if (end == 0) break;
  }
  return {};
}

const nlohmann::json* memberOf(const nlohmann::json* node, const std::string& key) {
  if (node == nullptr) return nullptr;
  if (node->is_object()) {
    const auto found = node->find(key);
    return found == node->end() ? nullptr : &*found;
  }
  if (node->is_array()) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (error == std::errc() && end == key.data() + key.size() && index < node->size()) return &(*node)[index];
  }
  return nullptr;
}

const nlohmann::json* valueAt(const nlohmann::json& document, const JsonPath& path) {
  const nlohmann::json* node = &document;
  for (const std::string& key : path) node = memberOf(node, key);
  return node;
}

/// Nothing if the path leads to no number of the scenario.
std::optional<Target> targetOf(const std::string& name, const nlohmann::json& document,
                               const MachineDescription& machine) {
  Target target;
  std::string rest = name;
  const nlohmann::json* node = &document;
  while (!rest.empty()) {
    const JsonPath& path = target.path;
    std::string key = longestKey(rest, [&](const std::string& k) { return memberOf(node, k) != nullptr; });
    if (key.empty() && (node == nullptr || node->is_object())) {
      key = longestKey(rest, [&](const std::string& k) {
        if (path.empty()) return k == "physics" || k == "environment" || k == "effects";
        if (path.size() == 1 && path[0] == "effects") {
          return k == convection || k == second_lag || whyNotPossible(k, machine).empty();
        }
        if (path.size() == 2 && path[0] == "effects") {
          const std::vector<std::string> own = effectParameters(path[1]);
          return k == "size" || std::find(own.begin(), own.end(), k) != own.end();
        }
        const std::vector<std::string>& known = knownKeys(path[0]);
        return path.size() == 1 && std::find(known.begin(), known.end(), k) != known.end();
      });
    }
    if (key.empty()) return std::nullopt;
    node = memberOf(node, key);
    target.path.push_back(key);
    rest.erase(0, std::min(rest.size(), key.size() + 1));
  }
  static const std::set<std::string> parts{"machine", "programme", "environment", "physics", "effects"};
  if (target.path.size() < 2 || !parts.contains(target.path[0])) return std::nullopt;
  if (node != nullptr && !node->is_number()) return std::nullopt;
  if (target.path[0] == "effects") {
    if (target.path.size() != 3 || target.path[2] == "strength") return std::nullopt;
    target.effect = target.path[1];
    target.size = target.path[2] == "size";
  } else if (node == nullptr && target.path.size() != 2) {
    return std::nullopt;
  }
  return target;
}

std::set<std::string> effectsOf(const nlohmann::json& document) {
  std::set<std::string> ids;
  const auto effects = document.find("effects");
  if (effects == document.end() || !effects->is_object()) return ids;
  for (auto it = effects->begin(); it != effects->end(); ++it) ids.insert(it.key());
  return ids;
}

/// What has to change in `document` for the parameter to have this value; nothing where it has it.
std::vector<JsonEdit> editsFor(const Target& target, double value, const nlohmann::json& document) {
  const nlohmann::json* now = valueAt(document, target.path);
  if (!target.size) {
    if (now != nullptr && now->get<double>() == value) return {};
    return {{target.path, value}};
  }
  const JsonPath effect{target.path[0], target.path[1]};
  const nlohmann::json* setting = valueAt(document, effect);
  // A factor of the heat flow is 1 where the scenario is silent, a cause is off.
  const bool factor = target.effect == convection || target.effect == second_lag;
  const bool on = setting == nullptr ? factor : !setting->contains("on") || (*setting)["on"] == true;
  const bool strength = setting != nullptr && setting->contains("strength");
  if (value == 0.0 && !on) return {};
  if (on && !strength && (now == nullptr ? 1.0 : now->get<double>()) == value) return {};
  std::vector<JsonEdit> edits{{target.path, value}};
  if (strength) edits.push_back({{effect[0], effect[1], "strength"}, std::nullopt});
  // A spindle without mass is none: that cause has a switch only.
  if (value == 0.0 && target.effect == second_lag) edits.push_back({{effect[0], effect[1], "on"}, false});
  if (value != 0.0 && setting != nullptr && !on) edits.push_back({{effect[0], effect[1], "on"}, true});
  return edits;
}

}  // namespace

struct ScenarioSimulator::Parts {
  explicit Parts(const SimulatorFile& simulator_file) : file(simulator_file) {}

  SimulatorFile file;
  std::string scenario;  ///< relative to the folder
  std::string machine;   ///< the same; empty: within the scenario
  fs::path path;         ///< of the scenario
  std::string text;      ///< of the scenario
  nlohmann::json document;
  std::map<std::string, Target> targets;  ///< by parameter

  mutable std::mutex mutex;
  mutable std::optional<std::map<std::string, double>> sizes;  ///< of effects that have a strength
  mutable AnswerCache<VirtualMachine> machines{6};
  mutable AnswerCache<std::vector<double>> answers{512};

  void readTargets();
  [[nodiscard]] std::vector<JsonEdit> editsOf(const ParameterValues& all) const;
  [[nodiscard]] nlohmann::json documentWith(const std::vector<JsonEdit>& edits) const;
  [[nodiscard]] Scenario parsed(const nlohmann::json& of) const {
    return Scenario::parse(JsonNode::parse(of.dump(), path), path);
  }
  /// Sizes of the effects with a strength, in the scenario with the simulator's own values.
  [[nodiscard]] std::map<std::string, double> resolvedSizes(const JobContext& job) const;
  [[nodiscard]] std::shared_ptr<const VirtualMachine> machineOf(const Scenario& scenario, const nlohmann::json& of,
                                                                const JobContext& job) const;
  [[nodiscard]] std::vector<double> predicted(const nlohmann::json& of, const ObservationSet& at,
                                              const JobContext& job) const;
};

void ScenarioSimulator::Parts::readTargets() {
  const Scenario as_it_stands = Scenario::read(path);
  std::set<std::string> sized = effectsOf(document);
  const std::vector<JsonNode> nodes = file.root.at("parameters").items();
  for (std::size_t i = 0; i < file.parameters.size(); ++i) {
    const auto target = targetOf(file.parameters[i].name, document, as_it_stands.machine);
    if (!target) {
      nodes[i].at("name").reject(
          fmt::format("the path of a number of {} in machine, programme, environment, physics or effects, such as "
                      "\"physics.friction\" or \"effects.spindle.growth.z.size\"",
                      scenario));
    }
    if (target->size) sized.insert(target->effect);
    targets[file.parameters[i].name] = *target;
  }
  for (std::size_t i = 0; i < file.parameters.size(); ++i) {
    const Target& target = targets.at(file.parameters[i].name);
    if (!target.effect.empty() && !sized.contains(target.effect)) {
      nodes[i].at("name").reject(
          fmt::format("a number of an effect of {}, or one whose size is a parameter as well", scenario));
    }
  }
}

std::vector<JsonEdit> ScenarioSimulator::Parts::editsOf(const ParameterValues& all) const {
  std::vector<JsonEdit> edits;
  for (const SimulatorParameter& p : file.parameters) {
    const std::vector<JsonEdit> more = editsFor(targets.at(p.name), all.at(p.name), document);
    edits.insert(edits.end(), more.begin(), more.end());
  }
  // A number of an effect that is off and not in the scenario must not bring it in.
  std::set<std::string> there = effectsOf(document);
  for (const JsonEdit& edit : edits) {
    if (edit.path[0] == "effects" && edit.path[2] == "size") there.insert(edit.path[1]);
  }
  std::erase_if(edits, [&](const JsonEdit& e) { return e.path[0] == "effects" && !there.contains(e.path[1]); });
  return edits;
}

nlohmann::json ScenarioSimulator::Parts::documentWith(const std::vector<JsonEdit>& edits) const {
  nlohmann::json out = document;
  for (const JsonEdit& edit : edits) applyEdit(out, edit);
  return out;
}

std::map<std::string, double> ScenarioSimulator::Parts::resolvedSizes(const JobContext& job) const {
  job.throwIfCancelled();
  const std::scoped_lock lock(mutex);
  if (sizes) return *sizes;
  ParameterValues own;
  for (const SimulatorParameter& p : file.parameters) own[p.name] = p.value;
  Scenario s = parsed(documentWith(editsOf(own)));
  std::map<std::string, double> out;
  const bool any =
      std::any_of(s.effects.begin(), s.effects.end(), [](const auto& e) { return e.second.strength.has_value(); });
  if (any) {
    s.simulation.reset();
    s.touches.reset();
    s.microscope.reset();
    s.profiler.reset();
    const VirtualCampaign campaign = simulateCampaign(s, {}, JobContext());
    for (const auto& [id, effect] : s.effects) {
      if (!effect.strength) continue;
      const auto found = campaign.truth.settings.find(id);
      out[id] = found == campaign.truth.settings.end() ? 0.0 : found->second.size;
    }
  }
  sizes = out;
  return out;
}

std::shared_ptr<const VirtualMachine> ScenarioSimulator::Parts::machineOf(const Scenario& s, const nlohmann::json& of,
                                                                          const JobContext& job) const {
  nlohmann::json key{{"seed", s.seed}, {"duration_s", s.duration_s}, {"machine", s.machine.source}};
  for (const char* part : {"programme", "environment"}) {
    if (of.contains(part)) key[part] = of[part];
  }
  const PlantParameters& p = s.physics;
  key["physics"] = {p.friction,       p.screw_friction, p.convection, p.convection_speed, p.spindle_mass,
                    p.structure_mass, p.screw_mass,     p.conduction, p.expansion};
  return machines.get(key.dump(), job, [&] { return makeVirtualMachine(s, {}, JobContext()); }).answer;
}

std::vector<double> ScenarioSimulator::Parts::predicted(const nlohmann::json& of, const ObservationSet& at,
                                                        const JobContext& job) const {
  const Scenario s = parsed(of);
  PlantEffectSettings settings;
  for (const auto& [id, effect] : s.effects) {
    settings[id] = effect.setting;
    if (effect.strength) settings[id].size = resolvedSizes(job).at(id);
  }
  const std::shared_ptr<const VirtualMachine> plant = machineOf(s, of, job);
  job.throwIfCancelled();
  std::vector<PlantQuery> queries;
  queries.reserve(at.rows.size());
  for (const Observation& o : at.rows) {
    queries.push_back({o.time_s, o.position_mm, o.c_deg * rad_per_deg, o.approach, o.tool_offset_mm, o.point});
  }
  const std::vector<SmallError> errors = plant->deviations(settings, queries);
  std::vector<double> out(at.rows.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < out.size(); ++i) {
    // A state that begins before the end is measured point by point.
    if (at.rows[i].time_s > s.duration_s + s.log_period_s) continue;
    out[i] = valueOf(errors[i], at.rows[i].component);
  }
  return out;
}

ScenarioSimulator::ScenarioSimulator(const SimulatorFile& file) : parts_(std::make_unique<Parts>(file)) {
  SPINDRIFT_ASSERT(file.kind == SimulatorKind::Scenario, "a scenario");
  file_ = file.file;
  parameters_ = file.parameters;
  Parts& parts = *parts_;
  parts.scenario = file.relativeFile(file.root.at("scenario"));
  parts.path = file.folder() / parts.scenario;
  parts.text = readFile(parts.path);
  const JsonNode root = JsonNode::parse(parts.text, parts.path);
  parts.document = root.value();
  if (root.has("machine") && root.at("machine").value().is_string()) {
    parts.machine = (fs::path(parts.scenario).parent_path() / pathWithin(root.at("machine"))).generic_string();
  }
  if (const auto sensors = file.root.find("sensor_values")) {
    sensors->reject("no errors of sensors: the virtual machine makes its own temperatures and reads none of log.csv");
  }
  parts.readTargets();
  // Values that the scenario does not take are told here, not in the middle of a search.
  (void)parts.parsed(parts.documentWith(parts.editsOf(completeValues(*this, {}))));
}

ScenarioSimulator::~ScenarioSimulator() = default;

SimulatorRun ScenarioSimulator::run(const ParameterValues& values, const ObservationSet& at,
                                    const JobContext& job) const {
  const auto started = std::chrono::steady_clock::now();
  const nlohmann::json of = parts_->documentWith(parts_->editsOf(completeValues(*this, values)));
  try {
    const auto kept = parts_->answers.get(sha256(of.dump() + placesOf(at)), job, [&] {
      return std::make_shared<const std::vector<double>>(parts_->predicted(of, at, job));
    });
    SimulatorRun out;
    out.predicted = *kept.answer;
    if (kept.fresh) {
      out.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    }
    return out;
  } catch (const InputError& error) {
    std::string text = error.what();
    while (!text.empty() && text.back() == '.') text.pop_back();
    throw SimulatorFailed(fmt::format("The virtual machine does not run with {}: {}.", valuesText(values), text));
  }
}

void ScenarioSimulator::writeVersion(const ParameterValues& values, const fs::path& folder,
                                     const nlohmann::json& change) const {
  const Parts& parts = *parts_;
  const ParameterValues all = completeValues(*this, values);
  const std::string text = appendedJson(editedJson(parts.file.text, valueEdits(parts.file, all)), "history", change);
  std::vector<JsonEdit> edits = parts.editsOf(all);
  for (const auto& [id, effect] : parts.parsed(parts.documentWith(edits)).effects) {
    if (!effect.strength) continue;
    // The strength of other values would be another size.
    edits.push_back({{"effects", id, "size"}, parts.resolvedSizes({}).at(id)});
    edits.push_back({{"effects", id, "strength"}, std::nullopt});
  }
  const std::string scenario = editedJson(parts.text, edits);
  writeWholeFolder(folder, [&](const fs::path& into) {
    writeFileAtomically(into / "simulator.json", text);
    writeFileAtomically(into / parts.scenario, scenario);
    if (!parts.machine.empty()) copyWithin(parts.file.folder(), into, parts.machine);
  });
}

}  // namespace spindrift
