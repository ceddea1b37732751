// SPDX-License-Identifier: GPL-3.0-or-later
// One bad scan in a campaign: a sentence that says what is wrong with it, and all others evaluated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "core/base/atomic_file.h"
#include "core/machine/campaign.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/scan_evaluation.h"
#include "core/simulation/virtual_profiler.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

constexpr const char* bad_scan = "captures/clouds/A1_C1.pcd";

/// Two artefacts in three cycles, scan model push_broom.
VirtualScanCampaign plan() {
  VirtualScanCampaign c;
  c.mounting.scan_model = "push_broom";
  c.optics.profile_points = 300;
  c.optics.profile_interval_mm = 0.1;
  c.optics.profile_spacing_mm = 0.2;
  c.pocket.scan_from_mm = -14.0;
  c.pocket.scan_to_mm = 14.0;
  for (const auto& [id, y] : {std::pair<const char*, double>{"A1", 350.0}, {"A2", 1250.0}}) {
    VirtualArtefact a;
    a.id = id;
    a.y_mm = y;
    c.artefacts.push_back(a);
  }
  c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1800.0, 40.0}, {"C2", 7200.0, 40.0}};
  c.error = [](double time_s, double) {
    return SmallError{{1e-6 * time_s, 2e-6 * time_s, -1e-6 * time_s}, {2e-9 * time_s, 0.0, 1e-9 * time_s}};
  };
  return c;
}

void changePoints(const std::filesystem::path& file, const std::function<void(std::vector<Eigen::Vector3d>&)>& change) {
  PointCloud cloud = readCloud(file);
  change(cloud.points_mm);
  // As a profiler writes them: profile after profile, from left to right.
  std::stable_sort(cloud.points_mm.begin(), cloud.points_mm.end(),
                   [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
                     return std::abs(a.y() - b.y()) > 0.02 ? a.y() < b.y() : a.x() < b.x();
                   });
  writeCloud(cloud, file);
}

class BadScan : public ::testing::Test {
 protected:
  void SetUp() override {
    JobContext job;
    writeVirtualScanCampaign(plan(), folder_.path(), 9, job);
  }
  ScanEvaluation evaluate() {
    JobContext job;
    return evaluateScanCampaign(Campaign::read(folder_.path()), "", job);
  }
  void change(const std::function<void(std::vector<Eigen::Vector3d>&)>& f) { changePoints(folder_ / bad_scan, f); }
  void changeBytes(const std::function<std::string(std::string)>& f) {
    writeFileAtomically(folder_ / bad_scan, f(readFile(folder_ / bad_scan)));
  }
  /// The scan is rejected with these words, the other five are evaluated.
  void expectRejected(const std::string& words) {
    const ScanEvaluation e = evaluate();
    ASSERT_EQ(e.rejected.size(), 1U);
    EXPECT_EQ(e.rejected[0].capture, bad_scan);
    EXPECT_NE(e.rejected[0].reason.find(words), std::string::npos) << e.rejected[0].reason;
    EXPECT_NE(e.rejected[0].reason.find("A1_C1.pcd"), std::string::npos) << e.rejected[0].reason;
    EXPECT_EQ(std::count(e.rejected[0].reason.begin(), e.rejected[0].reason.end(), '\n'), 0);
    EXPECT_EQ(e.scans.size(), 5U);
    for (const ScanResult& s : e.scans) EXPECT_TRUE(s.reference || s.registration.usable()) << s.capture.cloud;
  }
  /// The scan is evaluated with a warning, and its deviation stays within a few of its uncertainties.
  void expectWarning(const ScanEvaluation& good, const std::string& words) {
    const ScanEvaluation e = evaluate();
    EXPECT_TRUE(e.rejected.empty());
    ASSERT_EQ(e.scans.size(), 6U);
    const auto is_bad = [](const ScanResult& s) { return s.capture.cloud == bad_scan; };
    const ScanResult& s = *std::find_if(e.scans.begin(), e.scans.end(), is_bad);
    const ScanResult& was = *std::find_if(good.scans.begin(), good.scans.end(), is_bad);
    ASSERT_EQ(s.warnings.size(), 1U);
    EXPECT_NE(s.warnings[0].find(words), std::string::npos) << s.warnings[0];
    for (int i = 0; i < 3; ++i) {
      const double sigma = s.registration.standardUncertainty(i);
      EXPECT_GT(sigma, was.registration.standardUncertainty(i)) << i;
      EXPECT_LT(std::abs(s.registration.translation_mm[i] - was.registration.translation_mm[i]), 4.0 * sigma) << i;
    }
  }
  testing::TempFolder folder_;
};

using Points = std::vector<Eigen::Vector3d>;

