// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/calibration_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

constexpr std::array<const char*, 6> names{"alpha", "beta", "gamma", "dx", "dy", "dz"};

std::array<double, 6> valuesOf(const ProfilerCalibration& c) {
  return {c.alpha_rad, c.beta_rad, c.gamma_rad, c.offset_mm.x(), c.offset_mm.y(), c.offset_mm.z()};
}
const char* unit(std::size_t i) {
  return i < 3 ? "rad" : "mm";
}

}  // namespace

nlohmann::json calibrationJson(const ProfilerCalibration& c) {
  nlohmann::json out = {{"status", toString(c.status)},
                        {"message", c.message},
                        {"scan_model", toString(c.scan_model)},
                        {"undetermined", c.undetermined},
                        {"rim_points", c.rim.size()},
                        {"rim_rms_um", jsonNumber(c.rim_rms_um)},
                        {"plane_rms_um", jsonNumber(c.plane_rms_um)},
                        {"radius_offset_um", jsonNumber(c.radius_offset_um)},
                        {"unexplained_slope_rad", jsonNumber(c.unexplained_slope_rad)}};
  const bool failed = c.status == FitStatus::Rejected || c.status == FitStatus::NoConvergence;
  const std::array<double, 6> values = valuesOf(c);
  nlohmann::json sigma = nlohmann::json::object();
  nlohmann::json covariance = nlohmann::json::array();
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string key = fmt::format("{}_{}", names[i], unit(i));
    out[key] = failed ? nlohmann::json(nullptr) : jsonNumber(values[i]);
    sigma[key] = failed ? nlohmann::json(nullptr) : jsonNumber(c.standardUncertainty(static_cast<int>(i)));
    nlohmann::json row = nlohmann::json::array();
    for (int j = 0; j < 6; ++j) row.push_back(jsonNumber(c.covariance(static_cast<int>(i), j)));
    covariance.push_back(row);
  }
  out["standard_uncertainty"] = sigma;
  out["covariance"] = failed ? nlohmann::json(nullptr) : covariance;
  return out;
}

std::string calibrationSummary(const ProfilerCalibration& c) {
  std::string text;
  if (c.usable()) {
    const std::array<double, 6> values = valuesOf(c);
    for (std::size_t i = 0; i < 6; ++i)
      text += fmt::format("{} = {}\n", names[i],
                          withUncertainty(values[i], c.standardUncertainty(static_cast<int>(i)), unit(i)));
    text += fmt::format("{} points of the rim, rms {:.2f} µm; plate rms {:.2f} µm\n", c.rim.size(), c.rim_rms_um,
                        c.plane_rms_um);
  }
  if (!c.message.empty()) text += c.message + "\n";
  return text;
}

}  // namespace spindrift
