// SPDX-License-Identifier: GPL-3.0-or-later
// Marks of points and the placing of their labels.
#include "widgets/view3d/point_labels.h"

#include <QFontMetricsF>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "widgets/theme/fonts.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr double mark_radius_px = 6;
constexpr double near_px = 12;  ///< from the mark to its label
constexpr double far_px = 30;   ///< the same for a label with a leader line

struct Mark {
  QPointF at;
  const ViewPoint* point = nullptr;
};

bool sameId(const QString& id, const QString& wanted) {
  return !wanted.isEmpty() && id == wanted;
}

/// The order in which labels look for a place.
std::vector<std::size_t> byImportance(const std::vector<Mark>& marks, const PointEmphasis& emphasis) {
  std::vector<std::size_t> order(marks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](const ViewPoint& p) {
    if (sameId(p.id, emphasis.selected)) return 0;
    if (sameId(p.id, emphasis.hovered)) return 1;
    return p.used ? 2 : 3;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const ViewPoint& p = *marks[a].point;
    const ViewPoint& q = *marks[b].point;
    if (rank(p) != rank(q)) return rank(p) < rank(q);
    return std::abs(p.value.value_or(0.0)) > std::abs(q.value.value_or(0.0));
  });
  return order;
}

QPointF nearestIn(const QRectF& box, const QPointF& to) {
  return {std::clamp(to.x(), box.left(), box.right()), std::clamp(to.y(), box.top(), box.bottom())};
}

double length(const QPointF& d) {
  return std::hypot(d.x(), d.y());
}

/// From a point to the line between two others.
double distanceToLine(const QPointF& point, const QPointF& from, const QPointF& to) {
  const QPointF d = to - from;
  const double square = QPointF::dotProduct(d, d);
  const double part = square > 0.0 ? std::clamp(QPointF::dotProduct(point - from, d) / square, 0.0, 1.0) : 0.0;
  return length(point - from - part * d);
}

class LabelPlaces {
 public:
  LabelPlaces(const QSizeF& size, const std::vector<Mark>& marks, std::vector<QRectF> taken)
      : size_(size), marks_(&marks), taken_(std::move(taken)) {
    for (const Mark& mark : marks) taken_.emplace_back(mark.at.x() - 7, mark.at.y() - 7, 14, 14);
  }

  /// The first of a few places around the mark that is free and inside the picture, near ones first. `clear`: and of no
  /// other mark.
  [[nodiscard]] std::optional<PlacedLabel> find(const Mark& mark, const QSizeF& box, bool clear) const {
    for (const double distance : {near_px, far_px}) {
      const double w = box.width();
      const double h = box.height();
      const double up = -h - (distance == near_px ? 4 : distance - 8);
      const double down = distance == near_px ? 4 : distance - 8;
      const std::array<QPointF, 8> places{QPointF(distance, up),      QPointF(distance, down),
                                          QPointF(-distance - w, up), QPointF(-distance - w, down),
                                          QPointF(-w / 2, distance),  QPointF(-w / 2, -h - distance),
                                          QPointF(distance, -h / 2),  QPointF(-distance - w, -h / 2)};
      for (const QPointF& place : places) {
        const QRectF candidate(mark.at + place, box);
        if (free(candidate) && (!clear || belongsTo(mark, candidate)))
          return PlacedLabel{mark.point, mark.at, candidate, true, distance > near_px};
      }
    }
    return std::nullopt;
  }
  /// Beside the mark, moved into the picture, whatever it covers.
  [[nodiscard]] PlacedLabel force(const Mark& mark, const QSizeF& box) const {
    QRectF place(mark.at + QPointF(near_px, -box.height() - 4), box);
    place.moveLeft(std::clamp(place.left(), 2.0, std::max(2.0, size_.width() - 2 - box.width())));
    place.moveTop(std::clamp(place.top(), 2.0, std::max(2.0, size_.height() - 2 - box.height())));
    return {mark.point, mark.at, place, true, false};
  }
  void take(const QRectF& box) { taken_.push_back(box); }

 private:
  [[nodiscard]] bool free(const QRectF& box) const {
    const QRectF picture(2, 2, size_.width() - 4, size_.height() - 4);
    return picture.contains(box) &&
           std::none_of(taken_.begin(), taken_.end(), [&](const QRectF& r) { return r.intersects(box); });
  }
  /// No other mark is nearer to it, none lies on the way to it.
  [[nodiscard]] bool belongsTo(const Mark& own, const QRectF& box) const {
    constexpr double same_place_px = 2.0;
    const QPointF end = nearestIn(box, own.at);
    return std::all_of(marks_->begin(), marks_->end(), [&](const Mark& other) {
      if (length(other.at - own.at) < same_place_px) return true;
      return length(nearestIn(box, other.at) - other.at) >= length(end - own.at) - same_place_px &&
             distanceToLine(other.at, own.at, end) > mark_radius_px;
    });
  }
  QSizeF size_;
  const std::vector<Mark>* marks_;
  std::vector<QRectF> taken_;
};

