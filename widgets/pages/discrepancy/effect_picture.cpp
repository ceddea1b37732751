// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/discrepancy/effect_picture.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/reporting/report_wording.h"
#include "widgets/pages/discrepancy/effect_titles.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr int cells_along = 16;
constexpr int lines_along = 8;  ///< spaces between lines of the grid
constexpr int samples_along = 96;
constexpr double room_for_displacement = 0.16;  ///< of a view, on every side
constexpr double default_travel_mm = 500.0;

/// Which axes a view has: across, up, out of it towards who looks.
struct Plane {
  int across, up, out;
};
constexpr std::array<Plane, 3> planes{{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};

QString viewName(int number) {
  switch (number) {
    case 0:
      return EffectPicture::tr("Top");
    case 1:
      return EffectPicture::tr("Front");
    default:
      return EffectPicture::tr("Side");
  }
}

QColor axisColour(int axis) {
  return axis == 0 ? theme().axis_x : axis == 1 ? theme().axis_y : theme().axis_z;
}

/// "um_per_m" -> "µm/m".
QString gainUnit(const std::string& unit) {
  QString text = QString::fromStdString(unit);
  text.replace(QStringLiteral("_per_"), QStringLiteral("/"));
  return QString::fromStdString(printedUnits(text.toStdString()));
}

void paintArrow(QPainter& painter, const QPointF& from, const QPointF& to, const QColor& colour) {
  const QPointF way = to - from;
  const double length = std::hypot(way.x(), way.y());
  painter.setPen(QPen(colour, 1.4));
  painter.drawLine(from, to);
  if (length < 4.0) return;
  const QPointF along = way / length;
  const QPointF across(-along.y(), along.x());
  const double head = std::min(6.0, 0.5 * length);
  QPainterPath tip(to);
  tip.lineTo(to - along * head + across * 0.5 * head);
  tip.lineTo(to - along * head - across * 0.5 * head);
  tip.closeSubpath();
  painter.fillPath(tip, colour);
}

}  // namespace

EffectPicture::EffectPicture(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAccessibleName(tr("Shape of the effect on the machine"));
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] { update(); });
}

void EffectPicture::clear(const QString& why) {
  views_.clear();
  largest_ = 0.0;
  why_ = why;
  setAccessibleDescription(why);
  update();
}

void EffectPicture::show(const Effect& effect, const MachineDescription& machine, std::size_t gain) {
  views_.clear();
  largest_ = largest_out_ = 0.0;
  if (effect.shape.empty()) {
    clear(tr("This effect has no shape of its own."));
    return;
  }
  make(effect, machine, gain < effect.shape.size() ? gain : 0);
  if (!(largest_ > 0.0)) {
    clear(tr("The shape is zero, or has no value, everywhere in the working volume."));
    return;
  }
  setAccessibleDescription(
      tr("Largest deviation for a gain of 1 %1: %2")
          .arg(unit_, sizeText(largest_, rotations_ ? QStringLiteral("urad") : QStringLiteral("um"))));
  update();
}

void EffectPicture::make(const Effect& effect, const MachineDescription& machine, std::size_t gain) {
  const ShapeColumn& column = effect.shape[gain];
  unit_ = gainUnit(column.gain_unit);
  static constexpr const char* names[3] = {"X", "Y", "Z"};
  Eigen::Vector3d middle_mm;
  for (int i = 0; i < 3; ++i) {
    const LinearAxis* axis = machine.findAxis(names[i]);
    auto& range = range_mm_[static_cast<std::size_t>(i)];
    range = axis != nullptr ? axis->travel_mm : std::array<double, 2>{0.0, default_travel_mm};
    if (!(range[1] > range[0])) range[1] = range[0] + default_travel_mm;
    middle_mm[i] = 0.5 * (range[0] + range[1]);
  }
  const auto sampleAt = [&](const Eigen::Vector3d& at_mm, const std::string& point) {
    DeviationQuery query;
    query.position_mm = at_mm;
    query.point = point;
    query.approach = Eigen::Vector3d::Ones();
    Sample sample{at_mm, {}};
    for (int i = 0; i < 3; ++i)
      sample.deviation[i] = column.value(query, static_cast<Component>(i + (rotations_ ? 3 : 0)));
    return sample;
  };
  const auto fill = [&] {
    views_.clear();
    largest_ = largest_out_ = 0.0;
    double grid_largest = 0.0;
    const auto keep = [&](const Sample& s, int out, bool of_grid) {
      if (!s.deviation.allFinite()) return;
      largest_ = std::max(largest_, s.deviation.norm());
      largest_out_ = std::max(largest_out_, std::abs(s.deviation[out]));
      if (of_grid) grid_largest = std::max(grid_largest, s.deviation.norm());
    };
    for (const Plane& plane : planes) {
      View view;
      view.across = plane.across;
      view.up = plane.up;
      view.out = plane.out;
      view.cells = cells_along;
      const auto& h = range_mm_[static_cast<std::size_t>(plane.across)];
      const auto& v = range_mm_[static_cast<std::size_t>(plane.up)];
      const auto at = [&](double a, double b) {
        Eigen::Vector3d p = middle_mm;
        p[plane.across] = h[0] + a * (h[1] - h[0]);
        p[plane.up] = v[0] + b * (v[1] - v[0]);
        return sampleAt(p, {});
      };
      for (int row = 0; row <= cells_along; ++row) {
        for (int i = 0; i <= cells_along; ++i) {
          view.nodes.push_back(at(double(i) / cells_along, double(row) / cells_along));
          keep(view.nodes.back(), plane.out, true);
        }
      }
      for (const bool across : {true, false}) {
        for (int line = 0; line <= lines_along; ++line) {
          std::vector<Sample> samples;
          for (int i = 0; i <= samples_along; ++i) {
            const double along = double(i) / samples_along;
            const double beside = double(line) / lines_along;
            samples.push_back(across ? at(along, beside) : at(beside, along));
            keep(samples.back(), plane.out, true);
          }
          view.lines.push_back(std::move(samples));
        }
      }
      for (const MachinePoint& p : machine.points) {
        view.points.push_back(sampleAt(p.position_mm, p.id));
        keep(view.points.back(), plane.out, false);
      }
      views_.push_back(std::move(view));
    }
    one_point_ = largest_ > 0.0 && !(grid_largest > 0.0);
  };
  rotations_ = false;
  fill();
  if (!(largest_ > 0.0)) {
    rotations_ = true;
    fill();
  }
  scale_ = ColourScale::symmetric(largest_out_ > 0.0 ? largest_out_ : largest_, {}, {});
}

