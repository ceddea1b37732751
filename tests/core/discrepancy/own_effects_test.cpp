// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/discrepancy/own_effects.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

#include "core/base/job_context.h"
#include "core/base/random.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

/// effects.json with these effects.
std::string fileOf(const std::string& effects, bool built_in = false) {
  return fmt::format(R"({{"format":"spindrift-effects","version":1,"built_in":{},"effects":[{}]}})", built_in, effects);
}

/// An effect that is constant in time, as it stands in the file.
std::string steady(const std::string& id, const std::string& shape) {
  return fmt::format(
      R"({{"id":"{}","title":"the {}","physics":"p","drivers":[],"dynamics":"none","shape":[{}],"sign":0,"contains":[]}})",
      id, id, shape);
}

std::string refusalOf(const std::string& text) {
  try {
    (void)OwnEffects::parse(text, "effects.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// Points measured once each, at random angles: x and y in degrees, z = +1 or -1, all in EA and EB.
std::vector<Observation> sky(std::size_t count, Random& random, double sigma) {
  std::vector<Observation> rows;
  for (std::size_t i = 0; i < count; ++i) {
    Observation o;
    o.time_s = 30.0 * static_cast<double>(i);
    o.state = fmt::format("P{}", i);
    o.point = fmt::format("S{}", i);
    o.position_mm = {random.uniform(-80.0, 80.0), random.uniform(-20.0, 80.0), random.index(2) == 0 ? 1.0 : -1.0};
    o.approach = {random.index(2) == 0 ? 1.0 : -1.0, random.index(2) == 0 ? 1.0 : -1.0, 0.0};
    o.sigma = sigma;
    if (i % 3 == 2) o.use = ObservationUse::Holdout;
    for (const Component c : {Component::EA, Component::EB}) {
      o.component = c;
      o.value = random.normal(0.0, sigma);
      rows.push_back(o);
    }
  }
  return rows;
}

const char* const mount = R"j(
  {"id":"collimation","shape":[{"gain_unit":"urad","EA":"z"}]},
  {"id":"perpendicularity","shape":[{"gain_unit":"urad","EA":"z*sin(y*_pi/180)"}]},
  {"id":"hour_angle.zero","shape":[{"gain_unit":"urad","EA":"cos(y*_pi/180)"}]},
  {"id":"declination.zero","shape":[{"gain_unit":"urad","EB":"z"}]},
  {"id":"azimuth","shape":[{"gain_unit":"urad","EA":"-cos(x*_pi/180)*sin(y*_pi/180)","EB":"sin(x*_pi/180)"}]},
  {"id":"elevation","shape":[{"gain_unit":"urad","EA":"sin(x*_pi/180)*sin(y*_pi/180)","EB":"cos(x*_pi/180)"}]},
  {"id":"flexure","shape":[{"gain_unit":"urad","EA":"0.78*sin(x*_pi/180)",
                            "EB":"0.78*cos(x*_pi/180)*sin(y*_pi/180)-0.63*cos(y*_pi/180)"}]},
  {"id":"circle","shape":[{"gain_unit":"urad","EB":"z*sin(y*_pi/180)"},{"gain_unit":"urad","EB":"cos(y*_pi/180)"}]},
  {"id":"backlash","shape":[{"gain_unit":"urad","EB":"diry"}]},
  {"id":"slip","dynamics":"step","shape":[{"gain_unit":"urad","EA":"cos(y*_pi/180)"}],"contains":["hour_angle.zero"]},
  {"id":"drift","drivers":["elapsed_h"],"shape":[{"gain_unit":"urad/h","EB":"z"}]})j";

MachineDescription frame() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[-180,180]},{"name":"Y","travel_mm":[-90,90]},{"name":"Z","travel_mm":[-1,1]}]})",
                      "machine.json"),
      "machine.json");
}

