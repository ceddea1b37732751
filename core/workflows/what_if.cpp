// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/what_if.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/effect_listing.h"
#include "core/machine/campaign.h"
#include "core/machine/driver_words.h"
#include "core/machine/parameter_meanings.h"
#include "core/reporting/test_part_drawing.h"

namespace spindrift {
namespace {

/// Where the part of a shape that a free origin adds is to vanish.
enum class About { Given, Start, Middle };

/// What drives an effect, how far, and what one unit of it does. `others`: gains of the further columns of the shape
/// over that of the first, where no origin decides them.
struct DriverScale {
  std::string_view stem;
  std::string_view driver;
  std::string_view unit;
  double largest;
  double sensitivity;
  About about = About::Given;
  std::array<double, 3> others{};
};

// Steel 11.5 um/(m K), glass scale 8, cast iron 10.5. Turns and bends: a difference of 1 K across a body of height h
// and length l turns it by alpha l / h and curves it by alpha / h; column 0.4 m thick, beam 1 m x 0.4 m, head 0.5 m x
// 0.7 m with the tool 0.4 m below and 0.3 m in front of the pivot. Signs: a spindle grows towards the table (EZ < 0)
// and speed pulls its shaft back; a column leans away from its warm side (front: towards +Y, EA < 0; left: towards +X).
constexpr std::array scales{
    DriverScale{"spindle.growth.z", "temperature rise of the spindle", "K", 30.0, -1.7},
    DriverScale{"spindle.centrifugal.z", "square of the spindle speed", "krpm2", 150.0, 0.05},
    DriverScale{"spindle.drift", "temperature rise of the spindle", "K", 30.0, 0.3},
    DriverScale{"head.tilt.a", "temperature difference across the head", "K", 5.0, 3.2, About::Given, {-0.75, 2.5, 0}},
    DriverScale{"head.tilt.b", "temperature difference across the head", "K", 5.0, -3.2, About::Given, {0, -2.5, 0}},
    DriverScale{"column.bending.a",
                "temperature difference front minus rear of the column",
                "K",
                5.0,
                -28.75,
                About::Given,
                {-0.35, 0, 0}},
    DriverScale{"column.bending.b", "temperature difference left minus right of the column", "K", 5.0, 28.75},
    DriverScale{"column.expansion.z", "temperature rise of the column", "K", 10.0, 10.5},
    DriverScale{"ball_screw.expansion", "temperature rise of the ball screw", "K", 20.0, 11.5, About::Start},
    DriverScale{"ball_screw.nonuniform", "excess temperature where the nut travels", "K", 10.0, 20.0},
    DriverScale{"scale.expansion", "temperature rise of the scale", "K", 10.0, 8.0, About::Start},
    DriverScale{"table.expansion.xy", "temperature rise of the table", "K", 10.0, 10.5, About::Middle},
    DriverScale{"frame.rotation", "temperature difference across the frame", "K", 5.0, 8.0, About::Middle},
    DriverScale{"squareness.drift.c0y", "temperature difference across the guideway of Y", "K", 5.0, 5.0,
                About::Middle},
    DriverScale{"crossbeam.sag.z", "temperature difference bottom minus top of the beam", "K", 5.0, -3.6},
    DriverScale{"ambient.drift", "change of the room temperature", "K", 5.0, 3.0},
    DriverScale{"instrument.warm_up", "part of the warm-up that has passed", "%", 100.0, 0.05},
    DriverScale{"fixture.slip", "slip along X", "um", 20.0, 1.0},
    DriverScale{"periodic.pitch", "temperature rise of the ball screw", "K", 20.0, 0.2},
    DriverScale{"backlash", "half of the reversal error", "um", 10.0, 1.0},
    DriverScale{"coolant.shock", "coolant minus structure temperature", "K", 10.0, 0.8},
    DriverScale{"external_heat.a",
                "temperature difference that the heat makes across the column",
                "K",
                5.0,
                28.75,
                About::Given,
                {-0.35, 0, 0}},
    DriverScale{"external_heat.b", "temperature difference that the heat makes across the column", "K", 5.0, 28.75},
    DriverScale{"external_heat.z", "temperature rise of the part that is heated", "K", 5.0, 3.0},
    DriverScale{"heat_source.position", "spindle heat times distance from where it does nothing", "krpm_m", 3.0, 2.0},
    DriverScale{"rotary.drift", "temperature rise of the table drive", "K", 20.0, 1.0},
    DriverScale{"rotary.tilt", "temperature rise of the table drive", "K", 20.0, 1.5},
    DriverScale{"rotary.expansion.r0t", "temperature rise of the table", "K", 10.0, 10.5},
    DriverScale{"artefact.expansion", "temperature rise of the artefact", "K", 10.0, 11.5}};

const DriverScale* scaleOf(std::string_view id) {
  const auto found = std::find_if(scales.begin(), scales.end(), [&](const DriverScale& s) {
    return id == s.stem || (id.starts_with(s.stem) && id[s.stem.size()] == '.');
  });
  return found == scales.end() ? nullptr : &*found;
}

SixComponents sixOf(const SmallError& error) {
  SixComponents out;
  out << 1e3 * error.translation_mm, 1e6 * error.rotation_rad;
  return out;
}

std::array<std::array<double, 2>, 3> travelsOf(const MachineDescription& machine) {
  std::array<std::array<double, 2>, 3> travel{{{0.0, 500.0}, {0.0, 500.0}, {0.0, 400.0}}};
  for (const LinearAxis& axis : machine.axes) {
    const std::size_t i = axis.name.empty() ? 3 : std::string_view("XYZ").find(axis.name.front());
    if (i < 3) travel[i] = axis.travel_mm;
  }
  return travel;
}

/// A place by its parts of the travels.
Eigen::Vector3d placeIn(const std::array<std::array<double, 2>, 3>& travel, double x, double y, double z) {
  const std::array<double, 3> part{x, y, z};
  Eigen::Vector3d out;
  for (std::size_t i = 0; i < 3; ++i)
    out[static_cast<Eigen::Index>(i)] = travel[i][0] + part[i] * (travel[i][1] - travel[i][0]);
  return out;
}

DeviationQuery queryAt(const Eigen::Vector3d& at, const std::string& point = {}, double c_deg = 0.0) {
  DeviationQuery query;
  query.position_mm = at;
  query.point = point;
  query.c_deg = c_deg;
  query.approach = Eigen::Vector3d::Ones();  // one-sided, as it should be
  return query;
}

/// Gains of all columns for one unit of the driver: the first by the sensitivity, the others so that the shape vanishes
/// at its origin where that is free.
std::vector<double> gainsOf(const Effect& effect, const DriverScale& scale,
                            const std::array<std::array<double, 2>, 3>& travel) {
  const std::size_t n = effect.shape.size();
  std::vector<double> gains(n, 0.0);
  gains[0] = scale.sensitivity;
  for (std::size_t k = 1; k < n; ++k)
    gains[k] = k <= scale.others.size() ? scale.sensitivity * scale.others[k - 1] : 0.0;
  if (scale.about == About::Given || n < 2) return gains;
  const double part = scale.about == About::Start ? 0.0 : 0.5;
  const DeviationQuery origin = queryAt(placeIn(travel, part, part, part));
  Eigen::MatrixXd others(3, static_cast<Eigen::Index>(n - 1));
  Eigen::Vector3d first;
  for (Eigen::Index c = 0; c < 3; ++c) {
    first[c] = effect.shape[0].value(origin, static_cast<Component>(c));
    for (Eigen::Index k = 0; k < others.cols(); ++k)
      others(c, k) = effect.shape[static_cast<std::size_t>(k) + 1].value(origin, static_cast<Component>(c));
  }
  const Eigen::VectorXd solved = others.completeOrthogonalDecomposition().solve(-scale.sensitivity * first);
  for (std::size_t k = 1; k < n; ++k) gains[k] = solved[static_cast<Eigen::Index>(k - 1)];
  return gains;
}

constexpr std::string_view standard_machine = R"({"format":"spindrift-machine","version":1,
  "name":"vertical machining centre with rotary table","chain":"V [w-C'-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[0,600],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0},
           "scale":"rotary_encoder","datum_mm":0},
          {"name":"Y","travel_mm":[0,500],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":500},
           "scale":"rotary_encoder","datum_mm":0},
          {"name":"Z","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":400},
           "scale":"linear_scale","datum_mm":0}],
  "spindle":{"axis":"Z","max_rpm":12000},"table":{"centre_mm":[300,250]},
  "column":{"base_mm":-200,"overhang_mm":[0,-350]},"rotary":[{"name":"C","centre_mm":[300,250,0]}]})";

