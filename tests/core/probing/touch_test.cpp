// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/probing/touch.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/core/probing/probing_machines.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using namespace probing_test;

constexpr const char* header = "time_s,cycle,artefact,feature,stylus,c_deg,touch,x_mm,y_mm,z_mm,nx,ny,nz\n";

class TouchFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    const std::filesystem::path file = folder_.path() / "touches.csv";
    std::ofstream(file) << text;
    return file;
  }
  /// The complaint about rows after the header, or an empty text.
  std::string complaint(const std::string& rows, const MachineDescription* machine = nullptr) {
    try {
      const TouchList list = TouchList::read(write(header + rows));
      if (machine != nullptr) list.checkAgainst(*machine);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  testing::TempFolder folder_;
};

TEST_F(TouchFile, WritesWhatItReads) {
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 2, {}, 1);
  const TouchList list = TouchList::read(write(run.list.csv()));
  ASSERT_EQ(list.touches.size(), run.list.touches.size());
  EXPECT_EQ(list.csv(), run.list.csv());
  EXPECT_EQ(list.cycles(), (std::vector<std::string>{"M0", "M1"}));
  EXPECT_EQ(list.touches[4].line, 6U);
  list.checkAgainst(m);
}

TEST_F(TouchFile, BadRowsGiveOneClearSentence) {
  EXPECT_EQ(complaint("0,M0,bar,H1,p0,0,0,1,2,3,1,0,0\n1,M0,bar,H1,p0,0,1,1,2,3,-1,0,0\n"), "");
  EXPECT_NE(complaint("0,M0,bar,H1,p0,0,0,1,2,3,0,0,0\n").find("(0, 0, 0)"), std::string::npos);
  EXPECT_NE(complaint("0,M0,bar,H1,p0,0,0,1,2,3,1,1,0\n").find("unit vector"), std::string::npos);
  EXPECT_NE(complaint("5,M0,bar,H1,p0,0,0,1,2,3,1,0,0\n4,M0,bar,H1,p0,0,1,1,2,3,-1,0,0\n").find("backwards"),
            std::string::npos);
  EXPECT_NE(complaint("5,M0,bar,H1,p0,0,0,1,2,3,1,0,0\n5,M0,bar,H1,p0,0,1,1,2,3,-1,0,0\n").find("duplicate"),
            std::string::npos);
  EXPECT_NE(complaint("5,M0,bar,H1,p0,0,0,1,2,3,1,0,0\n6,M0,bar,H1,p0,0,0,1,2,3,-1,0,0\n").find("duplicate"),
            std::string::npos);
  EXPECT_NE(complaint("0,M0,bar,H1,p0,0,0,nan,2,3,1,0,0\n").find("x_mm"), std::string::npos);
  EXPECT_NE(complaint("0,M0,bar,H1,p0,0,1.5,1,2,3,1,0,0\n").find("1.5"), std::string::npos);
  EXPECT_NE(complaint("0,M0,bar,H1,p0,1e300,0,1,2,3,1,0,0\n").find("-36000 to 36000"), std::string::npos);
  EXPECT_NE(complaint("").find("no touches"), std::string::npos);
}

TEST_F(TouchFile, TheMachineFileDecidesWhatIsKnown) {
  const MachineDescription m = machineFrom(holeMachineText());
  EXPECT_NE(complaint("0,M0,plate,H1,p0,0,0,1,2,3,1,0,0\n", &m).find("\"plate\" is not in the machine file"),
            std::string::npos);
  EXPECT_NE(complaint("0,M0,bar,H9,p0,0,0,1,2,3,1,0,0\n", &m).find("H1, H2"), std::string::npos);
  EXPECT_NE(complaint("0,M0,bar,H1,p7,0,0,1,2,3,1,0,0\n", &m).find("radius is unknown"), std::string::npos);
}

