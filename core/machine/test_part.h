// SPDX-License-Identifier: Apache-2.0
// A contouring test piece of the kind of ISO 10791-7, as a machine with a given error field would mill it, and what a
// measuring machine would find on it.
//
// From below: a square of side l whose lower side is datum B, two faces inclined by 3 degrees, a square turned by 15
// degrees ("diamond", its sides at 75 degrees to the sides of the square), a circle; a bore through the middle (datum
// C) and four bored holes. The table is datum A and without error. The tool is where it should be plus the deviation of
// the tool relative to the table: that is the form of the part (um, MCF). Contours are milled counter-clockwise, so
// that a deviation that depends on the direction of approach (backlash) shows where an axis reverses. Holes are bored:
// round, their axis is what deviates. Which features there are is that of the standard; their proportions are our own
// and not taken from it.
//
// Evaluation, first order in the deviations (the next order is below 1e-3 um):
//   straightness, circularity   width of the minimum zone; circularity also about the least-squares centre
//   parallelism, perpendicularity, angularity to B   width of the zone between two lines at the nominal angle to B;
//                               B is the minimum-zone line of its side (ISO 5459: a line that touches from outside is
//                               parallel to it)
//   squareness                  angle between the least-squares lines of two sides, as EC0Y (urad)
//   size, distance, diameter    actual minus nominal, of least-squares lines at mid-length, centres and circle
//   position                    twice the largest distance of the axis from its place, from C along B
//   concentricity               twice the distance of the circle's least-squares centre from the mean of the bore C
//   perpendicularity of the bore to A   diameter of the smallest cylinder square to A that holds its axis
// Sources: ISO 1101:2017; ISO 5459:2011; ISO 12181-1:2011.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/machine_description.h"

namespace spindrift {

struct TestPartOptions {
  double side_mm = 160.0;                                   ///< l, > 0
  double height_mm = 40.0;                                  ///< > 0
  Eigen::Vector3d centre_mm = Eigen::Vector3d(0, 0, 40.0);  ///< of the upper face, MCF
  int points_per_side = 41;                                 ///< >= 3
  int points_on_circle = 180;                               ///< >= 8
  int depths = 5;                                           ///< along a hole, >= 2

  /// The largest of 320, 160, 80 and 40 mm that leaves a tenth of the travels free, in the middle of the table. Throws
  /// InputError for a machine without axes X, Y and Z or with less room than that.
  [[nodiscard]] static TestPartOptions on(const MachineDescription& machine);
  /// Throws InputError with the field, its value and what is allowed.
  void validate() const;
};

/// A line, circle or hole of the part.
struct PartFeature {
  enum class Kind { Side, Circle, Hole } kind = Kind::Side;
  std::string id;         ///< "square.1", "diamond.3", "inclined.2", "circle", "bore", "hole.4"
  std::size_t first = 0;  ///< of the part's points
  std::size_t count = 0;
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();   ///< circle and hole: nominal centre; side: its middle
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< side: as it is milled
  double length_mm = 0.0;                                ///< side: length; circle and hole: diameter
};

/// What is found. `feature` and `characteristic` are stable ids; the unit is um or urad.
struct PartCharacteristic {
  std::string feature;         ///< "square.2"
  std::string characteristic;  ///< "straightness"
  std::string datum;           ///< "A", "B", "C" or empty
  double value = 0.0;
  std::string unit = "um";
  double nominal_mm = 0.0;  ///< of sizes and distances; 0: none
};

class TestPart {
 public:
  explicit TestPart(const TestPartOptions& options);

  [[nodiscard]] const TestPartOptions& options() const noexcept { return options_; }
  [[nodiscard]] const std::vector<PartFeature>& features() const noexcept { return features_; }
  /// All points in the order of the features, with the direction in which the tool comes.
  [[nodiscard]] const std::vector<DeviationQuery>& points() const noexcept { return points_; }
  /// `deviation_um`: of the tool relative to the table at each of points(), along X, Y, Z.
  [[nodiscard]] std::vector<PartCharacteristic> evaluate(std::span<const Eigen::Vector3d> deviation_um) const;

 private:
  void addSide(const std::string& id, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double z_mm);
  void addSquare(const std::string& stem, double side_mm, double turn_rad, double z_mm);
  void addHole(const std::string& id, const Eigen::Vector2d& at, double diameter_mm);
  [[nodiscard]] const PartFeature& feature(std::string_view id) const;

  TestPartOptions options_;
  std::vector<PartFeature> features_;
  std::vector<DeviationQuery> points_;
};

/// "perpendicularity of side 2 of the square to B".
[[nodiscard]] std::string characteristicText(const PartCharacteristic& characteristic);

}  // namespace spindrift
