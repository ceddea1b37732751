// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/measuring_points.h"

#include <gtest/gtest.h>

namespace spindrift {
namespace {

std::vector<Eigen::Vector3d> lattice(int nx, int ny) {
  std::vector<Eigen::Vector3d> candidates;
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) candidates.emplace_back(300.0 * ix / (nx - 1), 130.0 * iy / (ny - 1), 0.0);
  }
  return candidates;
}

PlacementOptions tableOptions(int count, PlacementCriterion criterion) {
  PlacementOptions options;
  options.count = count;
  options.criterion = criterion;
  options.region_to_mm = {300.0, 130.0};
  return options;
}

TEST(MeasuringPoints, FourPositionsBelongIntoTheCorners) {
  for (const PlacementCriterion criterion : {PlacementCriterion::D, PlacementCriterion::I}) {
    const auto result = chooseMeasuringPoints(lattice(5, 4), tableOptions(4, criterion), {});
    ASSERT_EQ(result.status, FitStatus::Converged);
    EXPECT_TRUE(result.exhaustive);
    EXPECT_EQ(result.chosen, (std::vector<std::size_t>{0, 4, 15, 19}));
  }
}

TEST(MeasuringPoints, ExchangeFindsWhatTryingAllFinds) {
  for (const PlacementCriterion criterion : {PlacementCriterion::D, PlacementCriterion::I}) {
    for (const int count : {3, 5, 6}) {
      PlacementOptions options = tableOptions(count, criterion);
      const auto all = chooseMeasuringPoints(lattice(5, 4), options, {});
      options.exhaustive_limit = 0;
      const auto exchange = chooseMeasuringPoints(lattice(5, 4), options, {});
      EXPECT_FALSE(exchange.exhaustive);
      if (criterion == PlacementCriterion::D) {
        EXPECT_NEAR(exchange.log_det, all.log_det, 1e-9);
      } else {
        EXPECT_NEAR(exchange.mean_sigma_um, all.mean_sigma_um, 1e-9);
      }
    }
  }
}

TEST(MeasuringPoints, PaperSetOneBeatsSetTwo) {
  const std::vector<Eigen::Vector3d> fiducials{{20, 15, 0},  {280, 15, 0}, {280, 115, 0}, {20, 115, 0},
                                               {110, 40, 0}, {190, 40, 0}, {110, 90, 0},  {190, 90, 0}};
  const PlacementOptions options = tableOptions(4, PlacementCriterion::I);
  const auto corners = judgeMeasuringPoints(fiducials, {0, 1, 2, 3}, options);
  const auto diagonal = judgeMeasuringPoints(fiducials, {1, 3, 4, 6}, options);
  ASSERT_EQ(corners.status, FitStatus::Converged);
  ASSERT_EQ(diagonal.status, FitStatus::Converged);
  EXPECT_LT(corners.mean_sigma_um, 0.8 * diagonal.mean_sigma_um);
  EXPECT_GT(corners.log_det, diagonal.log_det);
  EXPECT_GE(corners.largest_sigma_um, corners.mean_sigma_um);
}

TEST(MeasuringPoints, FixedPositionsStayIn) {
  PlacementOptions options = tableOptions(4, PlacementCriterion::I);
  options.fixed = {7, 12};
  const auto result = chooseMeasuringPoints(lattice(5, 4), options, {});
  EXPECT_NE(std::find(result.chosen.begin(), result.chosen.end(), 7u), result.chosen.end());
  EXPECT_NE(std::find(result.chosen.begin(), result.chosen.end(), 12u), result.chosen.end());
  EXPECT_EQ(result.chosen.size(), 4u);
}

TEST(MeasuringPoints, CandidatesOnALineAreDegenerate) {
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 6; ++i) line.emplace_back(50.0 * i, 20.0 + 15.0 * i, 0.0);
  const auto result = chooseMeasuringPoints(line, tableOptions(4, PlacementCriterion::D), {});
  EXPECT_EQ(result.status, FitStatus::Degenerate);
  EXPECT_FALSE(result.message.empty());
}

TEST(MeasuringPoints, RefusesWhatCannotBe) {
  EXPECT_THROW((void)chooseMeasuringPoints(lattice(3, 2), tableOptions(2, PlacementCriterion::D), {}), InputError);
  EXPECT_THROW((void)chooseMeasuringPoints(lattice(3, 2), tableOptions(7, PlacementCriterion::D), {}), InputError);
}

}  // namespace
}  // namespace spindrift
