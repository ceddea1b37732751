// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/discrepancy/effect_model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "core/base/random.h"
#include "core/discrepancy/catalogue.h"
#include "tests/core/discrepancy/effect_part.h"
#include "tests/support/outside_folder.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

/// A machine that can have every effect of the catalogue.
MachineDescription everyMachine() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-C'-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[0,480],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0},
           "scale":"linear_scale","datum_mm":0},
          {"name":"Y","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10},"scale":"linear_scale"},
          {"name":"Z","travel_mm":[0,400],"drive":{"type":"ball_screw","pitch_mm":10,"fixed_bearing_mm":0}}],
  "table":{"centre_mm":[240,200]},"column":{"base_mm":-180},"crossbeam":{"axis":"Y","from_mm":0,"to_mm":400},
  "rotary":[{"name":"C","centre_mm":[240,200,0]}],
  "artefacts":[{"id":"bar","kind":"hole_bar","nominal_positions_mm":[0,60,130],"reference_hole":"H1",
                "reference_in_table_mm":[-150,0,0],"direction_at_c0":[1,0,0],"expansion_um_per_m_K":11.5,
                "hole_diameter_mm":10}],
  "temperature_sensors":[{"name":"T_spindle_degC","place":"front bearing"},{"name":"T_room_degC","place":"room"},
   {"name":"T_front_degC","place":"column front"},{"name":"T_rear_degC","place":"column rear"},
   {"name":"T_table_degC","place":"table"}]})",
                      "machine.json"),
      "machine.json");
}

OperatingLog everyLog() {
  Random random(3);
  std::vector<double> time;
  for (int i = 0; i < 400; ++i) time.push_back(60.0 * i);
  OperatingLog log(time);
  const auto steps = [&](double size) {
    std::vector<double> v;
    double level = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
      if (i % 40 == 20) level = size * static_cast<double>(random.index(4));
      v.push_back(level);
    }
    return v;
  };
  for (const char* name : {"spindle_rpm", "feed_x_mm_min", "feed_y_mm_min", "feed_z_mm_min"}) {
    log.setSignal(name, steps(1500.0));
  }
  for (const char* name : {"pos_x_mm", "pos_y_mm", "pos_z_mm"}) log.setSignal(name, steps(100.0));
  log.setSignal("speed_c_rpm", steps(10.0));
  std::vector<double> on = steps(1.0);
  for (double& v : on) v = v > 0.0 ? 1.0 : 0.0;
  log.setSignal("coolant", on);
  log.setSignal("instrument_on", std::vector<double>(time.size(), 1.0));
  for (const char* name : {"T_spindle_degC", "T_room_degC", "T_front_degC", "T_rear_degC", "T_table_degC"}) {
    std::vector<double> v;
    const double period = random.uniform(3000.0, 9000.0);
    for (const double t : time) v.push_back(20.0 + std::sin(t / period) + random.normal(0.0, 0.02));
    log.setSignal(name, v);
  }
  return log;
}

