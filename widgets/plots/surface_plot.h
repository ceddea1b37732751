// SPDX-License-Identifier: GPL-3.0-or-later
// A quantity over two others as a surface in space: errors of an axis over position and time. A 3D view as all others:
// colour bar, buttons, value ± uncertainty of a node under the cursor. By keyboard beside the keys of a view: N and B
// move a cursor to the next and the previous node of a row, Shift + N and Shift + B to the next and the previous row,
// Escape takes it away.
#pragma once

#include <QString>
#include <optional>

#include "widgets/theme/colour_map.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

class SurfacePlot : public View3D {
  Q_OBJECT
 public:
  explicit SurfacePlot(QWidget* parent = nullptr);
  /// Replaces what was there; without a single finite value the view is empty.
  void setData(ViewSurface data, const ColourScale& scale);
  [[nodiscard]] const ViewSurface& data() const { return data_; }
  /// By the ending: .png, .csv. Throws InputError.
  void exportTo(const QString& file);
  /// The node at which the cursor of the keyboard stands, an index of the values.
  [[nodiscard]] std::optional<std::size_t> cursor() const { return cursor_; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void setCursorAt(const std::optional<std::size_t>& node);
  /// The next node with a value, along the row or to another row.
  void moveCursor(int columns, int rows);
  [[nodiscard]] std::optional<QPointF> placeOf(std::size_t node) const;

  ViewSurface data_;
  QString unit_;  ///< of the values, as in files
  std::optional<std::size_t> cursor_;
  QString described_;  ///< what the surface is described by while no node is
};

}  // namespace spindrift::gui
