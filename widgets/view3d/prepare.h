// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spindrift::gui {

/// Loads the OpenGL driver and sets it up, which the first 3D view would otherwise wait for (a few hundredths of a
/// second with software rendering). Any thread; once is enough, more does nothing. Where there is no OpenGL nothing
/// happens: the first view says so.
void prepareOpenGl();

}  // namespace spindrift::gui
