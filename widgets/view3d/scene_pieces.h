// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the scene: a piece of geometry with its actor, lines and the shaded bodies of the machine (private to
// view3d).
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

#include <Eigen/Core>
#include <QColor>
#include <utility>
#include <vector>

#include "widgets/view3d/machine_bodies.h"

namespace spindrift::gui {

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

void setColour(Piece& piece, const QColor& colour);
/// Lines without lighting.
void makeLines(Piece& piece, const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& lines);
/// Shaded boxes and cylinders with a colour each, and their edges.
void makeBodies(Piece& faces, Piece& edges, const std::vector<const Body*>& bodies);

}  // namespace spindrift::gui
