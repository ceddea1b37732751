// SPDX-License-Identifier: GPL-3.0-or-later
// Names that the demos come with, in the language of the window.
#pragma once

#include <QString>
#include <string>

namespace spindrift::gui {

/// The name of a campaign or a machine as it is shown: those that a demo was written with in the language of the
/// window, every other as its owner wrote it. Files keep what they have.
[[nodiscard]] QString shownName(const std::string& name);
/// What a file keeps where `typed` stands in a field that showed the name `kept`: `kept` unless it was changed.
[[nodiscard]] std::string keptName(const QString& typed, const std::string& kept);

}  // namespace spindrift::gui
