// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/face_mesh.h"

#include <vtkPointData.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace spindrift::gui {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int around = 28;

/// Normals of a cylinder about `axis` (unit).
std::vector<Eigen::Vector3d> normalsAbout(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d help = std::abs(axis.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d u = axis.cross(help).normalized();
  const Eigen::Vector3d v = axis.cross(u);
  std::vector<Eigen::Vector3d> normals;
  for (int k = 0; k < around; ++k) {
    const double turn = 2 * pi * k / around;
    normals.push_back(std::cos(turn) * u + std::sin(turn) * v);
  }
  return normals;
}

void addDisc(FaceMesh& mesh, const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius) {
  std::vector<vtkIdType> rim;
  for (const Eigen::Vector3d& p : circle(centre, normal, radius)) rim.push_back(mesh.point(p, normal));
  mesh.face(rim);
}

}  // namespace

FaceMesh::FaceMesh() {
  normals_->SetNumberOfComponents(3);
  colours_->SetNumberOfComponents(3);
}

void FaceMesh::setColour(const QColor& colour) {
  rgb_ = {static_cast<unsigned char>(colour.red()), static_cast<unsigned char>(colour.green()),
          static_cast<unsigned char>(colour.blue())};
}

vtkIdType FaceMesh::point(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& normal) {
  normals_->InsertNextTuple3(normal.x(), normal.y(), normal.z());
  colours_->InsertNextTypedTuple(rgb_.data());
  return points_->InsertNextPoint(p_mm.x(), p_mm.y(), p_mm.z());
}

void FaceMesh::face(const std::vector<vtkIdType>& ids) {
  faces_->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
}

void FaceMesh::writeTo(vtkPolyData* data) const {
  data->SetPoints(points_);
  data->SetPolys(faces_);
  data->GetPointData()->SetNormals(normals_);
  data->GetPointData()->SetScalars(colours_);
  data->Modified();
}

void addSphere(FaceMesh& mesh, const Eigen::Vector3d& centre_mm, double radius_mm) {
  constexpr int rings = 14;
  std::vector<vtkIdType> ids;
  for (int i = 0; i <= rings; ++i) {
    const double polar = pi * i / rings;
    for (int j = 0; j <= around; ++j) {
      const double turn = 2 * pi * j / around;
      const Eigen::Vector3d n(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      ids.push_back(mesh.point(centre_mm + radius_mm * n, n));
    }
  }
  const auto at = [&](int i, int j) { return ids[static_cast<std::size_t>(i * (around + 1) + j)]; };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) mesh.face({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
}

std::vector<Eigen::Vector3d> circle(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& axis, double radius_mm) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& n : normalsAbout(axis)) points.emplace_back(centre_mm + radius_mm * n);
  return points;
}

void addRod(FaceMesh& mesh, const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm, double radius_mm) {
  if ((to_mm - from_mm).norm() < 1e-9) return;
  const Eigen::Vector3d axis = (to_mm - from_mm).normalized();
  std::vector<std::pair<vtkIdType, vtkIdType>> rim;
  for (const Eigen::Vector3d& n : normalsAbout(axis)) {
    rim.emplace_back(mesh.point(from_mm + radius_mm * n, n), mesh.point(to_mm + radius_mm * n, n));
  }
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const auto& next = rim[(k + 1) % rim.size()];
    mesh.face({rim[k].first, next.first, next.second, rim[k].second});
  }
  addDisc(mesh, from_mm, -axis, radius_mm);
  addDisc(mesh, to_mm, axis, radius_mm);
}

}  // namespace spindrift::gui