nlohmann::json placeJson(const WhatIfPlace& place, const char* name) {
  nlohmann::json out{{name, place.id},
                     {"x_mm", place.position_mm.x()},
                     {"y_mm", place.position_mm.y()},
                     {"z_mm", place.position_mm.z()}};
  for (const Component c : all_components)
    out[fmt::format("{}_{}", toString(c), unitOf(c))] = place.deviation[static_cast<Eigen::Index>(c)];
  return out;
}

}  // namespace

MachineDescription standardMachine() {
  return MachineDescription::parse(JsonNode::parse(std::string(standard_machine), "machine.json"), "machine.json");
}

WhatIf::WhatIf(const MachineDescription& machine) : machine_(machine), geometric_(machine) {
  addStandardPlaces();
  addParameters();
  for (const MachinePoint& point : machine_.points) asked_.push_back({queryAt(point.position_mm, point.id)});
  point_count_ = asked_.size();
  addBars();
  addBalls();
  addPlate();
  part_first_ = asked_.size();
  try {
    part_.emplace(TestPartOptions::on(machine_));
    for (const DeviationQuery& query : part_->points()) asked_.push_back({query, -1, true});
  } catch (const InputError& error) {
    why_no_part_ = error.what();
  }
}

void WhatIf::addStandardPlaces() {
  const auto travel = travelsOf(machine_);
  if (machine_.points.empty()) {
    int number = 1;
    for (const double z : {0.1, 0.6}) {
      for (const auto& [x, y] : {std::pair{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}, {0.5, 0.5}})
        machine_.points.push_back({fmt::format("P{}", number++), "surface", placeIn(travel, x, y, z)});
    }
  }
  const auto has = [&](std::string_view kind) {
    return std::any_of(machine_.artefacts.begin(), machine_.artefacts.end(),
                       [&](const Artefact& a) { return a.kind == kind; });
  };
  if (!has("hole_bar")) {
    Artefact bar;
    bar.id = "hole bar";
    bar.kind = "hole_bar";
    const double length = 0.8 * std::min(travel[0][1] - travel[0][0], travel[1][1] - travel[1][0]);
    for (const double part : {0.0, 0.13, 0.3, 0.44, 0.64, 0.81, 1.0})
      bar.nominal_positions_mm.push_back(std::round(part * length));
    const Eigen::Vector3d start = placeIn(travel, 0.1, 0.5, 0.1);
    const RotaryAxis* rotary = machine_.rotary.empty() ? nullptr : &machine_.rotary.front();
    bar.reference_in_table_mm =
        rotary == nullptr ? start : Eigen::Vector3d(-0.5 * length, 0.0, start.z() - rotary->centre_mm.z());
    machine_.artefacts.push_back(bar);
  }
  if (!has("balls")) {
    Artefact balls;
    balls.id = "ball artefact";
    balls.kind = "balls";
    const Eigen::Vector3d first = placeIn(travel, 0.2, 0.2, 0.1);
    int number = 1;
    for (const auto& [x, y, z] :
         {std::tuple{0.2, 0.2, 0.1}, {0.8, 0.2, 0.1}, {0.8, 0.8, 0.1}, {0.2, 0.8, 0.1}, {0.5, 0.5, 0.7}})
      balls.balls.push_back({fmt::format("B{}", number++), 25.0, placeIn(travel, x, y, z) - first});
    machine_.artefacts.push_back(balls);
  }
}