DiscrepancyInput inputOf(std::vector<Observation> rows, const std::string& file, bool absolute = true) {
  DiscrepancyInput input;
  input.machine = frame();
  input.observations.rows = std::move(rows);
  input.observations.absolute = input.absolute = absolute;
  input.predicted.assign(input.observations.rows.size(), 0.0);
  input.simulation_gain_uncertainty = 0.0;
  input.own = OwnEffects::parse(file, "effects.json");
  std::vector<double> time;
  std::vector<double> hours;
  for (const Observation& o : input.observations.rows) {
    if (!time.empty() && o.time_s == time.back()) continue;
    time.push_back(o.time_s);
    hours.push_back(o.time_s / 3600.0);
  }
  OperatingLog log(time);
  log.setSignal("elapsed_h", hours);
  input.log = log;
  return input;
}

/// Adds gain x shape column 0 of an own effect, from a time on.
void hide(DiscrepancyInput& input, const std::string& id, double gain, double from_s = -1.0) {
  const OwnEffect* own = input.own->find(id);
  ASSERT_NE(own, nullptr);
  for (Observation& o : input.observations.rows) {
    if (o.time_s < from_s) continue;
    double q = 1.0;
    if (!own->drivers.empty()) q = o.time_s / 3600.0;
    o.value += gain * q * own->effect.shape[0].value(DeviationQuery::of(o), o.component);
  }
}

DiscrepancyResult search(const DiscrepancyInput& input) {
  JobContext job;
  return findDiscrepancy(input, {}, job);
}

std::vector<std::string> namesOf(const DiscrepancyResult& result) {
  std::vector<std::string> out;
  for (const FoundEffect& e : result.effects) out.push_back(e.id);
  return out;
}

TEST(OwnEffects, EvaluatesItsExpressionsInTheUnitsOfTheFile) {
  const auto own = OwnEffects::parse(
      fileOf(R"({"id":"a","shape":[{"gain_unit":"um","EX":"x + 2*y - z + sin(c) + 10*dirx - 20*diry + 40*dirz",
               "EC":"1"},{"gain_unit":"urad","EA":"2"}]})"),
      "effects.json");
  DeviationQuery q;
  q.position_mm = {1.0, 2.0, 3.0};
  q.c_deg = 30.0;
  q.approach = {1.0, -1.0, 1.0};
  const auto& shape = own->effects().front().effect.shape;
  ASSERT_EQ(shape.size(), 2U);
  EXPECT_NEAR(shape[0].value(q, Component::EX), 1.0 + 4.0 - 3.0 + 0.5 + 10.0 + 20.0 + 40.0, 1e-12);
  EXPECT_EQ(shape[0].value(q, Component::EC), 1.0);
  EXPECT_EQ(shape[0].value(q, Component::EY), 0.0);
  EXPECT_EQ(shape[1].value(q, Component::EA), 2.0);
  EXPECT_EQ(shape[1].value(q, Component::EX), 0.0);
  EXPECT_EQ(own->effects().front().effect.title, "a");
}

