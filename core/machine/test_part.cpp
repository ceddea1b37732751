// SPDX-License-Identifier: Apache-2.0
#include "core/machine/test_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/math/minimum_zone.h"

namespace spindrift {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double diamond_turn = 15.0 * degree, inclination = 3.0 * degree;
// Parts of the side of the square.
constexpr double diamond_side = 0.6875, circle_diameter = 0.675, bore_diameter = 0.1875, hole_diameter = 0.15;
constexpr double hole_place = 0.35, inclined_length = 0.6, inclined_place = 0.45;

Eigen::Vector2d leftOf(const Eigen::Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

double signOf(double value) {
  return std::abs(value) < 1e-12 ? 0.0 : value > 0.0 ? 1.0 : -1.0;
}

/// A side as evaluated: deviations to the left of the way of the tool over the place along it, um and mm.
struct MeasuredSide {
  Eigen::VectorXd along_mm, left_um;
  double zone_slope_urad = 0.0;  ///< of the minimum-zone line: um/mm = 1e3 urad
  double straightness_um = 0.0;
  double mean_um = 0.0, slope_urad = 0.0;  ///< of the least-squares line, its middle and direction

  /// Width of the zone between two lines turned by `turn_urad` from nominal.
  [[nodiscard]] double zone_um(double turn_urad) const {
    const Eigen::VectorXd left = left_um - 1e-3 * turn_urad * along_mm;
    return left.maxCoeff() - left.minCoeff();
  }
};

MeasuredSide measure(const PartFeature& side, std::span<const DeviationQuery> points,
                     std::span<const Eigen::Vector3d> deviation_um) {
  const auto n = static_cast<Eigen::Index>(side.count);
  MeasuredSide out;
  out.along_mm.resize(n);
  out.left_um.resize(n);
  const Eigen::Vector2d left = leftOf(side.direction);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t p = side.first + static_cast<std::size_t>(i);
    out.along_mm[i] = side.direction.dot(points[p].position_mm.head<2>() - side.centre_mm);
    out.left_um[i] = left.dot(deviation_um[p].head<2>());
  }
  Eigen::MatrixXd line(n, 2);
  line.col(0).setOnes();
  line.col(1) = out.along_mm;
  const MinimumZone zone = minimumZone(line, out.left_um);
  out.zone_slope_urad = 1e3 * zone.parameters[1];
  out.straightness_um = zone.width();
  // The points lie evenly about the middle: mean and slope are independent.
  out.mean_um = out.left_um.mean();
  out.slope_urad = 1e3 * out.along_mm.dot(out.left_um) / out.along_mm.squaredNorm();
  return out;
}

}  // namespace

TestPartOptions TestPartOptions::on(const MachineDescription& machine) {
  std::array<double, 2> travel[3];
  for (int i = 0; i < 3; ++i) {
    const char letter = "XYZ"[i];
    const auto found = std::find_if(machine.axes.begin(), machine.axes.end(),
                                    [&](const LinearAxis& a) { return !a.name.empty() && a.name[0] == letter; });
    if (found == machine.axes.end())
      throw InputError(
          fmt::format("machine \"{}\" has no axis {}; a test piece is milled with X, Y and Z.", machine.name, letter));
    travel[i] = found->travel_mm;
  }
  TestPartOptions options;
  const double room_mm = 0.9 * std::min(travel[0][1] - travel[0][0], travel[1][1] - travel[1][0]);
  options.side_mm = 0.0;
  for (const double side : {320.0, 160.0, 80.0, 40.0})
    if (options.side_mm == 0.0 && side <= room_mm) options.side_mm = side;
  if (options.side_mm == 0.0)
    throw InputError(fmt::format(
        "machine \"{}\" has {:g} mm x {:g} mm of travel in X and Y; a test piece needs 45 mm in each at least.",
        machine.name, travel[0][1] - travel[0][0], travel[1][1] - travel[1][0]));
  const double z_length = travel[2][1] - travel[2][0];
  options.height_mm = std::min(0.25 * options.side_mm, 0.5 * z_length);
  options.centre_mm = {0.5 * (travel[0][0] + travel[0][1]), 0.5 * (travel[1][0] + travel[1][1]),
                       travel[2][0] + options.height_mm};
  if (machine.table_centre_mm) {
    // Where the table's centre is not that of the travels, as near to it as the travels let it be.
    for (int i = 0; i < 2; ++i) {
      const double half = 0.5 * options.side_mm;
      options.centre_mm[i] = std::clamp((*machine.table_centre_mm)[i], travel[i][0] + half, travel[i][1] - half);
    }
  }
  options.validate();
  return options;
}

