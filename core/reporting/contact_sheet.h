// SPDX-License-Identifier: Apache-2.0
// Thumbnails of captures on one sheet, for reports: what was seen, with its name below.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/reporting/drawing.h"

namespace spindrift {

/// A small picture, JPEG, and what it is. `jpeg` empty: the capture could not be read, the sheet says so.
struct Thumbnail {
  std::string jpeg;
  std::string label;    ///< "M1 F3", one line
  std::string comment;  ///< second line, smaller; may be empty
};

/// A microscope image, `width_px` wide. Empty if the file cannot be read as an image.
[[nodiscard]] std::string imageThumbnail(const std::filesystem::path& file, int width_px = 240);
/// Points seen from above, colour by `scalar` from `low` to `high` (sequential map), `width_px` wide. Empty without
/// points.
[[nodiscard]] std::string cloudThumbnail(const std::vector<float>& xyz_mm, const std::vector<float>& scalar, double low,
                                         double high, int width_px = 240);

/// `columns` thumbnails in a row, 860 px wide.
[[nodiscard]] Drawing contactSheet(const std::vector<Thumbnail>& thumbnails, int columns = 6);

}  // namespace spindrift