void EffectPicture::paintView(QPainter& painter, const View& view, const QRectF& area) const {
  const Theme& t = theme();
  const auto& h = range_mm_[static_cast<std::size_t>(view.across)];
  const auto& v = range_mm_[static_cast<std::size_t>(view.up)];
  const double room = room_for_displacement * std::min(area.width(), area.height());
  const double px_per_mm =
      std::min((area.width() - 2 * room) / (h[1] - h[0]), (area.height() - 2 * room) / (v[1] - v[0]));
  if (!(px_per_mm > 0.0)) return;
  const QPointF centre = area.center();
  const double px_per_unit = 0.9 * room / largest_;
  const auto rest = [&](const Sample& s) {
    return QPointF(centre.x() + (s.at_mm[view.across] - 0.5 * (h[0] + h[1])) * px_per_mm,
                   centre.y() - (s.at_mm[view.up] - 0.5 * (v[0] + v[1])) * px_per_mm);
  };
  const auto moved = [&](const Sample& s) {
    return rest(s) + QPointF(s.deviation[view.across], -s.deviation[view.up]) * px_per_unit;
  };
  const auto placed = [&](const Sample& s) { return rotations_ ? rest(s) : moved(s); };
  // The plane, coloured by what is out of it.
  painter.setRenderHint(QPainter::Antialiasing, false);
  const auto row_length = static_cast<std::size_t>(view.cells) + 1;
  for (std::size_t row = 0; row + 1 < row_length; ++row) {
    for (std::size_t i = 0; i + 1 < row_length; ++i) {
      const std::array<const Sample*, 4> corners{
          &view.nodes[row * row_length + i], &view.nodes[row * row_length + i + 1],
          &view.nodes[(row + 1) * row_length + i + 1], &view.nodes[(row + 1) * row_length + i]};
      double out = 0.0;
      QPolygonF cell;
      for (const Sample* s : corners) {
        out += 0.25 * s->deviation[view.out];
        cell << placed(*s);
      }
      if (!std::isfinite(out) ||
          std::any_of(corners.begin(), corners.end(), [](const Sample* s) { return !s->deviation.allFinite(); }))
        continue;
      const QColor colour = scale_.colour(out);
      painter.setPen(QPen(colour, 1));
      painter.setBrush(colour);
      painter.drawPolygon(cell);
    }
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  // Where the plane is without the effect.
  Sample low;
  Sample high;
  low.at_mm[view.across] = h[0];
  low.at_mm[view.up] = v[0];
  high.at_mm[view.across] = h[1];
  high.at_mm[view.up] = v[1];
  painter.setPen(QPen(t.text_secondary, 1, Qt::DashLine));
  painter.drawRect(QRectF(rest(low), rest(high)).normalized());
  QColor line_colour(0x20, 0x28, 0x30);  // on the light map, in both themes
  line_colour.setAlpha(150);
  painter.setPen(QPen(line_colour, 1));
  for (const std::vector<Sample>& line : view.lines) {
    QPolygonF path;
    for (const Sample& s : line) {
      if (s.deviation.allFinite()) path << placed(s);
    }
    painter.drawPolyline(path);
  }
  const QColor arrow_colour(0x14, 0x1a, 0x20);
  if (rotations_) {
    for (std::size_t row = 0; row < row_length; row += 4) {
      for (std::size_t i = 0; i < row_length; i += 4) {
        const Sample& s = view.nodes[row * row_length + i];
        if (s.deviation.allFinite()) paintArrow(painter, rest(s), moved(s), arrow_colour);
      }
    }
  }
  for (const Sample& s : view.points) {
    if (!s.deviation.allFinite()) continue;
    const QPointF from = rest(s);
    paintArrow(painter, from, moved(s), arrow_colour);
    painter.setPen(QPen(arrow_colour, 1));
    painter.setBrush(one_point_ ? scale_.colour(s.deviation[view.out]) : QColor(Qt::white));
    const double radius = one_point_ ? 4.0 : 2.5;
    painter.drawEllipse(from, radius, radius);
    painter.setBrush(Qt::NoBrush);
  }
}

void EffectPicture::paintScale(QPainter& painter, const QRectF& area) const {
  const Theme& t = theme();
  painter.setRenderHint(QPainter::Antialiasing, false);
  constexpr double bar_height = 10;
  const QRectF bar(area.left(), area.top(), area.width(), bar_height);
  for (int x = 0; x < static_cast<int>(bar.width()); ++x) {
    const double value = scale_.low + (scale_.high - scale_.low) * x / bar.width();
    painter.fillRect(QRectF(bar.left() + x, bar.top(), 1.5, bar.height()), scale_.colour(value));
  }
  painter.setPen(t.text_secondary);
  painter.setFont(textFont(sizes::font_secondary));
  const double step = scale_.high;
  for (const double value : {scale_.low, 0.0, scale_.high}) {
    const double x = bar.left() + (value - scale_.low) / (scale_.high - scale_.low) * bar.width();
    painter.drawText(QRectF(x - 40, bar.bottom() + 2, 80, 16), Qt::AlignHCenter | Qt::AlignTop, tickText(value, step));
  }
}

void EffectPicture::paint(QPainter& painter, const QSize& size) const {
  const Theme& t = theme();
  painter.setFont(textFont(sizes::font_secondary));
  if (views_.empty()) {
    painter.setPen(t.text_secondary);
    painter.setFont(textFont(sizes::font_body));
    painter.drawText(QRect(QPoint(0, 0), size).adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap, why_);
    return;
  }
  constexpr int foot = 36;
  constexpr int head = 20;
  const QString unit = rotations_ ? QStringLiteral("urad") : QStringLiteral("um");
  const double width = size.width() / 3.0;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const View& view = views_[i];
    const QRectF place(width * static_cast<double>(i), 0, width, size.height() - foot);
    painter.setPen(t.text);
    const auto coloured = static_cast<Component>(view.out + (rotations_ ? 3 : 0));
    painter.drawText(place.adjusted(4, 0, -4, 0), Qt::AlignLeft | Qt::AlignTop,
                     tr("%1, colour %2").arg(viewName(static_cast<int>(i)), componentName(coloured)));
    constexpr double axis_px = 22;
    const QRectF picture = place.adjusted(axis_px, head, -4, -axis_px);
    paintView(painter, view, picture);
    // The axes at the lower left.
    painter.setRenderHint(QPainter::Antialiasing);
    const QPointF origin(place.left() + 10, place.bottom() - 10);
    paintArrow(painter, origin, origin + QPointF(26, 0), axisColour(view.across));
    paintArrow(painter, origin, origin + QPointF(0, -26), axisColour(view.up));
    painter.setPen(axisColour(view.across));
    painter.drawText(QRectF(origin.x() + 30, origin.y() - 8, 16, 16), Qt::AlignLeft | Qt::AlignVCenter,
                     QStringLiteral("XYZ").at(view.across));
    painter.setPen(axisColour(view.up));
    painter.drawText(QRectF(origin.x() - 8, origin.y() - 44, 16, 16), Qt::AlignCenter,
                     QStringLiteral("XYZ").at(view.up));
  }
  const double bar = std::min(160.0, 0.3 * size.width());
  paintScale(painter, QRectF(size.width() - bar - 28, size.height() - foot + 6, bar, foot - 6));
  painter.setPen(t.text_secondary);
  painter.setFont(textFont(sizes::font_secondary));
  const QString words = rotations_ ? tr("Rotation of the tool for a gain of 1 %1, as vectors: at most %2.")
                                   : tr("Deviation of the tool for a gain of 1 %1, drawn exaggerated: at most %2.");
  painter.drawText(QRectF(4, size.height() - foot + 2, size.width() - bar - 72, foot - 2),
                   Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap, words.arg(unit_, sizeText(largest_, unit)));
  painter.drawText(QRectF(size.width() - 24 - 4, size.height() - foot + 2, 28, 16), Qt::AlignRight | Qt::AlignTop,
                   QString::fromStdString(printedUnits(unit.toStdString())));
}

void EffectPicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paint(painter, size());
}

void EffectPicture::exportTo(const QString& file) const {
  const QSize size(960, 400);
  QImage picture(size * 2, QImage::Format_RGB32);
  picture.setDevicePixelRatio(2);
  picture.fill(theme().surface);
  {
    QPainter painter(&picture);
    paint(painter, size);
  }
  if (!picture.save(file)) throw InputError({file.toStdString(), ""}, "the picture could not be written.");
}

}  // namespace spindrift::gui