void WhatIf::addParameters() {
  const auto travel = travelsOf(machine_);
  for (const std::string& name : geometric_.names()) {
    WhatIfParameter p;
    p.id = name;
    p.geometric = true;
    const std::size_t first = name.find('_');
    p.unit = name.substr(first + 1);
    const std::string symbol = name.substr(0, first);
    // EXX per metre from C is what a hole bar finds; here it is an error of the axis as of any other.
    p.title = parameterMeaning(p.unit == "um_per_m" ? symbol + "_um" : name);
    const bool square = symbol.find("0Y") != std::string::npos || symbol.find("0Z") != std::string::npos;
    p.group = square ? "squareness" : symbol.find('0') != std::string::npos ? "C" : symbol.substr(2);
    p.largest = p.unit == "um" ? 20.0 : p.unit == "um_per_m" ? 100.0 : 50.0;
    parameters_.push_back(std::move(p));
  }
  std::vector<std::string> points;
  for (const MachinePoint& point : machine_.points) points.push_back(point.id);
  effects_ = effectsOfMachine(machine_, points);
  for (const Effect& effect : effects_) {
    // An effect that is not in the table is set by its gain.
    const DriverScale* known = scaleOf(effect.id);
    const DriverScale scale = known != nullptr ? *known : DriverScale{effect.id, "gain", "1", 20.0, 1.0};
    gains_.push_back(gainsOf(effect, scale, travel));
    WhatIfParameter p;
    p.id = effect.id;
    p.title = titleOf(effect);
    p.group = effect.id.substr(0, effect.id.find('.'));
    p.unit = scale.unit;
    p.largest = scale.largest;
    p.driver = scale.driver;
    p.sensitivity = scale.sensitivity;
    p.gain_unit = effect.shape.front().gain_unit;
    p.physics = effect.physics;
    p.formula = effect.formula;
    parameters_.push_back(std::move(p));
  }
  values_.assign(parameters_.size(), 0.0);
}

