// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/probing/artefact_check.h"

#include <gtest/gtest.h>

#include "tests/core/probing/probing_machines.h"

namespace spindrift {
namespace {

using nlohmann::json;
using namespace probing_test;

json machineJson(bool holes) {
  return json::parse(holes ? holeMachineText() : ballMachineText());
}

/// The only finding after one change, with its place.
ArtefactFinding findingAfter(bool holes, const std::function<void(json&, json&)>& spoil) {
  json machine = machineJson(holes);
  spoil(machine["artefacts"][0], machine["styli"]);
  std::vector<ArtefactFinding> all = checkArtefact(machine["artefacts"][0], machine["styli"]);
  const std::vector<ArtefactFinding> styli = checkStyli(machine["styli"]);
  all.insert(all.end(), styli.begin(), styli.end());
  EXPECT_EQ(all.size(), 1U) << (all.size() > 1 ? all[1].sentence : "nothing found");
  return all.empty() ? ArtefactFinding{} : all.front();
}

void expectPlace(const ArtefactFinding& f, const std::string& key, int row, int column, const std::string& part) {
  EXPECT_EQ(f.key, key) << f.sentence;
  EXPECT_EQ(f.row, row) << f.sentence;
  EXPECT_EQ(f.column, column) << f.sentence;
  EXPECT_NE(f.sentence.find(part), std::string::npos) << f.sentence;
  EXPECT_EQ(f.sentence.back(), '.');
}

TEST(ArtefactCheck, GoodOnesHaveNoFindings) {
  for (const bool holes : {true, false}) {
    const json machine = machineJson(holes);
    EXPECT_TRUE(checkArtefact(machine["artefacts"][0], machine["styli"]).empty());
    EXPECT_TRUE(checkStyli(machine["styli"]).empty());
  }
}

TEST(ArtefactCheck, EveryWrongCellOfABarIsNamed) {
  expectPlace(findingAfter(true, [](json& a, json&) { a["nominal_positions_mm"][2] = "abc"; }), "nominal_positions_mm",
              2, 0, "\"abc\"");
  expectPlace(findingAfter(true, [](json& a, json&) { a["nominal_positions_mm"][3] = 37; }), "nominal_positions_mm", 3,
              0, "runs into H2");
  expectPlace(findingAfter(true, [](json& a, json&) { a["hole_diameter_mm"] = -12; }), "hole_diameter_mm", -1, -1,
              "-12");
  expectPlace(findingAfter(true, [](json& a, json&) { a["hole_diameter_mm"] = 3; }), "hole_diameter_mm", -1, -1,
              "does not enter");
  expectPlace(findingAfter(true, [](json& a, json&) { a["reference_hole"] = "H9"; }), "reference_hole", -1, -1,
              "H1 to H7");
  expectPlace(findingAfter(true, [](json& a, json&) { a["reference_in_table_mm"][1] = ""; }), "reference_in_table_mm",
              -1, 1, "nothing");
  expectPlace(findingAfter(true,
                           [](json& a, json&) {
                             a["direction_at_c0"] = {0, 0, 0};
                           }),
              "direction_at_c0", -1, 0, "along the bar");
  expectPlace(findingAfter(true, [](json& a, json&) { a["expansion_um_per_m_K"] = 11500; }), "expansion_um_per_m_K", -1,
              -1, "-5 to 100");
  expectPlace(findingAfter(true, [](json& a, json&) { a["temperature_degC"] = 293; }), "temperature_degC", -1, -1,
              "293");
  expectPlace(findingAfter(true, [](json& a, json&) { a["certificate_uncertainty_um"] = -1; }),
              "certificate_uncertainty_um", -1, -1, "zero or a number above");
  expectPlace(findingAfter(true, [](json& a, json&) { a["id"] = ""; }), "id", -1, -1, "no name");
  const ArtefactFinding inches = findingAfter(true, [](json& a, json&) {
    a["nominal_positions_mm"] = {0, 1.46, 12.5};
    a.erase("hole_diameter_mm");
  });
  EXPECT_FALSE(inches.wrong);
  EXPECT_NE(inches.sentence.find("inches"), std::string::npos);
}

TEST(ArtefactCheck, EveryWrongCellOfBallsAndStyliIsNamed) {
  expectPlace(findingAfter(false, [](json& a, json&) { a["balls"][1]["diameter_mm"] = 0; }), "balls", 1, 1, "is 0");
  expectPlace(findingAfter(false, [](json& a, json&) { a["balls"][2]["id"] = "B1"; }), "balls", 2, 0, "duplicate");
  expectPlace(findingAfter(false, [](json& a, json&) { a["balls"][3]["certified_mm"][2] = "x"; }), "balls", 3, 4,
              "\"x\"");
  expectPlace(findingAfter(false, [](json& a, json&) { a["balls"][0]["certified_mm"][0] = 5; }), "balls", 0, 2,
              "0, 0, 0");
  expectPlace(findingAfter(false,
                           [](json& a, json&) {
                             a["balls"][2]["certified_mm"] = {240, 30, 80};
                           }),
              "balls", 2, 2, "run into each other");
  expectPlace(findingAfter(false, [](json& a, json&) { a["balls"] = json::array(); }), "balls", -1, -1, "no balls");
  expectPlace(findingAfter(false, [](json&, json& s) { s[1]["radius_mm"] = nullptr; }), "styli", 1, 1, "nothing");
  expectPlace(findingAfter(false, [](json&, json& s) { s[2]["id"] = "p0"; }), "styli", 2, 0, "duplicate");
  expectPlace(findingAfter(false, [](json&, json& s) { s[0]["offset_mm"][2] = "1,5"; }), "styli", 0, 4, "\"1,5\"");
}

}  // namespace
}  // namespace spindrift