TEST(EffectModel, EveryVariantOfEveryFamilySurvivesSavingAndLoading) {
  const testing::TempFolder folder;
  const MachineDescription machine = everyMachine();
  const OperatingLog log = everyLog();
  const auto drivers = std::make_shared<DriverTable>(machine, &log);
  CatalogueContext context;
  context.machine = &machine;
  context.drivers = drivers.get();
  context.points = {"F1", "F2"};
  context.varying_approach = {"x", "y", "z"};
  context.c_varies = true;
  context.position_varies = true;
  const std::vector<Effect> catalogue = effectCatalogue(context);
  std::set<std::string> families;
  Random random(7);
  for (const Effect& effect : catalogue) {
    families.insert(effect.id.substr(0, effect.id.find('.')));
    EXPECT_FALSE(effect.variants.empty()) << effect.id;
    EXPECT_FALSE(effect.physics.empty()) << effect.id;
    for (const EffectVariant& variant : effect.variants) {
      ModelEffect e;
      e.effect = effect;
      e.variant = variant;
      for (const std::string& name : parameterNames(variant)) {
        e.parameters.push_back(name == "onset_s" ? 5000.0 : random.uniform(300.0, 4000.0));
        e.parameter_uncertainty.push_back(10.0);
      }
      e.gains = Eigen::VectorXd(static_cast<Eigen::Index>(variant.inputs.size() * effect.shape.size()));
      for (double& g : e.gains) g = random.normal();
      e.gain_uncertainty = 0.1 * e.gains.cwiseAbs();
      e.source = "a test";
      const auto unknowns = e.gains.size() + static_cast<Eigen::Index>(e.parameters.size());
      e.covariance = 0.04 * Eigen::MatrixXd::Identity(unknowns, unknowns);
      const EffectModel model(drivers, {e});
      const auto file = folder.path() / "model.json";
      std::ofstream(file) << model.json().dump(2);
      const auto loaded = EffectModel::read(file, machine, &log, context.points);
      ASSERT_EQ(loaded->effects().size(), 1u) << effect.id;
      EXPECT_EQ(loaded->json(), model.json()) << effect.id;
      double largest = 0.0;
      DeviationQuery reference;
      reference.time_s = 9000.0;
      reference.point = "F1";
      reference.position_mm = {240.0, 200.0, 100.0};
      for (int i = 0; i < 12; ++i) {
        DeviationQuery q;
        q.time_s = random.uniform(0.0, 23000.0);
        q.point = i % 2 == 0 ? "F1" : effect.id.substr(effect.id.rfind('.') + 1);
        q.position_mm = {random.uniform(0.0, 480.0), random.uniform(0.0, 400.0), random.uniform(0.0, 400.0)};
        q.c_deg = 90.0 * static_cast<double>(random.index(4));
        q.approach = {1.0, -1.0, 1.0};
        Observation row;
        row.time_s = q.time_s;
        row.point = q.point;
        row.position_mm = q.position_mm;
        row.c_deg = q.c_deg;
        row.approach = q.approach;
        for (const Component c : all_components) {
          row.component = c;
          const PredictedComponent predicted = model.predict(q, c);
          const double value = predicted.value;
          // For many rows at once the same as one by one.
          EXPECT_NEAR(effectPart(model, {&row, 1})[0], value, 1e-9 * (1.0 + std::abs(value))) << effect.id;
          EXPECT_NEAR(model.effectSigma({&row, 1})[0], predicted.sigma, 1e-9 * (1.0 + predicted.sigma)) << effect.id;
          largest = std::max(largest, std::abs(value));
          EXPECT_EQ(loaded->predict(q, c).value, value) << effect.id;
          const PredictedComponent at_reference = model.predict(reference, c);
          const PredictedComponent change = model.predictChange(q, reference, c);
          EXPECT_NEAR(change.value, value - at_reference.value, 1e-9 * (1.0 + std::abs(value))) << effect.id;
          EXPECT_LE(change.sigma, predicted.sigma + at_reference.sigma + 1e-9) << effect.id;
          EXPECT_GE(change.sigma, std::abs(predicted.sigma - at_reference.sigma) - 1e-9) << effect.id;
          EXPECT_EQ(model.predictChange(q, q, c).sigma, 0.0) << effect.id;
        }
      }
      EXPECT_GT(largest, 0.0) << effect.id << " predicts nothing at all";
    }
  }
  // One family for every line of the catalogue.
  for (const char* family : {"spindle", "head", "column", "ball_screw", "scale", "table", "frame", "squareness",
                             "crossbeam", "ambient", "instrument", "fixture", "periodic", "backlash", "coolant",
                             "external_heat", "heat_source", "rotary", "artefact"}) {
    EXPECT_TRUE(families.contains(family)) << family;
  }
}

