// SPDX-License-Identifier: GPL-3.0-or-later
// What the observations of the microscope share, against the covariances of what was measured.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/imaging/fiducial_displacement.h"
#include "tests/core/imaging/synthetic_pose.h"

namespace spindrift {
namespace {

constexpr int fiducial_count = 4;
constexpr int state_count = 3;

FocusSet focusSet(Random& random, double peak_mm) {
  FocusSet set{"a set", {}, {}};
  for (int i = -3; i <= 3; ++i) {
    const double z = 0.1 * i;
    set.height_mm.push_back(z);
    set.normalised.push_back(1.0 / (1.0 + std::pow((z - peak_mm) / 0.21, 2)) * (1.0 + random.normal(0.0, 0.003)));
  }
  return set;
}

/// Measured three times; F4 has an own direction, F3 no height in the last state, F2 only the reference in the plane.
FiducialDisplacement displacement(std::uint64_t seed, const Eigen::Vector2d& camera_move_px = Eigen::Vector2d::Zero()) {
  Random random(seed);
  FiducialDisplacement out;
  out.axes.phi_sigma_rad = 2e-3;
  std::vector<RotationSet> rotations;
  for (int k = 0; k < state_count; ++k) {
    for (int f = 0; f < fiducial_count; ++f) {
      FiducialState s;
      s.fiducial = "F" + std::to_string(f + 1);
      s.state = "M" + std::to_string(k);
      s.time_s = 3600.0 * k + 60.0 * f;
      s.commanded_mm = {0.01 * k, 0.02 * f};
      if (!(f == 1 && k > 0)) {
        RotationSet set{s.fiducial, s.state, {}};
        const Eigen::Vector2d place(random.uniform(1000, 1800), random.uniform(1000, 1800));
        for (int i = 0; i < 3 + k; ++i) {
          const double spindle = -8.0 + 8.0 * i;
          RotationImage image;
          image.pose = testing::syntheticPose(
              1.23, 0.05 * f + 0.11 - spindle * rad_per_deg,
              place + Eigen::Vector2d(random.normal(0.0, 0.3), random.normal(0.0, 0.3)),
              Eigen::Vector2d(3.0, 24.0) + (k > 0 ? camera_move_px : Eigen::Vector2d::Zero().eval()));
          image.spindle_deg = spindle;
          set.images.push_back(image);
        }
        s.centre = rotations.size();
        rotations.push_back(set);
      }
      if (!(f == 2 && k == state_count - 1)) {
        s.focus_set = out.focus_sets.size();
        out.focus_sets.push_back(focusSet(random, random.normal(0.0, 0.01)));
      }
      out.states.push_back(s);
    }
  }
  for (int f = 0; f < fiducial_count; ++f)
    out.directions.push_back({"F" + std::to_string(f + 1), 0.3 * f - 0.4, f == 3 ? 1e-3 : 3e-3, f != 3});
  out.centres = fitCentreOfRotation(rotations);
  out.focus = fitFocus(out.focus_sets);
  for (FiducialState& s : out.states) {
    const auto reference = static_cast<std::size_t>(s.fiducial.back() - '1');
    if (s.centre) {
      s.xy_reference = reference;
      s.xy_um = out.states[reference].state == s.state
                    ? Eigen::Vector2d::Zero().eval()
                    : Eigen::Vector2d(random.normal(0.0, 20.0), random.normal(0.0, 20.0));
    }
    if (s.focus_set) {
      s.z_reference = reference;
      s.z_um = out.states[reference].state == s.state ? 0.0 : random.normal(0.0, 20.0);
    }
  }
  makeFiducialObservations(out);
  return out;
}

const FiducialState& stateOf(const FiducialDisplacement& d, const Observation& o) {
  for (const FiducialState& s : d.states)
    if (s.fiducial == o.point && s.state == o.state) return s;
  throw std::logic_error("no such state");
}

/// Covariance of the displacements of two rows that are not of the reference, from those of what was measured.
double expected(const FiducialDisplacement& d, const Observation& a, const Observation& b) {
  const FiducialState& sa = stateOf(d, a);
  const FiducialState& sb = stateOf(d, b);
  if ((a.component == Component::EZ) != (b.component == Component::EZ)) return 0.0;
  if (a.component == Component::EZ) {
    const auto p = [&](std::size_t i, std::size_t j) {
      return d.focus.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    };
    const std::size_t ra = *d.states[*sa.z_reference].focus_set;
    const std::size_t rb = *d.states[*sb.z_reference].focus_set;
    return p(*sa.focus_set, *sb.focus_set) - p(*sa.focus_set, rb) - p(ra, *sb.focus_set) + p(ra, rb);
  }
  const auto directionOf = [&](const std::string& f) { return d.directions[static_cast<std::size_t>(f.back() - '1')]; };
  const auto turn = [&](const Observation& o) {
    const double psi = directionOf(o.point).psi_rad;
    return o.component == Component::EX ? Eigen::RowVector2d(std::cos(psi), -std::sin(psi))
                                        : Eigen::RowVector2d(std::sin(psi), std::cos(psi));
  };
  const auto s = [&](std::size_t i, std::size_t j) -> Eigen::Matrix2d {
    return d.centres.covariance.block<2, 2>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(j));
  };
  const FiducialState& ra = d.states[*sa.xy_reference];
  const FiducialState& rb = d.states[*sb.xy_reference];
  double out =
      turn(a) *
      (s(*sa.centre, *sb.centre) - s(*sa.centre, *rb.centre) - s(*ra.centre, *sb.centre) + s(*ra.centre, *rb.centre)) *
      turn(b).transpose();
  const auto per_psi = [](const Observation& o, const FiducialState& now, const FiducialState& reference) {
    const Eigen::Vector2d moved = *now.xy_um + (now.commanded_mm - reference.commanded_mm) * um_per_mm;
    return o.component == Component::EX ? -moved.y() : moved.x();
  };
  const FiducialDirection da = directionOf(a.point);
  const FiducialDirection db = directionOf(b.point);
  const double directions = a.point == b.point       ? da.sigma_rad * da.sigma_rad
                            : da.pooled && db.pooled ? d.axes.phi_sigma_rad * d.axes.phi_sigma_rad
                                                     : 0.0;
  return out + per_psi(a, sa, ra) * per_psi(b, sb, rb) * directions;
}

class FiducialNoise : public ::testing::TestWithParam<double> {};

TEST_P(FiducialNoise, IsThatOfWhatWasMeasured) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const FiducialDisplacement d = displacement(seed, Eigen::Vector2d(GetParam(), 0.0));
    ASSERT_EQ(d.centres.status, FitStatus::Converged);
    ASSERT_EQ(d.centres.pooling, GetParam() > 0.0 ? CentrePooling::PerState : CentrePooling::All);
    const std::vector<Observation>& rows = d.observations.rows;
    const SharedNoise& shared = d.observations.shared;
    ASSERT_EQ(rows.size(), 31U);
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd c(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        c(i, j) = shared.covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    for (Eigen::Index i = 0; i < n; ++i) {
      const Observation& o = rows[static_cast<std::size_t>(i)];
      EXPECT_LE(c(i, i), o.sigma * o.sigma * (1.0 + 1e-12));
      c(i, i) = o.sigma * o.sigma;
    }
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(c).eigenvalues()(0), -1e-12);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Observation& a = rows[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < n; ++j) {
        const Observation& b = rows[static_cast<std::size_t>(j)];
        const double size = a.sigma * b.sigma;
        if (a.state != "M0" && b.state != "M0") {
          EXPECT_NEAR(c(i, j), expected(d, a, b), 1e-8 * size) << a.point << a.state << b.point << b.state;
        }
        // The difference to the row of the reference is as uncertain as the row.
        if (a.state != "M0" && b.state == "M0" && a.point == b.point && a.component == b.component) {
          EXPECT_NEAR(c(i, i) + c(j, j) - 2.0 * c(i, j), a.sigma * a.sigma, 1e-12);
        }
      }
    }
    // Few causes: one or two centres or a shape, directions, two for each series.
    EXPECT_LE(shared.factors().size(), (GetParam() > 0.0 ? 6U : 2U) + 3U + 5U + 2U * 11U);
    for (const Observation& o : rows) EXPECT_GT(o.sigma, 0.0);
    const FiducialState& alone = d.states[1];
    EXPECT_EQ(alone.xy_sigma_um.x(), d.centres.sets[*alone.centre].place_sigma_um) << "nothing to compare with";
  }
}

