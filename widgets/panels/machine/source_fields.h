// SPDX-License-Identifier: GPL-3.0-or-later
// What the tab Connections asks of a source beside its address, by kind. Secrets only by where they are.
#pragma once

#include <string>
#include <vector>

#include "widgets/panels/common/fields_dialog.h"

namespace spindrift::gui {

[[nodiscard]] std::vector<FormField> fieldsOfSource(const std::string& kind);

}  // namespace spindrift::gui
