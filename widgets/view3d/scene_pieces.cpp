// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/scene_pieces.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>
#include <numbers>

#include "widgets/theme/theme.h"
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

/// Faces with normals and colours of many bodies.
class BodyMesh {
 public:
  BodyMesh() {
    normals_->SetNumberOfComponents(3);
    colours_->SetNumberOfComponents(3);
  }
  void setColour(const QColor& c) {
    rgb_ = {static_cast<unsigned char>(c.red()), static_cast<unsigned char>(c.green()),
            static_cast<unsigned char>(c.blue())};
  }
  vtkIdType point(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    normals_->InsertNextTuple3(normal.x(), normal.y(), normal.z());
    colours_->InsertNextTypedTuple(rgb_.data());
    return points_->InsertNextPoint(p.x(), p.y(), p.z());
  }
  void face(const std::vector<vtkIdType>& ids) {
    faces_->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  void edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { edges_.emplace_back(a, b); }
  void writeTo(vtkPolyData* data) const {
    data->SetPoints(points_);
    data->SetPolys(faces_);
    data->GetPointData()->SetNormals(normals_);
    data->GetPointData()->SetScalars(colours_);
    data->Modified();
  }
  [[nodiscard]] const std::vector<Line>& edges() const { return edges_; }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> faces_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkUnsignedCharArray> colours_;
  std::array<unsigned char, 3> rgb_{};
  std::vector<Line> edges_;
};

void addBox(BodyMesh& mesh, const Body& body) {
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
      if ((a & bit) == 0) mesh.edge(corner(a), corner(a | bit));
    }
  }
}

void addCylinder(BodyMesh& mesh, const Body& body) {
  constexpr int around = 36;
  const int axis = body.round_about;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const Eigen::Vector3d middle = 0.5 * (body.low_mm + body.high_mm);
  const Eigen::Vector3d half = 0.5 * (body.high_mm - body.low_mm);
  const auto normal = [&](int k) {
    const double turn = 2.0 * std::numbers::pi * k / around;
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    n[u] = std::cos(turn);
    n[v] = std::sin(turn);
    return n;
  };
  const auto rim = [&](int k, double end) {
    Eigen::Vector3d p = middle + half.cwiseProduct(normal(k));
    p[axis] = middle[axis] + end * half[axis];
    return p;
  };
  for (int k = 0; k < around; ++k) {
    mesh.face({mesh.point(rim(k, -1), normal(k)), mesh.point(rim(k + 1, -1), normal(k + 1)),
               mesh.point(rim(k + 1, 1), normal(k + 1)), mesh.point(rim(k, 1), normal(k))});
  }
  for (const double end : {-1.0, 1.0}) {
    std::vector<vtkIdType> ids;
    for (int k = 0; k < around; ++k) {
      ids.push_back(mesh.point(rim(k, end), end * Eigen::Vector3d::Unit(axis)));
      mesh.edge(rim(k, end), rim(k + 1, end));
    }
    mesh.face(ids);
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
  BodyMesh mesh;
  for (const Body* body : bodies) {
    mesh.setColour(bodyColour(body->kind));
    body->round_about < 0 ? addBox(mesh, *body) : addCylinder(mesh, *body);
  }
  mesh.writeTo(faces.data);
  faces.mapper->SetColorModeToDirectScalars();
  faces.actor->GetProperty()->SetAmbient(0.40);
  faces.actor->GetProperty()->SetDiffuse(0.85);
  // Faces step back a little so that edges and grid lines stay in front of them.
  faces.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  faces.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);
  makeLines(edges, mesh.edges());
  setColour(edges, theme().body_edge);
}

}  // namespace spindrift::gui
