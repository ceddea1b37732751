// SPDX-License-Identifier: GPL-3.0-or-later
// Recovery from truth: what is wrong with the machine is found on the part it mills.
#include "core/machine/test_part.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/machine/geometric_errors.h"

namespace spindrift {
namespace {

MachineDescription partMachine() {
  const char* text = R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
    "axes":[{"name":"X","travel_mm":[0,500]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,300]}]})";
  return MachineDescription::parse(JsonNode::parse(text, "machine.json"), "machine.json");
}

using FieldOf = std::function<Eigen::Vector3d(const DeviationQuery&)>;  // um

std::map<std::string, double> milled(const TestPart& part, const FieldOf& field) {
  std::vector<Eigen::Vector3d> deviation;
  for (const DeviationQuery& q : part.points()) deviation.push_back(field(q));
  std::map<std::string, double> out;
  for (const PartCharacteristic& c : part.evaluate(deviation)) {
    EXPECT_TRUE(out.emplace(c.feature + "." + c.characteristic, c.value).second) << c.feature << c.characteristic;
  }
  return out;
}

std::map<std::string, double> milledWith(const std::string& name, double value) {
  const GeometricErrors errors(partMachine());
  const auto found = std::find(errors.names().begin(), errors.names().end(), name);
  const auto index = static_cast<std::size_t>(found - errors.names().begin());
  return milled(TestPart(TestPartOptions::on(partMachine())), [&](const DeviationQuery& q) -> Eigen::Vector3d {
    return 1e3 * value * errors.unit(index, q).translation_mm;
  });
}

TEST(TestPart, APerfectMachineMillsAPerfectPart) {
  const auto found = milled(TestPart(TestPartOptions{}), [](const auto&) -> Eigen::Vector3d { return {3, -2, 1}; });
  EXPECT_EQ(found.size(), 33U);
  for (const auto& [name, value] : found) EXPECT_NEAR(value, 0.0, 1e-9) << name;
}

TEST(TestPart, ASquarenessOfTwentyMicroradiansIsOneOnThePart) {
  const auto found = milledWith("EC0Y_urad", 20.0);
  EXPECT_NEAR(found.at("square.squareness"), 20.0, 1e-9);
  // 320 mm at 20 urad.
  EXPECT_NEAR(found.at("square.2.perpendicularity"), 6.4, 1e-9);
  EXPECT_NEAR(found.at("square.4.perpendicularity"), 6.4, 1e-9);
  EXPECT_NEAR(found.at("square.3.parallelism"), 0.0, 1e-9);
  EXPECT_NEAR(found.at("square.2.straightness"), 0.0, 1e-9);
  EXPECT_NEAR(found.at("square.size_x"), 0.0, 1e-9);
  // The circle becomes an ellipse: dr = -E r sin a cos a, peak to valley E r.
  EXPECT_NEAR(found.at("circle.circularity"), 20e-3 * 108.0, 1e-3);
  // Holes at (±112, ±112): off by E y.
  EXPECT_NEAR(found.at("hole.3.position"), 2.0 * 20e-3 * 112.0, 1e-9);
}

TEST(TestPart, AScaleErrorIsASize) {
  const auto found = milledWith("EXX_um_per_m", 50.0);
  EXPECT_NEAR(found.at("square.size_x"), 16.0, 1e-9);
  EXPECT_NEAR(found.at("square.size_y"), 0.0, 1e-9);
  EXPECT_NEAR(found.at("circle.diameter"), 50e-3 * 216.0 / 2.0, 1e-3);  // of an axis alone: half
  EXPECT_NEAR(found.at("holes.distance_x"), 50e-3 * 224.0, 1e-9);
  EXPECT_NEAR(found.at("square.squareness"), 0.0, 1e-9);
  EXPECT_NEAR(found.at("circle.concentricity"), 0.0, 1e-9);
}

TEST(TestPart, AnArcOfAnAxisIsTheStraightnessOfItsSides) {
  // 12 um over 500 mm are 12 (320 / 500)^2 over the part; the sides along Y stay straight.
  const auto found = milledWith("EYX_um", 12.0);
  EXPECT_NEAR(found.at("square.1.straightness"), 12.0 * 0.64 * 0.64, 0.01);
  EXPECT_NEAR(found.at("square.3.straightness"), 12.0 * 0.64 * 0.64, 0.01);
  EXPECT_NEAR(found.at("square.2.straightness"), 0.0, 1e-9);
}