TEST_F(TouchFile, MissingStylusRadiusIsRefused) {
  std::string text = holeMachineText();
  text.replace(text.find("\"radius_mm\":1.5,"), 16, "");
  EXPECT_THROW((void)machineFrom(text), InputError);
}

TEST_F(TouchFile, InchesAreRecognised) {
  const MachineDescription holes = machineFrom(holeMachineText());
  const MachineDescription balls = machineFrom(ballMachineText());
  for (const MachineDescription* m : {&holes, &balls}) {
    TouchList list = runCycles(*m, 2, {}, 1).list;
    for (Touch& t : list.touches) t.position_mm /= 25.4;
    try {
      list.checkAgainst(*m);
      FAIL() << "inches were taken for millimetres";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("inches"), std::string::npos) << error.what();
    }
  }
  // A single cycle in inches.
  TouchList list = runCycles(holes, 4, {}, 1).list;
  for (Touch& t : list.touches) {
    if (t.cycle == "M2") t.position_mm /= 25.4;
  }
  EXPECT_THROW((void)evaluateHoleCycles(list, holes, holes.artefacts.front()), InputError);
}

/// What the check of a list against the machine says, or an empty text.
std::string checkOf(const TouchList& list, const MachineDescription& machine) {
  try {
    list.checkAgainst(machine);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

// Columns exported in another order, a sign of another control, a left-handed certificate: balls may stand in any
// direction, so that the evaluation would give wrong axes without a word.
TEST_F(TouchFile, BallsAsInAMirrorAreRefused) {
  const MachineDescription balls = machineFrom(ballMachineText());
  const TouchList right = runCycles(balls, 2, {}, 1).list;
  EXPECT_EQ(checkOf(right, balls), "");
  TouchList turned = right;  // another place on the table is allowed
  for (Touch& t : turned.touches) {
    t.position_mm = Eigen::Vector3d(400.0 - t.position_mm.y(), t.position_mm.x(), t.position_mm.z());
    t.approach = Eigen::Vector3d(-t.approach.y(), t.approach.x(), t.approach.z());
  }
  EXPECT_EQ(checkOf(turned, balls), "");
  const std::string mirror = "touches.csv: the balls of balls lie as in a mirror";
  const auto refused = [&](const TouchList& list, const MachineDescription& machine) {
    TouchList named = list;
    named.file = "touches.csv";
    return checkOf(named, machine);
  };
  TouchList swapped = right;
  TouchList swapped_positions = right;
  TouchList negative = right;
  for (std::size_t i = 0; i < right.touches.size(); ++i) {
    std::swap(swapped.touches[i].position_mm.x(), swapped.touches[i].position_mm.y());
    std::swap(swapped.touches[i].approach.x(), swapped.touches[i].approach.y());
    std::swap(swapped_positions.touches[i].position_mm.x(), swapped_positions.touches[i].position_mm.y());
    negative.touches[i].position_mm.z() *= -1.0;
  }
  for (const TouchList* list : {&swapped, &swapped_positions, &negative}) {
    EXPECT_EQ(refused(*list, balls).find(mirror), 0U) << refused(*list, balls);
  }
  MachineDescription left_handed = balls;
  for (ArtefactBall& ball : left_handed.artefacts.front().balls)
    std::swap(ball.certified_mm.x(), ball.certified_mm.y());
  EXPECT_EQ(refused(right, left_handed).find(mirror), 0U) << refused(right, left_handed);
  MachineDescription other_order = balls;  // swapped names are another mistake, told from the distances
  std::swap(other_order.artefacts.front().balls[1].certified_mm, other_order.artefacts.front().balls[2].certified_mm);
  EXPECT_EQ(refused(right, other_order), "");
}

// The program ended with a crash where every touch of a bar was left out.
TEST_F(TouchFile, AListOfWhichNothingFitsIsRefused) {
  const MachineDescription bar = machineFrom(holeMachineText());
  const TouchList right = runCycles(bar, 3, {}, 1).list;
  TouchList negative = right;
  for (Touch& t : negative.touches) t.position_mm.x() *= -1.0;
  negative.file = "touches.csv";
  for (std::size_t i = 0; i < negative.touches.size(); ++i) negative.touches[i].line = i + 2;
  try {
    (void)evaluateHoleCycles(negative, bar, bar.artefacts.front());
    FAIL() << "a list with the wrong sign was evaluated";
  } catch (const InputError& error) {
    const std::string sentence = error.what();
    EXPECT_EQ(sentence.find("touches.csv, line "), 0U) << sentence;
    EXPECT_NE(sentence.find("none of the "), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("away from H"), std::string::npos) << sentence;
  }
  MachineDescription reversed = bar;
  reversed.artefacts.front().direction_at_c0 *= -1.0;
  EXPECT_THROW((void)evaluateHoleCycles(right, reversed, reversed.artefacts.front()), InputError);
}

TEST_F(TouchFile, MetresAreRecognised) {
  const MachineDescription bar = machineFrom(holeMachineText());
  const auto complaint = [](const TouchList& list, const MachineDescription& machine) {
    try {
      list.checkAgainst(machine);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const VirtualRun run = runCycles(bar, 2, {}, 1);
  EXPECT_EQ(complaint(run.list, bar), "");
  TouchList metres = run.list;
  for (Touch& t : metres.touches) t.position_mm /= 1000.0;
  EXPECT_NE(complaint(metres, bar).find("1000 times too small, so positions look like metres"), std::string::npos);
  MachineDescription certificate = bar;
  for (double& s : certificate.artefacts.front().nominal_positions_mm) s /= 1000.0;
  EXPECT_NE(complaint(run.list, certificate).find("1000 times too large: the machine file looks like metres"),
            std::string::npos);
}

TEST(Feature, BadlySpreadTouchesNameTheWeakDirection) {
  TouchList list;
  for (int k = 0; k < 4; ++k) {
    Touch t;
    t.feature = "B1";
    const Eigen::Vector3d v(std::cos(1.5 * k), std::sin(1.5 * k), 0.0);
    t.position_mm = 15.0 * v;
    t.approach = -v;
    list.touches.push_back(t);
  }
  const std::vector<std::size_t> all{0, 1, 2, 3};
  const ProbedFeature equator = fitFeature(list, all, FeatureKind::Sphere, 2.5);
  EXPECT_EQ(equator.status, FitStatus::Degenerate);
  EXPECT_NE(equator.message.find("z"), std::string::npos) << equator.message;
  const ProbedFeature few = fitFeature(list, std::span(all).first(2), FeatureKind::Sphere, 2.5);
  EXPECT_EQ(few.status, FitStatus::Degenerate);
}

TEST(Feature, HoleGivesDiameterThroughTheStylusRadius) {
  const MachineDescription m = machineFrom(holeMachineText());
  VirtualProbeOptions options;
  options.noise_um = options.surface_noise_um = 0.0;
  const VirtualRun run = runCycles(m, 1, options, 1);
  std::map<std::pair<std::string, double>, std::vector<std::size_t>> touches_of;
  for (std::size_t i = 0; i < run.list.touches.size(); ++i)
    touches_of[{run.list.touches[i].feature, run.list.touches[i].c_deg}].push_back(i);
  ASSERT_EQ(touches_of.size(), 12U);
  const HoleBarSetup setup = HoleBarSetup::of(m, m.artefacts.front());
  for (const auto& [hole, touches] : touches_of) {
    const ProbedFeature f = fitFeature(run.list, touches, FeatureKind::Hole, m.findStylus("p0")->radius_mm);
    ASSERT_EQ(f.status, FitStatus::Converged) << f.message;
    EXPECT_NEAR(f.diameter_mm, 12.0, 1e-9);
    EXPECT_LT((f.centre_mm - setup.nominal_mm(HoleBarSetup::holeIndex(f.feature), f.c_deg)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace spindrift
