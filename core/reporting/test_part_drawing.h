// SPDX-License-Identifier: Apache-2.0
// A milled test piece as a figure: every contour as it should be and, exaggerated, as the machine left it. Seen from
// above, X to the right, Y up. Deviations are drawn from datum C, the bore in the middle: where the whole part lies is
// no error of it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/machine/test_part.h"
#include "core/reporting/drawing.h"

namespace spindrift {

struct TestPartDrawingOptions {
  double width_px = 460.0, height_px = 460.0;  ///< > 150 each
  /// Exaggeration; nothing: the largest of 1, 2, 5 times a power of ten with which the largest deviation takes less
  /// than 8 % of the side.
  std::optional<double> factor;
  PictureColour ground{255, 255, 255}, ink = picture_ink, nominal{190, 198, 207}, actual{11, 114, 133},
                                       soft{82, 96, 109};
  /// Of the line below ("magnified {} ×"): "{}" is the factor.
  std::string legend = "Deviations from bore C, magnified {} ×";
  std::string no_deviation = "No deviation: the part is as it should be";
};

/// `deviation_um` at part.points(), as for TestPart::evaluate.
[[nodiscard]] Drawing testPartDrawing(const TestPart& part, std::span<const Eigen::Vector3d> deviation_um,
                                      const TestPartDrawingOptions& options = {});

/// The exaggeration that is chosen where none is given; 0 if nothing deviates.
[[nodiscard]] double testPartExaggeration(const TestPart& part, std::span<const Eigen::Vector3d> deviation_um);

}  // namespace spindrift
