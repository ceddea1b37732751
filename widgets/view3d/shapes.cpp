// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/shapes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>

#include "widgets/view3d/face_mesh.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

QColor colourOf(const ViewShape& shape) {
  const Theme& t = theme();
  if (shape.tone != Tone::Neutral)
    return mixed(t.tone(shape.tone), t.view_top, shape.kind == ShapeKind::Path ? 0 : 0.2);
  return shape.kind == ShapeKind::Path ? t.text_secondary : mixed(t.body, t.text, 0.30);
}

}  // namespace

void makeShapeFaces(vtkPolyData* data, const std::vector<ViewShape>& shapes) {
  FaceMesh out;
  for (const ViewShape& shape : shapes) {
    if (shape.points_mm.empty()) continue;
    out.setColour(colourOf(shape));
    switch (shape.kind) {
      case ShapeKind::Sphere:
        addSphere(out, shape.points_mm.front(), shape.radius_mm);
        break;
      case ShapeKind::Rod:
        if (shape.points_mm.size() == 2) addRod(out, shape.points_mm[0], shape.points_mm[1], shape.radius_mm);
        break;
      case ShapeKind::Path:
        break;
    }
  }
  out.writeTo(data);
}

void makeShapeLines(vtkPolyData* data, const std::vector<ViewShape>& shapes) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const ViewShape& shape : shapes) {
    if (shape.kind != ShapeKind::Path || shape.points_mm.size() < 2) continue;
    const QColor c = colourOf(shape);
    const std::array<unsigned char, 3> rgb{static_cast<unsigned char>(c.red()), static_cast<unsigned char>(c.green()),
                                           static_cast<unsigned char>(c.blue())};
    std::vector<vtkIdType> ids;
    for (const Eigen::Vector3d& p : shape.points_mm) ids.push_back(points->InsertNextPoint(p.x(), p.y(), p.z()));
    lines->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    colours->InsertNextTypedTuple(rgb.data());
  }
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->SetScalars(colours);
  data->Modified();
}

}  // namespace spindrift::gui
