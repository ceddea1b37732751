// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/nine_parameter_maps.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/workflows/fit_campaign.h"

namespace spindrift {
namespace {

constexpr int nodes_along_the_table = 120;

double largestKnown(const Field& field) {
  double largest = 0.0;
  for (std::size_t i = 0; i < field.value.size(); ++i)
    if (std::isfinite(field.sigma[i])) largest = std::max(largest, std::abs(field.value[i]));
  for (const Field::Marker& m : field.markers)
    if (std::isfinite(m.sigma)) largest = std::max(largest, std::abs(m.value));
  return largest;
}

DisplacementMaps mapsOf(const NineParameterFit& fit, const ErrorModel& model, const FieldGrid& grid) {
  DisplacementMaps maps;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    maps[k].field = tableField(fit, model, grid, all_components[k]);
    maps[k].largest_um = largestKnown(maps[k].field);
  }
  return maps;
}

/// The points of the first set, with what the second says of them beyond it.
DisplacementMaps mapsOf(const NineParameterComparison& compared, const FieldGrid& grid) {
  const NineParameterModel model = compared.differenceModel();
  DeviationQuery here;
  here.state = compared.a.state;
  DisplacementMaps maps;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const Component component = all_components[k];
    std::vector<Eigen::Vector2d> measured;
    std::vector<Field::Marker> markers;
    for (const NineParameterResidual& r : compared.a.residuals) {
      if (r.component != component) continue;
      measured.emplace_back(r.position_mm.head<2>());
      here.position_mm = r.position_mm;
      const PredictedComponent difference = model.predict(here, component);
      markers.push_back({r.point, r.position_mm, difference.value, difference.sigma, r.used});
    }
    DeviationQuery conditions;
    conditions.state = compared.a.state;
    maps[k].field = evaluateField(model, grid, component, conditions, measured);
    maps[k].field.markers = std::move(markers);
    maps[k].largest_um = largestKnown(maps[k].field);
  }
  return maps;
}

}  // namespace

std::vector<PointChange> pointChanges(const ObservationSet& observations, const std::string& state) {
  const StateDifferences change = differencesFromReference(observations, state);
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::nan(""));
  std::map<std::string, PointChange> found;
  for (std::size_t k = 0; k < change.rows.size(); ++k) {
    const Observation& row = observations.rows[change.rows[k]];
    PointChange& point =
        found.try_emplace(row.point, PointChange{row.point, row.position_mm, none, none}).first->second;
    const auto component = static_cast<Eigen::Index>(row.component);
    if (component > 2) continue;
    point.value_um[component] = change.value_um(static_cast<Eigen::Index>(k));
    point.sigma_um[component] = change.sigma_um(k);
  }
  std::vector<PointChange> points;
  for (const std::string& name : observations.points())
    if (const auto at = found.find(name); at != found.end()) points.push_back(at->second);
  return points;
}

std::optional<NineParameterMaps> nineParameterMaps(const MachineDescription& machine, const NineParameterFit& fit,
                                                   const TableOrderChoice& order,
                                                   const std::optional<NineParameterComparison>& compared) {
  if (fit.residuals.empty() || fit.status == FitStatus::Rejected) return std::nullopt;
  double z_mm = 0.0;
  for (const NineParameterResidual& r : fit.residuals)
    z_mm += r.position_mm.z() / static_cast<double>(fit.residuals.size());
  const std::optional<FieldGrid> grid = mapTable(machine, z_mm, nodes_along_the_table);
  if (!grid) return std::nullopt;
  NineParameterMaps maps;
  maps.nine = mapsOf(fit, fit.predictingModel(), *grid);
  if (order.richer()) maps.higher = mapsOf(fit, *order.model, *grid);
  if (compared && !std::isnan(compared->p_value_all)) maps.difference = mapsOf(*compared, *grid);
  return maps;
}

}  // namespace spindrift
