// SPDX-License-Identifier: Apache-2.0
// What a person masked in a scan: strokes seen from above, in the profiler's frame.
//
// A scan is a height map, so a stroke is an area of (x, y): a brush along a path, a rectangle or a lasso. Strokes are
// applied in their order: a point is left out if the last stroke that covers it erases. Strokes are written as one line
// of text, which is how sessions, reports and the command line name a mask:
//   mask/captures/clouds/A1_C1.pcd: erase lasso 1.2,3.4 5,6 7,3; restore brush 0.5 2,3 2.1,3.4
// Lengths mm.
#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/scanning/cloud.h"

namespace spindrift {

enum class StrokeShape {
  Brush,      ///< within `radius_mm` of the path
  Rectangle,  ///< two opposite corners
  Lasso,      ///< inside the closed polygon (even-odd)
};

struct MaskStroke {
  StrokeShape shape = StrokeShape::Lasso;
  bool erase = true;       ///< false: what it covers is taken back in
  double radius_mm = 0.0;  ///< of a brush
  std::vector<Eigen::Vector2d> points_mm;

  [[nodiscard]] bool covers(const Eigen::Vector2d& place_mm) const noexcept;
};

using MaskStrokes = std::vector<MaskStroke>;

/// "erase lasso 1.2,3.4 5,6 7,3; restore ..."; rounded to a micrometre.
[[nodiscard]] std::string toText(const MaskStrokes& strokes);
/// Throws InputError naming the stroke and what is allowed.
[[nodiscard]] MaskStrokes maskStrokesFromText(std::string_view text);

/// Name of a scan's mask among what the user took out (Session::exclude, Campaign::excluded_captures).
[[nodiscard]] std::string maskItem(const std::string& cloud, const MaskStrokes& strokes);
/// True for the mask of any scan.
[[nodiscard]] bool isMaskItem(std::string_view item) noexcept;
/// The masks among all items, by cloud. Throws InputError for one that cannot be read.
[[nodiscard]] std::map<std::string, MaskStrokes> masksOf(const std::set<std::string>& items);

/// One entry a point: 1 keeps it.
[[nodiscard]] CloudMask paintedMask(const PointCloud& cloud, const MaskStrokes& strokes);

}  // namespace spindrift
