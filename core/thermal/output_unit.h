// SPDX-License-Identifier: Apache-2.0
// The unit of what a thermal model predicts.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// By the end of the column's name, as files write it: "urad", "um/m", "rpm", "degC" for every temperature (a series
/// holds them in degC, whatever their column), "um" for displacements and for names without a unit.
[[nodiscard]] std::string outputUnit(std::string_view column);

}  // namespace spindrift
