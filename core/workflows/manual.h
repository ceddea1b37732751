// SPDX-License-Identifier: Apache-2.0
// The manual: chapters that people wrote (resources/manual, in the order of their names), then what the program says of
// itself, so that it cannot fall behind: files, error parameters, every effect of the catalogue with its figure, and
// the commands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/reporting/report.h"

namespace spindrift {

/// Markdown of each chapter.
[[nodiscard]] const std::vector<std::string>& manualChapters();

/// `commands`: reference of a program as Markdown (markdownReference), the last chapter; may be empty.
[[nodiscard]] Report manual(std::string_view commands);

}  // namespace spindrift
