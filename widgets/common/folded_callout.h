// SPDX-License-Identifier: GPL-3.0-or-later
// A callout that tells the first of its sentences, and the others on demand.
#pragma once

#include "widgets/theme/theme.h"

class QString;

namespace spindrift::gui {

class Callout;

/// Shows the first sentence with a button "Details" that shows all of them, and takes it back ("Less"). What was opened
/// stays open as long as the same is told. Callout::sentence() is all of it. Takes the callout's button.
void showFolded(Callout& callout, Tone tone, const QString& sentences);

}  // namespace spindrift::gui
