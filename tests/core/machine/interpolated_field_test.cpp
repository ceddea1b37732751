// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/interpolated_field.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

double at(const InterpolatedField& field, const Eigen::Vector3d& place, double* sigma = nullptr) {
  DeviationQuery query;
  query.position_mm = place;
  const PredictedComponent p = field.predict(query, Component::EZ);
  if (sigma != nullptr) *sigma = p.sigma;
  return p.value;
}

TEST(InterpolatedField, GoesThroughExactValuesAndGrowsUncertainFarAway) {
  std::vector<ScatteredValue> values;
  for (const double x : {0.0, 100.0, 200.0, 300.0}) {
    for (const double y : {0.0, 150.0, 300.0}) values.push_back({{x, y, 0.0}, std::sin(x / 120.0) * 5.0, 1e-3});
  }
  const InterpolatedField field(Component::EZ, values);
  double near = 0.0;
  double far = 0.0;
  EXPECT_NEAR(at(field, {100.0, 150.0, 0.0}, &near), 5.0 * std::sin(100.0 / 120.0), 0.01);
  EXPECT_NEAR(at(field, {150.0, 80.0, 0.0}), 5.0 * std::sin(150.0 / 120.0), 0.4);
  (void)at(field, {900.0, 150.0, 0.0}, &far);
  EXPECT_GT(far, 50.0 * near);
  DeviationQuery query;
  EXPECT_TRUE(std::isinf(field.predict(query, Component::EX).sigma));
}

TEST(InterpolatedField, NoiseAloneIsTheMeanWithItsUncertainty) {
  Random random(7);
  std::vector<ScatteredValue> values;
  for (int i = 0; i < 40; ++i) {
    values.push_back(
        {{random.uniform(0.0, 500.0), random.uniform(0.0, 400.0), 0.0}, 3.0 + random.normal(0.0, 0.5), 0.5});
  }
  const InterpolatedField field(Component::EZ, values);
  double sigma = 0.0;
  EXPECT_NEAR(at(field, {250.0, 200.0, 0.0}, &sigma), 3.0, 0.3);
  EXPECT_LT(sigma, 0.3);
}

TEST(InterpolatedField, OneValueIsPossible) {
  const InterpolatedField field(Component::EZ, {{{10.0, 20.0, 0.0}, 4.0, 0.5}});
  double sigma = 0.0;
  EXPECT_NEAR(at(field, {10.0, 20.0, 0.0}, &sigma), 4.0, 1e-6);
  EXPECT_GE(sigma, 0.49);
}

// A ridge that the points only touch: a smooth process swings over it, and beyond the table it runs away.
TEST(InterpolatedField, SaysNothingLargerThanWasMeasuredAndCountsWhatItTookBack) {
  std::vector<ScatteredValue> values;
  for (const double x : {0.0, 100.0, 200.0, 300.0}) {
    for (const double y : {0.0, 100.0}) values.push_back({{x, y, 0.0}, x == 0.0 || x == 300.0 ? 0.0 : 10.0, 0.01});
  }
  const InterpolatedField field(Component::EZ, values);
  for (double x = -200.0; x <= 500.0; x += 10.0) {
    const double v = at(field, {x, 50.0, 0.0});
    EXPECT_GE(v, 0.0) << x;
    EXPECT_LE(v, 10.0) << x;
  }
  // Of all values that were told the top of the ridge is the least certain one between the points.
  double top = 0.0, slope = 0.0;
  (void)at(field, {150.0, 50.0, 0.0}, &top);
  (void)at(field, {100.0, 0.0, 0.0}, &slope);
  EXPECT_GT(top, 0.5) << "how far it was taken back";
  EXPECT_LT(slope, 0.02);
}

// Smooth courses over the table of other kinds than the model: waves and slopes of random direction and length.
TEST(InterpolatedField, TheTruthLiesInsideTheStatedIntervalAsOftenAsStated) {
  Random random(11);
  int inside = 0;
  int count = 0;
  for (int repeat = 0; repeat < 250; ++repeat) {
    const double angle = random.uniform(0.0, 6.283);
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    const double wave_mm = random.uniform(500.0, 1500.0);
    const double phase = random.uniform(0.0, 6.283);
    const double size = random.uniform(1.0, 6.0);
    const double slope = random.normal(0.0, 0.006);
    const auto truth = [&](const Eigen::Vector3d& p) {
      const double s = along.dot(p.head<2>());
      return size * std::sin(6.283 * s / wave_mm + phase) + slope * p.y();
    };
    std::vector<ScatteredValue> values;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d p(random.uniform(0.0, 500.0), random.uniform(0.0, 400.0), 0.0);
      values.push_back({p, truth(p) + random.normal(0.0, 0.4), 0.4});
    }
    const InterpolatedField field(Component::EZ, values);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d p(random.uniform(50.0, 450.0), random.uniform(50.0, 350.0), 0.0);
      double sigma = 0.0;
      const double value = at(field, p, &sigma);
      inside += std::abs(value - truth(p)) < 1.96 * sigma ? 1 : 0;
      ++count;
    }
  }
  const double part = static_cast<double>(inside) / count;
  RecordProperty("inside", std::to_string(part));
  EXPECT_GT(part, 0.92);
  EXPECT_LT(part, 0.985);
}

}  // namespace
}  // namespace spindrift
