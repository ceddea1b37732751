// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/c_frame_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

struct Parameter {
  const char* name;
  double value;
  const char* unit;
  double standard_uncertainty;
  double off_uncertainty;  ///< a size that it may well have where it is switched off
  double min;
  double max;  ///< NaN: the end of the campaign, which is then its value too if that is NaN
  const char* what;
  std::vector<std::string> effects;
};

const std::vector<Parameter>& parameterTable() {
  constexpr double end = std::numeric_limits<double>::quiet_NaN();
  static const std::vector<Parameter> table{
      {"h_air", 9.0, "W/m2/K", 1.0, 1.0, 2.0, 30.0, "film on the free faces", {}},
      {"h_inside", 2.5, "W/m2/K", 1.0, 1.0, 0.0, 12.0, "film in the hollows of the castings", {}},
      {"k_iron", 48.0, "W/m/K", 3.0, 3.0, 30.0, 65.0, "conductivity of grey iron", {}},
      {"cp_iron", 500.0, "J/kg/K", 20.0, 20.0, 400.0, 620.0, "heat capacity of grey iron", {}},
      {"alpha_iron", 10.8, "um/m/K", 0.3, 0.3, 8.0, 14.0, "expansion of grey iron", {}},
      {"alpha_steel", 11.6, "um/m/K", 0.3, 0.3, 9.0, 14.0, "expansion of the spindle's steel", {}},
      {"friction",
       1.6,
       "kW/m3 at 1000 rpm",
       0.15,
       1.5,
       0.0,
       20.0,
       "friction heat in the spindle's bearings, grows with speed^1.5",
       {"spindle.growth.z", "spindle.drift.y", "head.tilt.a"}},
      {"motor",
       0.0,
       "kW/m3 at 1000 rpm",
       0.5,
       2.0,
       0.0,
       40.0,
       "loss of the spindle's motor, grows with speed",
       {"head.tilt.a", "spindle.drift.y", "column.bending.a"}},
      {"room_gain",
       1.0,
       "1",
       0.05,
       1.0,
       0.0,
       2.0,
       "share of the room's change that reaches the machine",
       {"ambient.drift.x", "ambient.drift.y", "ambient.drift.z", "column.expansion.z", "frame.rotation.a"}},
      {"sun_front",
       0.0,
       "W/m2",
       10.0,
       60.0,
       0.0,
       600.0,
       "heat that the column's front takes up from the sun",
       {"external_heat.a", "external_heat.z", "column.bending.a"}},
      {"sun_on_s", 0.0, "s", 3600.0, 3600.0, 0.0, end, "begin of the sun", {}},
      {"sun_off_s", end, "s", 3600.0, 3600.0, 0.0, end, "end of the sun", {}},
      {"h_coolant",
       0.0,
       "W/m2/K",
       20.0,
       150.0,
       0.0,
       2000.0,
       "film of the coolant on the table while it runs",
       {"table.expansion.xy", "coolant.shock.x", "coolant.shock.y", "coolant.shock.z"}},
      {"coolant_K", -2.5, "K", 0.5, 0.5, -15.0, 15.0, "coolant minus start temperature", {}},
  };
  return table;
}

constexpr const char* inner_film = "h_inside";
constexpr const char* outer_film = "h_air";

std::string materialsOf(bool heat) {
  std::string text;
  const auto add = [&](const char* name, const char* conductivity, const char* capacity, const char* density,
                       const char* elastic, const char* expansion) {
    text += fmt::format("*MATERIAL, NAME={}\n", name);
    if (heat) {
      text += fmt::format("*CONDUCTIVITY\n{}\n*SPECIFIC HEAT\n{}\n*DENSITY\n{}\n", conductivity, capacity, density);
    } else {
      text += fmt::format("*ELASTIC\n{}\n*EXPANSION, ZERO=0.\n{}\n", elastic, expansion);
    }
    text += fmt::format("*SOLID SECTION, ELSET={0}, MATERIAL={0}\n", name);
  };
  add("IRON", "{{k_iron}}", "{{cp_iron*1e6}}", "7.2e-9", "1.2e5, 0.26", "{{alpha_iron*1e-6}}");
  add("STEEL", "46.", "4.7e8", "7.85e-9", "2.1e5, 0.29", "{{alpha_steel*1e-6}}");
  return text;
}

std::string headOf(const char* what, bool heat) {
  return fmt::format(
      "** C-frame machining centre: {}\n** units mm, t, s, N, MPa, mW, K; temperatures count from the start of the "
      "campaign\n*INCLUDE, INPUT=mesh.inp\n{}*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0.\n",
      what, materialsOf(heat));
}