TEST(OwnEffects, ReadsDriversAsAlternativesAndInputsTogether) {
  const std::string file = fileOf(
      R"({"id":"a","drivers":["spindle_rpm^1.5",["T_room_degC","spindle_rpm"]],"dynamics":"lag","tau_s":[60,9000],
          "shape":[{"gain_unit":"um","EZ":"1"}],"sign":-1})");
  const auto own = OwnEffects::parse(file, "effects.json");
  OperatingLog log(std::vector<double>{0.0, 100.0, 200.0});
  log.setSignal("spindle_rpm", {4.0, 9.0, 0.0});
  log.setSignal("T_room_degC", {22.0, 24.0, 21.0});
  for (const bool absolute : {false, true}) {
    DriverTable drivers(frame(), &log);
    const std::vector<Effect> bound = own->bind(drivers, &log, 20.0, absolute);
    ASSERT_EQ(bound.size(), 1U);
    const Effect& e = bound.front();
    ASSERT_EQ(e.variants.size(), 2U);
    EXPECT_EQ(e.sign, -1);
    ASSERT_TRUE(e.tau_s.has_value());
    EXPECT_EQ((*e.tau_s)[1], 9000.0);
    ASSERT_EQ(e.variants[1].inputs.size(), 2U);
    EXPECT_EQ(driverAsWritten(e.variants[0].inputs[0].driver), "spindle_rpm^1.5");
    const Driver* power = drivers.find(e.variants[0].inputs[0].driver);
    ASSERT_NE(power, nullptr);
    // As logged, and it holds until the next row.
    EXPECT_THAT(power->values, ::testing::ElementsAre(::testing::DoubleEq(8.0), ::testing::DoubleEq(27.0), 0.0));
    EXPECT_FALSE(power->linear);
    const double between[1] = {150.0};
    EXPECT_DOUBLE_EQ(drivers.response(*power, 0.0, -1.0, between)[0], 27.0);
    const Driver* room = drivers.find(e.variants[1].inputs[0].driver);
    ASSERT_NE(room, nullptr);
    const double zero = absolute ? 20.0 : 22.0;
    EXPECT_THAT(room->values, ::testing::ElementsAre(22.0 - zero, 24.0 - zero, 21.0 - zero));
    EXPECT_DOUBLE_EQ(drivers.response(*room, 0.0, -1.0, between)[0], 22.5 - zero);
    // An absolute temperature was there before the log began.
    const double start[1] = {0.0};
    EXPECT_DOUBLE_EQ(drivers.response(*room, 1000.0, -1.0, start)[0], absolute ? 2.0 : 0.0);
  }
}

