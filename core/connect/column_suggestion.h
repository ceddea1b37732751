// SPDX-License-Identifier: Apache-2.0
// Which column of log.csv a data item would be: from its unit, its type and its names, to be confirmed by the user.
//
// Temperatures become T_<name>_degC with the role that the name tells (core/machine/sensor_role.h); speeds of spindles
// spindle_rpm; positions pos_x_mm (y, z) and feeds feed_x_mm_min (y, z) where the axis is named; anything else its
// cleaned name with its unit. Words get the table of numbers that their type is known for, or none.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/connect/record.h"

namespace spindrift {

/// An entry of "columns" of connections.json; its column is none of `taken`.
[[nodiscard]] nlohmann::json suggestColumn(const DataItem& item, const std::string& source,
                                           const std::set<std::string>& taken);

}  // namespace spindrift
