// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/source_folder.h"

namespace spindrift::testing {

std::filesystem::path sourceFolder() {
  return SPINDRIFT_SOURCE_DIR;
}

std::filesystem::path testData() {
  return sourceFolder() / "tests/data";
}

}  // namespace spindrift::testing
