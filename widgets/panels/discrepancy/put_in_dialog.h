// SPDX-License-Identifier: GPL-3.0-or-later
// Asks where the new version of a simulator goes.
#pragma once

#include <QString>

class QWidget;

namespace spindrift::gui {

/// The folder; empty: the user has thought better of it. `runs`: which programs will be run.
[[nodiscard]] QString askForVersionFolder(QWidget* parent, const QString& proposed, const QString& runs);

}  // namespace spindrift::gui
