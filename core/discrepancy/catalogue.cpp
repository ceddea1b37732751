// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/discrepancy/effect_relations.h"

namespace spindrift {

std::string_view toString(Dynamics dynamics) noexcept {
  switch (dynamics) {
    case Dynamics::None:
      return "none";
    case Dynamics::Lag:
      return "lag";
    case Dynamics::AsymmetricLag:
      return "asymmetric_lag";
    case Dynamics::Step:
      return "step";
    case Dynamics::Pulse:
      return "pulse";
    case Dynamics::Start:
      return "start";
  }
  return "none";
}

ShapeColumn constantShape(Component component, double sign) {
  return {"um", [component, sign](const DeviationQuery&, Component c) { return c == component ? sign : 0.0; }};
}

void addLagVariants(Effect& effect, const std::vector<std::string>& drivers) {
  for (const std::string& driver : drivers) effect.variants.push_back({{{driver, Dynamics::Lag}}, false});
}

std::vector<Effect> formsApart(std::vector<Effect> effects) {
  std::vector<Effect> out;
  out.reserve(effects.size());
  for (Effect& effect : effects) {
    if (effect.forms.empty()) {
      out.push_back(std::move(effect));
      continue;
    }
    const auto whole = std::make_shared<const Effect>(std::move(effect));
    for (std::size_t f = 0; f < whole->forms.size(); ++f) {
      Effect form = *whole;
      form.shape = {{whole->shape.front().gain_unit, [whole, f](const DeviationQuery& q, Component c) {
                       double sum = 0.0;
                       for (std::size_t k = 0; k < whole->shape.size(); ++k)
                         if (whole->forms[f][k] != 0.0) sum += whole->forms[f][k] * whole->shape[k].value(q, c);
                       return sum;
                     }}};
      form.choices = static_cast<int>(whole->forms.size());
      form.forms.clear();
      form.of_forms = whole;
      form.form = f;
      out.push_back(std::move(form));
    }
  }
  return out;
}

namespace {

/// A machine that can have every effect, and a log in which everything that drives one changes.
constexpr std::string_view every_machine = R"({"format":"spindrift-machine","version":1,"name":"every",
  "chain":"V [w-C'-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[0,500],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0},
           "scale":"linear_scale","datum_mm":0},
          {"name":"Y","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0},
           "scale":"linear_scale","datum_mm":0},
          {"name":"Z","travel_mm":[0,300],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0},
           "scale":"linear_scale","datum_mm":0}],
  "table":{"centre_mm":[240,190]},"column":{"base_mm":-180},"crossbeam":{"axis":"Y","from_mm":-20,"to_mm":430},
  "rotary":[{"name":"C","centre_mm":[250,180,10]}],
  "artefacts":[{"id":"bar","kind":"hole_bar","nominal_positions_mm":[0,60,130],"reference_hole":"H1",
                "reference_in_table_mm":[-150,0,20],"direction_at_c0":[1,0,0],"hole_diameter_mm":10}],
  "temperature_sensors":[{"name":"T_spindle_degC","place":"spindle housing"},{"name":"T_room_degC","place":"room"},
   {"name":"T_column_front_degC","place":"column front"},{"name":"T_column_rear_degC","place":"column rear"},
   {"name":"T_table_degC","place":"table"},{"name":"T_screw_x_degC","place":"X ball screw"}]})";

MachineDescription everyMachine() {
  return MachineDescription::parse(JsonNode::parse(every_machine, "every"), "every");
}

OperatingLog everyLog() {
  std::vector<double> time_s;
  for (int i = 0; i < 12; ++i) time_s.push_back(600.0 * i);
  OperatingLog log(time_s);
  int k = 2;
  for (const char* name : {"spindle_rpm", "feed_x_mm_min", "feed_y_mm_min", "feed_z_mm_min", "pos_x_mm", "pos_y_mm",
                           "pos_z_mm", "speed_c_rpm", "coolant", "instrument_on", "T_spindle_degC", "T_room_degC",
                           "T_column_front_degC", "T_column_rear_degC", "T_table_degC", "T_screw_x_degC"}) {
    std::vector<double> values;
    for (std::size_t i = 0; i < time_s.size(); ++i)
      values.push_back(20.0 + 10.0 * std::sin(0.1 * k * static_cast<double>(i)));
    log.setSignal(name, values);
    ++k;
  }
  return log;
}

