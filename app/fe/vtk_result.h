// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's unstructured grids as results of finite elements: .vtu (one state) and .pvd (a series of .vtu with times).
//
// Displacements are a point array of three components: the one named, else "U", "DISP", "displacement" and the like.
// Nodes are numbered by a point array of whole numbers ("GlobalIds", "node_id", "NodeId", "node"), else by their place
// in the file from 0. A point array of whole numbers 0 and 1 by any other name is a set of nodes. The time of a .vtu is
// its field "TimeValue", else 0.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/finite_elements/fe_result.h"

namespace spindrift {

[[nodiscard]] std::unique_ptr<FeResultReader> openVtkResult(const std::filesystem::path& file,
                                                            const std::string& displacement_array);

}  // namespace spindrift
