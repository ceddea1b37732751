// SPDX-License-Identifier: GPL-3.0-or-later
// A quantity over two others as a surface in space: errors of an axis over position and time. A 3D view as all others:
// colour bar, buttons, value ± uncertainty of a node under the cursor.
#pragma once

#include <QString>

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

 private:
  ViewSurface data_;
};

}  // namespace spindrift::gui
