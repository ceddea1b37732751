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

/// Spindle minus column along Y, 0 for a column that carries no overhanging head; stated in machine.json or not.
struct Overhang {
  double y_mm = 0.0;
  bool stated = false;
};

MachineDescription randomMachine(Random& random, Family family, bool scale_on_z, const Overhang& overhang) {
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
      if (overhang.stated) json["column"]["overhang_mm"] = {0.0, overhang.y_mm};
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
    s.parameters["length_s"] = random.uniform(0.12, 0.25) * duration_s;
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

std::string familyOf(const std::string& id) {
  return id.substr(0, id.find('.'));
}

/// Two causes that leave one signature, at least for some drivers and origins (EFFECTS.md): not hidden together.
bool alike(const std::string& a, const std::string& b) {
  const auto either = [&](const auto& test) { return test(a, b) || test(b, a); };
  const auto starts = [](const std::string& id, std::string_view stem) { return id.starts_with(stem); };
  return a == b || either([&](const std::string& x, const std::string& y) {
           // A head that tilts about a pivot anywhere contains drift and growth of the same heat.
           if (starts(x, "head.") && starts(y, "spindle.")) return true;
           if (x == "rotary.expansion.r0t" && (starts(y, "table.") || starts(y, "artefact."))) return true;
           if (starts(x, "table.") && starts(y, "artefact.")) return true;
           if (x == "column.expansion.z" && (y == "spindle.growth.z" || y == "ambient.drift.z" ||
                                             y == "scale.expansion.z" || y == "spindle.centrifugal.z")) {
             return true;
           }
           if (starts(x, "scale.") && starts(y, "ambient.") && x.back() == y.back()) return true;
           // Rotation about Z and squareness need a plane of their own each.
           return starts(x, "squareness.") && y == "frame.rotation.c";
         });
}

/// What the campaign of a seed is, before anything is hidden in it.
struct Draw {
  Family family = Family::Vertical;
  Overhang overhang;
  bool rotations = false;  ///< EA, EB, EC are measured
  bool one_place = false;  ///< the work stays at one place all day
  bool turns = false;      ///< the table stands at four angles
  Scenario scenario;       ///< without effects
  std::vector<std::string> hideable;
};

/// Streams of random numbers of one campaign.
enum class DrawStream : std::uint64_t { Machine = 1, Room, Plan, Base, Hidden };

Random streamOf(std::uint64_t seed, DrawStream stream) {
  Random random(seed * 0x9e3779b97f4a7c15ULL + 0x5100u + static_cast<std::uint64_t>(stream));
  return random.split();
}

Draw drawCampaign(std::uint64_t seed) {
  Draw draw;
  Scenario& s = draw.scenario;
  Random random = streamOf(seed, DrawStream::Machine);
  draw.family = static_cast<Family>(random.index(4));
  const bool scale_on_z = random.uniform() < 0.5 && draw.family == Family::Horizontal;
  const double overhang_mm = -roundedTo(random.uniform(250.0, 450.0), 10.0);
  const double overhangs = random.uniform();
  if (draw.family == Family::Vertical && overhangs < 0.5) draw.overhang = {overhang_mm, overhangs < 0.25};
  s.machine = randomMachine(random, draw.family, scale_on_z, draw.overhang);
  s.name = s.machine.name;
  s.seed = seed;

  random = streamOf(seed, DrawStream::Room);
  s.instrument.sigma_um = random.uniform(0.35, 0.8);
  s.instrument.sigma_urad = random.uniform(1.0, 2.5);
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
  draw.one_place = random.uniform() < 0.25;
  const double place = random.uniform(0.12, 0.28);
  const bool far_end = random.uniform() < 0.5;
  if (draw.one_place) {
    // The same part of the screws works all day, nearer to one end than to the other.
    s.random_programme.places = {far_end ? 1.0 - place : place};
    s.random_programme.stroke_part = 0.35;
  }

  random = streamOf(seed, DrawStream::Plan);
  MeasurementOptions plan;
  for (int i = 0; i < 36; ++i) plan.times_s.push_back(1200.0 * i);
  for (int i = 26; i < 36; ++i) plan.holdout.insert(fmt::format("M{}", i));
  draw.rotations = random.uniform() < 0.3;
  draw.turns = random.uniform() < 0.5 && draw.family == Family::FiveAxis;
  if (draw.rotations) {
    plan.components.insert(plan.components.end(), {Component::EA, Component::EB, Component::EC});
  }
  if (draw.turns) plan.c_deg = {0.0, 90.0, 180.0, 270.0};
  s.measurement = plan;
  s.sensors = standardSensors(s.machine);
  const auto add = [&](const char* name, const char* where) {
    SensorOptions sensor;
    sensor.name = name;
    sensor.place = where;
    s.sensors.push_back(sensor);
  };
  if (draw.family == Family::Gantry) add("T_beam_degC", "crossbeam top");
  if (draw.family == Family::FiveAxis) add("T_artefact_degC", "artefact");
  for (SensorOptions& sensor : s.sensors) sensor.noise_K = 0.05;

  const std::vector<std::string> possible = catalogueOf(s.machine);
  for (const std::string& id : studyEffects()) {
    const bool can = id == "fixture.slip" || std::find(possible.begin(), possible.end(), id) != possible.end();
    if (!can) continue;
    // A head that tilts is a drift and a growth unless its turn is measured.
    const bool tool_on_column = draw.family == Family::Vertical || draw.family == Family::Gantry;
    if (id.starts_with("head.") && !(draw.rotations && tool_on_column)) continue;
    if (id.starts_with("ball_screw.nonuniform.") && !draw.one_place) continue;
    if (id.starts_with("heat_source.") && draw.one_place) continue;
    draw.hideable.push_back(id);
  }
  return draw;
}

std::vector<std::string> chooseHidden(const Draw& draw, const StudyOptions& options, Random& random) {
  if (!options.hide.empty()) return options.hide;
  const std::vector<std::string>& ids = draw.hideable;
  std::vector<std::string> hidden;
  switch (options.kind) {
    case StudyKind::Nothing:
      break;
    case StudyKind::Outside: {
      const auto outside = causesOutsideCatalogue();
      hidden.push_back(outside[options.turn % outside.size()]);
      break;
    }
    case StudyKind::Confounded: {
      std::vector<std::string> which;
      for (const char* id : {"column.bending.a", "coolant.shock.x", "ambient.drift.x", "spindle.growth.z",
                             "ball_screw.expansion.y", "instrument.warm_up.y"}) {
        if (std::find(ids.begin(), ids.end(), id) != ids.end()) which.emplace_back(id);
      }
      hidden.push_back(which[options.turn % which.size()]);
      break;
    }
    case StudyKind::One:
    case StudyKind::Two:
    case StudyKind::Three: {
      hidden.push_back(ids[options.turn % ids.size()]);
      const std::size_t count = options.kind == StudyKind::One ? 1 : options.kind == StudyKind::Two ? 2 : 3;
      // The others move something else: another family, and not a refinement.
      for (int attempt = 0; attempt < 1000 && hidden.size() < count; ++attempt) {
        const std::string& other = ids[random.index(ids.size())];
        if (other == "fixture.slip" || other.starts_with("ball_screw.nonuniform")) continue;
        const bool taken = std::any_of(hidden.begin(), hidden.end(), [&](const std::string& h) {
          return familyOf(h) == familyOf(other) || alike(h, other);
        });
        if (!taken) hidden.push_back(other);
      }
      break;
    }
  }
  return hidden;
}

/// The given simulation: three causes that every machine has.
std::vector<std::string> chooseBase(const Draw& draw, const std::vector<std::string>& hidden, Random& random) {
  std::vector<std::string> base;
  const std::vector<std::string> possible = catalogueOf(draw.scenario.machine);
  const auto add = [&](const std::string& id) {
    const bool taken = std::find(hidden.begin(), hidden.end(), id) != hidden.end() ||
                       std::find(base.begin(), base.end(), id) != base.end();
    if (!taken && std::find(possible.begin(), possible.end(), id) != possible.end()) base.push_back(id);
  };
  for (const std::string& id : hidden) {
    if (id.starts_with("ball_screw.nonuniform.")) add("ball_screw.expansion." + id.substr(22));
  }
  std::vector<std::string> usual{"ball_screw.expansion.x", "ball_screw.expansion.y", "ball_screw.expansion.z",
                                 "scale.expansion.x",      "spindle.growth.z",       "spindle.drift.y"};
  for (std::size_t i = usual.size(); i > 1; --i) std::swap(usual[i - 1], usual[random.index(i)]);
  for (const std::string& id : usual) {
    if (base.size() < 3) add(id);
  }
  return base;
}

}  // namespace