void WhatIf::addArtefact(Placed placed, const std::vector<DeviationQuery>& features) {
  placed.first = asked_.size();
  const int number = static_cast<int>(placed_.size());
  for (const DeviationQuery& query : features) {
    asked_.push_back({query, number});
    placed.artefact.features.push_back({query.point, query.position_mm, SixComponents::Zero()});
  }
  placed.artefact.reference = features[placed.reference].point;
  placed_.push_back(std::move(placed));
}

void WhatIf::addBars() {
  const Eigen::Vector3d centre =
      machine_.rotary.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(machine_.rotary.front().centre_mm);
  const bool turns = !machine_.rotary.empty();
  for (const Artefact& bar : machine_.artefacts) {
    if (bar.kind != "hole_bar" || bar.nominal_positions_mm.size() < 2) continue;
    std::size_t reference = 0;
    for (std::size_t i = 0; i < bar.nominal_positions_mm.size(); ++i)
      if (bar.reference_hole == fmt::format("H{}", i + 1)) reference = i;
    // On a table that turns at four angles; else as it lies, and square to that about the middle of the travels.
    for (int pose = 0; pose < (turns ? 4 : 2); ++pose) {
      const double c_deg = turns ? 90.0 * pose : 0.0;
      const Eigen::AngleAxisd turn(90.0 * pose * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
      Eigen::Vector3d about = centre;
      if (!turns) about.head<2>() = placeIn(travelsOf(machine_), 0.5, 0.5, 0.0).head<2>();
      Placed placed;
      placed.reference = reference;
      placed.along = turn * bar.direction_at_c0;
      placed.front = &bar == &machine_.artefacts.front();
      placed.artefact.id = bar.id;
      placed.artefact.kind = bar.kind;
      placed.artefact.pose = turns ? fmt::format("c = {:g}°", c_deg) : pose == 0 ? "as it lies" : "turned by 90°";
      std::vector<DeviationQuery> features;
      for (std::size_t i = 0; i < bar.nominal_positions_mm.size(); ++i) {
        const Eigen::Vector3d at_c0 =
            centre + bar.reference_in_table_mm +
            (bar.nominal_positions_mm[i] - bar.nominal_positions_mm[reference]) * bar.direction_at_c0;
        features.push_back(queryAt(about + turn * (at_c0 - about), fmt::format("H{}", i + 1), c_deg));
      }
      addArtefact(std::move(placed), features);
    }
  }
}

void WhatIf::addBalls() {
  const auto travel = travelsOf(machine_);
  for (const Artefact& artefact : machine_.artefacts) {
    if (artefact.kind != "balls" || artefact.balls.size() < 2) continue;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const ArtefactBall& ball : artefact.balls)
      middle += ball.certified_mm / static_cast<double>(artefact.balls.size());
    Eigen::Vector3d first = placeIn(travel, 0.5, 0.5, 0.3) - middle;
    if (const MachinePoint* point = machine_.findPoint(artefact.balls.front().id)) first = point->position_mm;
    Placed placed;
    placed.front = &artefact == &machine_.artefacts.front();
    placed.artefact.id = artefact.id;
    placed.artefact.kind = artefact.kind;
    std::vector<DeviationQuery> features;
    for (const ArtefactBall& ball : artefact.balls) features.push_back(queryAt(first + ball.certified_mm, ball.id));
    addArtefact(std::move(placed), features);
  }
}

