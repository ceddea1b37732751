// SPDX-License-Identifier: GPL-3.0-or-later
// What all Capture pages share: beside what is captured, what arrives now, and the camera.
#pragma once

#include "widgets/panels/page_context.h"

class QTabWidget;

namespace spindrift::gui {

/// Tabs of `parent`: "Captures" with `captured`, "Arriving" (watched folder, plan) and, for a microscope, "Camera".
[[nodiscard]] QTabWidget* captureTabs(QWidget* parent, QWidget* captured, const PageContext& context,
                                      Instrument instrument);

/// While captures arrive they are what one wants to see, else those that are there.
void chooseCaptureTab(QWidget& page, SessionModel& session);

}  // namespace spindrift::gui
