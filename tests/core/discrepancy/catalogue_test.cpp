// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/discrepancy/catalogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/base/random.h"
#include "core/discrepancy/effect_listing.h"
#include "core/discrepancy/effect_relations.h"
#include "core/discrepancy/effect_titles.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

using ::testing::UnorderedElementsAreArray;

TEST(Catalogue, EveryFileOfTheFolderIsAFamily) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(spindrift::testing::sourceFolder().string() + "/core/discrepancy/effects")) {
    if (entry.path().extension() == ".cpp") ++files;
  }
  EXPECT_EQ(effectFamilies().size(), files);
}

TEST(Catalogue, HoldsEveryEffectOfEffectsMd) {
  std::set<std::string> ids;
  for (const Effect& effect : everyEffect()) EXPECT_TRUE(ids.insert(effect.id).second) << effect.id;
  std::set<std::string> expected{
      "spindle.growth.z",     "spindle.centrifugal.z", "spindle.drift.x",  "spindle.drift.y",      "head.tilt.a",
      "head.tilt.b",          "column.bending.a",      "column.bending.b", "column.expansion.z",   "table.expansion.xy",
      "frame.rotation.a",     "frame.rotation.b",      "frame.rotation.c", "squareness.drift.c0y", "crossbeam.sag.z",
      "fixture.slip.<point>", "external_heat.a",       "external_heat.b",  "external_heat.z",      "rotary.drift.x0c",
      "rotary.drift.y0c",     "rotary.drift.z0t",      "rotary.tilt.a0c",  "rotary.tilt.b0c",      "rotary.tilt.c0c",
      "rotary.expansion.r0t", "artefact.expansion"};
  for (const char* stem :
       {"ball_screw.expansion.", "ball_screw.nonuniform.", "scale.expansion.", "ambient.drift.", "instrument.warm_up.",
        "periodic.pitch.", "backlash.", "coolant.shock.", "heat_source.position."}) {
    for (const char* axis : axis_letters) expected.insert(std::string(stem) + axis);
  }
  EXPECT_EQ(ids, expected);
}

TEST(Catalogue, EveryEffectSaysEverythingAboutItself) {
  for (const Effect& effect : everyEffect()) {
    EXPECT_FALSE(effect.title.empty()) << effect.id;
    EXPECT_EQ(effect.title.find("%1") != std::string::npos, !effect.subject.empty()) << effect.id;
    EXPECT_FALSE(effect.physics.empty()) << effect.id;
    EXPECT_FALSE(effect.formula.empty()) << effect.id;
    EXPECT_FALSE(effect.shape.empty()) << effect.id;
    EXPECT_FALSE(effect.variants.empty()) << effect.id;
    EXPECT_FALSE(effect.own) << effect.id;
    EXPECT_EQ(effect.references.empty(), effect.id.starts_with("fixture.")) << effect.id;
    EXPECT_EQ(effectTitle(effect.id), titleOf(effect));
  }
  EXPECT_EQ(effectTitle("ball_screw.expansion.y"), "thermal expansion of the Y ball screw");
  EXPECT_EQ(effectTitle("fixture.slip.F.12"), "slip of point F.12 in its fixture");
  EXPECT_EQ(effectTitle("no.effect"), "no.effect");
  EXPECT_FALSE(effectTitleOf("fixture.slip.").has_value());
}

/// What was set by hand before it was computed. Not among it any more: that a rotation of the frame holds a tilt of the
/// head, which is false as soon as rotations are measured or the Z axis is a ram, and that it holds what follows the
/// square of the speed, which no temperature does; and a screw that is warmer where its nut travels, which grows with
/// the square of the distance from its bearing alone. New: what the temperature of the table moves is part of what it
/// turns.
TEST(Catalogue, WhichEffectHoldsWhichIsComputed) {
  const std::map<std::string, std::vector<std::string>> expected{
      {"spindle.growth.z", {"spindle.centrifugal.z"}},
      {"column.expansion.z", {"spindle.growth.z", "ambient.drift.z", "scale.expansion.z", "spindle.centrifugal.z"}},
      {"head.tilt.a", {"spindle.drift.y", "spindle.growth.z", "spindle.centrifugal.z"}},
      {"head.tilt.b", {"spindle.drift.x", "spindle.growth.z", "spindle.centrifugal.z"}},
      {"heat_source.position.x", {"spindle.growth.z", "spindle.centrifugal.z"}},
      {"heat_source.position.y", {"spindle.growth.z", "spindle.centrifugal.z"}},
      {"heat_source.position.z", {"spindle.growth.z", "spindle.centrifugal.z"}},
      {"frame.rotation.a",
       {"ambient.drift.y", "spindle.drift.y", "ambient.drift.z", "spindle.growth.z", "rotary.drift.y0c",
        "rotary.drift.z0t", "rotary.tilt.a0c"}},
      {"frame.rotation.b",
       {"ambient.drift.x", "spindle.drift.x", "ambient.drift.z", "spindle.growth.z", "rotary.drift.x0c",
        "rotary.drift.z0t", "rotary.tilt.b0c"}},
      {"frame.rotation.c",
       {"ambient.drift.x", "spindle.drift.x", "ambient.drift.y", "spindle.drift.y", "rotary.drift.x0c",
        "rotary.drift.y0c", "rotary.tilt.c0c"}},
      {"squareness.drift.c0y", {"ambient.drift.x", "spindle.drift.x", "rotary.drift.x0c"}}};
  for (const Effect& effect : everyEffect()) {
    const auto found = expected.find(effect.id);
    EXPECT_THAT(effect.contains,
                UnorderedElementsAreArray(found == expected.end() ? std::vector<std::string>{} : found->second))
        << effect.id;
  }
}

