// SPDX-License-Identifier: GPL-3.0-or-later
// What a page says beside how its step is.
#pragma once

#include "widgets/common/parts.h"

namespace spindrift::gui {

/// Adds a sentence that asks for nothing to what a callout says: it takes away no warning and makes none.
inline void addNote(Callout& callout, const QString& note) {
  const Tone tone = callout.tone() == Tone::Good || callout.tone() == Tone::Neutral ? Tone::Accent : callout.tone();
  callout.show(tone, (callout.sentence() + QLatin1Char(' ') + note).trimmed());
}

}  // namespace spindrift::gui
