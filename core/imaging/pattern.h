// SPDX-License-Identifier: Apache-2.0
// The fiducial's artwork: numbered ellipse outlines on a square pitch with filled circles between them.
//
// Frame: fiducial coordinate frame (FCF), um; origin at the centre of the ellipse of the first row and first column, X
// along increasing column, Y along increasing row. An ellipse carries a 2 x 2 block of digits: the row number in the
// upper line (+Y), the column number in the lower line. A digit is a list of strokes with round ends. Marks are bright
// on dark. File format: FORMATS.md, "spindrift-fiducial-pattern" version 1.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// A polyline in um, relative to the centre of its digit, drawn with round joints and ends.
using PatternStroke = std::vector<Eigen::Vector2d>;

/// Artwork of one kind of fiducial. All lengths in um.
struct FiducialPattern {
  int first_row = 11, last_row = 19;        ///< numbers of the ellipses, both ends included, two digits each
  int first_column = 11, last_column = 19;  ///< the same
  double pitch_um = 350.0;
  double semi_axis_x_um = 150.0;        ///< of the middle of the ellipse's line
  double semi_axis_y_um = 118.0;        ///< of the middle of the ellipse's line
  double ellipse_line_width_um = 13.0;  ///< full width
  double circle_radius_um = 24.0;
  double circle_offset_x_um = 175.0;  ///< centre of circle (0, 0) in FCF
  double circle_offset_y_um = 175.0;
  int first_circle_column = -1, last_circle_column = 8;  ///< index i, both ends included
  int first_circle_row = -1, last_circle_row = 8;        ///< index j, both ends included
  double digit_offset_x_um = 33.0;                       ///< digit centres at (+-x, +-y) from the ellipse's centre
  double digit_offset_y_um = 45.0;
  double digit_line_width_um = 9.0;                   ///< full width
  std::array<std::vector<PatternStroke>, 10> digits;  ///< strokes of 0 ... 9

  [[nodiscard]] int rowCount() const noexcept { return last_row - first_row + 1; }
  [[nodiscard]] int columnCount() const noexcept { return last_column - first_column + 1; }
  [[nodiscard]] bool contains(int row, int column) const noexcept {
    return row >= first_row && row <= last_row && column >= first_column && column <= last_column;
  }
  /// Ideal centre of the ellipse (row, column), um, FCF.
  [[nodiscard]] Eigen::Vector2d ellipseCentre(int row, int column) const noexcept {
    return {(column - first_column) * pitch_um, (row - first_row) * pitch_um};
  }
  /// Ideal centre of the circle (i, j), um, FCF; i counts along X, j along Y.
  [[nodiscard]] Eigen::Vector2d circleCentre(int i, int j) const noexcept {
    return {circle_offset_x_um + i * pitch_um, circle_offset_y_um + j * pitch_um};
  }
  /// The four digits of an ellipse: row tens, row units, column tens, column units (upper left, upper right, lower
  /// left, lower right).
  [[nodiscard]] static std::array<int, 4> digitsOf(int row, int column) noexcept {
    return {row / 10, row % 10, column / 10, column % 10};
  }
  /// Centre of digit k (order of digitsOf) relative to its ellipse, um.
  [[nodiscard]] Eigen::Vector2d digitCentre(int k) const noexcept {
    return {k % 2 == 0 ? -digit_offset_x_um : digit_offset_x_um, k < 2 ? digit_offset_y_um : -digit_offset_y_um};
  }

  /// Throws InputError naming the value that cannot be (`name` stands for the file): numbers outside 10 ... 99, marks
  /// that touch each other, digits that leave their ellipse, lengths that are not positive, a digit without strokes.
  void validate(const std::filesystem::path& name = {}) const;
};

/// The pattern of FORMATS.md (resources/fiducial/pattern.json, held inside the program).
[[nodiscard]] const FiducialPattern& standardPattern();

/// Reads a pattern file. Throws InputError naming file, JSON path, value and what is allowed.
[[nodiscard]] FiducialPattern readPattern(const std::filesystem::path& file);
[[nodiscard]] FiducialPattern parsePattern(std::string_view json, const std::filesystem::path& name);

/// The pattern as a file that `readPattern` reads back to the same numbers.
[[nodiscard]] std::string patternJson(const FiducialPattern& pattern);

}  // namespace spindrift
