// SPDX-License-Identifier: GPL-3.0-or-later
// A question before something that cannot be taken back, which the user may switch off (Edit > Preferences).
#pragma once

#include <QString>

#include "widgets/common/preferences.h"

class QWidget;

namespace spindrift::gui {

struct Question {
  QString title;
  QString sentence;                    ///< what is going to be lost, and what is kept
  QString go_ahead;                    ///< what the button says: "Quit"
  bool Preferences::*asked = nullptr;  ///< the preference that switches the question off
};

/// True: go ahead. It is not asked where the user does not want to be asked. Cancel is what Enter and Esc mean.
[[nodiscard]] bool goAhead(const Question& question, QWidget* parent);

}  // namespace spindrift::gui
