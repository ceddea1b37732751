// SPDX-License-Identifier: Apache-2.0
// The shape of an effect as a figure, in reports and in the window: top, front and side view of a working volume. Every
// view is a plane through the middle, displaced as the effect displaces the tool for a gain of one, exaggerated, and
// coloured by the deviation out of the plane. An effect that only turns the tool is drawn by its rotation vectors.
// Measuring points carry arrows.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/effect.h"
#include "core/machine/machine_description.h"
#include "core/reporting/drawing.h"

namespace spindrift {

/// Where an effect is looked at.
struct EffectVolume {
  /// Of the axes X, Y, Z, mm.
  std::array<std::array<double, 2>, 3> travel_mm{{{0.0, 500.0}, {0.0, 500.0}, {0.0, 400.0}}};
  std::vector<MachinePoint> points;

  /// A travel that the machine does not have, or of no length, is taken as 500 mm.
  [[nodiscard]] static EffectVolume of(const MachineDescription& machine);
};

/// One column of the shape at the nodes, grid lines and points that are drawn.
struct EffectShape {
  struct Sample {
    Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
    Eigen::Vector3d deviation = Eigen::Vector3d::Zero();  ///< um or urad for a gain of one; NaN: has no value here
  };
  struct View {
    int across = 0, up = 1, out = 2;         ///< axes: 0 X, 1 Y, 2 Z
    std::vector<Sample> nodes;               ///< (cells + 1)^2, row by row
    std::vector<std::vector<Sample>> lines;  ///< of the grid
    std::vector<Sample> points;
  };
  static constexpr int cells = 16;  ///< along a side of a view
  std::array<View, 3> views;        ///< top, front, side
  std::array<std::array<double, 2>, 3> range_mm{};
  std::string gain_unit;
  bool rotations = false;    ///< the tool is only turned: urad; else um
  bool one_point = false;    ///< only measuring points move
  double largest = 0.0;      ///< size of a deviation, and
  double largest_out = 0.0;  ///< of its part out of a plane

  /// Limit of the colours, um or urad, symmetric about zero.
  [[nodiscard]] double limit() const;
  [[nodiscard]] Component colouredIn(const View& view) const {
    return static_cast<Component>(view.out + (rotations ? 3 : 0));
  }
};

/// `gain`: which column of the shape. Where a shape goes to infinity (refraction at the horizon) it is left out.
/// Nothing if there is no such column, or it is zero or not finite everywhere. Evaluates some thousand places: beside a
/// window.
[[nodiscard]] std::optional<EffectShape> effectShape(const Effect& effect, const EffectVolume& volume,
                                                     std::size_t gain = 0);

/// Look and words; what is empty is in English, um and urad.
struct EffectDrawingOptions {
  double width_px = 600.0, height_px = 260.0;
  PictureColour ground{255, 255, 255}, ink = picture_ink, soft{82, 96, 109};
  std::array<PictureColour, 3> axes{{{192, 57, 43}, {30, 132, 73}, {31, 97, 165}}};  ///< X, Y, Z
  std::array<std::string, 3> titles;                                                 ///< of the views: "Top, colour EZ"
  std::string legend;                  ///< a sentence; broken into lines where it has to be
  std::array<std::string, 3> numbers;  ///< at the ends and the middle of the colours
  std::string unit;                    ///< behind them
};

/// What such a drawing says below it where nobody says otherwise: how it is drawn, and the largest deviation.
[[nodiscard]] std::string effectLegend(const EffectShape& shape);

/// In a row, or as a drawing has them (top view above the front view, side view beside it), whichever makes the views
/// larger. All have one scale; an axis that is very short beside the others is stretched.
[[nodiscard]] Drawing effectDrawing(const EffectShape& shape, const EffectDrawingOptions& options = {});

}  // namespace spindrift
