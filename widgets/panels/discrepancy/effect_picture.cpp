// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/effect_picture.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "widgets/common/words.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr int cells_along = 16;
constexpr int lines_along = 8;  ///< spaces between lines of the grid
constexpr int samples_along = 96;
constexpr double view_name_px = 20;  ///< name of a view
constexpr double axes_px = 24;       ///< at the left and below
constexpr double scale_px = 36;      ///< colours of a legend with their numbers
constexpr double unit_px = 32;       ///< the unit behind them
constexpr double legend_px = 150;    ///< least width of a legend beside them
constexpr double default_travel_mm = 500.0;
constexpr double least_length = 0.3;  ///< of the longest axis, as drawn
constexpr double pole = 50.0;         ///< times the 70th percentile: nothing that can be drawn beside the rest

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

QColor colourOfAxis(int axis) {
  return axis == 0 ? theme().axis_x : axis == 1 ? theme().axis_y : theme().axis_z;
}

void paintArrow(QPainter& painter, const QPointF& from, const QPointF& to, const QColor& colour, bool halo = false) {
  const QPointF way = to - from;
  const double length = std::hypot(way.x(), way.y());
  if (halo && length > 1.0) {  // dark on the light map, and still seen where the arrow leaves it
    painter.setPen(QPen(QColor(255, 255, 255, 200), 4, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(from, to);
  }
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

void EffectPicture::leaveOutPoles() {
  std::vector<double> sizes_of_nodes;
  for (const View& view : views_)
    for (const Sample& s : view.nodes)
      if (s.deviation.allFinite()) sizes_of_nodes.push_back(s.deviation.norm());
  if (sizes_of_nodes.empty()) return;
  const auto at =
      sizes_of_nodes.begin() + static_cast<std::ptrdiff_t>(0.7 * static_cast<double>(sizes_of_nodes.size() - 1));
  std::nth_element(sizes_of_nodes.begin(), at, sizes_of_nodes.end());
  const double limit = pole * *at;
  if (!(limit > 0.0) || largest_ <= limit) return;
  largest_ = largest_out_ = 0.0;
  const auto keep = [&](Sample& s, int out) {
    if (!(s.deviation.norm() <= limit)) {
      s.deviation.setConstant(std::nan(""));
      return;
    }
    largest_ = std::max(largest_, s.deviation.norm());
    largest_out_ = std::max(largest_out_, std::abs(s.deviation[out]));
  };
  for (View& view : views_) {
    for (Sample& s : view.nodes) keep(s, view.out);
    for (Sample& s : view.points) keep(s, view.out);
    for (std::vector<Sample>& line : view.lines)
      for (Sample& s : line) keep(s, view.out);
  }
}

void EffectPicture::make(const Effect& effect, const MachineDescription& machine, std::size_t gain) {
  const ShapeColumn& column = effect.shape[gain];
  unit_ = gainUnitText(column.gain_unit);
  static constexpr const char* names[3] = {"X", "Y", "Z"};
  Eigen::Vector3d middle_mm;
  double longest_mm = 0.0;
  for (int i = 0; i < 3; ++i) {
    const LinearAxis* axis = machine.findAxis(names[i]);
    auto& range = range_mm_[static_cast<std::size_t>(i)];
    range = axis != nullptr ? axis->travel_mm : std::array<double, 2>{0.0, default_travel_mm};
    if (!(range[1] > range[0])) range[1] = range[0] + default_travel_mm;
    middle_mm[i] = 0.5 * (range[0] + range[1]);
    longest_mm = std::max(longest_mm, range[1] - range[0]);
  }
  for (std::size_t i = 0; i < 3; ++i)
    stretch_[i] = std::max(1.0, least_length * longest_mm / (range_mm_[i][1] - range_mm_[i][0]));
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
  leaveOutPoles();
  scale_ = ColourScale::symmetric(largest_out_ > 0.0 ? largest_out_ : largest_, {}, {});
}

/// Where the three views are: in a row, or as a drawing has them (top view above the front view, side view beside it),
/// whichever makes them larger. All have one scale.
struct EffectPicture::Layout {
  double px_per_mm = 0.0;
  double room_px = 0.0;  ///< for the displacement, on every side of a view
  std::array<QRectF, 3> view;
  QRectF legend;
  bool beside = false;  ///< the legend has the corner that a drawing leaves free
};

namespace {

QString legendWords(bool rotations, const QString& gain_unit, double largest) {
  const QString unit = rotations ? QStringLiteral("urad") : QStringLiteral("um");
  return (rotations ? EffectPicture::tr("Rotation of the tool for a gain of 1 %1, as vectors: at most %2.")
                    : EffectPicture::tr("Deviation of the tool for a gain of 1 %1, drawn exaggerated: at most %2."))
      .arg(gain_unit, sizeText(largest, unit).replace(QLatin1Char(' '), QChar(QChar::Nbsp)));
}

double scaleWidth(double width) {
  return std::min(160.0, 0.3 * width);
}

/// Of the words of a legend below the views, beside its scale.
double wordsWidth(double width) {
  return width - scaleWidth(width) - unit_px - 24;
}

}  // namespace

EffectPicture::Layout EffectPicture::layoutFor(const QSize& size) const {
  const double words = QFontMetricsF(textFont(sizes::font_secondary))
                           .boundingRect(QRectF(0, 0, wordsWidth(size.width()), 1000), Qt::TextWordWrap,
                                         legendWords(rotations_, unit_, largest_))
                           .height();
  const double foot_px = std::max(scale_px, words + 4);
  const auto length = [this](int axis) {
    const auto& range = range_mm_[static_cast<std::size_t>(axis)];
    return (range[1] - range[0]) * stretch_[static_cast<std::size_t>(axis)];
  };
  const double x = length(0);
  const double y = length(1);
  const double z = length(2);
  Layout row;
  Layout drawing;
  const double room = std::clamp(0.06 * std::min(size.width(), size.height()), 12.0, 36.0);
  row.room_px = drawing.room_px = room;
  const double more_width = 2 * room + axes_px;
  const double more_height = 2 * room + view_name_px + axes_px;
  row.px_per_mm =
      std::min((size.width() - 3 * more_width) / (2 * x + y), (size.height() - foot_px - more_height) / std::max(y, z));
  drawing.px_per_mm = std::min((size.width() - 2 * more_width) / (x + y), (size.height() - 2 * more_height) / (y + z));
  const double beside_px = size.width() - (x * drawing.px_per_mm + more_width);
  if (drawing.px_per_mm > row.px_per_mm && beside_px > legend_px) {
    const double s = drawing.px_per_mm;
    const double spare_x = std::max(0.0, size.width() - 2 * more_width - (x + y) * s) / 3;
    const double spare_y = std::max(0.0, size.height() - 2 * more_height - (y + z) * s) / 3;
    const double second_x = 2 * spare_x + more_width + x * s;
    const double second_y = 2 * spare_y + more_height + y * s;
    drawing.view = {QRectF(spare_x, spare_y, more_width + x * s, more_height + y * s),
                    QRectF(spare_x, second_y, more_width + x * s, more_height + z * s),
                    QRectF(second_x, second_y, more_width + y * s, more_height + z * s)};
    drawing.legend = QRectF(second_x + 8, spare_y + view_name_px, size.width() - second_x - 16, more_height + y * s);
    drawing.beside = true;
    return drawing;
  }
  const double s = row.px_per_mm;
  const double spare_x = std::max(0.0, size.width() - 3 * more_width - (2 * x + y) * s) / 4;
  const double high = std::max(y, z) * s + more_height;
  const double top = std::max(0.0, size.height() - foot_px - high) / 2;
  double left = spare_x;
  for (std::size_t i = 0; i < 3; ++i) {
    const double across = (i < 2 ? x : y) * s + more_width;
    row.view[i] = QRectF(left, top, across, high);
    left += across + spare_x;
  }
  row.legend = QRectF(0, size.height() - foot_px, size.width(), foot_px);
  return row;
}

void EffectPicture::paintView(QPainter& painter, const View& view, const QRectF& area, const Layout& layout) const {
  const Theme& t = theme();
  const auto& h = range_mm_[static_cast<std::size_t>(view.across)];
  const auto& v = range_mm_[static_cast<std::size_t>(view.up)];
  const double px_per_mm = layout.px_per_mm;
  if (!(px_per_mm > 0.0)) return;
  const QPointF centre = area.center();
  const double px_per_unit = 0.95 * layout.room_px / largest_;
  const auto rest = [&](const Sample& s) {
    const double across = stretch_[static_cast<std::size_t>(view.across)];
    const double up = stretch_[static_cast<std::size_t>(view.up)];
    return QPointF(centre.x() + (s.at_mm[view.across] - 0.5 * (h[0] + h[1])) * across * px_per_mm,
                   centre.y() - (s.at_mm[view.up] - 0.5 * (v[0] + v[1])) * up * px_per_mm);
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
        if (s.deviation.allFinite()) paintArrow(painter, rest(s), moved(s), arrow_colour, true);
      }
    }
  }
  for (const Sample& s : view.points) {
    if (!s.deviation.allFinite()) continue;
    const QPointF from = rest(s);
    paintArrow(painter, from, moved(s), arrow_colour, true);
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
  const ShownUnit unit = shownUnit(rotations_ ? QStringLiteral("urad") : QStringLiteral("um"));
  for (const double value : {scale_.low, 0.0, scale_.high}) {
    const double x = bar.left() + (value - scale_.low) / (scale_.high - scale_.low) * bar.width();
    painter.drawText(QRectF(x - 40, bar.bottom() + 2, 80, 16), Qt::AlignHCenter | Qt::AlignTop,
                     unit.converted() ? decimalText(unit.shown(value), 'g', 3) : tickText(value, step));
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
  const Layout layout = layoutFor(size);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const View& view = views_[i];
    const QRectF& place = layout.view[i];
    const auto coloured = static_cast<Component>(view.out + (rotations_ ? 3 : 0));
    painter.setPen(t.text);
    painter.setFont(textFont(sizes::font_secondary));
    painter.drawText(QRectF(place.left() + 4, place.top(), 160, view_name_px), Qt::AlignLeft | Qt::AlignTop,
                     tr("%1, colour %2").arg(viewName(static_cast<int>(i)), componentName(coloured)));
    paintView(painter, view, place.adjusted(axes_px, view_name_px, 0, -axes_px), layout);
    // The axes at the lower left.
    painter.setRenderHint(QPainter::Antialiasing);
    const QPointF origin(place.left() + 10, place.bottom() - 10);
    paintArrow(painter, origin, origin + QPointF(26, 0), colourOfAxis(view.across));
    paintArrow(painter, origin, origin + QPointF(0, -26), colourOfAxis(view.up));
    painter.setPen(colourOfAxis(view.across));
    painter.drawText(QRectF(origin.x() + 30, origin.y() - 8, 16, 16), Qt::AlignLeft | Qt::AlignVCenter,
                     QStringLiteral("XYZ").at(view.across));
    painter.setPen(colourOfAxis(view.up));
    painter.drawText(QRectF(origin.x() - 8, origin.y() - 44, 16, 16), Qt::AlignCenter,
                     QStringLiteral("XYZ").at(view.up));
  }
  paintLegend(painter, layout.legend, layout.beside);
}

void EffectPicture::paintLegend(QPainter& painter, const QRectF& area, bool beside) const {
  const double bar = beside ? std::min(160.0, area.width() - 2 * unit_px) : scaleWidth(area.width());
  const QRectF text = beside ? QRectF(area.left(), area.top(), area.width(), area.height() - scale_px)
                             : QRectF(4, area.top() + 2, wordsWidth(area.width()), area.height() - 2);
  painter.setPen(theme().text_secondary);
  painter.setFont(textFont(sizes::font_secondary));
  QRectF used;
  painter.drawText(text, Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap,
                   onScreen(legendWords(rotations_, unit_, largest_)), &used);
  const QPointF at =
      beside ? QPointF(area.left() + 12, used.bottom() + 12) : QPointF(area.right() - bar - unit_px, area.top() + 6);
  paintScale(painter, QRectF(at, QSizeF(bar, scale_px - 6)));
  painter.drawText(QRectF(at.x() + bar + 6, at.y() - 4, unit_px, 16), Qt::AlignLeft | Qt::AlignVCenter,
                   shownUnit(rotations_ ? QStringLiteral("urad") : QStringLiteral("um")).name);
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