TEST(EffectModel, SaysWhichParametersItNeeds) {
  const testing::TempFolder folder;
  const MachineDescription machine = everyMachine();
  const OperatingLog log = everyLog();
  const auto file = folder.path() / "model.json";
  const auto refusal = [&](const std::string& parameters) -> std::string {
    std::ofstream(file) << R"({"format":"spindrift-error-model","version":1,"effects":[{"id":"ambient.drift.x",
      "parameters":)" << parameters
                        << "}]}";
    try {
      (void)EffectModel::read(file, machine, &log, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(R"({"gain_um_per_K":1.0,"tau_s":600})"), "");
  EXPECT_NE(refusal(R"({"gain_um_per_K":1.0,"tau":600})").find("gain_um_per_K and tau_s"), std::string::npos);
  EXPECT_NE(refusal(R"({"gain_um_per_K":1.0,"tau_s":-5})").find("tau_s"), std::string::npos);
}

/// Written by hand, without inputs: all names that are given count, and nothing that is given is lost.
TEST(EffectModel, ParametersSayInWhichWayAnEffectIsDriven) {
  const testing::TempFolder folder;
  const MachineDescription machine = everyMachine();
  const OperatingLog log = everyLog();
  const auto file = folder.path() / "model.json";
  const auto read = [&](const std::string& id, const std::string& parameters) {
    std::ofstream(file) << fmt::format(
        R"({{"format":"spindrift-error-model","version":1,"effects":[{{"id":"{}","parameters":{}}}]}})", id,
        parameters);
    return EffectModel::read(file, machine, &log, {})->effects().front();
  };
  const ModelEffect both =
      read("ball_screw.expansion.z",
           R"({"gain_um_per_m_per_m_per_min":5,"tau_s":3000,"gain_um_per_m_per_K":4,"tau_2_s":1800})");
  ASSERT_EQ(both.variant.inputs.size(), 2U);
  EXPECT_EQ(both.gains[0], 5.0);
  EXPECT_EQ(both.gains[1], 4.0);
  EXPECT_EQ(both.parameters[1], 1800.0);
  EXPECT_EQ(read("ball_screw.expansion.z", R"({"gain_um_per_m_per_m_per_min":5,"tau_s":3000})").variant.inputs.size(),
            1U);
  // What is not written of a gain is zero: here the constant that a shifted origin adds.
  const ModelEffect turn = read("squareness.drift.c0y", R"({"gain_urad_per_K":3,"tau_s":1800})");
  EXPECT_EQ(turn.gains[0], 3.0);
  EXPECT_EQ(turn.gains.tail(turn.gains.size() - 1).norm(), 0.0);
  const std::string said = testing::refusal(
      [&] { (void)read("ball_screw.expansion.z", R"({"gain_um_per_m_per_m_per_min":5,"tau_s":3000,"tau_9_s":1})"); });
  EXPECT_NE(said.find("tau_9_s"), std::string::npos) << said;
}

TEST(EffectModel, RefusesADriverThatTheLogDoesNotHold) {
  const testing::TempFolder folder;
  const MachineDescription machine = everyMachine();
  const OperatingLog log = everyLog();
  const auto file = folder.path() / "model.json";
  std::ofstream(file) << R"({"format":"spindrift-error-model","version":1,"effects":[{"id":"ambient.drift.x",
    "parameters":{"gain_um_per_K":1.0,"tau_s":600},"inputs":[{"driver":"T_hall_degC","dynamics":"lag"}]}]})";
  EXPECT_THROW((void)EffectModel::read(file, machine, &log, {}), InputError);
}

TEST(EffectModel, HeatWhereTheHeadStoodMovesTheToolAlongZ) {
  const MachineDescription machine = everyMachine();
  const OperatingLog log = everyLog();
  const DriverTable drivers(machine, &log);
  CatalogueContext context;
  context.machine = &machine;
  context.drivers = &drivers;
  for (const Effect& effect : effectCatalogue(context)) {
    if (!effect.id.starts_with("heat_source.")) continue;
    for (const Component c : all_components) {
      EXPECT_EQ(effect.shape[0].value({}, c), c == Component::EZ ? 1.0 : 0.0) << effect.id;
    }
    ASSERT_FALSE(effect.variants.empty());
    EXPECT_TRUE(effect.variants[0].inputs[0].driver.ends_with(std::string("pos_") + effect.id.back()));
  }
}

TEST(EffectModel, TheTableLiesInTheFolderOfTheModel) {
  const std::string table = "time_s,point,component,predicted\n0,F1,EX,1\n10,F1,EX,2\n";
  const testing::OutsideFolder outside("simulation.csv", table);
  const MachineDescription machine = everyMachine();
  const auto said = [&](const std::string& name) {
    const nlohmann::json model = {
        {"format", "spindrift-error-model"}, {"version", 1}, {"effects", nlohmann::json::array()}, {"table", name}};
    return testing::refusal(
        [&] { (void)EffectModel::read(outside.write("model.json", model.dump()), machine, nullptr, {"F1"}); });
  };
  for (const std::string& name : outside.names()) EXPECT_THAT(said(name), HasSubstr("inside the folder")) << name;
  (void)outside.write("sub/simulation.csv", table);
  EXPECT_EQ(said("sub/simulation.csv"), "");
}

}  // namespace
}  // namespace spindrift
