// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the scene: a piece of geometry with its actor, and solids put together from VTK's sources (private to
// view3d). Lengths mm in MCF.
#pragma once

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

#include <Eigen/Core>
#include <QColor>
#include <utility>
#include <vector>

#include "widgets/view3d/machine_bodies.h"

class vtkAlgorithm;

namespace spindrift::gui {

struct ViewShape;

/// Geometry, mapper and actor together.
struct Piece {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;

  Piece() {
    mapper->SetInputData(data);
    actor->SetMapper(mapper);
    actor->PickableOff();
  }
};

/// What several sources make, each in a colour of its own.
class Parts {
 public:
  void add(vtkAlgorithm* source, const QColor& colour);
  void addRod(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm, double radius_mm, const QColor& colour);
  /// Into the piece, which is shown if there is anything.
  void writeTo(Piece& piece);

 private:
  vtkNew<vtkAppendPolyData> all_;
};

void setColour(Piece& piece, const QColor& colour);
/// Lines without lighting.
void makeLines(Piece& piece, const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& lines);
/// Shaded boxes and cylinders with a colour each, and their edges.
void makeBodies(Piece& faces, Piece& edges, const std::vector<const Body*>& bodies);
/// Spheres and rods, and paths, in the colours of the theme.
void makeShapes(Piece& faces, Piece& lines, const std::vector<ViewShape>& shapes);
/// Lines of equal value of a mesh with scalars; nothing without levels.
void makeContours(Piece& piece, vtkPolyData* mesh, const std::vector<double>& levels);

}  // namespace spindrift::gui