TEST(OwnEffects, SaysWhatIsWrongAndWhere) {
  const std::string good = R"("shape":[{"gain_unit":"um","EX":"1"}])";
  const auto one = [&](const std::string& text) { return refusalOf(fileOf(text)); };
  EXPECT_EQ(one(R"({"id":"a",)" + good + "}"), "");
  EXPECT_THAT(one(R"({"id":"a","shape":[{"gain_unit":"um","EX":"2*(x"}]})"),
              ::testing::AllOf(HasSubstr("effects.json"), HasSubstr("$.effects[0].shape[0].EX"), HasSubstr("2*(x"),
                               HasSubstr("allowed:")));
  EXPECT_THAT(one(R"({"id":"a","shape":[{"gain_unit":"um","EX":"x*speed"}]})"),
              ::testing::AllOf(HasSubstr("\"speed\""), HasSubstr("dirz")));
  EXPECT_THAT(one(R"({"id":"a",)" + good + R"(},{"id":"a",)" + good + "}"),
              ::testing::AllOf(HasSubstr("$.effects[1].id"), HasSubstr("once")));
  EXPECT_THAT(one(R"({"id":"a","shape":{"gain_unit":"um","EX":"1"}})"), HasSubstr("$.effects[0].shape"));
  EXPECT_THAT(one(R"({"id":"a","shape":[]})"), HasSubstr("at least one"));
  EXPECT_THAT(one(R"({"id":"a","shape":[{"gain_unit":"um","EQ":"1"}]})"), HasSubstr("EX, EY, EZ"));
  EXPECT_THAT(one(R"({"id":"a","drivers":"speed",)" + good + "}"), HasSubstr("$.effects[0].drivers"));
  EXPECT_THAT(one(R"({"id":"a","drivers":["s"],"dynamics":"lag","tau_s":[2000,60],)" + good + "}"),
              ::testing::AllOf(HasSubstr("$.effects[0].tau_s"), HasSubstr("smaller first")));
  EXPECT_THAT(one(R"({"id":"a","sign":2,)" + good + "}"),
              ::testing::AllOf(HasSubstr("$.effects[0].sign"), HasSubstr("-1, 0 or 1")));
  EXPECT_THAT(one(R"({"id":"a","dynamics":"lag",)" + good + "}"), HasSubstr("$.effects[0].dynamics"));
  EXPECT_THAT(one(R"({"id":"a","drivers":["s"],"dynamics":"step",)" + good + "}"), HasSubstr("without drivers"));
  EXPECT_THAT(one(R"({"id":"a","dynamics":"slow",)" + good + "}"), HasSubstr("none"));
  EXPECT_THAT(one(R"({"id":"a","contains":["b"],)" + good + "}"), HasSubstr("$.effects[0].contains[0]"));
  EXPECT_THAT(refusalOf(R"({"format":"spindrift-effects","version":2,"effects":[]})"), HasSubstr("version"));
  EXPECT_THAT(refusalOf(R"({"format":"spindrift-effects","version":1,"effects":{}})"), HasSubstr("$.effects"));
  // An id of the catalogue is taken, unless the catalogue is left out.
  EXPECT_THAT(refusalOf(fileOf(R"({"id":"spindle.growth.z",)" + good + "}", true)), HasSubstr("built_in"));
  EXPECT_EQ(refusalOf(fileOf(R"({"id":"spindle.growth.z",)" + good + "}", false)), "");
}

TEST(OwnEffects, SaysWhichDriverTheLogDoesNotHave) {
  OperatingLog log(std::vector<double>{0.0, 100.0});
  log.setSignal("speed", {-1.0, 2.0});
  const auto refusal = [&](const std::string& driver, const OperatingLog* given) -> std::string {
    const auto own = OwnEffects::parse(
        fileOf(R"({"id":"a","drivers":[")" + driver + R"("],"shape":[{"gain_unit":"um","EX":"1"}]})"), "effects.json");
    DriverTable drivers(frame(), given);
    try {
      (void)own->bind(drivers, given, 20.0, true);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal("speed", &log), "");
  EXPECT_EQ(refusal("speed^2", &log), "");
  EXPECT_THAT(refusal("sped", &log),
              ::testing::AllOf(HasSubstr("$.effects[0].drivers[0]"), HasSubstr("sped"), HasSubstr("allowed: speed")));
  EXPECT_THAT(refusal("speed^x", &log), HasSubstr("power"));
  EXPECT_THAT(refusal("speed^1.5", &log), ::testing::AllOf(HasSubstr("no value at 0 s"), HasSubstr("-1")));
  EXPECT_THAT(refusal("speed", nullptr), HasSubstr("log.csv"));
}

TEST(OwnEffects, NamesThePointWhereAnExpressionHasNoValue) {
  Random random(3);
  DiscrepancyInput input = inputOf(sky(60, random, 1.0), fileOf(steady("ok", R"({"gain_unit":"um","EA":"1/z"})")));
  EXPECT_NO_THROW((void)search(input));
  input.observations.rows[14].position_mm.z() = 0.0;
  try {
    (void)search(input);
    FAIL() << "a division by zero went unseen";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(HasSubstr("$.effects[0].shape[0].EA"), HasSubstr("infinite at point S7"),
                                               HasSubstr("EA"), HasSubstr("z 0 mm")));
  }
  input.observations.rows[14].use = ObservationUse::Exclude;
  EXPECT_NO_THROW((void)search(input));
}

TEST(OwnEffects, LeavesOutWhatIsZeroEverywhereAndSaysSo) {
  Random random(4);
  DiscrepancyInput input =
      inputOf(sky(120, random, 1.0), fileOf(steady("dead", R"({"gain_unit":"um","EX":"1"})") + "," +
                                            steady("alive", R"({"gain_unit":"um","EA":"z"})")));
  hide(input, "alive", 3.0);
  const DiscrepancyResult result = search(input);
  EXPECT_THAT(namesOf(result), ::testing::ElementsAre("alive"));
  EXPECT_THAT(result.warnings,
              ::testing::Contains(::testing::AllOf(HasSubstr("zero at every point"), HasSubstr("dead"))));
}

TEST(OwnEffects, TermsOfAMountAreRecoveredFromPointsMeasuredOnce) {
  const std::vector<std::pair<std::string, double>> terms{
      {"collimation", 90.0}, {"perpendicularity", -120.0}, {"hour_angle.zero", 80.0}, {"declination.zero", 70.0},
      {"azimuth", 90.0},     {"elevation", -100.0},        {"flexure", 120.0},        {"backlash", 60.0},
      {"drift", 90.0}};
  int seed = 10;
  for (const auto& [id, gain] : terms) {
    Random random(static_cast<std::uint64_t>(++seed));
    DiscrepancyInput input = inputOf(sky(300, random, 100.0), fileOf(mount));
    hide(input, id, gain);
    const DiscrepancyResult result = search(input);
    ASSERT_EQ(result.effects.size(), 1U) << id << ": " << result.summary();
    const FoundEffect& found = result.effects.front();
    EXPECT_TRUE(found.id == id || std::count(found.rivals.begin(), found.rivals.end(), id) == 1) << result.summary();
    EXPECT_LE(found.rivals.size(), 2U);
    if (found.id != id) continue;
    const FittedParameter& p = found.parameters.front();
    EXPECT_EQ(p.name, id == "drift" ? "gain_urad/h" : "gain_urad");
    EXPECT_NEAR(p.value, gain, 4.0 * p.standard_uncertainty) << id;
    EXPECT_LT(p.standard_uncertainty, 0.3 * std::abs(gain)) << id;
    EXPECT_LT(result.gap.heldout_rms_after_um, result.gap.heldout_rms_before_um) << id;
    EXPECT_TRUE(result.gap.rotations);
  }
}

TEST(OwnEffects, AStepAtAnUnknownTimeIsFound) {
  Random random(31);
  DiscrepancyInput input = inputOf(sky(300, random, 100.0), fileOf(mount));
  hide(input, "slip", 200.0, 5000.0);
  const DiscrepancyResult result = search(input);
  ASSERT_THAT(namesOf(result), ::testing::ElementsAre("slip")) << result.summary();
  const auto& parameters = result.effects.front().parameters;
  const auto onset =
      std::find_if(parameters.begin(), parameters.end(), [](const auto& p) { return p.name == "onset_s"; });
  ASSERT_NE(onset, parameters.end());
  EXPECT_NEAR(onset->value, 5000.0, 300.0);
}

TEST(OwnEffects, NothingHiddenIsNothingNamed) {
  int named = 0;
  for (int seed = 0; seed < 8; ++seed) {
    Random random(static_cast<std::uint64_t>(100 + seed));
    const DiscrepancyInput input = inputOf(sky(300, random, 100.0), fileOf(mount));
    const DiscrepancyResult result = search(input);
    if (!result.effects.empty()) ++named;
    EXPECT_NE(result.verdict, DiscrepancyVerdict::Ambiguous);
  }
  EXPECT_EQ(named, 0);
}

TEST(OwnEffects, TwoOfTheSameShapeAndDriverAreRivals) {
  Random random(41);
  DiscrepancyInput input =
      inputOf(sky(200, random, 100.0),
              fileOf(std::string(mount) + "," + steady("collimation.twin", R"({"gain_unit":"urad","EA":"-2*z"})")));
  hide(input, "collimation", 90.0);
  const DiscrepancyResult result = search(input);
  ASSERT_EQ(result.effects.size(), 1U) << result.summary();
  EXPECT_EQ(result.verdict, DiscrepancyVerdict::Ambiguous);
  const FoundEffect& found = result.effects.front();
  ASSERT_EQ(found.rivals.size(), 1U);
  std::vector<std::string> both{found.id, found.rivals.front()};
  EXPECT_THAT(both, ::testing::UnorderedElementsAre("collimation", "collimation.twin"));
  EXPECT_THAT(result.warnings, ::testing::Contains(::testing::AllOf(HasSubstr("collimation.twin"), HasSubstr("same"))));
}

TEST(OwnEffects, ADriverThroughALagIsFoundBesideTheCatalogue) {
  Random random(51);
  std::vector<Observation> rows;
  std::vector<double> time;
  std::vector<double> heat;
  double level = 0.0;
  for (int i = 0; i < 400; ++i) {
    time.push_back(60.0 * i);
    if (i % 50 == 10) level = static_cast<double>(random.index(5));
    heat.push_back(level);
  }
  OperatingLog log(time);
  log.setSignal("heater_kW", heat);
  double q = 0.0;
  std::size_t row = 0;
  for (int i = 0; i < 40; ++i) {
    const double t = 600.0 * i;
    for (; row < time.size() && time[row] < t; ++row) q += (heat[row] - q) * (1.0 - std::exp(-60.0 / 1500.0));
    for (int p = 0; p < 4; ++p) {
      Observation o;
      o.time_s = t;
      o.state = fmt::format("M{}", i);
      o.point = fmt::format("F{}", p);
      o.position_mm = {50.0 * p, 20.0 * p * p, 0.0};
      o.sigma = 0.3;
      o.component = Component::EX;
      o.value = 3.0 + p + 0.02 * o.position_mm.x() * q + random.normal(0.0, 0.3);
      rows.push_back(o);
    }
  }
  const std::string file = fileOf(
      R"({"id":"heater.bend","drivers":["heater_kW"],"dynamics":"lag","tau_s":[60,9000],
          "shape":[{"gain_unit":"um/mm","EX":"x"}]})",
      true);
  DiscrepancyInput input = inputOf(rows, file, false);
  input.log = log;
  const DiscrepancyResult result = search(input);
  ASSERT_THAT(namesOf(result), ::testing::ElementsAre("heater.bend")) << result.summary();
  EXPECT_THAT(result.effects.front().drivers, HasSubstr("heater_kW (time constant"));
  EXPECT_NEAR(result.effects.front().parameters.front().value, 0.02, 0.002);
  // Saved and read again with the same file.
  const testing::TempFolder folder;
  const auto model = folder.path() / "model.json";
  std::ofstream(model) << result.model->json().dump(2);
  const auto again = EffectModel::read(model, input.machine, &log, input.observations.points(), input.own.get());
  EXPECT_EQ(again->json(), result.model->json());
}

