// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plots/surface_plot.h"

#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/theme/light_colours.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

SurfacePlot::SurfacePlot(QWidget* parent) : View3D(parent) {
  setAccessibleName(tr("Surface over position and time"));
}

void SurfacePlot::setData(ViewSurface data, const ColourScale& scale) {
  data_ = std::move(data);
  setColourScale(scale);
  const bool known = std::any_of(data_.value.begin(), data_.value.end(), [](double v) { return std::isfinite(v); });
  setSurface(known ? std::optional(data_) : std::nullopt);
}

void SurfacePlot::exportTo(const QString& file) {
  if (!file.toLower().endsWith(QLatin1String(".csv"))) {
    const LightColours light;
    const FileUnits units;
    if (!picture(size().expandedTo({800, 600}), picture_ratio).save(file))
      throw InputError({file.toStdString(), ""}, "the picture could not be written.");
    return;
  }
  std::string text = "x,y,value,sigma\n";
  for (std::size_t row = 0; row < data_.y.size(); ++row) {
    for (std::size_t column = 0; column < data_.x.size(); ++column) {
      const std::size_t n = data_.index(column, row);
      if (!std::isfinite(data_.value[n])) continue;
      text += exactNumber(data_.x[column]) + "," + exactNumber(data_.y[row]) + "," + exactNumber(data_.value[n]) + "," +
              (n < data_.sigma.size() && std::isfinite(data_.sigma[n]) ? exactNumber(data_.sigma[n]) : "") + "\n";
    }
  }
  writeFileAtomically(file.toStdString(), text);
}

}  // namespace spindrift::gui
