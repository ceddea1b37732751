// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/scene_pieces.h"

#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkContourFilter.h>
#include <vtkCubeSource.h>
#include <vtkLineSource.h>
#include <vtkOutlineSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <array>

#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr int around = 28;

QColor bodyColour(BodyKind kind) {
  const Theme& t = theme();
  switch (kind) {
    case BodyKind::Table:
      return mixed(t.body, t.surface, t.kind == ThemeKind::Light ? 0.55 : 0.0);
    case BodyKind::WorkpieceSide:
      return mixed(t.body, t.accent, 0.10);
    case BodyKind::Bed:
      return mixed(t.body, t.body_edge, 0.25);
    case BodyKind::Column:
      return t.body;
    case BodyKind::ToolSide:
      return mixed(t.body, t.axis_z, 0.16);
    case BodyKind::Spindle:
      return mixed(t.body, t.text, 0.35);
  }
  return t.body;
}

QColor shapeColour(const ViewShape& shape) {
  const Theme& t = theme();
  if (shape.tone != Tone::Neutral)
    return mixed(t.tone(shape.tone), t.view_top, shape.kind == ShapeKind::Path ? 0 : 0.2);
  return shape.kind == ShapeKind::Path ? t.text_secondary : mixed(t.body, t.text, 0.30);
}

/// Lit, and a little behind the edges and lines that lie on it.
void shade(Piece& faces) {
  faces.actor->GetProperty()->SetAmbient(0.40);
  faces.actor->GetProperty()->SetDiffuse(0.85);
  faces.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  faces.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);
}

void addBox(Parts& faces, Parts& edges, const Body& body) {
  std::array<double, 6> bounds{};
  for (int i = 0; i < 3; ++i) {
    bounds[static_cast<std::size_t>(2 * i)] = body.low_mm[i];
    bounds[static_cast<std::size_t>(2 * i + 1)] = body.high_mm[i];
  }
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(bounds.data());
  faces.add(cube, bodyColour(body.kind));
  vtkNew<vtkOutlineSource> outline;
  outline->SetBounds(bounds.data());
  edges.add(outline, theme().body_edge);
}

void addCylinder(Parts& faces, Parts& edges, const Body& body) {
  const int about = body.round_about;
  Eigen::Vector3d from = 0.5 * (body.low_mm + body.high_mm);
  Eigen::Vector3d to = from;
  from[about] = body.low_mm[about];
  to[about] = body.high_mm[about];
  const double radius = 0.5 * (body.high_mm - body.low_mm)[(about + 1) % 3];
  faces.addRod(from, to, radius, bodyColour(body.kind));
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(about);
  for (const Eigen::Vector3d& end : {from, to}) {
    vtkNew<vtkRegularPolygonSource> rim;
    rim->GeneratePolygonOff();
    rim->SetNumberOfSides(around);
    rim->SetCenter(end.x(), end.y(), end.z());
    rim->SetNormal(axis.x(), axis.y(), axis.z());
    rim->SetRadius(radius);
    edges.add(rim, theme().body_edge);
  }
}

}  // namespace

void Parts::add(vtkAlgorithm* source, const QColor& colour) {
  source->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(source->GetOutputDataObject(0));
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("colour");
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(mesh->GetNumberOfPoints());
  colours->FillComponent(0, colour.red());
  colours->FillComponent(1, colour.green());
  colours->FillComponent(2, colour.blue());
  mesh->GetPointData()->SetTCoords(nullptr);
  mesh->GetPointData()->SetScalars(colours);
  // Only what all parts have is kept, by name.
  if (vtkDataArray* normals = mesh->GetPointData()->GetNormals()) normals->SetName("normal");
  all_->AddInputData(mesh);
}

