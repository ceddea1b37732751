// SPDX-License-Identifier: Apache-2.0
// A deviation that is known at the observations only, um or urad: looked up by point, component and the way it was
// measured, linear in time between the readings of the same kind, constant before the first and after the last.
#pragma once

#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/observation.h"

namespace spindrift {

class ObservedField {
 public:
  /// `values` of the rows; rows whose value is NaN are left out.
  ObservedField(std::span<const Observation> rows, std::span<const double> values);
  /// 0 where nothing like it was observed.
  [[nodiscard]] double at(const DeviationQuery& query, Component component) const;

 private:
  /// Point, component, table angle in mdeg, approach, tool in um: what tells readings of one series apart.
  using Key = std::tuple<std::string, int, long long, int, int, int, long long, long long, long long>;
  static Key keyOf(const DeviationQuery& query, Component component);
  std::map<Key, std::vector<std::pair<double, double>>> series_;  ///< time_s and value, in order of time
};

}  // namespace spindrift
