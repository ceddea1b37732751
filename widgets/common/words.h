// SPDX-License-Identifier: GPL-3.0-or-later
// Small changes of a text for where it stands.
#pragma once

#include <QString>
#include <string_view>

namespace spindrift::gui {

/// The first letter as a capital.
[[nodiscard]] QString sentenceStart(QString text);
/// A unit as people write it: "um" -> "µm".
[[nodiscard]] QString unitText(std::string_view unit);

}  // namespace spindrift::gui