void Parts::addRod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_mm, const QColor& colour) {
  if ((to - from).norm() < 1e-9) return;
  vtkNew<vtkLineSource> axis;
  axis->SetPoint1(from.x(), from.y(), from.z());
  axis->SetPoint2(to.x(), to.y(), to.z());
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputConnection(axis->GetOutputPort());
  tube->SetRadius(radius_mm);
  tube->SetNumberOfSides(around);
  tube->CappingOn();
  add(tube, colour);
}

void Parts::writeTo(Piece& piece) {
  const bool some = all_->GetNumberOfInputConnections(0) > 0;
  if (some) all_->Update();
  piece.data->Initialize();
  if (some) piece.data->ShallowCopy(all_->GetOutput());
  piece.mapper->SetColorModeToDirectScalars();
  piece.actor->SetVisibility(some);
}

void setColour(Piece& piece, const QColor& colour) {
  piece.actor->GetProperty()->SetColor(colour.redF(), colour.greenF(), colour.blueF());
}

void makeLines(Piece& piece, const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& lines) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : lines) {
    const vtkIdType first = points->InsertNextPoint(a.x(), a.y(), a.z());
    points->InsertNextPoint(b.x(), b.y(), b.z());
    const std::array<vtkIdType, 2> ids{first, first + 1};
    cells->InsertNextCell(2, ids.data());
  }
  piece.data->SetPoints(points);
  piece.data->SetLines(cells);
  piece.data->Modified();
  piece.actor->GetProperty()->LightingOff();
  piece.actor->SetVisibility(!lines.empty());
}

void makeBodies(Piece& faces, Piece& edges, const std::vector<const Body*>& bodies) {
  Parts solids, lines;
  for (const Body* body : bodies)
    body->round_about < 0 ? addBox(solids, lines, *body) : addCylinder(solids, lines, *body);
  solids.writeTo(faces);
  lines.writeTo(edges);
  shade(faces);
  edges.actor->GetProperty()->LightingOff();
}

void makeShapes(Piece& faces, Piece& lines, const std::vector<ViewShape>& shapes) {
  Parts solids, paths;
  for (const ViewShape& shape : shapes) {
    const std::vector<Eigen::Vector3d>& p = shape.points_mm;
    if (shape.kind == ShapeKind::Sphere && !p.empty()) {
      vtkNew<vtkSphereSource> sphere;
      sphere->SetCenter(p[0].x(), p[0].y(), p[0].z());
      sphere->SetRadius(shape.radius_mm);
      sphere->SetThetaResolution(around);
      sphere->SetPhiResolution(around / 2);
      solids.add(sphere, shapeColour(shape));
    } else if (shape.kind == ShapeKind::Rod && p.size() == 2) {
      solids.addRod(p[0], p[1], shape.radius_mm, shapeColour(shape));
    } else if (shape.kind == ShapeKind::Path && p.size() >= 2) {
      vtkNew<vtkPoints> points;
      for (const Eigen::Vector3d& at : p) points->InsertNextPoint(at.x(), at.y(), at.z());
      vtkNew<vtkLineSource> path;
      path->SetPoints(points);
      paths.add(path, shapeColour(shape));
    }
  }
  solids.writeTo(faces);
  paths.writeTo(lines);
  shade(faces);
  lines.actor->GetProperty()->LightingOff();
}

void makeContours(Piece& piece, vtkPolyData* mesh, const std::vector<double>& levels) {
  piece.data->Initialize();
  if (!levels.empty()) {
    vtkNew<vtkContourFilter> filter;
    filter->SetInputData(mesh);
    filter->ComputeScalarsOff();
    filter->ComputeNormalsOff();
    for (std::size_t i = 0; i < levels.size(); ++i) filter->SetValue(static_cast<int>(i), levels[i]);
    filter->Update();
    piece.data->ShallowCopy(filter->GetOutput());
  }
  piece.actor->GetProperty()->LightingOff();
  piece.mapper->ScalarVisibilityOff();
  piece.actor->SetVisibility(piece.data->GetNumberOfLines() > 0);
}

}  // namespace spindrift::gui
