// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/machine/operating_log.h"

namespace spindrift {
namespace {

/// What a campaign may hold; more is a slip of the pen that would take the whole memory.
constexpr double most_states = 1e5;
constexpr double most_log_rows = 1e7;
constexpr int most_doors = 10000;

constexpr std::array<char, 3> axes{'x', 'y', 'z'};

double partOf(const JsonNode& node, std::string_view key, double otherwise) {
  const auto found = node.find(key);
  if (!found) return otherwise;
  const double value = found->number();
  if (value < 0.0 || value >= 1.0) found->reject("a number from 0 to below 1");
  return value;
}

double nonNegative(const JsonNode& node, std::string_view key, double otherwise) {
  const auto found = node.find(key);
  return found ? found->nonNegativeNumber() : otherwise;
}

double positive(const JsonNode& node, std::string_view key, double otherwise) {
  const auto found = node.find(key);
  return found ? found->positiveNumber() : otherwise;
}

std::vector<double> numbersOr(const JsonNode& node, std::string_view key, std::vector<double> otherwise) {
  const auto found = node.find(key);
  if (!found) return otherwise;
  std::vector<double> values = found->numbers();
  if (values.empty()) found->reject("at least one number");
  return values;
}

std::vector<std::string> words(const JsonNode& node) {
  std::vector<std::string> list;
  for (const JsonNode& item : node.items()) list.push_back(item.name());
  return list;
}

Programme parseSegments(const JsonNode& node) {
  std::vector<ProgrammeSegment> segments;
  for (const JsonNode& item : node.items()) {
    ProgrammeSegment s = segments.empty() ? ProgrammeSegment{} : segments.back();
    const JsonNode from = item.at("from_s");
    s.from_s = from.nonNegativeNumber();
    if (segments.empty() && s.from_s != 0.0) from.reject("0 for the first segment");
    if (!segments.empty() && s.from_s <= segments.back().from_s) from.reject("a time after that of the segment before");
    s.spindle_rpm = nonNegative(item, "spindle_rpm", s.spindle_rpm);
    for (std::size_t a = 0; a < 3; ++a) {
      s.feed_mm_min[a] = nonNegative(item, fmt::format("feed_{}_mm_min", axes[a]), s.feed_mm_min[a]);
      s.position_mm[a] = item.numberOr(fmt::format("pos_{}_mm", axes[a]), s.position_mm[a]);
      s.stroke_part[a] = nonNegative(item, fmt::format("stroke_{}", axes[a]), s.stroke_part[a]);
    }
    s.c_rpm = item.numberOr("c_rpm", s.c_rpm);
    s.coolant = item.booleanOr("coolant", s.coolant);
    s.instrument_on = item.booleanOr("instrument_on", s.instrument_on);
    segments.push_back(s);
  }
  if (segments.empty()) node.reject("at least one segment");
  return Programme(std::move(segments));
}

RandomProgrammeOptions parseRandom(const JsonNode& node) {
  RandomProgrammeOptions o;
  o.idle_s = nonNegative(node, "idle_s", o.idle_s);
  o.mean_hold_s = positive(node, "mean_hold_s", o.mean_hold_s);
  o.speeds_rpm = numbersOr(node, "speeds_rpm", o.speeds_rpm);
  o.feeds_mm_min = numbersOr(node, "feeds_mm_min", o.feeds_mm_min);
  o.c_speeds_rpm = numbersOr(node, "c_speeds_rpm", o.c_speeds_rpm);
  o.coolant = node.booleanOr("coolant", o.coolant);
  o.move = node.booleanOr("move", o.move);
  o.places = numbersOr(node, "places", o.places);
  o.stroke_part = positive(node, "stroke_part", o.stroke_part);
  o.instrument_on_s = nonNegative(node, "instrument_on_s", o.instrument_on_s);
  return o;
}

EnvironmentOptions parseEnvironment(const JsonNode& node) {
  EnvironmentOptions o;
  o.temperature_degC = node.numberOr("temperature_degC", o.temperature_degC);
  o.day_amplitude_K = node.numberOr("day_amplitude_K", o.day_amplitude_K);
  o.day_phase_h = node.numberOr("day_phase_h", o.day_phase_h);
  o.ramp_K_per_h = node.numberOr("ramp_K_per_h", o.ramp_K_per_h);
  o.weather_K = nonNegative(node, "weather_K", o.weather_K);
  o.weather_hours = positive(node, "weather_hours", o.weather_hours);
  o.coolant_below_room_K = node.numberOr("coolant_below_room_K", o.coolant_below_room_K);
  if (const auto doors = node.find("doors")) {
    for (const JsonNode& door : doors->items()) {
      o.doors.push_back(
          {door.at("time_s").number(), door.numberOr("drop_K", 2.0), positive(door, "recovery_s", 1200.0)});
    }
  }
  if (const auto count = node.find("random_doors")) {
    o.random_doors = count->integer();
    if (o.random_doors < 0 || o.random_doors > most_doors) {
      count->reject(fmt::format("a whole number from 0 to {}", most_doors));
    }
  }
  return o;
}

PlantParameters parsePhysics(const JsonNode& node) {
  PlantParameters p;
  p.friction = positive(node, "friction", p.friction);
  p.screw_friction = positive(node, "screw_friction", p.screw_friction);
  p.convection = positive(node, "convection", p.convection);
  p.convection_speed = nonNegative(node, "convection_speed", p.convection_speed);
  p.spindle_mass = positive(node, "spindle_mass", p.spindle_mass);
  p.structure_mass = positive(node, "structure_mass", p.structure_mass);
  p.screw_mass = positive(node, "screw_mass", p.screw_mass);
  p.conduction = positive(node, "conduction", p.conduction);
  p.expansion = positive(node, "expansion", p.expansion);
  return p;
}

ScenarioEffect parseEffect(const std::string& id, const JsonNode& node, const MachineDescription& machine) {
  const std::string reason = whyNotPossible(id, machine);
  if (!reason.empty()) throw InputError(node.place(), fmt::format("effect \"{}\" {}.", id, reason));
  ScenarioEffect effect;
  effect.setting.on = node.booleanOr("on", true);
  effect.setting.size = node.numberOr("size", 1.0);
  if (const auto strength = node.find("strength")) {
    effect.strength = strength->nonNegativeNumber();
    if (node.has("size")) node.reject("either size or strength");
  }
  if (const auto driver = node.find("driver")) effect.setting.driver = driver->oneOf({"room", "column", "spindle"});
  for (const std::string& name : effectParameters(id)) {
    if (const auto value = node.find(name)) effect.setting.parameters[name] = value->number();
  }
  return effect;
}

std::vector<double> parseTimes(const JsonNode& node, std::string_view count_key, double duration_s) {
  if (const auto times = node.find("times_s")) {
    std::vector<double> list = times->numbers();
    if (list.empty() || !std::is_sorted(list.begin(), list.end()) || list.front() < 0.0) {
      times->reject("times in order, from 0");
    }
    return list;
  }
  const double first = nonNegative(node, "first_s", 0.0);
  const double every = node.at("every_s").positiveNumber();
  const auto count_node = node.find(count_key);
  const double count = count_node ? count_node->integer() : std::floor((duration_s - first) / every);
  if (!(count >= 1.0 && count <= most_states)) node.reject(fmt::format("1 to {:.0f} of {}", most_states, count_key));
  std::vector<double> list;
  for (int i = 0; i < static_cast<int>(count); ++i) list.push_back(first + i * every);
  return list;
}

MeasurementOptions parseMeasurement(const JsonNode& node, const MachineDescription& machine, double duration_s) {
  MeasurementOptions m;
  m.times_s = parseTimes(node, "states", duration_s);
  m.per_point_s = nonNegative(node, "per_point_s", m.per_point_s);
  if (const auto points = node.find("points")) {
    for (const JsonNode& item : points->items()) {
      m.points.push_back(item.name());
      if (machine.findPoint(m.points.back()) == nullptr) item.reject("the id of a point of the machine");
    }
  }
  if (machine.points.empty()) node.reject("a machine with points");
  if (const auto components = node.find("components")) {
    m.components.clear();
    for (const JsonNode& item : components->items()) {
      const auto component = componentFromString(item.string());
      if (!component) item.reject("EX, EY, EZ, EA, EB or EC");
      m.components.push_back(*component);
    }
    if (m.components.empty()) components->reject("at least one component");
  }
  m.c_deg = numbersOr(node, "c_deg", m.c_deg);
  if (const auto offset = node.find("tool_offset_mm")) m.tool_offset_mm = offset->vector3();
  m.random_approach = node.booleanOr("random_approach", m.random_approach);
  m.clock_offset_s = node.numberOr("clock_offset_s", m.clock_offset_s);
  if (const auto holdout = node.find("holdout")) {
    for (const std::string& state : words(*holdout)) m.holdout.insert(state);
  }
  if (const auto last = node.find("holdout_last")) {
    const int count = last->integer();
    const int states = static_cast<int>(m.times_s.size());
    if (count < 0 || count >= states) last->reject("a whole number from 0, less than the number of states");
    for (int i = states - count; i < states; ++i) m.holdout.insert(fmt::format("M{}", i));
  }
  return m;
}

InstrumentOptions parseInstrument(const JsonNode& node) {
  InstrumentOptions o;
  o.name = node.stringOr("name", o.name);
  o.sigma_um = positive(node, "sigma_um", o.sigma_um);
  o.sigma_urad = positive(node, "sigma_urad", o.sigma_urad);
  o.resolution_um = nonNegative(node, "resolution_um", o.resolution_um);
  o.drift_um_per_h = node.numberOr("drift_um_per_h", o.drift_um_per_h);
  o.ar1 = partOf(node, "ar1", o.ar1);
  o.dropped = partOf(node, "dropped", o.dropped);
  o.outliers = partOf(node, "outliers", o.outliers);
  o.outlier_size = nonNegative(node, "outlier_size", o.outlier_size);
  return o;
}

TouchOptions parseTouches(const JsonNode& node, const MachineDescription& machine, double duration_s) {
  TouchOptions t;
  const JsonNode artefact = node.at("artefact");
  t.artefact = artefact.name();
  if (machine.findArtefact(t.artefact) == nullptr) artefact.reject("the id of an artefact of the machine");
  if (machine.styli.empty()) node.reject("a machine with styli");
  t.times_s = parseTimes(node, "cycles", duration_s);
  t.touch_s = nonNegative(node, "touch_s", t.touch_s);
  t.sigma_um = nonNegative(node, "sigma_um", t.sigma_um);
  t.pretravel_um = node.numberOr("pretravel_um", t.pretravel_um);
  if (const auto origin = node.find("origin_mm")) t.origin_mm = origin->vector3();
  return t;
}

std::vector<SensorOptions> parseSensors(const JsonNode& node) {
  std::vector<SensorOptions> sensors;
  for (const JsonNode& item : node.items()) {
    SensorOptions s;
    const JsonNode name = item.at("name");
    s.name = name.name();
    if (!OperatingLog::isTemperature(s.name)) name.reject("a name such as T_column_degC");
    for (const SensorOptions& other : sensors) {
      if (other.name == s.name) name.reject("a name that no other sensor has");
    }
    s.place = item.at("place").name();
    (void)volumesAt(BodyIndex{}, s.place, item.at("place").place());
    s.noise_K = nonNegative(item, "noise_K", s.noise_K);
    s.ar1 = partOf(item, "ar1", s.ar1);
    s.resolution_K = nonNegative(item, "resolution_K", s.resolution_K);
    s.bias_K = item.numberOr("bias_K", s.bias_K);
    s.drift_K_per_h = item.numberOr("drift_K_per_h", s.drift_K_per_h);
    s.time_constant_s = nonNegative(item, "time_constant_s", s.time_constant_s);
    s.dead = item.booleanOr("dead", s.dead);
    s.dropout = partOf(item, "dropout", s.dropout);
    sensors.push_back(s);
  }
  return sensors;
}

}  // namespace

std::vector<SensorOptions> standardSensors(const MachineDescription& machine) {
  std::vector<SensorOptions> sensors;
  for (const TemperatureSensor& sensor : machine.temperature_sensors) {
    try {
      (void)volumesAt(BodyIndex{}, sensor.place, {});
    } catch (const InputError&) {
      continue;
    }
    SensorOptions s;
    s.name = sensor.name;
    s.place = sensor.place;
    sensors.push_back(s);
  }
  if (!sensors.empty()) return sensors;
  const std::pair<const char*, const char*> usual[] = {{"T_spindle_degC", "front bearing"},
                                                       {"T_housing_degC", "spindle housing"},
                                                       {"T_column_front_degC", "column front"},
                                                       {"T_column_rear_degC", "column rear"},
                                                       {"T_table_degC", "table"},
                                                       {"T_ambient_degC", "room"}};
  for (const auto& [name, place] : usual) {
    SensorOptions s;
    s.name = name;
    s.place = place;
    sensors.push_back(s);
  }
  return sensors;
}

Scenario Scenario::read(const std::filesystem::path& file) {
  return parse(JsonNode::read(file), file);
}

Scenario Scenario::parse(const JsonNode& root, const std::filesystem::path& file) {
  root.requireFormat("spindrift-scenario", 1);
  Scenario s;
  s.name = root.at("name").name();
  if (const auto seed = root.find("seed")) {
    const int value = seed->integer();
    if (value < 0) seed->reject("a whole number from 0");
    s.seed = static_cast<std::uint64_t>(value);
  }
  s.start_utc = root.stringOr("start_utc", s.start_utc);
  const JsonNode duration = root.at("duration_s");
  s.duration_s = duration.positiveNumber();
  if (s.duration_s > 60.0 * 86400.0) duration.reject("at most 60 days");
  if (const auto period = root.find("log_period_s")) {
    s.log_period_s = period->positiveNumber();
    if (s.log_period_s > s.duration_s) period->reject("at most the duration");
    if (s.duration_s / s.log_period_s > most_log_rows) {
      period->reject(fmt::format("a period that makes at most {:.0f} rows of the duration", most_log_rows));
    }
  }
  const JsonNode machine = root.at("machine");
  s.machine = machine.value().is_string() ? MachineDescription::read(file.parent_path() / machine.string())
                                          : MachineDescription::parse(machine, file);
  if (const auto programme = root.find("programme")) {
    if (const auto segments = programme->find("segments")) {
      s.programme = parseSegments(*segments);
    } else {
      s.random_programme = parseRandom(programme->at("random"));
    }
  }
  s.random_programme.duration_s = s.duration_s;
  if (const auto environment = root.find("environment")) s.environment = parseEnvironment(*environment);
  if (const auto physics = root.find("physics")) s.physics = parsePhysics(*physics);
  if (const auto effects = root.find("effects")) {
    for (const auto& [id, node] : effects->members()) {
      if (id == "convection.speed") {
        s.physics.convection_speed = node.booleanOr("on", true) ? nonNegative(node, "size", 1.0) : 0.0;
      } else if (id == "dynamics.second_lag") {
        s.physics.spindle_mass *= node.booleanOr("on", true) ? positive(node, "size", 1.0) : 0.1;
      } else {
        s.effects[id] = parseEffect(id, node, s.machine);
      }
    }
  }
  if (const auto simulation = root.find("simulation")) {
    BaseSimulationOptions base;
    const JsonNode list = simulation->at("effects");
    for (const JsonNode& item : list.items()) {
      base.effects.push_back(item.name());
      if (s.effects.find(base.effects.back()) == s.effects.end()) item.reject("an effect of this scenario");
    }
    base.parameter_error = partOf(*simulation, "parameter_error", base.parameter_error);
    base.gain_uncertainty = nonNegative(*simulation, "gain_uncertainty", base.gain_uncertainty);
    base.missing_rows = partOf(*simulation, "missing_rows", base.missing_rows);
    if (const auto errors = simulation->find("size_errors")) {
      for (const auto& [id, node] : errors->members()) {
        if (std::find(base.effects.begin(), base.effects.end(), id) == base.effects.end()) {
          node.reject("an error of an effect of the simulation");
        }
        base.size_errors[id] = node.number();
      }
    }
    s.simulation = base;
  }
  if (const auto node = root.find("measurement")) s.measurement = parseMeasurement(*node, s.machine, s.duration_s);
  if (const auto node = root.find("instrument")) s.instrument = parseInstrument(*node);
  if (const auto node = root.find("touches")) s.touches = parseTouches(*node, s.machine, s.duration_s);
  if (const auto node = root.find("microscope")) {
    s.microscope = parseMicroscope(*node, s.machine, parseTimes(*node, "states", s.duration_s), file.parent_path());
  }
  if (const auto node = root.find("profiler")) {
    s.profiler = parseProfiler(*node, s.machine, parseTimes(*node, "cycles", s.duration_s));
  }
  s.sensors = root.has("sensors") ? parseSensors(root.at("sensors")) : standardSensors(s.machine);
  if (const auto log = root.find("log")) {
    if (const auto omit = log->find("omit")) {
      for (const std::string& name : words(*omit)) s.omitted_signals.insert(name);
    }
  }
  const bool wants_strength =
      std::any_of(s.effects.begin(), s.effects.end(), [](const auto& e) { return e.second.strength.has_value(); });
  if (wants_strength && !s.measurement) {
    throw InputError(root.place(), "an effect with a strength needs a measurement; give its size instead.");
  }
  if (s.simulation && !s.measurement) {
    throw InputError(root.place(), "a simulation table needs a measurement to predict; give a measurement.");
  }
  return s;
}

}  // namespace spindrift