std::string_view toString(StudyKind kind) noexcept {
  switch (kind) {
    case StudyKind::One:
      return "one";
    case StudyKind::Two:
      return "two";
    case StudyKind::Three:
      return "three";
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

std::vector<std::string> hideable(std::uint64_t seed) {
  return drawCampaign(seed).hideable;
}

StudyCase studyCase(const StudyOptions& options, std::uint64_t seed) {
  Draw draw = drawCampaign(seed);
  StudyCase result;
  result.conditions = options.conditions;
  result.strength = options.strength;
  result.ar1 = options.ar1;
  result.scenario = draw.scenario;
  Scenario& s = result.scenario;
  Random hidden_random = streamOf(seed, DrawStream::Hidden);
  Random base_random = streamOf(seed, DrawStream::Base);
  const bool one_base_off = options.conditions.one_base_error != 0.0;
  if (!one_base_off) result.hidden = chooseHidden(draw, options, hidden_random);
  for (std::string& id : result.hidden) {
    if (id == "fixture.slip") id = "fixture.slip." + s.machine.points[hidden_random.index(s.machine.points.size())].id;
  }

  s.simulation = BaseSimulationOptions{};
  s.simulation->parameter_error = options.parameter_error;
  s.simulation->effects = chooseBase(draw, result.hidden, base_random);
  for (const std::string& id : s.simulation->effects) {
    s.effects[id].strength = base_random.uniform(5.0, 12.0);
    const double error = base_random.normal(0.0, 1.0);
    if (options.conditions.base_error > 0.0) s.simulation->size_errors[id] = options.conditions.base_error * error;
  }
  if (one_base_off) {
    const std::string id = s.simulation->effects[options.turn % s.simulation->effects.size()];
    result.hidden = {id};
    const double error = options.conditions.one_base_error;
    s.simulation->size_errors[id] = base_random.uniform() < 0.5 ? -error : error;
    s.effects[id].strength = options.strength / error;  // what the simulation lacks has the strength
  } else {
    const bool drifts = std::any_of(result.hidden.begin(), result.hidden.end(),
                                    [](const auto& h) { return h.starts_with("ambient."); });
    for (const std::string& id : result.hidden) {
      ScenarioEffect effect;
      effect.setting = randomSetting(hidden_random, id, s.duration_s, s.machine);
      // A turn that follows the room, about a free origin, and a drift that follows it: two causes, one signature.
      if (drifts && effect.setting.driver == "room") effect.setting.driver = "column";
      effect.strength = options.strength;
      if (options.kind == StudyKind::Three) *effect.strength *= hidden_random.uniform(0.8, 1.2);
      s.effects[id] = effect;
    }
  }
  for (auto& [id, effect] : s.effects) {
    if (id.starts_with("column.bending.") || id == "external_heat.a" || id == "external_heat.b") {
      effect.setting.parameters["overhang_y_mm"] = draw.overhang.y_mm;
    }
  }
  if (options.kind == StudyKind::Confounded) {
    const std::string& id = result.hidden.front();
    if (id == "column.bending.a") s.omitted_signals = {"T_column_front_degC", "T_column_rear_degC"};
    if (id == "coolant.shock.x") s.omitted_signals = {"coolant"};
    if (id == "ambient.drift.x") s.omitted_signals = {"T_ambient_degC"};
    if (id == "spindle.growth.z") s.omitted_signals = {"spindle_rpm", "T_spindle_degC", "T_housing_degC"};
    if (id == "ball_screw.expansion.y") s.omitted_signals = {"feed_y_mm_min"};
    if (id == "instrument.warm_up.y") s.omitted_signals = {"instrument_on"};
  }
  prepare(s, options.conditions, seed);
  return result;
}

StudyCampaign simulateStudy(const StudyCase& made, const JobContext& job) {
  StudyCampaign result;
  result.campaign = simulateCampaign(made.scenario, {}, job);
  CampaignTruth& truth = result.campaign.truth;
  for (const std::string& id : made.hidden) {
    if (std::find(truth.base.begin(), truth.base.end(), id) == truth.base.end()) continue;
    // The simulation has this effect, too much or too little of it: what it lacks is what is hidden.
    const double lacks = -made.scenario.simulation->size_errors.at(id);
    const std::vector<double>& signal = truth.signals.at(id);
    for (std::size_t i = 0; i < signal.size(); ++i) {
      truth.hidden_signal[i] += lacks * signal[i];
      truth.base_error[i] -= lacks * signal[i];
    }
    truth.hidden.push_back(id);
  }
  result.applied = applyConditions(result.campaign, made.conditions, made.strength, made.ar1, made.scenario.seed);
  return result;
}

}  // namespace spindrift
