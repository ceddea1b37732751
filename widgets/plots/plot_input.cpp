// SPDX-License-Identifier: GPL-3.0-or-later
// What mouse and keyboard do in a plot: values picked, edges of spans dragged, what stands under the cursor.
#include <QFocusEvent>
#include <QKeyEvent>
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

namespace {

QString quantityOf(const QString& title) {
  return title.section(QStringLiteral(" / "), 0, 0);
}

QString numberText(double v, const QString& title) {
  const ShownUnit unit = unitOfTitle(title);
  const QString text = decimalText(unit.shown(v), 'g', 4);
  return unit.name.isEmpty() ? text : text + QLatin1Char(' ') + unit.name;
}

}  // namespace

QString Plot::textAt(const QPointF& place) const {
  if (const auto found = valueAt(place)) return textOf(found->first, found->second);
  return quantityOf(x_title_) + QStringLiteral(" = ") + numberText(plot_->xAxis->pixelToCoord(place.x()), x_title_) +
         QStringLiteral(",  ") + quantityOf(y_title_) + QStringLiteral(" = ") +
         numberText(plot_->yAxis->pixelToCoord(place.y()), y_title_);
}

QString Plot::textOf(std::size_t series_index, std::size_t i) const {
  const Series& series = series_[series_index];
  const double sigma = i < series.sigma.size() ? series.sigma[i] : 0.0;
  const ShownUnit y_unit = unitOfTitle(y_title_);
  const QString value = sigma > 0.0 ? shownNumbers(QString::fromStdString(withUncertainty(
                                          y_unit.shown(series.y[i]), y_unit.factor * sigma, y_unit.name.toStdString())))
                                    : numberText(series.y[i], y_title_);
  return (series.name.isEmpty() ? quantityOf(y_title_) : onScreen(series.name)) + QStringLiteral(", ") +
         quantityOf(x_title_) + QLatin1Char(' ') + numberText(series.x[i], x_title_) + QStringLiteral(": ") + value;
}

std::vector<std::size_t> Plot::valuesOf(std::size_t series) const {
  const Series& s = series_[series];
  std::vector<std::size_t> values;
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (std::isfinite(s.x[i]) && std::isfinite(s.y[i])) values.push_back(i);
  std::stable_sort(values.begin(), values.end(), [&s](std::size_t a, std::size_t b) { return s.x[a] < s.x[b]; });
  return values;
}

void Plot::setCursorAt(const std::optional<std::pair<std::size_t, std::size_t>>& value) {
  if (!cursor_) described_ = accessibleDescription();
  cursor_ = value;
  placeCursor();
  replotSoon();
  if (!cursor_) {
    QToolTip::hideText();
    setAccessibleDescription(described_);
    Q_EMIT hovered({});
    return;
  }
  const double x = series_[cursor_->first].x[cursor_->second], y = series_[cursor_->first].y[cursor_->second];
  for (const auto& [axis, at] : {std::pair{plot_->xAxis, x}, std::pair{plot_->yAxis, y}})
    if (!axis->range().contains(at)) axis->setRange(at, axis->range().size(), Qt::AlignCenter);
  const QString text = textOf(cursor_->first, cursor_->second);
  setAccessibleDescription(text);
  QToolTip::showText(mapToGlobal(pixelOf(x, y).toPoint()), text, this);
  Q_EMIT hovered(text);
}

void Plot::placeCursor() {
  if (!cursor_) {
    if (cursor_ring_ != nullptr) plot_->removeItem(cursor_ring_);
    cursor_ring_ = nullptr;
    return;
  }
  if (cursor_ring_ == nullptr) {
    constexpr double diameter_px = 13;
    cursor_ring_ = new QCPItemTracer(plot_);
    cursor_ring_->setStyle(QCPItemTracer::tsCircle);
    cursor_ring_->setSize(diameter_px);
    cursor_ring_->setPen(QPen(theme().tone(Tone::Accent), 2));
    cursor_ring_->setBrush(Qt::NoBrush);
  }
  cursor_ring_->position->setCoords(series_[cursor_->first].x[cursor_->second],
                                    series_[cursor_->first].y[cursor_->second]);
}

