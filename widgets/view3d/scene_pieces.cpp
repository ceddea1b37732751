// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/scene_pieces.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

#include <array>

#include "widgets/theme/theme.h"
#include "widgets/view3d/face_mesh.h"
#include "widgets/view3d/overlay.h"

namespace spindrift::gui {
namespace {

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

using Line = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

void addBox(FaceMesh& mesh, const Body& body, std::vector<Line>& edges) {
  const auto corner = [&](int k) {
    return Eigen::Vector3d((k & 1) != 0 ? body.high_mm.x() : body.low_mm.x(),
                           (k & 2) != 0 ? body.high_mm.y() : body.low_mm.y(),
                           (k & 4) != 0 ? body.high_mm.z() : body.low_mm.z());
  };
  constexpr std::array<std::array<int, 4>, 6> faces_of{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t f = 0; f < 6; ++f) {
    const Eigen::Vector3d normal = (f % 2 == 0 ? -1.0 : 1.0) * Eigen::Vector3d::Unit(static_cast<int>(f / 2));
    std::vector<vtkIdType> ids;
    for (const int c : faces_of[f]) ids.push_back(mesh.point(corner(c), normal));
    mesh.face(ids);
  }
  for (int a = 0; a < 8; ++a) {
    for (const int bit : {1, 2, 4}) {
      if ((a & bit) == 0) edges.emplace_back(corner(a), corner(a | bit));
    }
  }
}

void addCylinder(FaceMesh& mesh, const Body& body, std::vector<Line>& edges) {
  const int about = body.round_about;
  Eigen::Vector3d from = 0.5 * (body.low_mm + body.high_mm);
  Eigen::Vector3d to = from;
  from[about] = body.low_mm[about];
  to[about] = body.high_mm[about];
  const double radius = 0.5 * (body.high_mm - body.low_mm)[(about + 1) % 3];
  addRod(mesh, from, to, radius);
  for (const Eigen::Vector3d& end : {from, to}) {
    const std::vector<Eigen::Vector3d> rim = circle(end, Eigen::Vector3d::Unit(about), radius);
    for (std::size_t k = 0; k < rim.size(); ++k) edges.emplace_back(rim[k], rim[(k + 1) % rim.size()]);
  }
}

}  // namespace

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
  FaceMesh mesh;
  std::vector<Line> lines;
  for (const Body* body : bodies) {
    mesh.setColour(bodyColour(body->kind));
    body->round_about < 0 ? addBox(mesh, *body, lines) : addCylinder(mesh, *body, lines);
  }
  mesh.writeTo(faces.data);
  faces.mapper->SetColorModeToDirectScalars();
  faces.actor->GetProperty()->SetAmbient(0.40);
  faces.actor->GetProperty()->SetDiffuse(0.85);
  // Faces step back a little so that edges and grid lines stay in front of them.
  faces.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  faces.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);
  makeLines(edges, lines);
  setColour(edges, theme().body_edge);
}

}  // namespace spindrift::gui