void WhatIf::addPlate() {
  const auto travel = travelsOf(machine_);
  Placed placed;
  placed.reference = 12;
  placed.artefact.id = "fiducial plate";
  placed.artefact.kind = "fiducial_plate";
  std::vector<DeviationQuery> features;
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column)
      features.push_back(queryAt(placeIn(travel, 0.1 + 0.2 * column, 0.1 + 0.2 * row, 0.05),
                                 fmt::format("{}{}", static_cast<char>('A' + row), column + 1)));
  }
  addArtefact(std::move(placed), features);
}

std::size_t WhatIf::find(const std::string& id) const {
  const auto found =
      std::find_if(parameters_.begin(), parameters_.end(), [&](const WhatIfParameter& p) { return p.id == id; });
  if (found != parameters_.end()) return static_cast<std::size_t>(found - parameters_.begin());
  std::vector<std::string> alike;
  const std::string stem = id.substr(0, std::max<std::size_t>(id.find_first_of("._"), 2));
  for (const WhatIfParameter& p : parameters_)
    if (p.id.starts_with(stem)) alike.push_back(p.id);
  throw InputError(fmt::format("\"{}\" is not a parameter of machine \"{}\"; allowed: {}.", id, machine_.name,
                               alike.empty() ? "those that what-if --list lists" : joinedList(alike, "or")));
}

void WhatIf::set(std::size_t parameter, double value) {
  if (!std::isfinite(value))
    throw InputError(fmt::format("{} = {}; allowed: a finite number.", parameters_[parameter].id, value));
  values_[parameter] = value;
}

void WhatIf::reset() {
  values_.assign(values_.size(), 0.0);
}

const Eigen::Matrix<double, 6, Eigen::Dynamic>& WhatIf::unit(std::size_t parameter) const {
  const auto kept = units_.find(parameter);
  if (kept != units_.end()) return kept->second;
  Eigen::Matrix<double, 6, Eigen::Dynamic> out(6, static_cast<Eigen::Index>(asked_.size()));
  out.setZero();
  const std::size_t geometric = geometric_.names().size();
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    const Asked& asked = asked_[i];
    auto column = out.col(static_cast<Eigen::Index>(i));
    if (parameter < geometric) {
      column = sixOf(geometric_.unit(parameter, asked.query));
      continue;
    }
    const Effect& effect = effects_[parameter - geometric];
    if (!effect.of_machine && asked.part) continue;
    if (effect.id == "artefact.expansion" &&
        (asked.artefact < 0 || !placed_[static_cast<std::size_t>(asked.artefact)].front))
      continue;
    const std::vector<double>& gains = gains_[parameter - geometric];
    for (const Component c : all_components)
      for (std::size_t k = 0; k < gains.size(); ++k)
        if (gains[k] != 0.0) column[static_cast<Eigen::Index>(c)] += gains[k] * effect.shape[k].value(asked.query, c);
  }
  return units_.emplace(parameter, std::move(out)).first->second;
}

