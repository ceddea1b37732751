// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/study_campaigns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace spindrift {
namespace {

enum class Family { Vertical, Gantry, Horizontal, FiveAxis };

double roundedTo(double value, double step) {
  return std::round(value / step) * step;
}

nlohmann::json axisJson(Random& random, const char* name, double travel, bool linear_scale) {
  const double bearing = random.uniform() < 0.5 ? 0.0 : travel;
  return {{"name", name},
          {"travel_mm", {0.0, travel}},
          {"drive",
           {{"type", "ball_screw"}, {"pitch_mm", random.uniform() < 0.5 ? 10 : 12}, {"fixed_bearing_mm", bearing}}},
          {"scale", linear_scale ? "linear_scale" : "rotary_encoder"},
          {"datum_mm", 0.0}};
}

MachineDescription randomMachine(Random& random, Family family, bool scale_on_z) {
  const double x = roundedTo(random.uniform(400.0, 700.0), 10.0);
  const double y = roundedTo(random.uniform(350.0, 550.0), 10.0);
  const double z = roundedTo(random.uniform(260.0, 500.0), 10.0);
  nlohmann::json json{{"format", "spindrift-machine"}, {"version", 1}, {"spindle", {{"axis", "Z"}, {"max_rpm", 6000}}}};
  const bool scales = family == Family::Gantry || family == Family::Horizontal;
  json["axes"] = {axisJson(random, "X", x, scales), axisJson(random, "Y", y, false),
                  axisJson(random, "Z", z, scale_on_z)};
  json["table"] = {{"centre_mm", {0.5 * x, 0.5 * y}}};
  switch (family) {
    case Family::Vertical:
      json["name"] = "vertical machining centre";
      json["chain"] = "V [w-X'-Y'-b-Z-t]";
      json["column"] = {{"base_mm", -roundedTo(random.uniform(100.0, 250.0), 10.0)}};
      break;
    case Family::Gantry:
      json["name"] = "gantry milling machine";
      json["chain"] = "V [w-X'-b-Y-Z-t]";
      json["crossbeam"] = {{"axis", "Y"}, {"from_mm", -40.0}, {"to_mm", y + 40.0}};
      break;
    case Family::Horizontal:
      json["name"] = "horizontal machining centre";
      json["chain"] = "H [w-Z'-b-X-Y-(C)-t]";
      break;
    case Family::FiveAxis:
      json["name"] = "five-axis machining centre";
      json["chain"] = "V [w-C2'-A'-X'-b-Y-Z-C1-t]";
      json["rotary"] = {{{"name", "C2"}, {"centre_mm", {0.5 * x, 0.5 * y, 0.0}}}};
      json["artefacts"] = {{{"id", "bar"},
                            {"kind", "hole_bar"},
                            {"nominal_positions_mm", {0, 42, 97, 141, 206, 259, 320}},
                            {"reference_hole", "H1"},
                            {"reference_in_table_mm", {-0.4 * x, 0.0, 0.0}},
                            {"direction_at_c0", {1, 0, 0}},
                            {"expansion_um_per_m_K", 11.5},
                            {"hole_diameter_mm", 10.0}}};
      break;
  }
  // Four in the corners of the table, the others spread over the volume.
  constexpr double places[10][3] = {{0.08, 0.11, 0.0},  {0.91, 0.12, 0.02}, {0.88, 0.90, 0.0},  {0.10, 0.88, 0.02},
                                    {0.34, 0.31, 0.30}, {0.69, 0.32, 0.45}, {0.31, 0.67, 0.70}, {0.70, 0.68, 0.55},
                                    {0.49, 0.48, 0.95}, {0.53, 0.51, 0.05}};
  json["points"] = nlohmann::json::array();
  for (std::size_t i = 0; i < 10; ++i) {
    json["points"].push_back({{"id", fmt::format("F{}", i + 1)},
                              {"kind", "fiducial"},
                              {"x_mm", roundedTo(places[i][0] * x + random.uniform(-12.0, 12.0), 0.1)},
                              {"y_mm", roundedTo(places[i][1] * y + random.uniform(-12.0, 12.0), 0.1)},
                              {"z_mm", roundedTo(places[i][2] * z, 0.1)}});
  }
  return MachineDescription::parse(JsonNode::parse(json.dump(), "machine.json"), "machine.json");
}

/// Families that can have an effect.
std::vector<Family> familiesOf(const std::string& id) {
  const auto starts = [&](std::string_view stem) { return id.starts_with(stem); };
  if (starts("rotary.") || starts("artefact.")) return {Family::FiveAxis};
  if (starts("column.") || id == "external_heat.a" || id == "external_heat.b") return {Family::Vertical};
  if (starts("crossbeam.")) return {Family::Gantry};
  if (id == "scale.expansion.z") return {Family::Horizontal};
  if (starts("scale.")) return {Family::Gantry, Family::Horizontal};
  if (id == "ball_screw.expansion.x" || id == "ball_screw.nonuniform.x" || id == "ball_screw.nonuniform.z" ||
      id == "ball_screw.expansion.z") {
    return {Family::Vertical, Family::FiveAxis};
  }
  if (starts("head.")) return {Family::Gantry};
  return {Family::Vertical, Family::Gantry, Family::Horizontal, Family::FiveAxis};
}

/// Details of a hidden cause that differ from campaign to campaign.
PlantEffectSetting randomSetting(Random& random, const std::string& id, double duration_s,
                                 const MachineDescription& machine) {
  PlantEffectSetting s;
  if (random.uniform() < 0.5 && !id.starts_with("table.") && !id.starts_with("ball_screw.")) s.size = -1.0;
  if (id.starts_with("fixture.slip.")) {
    s.parameters["time_s"] = random.uniform(0.2, 0.6) * duration_s;
    for (const char* name : {"step_x_um", "step_y_um", "step_z_um"}) s.parameters[name] = random.uniform(-4.0, 4.0);
  } else if (id.starts_with("external_heat.")) {
    s.parameters["onset_s"] = random.uniform(0.15, 0.45) * duration_s;
    s.parameters["length_s"] = random.uniform(0.15, 0.35) * duration_s;
  } else if (id.starts_with("frame.") || id.starts_with("squareness.")) {
    const char* drivers[] = {"room", "column", "spindle"};
    s.driver = drivers[random.index(3)];
    s.parameters["origin_x_mm"] = random.uniform(0.0, machine.axes[0].travel_mm[1]);
    s.parameters["origin_y_mm"] = random.uniform(0.0, machine.axes[1].travel_mm[1]);
  } else if (id.starts_with("head.")) {
    // The position enters only through an axis between pivot and tool: Z as a ram, never as the table's axis.
    s.parameters["ram"] = machine.chain.movesTool("Z") && random.uniform() < 0.7 ? 1.0 : 0.0;
    s.parameters["lever_z_mm"] = -random.uniform(300.0, 600.0);
    s.parameters["lever_y_mm"] = -random.uniform(80.0, 280.0);
    s.parameters["lever_x_mm"] = random.uniform(40.0, 160.0);
  } else if (id.starts_with("periodic.")) {
    s.parameters["phase_rad"] = random.uniform(0.0, 2.0 * std::numbers::pi);
  } else if (id == "unknown.hydraulics") {
    s.parameters["period_s"] = random.uniform(1700.0, 4200.0);
  }
  return s;
}

bool sameCause(const std::string& a, const std::string& b) {
  const auto pair = [&](std::string_view x, std::string_view y) { return (a == x && b == y) || (a == y && b == x); };
  return a == b || pair("rotary.expansion.r0t", "table.expansion.xy");
}

}  // namespace

