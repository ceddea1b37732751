// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/shapes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>

#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int around = 28;

QColor colourOf(const ViewShape& shape) {
  const Theme& t = theme();
  if (shape.tone != Tone::Neutral)
    return mixed(t.tone(shape.tone), t.view_top, shape.kind == ShapeKind::Path ? 0 : 0.2);
  return shape.kind == ShapeKind::Path ? t.text_secondary : mixed(t.body, t.text, 0.30);
}

class FaceWriter {
 public:
  FaceWriter() {
    normals_->SetNumberOfComponents(3);
    colours_->SetNumberOfComponents(3);
  }
  void colour(const QColor& c) {
    rgb_ = {static_cast<unsigned char>(c.red()), static_cast<unsigned char>(c.green()),
            static_cast<unsigned char>(c.blue())};
  }
  vtkIdType point(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    normals_->InsertNextTuple3(normal.x(), normal.y(), normal.z());
    colours_->InsertNextTypedTuple(rgb_.data());
    return points_->InsertNextPoint(p.x(), p.y(), p.z());
  }
  void quad(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d) {
    const std::array<vtkIdType, 4> ids{a, b, c, d};
    faces_->InsertNextCell(4, ids.data());
  }
  void triangle(vtkIdType a, vtkIdType b, vtkIdType c) {
    const std::array<vtkIdType, 3> ids{a, b, c};
    faces_->InsertNextCell(3, ids.data());
  }
  void writeTo(vtkPolyData* data) {
    data->SetPoints(points_);
    data->SetPolys(faces_);
    data->GetPointData()->SetNormals(normals_);
    data->GetPointData()->SetScalars(colours_);
    data->Modified();
  }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> faces_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkUnsignedCharArray> colours_;
  std::array<unsigned char, 3> rgb_{};
};

void addSphere(FaceWriter& out, const Eigen::Vector3d& centre, double radius) {
  constexpr int rings = 14;
  std::vector<vtkIdType> ids;
  for (int i = 0; i <= rings; ++i) {
    const double polar = pi * i / rings;
    for (int j = 0; j <= around; ++j) {
      const double turn = 2 * pi * j / around;
      const Eigen::Vector3d n(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      ids.push_back(out.point(centre + radius * n, n));
    }
  }
  const auto at = [&](int i, int j) { return ids[static_cast<std::size_t>(i * (around + 1) + j)]; };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) out.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
}

/// Two directions across `axis` (unit).
std::pair<Eigen::Vector3d, Eigen::Vector3d> across(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d help = std::abs(axis.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d u = axis.cross(help).normalized();
  return {u, axis.cross(u)};
}

void addDisc(FaceWriter& out, const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius) {
  const auto [u, v] = across(normal);
  const vtkIdType middle = out.point(centre, normal);
  std::vector<vtkIdType> rim;
  for (int j = 0; j < around; ++j) {
    const double turn = 2 * pi * j / around;
    rim.push_back(out.point(centre + radius * (std::cos(turn) * u + std::sin(turn) * v), normal));
  }
  for (std::size_t j = 0; j < rim.size(); ++j) out.triangle(middle, rim[j], rim[(j + 1) % rim.size()]);
}

void addRod(FaceWriter& out, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  if ((to - from).norm() < 1e-9) return;
  const Eigen::Vector3d axis = (to - from).normalized();
  const auto [u, v] = across(axis);
  std::vector<std::pair<vtkIdType, vtkIdType>> rim;
  for (int j = 0; j <= around; ++j) {
    const double turn = 2 * pi * j / around;
    const Eigen::Vector3d n = std::cos(turn) * u + std::sin(turn) * v;
    rim.emplace_back(out.point(from + radius * n, n), out.point(to + radius * n, n));
  }
  for (std::size_t j = 0; j + 1 < rim.size(); ++j)
    out.quad(rim[j].first, rim[j].second, rim[j + 1].second, rim[j + 1].first);
  addDisc(out, from, -axis, radius);
  addDisc(out, to, axis, radius);
}

}  // namespace

void makeShapeFaces(vtkPolyData* data, const std::vector<ViewShape>& shapes) {
  FaceWriter out;
  for (const ViewShape& shape : shapes) {
    if (shape.points_mm.empty()) continue;
    out.colour(colourOf(shape));
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