WhatIfAnswer WhatIf::answer() const {
  Eigen::Matrix<double, 6, Eigen::Dynamic> total(6, static_cast<Eigen::Index>(asked_.size()));
  total.setZero();
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (values_[i] != 0.0) total += values_[i] * unit(i);
  // What rounding leaves is nothing, so that it is not printed as minus nothing.
  constexpr double nothing = 1e-9;
  total = (total.array().abs() < nothing).select(0.0, total);
  const auto at = [&](std::size_t i) -> SixComponents { return total.col(static_cast<Eigen::Index>(i)); };
  WhatIfAnswer out;
  for (std::size_t i = 0; i < point_count_; ++i)
    out.points.push_back({asked_[i].query.point, asked_[i].query.position_mm, at(i)});
  for (const Placed& placed : placed_) {
    WhatIfArtefact artefact = placed.artefact;
    const SixComponents reference = at(placed.first + placed.reference);
    const Eigen::Vector3d from = artefact.features[placed.reference].position_mm;
    double moment = 0.0, square = 0.0, mean_s = 0.0;
    for (std::size_t i = 0; i < artefact.features.size(); ++i) {
      artefact.features[i].deviation = at(placed.first + i) - reference;
      if (placed.along)
        mean_s +=
            placed.along->dot(artefact.features[i].position_mm - from) / static_cast<double>(artefact.features.size());
    }
    if (placed.along) {
      for (const WhatIfPlace& feature : artefact.features) {
        const double s = placed.along->dot(feature.position_mm - from) - mean_s;
        moment += s * placed.along->dot(feature.deviation.head<3>());
        square += s * s;
      }
      const double slope = square > 0.0 ? 1e3 * moment / square : 0.0;
      artefact.along_um_per_m = std::abs(slope) < 1e-6 ? 0.0 : slope;
    }
    out.artefacts.push_back(std::move(artefact));
  }
  if (part_) {
    for (std::size_t i = part_first_; i < asked_.size(); ++i) out.part_um.emplace_back(at(i).head<3>());
    out.part = part_->evaluate(out.part_um);
  }
  return out;
}

nlohmann::json WhatIf::json() const {
  const WhatIfAnswer found = answer();
  nlohmann::json set = nlohmann::json::array(), points = nlohmann::json::array(), artefacts = nlohmann::json::array();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const WhatIfParameter& p = parameters_[i];
    if (values_[i] == 0.0) continue;
    nlohmann::json one{{"id", p.id}, {"title", p.title}, {"value", values_[i]}, {"unit", p.unit}};
    if (!p.geometric) {
      one["driver"] = p.driver;
      one["gain"] = values_[i] * p.sensitivity;
      one["gain_unit"] = p.gain_unit;
    }
    set.push_back(std::move(one));
  }
  for (const WhatIfPlace& place : found.points) points.push_back(placeJson(place, "point"));
  for (const WhatIfArtefact& artefact : found.artefacts) {
    nlohmann::json features = nlohmann::json::array();
    for (const WhatIfPlace& place : artefact.features) features.push_back(placeJson(place, "feature"));
    artefacts.push_back(
        {{"id", artefact.id},
         {"kind", artefact.kind},
         {"pose", artefact.pose},
         {"reference", artefact.reference},
         {"along_um_per_m", artefact.along_um_per_m ? nlohmann::json(*artefact.along_um_per_m) : nlohmann::json()},
         {"features", features}});
  }
  nlohmann::json out{{"machine", machine_.name}, {"parameters", set}, {"points", points}, {"artefacts", artefacts}};
  out["part"] = nullptr;
  if (part_) {
    nlohmann::json rows = nlohmann::json::array();
    for (const PartCharacteristic& c : found.part)
      rows.push_back({{"feature", c.feature},
                      {"characteristic", c.characteristic},
                      {"datum", c.datum},
                      {"value", c.value},
                      {"unit", c.unit},
                      {"nominal_mm", c.nominal_mm > 0.0 ? nlohmann::json(c.nominal_mm) : nlohmann::json()}});
    const Eigen::Vector3d& centre = part_->options().centre_mm;
    out["part"] = {{"side_mm", part_->options().side_mm},
                   {"centre_mm", {centre.x(), centre.y(), centre.z()}},
                   {"characteristics", rows}};
  }
  return out;
}

WhatIf runWhatIf(const WhatIfRequest& request) {
  if (!request.campaign.empty() && !request.machine.empty())
    throw InputError("A campaign and --machine are both given; allowed: one of them.");
  const MachineDescription machine = !request.campaign.empty()  ? Campaign::read(request.campaign).machine
                                     : !request.machine.empty() ? MachineDescription::read(request.machine)
                                                                : standardMachine();
  WhatIf what_if(machine);
  for (const std::string& setting : request.settings) {
    const std::size_t equals = setting.find('=');
    double value = 0.0;
    if (equals == std::string::npos || !parseNumber(setting.substr(equals + 1), value))
      throw InputError(
          fmt::format("--set \"{}\" is not allowed; allowed: NAME=NUMBER, for example EC0Y_urad=20.", setting));
    what_if.set(what_if.find(setting.substr(0, equals)), value);
  }
  if (request.svg.empty() && request.png.empty()) return what_if;
  if (what_if.part() == nullptr) throw InputError(what_if.whyNoPart());
  const Drawing drawing = testPartDrawing(*what_if.part(), what_if.answer().part_um);
  if (!request.svg.empty()) writeFileAtomically(request.svg, svgOf(drawing));
  if (!request.png.empty()) writeFileAtomically(request.png, pngOf(drawing));
  return what_if;
}