/// EFFECTS.md: an origin that machine.json does not state is free; what bends needs to know that there is a column.
TEST(Catalogue, AColumnWhoseBaseIsNotStatedGrowsFromAFreeHeight) {
  const std::string json = R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
      "axes":[{"name":"X","travel_mm":[0,500]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,300]}]})";
  const auto effects = effectsOfMachine(MachineDescription::parse(JsonNode::parse(json, "machine.json"), "m"), {"P1"});
  const auto has = [&](const char* id) {
    return std::any_of(effects.begin(), effects.end(), [&](const Effect& e) { return e.id == id; });
  };
  EXPECT_TRUE(has("column.expansion.z"));
  for (const char* id : {"column.bending.a", "column.bending.b", "external_heat.a", "crossbeam.sag.z"})
    EXPECT_FALSE(has(id)) << id;
}

TEST(Catalogue, AScrewWhoseBearingIsNotKnownHoldsTheUniformOneInTheOtherOne) {
  const auto screw = [](const char* bearing) {
    const std::string json = R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
      "axes":[{"name":"X","travel_mm":[0,500],"drive":{"type":"ball_screw","pitch_mm":10)" +
                             std::string(bearing) + R"(}},
              {"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,300]}]})";
    const auto effects =
        effectsOfMachine(MachineDescription::parse(JsonNode::parse(json, "machine.json"), "m"), {"P1"});
    return *std::find_if(effects.begin(), effects.end(),
                         [](const Effect& e) { return e.id == "ball_screw.nonuniform.x"; });
  };
  const Effect known = screw(R"(,"fixed_bearing_mm":0)");
  // One gain: of the square, or of what vanishes at both ends. Neither is the uniform screw.
  ASSERT_EQ(known.forms.size(), 2U) << known.formula;
  EXPECT_TRUE(known.contains.empty());
  const std::vector<Effect> apart = formsApart({known});
  ASSERT_EQ(apart.size(), 2U);
  DeviationQuery far;
  far.position_mm.x() = 500.0;
  DeviationQuery middle;
  middle.position_mm.x() = 250.0;
  for (const Effect& form : apart) {
    EXPECT_EQ(form.id, "ball_screw.nonuniform.x");
    ASSERT_EQ(form.shape.size(), 1U);
    EXPECT_EQ(form.choices, 2);
  }
  EXPECT_NEAR(apart[0].shape[0].value(far, Component::EX), 0.25, 1e-12);
  EXPECT_NEAR(apart[1].shape[0].value(far, Component::EX), 0.0, 1e-12);
  EXPECT_NEAR(apart[1].shape[0].value(middle, Component::EX), -0.0625, 1e-12);
  EXPECT_EQ(apart[1].shape[0].value(middle, Component::EY), 0.0);
  const Effect unknown = screw("");
  EXPECT_EQ(unknown.shape.size(), 3U);
  EXPECT_EQ(unknown.contains, std::vector<std::string>{"ball_screw.expansion.x"});
}

Effect driven(const std::string& id, const std::string& driver, Dynamics dynamics) {
  Effect effect;
  effect.id = id;
  effect.variants.push_back({{{driver, dynamics}}, false});
  return effect;
}

TEST(EffectRelations, FollowFromShapesAndDrivers) {
  Random random(5);
  Eigen::MatrixXd one(200, 1);
  for (double& v : one.reshaped()) v = random.normal();
  Eigen::MatrixXd other(200, 1);
  for (double& v : other.reshaped()) v = random.normal();
  Eigen::MatrixXd both(200, 2);
  both << one + 0.5 * other, one - other;
  const std::vector<Effect> effects{driven("lagged", "u", Dynamics::Lag), driven("at once", "u", Dynamics::None),
                                    driven("wide", "u", Dynamics::Lag), driven("elsewhere", "v", Dynamics::Lag),
                                    driven("twin", "u", Dynamics::Lag)};
  const EffectRelations found = effectRelations(effects, {one, one, both, one, -3.0 * one}, false);
  EXPECT_THAT(found.holds[0], ::testing::UnorderedElementsAre(1));
  EXPECT_THAT(found.holds[1], ::testing::IsEmpty());
  EXPECT_THAT(found.holds[2], ::testing::UnorderedElementsAre(0, 1, 4));
  EXPECT_THAT(found.holds[3], ::testing::IsEmpty());
  ASSERT_EQ(found.same.size(), 1U);
  EXPECT_EQ(found.same.front(), std::make_pair(std::size_t{0}, std::size_t{4}));
}

TEST(EffectRelations, AThousandEffectsTakeNoTime) {
  Random random(6);
  std::vector<Effect> effects;
  std::vector<Eigen::MatrixXd> shapes;
  for (int i = 0; i < 1000; ++i) {
    effects.push_back(driven(std::to_string(i), "", Dynamics::None));
    shapes.emplace_back(1000, 2);
    for (double& v : shapes.back().reshaped()) v = random.normal();
  }
  shapes[7] = shapes[3] * 2.0;
  const EffectRelations found = effectRelations(effects, shapes, false);
  ASSERT_EQ(found.same.size(), 1U);
  EXPECT_EQ(found.same.front(), std::make_pair(std::size_t{3}, std::size_t{7}));
}

}  // namespace
}  // namespace spindrift
