// SPDX-License-Identifier: GPL-3.0-or-later
// Images that contradict what was commanded: turned otherwise, elsewhere, out of focus.
#include "core/imaging/capture_agreement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/core/imaging/synthetic_pose.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The images of one fiducial as FORMATS.md commands them, the spindle's axis away from the centre of the image.
struct Set {
  double psi_rad = 0.05;
  Eigen::Vector2d place_um{1400, 1400};
  Eigen::Vector2d axis_px{60, -35};
  double noise_um = 0.0;
  Random random{1};

  SeenCapture shot(const std::string& fiducial, CaptureRole role, int index, const Eigen::Vector3d& position_mm,
                   double spindle_deg, const Eigen::Vector3d& moved_mm, double turned_deg) {
    SeenCapture c{fiducial, "M0", role, index, position_mm, spindle_deg, std::nullopt, 0.0};
    const Eigen::Vector2d tool =
        moved_mm.head<2>() * um_per_mm + Eigen::Vector2d(random.normal(0.0, noise_um), random.normal(0.0, noise_um));
    const Eigen::Vector2d place = place_um + Eigen::Rotation2Dd(-psi_rad) * tool;
    c.pose = testing::syntheticPose(2.4, psi_rad - 0.11 - turned_deg * rad_per_deg, place, axis_px);
    c.sharpness = 0.3 * std::exp(-std::pow(moved_mm.z() / 0.15, 2));
    return c;
  }
  SeenCapture shot(CaptureRole role, int index, const Eigen::Vector3d& offset_mm, double spindle_deg) {
    return shot("F1", role, index, offset_mm, spindle_deg, offset_mm, spindle_deg);
  }
  std::vector<SeenCapture> all(const std::vector<double>& angles) {
    std::vector<SeenCapture> list;
    for (int i = 0; i < static_cast<int>(angles.size()); ++i) {
      list.push_back(shot(CaptureRole::Rotation, i, {0, 0, 0}, angles[static_cast<std::size_t>(i)]));
    }
    for (int i = -2; i <= 2; ++i) list.push_back(shot(CaptureRole::XAxis, i + 2, {0.0508 * i, 0, 0}, 0.0));
    for (int i = -2; i <= 2; ++i) list.push_back(shot(CaptureRole::YAxis, i + 2, {0, 0.0508 * i, 0}, 0.0));
    for (int i = -2; i <= 2; ++i) list.push_back(shot(CaptureRole::Focus, i + 2, {0, 0, 0.127 * i}, 0.0));
    return list;
  }
};

std::vector<std::string> onlySaid(const std::vector<std::string>& sentences) {
  std::vector<std::string> said;
  std::copy_if(sentences.begin(), sentences.end(), std::back_inserter(said), [](const auto& s) { return !s.empty(); });
  return said;
}

TEST(CaptureAgreement, AnImageTurnedOtherwiseIsToldWithBothAngles) {
  Set set;
  std::vector<SeenCapture> there{set.shot(CaptureRole::Rotation, 0, {0, 0, 0}, 0.0)};
  const SeenCapture wrong = set.shot("F1", CaptureRole::Rotation, 1, {0, 0, 0}, 90.0, {0, 0, 0}, 8.0);
  EXPECT_THAT(contradictionOf(wrong, there), HasSubstr("turned by 8°, the plan says 90°"));
  for (const double angle : {90.0, 180.0, 270.0, -90.0, -8.0}) {
    EXPECT_THAT(contradictionOf(set.shot(CaptureRole::Rotation, 1, {0, 0, 0}, angle), there), IsEmpty()) << angle;
  }
  // The sign counts: the camera turned clockwise.
  const SeenCapture back = set.shot("F1", CaptureRole::Rotation, 1, {0, 0, 0}, 8.0, {0, 0, 0}, -8.0);
  EXPECT_THAT(contradictionOf(back, there), HasSubstr("turned by −8°, the plan says 8°"));
  // A spindle set by hand.
  const SeenCapture near = set.shot("F1", CaptureRole::Rotation, 1, {0, 0, 0}, 90.0, {0, 0, 0}, 91.5);
  EXPECT_THAT(contradictionOf(near, there), IsEmpty());
  EXPECT_THAT(contradictionOf(wrong, {}), IsEmpty()) << "nothing to compare with";
}

