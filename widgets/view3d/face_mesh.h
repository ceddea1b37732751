// SPDX-License-Identifier: GPL-3.0-or-later
// Faces with normals and colours for VTK, and the simple solids that bodies of machines and shapes are made of (private
// to view3d). Lengths mm in MCF.
#pragma once

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Core>
#include <QColor>
#include <array>
#include <vector>

namespace spindrift::gui {

class FaceMesh {
 public:
  FaceMesh();
  /// Of the points that follow.
  void setColour(const QColor& colour);
  vtkIdType point(const Eigen::Vector3d& p_mm, const Eigen::Vector3d& normal);
  /// A convex polygon of points.
  void face(const std::vector<vtkIdType>& ids);
  void writeTo(vtkPolyData* data) const;

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> faces_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkUnsignedCharArray> colours_;
  std::array<unsigned char, 3> rgb_{};
};

void addSphere(FaceMesh& mesh, const Eigen::Vector3d& centre_mm, double radius_mm);
/// Points of a circle about `axis` (unit), one after the other.
[[nodiscard]] std::vector<Eigen::Vector3d> circle(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& axis,
                                                  double radius_mm);
/// A closed cylinder; nothing if both ends are the same place.
void addRod(FaceMesh& mesh, const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm, double radius_mm);

}  // namespace spindrift::gui
