// SPDX-License-Identifier: Apache-2.0
// A field as a picture.
//
// Colours: diverging cool-warm map (Moreland 2009), zero neutral, limits symmetric about zero. Where |value| < 2 sigma
// the colour fades and a contour separates it; outside the measured region cells are hatched. Measured points carry an
// arrow (along X, along Y, up for EZ) and their value; hollow points did not take part in the fit. Axes in mm, equal
// scale.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/machine/field.h"
#include "core/reporting/drawing.h"

namespace spindrift {

struct HeatmapPictureOptions {
  std::string title;            ///< empty: component and unit
  std::string subtitle;         ///< empty: none
  std::optional<double> limit;  ///< of the colour scale, um or urad; empty: from the field, rounded up
  bool legend = true;           ///< what pale, hatched and hollow mean, below; else the caption has to say it
  int width_px = 820;           ///< of the picture; the height follows from the table, >= 480
  /// Throws InputError.
  void validate() const;
};

/// For the caption of a picture without a legend.
inline constexpr std::string_view heatmap_legend =
    "pale: smaller than two standard uncertainties, hatched: outside the measured points, hollow: not fitted";

/// Throws InputError on options that cannot be.
[[nodiscard]] Drawing heatmapPicture(const Field& field, const HeatmapPictureOptions& options = {});

/// Colour of value/limit in [-1, 1] (clamped): red, green, blue.
[[nodiscard]] std::array<std::uint8_t, 3> coolWarm(double part);
/// Smallest round number (1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten) that is not below `magnitude`; 1 for zero.
[[nodiscard]] double roundLimit(double magnitude);

}  // namespace spindrift
