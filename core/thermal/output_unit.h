// SPDX-License-Identifier: Apache-2.0
// The unit of what a thermal model predicts.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// For people to read. By the end of the column's name: "urad", "um/m", "rpm", "degC" for every temperature (a series
/// holds them in degC, whatever their column), "um" for displacements and for names without a unit.
[[nodiscard]] std::string outputUnit(std::string_view column);

/// As model files write it: "urad", "um/m", else "um"; the compensator takes whatever a model predicts for a deviation.
[[nodiscard]] std::string modelUnit(std::string_view column);

}  // namespace spindrift
