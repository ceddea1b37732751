// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/probing/cycle_studies.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/random.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

/// Twelve cycles of one parameter that rises to 60; the reference is `gain` times that, noise 0.5 each, plus 40.
ReferenceComparison compared(double gain, double rise, double bump, std::uint64_t seed) {
  Random random(seed);
  CycleEvaluation evaluation;
  evaluation.names = {"EXX_um_per_m"};
  evaluation.unit = {1.0};
  std::string record = "time_s,value,sigma\n";
  for (int k = 0; k < 12; ++k) {
    const double truth = rise * (1.0 - std::exp(-k / 4.0));
    CycleParameter parameter;
    parameter.value = truth + (k == 6 ? bump : 0.0) + 0.5 * random.normal();
    parameter.standard_uncertainty = 0.5;
    parameter.determined = true;
    evaluation.cycles.push_back(fmt::format("C{}", k));
    evaluation.cycle_time_s.push_back(600.0 * k);
    evaluation.parameters.push_back({parameter});
    record += fmt::format("{},{},0.5\n", 600.0 * k, 40.0 + truth / gain + 0.5 * random.normal());
  }
  const testing::TempFolder folder;
  return compareWithReference(evaluation, "EXX_um_per_m", folder.write("reference.csv", record));
}

TEST(ReferenceComparison, GivesSlopeOffsetAndAVerdict) {
  const ReferenceComparison same = compared(1.0, 60.0, 0.0, 1);
  EXPECT_TRUE(same.agrees) << same.verdict;
  EXPECT_NEAR(same.slope, 1.0, 4.0 * same.slope_sigma);
  EXPECT_NEAR(same.offset, -40.0, 4.0 * same.offset_sigma);
  EXPECT_NEAR(same.offset_sigma, std::sqrt(0.5 / 12.0), 0.02);
  const ReferenceComparison gain = compared(1.25, 60.0, 0.0, 2);
  EXPECT_GT(gain.correlation, 0.99);
  EXPECT_FALSE(gain.agrees);
  EXPECT_TRUE(gain.differs);
  EXPECT_NEAR(gain.slope, 1.25, 4.0 * gain.slope_sigma);
  EXPECT_THAT(gain.verdict, HasSubstr("the gain differs"));
  const ReferenceComparison course = compared(1.0, 60.0, 30.0, 3);
  EXPECT_TRUE(course.differs);
  EXPECT_THAT(course.verdict, HasSubstr("time histories differ"));
  const ReferenceComparison still = compared(1.0, 1.0, 0.0, 4);
  EXPECT_FALSE(still.agrees);
  EXPECT_THAT(still.verdict, HasSubstr("moves too little"));
}

TEST(ReferenceComparison, ACycleWithoutAnUncertaintyNeitherAgreesNorDisagrees) {
  CycleEvaluation evaluation;
  evaluation.names = {"EXX_um_per_m"};
  evaluation.unit = {1.0};
  std::string record = "time_s,value\n";
  for (int k = 0; k < 6; ++k) {
    CycleParameter parameter;
    parameter.value = 10.0 * k;
    parameter.standard_uncertainty = k == 0 ? 0.0 : 1.0;  // of the first, zero by definition
    parameter.determined = true;
    evaluation.cycles.push_back(fmt::format("C{}", k));
    evaluation.cycle_time_s.push_back(600.0 * k);
    evaluation.parameters.push_back({parameter});
    record += fmt::format("{},{}\n", 600.0 * k, 10.0 * k + (k % 2 == 0 ? 0.3 : -0.3));
  }
  const testing::TempFolder folder;
  const ReferenceComparison c = compareWithReference(evaluation, "EXX_um_per_m", folder.write("reference.csv", record));
  EXPECT_EQ(c.points.size(), 6U);
  EXPECT_EQ(c.judged, 5U);
  EXPECT_EQ(c.within_two_sigma, 1.0);
}

TEST(ReferenceComparison, ANegativeUncertaintyIsRefused) {
  CycleEvaluation evaluation;
  evaluation.names = {"EXX_um_per_m"};
  const testing::TempFolder folder;
  const auto file = folder.write("reference.csv", "time_s,value,sigma\n0,0,0.5\n100,1,-0.5\n");
  try {
    (void)compareWithReference(evaluation, "EXX_um_per_m", file);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("-0.5; allowed: 0 or more"));
  }
}

TEST(ReferenceComparison, SlopeAndItsUncertaintyAreTrue) {
  double sum = 0.0, squares = 0.0;
  constexpr int runs = 300;
  for (int k = 0; k < runs; ++k) {
    const ReferenceComparison c = compared(1.1, 20.0, 0.0, 100 + static_cast<std::uint64_t>(k));
    const double z = (c.slope - 1.1) / c.slope_sigma;
    sum += z / runs;
    squares += z * z / runs;
  }
  EXPECT_NEAR(sum, 0.0, 0.25);
  EXPECT_GT(squares, 0.6);
  EXPECT_LT(squares, 1.4);
}

}  // namespace
}  // namespace spindrift
