// SPDX-License-Identifier: Apache-2.0
// The curve of contrast over height that fitFocus finds (core/imaging/focus.h), from what is kept of it.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/imaging/focus.h"

namespace spindrift {

/// 1 / (gain H) at a height, for a curve whose peak is at `peak_um`; `shape` as in FocusResult.
[[nodiscard]] double contrastAt(const Eigen::VectorXd& shape, double gain, double peak_um, double height_mm);
/// The gain that the points of one set tell where shape and peak are known: least squares in ln n. At least one point.
[[nodiscard]] double contrastGain(const FocusSet& set, const Eigen::VectorXd& shape, double peak_um);

/// The contrast of one fiducial in one state over the commanded height, as measured and as fitted; um.
struct ContrastCurve {
  std::string fiducial;
  std::string state;
  std::vector<double> height_um, contrast;
  std::vector<double> fitted_height_um, fitted;  ///< empty where no curve was fitted
};
/// Of an evaluation of images, from what is stored of it (JSON of `evaluate`, FORMATS.md): sessions of earlier versions
/// show theirs as well. What is not there or of another kind is left out.
[[nodiscard]] std::vector<ContrastCurve> contrastCurves(const nlohmann::json& details);

}  // namespace spindrift
