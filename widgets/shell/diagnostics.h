// SPDX-License-Identifier: GPL-3.0-or-later
// What a user sends along with a report of something that went wrong.
#pragma once

#include <QString>

namespace spindrift::gui {

/// Version, platform, memory and the last messages of the log. Nothing private: folders are cut down to the last name,
/// the names of the user and the computer are replaced, what stands in quotes (names of campaigns) is left out.
[[nodiscard]] QString diagnosticsText();

/// A line of the log without what is private in it.
[[nodiscard]] QString withoutPrivateData(QString line);

/// Memory of this process in use now, MB; 0 where the system does not tell.
[[nodiscard]] double residentMegabytes();
/// The most it ever was.
[[nodiscard]] double peakMegabytes();

}  // namespace spindrift::gui
