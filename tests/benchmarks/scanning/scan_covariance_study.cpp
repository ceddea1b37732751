// SPDX-License-Identifier: GPL-3.0-or-later
// Does the covariance hold that the evaluation of scans states? Many small campaigns of the virtual profiler, each with
// its own mounting, artefacts, noise and smooth errors of the axis, go through the whole evaluation: calibration from
// the pocket, registration, deviation at the artefact, error at the slide's origin. Printed for every component: root
// mean square of error and of error over stated standard uncertainty, and the part inside 95 %, each with the 95 %
// interval that the number of campaigns allows (scans of a campaign share their reference and their calibration).
//   scan_covariance_study [campaigns] [rigid|push_broom] [seed]
#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/units.h"
#include "core/scanning/axis_errors.h"
#include "core/scanning/scan_evaluation.h"
#include "core/simulation/virtual_profiler.h"

namespace {

using namespace spindrift;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// What is studied beside white noise.
struct Setting {
  std::string name;
  double speckle_um = 0.5;
  int speckle_points = 3;
  double position_error_um = 0.1;
  double wave_mm = 1800.0;  ///< of the errors along the axis; 0: the same along a scan
};

struct Errors {
  double wave_mm = 0.0;
  std::array<std::array<double, 3>, 6> shape{};  ///< constant, sine, cosine; mm or rad
  [[nodiscard]] SmallError at(double time_s, double y_mm) const {
    const double q = 1.0 - std::exp(-time_s / 3600.0);
    const double place = wave_mm > 0.0 ? y_mm : 500.0 * std::floor(y_mm / 500.0);
    const double phase = 2.0 * std::numbers::pi * place / (wave_mm > 0.0 ? wave_mm : 1800.0);
    SmallError e;
    for (int i = 0; i < 6; ++i) {
      const auto& s = shape[static_cast<std::size_t>(i)];
      const double v = q * (s[0] + s[1] * std::sin(phase) + s[2] * std::cos(phase));
      (i < 3 ? e.translation_mm[i] : e.rotation_rad[i - 3]) = v;
    }
    return e;
  }
};

VirtualScanCampaign campaignOf(const std::string& model, const Setting& setting, Errors& errors, Random& random) {
  VirtualScanCampaign c;
  c.mounting.scan_model = model;
  const bool rigid = model == "rigid";
  c.mounting.alpha_rad = random.normal(0.0, rigid ? 0.005 : 0.02);  // as uncertain as the evaluation takes it to be
  c.mounting.beta_rad = random.normal(0.0, 0.005);
  c.mounting.gamma_rad = random.normal(0.0, rigid ? 0.02 : 0.01);
  for (int i = 0; i < 3; ++i) c.mounting.offset_mm[i] = random.normal(0.0, 2.0);
  c.optics.profile_points = 700;
  c.optics.profile_interval_mm = 0.05;
  c.optics.profile_spacing_mm = 0.15;
  c.optics.speckle_noise_um = setting.speckle_um;
  c.optics.speckle_points = setting.speckle_points;
  c.optics.position_error_um = setting.position_error_um;
  for (int k = 0; k < 2; ++k) {
    VirtualArtefact a;
    a.id = "A" + std::to_string(k + 1);
    a.y_mm = 350.0 + 900.0 * k;
    a.centre_mm = c.mounting.offset_mm + Eigen::Vector3d(0.0, 20.5, 0.0);
    a.yaw_rad = random.normal(0.0, 0.01);
    c.artefacts.push_back(a);
  }
  c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1800.0, 40.0}, {"C2", 10800.0, 40.0}};
  errors.wave_mm = setting.wave_mm;
  for (std::size_t i = 0; i < 6; ++i)
    for (double& v : errors.shape[i]) v = random.normal(0.0, i < 3 ? 0.010 : 10e-6);
  c.error = [&errors](double time_s, double y_mm) { return errors.at(time_s, y_mm); };
  return c;
}

/// Sums over campaigns of what the scans of one campaign give.
class Tally {
 public:
  /// One row per scan: error and standard uncertainty by component; NaN where it is not stated.
  void add(const std::vector<std::array<Vector6, 2>>& scans) {
    for (int i = 0; i < 6; ++i) {
      double squares = 0.0, ratios = 0.0, inside = 0.0, n = 0.0;
      for (const auto& [error, sigma] : scans) {
        if (!std::isfinite(sigma[i])) continue;
        const double t = error[i] / sigma[i];
        squares += error[i] * error[i];
        ratios += t * t;
        inside += std::abs(t) < 1.96 ? 1.0 : 0.0;
        n += 1.0;
      }
      if (n > 0.0) of_[static_cast<std::size_t>(i)].push_back({squares / n, ratios / n, inside / n});
    }
  }
  void print(const std::string& what) const {
    fmt::print("  {}\n", what);
    for (const Component k : all_components) {
      const auto& all = of_[static_cast<std::size_t>(k)];
      if (all.size() < 5) {
        fmt::print("    {}  stated in {} campaigns only\n", toString(k), all.size());
        continue;
      }
      const std::array<double, 2> ratio = mean(all, 1), inside = mean(all, 2);
      const double unit = isRotation(k) ? urad_per_rad : um_per_mm;
      fmt::print(
          "    {}  rms error {:8.4f} {}  error/sigma {:.2f} [{:.2f}, {:.2f}]  inside 95 %: {:.1f} % [{:.1f}, {:.1f}]\n",
          toString(k), unit * std::sqrt(mean(all, 0)[0]), isRotation(k) ? "urad" : "um  ", std::sqrt(ratio[0]),
          std::sqrt(std::max(0.0, ratio[0] - 1.96 * ratio[1])), std::sqrt(ratio[0] + 1.96 * ratio[1]),
          100.0 * inside[0], 100.0 * std::max(0.0, inside[0] - 1.96 * inside[1]),
          100.0 * std::min(1.0, inside[0] + 1.96 * inside[1]));
    }
  }

