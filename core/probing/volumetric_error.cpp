// SPDX-License-Identifier: Apache-2.0
#include "core/probing/volumetric_error.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.h"
#include "core/geometry/rigid_transform.h"

namespace spindrift {

BallCycleModel::BallCycleModel(const BallCycleResult& result, int cycle) : bearing_mm_(result.fixed_bearing_mm) {
  SPINDRIFT_ASSERT(cycle >= 0 && cycle < static_cast<int>(result.cycles.size()), "no such cycle");
  const CycleSolution& solution = result.fit.cycles[static_cast<std::size_t>(cycle)];
  cycle_ = result.cycles[static_cast<std::size_t>(cycle)];
  theta_ = solution.theta;
  covariance_ = solution.covariance;
  for (const ProbedFeature& feature : result.features)
    if (feature.status == FitStatus::Converged) places_mm_.push_back(feature.centre_mm);
}

std::string BallCycleModel::description() const {
  return fmt::format("head, column, spindle and screws in cycle {} from the ball artefact", cycle_);
}

BallCycleModel::Row BallCycleModel::rowOf(const DeviationQuery& query, Component component) const {
  if (!isRotation(component))
    return ballDeviationJacobian(query.position_mm, query.tool_offset_mm, bearing_mm_).row(axisIndex(component));
  Row row = Row::Zero();
  row(axisIndex(component)) = 1.0;
  row(3 + axisIndex(component)) = 1.0;
  return row;
}

PredictedComponent BallCycleModel::predict(const DeviationQuery& query, Component component) const {
  return combined(rowOf(query, component), component);
}

PredictedComponent BallCycleModel::predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const {
  return combined(rowOf(query, component) - rowOf(reference, component), component);
}

PredictedComponent BallCycleModel::combined(const Row& row, Component component) const {
  const double unit = isRotation(component) ? urad_per_rad : um_per_mm;
  double variance = 0.0;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      // An undetermined parameter has infinite variance; it matters only where it enters.
      if (row(i) != 0.0 && row(j) != 0.0) variance += row(i) * row(j) * covariance_(i, j);
    }
  }
  return {row.dot(theta_.transpose()) * unit, std::sqrt(std::max(variance, 0.0)) * unit};
}

namespace {

std::array<double, 2> travelOf(const MachineDescription& machine, int axis) {
  const LinearAxis* found = machine.findAxis(std::string(1, "XYZ"[axis]));
  if (found == nullptr) {
    throw InputError({machine.file, "$.axes"},
                     fmt::format("axis {} is missing; allowed: an entry with its travel.", "XYZ"[axis]));
  }
  return found->travel_mm;
}

}  // namespace

Field volumetricField(const BallCycleModel& model, const MachineDescription& machine, Component component,
                      int normal_axis, double level_mm, const Eigen::Vector3d& tool_offset_mm, int n) {
  SPINDRIFT_ASSERT(normal_axis >= 0 && normal_axis < 3 && n >= 2, "a plane has a normal axis and two nodes a side");
  Field field;
  field.component = component;
  field.grid.normal_axis = normal_axis;
  const auto u = travelOf(machine, field.grid.firstAxis());
  const auto v = travelOf(machine, field.grid.secondAxis());
  field.grid = {u[0], u[1], v[0], v[1], level_mm, n, n, normal_axis};
  field.value.resize(field.grid.size());
  field.sigma.resize(field.grid.size());
  field.extrapolated.resize(field.grid.size());
  const auto inPlane = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(p[field.grid.firstAxis()], p[field.grid.secondAxis()]);
  };
  std::vector<Eigen::Vector2d> touched;
  for (const Eigen::Vector3d& p : model.places_mm()) touched.push_back(inPlane(p));
  const std::vector<Eigen::Vector2d> hull = convexHull(touched);
  for (int iy = 0; iy < n; ++iy) {
    for (int ix = 0; ix < n; ++ix) {
      DeviationQuery query;
      query.position_mm = field.grid.place_mm(field.grid.x_mm(ix), field.grid.y_mm(iy));
      query.tool_offset_mm = tool_offset_mm;
      const PredictedComponent p = model.predict(query, component);
      field.value[field.grid.index(ix, iy)] = p.value;
      field.sigma[field.grid.index(ix, iy)] = p.sigma;
      field.extrapolated[field.grid.index(ix, iy)] = !insideHull(hull, inPlane(query.position_mm));
    }
  }
  return field;
}

std::vector<VolumetricArrow> volumetricArrows(const BallCycleModel& model, const MachineDescription& machine,
                                              const Eigen::Vector3d& tool_offset_mm, int per_axis) {
  SPINDRIFT_ASSERT(per_axis >= 2, "arrows need two places per axis");
  std::vector<VolumetricArrow> arrows;
  const std::array<std::array<double, 2>, 3> travel{travelOf(machine, 0), travelOf(machine, 1), travelOf(machine, 2)};
  const auto place = [&](int axis, int i) {
    const auto& t = travel[static_cast<std::size_t>(axis)];
    return t[0] + (t[1] - t[0]) * i / (per_axis - 1);
  };
  for (int iz = 0; iz < per_axis; ++iz) {
    for (int iy = 0; iy < per_axis; ++iy) {
      for (int ix = 0; ix < per_axis; ++ix) {
        VolumetricArrow arrow;
        arrow.position_mm = {place(0, ix), place(1, iy), place(2, iz)};
        DeviationQuery query;
        query.position_mm = arrow.position_mm;
        query.tool_offset_mm = tool_offset_mm;
        for (int k = 0; k < 3; ++k) arrow.deviation_um(k) = model.predict(query, static_cast<Component>(k)).value;
        arrows.push_back(arrow);
      }
    }
  }
  return arrows;
}

}  // namespace spindrift