/// At the first value in view.
void Plot::beginCursor() {
  drawIfStale();
  for (std::size_t k = 0; k < series_.size(); ++k) {
    const std::vector<std::size_t> values = valuesOf(k);
    if (values.empty()) continue;
    const auto seen = std::find_if(values.begin(), values.end(), [&](std::size_t i) {
      return plot_->xAxis->range().contains(series_[k].x[i]) && plot_->yAxis->range().contains(series_[k].y[i]);
    });
    return setCursorAt(std::pair{k, seen == values.end() ? values.front() : *seen});
  }
}

void Plot::moveAlong(int key) {
  const std::vector<std::size_t> values = valuesOf(cursor_->first);
  const auto here = std::find(values.begin(), values.end(), cursor_->second);
  auto to = here;
  if (key == Qt::Key_Left && here != values.begin()) --to;
  if (key == Qt::Key_Right && here + 1 != values.end()) ++to;
  if (key == Qt::Key_Home) to = values.begin();
  if (key == Qt::Key_End) to = values.end() - 1;
  setCursorAt(std::pair{cursor_->first, *to});
}

/// To the value of another series nearest in x.
void Plot::moveToSeries(int by) {
  const double x = series_[cursor_->first].x[cursor_->second];
  const auto count = static_cast<int>(series_.size());
  for (int k = static_cast<int>(cursor_->first) + by; k >= 0 && k < count; k += by) {
    const Series& s = series_[static_cast<std::size_t>(k)];
    const std::vector<std::size_t> values = valuesOf(static_cast<std::size_t>(k));
    if (values.empty()) continue;
    const auto nearest = std::min_element(values.begin(), values.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(s.x[a] - x) < std::abs(s.x[b] - x);
    });
    return setCursorAt(std::pair{static_cast<std::size_t>(k), *nearest});
  }
  setCursorAt(cursor_);
}

/// False: the key is not one of the plot's.
bool Plot::onKey(const QKeyEvent& event) {
  constexpr double pan = 0.1;   // of what is shown
  constexpr double zoom = 0.8;  // what is shown then of what was
  if (series_.empty() || (event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier))) return false;
  const bool shift = (event.modifiers() & Qt::ShiftModifier) != 0;
  const auto move = [this](QCPAxis* axis, double part) {
    axis->moveRange(part * axis->range().size());
    replotSoon();
  };
  const auto scale = [this](double factor) {
    for (QCPAxis* axis : {plot_->xAxis, plot_->yAxis}) {
      const auto at = [&] {
        const std::vector<double>& values =
            axis == plot_->xAxis ? series_[cursor_->first].x : series_[cursor_->first].y;
        return values[cursor_->second];
      };
      axis->scaleRange(factor, cursor_ ? at() : axis->range().center());
    }
    replotSoon();
  };
  const int key = event.key();
  switch (key) {
    case Qt::Key_Left:
    case Qt::Key_Right:
      if (shift) {
        move(plot_->xAxis, key == Qt::Key_Left ? -pan : pan);
        return true;
      }
      [[fallthrough]];
    case Qt::Key_Home:
    case Qt::Key_End:
      if (!cursor_)
        beginCursor();
      else
        moveAlong(key);
      return true;
    case Qt::Key_Up:
    case Qt::Key_Down:
      if (shift)
        move(plot_->yAxis, key == Qt::Key_Down ? -pan : pan);
      else if (!cursor_)
        beginCursor();
      else
        moveToSeries(key == Qt::Key_Up ? -1 : 1);
      return true;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      scale(zoom);
      return true;
    case Qt::Key_Minus:
      scale(1.0 / zoom);
      return true;
    case Qt::Key_0:
      showAll();
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (!cursor_) return false;
      Q_EMIT picked(series_[cursor_->first].x[cursor_->second], static_cast<int>(cursor_->first),
                    static_cast<int>(cursor_->second));
      return true;
    case Qt::Key_Escape:
      if (!cursor_) return false;
      setCursorAt(std::nullopt);
      return true;
    default:
      return false;
  }
}

void Plot::keyPressEvent(QKeyEvent* event) {
  if (!onKey(*event)) QWidget::keyPressEvent(event);
}

void Plot::focusInEvent(QFocusEvent* event) {
  QWidget::focusInEvent(event);
  // Whoever comes by keyboard sees where the keys work.
  if (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason) beginCursor();
}

void Plot::focusOutEvent(QFocusEvent* event) {
  QWidget::focusOutEvent(event);
  if (cursor_ && event->reason() != Qt::ActiveWindowFocusReason && event->reason() != Qt::PopupFocusReason)
    setCursorAt(std::nullopt);
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
