// SPDX-License-Identifier: GPL-3.0-or-later
// Artefacts that bend between the scans: no motion of a scan model explains them. The change of shape is found beside
// the motion, and the uncertainty of the motion has what cannot be told from it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/machine/campaign.h"
#include "core/scanning/evaluate_scans.h"
#include "core/scanning/scan_evaluation.h"
#include "core/scanning/scan_points.h"
#include "core/simulation/virtual_profiler.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

ArtefactBending someBending(Random& random, double size_mm) {
  ArtefactBending b;
  b.along_mm = size_mm * (random.uniform() < 0.5 ? -1.0 : 1.0) * random.uniform(0.5, 1.5);
  b.across_mm = random.normal(0.0, 0.1 * size_mm);
  b.twist_mm = random.normal(0.0, 0.2 * size_mm);
  b.held_at = random.uniform(-1.0, 1.0);
  b.skew = random.normal(0.0, 0.2);
  return b;
}

VirtualScanCampaign plan(const std::string& model, Random& random) {
  VirtualScanCampaign c;
  c.mounting.scan_model = model;
  c.mounting.alpha_rad = random.normal(0.0, 0.003);
  c.mounting.beta_rad = random.normal(0.0, 0.003);
  c.mounting.gamma_rad = model == "rigid" ? 0.0 : random.normal(0.0, 0.01);  // rigid: a circle cannot show it
  c.mounting.offset_mm = {1.2, -0.7, 3.1};
  c.optics.profile_points = 300;
  c.optics.profile_interval_mm = 0.1;
  c.optics.profile_spacing_mm = 0.2;
  c.pocket.circle_mm = {0.0, 0.0, 0.0, 9.0};
  c.pocket.scan_from_mm = -11.0;
  c.pocket.scan_to_mm = 11.0;
  VirtualArtefact a;
  a.y_mm = 350.0;
  a.surface.bumps = {{{3.0, 9.0}, 2.5, 0.5}, {{8.0, 30.0}, 3.0, -0.4}};
  c.artefacts.push_back(a);
  c.cycles = {{"C0", 0.0, 40.0}, {"C1", 3600.0, 40.0}, {"C2", 10800.0, 40.0}};
  std::array<std::array<double, 2>, 6> wave{};
  for (std::size_t i = 0; i < 6; ++i) wave[i] = {random.normal(0.0, i < 3 ? 0.01 : 2e-5), 6.3 * random.uniform()};
  const bool rigid = model == "rigid";
  c.error = [wave, rigid](double time_s, double y_mm) {
    SmallError e;
    for (int i = 0; i < 6; ++i) {
      const auto& [size, phase] = wave[static_cast<std::size_t>(i)];
      const double v = (1.0 - std::exp(-time_s / 3600.0)) * size * std::sin((rigid ? 0.0 : y_mm) / 286.5 + phase);
      (i < 3 ? e.translation_mm[i] : e.rotation_rad[i - 3]) = v;
    }
    return e;
  };
  return c;
}

/// Error of the deviation of a scan over its standard uncertainty, by component; NaN where it is not observed.
std::array<double, 6> standardisedErrors(const VirtualScanCampaign& campaign, const ScanEvaluation& e,
                                         const ScanCapture& capture, const RegistrationResult& r) {
  const double y = capture.y_mm + r.centroid_mm.y();
  const SmallError truth =
      (campaign.error(capture.time_s, y) - campaign.error(0.0, y)).at(e.mounting.arm_mm(r.centroid_mm, e.scan_model));
  const Eigen::Matrix<double, 6, 1> variance =
      r.covariance.diagonal() + calibrationSpread(r, e.mounting.calibration).rowwise().squaredNorm();
  std::array<double, 6> out{};
  for (int i = 0; i < 6; ++i) {
    const double error =
        i < 3 ? r.translation_mm[i] - truth.translation_mm[i] : r.rotation_rad[i - 3] - truth.rotation_rad[i - 3];
    out[static_cast<std::size_t>(i)] = std::isfinite(variance[i]) ? error / std::sqrt(variance[i]) : std::nan("");
  }
  return out;
}

struct Tally {
  std::array<double, 6> squares{}, inside{}, count{};
  double scans = 0.0, told = 0.0, rejected = 0.0;
};

Tally statedAgainstTrue(const std::string& model, double size_mm, int campaigns, std::uint64_t seed) {
  Random random(seed);
  Tally tally;
  for (int n = 0; n < campaigns; ++n) {
    VirtualScanCampaign c = plan(model, random);
    const ArtefactBending bending = someBending(random, size_mm);
    if (size_mm > 0.0) c.bending["A1"] = bending;
    const testing::TempFolder folder;
    JobContext job;
    writeVirtualScanCampaign(c, folder.path(), random.bits(), job);
    const ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
    tally.rejected += static_cast<double>(e.rejected.size());
    for (const ScanResult& s : e.scans) {
      if (s.reference) continue;
      tally.scans += 1.0;
      tally.told += s.registration.free_form ? 1.0 : 0.0;
      const std::array<double, 6> errors = standardisedErrors(c, e, s.capture, s.registration);
      for (std::size_t i = 0; i < 6; ++i) {
        if (std::isnan(errors[i])) continue;
        tally.squares[i] += errors[i] * errors[i];
        tally.inside[i] += std::abs(errors[i]) < 1.96 ? 1.0 : 0.0;
        tally.count[i] += 1.0;
      }
    }
  }
  return tally;
}

class BendingScans : public ::testing::TestWithParam<const char*> {};