std::string heatTemplate(const CFrameDeckOptions& options, const CFrameMachine& machine) {
  std::string text = headOf("temperatures", true);
  for (const char* table : {"ROOM", "FRICTION", "MOTOR", "SUN", "COOLANT"}) {
    text += fmt::format("*AMPLITUDE, NAME={0}, TIME=TOTAL TIME\n{{{{table:{0}}}}}\n", table);
  }
  const std::string step =
      fmt::format("*STEP, INC={}\n*HEAT TRANSFER, DIRECT, SOLVER=ITERATIVE CHOLESKY\n{:.10g}, {:.10g}\n",
                  10 + static_cast<int>(options.state_interval_s / options.increment_s), options.increment_s,
                  options.state_interval_s);
  const std::string wanted = "*NODE FILE, FREQUENCY=100000\nNT\n*END STEP\n";
  text += step;
  text += "** air in the room and in the hollows\n*FILM, AMPLITUDE=ROOM\n";
  for (const auto& [name, group] : machine.faces()) {
    if (name.starts_with("WET")) continue;
    text += fmt::format("{}, F{}, {{{{room_gain}}}}, {{{{{}*1e-3}}}}\n", name, group.side,
                        group.in_cavity ? inner_film : outer_film);
  }
  text +=
      "** coolant while it runs\n*FILM, FILM AMPLITUDE=COOLANT\nWET_2, F2, {{coolant_K}}, {{h_coolant*1e-3}}\n"
      "** losses of bearings and motor, sun\n"
      "*DFLUX, AMPLITUDE=FRICTION\nBEARING, BF, {{friction*1e-3}}\n"
      "*DFLUX, AMPLITUDE=MOTOR\nMOTOR, BF, {{motor*1e-3}}\n"
      "*DFLUX, AMPLITUDE=SUN\nSUN_3, S3, {{sun_front*1e-3}}\n";
  text += wanted;
  text += "** the loads stay, one step per state\n";
  for (int k = 1; k < options.states; ++k) text += step + wanted;
  return text;
}

std::string mechTemplate(const CFrameDeckOptions& options, const CFrameMachine& machine) {
  std::string text = headOf("displacements", false);
  const std::array<std::size_t, 3> feet = machine.feet();
  text += fmt::format(
      "** three feet: 3, 2 and 1 direction held\n*BOUNDARY\n{}, 1, 3\n{}, 2, 3\n{}, 3, 3\n"
      "** one step per state; BSTEP counts the steps of heat.inp\n",
      feet[0] + 1, feet[1] + 1, feet[2] + 1);
  for (int k = 1; k <= options.states; ++k) {
    text += fmt::format(
        "*STEP\n*STATIC\n*TEMPERATURE, FILE=heat.frd, BSTEP={}\n*NODE PRINT, NSET=OBSERVED\nU\n*END STEP\n", k);
  }
  return text;
}

std::string observeCsv(const CFrameMachine& machine) {
  std::string text = "point,component,node,dof,weight\n";
  for (const CFrameObserved& row : machine.observed()) {
    for (const auto& [key, weight] : row.weights) {
      text += fmt::format("{},{},{},{},{:.10g}\n", row.point, toString(row.component), key.first + 1, key.second + 1,
                          weight);
    }
  }
  return text;
}

double boundOf(double value, const CFrameDeckOptions& options) {
  return std::isnan(value) ? options.duration_s() : value;
}

nlohmann::json simulatorJson(const CFrameDeckOptions& options) {
  nlohmann::json parameters = nlohmann::json::array();
  for (const Parameter& p : parameterTable()) {
    const auto given = options.values.find(p.name);
    const double value = given != options.values.end() ? given->second : boundOf(p.value, options);
    const bool off = value == 0.0 && !p.effects.empty();
    parameters.push_back({{"name", p.name},
                          {"value", value},
                          {"unit", p.unit},
                          {"standard_uncertainty", off ? p.off_uncertainty : p.standard_uncertainty},
                          {"min", p.min},
                          {"max", boundOf(p.max, options)},
                          {"what", p.what},
                          {"effects", p.effects}});
  }
  const auto speed = [](double power) {
    return nlohmann::json{{"column", "spindle_rpm"},
                          {"between_rows", "hold"},
                          {"divide_by", 1000.0},
                          {"power", power},
                          {"mean_over_increment", true}};
  };
  return {
      {"format", "spindrift-simulator"},
      {"version", 1},
      {"kind", "calculix"},
      {"templates", nlohmann::json::array({"heat.inp.in", "mech.inp.in"})},
      {"include", nlohmann::json::array({"mesh.inp"})},
      {"run", {{"ccx", "-i", "heat"}, {"ccx", "-i", "mech"}}},
      {"time_limit_s", 600},
      {"displacements", "mech.dat"},
      {"unit_of_displacement", "mm"},
      {"observe", "observe.csv"},
      {"first_state_s", 0},
      {"state_interval_s", options.state_interval_s},
      {"increment_s", options.increment_s},
      {"parameters", parameters},
      {"tables",
       {{"ROOM", {{"column", "T_ambient_degC"}, {"between_rows", "linear"}, {"minus_first", true}}},
        {"FRICTION", speed(1.5)},
        {"MOTOR", speed(1.0)},
        {"COOLANT", {{"column", "coolant"}, {"between_rows", "hold"}, {"mean_over_increment", true}}},
        {"SUN", {{"window", nlohmann::json::array({"sun_on_s", "sun_off_s"})}, {"mean_over_increment", true}}}}},
  };
}

}  // namespace

