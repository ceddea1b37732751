// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/core_formats.h"

#include <algorithm>
#include <cstring>

#include "widgets/common/core_formats/groups.h"

namespace spindrift::gui {

const std::vector<const char*>& coreFormats() {
  static const std::vector<const char*> all = [] {
    std::vector<const char*> out;
    for (const auto& group : core_formats::groups) {
      const auto formats = group();
      out.insert(out.end(), formats.begin(), formats.end());
    }
    std::sort(out.begin(), out.end(), [](const char* a, const char* b) { return std::strcmp(a, b) < 0; });
    return out;
  }();
  return all;
}

}  // namespace spindrift::gui
