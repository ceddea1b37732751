// SPDX-License-Identifier: Apache-2.0
// The shape of an effect as a figure: top, front and side view of a working volume. In each, a grid in the plane
// through the middle as it is (grey) and as the effect displaces the tool for a gain of one, exaggerated. An effect
// that only turns the tool is drawn by its rotation vectors.
#pragma once

#include <array>
#include <optional>

#include "core/machine/effect.h"
#include "core/reporting/drawing.h"

namespace spindrift {

struct EffectDrawingOptions {
  /// Of the axes X, Y, Z.
  std::array<std::array<double, 2>, 3> travel_mm{{{0.0, 500.0}, {0.0, 500.0}, {0.0, 400.0}}};
  std::size_t gain = 0;  ///< which column of the shape
};

/// Nothing if the effect has no shape, or one that is zero or not finite at every point of the grid.
[[nodiscard]] std::optional<Drawing> effectDrawing(const Effect& effect, const EffectDrawingOptions& options = {});

}  // namespace spindrift
