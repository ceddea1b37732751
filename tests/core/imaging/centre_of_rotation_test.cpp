// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/centre_of_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/core/imaging/synthetic_pose.h"

namespace spindrift {
namespace {

using testing::syntheticPose;

struct Truth {
  Eigen::Vector2d centre{3.0, 24.0};  // pixels from the image's centre
  std::vector<Eigen::Vector2d> places;
};

/// Four fiducials in two states, three images each turned by 8 degrees.
std::vector<RotationSet> makeSets(Random& random, Truth& truth, double noise_um,
                                  const Eigen::Vector2d& camera_move_px = Eigen::Vector2d::Zero()) {
  std::vector<RotationSet> sets;
  truth.places.clear();
  for (int state = 0; state < 2; ++state) {
    for (int f = 0; f < 4; ++f) {
      RotationSet set{"F" + std::to_string(f + 1), "M" + std::to_string(state), {}};
      const Eigen::Vector2d place(random.uniform(1000, 1800), random.uniform(1000, 1800));
      truth.places.push_back(place);
      for (const double spindle : {-8.0, 0.0, 8.0}) {
        const Eigen::Vector2d error(random.normal(0, noise_um), random.normal(0, noise_um));
        const Eigen::Vector2d centre = truth.centre + (state == 1 ? camera_move_px : Eigen::Vector2d::Zero());
        RotationImage image;
        image.pose = syntheticPose(1.23, 0.05 * f + 0.11 - spindle * rad_per_deg, place + error, centre);
        image.spindle_deg = spindle;
        set.images.push_back(image);
      }
      sets.push_back(set);
    }
  }
  return sets;
}

TEST(CentreOfRotation, ExactWithoutNoise) {
  Random random(1);
  Truth truth;
  const CentreResult result = fitCentreOfRotation(makeSets(random, truth, 0.0));
  ASSERT_EQ(result.status, FitStatus::Converged);
  EXPECT_EQ(result.pooling, CentrePooling::All);
  for (std::size_t i = 0; i < result.sets.size(); ++i) {
    EXPECT_LT((result.sets[i].place_um - truth.places[i]).norm(), 1e-6);
    EXPECT_LT((result.sets[i].centre_px - Eigen::Vector2d(962.5, 563.5)).norm(), 1e-6);
    EXPECT_FALSE(result.sets[i].algebraic_centre_px) << "no tracks were measured";
  }
}

TEST(CentreOfRotation, StatedUncertaintiesHoldAndPoolingIsKept) {
  Random random(2);
  int inside = 0;
  int total = 0;
  int pooled = 0;
  double own = 0.0;
  double centre_error = 0.0;
  double centre_sigma = 0.0;
  constexpr int campaigns = 400;
  for (int n = 0; n < campaigns; ++n) {
    Truth truth;
    const CentreResult result = fitCentreOfRotation(makeSets(random, truth, 0.3));
    pooled += result.pooling == CentrePooling::All ? 1 : 0;
    for (std::size_t f = 0; f < 4; ++f) {
      // Displacement between the states: difference of places, and its covariance.
      const Eigen::Vector2d error =
          (result.sets[f + 4].place_um - result.sets[f].place_um) - (truth.places[f + 4] - truth.places[f]);
      const auto a = static_cast<Eigen::Index>(2 * f);
      const auto b = static_cast<Eigen::Index>(2 * f + 8);
      for (int k = 0; k < 2; ++k) {
        const double variance =
            result.covariance(a + k, a + k) + result.covariance(b + k, b + k) - 2.0 * result.covariance(a + k, b + k);
        inside += error(k) * error(k) < 1.96 * 1.96 * variance ? 1 : 0;
        ++total;
      }
    }
    own += result.sets[0].own_centre_sigma_px * 1.23 / campaigns;
    centre_error += (result.sets[0].centre_px - Eigen::Vector2d(962.5, 563.5)).squaredNorm() / 2 / campaigns;
    centre_sigma += result.sets[0].centre_sigma_px.squaredNorm() / 2 / campaigns;
  }
  EXPECT_GT(inside, 0.925 * total);
  EXPECT_LT(inside, 0.97 * total);
  EXPECT_GT(pooled, 0.95 * campaigns);
  // One set alone: sigma / angle = 0.3 / (8 deg * sqrt 2) = 1.5 um.
  EXPECT_NEAR(own, 1.5, 0.2);
  EXPECT_NEAR(std::sqrt(centre_error / centre_sigma), 1.0, 0.1);
}

TEST(CentreOfRotation, AlgebraicCirclesOfMeasuredTracksAreBiasedAndTheJointCentreIsNot) {
  Random random(7);
  Eigen::Vector2d algebraic = Eigen::Vector2d::Zero();
  Eigen::Vector2d joint = Eigen::Vector2d::Zero();
  const auto measure = [&](double noise_px, int campaigns) {
    algebraic.setZero();
    joint.setZero();
    double count = 0.0;
    for (int n = 0; n < campaigns; ++n) {
      Truth truth;
      std::vector<RotationSet> sets = makeSets(random, truth, 0.0);
      for (RotationSet& set : sets) {
        for (RotationImage& image : set.images) {
          const Eigen::Matrix2d pixel_per_um = image.pose.patternPerPixel().inverse();
          for (int k = 0; k < 16; ++k) {
            MarkPosition mark;
            mark.pattern_um = 250.0 * Eigen::Vector2d(k % 4, k / 4);  // below and left of the axis
            const Eigen::Vector2d exact = pixel_per_um * (mark.pattern_um - image.pose.patternAt({0, 0}));
            mark.pixel =
                image.pose.distorted(exact) + Eigen::Vector2d(random.normal(0, noise_px), random.normal(0, noise_px));
            mark.sigma_px = std::max(noise_px, 1e-6);
            image.marks.push_back(mark);
          }
          image.pose = fitImagePose(image.marks, image.pose.centre_px, 0.0);
        }
      }
      const CentreResult result = fitCentreOfRotation(sets);
      for (const SetCentre& c : result.sets) {
        EXPECT_EQ(c.algebraic_tracks, 16);
        algebraic += *c.algebraic_centre_px - Eigen::Vector2d(962.5, 563.5);
        joint += c.centre_px - Eigen::Vector2d(962.5, 563.5);
        count += 1.0;
      }
    }
    algebraic /= count;
    joint /= count;
  };
  measure(0.0, 1);
  EXPECT_LT(algebraic.norm(), 1e-5);
  measure(3.0, 60);  // the bias grows with the square of the noise
  EXPECT_GT(algebraic.norm(), 4.0) << "towards the marks";
  EXPECT_LT(joint.norm(), 0.2 * algebraic.norm()) << algebraic.norm();
}

TEST(CentreOfRotation, ACameraThatMovedIsNoticed) {
  Random random(3);
  int noticed = 0;
  double squares = 0.0;
  constexpr int campaigns = 100;
  for (int n = 0; n < campaigns; ++n) {
    Truth truth;
    const CentreResult result = fitCentreOfRotation(makeSets(random, truth, 0.25, {6.0, -5.0}));
    noticed += result.pooling == CentrePooling::PerState ? 1 : 0;
    for (std::size_t f = 0; f < 4; ++f) {
      squares += ((result.sets[f + 4].place_um - result.sets[f].place_um) - (truth.places[f + 4] - truth.places[f]))
                     .squaredNorm() /
                 (8 * campaigns);
    }
  }
  EXPECT_GT(noticed, 0.9 * campaigns);
  EXPECT_LT(std::sqrt(squares), 1.2);  // ignoring the move would give 5 to 7 um
}

TEST(CentreOfRotation, ImagesThatDoNotTurnAreDegenerate) {
  RotationSet set{"F1", "M0", {}};
  for (int i = 0; i < 3; ++i) set.images.push_back({syntheticPose(1.2, 0.1, {1000, 1000}, {0, 0}), {0, 0}, 0.0});
  EXPECT_EQ(fitCentreOfRotation({set}).status, FitStatus::Degenerate);
}

}  // namespace
}  // namespace spindrift
