// SPDX-License-Identifier: GPL-3.0-or-later
// A whole campaign of scans, 8 artefacts in 10 cycles of about 640,000 points each: time and largest memory of its
// evaluation, and errors of the deviation at the artefacts against the truth. `scan_campaign_benchmark FOLDER [CYCLES]`
// writes the campaign into FOLDER (about 90 MB a cycle) unless it is there already.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/base/units.h"
#include "core/scanning/scan_evaluation.h"
#include "core/simulation/virtual_profiler.h"

namespace {

using namespace spindrift;

double rss_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Error of the axis at the slide's origin: grows with time, differs from artefact to artefact, the same within a scan.
SmallError truth(double time_s, double carriage_mm) {
  const double y_mm = 500.0 * std::floor(carriage_mm / 500.0);
  const double t = time_s / 36000.0;
  SmallError e;
  e.translation_mm = t * Eigen::Vector3d(0.020, -0.015, 0.030 + 1e-5 * y_mm);
  e.rotation_rad = t * Eigen::Vector3d(25e-6, -18e-6, 30e-6 - 1e-8 * y_mm);
  return e;
}

VirtualScanCampaign campaignOf(int cycles) {
  VirtualScanCampaign c;
  c.mounting.alpha_rad = 0.0029;
  c.mounting.beta_rad = -0.0013;
  c.mounting.offset_mm = {2.771, -0.876, 4.219};
  c.optics.profile_points = 1800;  // the artefact stands beside the middle of the profile
  c.optics.profile_interval_mm = 0.01;
  c.optics.profile_spacing_mm = 0.0704;
  for (int k = 0; k < 8; ++k) {
    VirtualArtefact a;
    a.id = "A" + std::to_string(k + 1);
    a.y_mm = 350.0 + 500.0 * k;
    c.artefacts.push_back(a);
  }
  for (int k = 0; k < cycles; ++k) c.cycles.push_back({"C" + std::to_string(k), 3600.0 * k, 40.0});
  c.error = truth;
  return c;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::printf("scan_campaign_benchmark FOLDER [CYCLES]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  JobContext job;
  if (!std::filesystem::exists(folder)) {
    writeVirtualScanCampaign(campaignOf(argc > 2 ? std::stoi(argv[2]) : 10), folder, 1, job);
    std::printf("written; run again for time and memory of the evaluation alone\n");
    return 0;
  }
  const auto start = std::chrono::steady_clock::now();
  const Campaign campaign = Campaign::read(folder);
  const ScanEvaluation e = evaluateScanCampaign(campaign, "", job);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> stated = squares;
  double points = 0.0;
  int count = 0;
  for (const ScanResult& s : e.scans) {
    if (s.reference || !s.registration.usable()) continue;
    const Eigen::Vector3d arm = e.mounting.arm_mm(s.registration.centroid_mm, e.scan_model);
    // The scan of an artefact takes a while; the error hardly changes in it.
    const SmallError now = truth(s.capture.time_s, s.capture.y_mm);
    const auto reference = std::find_if(e.scans.begin(), e.scans.end(), [&s](const ScanResult& r) {
      return r.reference && r.capture.artefact == s.capture.artefact;
    });
    const SmallError cold = truth(reference->capture.time_s, s.capture.y_mm);
    SmallError change;
    change.translation_mm = now.translation_mm - cold.translation_mm;
    change.rotation_rad = now.rotation_rad - cold.rotation_rad;
    Eigen::Matrix<double, 6, 1> error;
    error << s.registration.translation_mm - change.at(arm).translation_mm,
        s.registration.rotation_rad - change.rotation_rad;
    squares += error.cwiseAbs2();
    stated += s.registration.covariance.diagonal() +
              calibrationSpread(s.registration, e.mounting.calibration).rowwise().squaredNorm();
    points += static_cast<double>(s.registration.points_used);
    ++count;
  }
  std::printf("%zu scans, %d registered onto their references, %.0f points used each, %zu rejected\n", e.scans.size(),
              count, points / std::max(1, count), e.rejected.size());
  std::printf("evaluated in %.1f s, largest memory %.0f MB\n", seconds, rss_MB());
  const char* const names[] = {"EX um", "EY um", "EZ um", "EA urad", "EB urad", "EC urad"};
  std::printf("deviation at the artefact: rms error and stated standard uncertainty (calibration included)\n");
  for (int i = 0; i < 6; ++i) {
    const double unit = i < 3 ? um_per_mm : 1e6;
    std::printf("  %-8s %8.3f %8.3f\n", names[i], unit * std::sqrt(squares[i] / std::max(1, count)),
                unit * std::sqrt(stated[i] / std::max(1, count)));
  }
  return 0;
}