std::string_view toString(StudyKind kind) noexcept {
  switch (kind) {
    case StudyKind::One:
      return "one";
    case StudyKind::Two:
      return "two";
    case StudyKind::Nothing:
      return "nothing";
    case StudyKind::Outside:
      return "outside";
    case StudyKind::Confounded:
      return "confounded";
  }
  return "";
}

const std::vector<std::string>& studyEffects() {
  static const std::vector<std::string> ids{"spindle.growth.z",
                                            "column.bending.a",
                                            "ball_screw.expansion.x",
                                            "table.expansion.xy",
                                            "frame.rotation.a",
                                            "crossbeam.sag.z",
                                            "ambient.drift.x",
                                            "instrument.warm_up.y",
                                            "fixture.slip",
                                            "periodic.pitch.x",
                                            "backlash.y",
                                            "coolant.shock.x",
                                            "external_heat.a",
                                            "rotary.drift.x0c",
                                            "head.tilt.a",
                                            "spindle.drift.x",
                                            "column.expansion.z",
                                            "scale.expansion.x",
                                            "squareness.drift.c0y",
                                            "heat_source.position.y",
                                            "ball_screw.nonuniform.y",
                                            "spindle.centrifugal.z",
                                            "ball_screw.expansion.y",
                                            "frame.rotation.b",
                                            "ambient.drift.y",
                                            "instrument.warm_up.z",
                                            "rotary.tilt.a0c",
                                            "coolant.shock.z",
                                            "backlash.x",
                                            "external_heat.z",
                                            "column.bending.b",
                                            "artefact.expansion",
                                            "spindle.drift.y",
                                            "frame.rotation.c",
                                            "ball_screw.expansion.z",
                                            "rotary.drift.z0t",
                                            "ambient.drift.z",
                                            "instrument.warm_up.x",
                                            "periodic.pitch.y",
                                            "head.tilt.b",
                                            "external_heat.b",
                                            "rotary.drift.y0c",
                                            "coolant.shock.y",
                                            "backlash.z",
                                            "scale.expansion.z",
                                            "rotary.tilt.c0c",
                                            "ball_screw.nonuniform.x",
                                            "heat_source.position.z",
                                            "rotary.expansion.r0t",
                                            "periodic.pitch.z",
                                            "rotary.tilt.b0c",
                                            "heat_source.position.x",
                                            "ball_screw.nonuniform.z"};
  return ids;
}