void paintMark(QPainter& painter, const Mark& mark, const std::optional<ColourScale>& scale, bool selected) {
  const Theme& t = theme();
  const ViewPoint& point = *mark.point;
  const QColor fill = point.value && scale ? scale->colour(*point.value) : t.tone(point.tone);
  if (point.mark) {
    painter.setPen(QPen(t.view_top, 4));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(mark.at, mark_radius_px, mark_radius_px);
  }
  if (selected) {
    painter.setPen(QPen(t.accent, 3));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(mark.at, 11, 11);
  }
  if (!point.mark) return;
  painter.setPen(QPen(t.text, 1.6, point.used ? Qt::SolidLine : Qt::DotLine));
  painter.setBrush(point.used ? QBrush(fill) : QBrush(mixed(fill, t.view_top, 0.55)));
  painter.drawEllipse(mark.at, mark_radius_px, mark_radius_px);
  if (!point.used) {
    painter.setPen(QPen(t.text, 1.6));
    painter.drawPoint(mark.at);
  }
}

struct LabelFonts {
  QFont name = textFont(sizes::font_secondary, QFont::DemiBold);
  QFont value = textFont(sizes::font_secondary);
  QFontMetricsF name_metrics{name};
  QFontMetricsF value_metrics{value};

  [[nodiscard]] QSizeF size(const ViewPoint& point, bool with_value) const {
    double width = 12;
    if (!point.label.isEmpty()) width += name_metrics.horizontalAdvance(point.label);
    if (with_value && !point.value_text.isEmpty()) width += value_metrics.horizontalAdvance(point.value_text) + 6;
    return {width, name_metrics.height() + 4};
  }
};

void paintLabel(QPainter& painter, const PlacedLabel& label, const LabelFonts& fonts, bool selected) {
  const Theme& t = theme();
  const ViewPoint& point = *label.point;
  if (label.leader) {
    const QPointF& at = label.mark;
    const QPointF end = nearestIn(label.box, at);
    const QPointF d = end - at;
    painter.setPen(QPen(t.text_secondary, 1));
    if (length(d) > mark_radius_px) painter.drawLine(at + d * (mark_radius_px / length(d)), end);
  }
  QColor back = t.surface;
  back.setAlphaF(0.9F);
  painter.setPen(QPen(selected ? t.accent : t.border, 1));
  painter.setBrush(back);
  painter.drawRoundedRect(label.box, 4, 4);
  painter.setPen(t.text);
  painter.setFont(fonts.name);
  const double baseline = label.box.top() + 2 + fonts.name_metrics.ascent();
  painter.drawText(QPointF(label.box.left() + 6, baseline), point.label);
  if (!label.with_value || point.value_text.isEmpty()) return;
  painter.setFont(fonts.value);
  painter.drawText(QPointF(label.box.left() + 12 + fonts.name_metrics.horizontalAdvance(point.label), baseline),
                   point.value_text);
}

std::vector<Mark> marksOf(const Camera& camera, const QSizeF& size, const std::vector<ViewPoint>& points) {
  std::vector<Mark> marks;
  for (const ViewPoint& point : points) {
    if (const auto at = camera.project(point.position_mm, size)) marks.push_back({*at, &point});
  }
  return marks;
}

}  // namespace

std::vector<PlacedLabel> placeLabels(const Camera& camera, const QSizeF& size, const std::vector<ViewPoint>& points,
                                     const PointEmphasis& emphasis) {
  const std::vector<Mark> marks = marksOf(camera, size, points);
  const LabelFonts fonts;
  LabelPlaces places(size, marks, emphasis.keep_out);
  std::vector<PlacedLabel> labels;
  for (const std::size_t i : byImportance(marks, emphasis)) {
    const ViewPoint& point = *marks[i].point;
    if (point.label.isEmpty() && point.value_text.isEmpty()) continue;
    auto label = places.find(marks[i], fonts.size(point, true), true);
    const bool emphasised = sameId(point.id, emphasis.selected) || sameId(point.id, emphasis.hovered);
    if (!label && emphasised) label = places.force(marks[i], fonts.size(point, true));
    // A value that may be read as that of another point is left out, at last also that the name cannot be.
    for (const bool clear : {true, false}) {
      if (label || point.value_text.isEmpty() || point.label.isEmpty()) break;
      label = places.find(marks[i], fonts.size(point, false), clear);
      if (label) label->with_value = false;
    }
    if (!label) continue;
    places.take(label->box);
    labels.push_back(*label);
  }
  return labels;
}

void paintPoints(QPainter& painter, const Camera& camera, const QSizeF& size, const std::vector<ViewPoint>& points,
                 const std::optional<ColourScale>& scale, const PointEmphasis& emphasis) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const Mark& mark : marksOf(camera, size, points))
    paintMark(painter, mark, scale, sameId(mark.point->id, emphasis.selected));
  const std::vector<PlacedLabel> labels = placeLabels(camera, size, points, emphasis);
  const LabelFonts fonts;
  for (auto label = labels.rbegin(); label != labels.rend(); ++label)
    paintLabel(painter, *label, fonts, sameId(label->point->id, emphasis.selected));
  painter.restore();
}

}  // namespace spindrift::gui
