// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/contrast_curve.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace spindrift {
namespace {

nlohmann::json at(const nlohmann::json& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  return found == json.end() ? nlohmann::json() : *found;
}

std::optional<double> numberIn(const nlohmann::json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

std::string textIn(const nlohmann::json& json) {
  return json.is_string() ? json.get<std::string>() : std::string();
}

void addFitted(ContrastCurve& curve, const FocusSet& set, const nlohmann::json& shape, double peak_um) {
  Eigen::VectorXd terms(static_cast<Eigen::Index>(shape.size()));
  for (Eigen::Index t = 0; t < terms.size(); ++t) {
    const auto term = numberIn(shape[static_cast<std::size_t>(t)]);
    if (!term) return;
    terms(t) = *term;
  }
  constexpr int steps = 120;
  const double gain = contrastGain(set, terms, peak_um);
  const auto [low, high] = std::minmax_element(curve.height_um.begin(), curve.height_um.end());
  for (int i = 0; i <= steps; ++i) {
    const double height_um = *low + (*high - *low) * i / steps;
    curve.fitted_height_um.push_back(height_um);
    curve.fitted.push_back(contrastAt(terms, gain, peak_um, 1e-3 * height_um));
  }
}

}  // namespace

double contrastAt(const Eigen::VectorXd& shape, double gain, double peak_um, double height_mm) {
  const double u = height_mm - peak_um * 1e-3;
  double H = 1.0;
  for (Eigen::Index t = 0; t < shape.size(); ++t) H += shape(t) * std::pow(u, t + 2);
  return 1.0 / (gain * H);
}

double contrastGain(const FocusSet& set, const Eigen::VectorXd& shape, double peak_um) {
  SPINDRIFT_ASSERT(!set.height_mm.empty(), "no point to tell the gain");
  double log_gain = 0.0;
  for (std::size_t i = 0; i < set.height_mm.size(); ++i)
    log_gain += std::log(contrastAt(shape, 1.0, peak_um, set.height_mm[i]) / set.normalised[i]);
  return std::exp(log_gain / static_cast<double>(set.height_mm.size()));
}

std::vector<ContrastCurve> contrastCurves(const nlohmann::json& details) {
  const nlohmann::json shape = at(at(details, "contrast_curve"), "shape_per_mm");
  std::vector<ContrastCurve> curves;
  for (const auto& fiducial : at(details, "fiducials")) {
    for (const auto& state : at(fiducial, "states")) {
      const nlohmann::json focus = at(state, "focus");
      if (!focus.is_object()) continue;
      ContrastCurve curve;
      curve.fiducial = textIn(at(fiducial, "fiducial"));
      curve.state = textIn(at(state, "state"));
      FocusSet set;
      for (const auto& p : at(focus, "curve")) {
        const auto height_mm = numberIn(at(p, "z_mm")), contrast = numberIn(at(p, "contrast"));
        if (!height_mm || !contrast || !(*contrast > 0.0)) continue;
        set.height_mm.push_back(*height_mm);
        set.normalised.push_back(*contrast);
        curve.height_um.push_back(1e3 * *height_mm);
      }
      curve.contrast = set.normalised;
      const auto peak_um = numberIn(at(at(focus, "peak_z_um"), "value"));
      if (shape.is_array() && !shape.empty() && peak_um && set.height_mm.size() >= 2)
        addFitted(curve, set, shape, *peak_um);
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace spindrift