const CFrameValues& cFrameValues() {
  static const CFrameValues values = [] {
    CFrameValues out;
    for (const Parameter& p : parameterTable()) {
      if (!std::isnan(p.value)) out[p.name] = p.value;
    }
    return out;
  }();
  return values;
}

void CFrameDeckOptions::validate() const {
  if (states < 1) throw InputError(fmt::format("{} states are not allowed; allowed: at least 1.", states));
  const double increments = state_interval_s / increment_s;
  const bool whole = increment_s > 0.0 && increments >= 1.0 && std::abs(increments - std::round(increments)) < 1e-9;
  if (!whole) {
    throw InputError(fmt::format(
        "An increment of {:.6g} s is not allowed; allowed: a whole part of the {:.6g} s from state to state.",
        increment_s, state_interval_s));
  }
  for (const auto& [name, value] : values) {
    const auto& table = parameterTable();
    const auto found = std::find_if(table.begin(), table.end(), [&](const Parameter& p) { return p.name == name; });
    if (found == table.end()) {
      std::vector<std::string> names;
      for (const Parameter& p : table) names.emplace_back(p.name);
      throw InputError(
          fmt::format("There is no parameter \"{}\" of the machine; allowed: {}.", name, joinedList(names, "or")));
    }
    if (!(value >= found->min && value <= boundOf(found->max, *this))) {
      throw InputError(fmt::format("{} = {:.6g} is not allowed; allowed: {:.6g} to {:.6g} {}.", name, value, found->min,
                                   boundOf(found->max, *this), found->unit));
    }
  }
}

CFrameDeck CFrameDeck::make(const CFrameDeckOptions& options) {
  options.validate();
  return make(options, CFrameMachine(options.dimensions, options.largest_cell_mm));
}

CFrameDeck CFrameDeck::make(const CFrameDeckOptions& options, const CFrameMachine& machine) {
  options.validate();
  CFrameDeck deck;
  deck.options = options;
  deck.mesh = machine.meshText();
  deck.heat_template = heatTemplate(options, machine);
  deck.mech_template = mechTemplate(options, machine);
  deck.observe = observeCsv(machine);
  deck.simulator = simulatorJson(options);
  deck.nodes = machine.mesh().nodes_mm().size();
  deck.elements = machine.mesh().elements().size();
  return deck;
}

CFrameValues CFrameDeck::values() const {
  CFrameValues out;
  for (const nlohmann::json& parameter : simulator.at("parameters")) {
    out[parameter.at("name").get<std::string>()] = parameter.at("value").get<double>();
  }
  return out;
}

void CFrameDeck::write(const std::filesystem::path& folder) const {
  writeFileAtomically(folder / "mesh.inp", mesh);
  writeFileAtomically(folder / "heat.inp.in", heat_template);
  writeFileAtomically(folder / "mech.inp.in", mech_template);
  writeFileAtomically(folder / "observe.csv", observe);
  writeFileAtomically(folder / "simulator.json", simulator.dump(1) + "\n");
}

nlohmann::json cFrameMachineJson(const CFrameDimensions& dimensions) {
  nlohmann::json axes = nlohmann::json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    axes.push_back({{"name", std::string(1, "XYZ"[axis])},
                    {"travel_mm", {0.0, c_frame_travel_mm[axis]}},
                    {"scale", "linear_scale"},
                    {"datum_mm", 0.0}});
  }
  nlohmann::json points = nlohmann::json::array();
  for (const CFramePoint& point : cFramePoints()) {
    points.push_back({{"id", point.id},
                      {"kind", "fiducial"},
                      {"x_mm", point.position_mm.x()},
                      {"y_mm", point.position_mm.y()},
                      {"z_mm", point.position_mm.z()}});
  }
  const nlohmann::json room = {{"name", "T_ambient_degC"}, {"place", "beside the column"}, {"role", "room"}};
  const double base = -dimensions.table_thickness_mm - dimensions.saddle_height_mm;
  const double overhang = -(dimensions.column_front_mm + 0.5 * dimensions.column_depth_mm);
  return {{"format", "spindrift-machine"},
          {"version", 1},
          {"name", "C-frame machining centre (finite elements)"},
          {"chain", "V [w-X'-Y'-b-Z-t]"},
          {"axes", axes},
          {"spindle", {{"axis", "Z"}, {"max_rpm", 8000}}},
          {"table", nlohmann::json::object({{"centre_mm", {0.5 * c_frame_travel_mm[0], 0.5 * c_frame_travel_mm[1]}}})},
          {"column", {{"base_mm", base}, {"overhang_mm", {0.0, overhang}}}},
          {"temperature_sensors", nlohmann::json::array({room})},
          {"points", points}};
}

}  // namespace spindrift
