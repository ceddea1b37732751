// SPDX-License-Identifier: GPL-3.0-or-later
// The style sheet made from a theme. Roles are set with setRole().
#pragma once

#include <QString>

namespace spindrift::gui {

struct Theme;

[[nodiscard]] QString styleSheet(const Theme& theme);

}  // namespace spindrift::gui