TEST_F(BadScan, Truncated) {
  changeBytes([](const std::string& b) { return b.substr(0, b.size() / 2); });
  expectRejected("is truncated: the header promises");
}
TEST_F(BadScan, CutInsideItsHeader) {
  changeBytes([](const std::string& b) { return b.substr(0, b.find("POINTS")); });
  expectRejected("the DATA line is missing");
}
TEST_F(BadScan, HeaderThatContradictsItself) {
  changeBytes([](std::string b) { return b.replace(b.find("HEIGHT 1"), 8, "HEIGHT 3"); });
  expectRejected("times HEIGHT 3 but POINTS");
}
TEST_F(BadScan, HeaderThatPromisesMore) {
  changeBytes([](std::string b) {
    for (const char* key : {"WIDTH ", "POINTS "}) b.insert(b.find(key) + std::string(key).size(), "9");
    return b;
  });
  expectRejected("is truncated: the header promises 9");
}
TEST_F(BadScan, ZeroPoints) {
  writeFileAtomically(folder_ / bad_scan,
                      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 0\nHEIGHT 1\nPOINTS 0\n"
                      "DATA binary\n");
  expectRejected("states zero points");
}
TEST_F(BadScan, AllNaN) {
  std::string text =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 500\nHEIGHT 1\nPOINTS 500\n"
      "DATA ascii\n";
  for (int i = 0; i < 500; ++i) text += "nan nan nan\n";
  writeFileAtomically(folder_ / bad_scan, text);
  expectRejected("none of which is a number (all NaN)");
}
TEST_F(BadScan, Micrometres) {
  change([](Points& points) {
    for (Eigen::Vector3d& p : points) p *= 1000.0;
  });
  expectRejected("the unit seems to be µm");
}
TEST_F(BadScan, HeightsInMicrometres) {
  change([](Points& points) {
    for (Eigen::Vector3d& p : points) p.z() *= 1000.0;
  });
  expectRejected("its heights seem to be in µm");
}
TEST_F(BadScan, Metres) {
  change([](Points& points) {
    for (Eigen::Vector3d& p : points) p *= 0.001;
  });
  expectRejected("the unit seems to be m");
}
TEST_F(BadScan, AnotherArtefact) {
  change([](Points& points) {
    Random random(2);
    for (Eigen::Vector3d& p : points)
      p.z() = 1.2 * std::cos(0.5 * p.x() + 0.3) + 1.5 * std::sin(0.25 * p.y() + 0.7) + random.normal(0.0, 7e-4);
  });
  expectRejected("does not show the same surface as the reference");
}
TEST_F(BadScan, FlatPlate) {
  change([](Points& points) {
    Random random(3);
    for (Eigen::Vector3d& p : points) p.z() = 0.002 * p.x() + random.normal(0.0, 7e-4);
  });
  expectRejected("is nearly flat");
}
TEST_F(BadScan, MirroredInX) {
  change([](Points& points) {
    for (Eigen::Vector3d& p : points) p.x() = -p.x();
  });
  expectRejected("is mirrored in x");
}
TEST_F(BadScan, MirroredInY) {
  change([](Points& points) {
    for (Eigen::Vector3d& p : points) p.y() = 41.0 - p.y();
  });
  expectRejected("is mirrored in y");
}
TEST_F(BadScan, UpsideDown) {
  change([](Points& points) {
    for (Eigen::Vector3d& p : points) p.z() = -p.z();
  });
  expectRejected("is upside down");
}
TEST_F(BadScan, CutShort) {
  const ScanEvaluation good = evaluate();
  change([](Points& points) { std::erase_if(points, [](const Eigen::Vector3d& p) { return p.y() > 27.0; }); });
  expectWarning(good, "cut short or hidden");
}
TEST_F(BadScan, CutShortToAFifth) {
  change([](Points& points) { std::erase_if(points, [](const Eigen::Vector3d& p) { return p.y() > 8.0; }); });
  expectRejected("covers only");
}
/// A hand between profiler and artefact: high, uneven.
void holdIn(Points& points, double from_mm, double to_mm, double left_mm) {
  Random random(4);
  for (Eigen::Vector3d& p : points)
    if (p.y() > from_mm && p.y() < to_mm && p.x() > left_mm)
      p.z() = 15.0 + 3.0 * std::cos(0.25 * p.x()) + random.normal(0.0, 0.05);
}
TEST_F(BadScan, HandInTheScan) {
  const ScanEvaluation good = evaluate();
  change([](Points& points) { holdIn(points, 12.0, 24.0, -2.0); });
  expectWarning(good, "something lay in the way");
}
TEST_F(BadScan, HandOverMostOfTheScan) {
  change([](Points& points) { holdIn(points, 4.0, 36.0, -100.0); });
  expectRejected("another artefact, something over it");
}
TEST_F(BadScan, TwoArtefactsOneBehindTheOther) {
  const PointCloud other = readCloud(folder_ / "captures/clouds/A2_C1.pcd");
  change([&](Points& points) {
    for (const Eigen::Vector3d& p : other.points_mm) points.emplace_back(p.x(), p.y() + 60.0, p.z());
  });
  expectRejected("holds two separate surfaces (a gap of");
}
TEST_F(BadScan, TwoArtefactsBesideEachOther) {
  const PointCloud other = readCloud(folder_ / "captures/clouds/A2_C1.pcd");
  change([&](Points& points) {
    for (const Eigen::Vector3d& p : other.points_mm) points.emplace_back(p.x() + 16.0, p.y(), p.z());
  });
  expectRejected("holds two separate surfaces (a gap of");
}
TEST_F(BadScan, AReferenceThatIsBadIsReplacedByTheNextScan) {
  const auto first = folder_ / "captures/clouds/A1_C0.pcd";
  writeFileAtomically(first, readFile(first).substr(0, 5000));
  const ScanEvaluation e = evaluate();
  ASSERT_EQ(e.rejected.size(), 1U);
  EXPECT_EQ(e.scans.size(), 5U);
  const auto reference = std::find_if(e.scans.begin(), e.scans.end(),
                                      [](const ScanResult& s) { return s.reference && s.capture.artefact == "A1"; });
  ASSERT_NE(reference, e.scans.end());
  EXPECT_EQ(reference->capture.cycle, "C1");
}

}  // namespace
}  // namespace spindrift
