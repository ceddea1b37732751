// SPDX-License-Identifier: GPL-3.0-or-later
// The sign of every export is proven against golden files that were worked out by hand.
#include "core/machine/compensation.h"

#include <gmock/gmock.h>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/machine/nine_parameter_model.h"
#include "tests/support/source_folder.h"

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
  return readFile(spindrift::testing::testData() / "compensation" / name);
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

/// What a machine does that no nine parameters describe, um: bends of second order.
struct Bends {
  std::array<Eigen::Vector3d, 3> of_component{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                              Eigen::Vector3d::Zero()};

  [[nodiscard]] double at(const Eigen::Vector3d& p, Component component) const {
    const double x = (p.x() - 50.0) / 50.0;
    const double y = (p.y() - 25.0) / 25.0;
    return of_component[static_cast<std::size_t>(component)].dot(Eigen::Vector3d(x * x, y * y, x * y));
  }
};

/// Observations of a machine whose nine parameters change from one state to the next: twelve points, three readings
/// each.
ObservationSet readings(const NineVector& change, const Bends& bends, const Eigen::Vector3d& sigma_um, Random& random) {
  ObservationSet set;
  set.file = "observations.csv";
  std::vector<Eigen::Vector3d> places;
  for (const double x : {5.0, 35.0, 65.0, 95.0})
    for (const double y : {5.0, 25.0, 45.0}) places.emplace_back(x, y, x == y ? 8.0 : -8.0 + 0.2 * y);
  for (const bool warm : {false, true}) {
    for (std::size_t p = 0; p < places.size(); ++p) {
      for (int c = 0; c < 3; ++c) {
        for (int repeat = 0; repeat < 3; ++repeat) {
          Observation o;
          o.state = warm ? "M1" : "M0";
          o.point = "P" + std::to_string(p);
          o.component = static_cast<Component>(c);
          o.position_mm = places[p];
          o.sigma = sigma_um[c];
          o.value = random.normal(0.0, o.sigma) + 7.0 * static_cast<double>(p);
          if (warm)
            o.value += nineParameterRow(o.position_mm, o.component).dot(change) + bends.at(o.position_mm, o.component);
          set.rows.push_back(o);
        }
      }
    }
  }
  return set;
}

struct Standardised {
  double inside = 0.0;  ///< part of the errors within 1.96 sigma
  double rms = 0.0;     ///< of errors over sigma
};

/// Errors of component tables over their sigma, 400 machines. `bend_um`: standard deviation of the bends.
Standardised standardisedErrors(double bend_um) {
  NineVector change;
  change << 20, -15, 30, 40, -60, 50, 90, 120, -70;
  const Eigen::Vector3d reference_mm(30.0, 25.0, 0.0);
  Standardised out;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    Bends bends;
    for (Eigen::Vector3d& of : bends.of_component)
      for (double& value : of) value = random.normal(0.0, bend_um);
    NineParameterOptions options;
    options.state = "M1";
    const NineParameterFit fit = fitNineParameters(readings(change, bends, {0.4, 0.6, 1.0}, random), options);
    EXPECT_EQ(fit.status, FitStatus::Converged);
    for (const char* axis : {"X", "Y"}) {
      const AxisComponentTable table = axisComponents(fit.predictingModel(), machine(), axis, reference_mm, 5, {});
      for (std::size_t row = 0; row < table.position_mm.size(); ++row) {
        Eigen::Vector3d place = reference_mm;
        place[axis[0] - 'X'] = table.position_mm[row];
        for (std::size_t c = 0; c < 6; ++c) {
          if (place == reference_mm || c >= 3) {
            EXPECT_EQ(table.sigma[row][c], 0.0);  // nothing changes
            continue;
          }
          const auto component = static_cast<Component>(c);
          const double truth =
              (nineParameterRow(place, component) - nineParameterRow(reference_mm, component)).dot(change) +
              bends.at(place, component) - bends.at(reference_mm, component);
          const double z = (table.deviation[row][c] - truth) / table.sigma[row][c];
          out.inside += std::abs(z) < 1.96 ? 1.0 : 0.0;
          out.rms += z * z;
          count += 1.0;
        }
      }
    }
  }
  out.inside /= count;
  out.rms = std::sqrt(out.rms / count);
  return out;
}

TEST(Compensation, SigmaOfAComponentTableIsThatOfTheChangeFromTheReference) {
  const Standardised errors = standardisedErrors(0.0);
  EXPECT_NEAR(errors.inside, 0.95, 0.015);
  EXPECT_NEAR(errors.rms, 1.0, 0.04);
}

TEST(Compensation, WhatTheModelDoesNotDescribeIsInTheSigmaOfTheChange) {
  const Standardised errors = standardisedErrors(5.0);
  EXPECT_GT(errors.inside, 0.92);
  EXPECT_LT(errors.rms, 1.1);
  EXPECT_GT(errors.rms, 0.5);
}

TEST(Compensation, TablesSayNothingOfAnErrorThatTheModelDoesNotKnow) {
  NineMatrix covariance = NineMatrix::Identity();
  const NineParameterModel model(NineVector::Ones(), covariance, "nine parameters");
  const MeasuredBox measured{{0.0, 0.0, -10.0}, {100.0, 50.0, 10.0}};
  const std::string z = axisComponentsCsv(axisComponents(model, machine(), "Z", {50.0, 0.0, 0.0}, 3, {}), measured);
  EXPECT_THAT(z, ::testing::HasSubstr("# not in the model, so that nothing is stated of it: EZZ, EAZ, EBZ, ECZ\n"));
  EXPECT_THAT(z, ::testing::ContainsRegex("\n10,0\\.0100,-0\\.0100,,,,,0\\.0100,0\\.0100,,,,,0\n"));
}

TEST(Compensation, TablesMarkExtrapolationAndStateNothingThatWasNotMeasured) {
  const MeasuredBox measured{{0.0, 10.0, 0.0}, {60.0, 40.0, 0.0}};
  EXPECT_TRUE(measured.extendsAlong(0));
  EXPECT_FALSE(measured.extendsAlong(2));
  const std::string x =
      axisComponentsCsv(axisComponents(HandModel(), machine(), "X", {50.0, 20.0, 0.0}, 3, {}), measured);
  EXPECT_THAT(x, ::testing::HasSubstr(",extrapolated\n0,"));
  EXPECT_THAT(x, ::testing::ContainsRegex("\n50,[^\n]*,0\n100,[^\n]*,1\n"));
  const std::string beside =
      axisComponentsCsv(axisComponents(HandModel(), machine(), "X", {50.0, 0.0, 0.0}, 3, {}), measured);
  EXPECT_THAT(beside, ::testing::ContainsRegex("\n50,[^\n]*,1\n100,[^\n]*,1\n")) << "nothing was measured at y = 0";
  const std::string z =
      axisComponentsCsv(axisComponents(HandModel(), machine(), "Z", {0.0, 10.0, 0.0}, 3, {}), measured);
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
