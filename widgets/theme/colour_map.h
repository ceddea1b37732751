// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of fields and clouds, and the round numbers beside them.
//
// Signed deviations: cool-warm diverging map (K. Moreland, "Diverging Color Maps for Scientific Visualization", 2009),
// zero = neutral grey, limits symmetric. Magnitudes: viridis (Smith and van der Walt 2015), by control points.
#pragma once

#include <QColor>
#include <QString>
#include <array>
#include <cstdint>
#include <vector>

namespace spindrift::gui {

enum class ColourMap { Diverging, Sequential };

/// A scale from `low` to `high` in the given unit. For the diverging map low = -high.
struct ColourScale {
  ColourMap map = ColourMap::Diverging;
  double low = -1.0;
  double high = 1.0;
  QString title;  ///< "EX"
  QString unit;   ///< "um"

  /// Symmetric about zero; the limit is rounded up to the next 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 x 10^n.
  [[nodiscard]] static ColourScale symmetric(double largest_magnitude, QString title, QString unit);
  /// From zero up, for magnitudes.
  [[nodiscard]] static ColourScale magnitude(double largest, QString title, QString unit);

  [[nodiscard]] QRgb rgb(double value) const;
  [[nodiscard]] QColor colour(double value) const { return QColor(rgb(value)); }
  /// 5 to 7 values within the limits, ascending, that are round in the unit on screen.
  [[nodiscard]] std::vector<double> ticks() const;
  /// A value as it stands beside the colours, in the unit on screen; `step`: between two of them.
  [[nodiscard]] QString text(double value, double step) const;
  [[nodiscard]] bool operator==(const ColourScale&) const = default;
};

/// Table of 256 colours.
[[nodiscard]] const std::array<QRgb, 256>& colourTable(ColourMap map);

/// Round values (1, 2, 2.5, 5 x 10^n apart) within [low, high], about `wanted` of them.
[[nodiscard]] std::vector<double> roundTicks(double low, double high, int wanted);
/// A number with as many decimals as its step needs, with a true minus sign.
[[nodiscard]] QString tickText(double value, double step);

}  // namespace spindrift::gui