void TestPartOptions::validate() const {
  const auto reject = [](const char* field, double value, const char* allowed) {
    throw InputError(fmt::format("test piece: {} = {:g}; allowed: {}.", field, value, allowed));
  };
  if (!(side_mm > 0.0) || !std::isfinite(side_mm)) reject("side_mm", side_mm, "greater than zero");
  if (!(height_mm > 0.0) || !std::isfinite(height_mm)) reject("height_mm", height_mm, "greater than zero");
  if (!centre_mm.allFinite()) reject("centre_mm", centre_mm.sum(), "finite numbers");
  if (points_per_side < 3) reject("points_per_side", points_per_side, "3 and more");
  if (points_on_circle < 8) reject("points_on_circle", points_on_circle, "8 and more");
  if (depths < 2) reject("depths", depths, "2 and more");
}

void TestPart::addSide(const std::string& id, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double z_mm) {
  PartFeature side;
  side.id = id;
  side.first = points_.size();
  side.count = static_cast<std::size_t>(options_.points_per_side);
  side.centre_mm = 0.5 * (from + to);
  side.direction = (to - from).normalized();
  side.length_mm = (to - from).norm();
  for (int i = 0; i < options_.points_per_side; ++i) {
    DeviationQuery point;
    point.position_mm.head<2>() = from + (to - from) * i / (options_.points_per_side - 1);
    point.position_mm.z() = z_mm;
    point.approach = {signOf(side.direction.x()), signOf(side.direction.y()), 0.0};
    points_.push_back(point);
  }
  features_.push_back(side);
}

void TestPart::addSquare(const std::string& stem, double side_mm, double turn_rad, double z_mm) {
  const Eigen::Rotation2Dd turn(turn_rad);
  const Eigen::Vector2d centre = options_.centre_mm.head<2>();
  const std::array<Eigen::Vector2d, 4> corners{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  for (std::size_t i = 0; i < 4; ++i)
    addSide(fmt::format("{}.{}", stem, i + 1), centre + turn * (side_mm * corners[i]),
            centre + turn * (side_mm * corners[(i + 1) % 4]), z_mm);
}

void TestPart::addHole(const std::string& id, const Eigen::Vector2d& at, double diameter_mm) {
  PartFeature hole;
  hole.kind = PartFeature::Kind::Hole;
  hole.id = id;
  hole.first = points_.size();
  hole.count = static_cast<std::size_t>(options_.depths);
  hole.centre_mm = at;
  hole.length_mm = diameter_mm;
  for (int i = 0; i < options_.depths; ++i) {
    DeviationQuery point;
    point.position_mm << at.x(), at.y(), options_.centre_mm.z() - options_.height_mm * i / (options_.depths - 1);
    point.approach = {1.0, 1.0, -1.0};  // holes are gone to from below left, whatever was before
    points_.push_back(point);
  }
  features_.push_back(hole);
}

TestPart::TestPart(const TestPartOptions& options) : options_(options) {
  options_.validate();
  const double l = options_.side_mm;
  const double top = options_.centre_mm.z();
  const double step = options_.height_mm / 5.0;
  const Eigen::Vector2d centre = options_.centre_mm.head<2>();
  addSquare("square", l, 0.0, top - 4.0 * step);
  // Two faces along side 1 and side 4, turned by 3 degrees towards the middle.
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d along = i == 0 ? Eigen::Vector2d::UnitX() : Eigen::Vector2d(0.0, -1.0);
    const Eigen::Vector2d middle = centre - inclined_place * l * leftOf(along);
    const Eigen::Vector2d half = 0.5 * inclined_length * l * (Eigen::Rotation2Dd(inclination) * along);
    addSide(fmt::format("inclined.{}", i + 1), middle - half, middle + half, top - 3.0 * step);
  }
  addSquare("diamond", diamond_side * l, diamond_turn, top - 2.0 * step);
  PartFeature circle;
  circle.kind = PartFeature::Kind::Circle;
  circle.id = "circle";
  circle.first = points_.size();
  circle.count = static_cast<std::size_t>(options_.points_on_circle);
  circle.centre_mm = centre;
  circle.length_mm = circle_diameter * l;
  for (int i = 0; i < options_.points_on_circle; ++i) {
    // Half a step beside the axes, where the tool reverses.
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / options_.points_on_circle;
    DeviationQuery point;
    point.position_mm << centre.x() + 0.5 * circle.length_mm * std::cos(angle),
        centre.y() + 0.5 * circle.length_mm * std::sin(angle), top - step;
    point.approach = {signOf(-std::sin(angle)), signOf(std::cos(angle)), 0.0};
    points_.push_back(point);
  }
  features_.push_back(circle);
  addHole("bore", centre, bore_diameter * l);
  constexpr std::array<std::array<double, 2>, 4> places{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < 4; ++i)
    addHole(fmt::format("hole.{}", i + 1), centre + hole_place * l * Eigen::Vector2d(places[i][0], places[i][1]),
            hole_diameter * l);
}