struct KnownEffects {
  std::vector<Effect> effects;
  std::map<std::string, std::vector<std::string>> holds[2];  ///< with displacements alone, with rotations
};

std::vector<Effect> effectsOf(const CatalogueContext& context) {
  std::vector<Effect> out;
  for (const EffectFamily family : effectFamilies()) family(context, out);
  return out;
}

KnownEffects makeKnownEffects() {
  KnownEffects out;
  const MachineDescription machine = everyMachine();
  const OperatingLog log = everyLog();
  const DriverTable drivers(machine, &log);
  CatalogueContext context;
  context.machine = &machine;
  context.drivers = &drivers;
  context.points = {"<point>", "P2"};
  context.point_count = 2;
  context.varying_approach = {"x", "y", "z"};
  context.c_varies = true;
  context.position_varies = true;
  out.effects = effectsOf(context);
  std::erase_if(out.effects, [](const Effect& e) { return e.id == "fixture.slip.P2"; });
  Random random(7);
  std::vector<DeviationQuery> places(60);
  for (DeviationQuery& q : places) {
    q.position_mm = {random.uniform(0.0, 500.0), random.uniform(0.0, 400.0), random.uniform(0.0, 300.0)};
    q.c_deg = random.uniform(0.0, 360.0);
    q.approach = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    q.point = random.index(4) == 0 ? "<point>" : "P2";
  }
  const std::vector<Effect> effects = formsApart(out.effects);
  for (const bool rotations : {false, true}) {
    std::vector<Eigen::MatrixXd> shapes;
    for (const Effect& effect : effects) {
      Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(6 * places.size()),
                                                    static_cast<Eigen::Index>(effect.shape.size()));
      for (std::size_t p = 0; p < places.size(); ++p) {
        for (const Component c : all_components) {
          if (isRotation(c) && !rotations) continue;
          const auto row = static_cast<Eigen::Index>(6 * p) + static_cast<Eigen::Index>(c);
          for (Eigen::Index k = 0; k < shape.cols(); ++k)
            shape(row, k) = effect.shape[static_cast<std::size_t>(k)].value(places[p], c);
        }
      }
      shapes.push_back(std::move(shape));
    }
    const EffectRelations relations = effectRelations(effects, shapes, true);
    for (std::size_t a = 0; a < effects.size(); ++a) {
      for (const std::size_t b : relations.holds[a]) {
        std::vector<std::string>& held = out.holds[rotations][effects[a].id];
        if (std::find(held.begin(), held.end(), effects[b].id) == held.end()) held.push_back(effects[b].id);
      }
    }
  }
  for (Effect& effect : out.effects) effect.contains = out.holds[1][effect.id];
  return out;
}

const KnownEffects& knownEffects() {
  static const KnownEffects known = makeKnownEffects();
  return known;
}

}  // namespace

const std::vector<Effect>& everyEffect() {
  return knownEffects().effects;
}

std::vector<Effect> effectsOfMachine(const MachineDescription& machine, const std::vector<std::string>& points) {
  MachineDescription equipped = machine;
  equipped.temperature_sensors = everyMachine().temperature_sensors;
  const OperatingLog log = everyLog();
  const DriverTable drivers(equipped, &log);
  CatalogueContext context;
  context.machine = &equipped;
  context.drivers = &drivers;
  context.points = points;
  context.point_count = points.size();
  context.varying_approach = {"x", "y", "z"};
  context.c_varies = !machine.rotary.empty();
  context.position_varies = true;
  return effectCatalogue(context);
}

std::vector<Effect> effectCatalogue(const CatalogueContext& context) {
  std::vector<Effect> out = effectsOf(context);
  const auto& holds = knownEffects().holds[context.rotations ? 1 : 0];
  for (Effect& effect : out) {
    const auto found = holds.find(effect.id);
    if (found != holds.end()) effect.contains.insert(effect.contains.end(), found->second.begin(), found->second.end());
  }
  return out;
}

}  // namespace spindrift