/// 1,000 harmonics of two angles, a sine and a cosine each.
std::string harmonics() {
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    const int kx = i % 25;
    const int ky = 1 + i / 25 % 20;
    const char* component = i < 500 ? "EA" : "EB";
    const std::string angle = fmt::format("({}*x{:+}*y)*_pi/180", kx, ky);
    text += (i == 0 ? "" : ",") +
            steady(fmt::format("harmonic.{}.{}.{}", component, kx, ky),
                   fmt::format(R"j({{"gain_unit":"urad","{}":"sin({})"}},{{"gain_unit":"urad","{}":"cos({})"}})j",
                               component, angle, component, angle));
  }
  return text;
}

TEST(OwnEffects, AThousandOfThemNameNothingByChanceAndStayQuick) {
  const std::string file = fileOf(harmonics());
  for (int seed = 0; seed < 3; ++seed) {
    Random random(static_cast<std::uint64_t>(200 + seed));
    const DiscrepancyInput input = inputOf(sky(500, random, 100.0), file);
    ASSERT_EQ(input.observations.rows.size(), 1000U);
    const auto begin = std::chrono::steady_clock::now();
    const DiscrepancyResult result = search(input);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    RecordProperty("seconds", std::to_string(seconds));
    EXPECT_TRUE(result.effects.empty()) << result.summary();
    EXPECT_LT(seconds, 30.0);
  }
}

TEST(OwnEffects, OneOfAThousandIsFoundWhenItIsThere) {
  Random random(210);
  DiscrepancyInput input = inputOf(sky(500, random, 100.0), fileOf(harmonics()));
  hide(input, "harmonic.EA.7.3", 90.0);
  const auto begin = std::chrono::steady_clock::now();
  const DiscrepancyResult result = search(input);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_THAT(namesOf(result), ::testing::ElementsAre("harmonic.EA.7.3")) << result.summary();
  EXPECT_LT(seconds, 30.0);
}

}  // namespace
}  // namespace spindrift