StudyCase studyCase(const StudyOptions& options, std::uint64_t seed) {
  Random random(seed * 0x9e3779b97f4a7c15ULL + 0x51u);
  StudyCase result;
  Scenario& s = result.scenario;
  std::vector<std::string> hidden;
  const auto& ids = studyEffects();
  if (options.kind == StudyKind::One || options.kind == StudyKind::Two)
    hidden.push_back(ids[options.turn % ids.size()]);
  if (options.kind == StudyKind::Outside) {
    const auto outside = causesOutsideCatalogue();
    hidden.push_back(outside[options.turn % outside.size()]);
  }
  if (options.kind == StudyKind::Confounded) {
    const char* which[] = {"column.bending.a", "coolant.shock.x",        "ambient.drift.x",
                           "spindle.growth.z", "ball_screw.expansion.y", "instrument.warm_up.y"};
    hidden.emplace_back(which[options.turn % 6]);
  }
  const std::vector<Family> families = hidden.empty() ? familiesOf("") : familiesOf(hidden.front());
  const Family family = families[random.index(families.size())];
  const bool scale_on_z = !hidden.empty() && hidden.front() == "scale.expansion.z";
  s.machine = randomMachine(random, family, scale_on_z);
  s.name = s.machine.name;
  s.seed = seed;
  for (std::string& id : hidden) {
    if (id == "fixture.slip") id = "fixture.slip." + s.machine.points[random.index(s.machine.points.size())].id;
  }
  const std::vector<std::string> possible = catalogueOf(s.machine);
  const auto canHave = [&](const std::string& id) {
    return std::find(possible.begin(), possible.end(), id) != possible.end();
  };
  if (options.kind == StudyKind::Two) {
    // A partner that moves something else: another family, and not a refinement.
    for (int attempt = 0; attempt < 200 && hidden.size() < 2; ++attempt) {
      std::string other = ids[random.index(ids.size())];
      if (other == "fixture.slip" || !canHave(other) || other.starts_with("ball_screw.nonuniform")) continue;
      const auto stem = [](const std::string& id) { return id.substr(0, id.find('.')); };
      if (stem(other) == stem(hidden.front())) continue;
      // A head that tilts about a pivot anywhere contains drift and growth of the same heat: two causes, one signature.
      const auto pairOf = [&](const char* a, const char* b) {
        return (stem(other) == a && stem(hidden.front()) == b) || (stem(other) == b && stem(hidden.front()) == a);
      };
      if (pairOf("head", "spindle")) continue;
      // The programme of a screw that works at one place all day moves no source of heat.
      if (hidden.front().starts_with("ball_screw.nonuniform") && stem(other) == "heat_source") continue;
      hidden.push_back(other);
    }
  }

  // The given simulation: three causes that every machine has, 5 to 12 sigma large.
  std::vector<std::string> base;
  const auto addBase = [&](const std::string& id) {
    const bool taken = std::any_of(hidden.begin(), hidden.end(), [&](const auto& h) { return sameCause(h, id); }) ||
                       std::find(base.begin(), base.end(), id) != base.end();
    if (!taken && canHave(id)) base.push_back(id);
  };
  for (const std::string& id : hidden) {
    if (id.starts_with("ball_screw.nonuniform.")) addBase("ball_screw.expansion." + id.substr(22));
  }
  const std::string usual[] = {"ball_screw.expansion.x", "ball_screw.expansion.y", "ball_screw.expansion.z",
                               "scale.expansion.x",      "spindle.growth.z",       "spindle.drift.y"};
  for (int attempt = 0; attempt < 50 && base.size() < 3; ++attempt) addBase(usual[random.index(6)]);

  InstrumentOptions& instrument = s.instrument;
  instrument.sigma_um = random.uniform(0.35, 0.8);
  instrument.sigma_urad = random.uniform(1.0, 2.5);
  instrument.ar1 = options.ar1;
  EnvironmentOptions& room = s.environment;
  room.temperature_degC = random.uniform(19.0, 22.0);
  room.day_amplitude_K = random.uniform(0.8, 2.5);
  room.day_phase_h = random.uniform(-3.0, 3.0);
  room.weather_K = random.uniform(0.2, 0.6);
  room.random_doors = static_cast<int>(random.index(4));
  for (double* value : {&s.physics.friction, &s.physics.screw_friction, &s.physics.convection, &s.physics.spindle_mass,
                        &s.physics.structure_mass, &s.physics.screw_mass}) {
    *value = random.uniform(0.75, 1.3);
  }
  s.random_programme.duration_s = s.duration_s;
  s.random_programme.mean_hold_s = random.uniform(2000.0, 4000.0);
  for (const std::string& id : hidden) {
    if (!id.starts_with("ball_screw.nonuniform")) continue;
    // The same part of the screw works all day, nearer to one end than to the other.
    const double place = random.uniform(0.12, 0.28);
    s.random_programme.places = {random.uniform() < 0.5 ? place : 1.0 - place};
    s.random_programme.stroke_part = 0.35;
  }
  for (const std::string& id : base) {
    ScenarioEffect effect;
    effect.strength = random.uniform(5.0, 12.0);
    s.effects[id] = effect;
  }
  for (const std::string& id : hidden) {
    ScenarioEffect effect;
    effect.setting = randomSetting(random, id, s.duration_s, s.machine);
    // A turn that follows the room, about a free origin, and a drift that follows it: two causes, one signature.
    const bool drifts =
        std::any_of(hidden.begin(), hidden.end(), [](const auto& h) { return h.starts_with("ambient."); });
    if (drifts && effect.setting.driver == "room") effect.setting.driver = "column";
    effect.strength = options.strength;
    s.effects[id] = effect;
  }
  s.simulation = BaseSimulationOptions{};
  s.simulation->effects = base;
  s.simulation->parameter_error = options.parameter_error;
  MeasurementOptions plan;
  for (int i = 0; i < 36; ++i) plan.times_s.push_back(1200.0 * i);
  for (int i = 26; i < 36; ++i) plan.holdout.insert(fmt::format("M{}", i));
  const bool rotations =
      std::any_of(hidden.begin(), hidden.end(), [](const auto& id) { return id.starts_with("head."); });
  if (rotations || random.uniform() < 0.15) {
    plan.components.insert(plan.components.end(), {Component::EA, Component::EB, Component::EC});
  }
  if (family == Family::FiveAxis && random.uniform() < 0.5) plan.c_deg = {0.0, 90.0, 180.0, 270.0};
  s.measurement = plan;
  s.sensors = standardSensors(s.machine);
  for (SensorOptions& sensor : s.sensors) sensor.noise_K = 0.05;
  for (const std::string& id : hidden) {
    const auto add = [&](const char* name, const char* place) {
      SensorOptions sensor;
      sensor.name = name;
      sensor.place = place;
      s.sensors.push_back(sensor);
    };
    if (id == "artefact.expansion") add("T_artefact_degC", "artefact");
    if (id == "crossbeam.sag.z") add("T_beam_degC", "crossbeam top");
  }
  if (options.kind == StudyKind::Confounded) {
    const std::string& id = hidden.front();
    if (id == "column.bending.a") s.omitted_signals = {"T_column_front_degC", "T_column_rear_degC"};
    if (id == "coolant.shock.x") s.omitted_signals = {"coolant"};
    if (id == "ambient.drift.x") s.omitted_signals = {"T_ambient_degC"};
    if (id == "spindle.growth.z") s.omitted_signals = {"spindle_rpm", "T_spindle_degC", "T_housing_degC"};
    if (id == "ball_screw.expansion.y") s.omitted_signals = {"feed_y_mm_min"};
    if (id == "instrument.warm_up.y") s.omitted_signals = {"instrument_on"};
  }
  result.hidden = hidden;
  return result;
}

}  // namespace spindrift
