// SPDX-License-Identifier: Apache-2.0
// Artwork of a user's own fiducial: the pattern and the drawings a mask shop can make it from.
//
// Drawings are in the fiducial coordinate frame seen from above: X to the right, Y up. Marks bright (chrome or
// reflecting) on dark. SVG: user units um, size in mm. DXF: release 12 (AC1009), units mm.
#pragma once

#include <string>

#include "core/imaging/pattern.h"

namespace spindrift {

struct ArtworkOptions {
  int rows = 9;             ///< of ellipses
  int columns = 9;          ///< of ellipses
  int first_row = 11;       ///< number of the first row, 10 ... 99
  int first_column = 11;    ///< number of the first column, 10 ... 99
  double pitch_um = 350.0;  ///< all sizes of the standard artwork are scaled with it
};

/// The standard artwork with another number of ellipses and another pitch; circles all around as in the standard one.
/// Throws InputError: counts below 1, numbers beyond 99, a pitch outside 20 ... 100000 um.
[[nodiscard]] FiducialPattern makePattern(const ArtworkOptions& options);

/// Drawing with strokes (round ends and joints) and filled circles on a dark ground that reaches half a pitch further.
[[nodiscard]] std::string artworkSvg(const FiducialPattern& pattern);

/// Drawing for masks: layers ELLIPSES and DIGITS hold polylines of the line's width, their round ends and corners and
/// the circles (layer CIRCLES) are filled discs (closed polylines of two arcs with width). Ellipses have 180 vertices,
/// within 0.03 um of the curve at the standard size.
[[nodiscard]] std::string artworkDxf(const FiducialPattern& pattern);

}  // namespace spindrift
