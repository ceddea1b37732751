// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace spindrift::testing {

/// The top of the tree that the tests were built from. Known to one file alone, so that nothing else is compiled anew
/// where the tree lies elsewhere.
[[nodiscard]] std::filesystem::path sourceFolder();

/// What tests read, tests/data of the tree.
[[nodiscard]] std::filesystem::path testData();

}  // namespace spindrift::testing
