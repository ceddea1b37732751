// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/structure.h"

#include <gtest/gtest.h>

namespace spindrift {
namespace {

const RodIndex rod{0, 10, 100.0, 600.0};

TEST(Structure, EvenStrainGrowsInProportion) {
  const std::vector<double> even(10, 4.0);
  EXPECT_NEAR(strainIntegral_mm(rod, even, 1e-5, 100.0, 600.0), 0.02, 1e-12);
  EXPECT_NEAR(strainIntegral_mm(rod, even, 1e-5, 350.0, 600.0), 0.01, 1e-12);
  EXPECT_NEAR(strainIntegral_mm(rod, even, 1e-5, 600.0, 350.0), -0.01, 1e-12) << "towards the fixed end";
  EXPECT_NEAR(strainIntegral_mm(rod, even, 1e-5, 600.0, 700.0), 0.004, 1e-12) << "beyond the end";
}

TEST(Structure, LinearRiseGivesAQuadratic) {
  std::vector<double> rise(10);
  for (int i = 0; i < 10; ++i) rise[static_cast<std::size_t>(i)] = i + 0.5;
  EXPECT_NEAR(strainIntegral_mm(rod, rise, 1e-5, 100.0, 350.0), 1e-5 * 50.0 * 12.5, 1e-12);
  EXPECT_NEAR(strainIntegral_mm(rod, rise, 1e-5, 100.0, 600.0), 1e-5 * 50.0 * 50.0, 1e-12);
}

TEST(Structure, CantileverOfEvenCurvature) {
  const std::vector<double> hot(10, 3.0);
  const std::vector<double> cold(10, 1.0);
  const double curvature = 1e-5 * 2.0 / 400.0;
  const Bending b = cantilever(rod, hot, cold, 1e-5, 400.0, 475.0);
  EXPECT_NEAR(b.slope_rad, curvature * 375.0, 1e-15);
  EXPECT_NEAR(b.deflection_mm, 0.5 * curvature * 375.0 * 375.0, 1e-12);
}

TEST(Structure, BeamOnTwoSupportsIsAParabolaThatIsZeroAtBothEnds) {
  const std::vector<double> hot(10, 3.0);
  const std::vector<double> cold(10, 1.0);
  const double curvature = 1e-5 * 2.0 / 400.0;
  for (const double y : {100.0, 225.0, 350.0, 475.0, 600.0}) {
    const Bending b = simplySupported(rod, hot, cold, 1e-5, 400.0, y);
    EXPECT_NEAR(b.deflection_mm, 0.5 * curvature * (y - 100.0) * (600.0 - y), 1e-12);
    EXPECT_NEAR(b.slope_rad, 0.5 * curvature * (700.0 - 2.0 * y), 1e-15);
  }
}

}  // namespace
}  // namespace spindrift
