// SPDX-License-Identifier: GPL-3.0-or-later
// What a window says, as text: beside a picture it tells what a picture cannot, and it is the same at every scale and
// in every theme.
#pragma once

#include <QString>

class QWidget;

namespace spindrift::gui {

/// A line for each visible control in the order of their making, inner ones further in: the text of labels; of others
/// what they are called in angle brackets, what they hold, whether they are checked or cannot be used. Of tables the
/// titles and the first rows, of menus the entries. Controls that say nothing are left out, parts of them are not.
[[nodiscard]] QString pageState(const QWidget& window);

}  // namespace spindrift::gui