TEST_P(BendingScans, UncertaintyOfTheMotionCovers) {
  for (const double size_mm : {0.003, 0.02}) {
    const Tally tally = statedAgainstTrue(GetParam(), size_mm, 24, 101);
    EXPECT_EQ(tally.rejected, 0.0);
    EXPECT_GT(tally.told, 0.95 * tally.scans);
    for (std::size_t i = 0; i < 6; ++i) {
      if (tally.count[i] < 6.0) continue;  // the bending leaves too little of it
      EXPECT_LT(std::sqrt(tally.squares[i] / tally.count[i]), 1.4) << size_mm << ' ' << i;
      EXPECT_GT(tally.inside[i], 0.85 * tally.count[i]) << size_mm << ' ' << i;
    }
  }
}

TEST_P(BendingScans, WithoutBendingNothingIsSaid) {
  EXPECT_EQ(statedAgainstTrue(GetParam(), 0.0, 12, 78).told, 0.0);
  Random random(5);
  const VirtualScanCampaign c = plan(GetParam(), random);
  const testing::TempFolder folder;
  JobContext job;
  writeVirtualScanCampaign(c, folder.path(), 3, job);
  const ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
  const RegistrationTarget target(readScanPoints(Campaign::read(folder.path()), "captures/clouds/A1_C0.pcd").used());
  const PointCloud scan = readScanPoints(Campaign::read(folder.path()), "captures/clouds/A1_C2.pcd").used();
  RegistrationOptions options;
  options.scan_model = scanModelFromString(GetParam());
  options.machine_from_profiler = e.mounting.calibration.rotation();
  const RegistrationResult motion = registerToSurface(scan, target, options);
  options.free_form = true;
  const RegistrationResult either = registerToSurface(scan, target, options);
  EXPECT_EQ(either.translation_mm, motion.translation_mm);
  EXPECT_EQ(either.covariance, motion.covariance);
}

TEST_P(BendingScans, TheChangeIsFoundAndSaid) {
  Random random(6);
  VirtualScanCampaign c = plan(GetParam(), random);
  c.bending["A1"] = {.along_mm = 0.012, .across_mm = 0.001, .twist_mm = 0.002, .held_at = 0.9};
  const testing::TempFolder folder;
  JobContext job;
  writeVirtualScanCampaign(c, folder.path(), 4, job);
  const Campaign campaign = Campaign::read(folder.path());
  const ScanEvaluation e = evaluateScanCampaign(campaign, "", job);
  ASSERT_EQ(e.scans.size(), 3U);
  const ScanResult& s = e.scans.back();
  ASSERT_TRUE(s.registration.free_form);
  // Without mean and tilt the curvature along y is 2/3 of P_2, that across and the twist as they stand.
  const double part = 1.0 - std::exp(-s.capture.time_s / 7200.0);
  const double rms_mm =
      part * std::hypot(2.0 / 3.0 * 0.012 / std::sqrt(5.0), 2.0 / 3.0 * 0.001 / std::sqrt(5.0), 0.002 / 3.0);
  EXPECT_NEAR(s.registration.free_form->rms_mm(), rms_mm, 0.2 * rms_mm);
  const Eigen::Vector2d middle = 0.5 * (s.registration.free_form->low_mm + s.registration.free_form->high_mm);
  const FreeForm::Value at = s.registration.free_form->shape(middle.x(), middle.y());
  EXPECT_NEAR(at.mm, -part * (0.012 + 0.001) / 3.0, 0.15 * part * 0.013 / 3.0);
  EXPECT_LT(at.standard_uncertainty_mm, 0.1 * part * 0.013 / 3.0);
  // The motion alone would be far off what it states.
  const RegistrationTarget target(readScanPoints(campaign, "captures/clouds/A1_C0.pcd").used());
  RegistrationOptions options;
  options.scan_model = e.scan_model;
  options.machine_from_profiler = e.mounting.calibration.rotation();
  options.at_y_mm = s.registration.centroid_mm.y();
  const RegistrationResult motion =
      registerToSurface(readScanPoints(campaign, s.capture.cloud).used(), target, options);
  EXPECT_GT(std::abs(standardisedErrors(c, e, s.capture, motion)[2]), 20.0);
  EXPECT_LT(std::abs(standardisedErrors(c, e, s.capture, s.registration)[2]), 3.0);

  const InstrumentEvaluation rows = evaluateScans(campaign, "", job);
  bool said = false;
  for (const EvaluationWarning& w : rows.warnings)
    said = said || w.sentence.find("free-form field") != std::string::npos;
  EXPECT_TRUE(said);
  const nlohmann::json& cycles = rows.details["cycles"];
  EXPECT_TRUE(cycles[0]["free_form"].is_null());
  const nlohmann::json& form = cycles[2]["free_form"];
  EXPECT_NEAR(form["rms_um"].get<double>(), 1e3 * s.registration.free_form->rms_mm(), 1e-9);
  EXPECT_EQ(form["height_um"].size(), form["y_mm"].size());
  EXPECT_EQ(form["standard_uncertainty_um"][0].size(), form["x_mm"].size());
  // What both warm scans leave open is alike: it cancels in part in their difference.
  double sigma = 0.0, before = 0.0, common = 0.0;
  std::size_t last = 0, first = 0;
  for (std::size_t r = 0; r < rows.observations.rows.size(); ++r) {
    const Observation& o = rows.observations.rows[r];
    if (o.component != Component::EZ) continue;
    if (o.state == "C2") {
      sigma = o.sigma;
      last = r;
    }
    if (o.state == "C1") {
      before = o.sigma;
      first = r;
    }
  }
  common = rows.observations.shared.covariance(first, last);
  EXPECT_GT(sigma, 1.0) << "um: as large as what bends";
  EXPECT_GT(common, 0.8 * sigma * before);
}

INSTANTIATE_TEST_SUITE_P(Models, BendingScans, ::testing::Values("rigid", "push_broom"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace spindrift
