// SPDX-License-Identifier: GPL-3.0-or-later
// A VTK render window that needs neither a display nor a window system (private to view3d).
#pragma once

#include <vtkSmartPointer.h>

class vtkRenderWindow;

namespace spindrift::gui {

/// On Linux: an own EGL context without a surface (a graphics card where there is one, else Mesa's software renderer).
/// Elsewhere: VTK's own off-screen window. Throws std::runtime_error with a sentence for the user if there is no
/// OpenGL.
[[nodiscard]] vtkSmartPointer<vtkRenderWindow> makeOffscreenWindow();

}  // namespace spindrift::gui
