// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/scan_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Registration of a usual surface: micrometres and tens of microradians, correlated.
Matrix6 someRegistration(Random& random, double size) {
  Matrix6 root;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) root(i, j) = (i < 3 ? 1e-3 : 1e-5) * random.normal();
  Matrix6 c = size * size * (root * root.transpose() / 6.0);
  for (int i = 0; i < 6; ++i) c(i, i) *= 1.5;
  return c;
}

struct Example {
  std::vector<ScanResult> scans;
  std::vector<ScanRow> rows;
};

/// Two artefacts, a reference and three scans each; one scan does not see EB, one states far less in one direction.
Example example(std::uint64_t seed) {
  Random random(seed);
  Example e;
  for (const std::string artefact : {"A", "B"}) {
    const Matrix6 usual = someRegistration(random, 1.0);
    for (int k = 0; k < 4; ++k) {
      ScanResult s;
      s.capture.artefact = artefact;
      s.capture.cycle = "M" + std::to_string(k);
      s.reference = k == 0;
      if (k > 0) {
        s.registration.covariance = usual * (artefact == "A" && k == 2 ? 1.6 : random.uniform(0.8, 1.5));
        for (int i = 0; i < 6; ++i)
          for (int q = 0; q < 6; ++q) s.calibration_spread(i, q) = (i < 3 ? 5e-4 : 5e-6) * random.normal();
      }
      if (artefact == "A" && k == 2) {
        s.registration.covariance.row(4).setZero();
        s.registration.covariance.col(4).setZero();
        s.registration.covariance(4, 4) = std::numeric_limits<double>::infinity();
      }
      if (artefact == "B" && k == 3) {
        s.registration.covariance.row(0) *= 0.3;
        s.registration.covariance.col(0) *= 0.3;
      }
      for (int i = 0; i < 6; ++i)
        if (std::isfinite(s.registration.covariance(i, i))) e.rows.push_back({e.scans.size(), i});
      e.scans.push_back(s);
    }
  }
  return e;
}

TEST(ScanNoise, HoldsWhatTheRegistrationsStateAndWhatScansShare) {
  for (std::uint64_t seed = 1; seed < 8; ++seed) {
    const Example e = example(seed);
    const ScanNoise noise = noiseOfScans(e.scans, e.rows);
    ASSERT_EQ(noise.sigma.size(), 2U * 24U - 1U);
    const auto n = static_cast<Eigen::Index>(e.rows.size());
    Eigen::MatrixXd c(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j)
        c(i, j) = noise.shared.covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      const double variance = std::pow(noise.sigma[static_cast<std::size_t>(i)], 2);
      EXPECT_LE(c(i, i), variance * (1.0 + 1e-12));
      c(i, i) = variance;
    }
    const Eigen::VectorXd size = c.diagonal().cwiseSqrt().cwiseInverse();
    EXPECT_GT(
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(size.asDiagonal() * c * size.asDiagonal()).eigenvalues()(0),
        -1e-10);
    const auto unit = [](int component) { return component < 3 ? um_per_mm : urad_per_rad; };
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const ScanRow& a = e.rows[static_cast<std::size_t>(i)];
        const ScanRow& b = e.rows[static_cast<std::size_t>(j)];
        const ScanResult& sa = e.scans[a.scan];
        const ScanResult& sb = e.scans[b.scan];
        const double units = unit(a.component) * unit(b.component);
        const double spread =
            units * sa.calibration_spread.row(a.component).dot(sb.calibration_spread.row(b.component));
        const double tolerance =
            1e-9 * noise.sigma[static_cast<std::size_t>(i)] * noise.sigma[static_cast<std::size_t>(j)];
        if (a.scan == b.scan && !sa.reference) {
          EXPECT_NEAR(c(i, j), units * sa.registration.covariance(a.component, b.component) + spread, tolerance);
        } else if (sa.capture.artefact != sb.capture.artefact) {
          EXPECT_NEAR(c(i, j), spread, tolerance);
        }
        if (sb.reference && !sa.reference && sa.capture.artefact == sb.capture.artefact && a.component == b.component) {
          EXPECT_NEAR(c(i, i) + c(j, j) - 2.0 * c(i, j), c(i, i), tolerance)
              << "the difference to the reference is as uncertain as the row";
        }
      }
    }
    // A: half of the smallest registration is that of the reference, as all scans are alike.
    Eigen::Index smallest = 1;
    for (Eigen::Index k = 1; k < 4; ++k)
      if (e.scans[static_cast<std::size_t>(k)].registration.covariance.topLeftCorner<3, 3>().trace() <
          e.scans[static_cast<std::size_t>(smallest)].registration.covariance.topLeftCorner<3, 3>().trace())
        smallest = k;
    const Matrix6& least = e.scans[static_cast<std::size_t>(smallest)].registration.covariance;
    EXPECT_NEAR(std::pow(noise.sigma[0], 2), um_per_mm * um_per_mm * least(0, 0),
                1e-9 * um_per_mm * um_per_mm * least(0, 0));
  }
}

TEST(ScanNoise, AReferenceThatNothingWasComparedWithHasTheSmallestSigma) {
  ScanResult s;
  s.reference = true;
  const ScanNoise noise = noiseOfScans({s}, {{0, 0}, {0, 5}});
  EXPECT_EQ(noise.sigma, (std::vector<double>{1e-4, 0.01}));
  EXPECT_TRUE(noise.shared.empty());
}

}  // namespace
}  // namespace spindrift
