// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/measuring_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

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

/// Of one given choice: nothing is left to choose.
PlacementResult figuresOf(const std::vector<Eigen::Vector3d>& candidates, const std::vector<std::size_t>& chosen,
                          PlacementOptions options) {
  options.count = static_cast<int>(chosen.size());
  options.fixed = chosen;
  return chooseMeasuringPoints(candidates, options, {});
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
  const auto corners = figuresOf(fiducials, {0, 1, 2, 3}, options);
  const auto diagonal = figuresOf(fiducials, {1, 3, 4, 6}, options);
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
  PlacementOptions twice = tableOptions(4, PlacementCriterion::D);
  twice.fixed = {1, 1};
  EXPECT_THROW((void)chooseMeasuringPoints(lattice(3, 2), twice, {}), InputError);
}

double nearest(const std::vector<Eigen::Vector3d>& candidates, const PlacementResult& result) {
  double least = 1e300;
  for (const std::size_t a : result.chosen)
    for (const std::size_t b : result.chosen)
      if (a != b) least = std::min(least, (candidates[a] - candidates[b]).norm());
  return least;
}

TEST(MeasuringPoints, KeepADistance) {
  // 5 mm from candidate to candidate: without a distance the criterion puts several into one corner.
  const std::vector<Eigen::Vector3d> candidates = lattice(61, 27);
  PlacementOptions options = tableOptions(7, PlacementCriterion::I);
  options.starts = 2;
  options.least_distance_mm = 0.0;
  EXPECT_LT(nearest(candidates, chooseMeasuringPoints(candidates, options, {})), 10.0);
  options.least_distance_mm.reset();
  const PlacementResult apart = chooseMeasuringPoints(candidates, options, {});
  ASSERT_EQ(apart.status, FitStatus::Converged);
  EXPECT_GE(apart.least_distance_mm, 0.1 * std::hypot(300.0, 130.0) - 1e-9);
  EXPECT_DOUBLE_EQ(nearest(candidates, apart), apart.least_distance_mm);
  // Trying all keeps it, too, and from what is fixed.
  PlacementOptions few = tableOptions(5, PlacementCriterion::D);
  few.least_distance_mm = 80.0;
  few.fixed = {7};
  const std::vector<Eigen::Vector3d> coarse = lattice(5, 4);
  const PlacementResult tried = chooseMeasuringPoints(coarse, few, {});
  EXPECT_TRUE(tried.exhaustive);
  EXPECT_GE(nearest(coarse, tried), 80.0 - 1e-6);
}

TEST(MeasuringPoints, TheDistanceThatIsStatedCountsWhatIsKept) {
  const std::vector<Eigen::Vector3d> candidates = lattice(61, 27);
  PlacementOptions options = tableOptions(6, PlacementCriterion::I);
  options.starts = 2;
  options.fixed = {700, 701};
  const PlacementResult result = chooseMeasuringPoints(candidates, options, {});
  ASSERT_EQ(result.status, FitStatus::Converged);
  EXPECT_NEAR(result.least_distance_mm, 5.0, 1e-9);
}

TEST(MeasuringPoints, AThousandPositionsAreChosenInSeconds) {
  const std::vector<Eigen::Vector3d> candidates = lattice(60, 60);
  for (const PlacementCriterion criterion : {PlacementCriterion::D, PlacementCriterion::I}) {
    for (const double distance_mm : {0.0, 4.0}) {
      PlacementOptions options = tableOptions(distance_mm > 0.0 ? 500 : 1000, criterion);
      options.least_distance_mm = distance_mm;
      const std::clock_t begin = std::clock();  // processor time: others may be at work
      const PlacementResult result = chooseMeasuringPoints(candidates, options, {});
      const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      EXPECT_LT(seconds, 30.0);
      ASSERT_EQ(result.status, FitStatus::Converged);
      ASSERT_EQ(std::ssize(result.chosen), options.count);
      EXPECT_GE(nearest(candidates, result), distance_mm - 1e-6);
      // Better than any regular choice of as many.
      std::vector<std::size_t> regular;
      for (std::size_t i = 0; std::ssize(regular) < options.count; i += distance_mm > 0.0 ? 7 : 3) regular.push_back(i);
      const PlacementResult plain = figuresOf(candidates, regular, options);
      if (criterion == PlacementCriterion::D) {
        EXPECT_GT(result.log_det, plain.log_det);
      } else {
        EXPECT_LT(result.mean_sigma_um, plain.mean_sigma_um);
      }
    }
  }
}

TEST(MeasuringPoints, ADistanceThatCannotBeKeptIsSaid) {
  PlacementOptions options = tableOptions(5, PlacementCriterion::I);
  options.least_distance_mm = 200.0;
  const PlacementResult none = chooseMeasuringPoints(lattice(5, 4), options, {});
  EXPECT_EQ(none.status, FitStatus::Degenerate);
  EXPECT_EQ(none.message, "no choice of 5 positions among the candidates keeps 200 mm between any two");
  // Fiducials that stand close together: as far apart as they allow.
  std::vector<Eigen::Vector3d> close;
  for (const Eigen::Vector3d& p : lattice(3, 2)) close.push_back(0.05 * p);
  options.least_distance_mm.reset();
  const PlacementResult best = chooseMeasuringPoints(close, options, {});
  EXPECT_EQ(best.status, FitStatus::Converged);
  EXPECT_LT(best.least_distance_mm, 10.0);
  options.least_distance_mm = -1.0;
  EXPECT_THROW((void)chooseMeasuringPoints(close, options, {}), InputError);
}

}  // namespace
}  // namespace spindrift