std::string whatIfText(const WhatIf& what_if) {
  const WhatIfAnswer found = what_if.answer();
  std::string out = what_if.machine().name + "\n";
  bool any = false;
  for (std::size_t i = 0; i < what_if.parameters().size(); ++i) {
    const WhatIfParameter& p = what_if.parameters()[i];
    if (what_if.value(i) == 0.0) continue;
    any = true;
    const std::string name = p.geometric ? p.id.substr(0, p.id.find('_')) : p.id;  // the unit stands behind the value
    out += fmt::format("  {} = {:g} {}  {}", name, printed(what_if.value(i)), gainUnit(p.unit), p.title);
    if (!p.geometric)
      out += fmt::format(" ({}, {:g} {} per {})", p.driver, printed(p.sensitivity), gainUnit(p.gain_unit),
                         gainUnit(p.unit));
    out += "\n";
  }
  if (!any) out += "  no error is set; --set NAME=VALUE sets one, --list lists all\n";
  out += fmt::format("\nProbing points{:>29}{:>10}{:>10}\n", "EX / µm", "EY / µm", "EZ / µm");
  const auto row = [&](const std::string& name, const WhatIfPlace& place) {
    out += fmt::format("  {:<24}{:>16.2f}{:>10.2f}{:>10.2f}\n", name, printed(place.deviation[0]),
                       printed(place.deviation[1]), printed(place.deviation[2]));
  };
  for (const WhatIfPlace& place : found.points)
    row(fmt::format("{} ({:.0f}, {:.0f}, {:.0f})", place.id, printed(place.position_mm.x()),
                    printed(place.position_mm.y()), printed(place.position_mm.z())),
        place);
  for (const WhatIfArtefact& artefact : found.artefacts) {
    if (artefact.kind == "fiducial_plate") continue;  // 25 rows: in the JSON
    out += fmt::format("\n{}{}, relative to {}", artefact.id, artefact.pose.empty() ? "" : ", " + artefact.pose,
                       artefact.reference);
    if (artefact.along_um_per_m) out += fmt::format("; {:.1f} µm/m along it", printed(*artefact.along_um_per_m));
    out += "\n";
    for (const WhatIfPlace& place : artefact.features) row(place.id, place);
  }
  if (what_if.part() == nullptr) return out + "\n" + what_if.whyNoPart() + "\n";
  out += fmt::format("\nTest piece of the kind of ISO 10791-7, side {:g} mm\n", what_if.part()->options().side_mm);
  for (const PartCharacteristic& c : found.part)
    out += fmt::format("  {:<52}{:>10.2f} {}\n", characteristicText(c), printed(c.value), printedUnit(c.unit));
  return out;
}

std::string whatIfParametersText(const WhatIf& what_if) {
  std::string out;
  for (const WhatIfParameter& p : what_if.parameters()) {
    out += fmt::format("{:<26} ±{:g} {}  {}", p.id, p.largest, gainUnit(p.unit), p.title);
    if (!p.geometric)
      out += fmt::format("; {}, {:g} {} per {}", p.driver, printed(p.sensitivity), gainUnit(p.gain_unit),
                         gainUnit(p.unit));
    out += "\n";
  }
  return out;
}

nlohmann::json whatIfParametersJson(const WhatIf& what_if) {
  nlohmann::json out = nlohmann::json::array();
  for (const WhatIfParameter& p : what_if.parameters())
    out.push_back({{"id", p.id},
                   {"title", p.title},
                   {"group", p.group},
                   {"unit", p.unit},
                   {"largest", p.largest},
                   {"driver", p.driver},
                   {"sensitivity", p.sensitivity},
                   {"gain_unit", p.gain_unit}});
  return {{"machine", what_if.machine().name}, {"parameters", out}};
}

}  // namespace spindrift
