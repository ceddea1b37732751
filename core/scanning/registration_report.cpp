// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/registration_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace spindrift {

nlohmann::json registrationJson(const RegistrationResult& result) {
  const bool has = result.status == FitStatus::Converged || result.status == FitStatus::Degenerate;
  nlohmann::json out = {{"status", toString(result.status)},
                        {"message", result.message},
                        {"method", result.method},
                        {"scan_model", toString(result.scan_model)},
                        {"elapsed_ms", result.elapsed_ms},
                        {"points_used", result.points_used},
                        {"overlap", jsonNumber(result.overlap)},
                        {"inliers", jsonNumber(result.inliers)},
                        {"free_directions", result.free_directions},
                        {"target_from_source", nullptr},
                        {"translation_um", nullptr},
                        {"rotation_urad", nullptr},
                        {"standard_uncertainty", nullptr},
                        {"covariance", nullptr},
                        {"rms_um", nullptr}};
  if (!has) return out;
  nlohmann::json matrix = nlohmann::json::array();
  const Eigen::Matrix4d m = result.target_from_source.matrix();
  for (int r = 0; r < 4; ++r) matrix.push_back({m(r, 0), m(r, 1), m(r, 2), m(r, 3)});
  out["target_from_source"] = matrix;
  const Eigen::Vector3d t = um_per_mm * result.translation_mm, w = urad_per_rad * result.rotation_rad;
  // A free direction has no value.
  const auto known = [&](double value, int i) {
    return jsonNumber(std::isfinite(result.covariance(i, i)) ? value : std::nan(""));
  };
  out["translation_um"] = {known(t.x(), 0), known(t.y(), 1), known(t.z(), 2)};
  out["rotation_urad"] = {known(w.x(), 3), known(w.y(), 4), known(w.z(), 5)};
  out["centroid_mm"] = {result.centroid_mm.x(), result.centroid_mm.y(), result.centroid_mm.z()};
  nlohmann::json covariance = nlohmann::json::array();
  nlohmann::json sigma = nlohmann::json::array();
  const auto unit = [](int i) { return i < 3 ? um_per_mm : urad_per_rad; };
  for (int r = 0; r < 6; ++r) {
    nlohmann::json row = nlohmann::json::array();
    for (int c = 0; c < 6; ++c) row.push_back(jsonNumber(result.covariance(r, c) * unit(r) * unit(c)));
    covariance.push_back(row);
    sigma.push_back(jsonNumber(std::sqrt(result.covariance(r, r)) * unit(r)));
  }
  out["covariance"] = covariance;
  out["standard_uncertainty"] = sigma;
  out["rms_um"] = jsonNumber(um_per_mm * result.rms_mm);
  out["misfit_ratio"] = jsonNumber(result.misfit_ratio);
  out["noise_correlation"] = jsonNumber(result.noise_correlation);
  return out;
}

std::string registrationSummary(const RegistrationResult& result) {
  std::string text;
  if (result.status == FitStatus::Converged || result.status == FitStatus::Degenerate) {
    constexpr std::array<const char*, 6> names{"EX", "EY", "EZ", "EA", "EB", "EC"};
    text += "Deviation at the centroid of the target:\n";
    for (int i = 0; i < 6; ++i) {
      const double value = i < 3 ? um_per_mm * result.translation_mm[i] : urad_per_rad * result.rotation_rad[i - 3];
      const double sigma = std::sqrt(result.covariance(i, i)) * (i < 3 ? um_per_mm : urad_per_rad);
      text += std::isfinite(sigma) ? fmt::format("  {} = {}\n", names[static_cast<std::size_t>(i)],
                                                 withUncertainty(value, sigma, i < 3 ? "um" : "urad"))
                                   : fmt::format("  {} is not determined\n", names[static_cast<std::size_t>(i)]);
    }
    text += fmt::format("{} points, rms {:.3f} µm, overlap {:.0f} %, {:.1f} ms\n", result.points_used,
                        um_per_mm * result.rms_mm, 100.0 * result.overlap, result.elapsed_ms);
  }
  if (!result.message.empty()) text += result.message + "\n";
  return text;
}

}  // namespace spindrift
