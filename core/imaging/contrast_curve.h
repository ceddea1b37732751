// SPDX-License-Identifier: Apache-2.0
// The curve of contrast over height that fitFocus finds (core/imaging/focus.h), from what is kept of it.
#pragma once

#include <Eigen/Core>

#include "core/imaging/focus.h"

namespace spindrift {

/// 1 / (gain H) at a height, for a curve whose peak is at `peak_um`; `shape` as in FocusResult.
[[nodiscard]] double contrastAt(const Eigen::VectorXd& shape, double gain, double peak_um, double height_mm);
/// The gain that the points of one set tell where shape and peak are known: least squares in ln n. At least one point.
[[nodiscard]] double contrastGain(const FocusSet& set, const Eigen::VectorXd& shape, double peak_um);

}  // namespace spindrift
