// SPDX-License-Identifier: Apache-2.0
// The maps that are shown of a fitted state: EX, EY and EZ over the table at the mean height of the points, of the
// nine-parameter model, of the model of higher order where the evidence asks for one, and of what two sets of points
// disagree about. Units um, mm in MCF.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/machine_description.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/table_polynomial.h"

namespace spindrift {

/// One map; its markers are the measured points.
struct ComponentMap {
  Field field;
  double largest_um = 0.0;  ///< |value| where it is known, over nodes and markers
};
/// EX, EY, EZ.
using DisplacementMaps = std::array<ComponentMap, 3>;

struct NineParameterMaps {
  DisplacementMaps nine;
  std::optional<DisplacementMaps> higher;
  /// Second set minus first; a marker whose sigma is not finite has no value.
  std::optional<DisplacementMaps> difference;
};

/// A measured point against the reference state, EX, EY, EZ in um; NaN: not measured.
struct PointChange {
  std::string point;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d value_um, sigma_um;
};
/// In the order of the set. Throws InputError as differencesFromReference.
[[nodiscard]] std::vector<PointChange> pointChanges(const ObservationSet& observations, const std::string& state);

/// Nothing without residuals, or where the machine has no X or no Y axis.
[[nodiscard]] std::optional<NineParameterMaps> nineParameterMaps(
    const MachineDescription& machine, const NineParameterFit& fit, const TableOrderChoice& order,
    const std::optional<NineParameterComparison>& compared);

}  // namespace spindrift
