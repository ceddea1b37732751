// SPDX-License-Identifier: GPL-3.0-or-later
// Arrows, and surfaces in a box with their nodes: what the scene draws with glyphs (private to view3d).
#pragma once

#include <vtkGlyph3DMapper.h>
#include <vtkRenderer.h>

#include <functional>
#include <optional>
#include <vector>

#include "widgets/view3d/scene_pieces.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

/// One shape at each point of a piece of its own.
struct Glyphs {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkGlyph3DMapper> mapper;
  vtkNew<vtkActor> actor;
  explicit Glyphs(vtkAlgorithm* shape);
};

/// Deviations: shafts as wide as lines, heads of the same size on the screen at every zoom.
class ArrowLayer {
 public:
  explicit ArrowLayer(vtkRenderer* renderer);
  void set(const std::vector<ViewArrow>& arrows, double exaggeration);
  void setColours();
  /// For a camera under which a pixel is this large.
  void place(double mm_per_pixel, double line_width);
  /// Moves all of them, out of a heat map that lies where they begin.
  void raise(const Eigen::Vector3d& by_mm);
  /// The lowest coordinate along `direction` of any end of any arrow, mm; infinite without arrows.
  [[nodiscard]] double lowest_mm(const Eigen::Vector3d& direction) const;
  void onMappers(const std::function<void(vtkMapper*)>& act);

 private:
  void build();
  std::vector<ViewArrow> arrows_;
  double exaggeration_ = 0.0;
  double head_mm_ = 0.0;
  Piece shafts_;
  Glyphs heads_;
};

/// A surface in its box: coloured faces, the lines between its nodes, the nodes and the bars of their uncertainties.
class SurfaceLayer {
 public:
  explicit SurfaceLayer(vtkRenderer* renderer);
  void set(const std::optional<ViewSurface>& surface, const SurfaceBox& box, const ColourScale& scale);
  void setColours();
  void setLineWidth(double pixels);
  [[nodiscard]] bool shown() const { return faces_.actor->GetVisibility() != 0 || nodes_.actor->GetVisibility() != 0; }
  void onMappers(const std::function<void(vtkMapper*)>& act);

 private:
  Piece faces_, mesh_, bars_, frame_;
  Glyphs nodes_;
};

}  // namespace spindrift::gui
