// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plots/surface_plot.h"

#include <QFocusEvent>
#include <QKeyEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/theme/light_colours.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/overlay.h"

namespace spindrift::gui {

SurfacePlot::SurfacePlot(QWidget* parent) : View3D(parent) {
  setAccessibleName(tr("Surface over position and time"));
}

void SurfacePlot::setData(ViewSurface data, const ColourScale& scale) {
  if (cursor_) setCursorAt(std::nullopt);
  data_ = std::move(data);
  unit_ = scale.unit;
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

std::optional<QPointF> SurfacePlot::placeOf(std::size_t node) const {
  if (!surfaceBox() || node >= data_.value.size()) return std::nullopt;
  const std::size_t columns = data_.x.size();
  return pixelOf(surfaceBox()->place_mm({data_.x[node % columns], data_.y[node / columns], data_.value[node]}));
}

void SurfacePlot::setCursorAt(const std::optional<std::size_t>& node) {
  if (!cursor_) described_ = accessibleDescription();
  cursor_ = node;
  update();
  if (!cursor_) {
    QToolTip::hideText();
    setAccessibleDescription(described_);
    Q_EMIT hovered({});
    return;
  }
  const QString text = surfaceNodeText(data_, unit_, *cursor_);
  setAccessibleDescription(text);
  if (const auto place = placeOf(*cursor_)) QToolTip::showText(mapToGlobal(place->toPoint()), text, this);
  Q_EMIT hovered(text);
}

void SurfacePlot::moveCursor(int columns, int rows) {
  const auto width = static_cast<int>(data_.x.size()), height = static_cast<int>(data_.y.size());
  const auto known = [&](int column, int row) {
    return std::isfinite(data_.value[data_.index(static_cast<std::size_t>(column), static_cast<std::size_t>(row))]);
  };
  if (!cursor_) {
    const auto first = std::find_if(data_.value.begin(), data_.value.end(), [](double v) { return std::isfinite(v); });
    if (first != data_.value.end()) setCursorAt(static_cast<std::size_t>(first - data_.value.begin()));
    return;
  }
  int column = static_cast<int>(*cursor_) % width + columns, row = static_cast<int>(*cursor_) / width + rows;
  for (; column >= 0 && column < width && row >= 0 && row < height; column += columns, row += rows)
    if (known(column, row))
      return setCursorAt(data_.index(static_cast<std::size_t>(column), static_cast<std::size_t>(row)));
  setCursorAt(cursor_);
}

void SurfacePlot::keyPressEvent(QKeyEvent* event) {
  const bool plain = (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) == 0;
  if (plain && !empty() && (event->key() == Qt::Key_N || event->key() == Qt::Key_B)) {
    const int by = event->key() == Qt::Key_N ? 1 : -1;
    const bool shift = (event->modifiers() & Qt::ShiftModifier) != 0;
    return moveCursor(shift ? 0 : by, shift ? by : 0);
  }
  if (plain && cursor_ && event->key() == Qt::Key_Escape) return setCursorAt(std::nullopt);
  View3D::keyPressEvent(event);
}

void SurfacePlot::focusInEvent(QFocusEvent* event) {
  View3D::focusInEvent(event);
  // Whoever comes by keyboard sees where the keys work.
  if (!empty() && (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason))
    moveCursor(0, 0);
}

void SurfacePlot::focusOutEvent(QFocusEvent* event) {
  View3D::focusOutEvent(event);
  if (cursor_ && event->reason() != Qt::ActiveWindowFocusReason && event->reason() != Qt::PopupFocusReason)
    setCursorAt(std::nullopt);
}

void SurfacePlot::paintEvent(QPaintEvent* event) {
  View3D::paintEvent(event);
  if (!cursor_) return;
  if (const auto place = placeOf(*cursor_)) {
    QPainter painter(this);
    paintCursorRing(painter, *place);
  }
}

}  // namespace spindrift::gui