TEST(TestPart, ASpindleThatLeansBoresAtAnAngle) {
  const auto found = milledWith("EB0Z_urad", 30.0);
  // 80 mm deep: 30e-6 * 80 mm.
  EXPECT_NEAR(found.at("bore.perpendicularity"), 2.4, 1e-9);
}

TEST(TestPart, ATurnOfEverythingIsNoErrorOfForm) {
  const TestPart part((TestPartOptions()));
  const auto found = milled(part, [](const DeviationQuery& q) -> Eigen::Vector3d {
    return {-0.1 * q.position_mm.y(), 0.1 * q.position_mm.x(), 0.0};
  });
  for (const auto& [name, value] : found) EXPECT_NEAR(value, 0.0, 1e-9) << name;
}

TEST(TestPart, BacklashShowsWhereAnAxisReverses) {
  const TestPart part((TestPartOptions()));
  const auto found = milled(part, [](const DeviationQuery& q) -> Eigen::Vector3d {
    return {2.0 * q.approach.x(), 0.0, 0.0};
  });
  // Lower and upper half of the circle are shifted against one another.
  EXPECT_GT(found.at("circle.circularity"), 2.0);
  EXPECT_NEAR(found.at("square.size_x"), 0.0, 1e-9);
  EXPECT_NEAR(found.at("square.2.straightness"), 0.0, 1e-9);
  EXPECT_NEAR(found.at("hole.1.position"), 0.0, 1e-9);
}

TEST(TestPart, AnOvalCircleMinimumZoneAndLeastSquares) {
  const TestPart part((TestPartOptions()));
  const auto found = milled(part, [](const DeviationQuery& q) -> Eigen::Vector3d {
    const double a = std::atan2(q.position_mm.y(), q.position_mm.x());
    const double r = 5.0 * std::cos(3.0 * a) + 4.0;
    return {r * std::cos(a), r * std::sin(a), 0.0};
  });
  // Points every 2 degrees miss the crests by up to 10 (1 - cos 3 deg).
  EXPECT_NEAR(found.at("circle.circularity"), 10.0, 0.02);
  EXPECT_NEAR(found.at("circle.circularity_ls"), 10.0, 0.02);
  EXPECT_NEAR(found.at("circle.diameter"), 8.0, 0.01);
}

TEST(TestPart, TakesTheLargestThatFitsAndSaysWhereThereIsNoRoom) {
  const TestPartOptions options = TestPartOptions::on(partMachine());
  EXPECT_EQ(options.side_mm, 320.0);
  EXPECT_EQ(options.centre_mm.head<2>(), Eigen::Vector2d(250, 200));
  const TestPart part(options);
  for (const DeviationQuery& q : part.points()) {
    EXPECT_GE(q.position_mm.z(), 0.0);
    EXPECT_LE(q.position_mm.x(), 500.0);
  }
  MachineDescription small = partMachine();
  small.axes[1].travel_mm = {0, 30};
  EXPECT_THROW((void)TestPartOptions::on(small), InputError);
  small.axes.pop_back();
  EXPECT_THROW((void)TestPartOptions::on(small), InputError);
  TestPartOptions bad;
  bad.depths = 1;
  EXPECT_THROW(TestPart{bad}, InputError);
}

TEST(TestPart, EveryCharacteristicHasWords) {
  const TestPart part((TestPartOptions()));
  const std::vector<Eigen::Vector3d> none(part.points().size(), Eigen::Vector3d::Zero());
  std::map<std::string, int> seen;
  for (const PartCharacteristic& c : part.evaluate(none)) {
    EXPECT_FALSE(characteristicText(c).empty());
    EXPECT_EQ(++seen[characteristicText(c)], 1) << characteristicText(c);
  }
  EXPECT_EQ(characteristicText({"square.2", "perpendicularity", "B"}), "perpendicularity of side 2 of the square to B");
}

}  // namespace
}  // namespace spindrift
