// SPDX-License-Identifier: Apache-2.0
// The kinematic chain of a machine (ISO 10791-1 notation) and how ISO 230-1 errors of its axes reach the tool.
//
// "V [w-X'-Y'-b-Z-(C)-t]": from the workpiece w over the bed b to the tool t; an axis with ' carries the workpiece; an
// axis in brackets is the spindle (it turns the tool, it does not position). Nominal directions are those of ISO 841.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/geometry/small_error.h"

namespace spindrift {

struct ChainAxis {
  std::string name;           ///< "X", "C2"
  bool rotary = false;        ///< letter A, B, C
  Eigen::Vector3d direction;  ///< unit vector in MCF
  bool carries_workpiece = false;
  bool spindle = false;  ///< written in brackets
};

/// Commanded positions: linear axes mm, rotary axes rad, by name. Axes that are not named stand at 0.
using AxisPositions = std::map<std::string, double, std::less<>>;
/// ISO 230-1 component errors of each axis (for X: EXX, EYX, EZX, EAX, EBX, ECX) as the error of the moved part in MCF
/// at the origin of its carriage. Location errors (EXOC, EAOC, squareness) of a rotary axis are added by the caller to
/// the same six numbers, stated at its centre.
using AxisErrors = std::map<std::string, SmallError, std::less<>>;

class KinematicChain {
 public:
  KinematicChain() = default;
  /// Throws InputError: no w, b or t, an axis twice, an unknown letter, ' on the tool side.
  [[nodiscard]] static KinematicChain parse(std::string_view text, const SourcePlace& place = {});

  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// From the workpiece to the tool.
  [[nodiscard]] const std::vector<ChainAxis>& axes() const noexcept { return axes_; }
  [[nodiscard]] const ChainAxis* find(std::string_view name) const noexcept;
  /// True for the first letter V (vertical spindle), false for H; empty letter counts as V.
  [[nodiscard]] bool verticalSpindle() const noexcept { return vertical_; }
  /// True if the axis lies between bed and tool.
  [[nodiscard]] bool movesTool(std::string_view name) const noexcept;

  /// Deviation of the tool relative to the table at the tool point (PAPERS.md, FORMATS.md sign):
  /// sum over tool-side axes of e_i at the tool point minus sum over workpiece-side axes of e_i at the same place.
  /// The lever of an axis goes from the origin of its carriage (the sum of the linear motions from the bed up to and
  /// including it; for a rotary axis its centre, moved by what carries it) to the tool point.
  /// `tool_point_mm` is the tool point in MCF when all axes stand at 0.
  [[nodiscard]] SmallError toolDeviation(
      const AxisPositions& positions, const AxisErrors& errors, const Eigen::Vector3d& tool_point_mm,
      const std::map<std::string, Eigen::Vector3d, std::less<>>& rotary_centres_mm = {}) const;

 private:
  std::string text_;
  bool vertical_ = true;
  std::vector<ChainAxis> axes_;
};

}  // namespace spindrift
