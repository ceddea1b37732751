// SPDX-License-Identifier: GPL-3.0-or-later
// Scan campaigns with a known truth (a folder and <folder>.truth.json beside it): what the evaluation gives against the
// truth, in the units of the stated uncertainty, and the stated covariance against the Cramer-Rao bound.
//   scan_dev_benchmark CAMPAIGN ...
#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <map>

#include "core/base/json_reader.h"
#include "core/base/units.h"
#include "core/scanning/axis_errors.h"
#include "core/scanning/scan_evaluation.h"

namespace {

using namespace spindrift;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const std::array<const char*, 6> names{"EX", "EY", "EZ", "EA", "EB", "EC"};

/// Root mean squares of errors and of errors over their stated uncertainty, by component.
struct Tally {
  Vector6 error = Vector6::Zero(), ratio = Vector6::Zero(), count = Vector6::Zero();
  double largest = 0.0;
  void add(int i, double e, double sigma) {
    error[i] += e * e;
    ratio[i] += e * e / (sigma * sigma);
    count[i] += 1.0;
    largest = std::max(largest, std::abs(e / sigma));
  }
  void print(const char* what) const {
    fmt::print("  {:38}", what);
    for (int i = 0; i < 6; ++i)
      fmt::print("  {} {:8.4f} ({:.2f})", names[static_cast<std::size_t>(i)], std::sqrt(error[i] / count[i]),
                 std::sqrt(ratio[i] / count[i]));
    fmt::print("   largest {:.2f} sigma\n", largest);
  }
};

/// Covariance at the slide's origin if only the scans' own noise counted: `noise` of (u, w) through the lever.
Matrix6 atOrigin(const Matrix6& noise, const Eigen::Vector3d& arm) {
  Matrix6 lever = Matrix6::Identity();
  lever.topRightCorner<3, 3>() = crossMatrix(arm);
  return lever * noise * lever.transpose();
}

void score(const std::filesystem::path& folder) {
  const Campaign campaign = Campaign::read(folder);
  const nlohmann::json truth = JsonNode::read(folder.string() + ".truth.json").value();
  JobContext job;
  const ScanEvaluation e = evaluateScanCampaign(campaign, "", job);
  fmt::print("{}, scan model {}, {} scans, {} rejected\n", folder.filename().string(), toString(e.scan_model),
             e.scans.size(), e.rejected.size());
  const ProfilerCalibration& c = e.mounting.calibration;
  const std::array<const char*, 6> keys{"alpha_rad", "beta_rad", "gamma_rad", "dx_mm", "dy_mm", "dz_mm"};
  const std::array<double, 6> found{c.alpha_rad,     c.beta_rad,      c.gamma_rad,
                                    c.offset_mm.x(), c.offset_mm.y(), c.offset_mm.z()};
  fmt::print("  calibration, error (stated)");
  for (int i = 0; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(i);
    fmt::print("  {} {:.2g} ({:.2g})", keys[k], found[k] - truth["calibration"][keys[k]].get<double>(),
               c.standardUncertainty(i));
  }
  fmt::print("\n");
  Tally artefact, without_angles, origin;
  Vector6 bound = Vector6::Zero(), bound_origin = Vector6::Zero();
  // Errors of the profiler's angles turn every deviation alike; taken out with the true ones they show the rest.
  const Eigen::Vector3d angle_error(found[0] - truth["calibration"]["alpha_rad"].get<double>(),
                                    found[1] - truth["calibration"]["beta_rad"].get<double>(),
                                    found[2] - truth["calibration"]["gamma_rad"].get<double>());
  double scans = 0.0;
  for (const ScanResult& s : e.scans) {
    if (s.reference) continue;
    scans += 1.0;
    const auto find = [&](const char* list) {
      for (const auto& row : truth[list])
        if (row["artefact"] == s.capture.artefact && row["cycle"] == s.capture.cycle) return row;
      throw InputError("The truth lacks a scan.");
    };
    const nlohmann::json near = find("at_artefact"), far = find("errors");
    const Eigen::Matrix<double, 6, 3> turn = calibrationSensitivity(s.registration, c);
    const Vector6 calibration = calibrationSpread(s.registration, c).rowwise().squaredNorm();
    const Vector6 angles = turn * angle_error;
    const Matrix6 correlated = s.registration.noise_correlation * s.registration.white_covariance;
    const Matrix6 far_bound = atOrigin(correlated, e.mounting.arm_mm(s.registration.centroid_mm, e.scan_model));
    for (const Component k : all_components) {
      const int i = static_cast<int>(k);
      const auto n = static_cast<std::size_t>(i);
      const double unit = isRotation(k) ? urad_per_rad : um_per_mm;
      if (std::isfinite(s.registration.covariance(i, i))) {
        const double error = valueOf(SmallError{s.registration.translation_mm, s.registration.rotation_rad}, k) -
                             near[names[n]].get<double>();
        artefact.add(i, error, unit * std::sqrt(s.registration.covariance(i, i) + calibration[i]));
        without_angles.add(i, error - unit * angles[i], unit * std::sqrt(s.registration.covariance(i, i)));
        bound[i] += std::sqrt(s.registration.covariance(i, i) / correlated(i, i));
      }
      if (!s.axis.determined(i)) continue;
      const std::string key = fmt::format("{}Y_{}", names[n], isRotation(k) ? "urad" : "um");
      origin.add(i, valueOf(s.axis.error, k) - far[key].get<double>(), unit * std::sqrt(s.axis.covariance(i, i)));
      bound_origin[i] += std::sqrt(s.axis.covariance(i, i) / far_bound(i, i));
    }
  }
  fmt::print("  rms error in um and urad (error over stated uncertainty)\n");
  artefact.print("at the artefact");
  without_angles.print("at the artefact, true angles");
  origin.print("at the slide's origin");
  const auto ratios = [&](const char* what, const Vector6& sum) {
    fmt::print("  {:38}", what);
    for (int i = 0; i < 6; ++i) fmt::print("  {} {:.2f}", names[static_cast<std::size_t>(i)], sum[i] / scans);
    fmt::print("\n");
  };
  ratios("stated / Cramer-Rao, artefact", bound);
  ratios("stated / Cramer-Rao, origin", bound_origin);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) score(argv[i]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
