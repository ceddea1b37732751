// SPDX-License-Identifier: GPL-3.0-or-later
// Which arrangement a panel has room for.
#pragma once

class QWidget;

namespace spindrift::gui {

/// The height in px that `panel` has as long as its page does not scroll. Where the page scrolls, the panel's own
/// height is what it asks for: arranged by that it would go from one arrangement to the other and back without end.
[[nodiscard]] int roomOnPage(const QWidget& panel);

}  // namespace spindrift::gui