 private:
  using Campaigns = std::vector<std::array<double, 3>>;
  /// Mean over campaigns and its standard error.
  static std::array<double, 2> mean(const Campaigns& all, std::size_t what) {
    double sum = 0.0, squares = 0.0;
    const auto n = static_cast<double>(all.size());
    for (const auto& c : all) sum += c[what] / n;
    for (const auto& c : all) squares += (c[what] - sum) * (c[what] - sum);
    return {sum, std::sqrt(squares / (n - 1.0) / n)};
  }
  std::array<Campaigns, 6> of_;
};

void study(const std::string& model, const Setting& setting, int campaigns, std::uint64_t seed,
           const std::filesystem::path& folder) {
  Random random(seed);
  Tally artefact, without_angles, origin;
  std::size_t rejected = 0, scans = 0;
  for (int n = 0; n < campaigns; ++n) {
    Errors errors;
    const VirtualScanCampaign plan = campaignOf(model, setting, errors, random);
    JobContext job;
    std::filesystem::remove_all(folder);
    writeVirtualScanCampaign(plan, folder, random.bits(), job);
    const ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder), "", job);
    rejected += e.rejected.size();
    ProfilerMounting true_mounting = e.mounting;
    ProfilerCalibration& c = true_mounting.calibration;
    c.alpha_rad = plan.mounting.alpha_rad;
    c.beta_rad = plan.mounting.beta_rad;
    c.gamma_rad = plan.mounting.gamma_rad;
    c.offset_mm = plan.mounting.offset_mm;
    const ProfilerCalibration& found = e.mounting.calibration;
    // What the scans show, in the machine axes that the true angles give.
    const Eigen::Matrix3d true_angles = c.rotation(), found_angles = found.rotation();
    const auto true_frame = [&](const Eigen::Vector3d& u) {
      Eigen::Matrix3d is = true_angles, was = found_angles;
      if (model == "push_broom") is.col(1) = was.col(1) = Eigen::Vector3d::UnitY();
      return Eigen::Vector3d(is * was.inverse() * u);
    };
    std::vector<std::array<Vector6, 2>> at_artefact, with_true_angles, at_origin;
    for (const ScanResult& s : e.scans) {
      if (s.reference) continue;
      ++scans;
      const RegistrationResult& r = s.registration;
      const double y = s.capture.y_mm + (model == "rigid" ? 0.0 : r.centroid_mm.y());
      const double cold = s.capture.artefact == "A1" ? 0.0 : 40.0;
      const SmallError far = errors.at(s.capture.time_s, y) - errors.at(cold, y);
      const SmallError near = far.at(true_mounting.arm_mm(r.centroid_mm, e.scan_model));
      Vector6 error, error_far, turned;
      turned << true_frame(r.translation_mm) - near.translation_mm,
          true_angles * found_angles.transpose() * r.rotation_rad - near.rotation_rad;
      error << r.translation_mm - near.translation_mm, r.rotation_rad - near.rotation_rad;
      error_far << s.axis.error.translation_mm - far.translation_mm, s.axis.error.rotation_rad - far.rotation_rad;
      const Vector6 calibration = calibrationSpread(r, found).rowwise().squaredNorm();
      at_artefact.push_back({error, (r.covariance.diagonal() + calibration).cwiseSqrt()});
      with_true_angles.push_back({turned, r.covariance.diagonal().cwiseSqrt()});
      at_origin.push_back({error_far, s.axis.covariance.diagonal().cwiseSqrt()});
    }
    artefact.add(at_artefact);
    without_angles.add(with_true_angles);
    origin.add(at_origin);
  }
  std::filesystem::remove_all(folder);
  fmt::print("{}, {}: {} campaigns, {} scans compared, {} rejected\n", model, setting.name, campaigns, scans, rejected);
  artefact.print("deviation at the artefact");
  without_angles.print("deviation at the artefact with the true angles of the profiler (registration alone)");
  origin.print("error at the slide's origin");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int campaigns = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::string only = argc > 2 ? argv[2] : "";
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  const std::vector<Setting> settings = {
      {"errors constant along a scan, white noise", 0.0, 3, 0.0, 0.0},
      {"errors constant along a scan, noise correlated over 3 points", 0.5, 3, 0.1, 0.0},
      {"errors constant along a scan, profiles at wrong places (0.5 um)", 0.5, 3, 0.5, 0.0},
      {"errors vary along the axis, noise correlated over 3 points", 0.5, 3, 0.1, 1800.0},
  };
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("scan_covariance_study_{}", getpid());
  try {
    for (const char* model : {"rigid", "push_broom"})
      if (only.empty() || only == model)
        for (const Setting& setting : settings)
          if (std::string(model) != "rigid" || setting.wave_mm == 0.0) study(model, setting, campaigns, seed, folder);
  } catch (const std::exception& error) {
    std::filesystem::remove_all(folder);
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
