// SPDX-License-Identifier: GPL-3.0-or-later
// Simple solids and paths of the 3D view as VTK's triangles and lines (private to view3d).
#pragma once

#include <vector>

class vtkPolyData;

namespace spindrift::gui {

struct ViewShape;

/// Triangles with normals and a colour each, in the colours of the theme.
void makeShapeFaces(vtkPolyData* data, const std::vector<ViewShape>& shapes);
/// Paths, with a colour each.
void makeShapeLines(vtkPolyData* data, const std::vector<ViewShape>& shapes);

}  // namespace spindrift::gui
