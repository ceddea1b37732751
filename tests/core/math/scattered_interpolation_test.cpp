// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/scattered_interpolation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

std::vector<Eigen::Vector3d> randomPlaces(Random& random, std::size_t count, const Eigen::Vector3d& size) {
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.emplace_back(size.x() * random.uniform(), size.y() * random.uniform(), size.z() * random.uniform());
  }
  return places;
}

double at(const ScatteredInterpolation& interpolation, const std::vector<double>& values,
          const Eigen::Vector3d& place) {
  const auto weights = interpolation.at(place);
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.place.size(); ++k) sum += weights.weight[k] * values[weights.place[k]];
  return sum;
}

template <typename Field>
std::vector<double> valuesOf(const std::vector<Eigen::Vector3d>& places, const Field& field) {
  std::vector<double> values;
  for (const Eigen::Vector3d& p : places) values.push_back(field(p));
  return values;
}

const auto linear = [](const Eigen::Vector3d& p) { return 3.0 + 0.02 * p.x() - 0.05 * p.y() + 0.01 * p.z(); };

// What a machine does: expansion, bending with the square of the height, a table that dishes.
const auto machine = [](const Eigen::Vector3d& p) {
  return 5.0 + 0.02 * p.x() + 2e-5 * p.z() * p.z() - 1e-5 * (p.x() - 200.0) * (p.x() - 200.0) +
         1e-8 * std::pow(p.y(), 3);
};

TEST(ScatteredInterpolation, IsExactAtThePlaces) {
  Random random(1);
  const auto places = randomPlaces(random, 40, {400.0, 300.0, 500.0});
  std::vector<double> values;
  for (std::size_t i = 0; i < places.size(); ++i) values.push_back(random.normal(0.0, 10.0));
  const ScatteredInterpolation interpolation(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_DOUBLE_EQ(at(interpolation, values, places[i]), values[i]);
    // and continuous there
    EXPECT_NEAR(at(interpolation, values, places[i] + Eigen::Vector3d(1e-5, 0.0, 0.0)), values[i], 1e-3);
  }
}

TEST(ScatteredInterpolation, ReproducesLinearFieldsInsideAndOutside) {
  Random random(2);
  // Up to the whole system at once, beyond it in neighbourhoods.
  for (const std::size_t count : {4U, 5U, 30U, 300U, 900U}) {
    const auto places = randomPlaces(random, count, {400.0, 300.0, 500.0});
    const ScatteredInterpolation interpolation(places);
    const auto values = valuesOf(places, linear);
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d p(600.0 * random.uniform() - 100.0, 500.0 * random.uniform() - 100.0,
                              700.0 * random.uniform() - 100.0);
      EXPECT_NEAR(at(interpolation, values, p), linear(p), 1e-6) << count;
    }
  }
}

TEST(ScatteredInterpolation, FollowsASmoothFieldBetweenThePlaces) {
  Random random(3);
  const auto places = randomPlaces(random, 120, {400.0, 300.0, 500.0});
  const ScatteredInterpolation interpolation(places);
  const auto values = valuesOf(places, machine);
  double worst = 0.0;
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(40.0 + 320.0 * random.uniform(), 30.0 + 240.0 * random.uniform(),
                            50.0 + 400.0 * random.uniform());
    if (interpolation.at(p).outside > 0.0) continue;
    ++inside;
    worst = std::max(worst, std::abs(at(interpolation, values, p) - machine(p)));
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(worst, 0.12);  // of a field of 14 um
}

TEST(ScatteredInterpolation, WorksInAPlaneOnALineAndWithOnePlace) {
  const auto field = [](const Eigen::Vector3d& p) { return 1.0 + 0.1 * p.x() + 0.2 * p.y(); };
  std::vector<Eigen::Vector3d> plane;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 4; ++j) plane.emplace_back(100.0 * i, 80.0 * j, 20.0);
  }
  const ScatteredInterpolation flat(plane);
  EXPECT_NEAR(at(flat, valuesOf(plane, field), {133.0, 71.0, 20.0}), field({133.0, 71.0, 0.0}), 1e-9);
  EXPECT_EQ(flat.at({133.0, 71.0, 20.0}).outside, 0.0);
  // Across the plane nothing is known: constant, and told.
  EXPECT_NEAR(at(flat, valuesOf(plane, field), {133.0, 71.0, 50.0}), field({133.0, 71.0, 0.0}), 1e-9);
  EXPECT_NEAR(flat.at({133.0, 71.0, 50.0}).outside, 30.0, 1e-9);
  const std::vector<Eigen::Vector3d> line{{0, 0, 0}, {50, 0, 0}, {200, 0, 0}};
  const ScatteredInterpolation along(line);
  EXPECT_NEAR(at(along, valuesOf(line, field), {120.0, 0.0, 0.0}), 13.0, 1e-9);
  EXPECT_NEAR(at(along, valuesOf(line, field), {250.0, 0.0, 0.0}), 26.0, 1e-9);
  const ScatteredInterpolation alone({{10, 20, 30}});
  EXPECT_DOUBLE_EQ(at(alone, {7.0}, {10.0, 20.0, 30.0}), 7.0);
  EXPECT_DOUBLE_EQ(at(alone, {7.0}, {10.0, 20.0, 33.0}), 7.0);
  EXPECT_NEAR(alone.at({10.0, 24.0, 33.0}).outside, 5.0, 1e-12);
}

TEST(ScatteredInterpolation, IsNotCarriedAwayByAPlaneThatIsNotQuiteFlat) {
  Random random(4);
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < 60; ++i) {
    places.emplace_back(500.0 * random.uniform(), 400.0 * random.uniform(), 0.001 * random.uniform());
  }
  std::vector<double> values = valuesOf(places, [](const Eigen::Vector3d& p) { return 0.02 * p.x(); });
  for (double& v : values) v += random.normal(0.0, 0.05);
  const ScatteredInterpolation interpolation(places);
  EXPECT_NEAR(at(interpolation, values, {250.0, 200.0, 100.0}), 5.0, 0.5);
}

TEST(NearestInHull, FindsTheNearestPointOfABox) {
  std::vector<Eigen::Vector3d> box;
  for (int i = 0; i < 8; ++i) box.emplace_back((i & 1) * 4.0, ((i >> 1) & 1) * 3.0, ((i >> 2) & 1) * 2.0);
  Random random(5);
  for (int i = 0; i < 30; ++i) box.emplace_back(4.0 * random.uniform(), 3.0 * random.uniform(), 2.0 * random.uniform());
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p(12.0 * random.uniform() - 4.0, 9.0 * random.uniform() - 3.0, 6.0 * random.uniform() - 2.0);
    const Eigen::Vector3d nearest = p.cwiseMax(Eigen::Vector3d::Zero()).cwiseMin(Eigen::Vector3d(4.0, 3.0, 2.0));
    EXPECT_LT((nearestInHull(box, p) - nearest).norm(), 1e-6) << p.transpose();
  }
}

}  // namespace
}  // namespace spindrift
