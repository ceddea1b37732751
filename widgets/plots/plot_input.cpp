// SPDX-License-Identifier: GPL-3.0-or-later
// What the mouse does in a plot: values picked, edges of spans dragged, what stands under the cursor.
#include <QLineF>
#include <QMouseEvent>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "widgets/plots/plot.h"
#include "widgets/plots/qcustomplot_header.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

double Plot::pixelOfX(double x) {
  drawIfStale();
  return plot_->xAxis->coordToPixel(x);
}

QPointF Plot::pixelOf(double x, double y) {
  drawIfStale();
  return {plot_->xAxis->coordToPixel(x), plot_->yAxis->coordToPixel(y)};
}

std::optional<std::pair<std::size_t, std::size_t>> Plot::valueAt(const QPointF& place) const {
  constexpr double reach_px = 12;
  double nearest = reach_px;
  std::optional<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t k = 0; k < series_.size(); ++k) {
    for (std::size_t i = 0; i < series_[k].x.size(); ++i) {
      const double x = plot_->xAxis->coordToPixel(series_[k].x[i]);
      if (std::abs(x - place.x()) >= nearest) continue;
      const double distance = QLineF(place, {x, plot_->yAxis->coordToPixel(series_[k].y[i])}).length();
      if (!(distance < nearest)) continue;
      nearest = distance;
      found = {k, i};
    }
  }
  return found;
}

QString Plot::textAt(const QPointF& place) const {
  const auto quantity = [](const QString& title) { return title.section(QStringLiteral(" / "), 0, 0); };
  const auto number = [](double v, const QString& title) {
    const ShownUnit unit = unitOfTitle(title);
    const QString text = decimalText(unit.shown(v), 'g', 4);
    return unit.name.isEmpty() ? text : text + QLatin1Char(' ') + unit.name;
  };
  const auto found = valueAt(place);
  if (!found) {
    return quantity(x_title_) + QStringLiteral(" = ") + number(plot_->xAxis->pixelToCoord(place.x()), x_title_) +
           QStringLiteral(",  ") + quantity(y_title_) + QStringLiteral(" = ") +
           number(plot_->yAxis->pixelToCoord(place.y()), y_title_);
  }
  const Series& series = series_[found->first];
  const std::size_t i = found->second;
  const double sigma = i < series.sigma.size() ? series.sigma[i] : 0.0;
  const ShownUnit y_unit = unitOfTitle(y_title_);
  const QString value = sigma > 0.0 ? shownNumbers(QString::fromStdString(withUncertainty(
                                          y_unit.shown(series.y[i]), y_unit.factor * sigma, y_unit.name.toStdString())))
                                    : number(series.y[i], y_title_);
  return (series.name.isEmpty() ? quantity(y_title_) : onScreen(series.name)) + QStringLiteral(", ") +
         quantity(x_title_) + QLatin1Char(' ') + number(series.x[i], x_title_) + QStringLiteral(": ") + value;
}

void Plot::pickValue(QEvent* event) {
  constexpr double still_px = 4;
  const auto* mouse = static_cast<QMouseEvent*>(event);
  if (mouse->button() != Qt::LeftButton) return;
  const QPointF place = mouse->position();
  if (event->type() == QEvent::MouseButtonPress) {
    pressed_at_ = place;
    return;
  }
  if (QLineF(place, pressed_at_).length() > still_px) return;  // dragged
  drawIfStale();
  const auto found = valueAt(place);
  if (!found) return;
  Q_EMIT picked(series_[found->first].x[found->second], static_cast<int>(found->first),
                static_cast<int>(found->second));
}

std::optional<std::pair<std::size_t, bool>> Plot::spanEdgeAt(double pixel_x) const {
  constexpr double reach_px = 8;
  std::optional<std::pair<std::size_t, bool>> best;
  double nearest = reach_px;
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    for (const bool left : {true, false}) {
      const double d = std::abs(plot_->xAxis->coordToPixel(left ? spans_[i].from : spans_[i].to) - pixel_x);
      if (d >= nearest) continue;
      nearest = d;
      best = {i, left};
    }
  }
  return best;
}

bool Plot::dragSpan(QEvent* event) {
  if (!spans_movable_) return false;
  drawIfStale();
  const auto place = [event] { return static_cast<QMouseEvent*>(event)->position().x(); };
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      if (static_cast<QMouseEvent*>(event)->button() != Qt::LeftButton) return false;
      dragged_edge_ = spanEdgeAt(place());
      return dragged_edge_.has_value();
    case QEvent::MouseMove: {
      if (!dragged_edge_) {
        plot_->setCursor(spanEdgeAt(place()) ? Qt::SizeHorCursor : Qt::ArrowCursor);
        return false;
      }
      Span& span = spans_[dragged_edge_->first];
      const double x = plot_->xAxis->pixelToCoord(place());
      (dragged_edge_->second ? span.from : span.to) = x;
      rebuild();
      replotSoon();
      return true;
    }
    case QEvent::MouseButtonRelease: {
      if (!dragged_edge_) return false;
      const std::size_t index = dragged_edge_->first;
      dragged_edge_.reset();
      Span& span = spans_[index];
      if (span.from > span.to) std::swap(span.from, span.to);
      Q_EMIT spanMoved(static_cast<int>(index), span.from, span.to);
      return true;
    }
    default:
      return false;
  }
}

bool Plot::eventFilter(QObject* watched, QEvent* event) {
  if (watched == plot_) {
    if (event->type() == QEvent::Paint) drawIfStale();
    if (dragSpan(event)) return true;
    if (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonRelease) pickValue(event);
    if (event->type() == QEvent::MouseButtonDblClick) {
      showAll();
      return true;
    }
    if (event->type() == QEvent::MouseMove) {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const QString text = textAt(mouse->position());
      if (valueAt(mouse->position()))
        QToolTip::showText(mouse->globalPosition().toPoint(), text, plot_);
      else
        QToolTip::hideText();
      Q_EMIT hovered(text);
    }
    if (event->type() == QEvent::Leave) Q_EMIT hovered({});
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace spindrift::gui