const PartFeature& TestPart::feature(std::string_view id) const {
  const auto found = std::find_if(features_.begin(), features_.end(), [&](const auto& f) { return f.id == id; });
  SPINDRIFT_ASSERT(found != features_.end(), "a feature of the part");
  return *found;
}

std::vector<PartCharacteristic> TestPart::evaluate(std::span<const Eigen::Vector3d> deviation_um) const {
  SPINDRIFT_ASSERT(deviation_um.size() == points_.size(), "a deviation for each point of the part");
  std::vector<PartCharacteristic> out;
  const auto add = [&](const std::string& id, const char* characteristic, const char* datum, double value,
                       const char* unit = "um", double nominal_mm = 0.0) {
    out.push_back({id, characteristic, datum, value, unit, nominal_mm});
  };
  const auto side = [&](const std::string& id) { return measure(feature(id), points_, deviation_um); };
  std::array<MeasuredSide, 4> square;
  for (std::size_t i = 0; i < 4; ++i) square[i] = side(fmt::format("square.{}", i + 1));
  const double turn_urad = square[0].zone_slope_urad;  // of datum B
  const double l = options_.side_mm;
  for (std::size_t i = 0; i < 4; ++i)
    add(fmt::format("square.{}", i + 1), "straightness", "", square[i].straightness_um);
  add("square.2", "perpendicularity", "B", square[1].zone_um(turn_urad));
  add("square.3", "parallelism", "B", square[2].zone_um(turn_urad));
  add("square.4", "perpendicularity", "B", square[3].zone_um(turn_urad));
  add("square", "squareness", "",
      0.5 * (square[1].slope_urad + square[3].slope_urad) - 0.5 * (square[0].slope_urad + square[2].slope_urad),
      "urad");
  // The left of the way is inside.
  add("square", "size_x", "", -square[1].mean_um - square[3].mean_um, "um", l);
  add("square", "size_y", "", -square[0].mean_um - square[2].mean_um, "um", l);
  for (const char* stem : {"diamond", "inclined"}) {
    for (int i = 1; i <= (*stem == 'd' ? 4 : 2); ++i) {
      const std::string id = fmt::format("{}.{}", stem, i);
      const MeasuredSide one = side(id);
      add(id, "straightness", "", one.straightness_um);
      add(id, "angularity", "B", one.zone_um(turn_urad));
    }
  }

  const PartFeature& circle = feature("circle");
  const auto n = static_cast<Eigen::Index>(circle.count);
  Eigen::MatrixXd shape(n, 3);
  Eigen::VectorXd radial(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t p = circle.first + static_cast<std::size_t>(i);
    const Eigen::Vector2d outwards = (points_[p].position_mm.head<2>() - circle.centre_mm).normalized();
    shape.row(i) << 1.0, outwards.x(), outwards.y();
    radial[i] = outwards.dot(deviation_um[p].head<2>());
  }
  // Points all around: the columns are orthogonal, n, n/2, n/2.
  const Eigen::Vector3d fitted = (shape.transpose() * radial).cwiseQuotient(Eigen::Vector3d(n, 0.5 * n, 0.5 * n));
  const Eigen::VectorXd beside = radial - shape * fitted;
  add("circle", "circularity", "", minimumZone(shape, radial).width());
  add("circle", "circularity_ls", "", beside.maxCoeff() - beside.minCoeff());
  add("circle", "diameter", "", 2.0 * fitted[0], "um", circle.length_mm);

  const auto axisOf = [&](const PartFeature& hole) {
    Eigen::Matrix2Xd axis(2, static_cast<Eigen::Index>(hole.count));
    for (std::size_t i = 0; i < hole.count; ++i)
      axis.col(static_cast<Eigen::Index>(i)) = deviation_um[hole.first + i].head<2>();
    return axis;
  };
  const PartFeature& bore = feature("bore");
  const Eigen::Matrix2Xd bore_axis = axisOf(bore);
  const Eigen::Vector2d datum = bore_axis.rowwise().mean();
  add("circle", "concentricity", "C", 2.0 * (fitted.tail<2>() - datum).norm());
  add("bore", "perpendicularity", "A", smallestCircleDiameter(bore_axis));
  std::array<Eigen::Vector2d, 4> centres;
  for (std::size_t i = 0; i < 4; ++i) {
    const PartFeature& hole = feature(fmt::format("hole.{}", i + 1));
    const Eigen::Matrix2Xd axis = axisOf(hole);
    centres[i] = axis.rowwise().mean();
    // From C, and turned with B.
    const Eigen::Vector2d expected = datum + 1e-3 * turn_urad * leftOf(hole.centre_mm - bore.centre_mm);
    add(hole.id, "position", "C", 2.0 * (axis.colwise() - expected).colwise().norm().maxCoeff());
  }
  const double apart = 2.0 * hole_place * l;
  add("holes", "distance_x", "", 0.5 * (centres[1] - centres[0] + centres[2] - centres[3]).x(), "um", apart);
  add("holes", "distance_y", "", 0.5 * (centres[3] - centres[0] + centres[2] - centres[1]).y(), "um", apart);
  return out;
}

std::string characteristicText(const PartCharacteristic& characteristic) {
  const auto& [feature, what, datum, value, unit, nominal] = characteristic;
  const std::size_t dot = feature.find('.');
  const std::string stem = feature.substr(0, dot), number = dot == std::string::npos ? "" : feature.substr(dot + 1);
  const std::string of = stem == "square" ? (number.empty() ? "of the square" : "of side " + number + " of the square")
                         : stem == "diamond"  ? "of side " + number + " of the diamond"
                         : stem == "inclined" ? "of inclined face " + number
                         : stem == "circle"   ? "of the circle"
                         : stem == "bore"     ? "of the centre bore"
                         : stem == "hole"     ? "of hole " + number
                                              : "of the holes";
  if (what == "size_x" || what == "size_y") return fmt::format("size {} along {}", of, what.back() == 'x' ? "X" : "Y");
  if (what == "distance_x" || what == "distance_y")
    return fmt::format("distance {} along {}", of, what.back() == 'x' ? "X" : "Y");
  if (what == "circularity_ls") return "circularity " + of + ", least squares";
  return datum.empty() ? what + " " + of : fmt::format("{} {} to {}", what, of, datum);
}

}  // namespace spindrift