INSTANTIATE_TEST_SUITE_P(FiducialNoise, FiducialNoise, ::testing::Values(0.0, 20.0));

TEST(FiducialCauses, OwnPartsLeaveWhatComesThroughCentresAndShape) {
  const FiducialDisplacement d = displacement(3);
  Eigen::MatrixXd rest = d.centres.covariance;
  for (std::size_t k = 0; k < d.centres.sets.size(); ++k) {
    const double own = d.centres.sets[k].own_place_sigma_um;
    EXPECT_LT(own, d.centres.sets[k].place_sigma_um);
    for (int axis = 0; axis < 2; ++axis) rest(2 * k + axis, 2 * k + axis) -= own * own;
  }
  const Eigen::VectorXd of_centres = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(rest).eigenvalues();
  EXPECT_GT(of_centres(0), -1e-10);
  EXPECT_LT(of_centres(of_centres.size() - 3), 1e-10) << "one centre: two columns";
  Eigen::MatrixXd peaks = d.focus.covariance;
  for (std::size_t k = 0; k < d.focus.peaks.size(); ++k) peaks(k, k) -= std::pow(d.focus.peaks[k].own_sigma_um, 2);
  const Eigen::VectorXd of_shape = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(peaks).eigenvalues();
  EXPECT_GT(of_shape(0), -1e-8 * d.focus.covariance.trace());
  EXPECT_LT(of_shape(of_shape.size() - 4), 1e-8 * d.focus.covariance.trace()) << "a shape of three terms";
}

}  // namespace
}  // namespace spindrift
