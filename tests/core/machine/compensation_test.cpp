// SPDX-License-Identifier: GPL-3.0-or-later
// The sign of every export is proven against golden files that were worked out by hand.
#include "core/machine/compensation.h"

#include <gmock/gmock.h>

#include "core/base/atomic_file.h"

namespace spindrift {
namespace {

/// ex = 0.1 um per mm of x, plus 2 um in the direction of approach; ey = 3 um; EC = 5 urad per 100 mm of x.
class HandModel final : public ErrorModel {
 public:
  [[nodiscard]] std::string description() const override { return "worked by hand"; }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& q, Component component) const override {
    if (component == Component::EX) return {0.1 * q.position_mm.x() + 2.0 * q.approach.x(), 0.5};
    if (component == Component::EY) return {3.0, 0.25};
    if (component == Component::EC) return {0.05 * q.position_mm.x(), 1.0};
    return {};
  }
};

MachineDescription machine() {
  const auto root = JsonNode::parse(
      R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
          "axes":[{"name":"X","travel_mm":[0,100]},{"name":"Y","travel_mm":[0,50]},{"name":"Z","travel_mm":[-10,10]}]})",
      "machine.json");
  return MachineDescription::parse(root, "machine.json");
}

std::string golden(const char* name) {
  return readFile(std::filesystem::path(SPINDRIFT_TEST_DATA) / "compensation" / name);
}

TEST(Compensation, GridIsMinusTheDeviation) {
  CompensationGridOptions options = CompensationGridOptions::travelOf(machine());
  options.nodes = {2, 1, 1};
  EXPECT_EQ(compensationGridCsv(compensationGrid(HandModel(), options, {})), golden("grid.csv"));
}

TEST(Compensation, ComponentTableIsTheDeviationRelativeToTheReference) {
  const AxisComponentTable table = axisComponents(HandModel(), machine(), "X", {50.0, 0.0, 0.0}, 3, {});
  EXPECT_EQ(axisComponentsCsv(table), golden("iso230_x.csv"));
}

TEST(Compensation, TablesMarkExtrapolationAndStateNothingThatWasNotMeasured) {
  const MeasuredBox measured{{0.0, 10.0, 0.0}, {60.0, 40.0, 0.0}};
  EXPECT_TRUE(measured.extendsAlong(0));
  EXPECT_FALSE(measured.extendsAlong(2));
  const std::string x =
      axisComponentsCsv(axisComponents(HandModel(), machine(), "X", {50.0, 0.0, 0.0}, 3, {}), measured);
  EXPECT_THAT(x, ::testing::HasSubstr(",extrapolated\n0,"));
  EXPECT_THAT(x, ::testing::ContainsRegex("\n50,[^\n]*,0\n100,[^\n]*,1\n"));
  const std::string z =
      axisComponentsCsv(axisComponents(HandModel(), machine(), "Z", {0.0, 0.0, 0.0}, 3, {}), measured);
  EXPECT_THAT(z, ::testing::HasSubstr("# nothing was measured along Z (all points lie at 0 mm)"));
  EXPECT_THAT(z, ::testing::HasSubstr("\n-10,,,,,,,,,,,,,1\n0,,,,,,,,,,,,,0\n10,,,,,,,,,,,,,1\n"));
  CompensationGridOptions options = CompensationGridOptions::travelOf(machine());
  options.nodes = {2, 1, 1};
  options.from_mm = {50.0, 20.0, 0.0};
  EXPECT_THAT(compensationGridCsv(compensationGrid(HandModel(), options, {}), measured),
              ::testing::ContainsRegex(",extrapolated\n50,20,0,[^\n]*,0\n100,20,0,[^\n]*,1\n"));
}

TEST(Compensation, LinuxcncFileHoldsWhereTheAxisReallyIs) {
  EXPECT_EQ(linuxcncCompensation(HandModel(), machine(), "X", {0.0, 0.0, 0.0}, 3, {}), golden("linuxcnc_x.comp"));
}

TEST(Compensation, LinuxcncTrimIsMinusTheDeviation) {
  // 0.1 um per mm, and 2 um the other way for the other direction.
  EXPECT_EQ(linuxcncCompensation(HandModel(), machine(), "X", {0.0, 0.0, 0.0}, 3, {}, LinuxcncTable::Trim),
            "0.000000 -0.002000 0.002000\n50.000000 -0.007000 -0.003000\n100.000000 -0.012000 -0.008000\n");
}

// K3 of the control's manual: the value is added to the position that is read, and the axis moves until that is the
// commanded one.
TEST(Compensation, SiemensTableLeavesNothingOnAControlThatAddsItToTheActualValue) {
  const HandModel model;
  const std::string text = siemensCompensation(model, machine(), "X", {40.0, 0.0, 0.0}, 3, {});
  EXPECT_EQ(text, golden("siemens_x_eec.ini"));
  std::array<double, 3> table{};
  for (int i = 0; i < 3; ++i) {
    const std::string name = "$AA_ENC_COMP[0," + std::to_string(i) + ",X1]=";
    const std::size_t at = text.find(name);
    ASSERT_NE(at, std::string::npos);
    table[static_cast<std::size_t>(i)] = std::stod(text.substr(at + name.size()));
  }
  const auto deviation_mm = [&](double x) {
    DeviationQuery query;
    query.position_mm = {x, 0.0, 0.0};
    return 1e-3 * model.predict(query, Component::EX).value;
  };
  for (int i = 0; i < 3; ++i) {
    const double commanded = 50.0 * i;
    const double read = commanded - table[static_cast<std::size_t>(i)];  // read + value = commanded
    const double really = read + deviation_mm(commanded);
    EXPECT_NEAR(really - commanded, deviation_mm(40.0), 1e-9) << "the same everywhere: that of the reference";
  }
}

TEST(Compensation, AddingTheCorrectionLeavesNothing) {
  const HandModel model;
  for (const CompensationNode& node : compensationGrid(model, CompensationGridOptions::travelOf(machine()), {})) {
    DeviationQuery query;
    query.position_mm = node.position_mm;
    EXPECT_DOUBLE_EQ(model.predict(query, Component::EX).value + node.correction_um.x(), 0.0);
    EXPECT_DOUBLE_EQ(model.predict(query, Component::EY).value + node.correction_um.y(), 0.0);
  }
}

TEST(Compensation, RefusesWhatItCannotExport) {
  EXPECT_THROW((void)axisComponents(HandModel(), machine(), "C", Eigen::Vector3d::Zero(), 3, {}), InputError);
  EXPECT_THROW((void)linuxcncCompensation(HandModel(), machine(), "X", Eigen::Vector3d::Zero(), 257, {}), InputError);
  CompensationGridOptions options;
  options.nodes = {0, 1, 1};
  EXPECT_THROW((void)compensationGrid(HandModel(), options, {}), InputError);
}

}  // namespace
}  // namespace spindrift