TEST(CaptureAgreement, AWholeListFindsTheOneThatIsWrong) {
  Set set;
  std::vector<SeenCapture> list = set.all({0, 90, 180, 270});
  EXPECT_THAT(onlySaid(contradictionsOf(list)), IsEmpty());
  // The first one is the wrong one: the majority tells.
  list[0] = set.shot("F1", CaptureRole::Rotation, 0, {0, 0, 0}, 0.0, {0, 0, 0}, 33.0);
  const std::vector<std::string> sentences = contradictionsOf(list);
  EXPECT_THAT(sentences[0], HasSubstr("turned by"));
  EXPECT_EQ(onlySaid(sentences).size(), 1U);
}

TEST(CaptureAgreement, AnAxisThatDidNotMoveIsTold) {
  Set set;
  std::vector<SeenCapture> list = set.all({-8, 0, 8});
  list[3] = set.shot("F1", CaptureRole::XAxis, 0, {-0.1016, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  std::vector<std::string> sentences = contradictionsOf(list);
  EXPECT_THAT(sentences[3], HasSubstr("shifted by"));
  EXPECT_EQ(onlySaid(sentences).size(), 1U);
  // On arrival: one other position is enough.
  const std::vector<SeenCapture> there{set.shot(CaptureRole::XAxis, 0, {-0.1016, 0, 0}, 0.0)};
  const SeenCapture still = set.shot("F1", CaptureRole::XAxis, 1, {-0.0508, 0, 0}, 0.0, {-0.1016, 0, 0}, 0.0);
  EXPECT_THAT(contradictionOf(still, there), HasSubstr("shifted by 0 µm, the plan says 51 µm"));
}

TEST(CaptureAgreement, AnotherFiducialUnderTheNameOfThisOneIsToldByItsPlace) {
  Set set;
  Set other;
  other.place_um = {1180, 1520};
  std::vector<SeenCapture> list = set.all({0, 90, 180, 270});
  // A rotation image: its place under the spindle's axis follows from the others.
  list[2] = other.shot(CaptureRole::Rotation, 2, {0, 0, 0}, 180.0);
  std::vector<std::string> sentences = contradictionsOf(list);
  EXPECT_THAT(sentences[2], HasSubstr("another fiducial"));
  EXPECT_EQ(onlySaid(sentences).size(), 1U);
  const SeenCapture late = other.shot(CaptureRole::Rotation, 3, {0, 0, 0}, 270.0);
  EXPECT_THAT(contradictionOf(late, {list[0], list[1]}), HasSubstr("another fiducial"));
}

TEST(CaptureAgreement, AnImageOutOfFocusForItsHeightIsTold) {
  Set set;
  std::vector<SeenCapture> list = set.all({-8, 0, 8});
  const std::size_t middle = 3 + 5 + 5 + 2;
  list[middle].sharpness = 0.02;
  std::vector<std::string> sentences = contradictionsOf(list);
  EXPECT_THAT(sentences[middle], HasSubstr("out of focus for its height of 0 mm"));
  EXPECT_EQ(onlySaid(sentences).size(), 1U);
  // On arrival: the sharp images at the height of the rotations and one below it tell.
  const SeenCapture below = set.shot(CaptureRole::Focus, 0, {0, 0, -0.254}, 0.0);
  SeenCapture lost = set.shot(CaptureRole::Focus, 1, {0, 0, -0.127}, 0.0);
  lost.sharpness = 0.3 * below.sharpness;
  EXPECT_THAT(contradictionOf(lost, {list[0], below}), HasSubstr("out of focus"));
}

TEST(CaptureAgreement, HonestScatterIsNotTold) {
  // Backlash, drift and a spindle set by hand, far above what the evaluation expects (0.25 um).
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Set set;
    set.noise_um = 4.0;
    set.random = Random(seed);
    std::vector<SeenCapture> list;
    for (const double angle : {-8.0, 0.0, 8.0}) {
      list.push_back(set.shot("F1", CaptureRole::Rotation, static_cast<int>(list.size()), {0, 0, 0}, angle, {0, 0, 0},
                              angle + set.random.uniform(-0.5, 0.5)));
    }
    for (int i = -2; i <= 2; ++i) list.push_back(set.shot(CaptureRole::XAxis, i + 2, {0.0508 * i, 0, 0}, 0.0));
    for (int i = -2; i <= 2; ++i) list.push_back(set.shot(CaptureRole::YAxis, i + 2, {0, 0.0508 * i, 0}, 0.0));
    std::vector<SeenCapture> there;
    for (const SeenCapture& c : list) {
      told += contradictionOf(c, there).empty() ? 0 : 1;
      there.push_back(c);
    }
    told += static_cast<int>(onlySaid(contradictionsOf(list)).size());
  }
  EXPECT_EQ(told, 0);
}

}  // namespace
}  // namespace spindrift
