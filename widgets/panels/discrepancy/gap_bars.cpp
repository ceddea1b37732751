// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/gap_bars.h"

#include <QSvgGenerator>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr int bar_height = 16;
constexpr int bar_step = 24;
constexpr int title_height = 24;
constexpr int group_gap = 8;
constexpr int name_width = 56;
constexpr int value_width = 72;
constexpr int foot_height = 24;
constexpr int more_height = 17;

QString signedText(double value, int digits) {
  return decimalText(value, 'f', digits);
}

/// "peak-to-peak 12.4 → 2.6 um" and "variation explained 61 → 92 %"; empty where nothing is known.
QStringList figuresText(const GapFigures& figures) {
  const auto change = [](double before, double after, int digits) {
    const QString first = signedText(before, digits);
    return std::isfinite(after) ? GapBars::tr("%1 → %2").arg(first, signedText(after, digits)) : first;
  };
  QStringList parts;
  if (std::isfinite(figures.p2p_before)) {
    parts << GapBars::tr("peak-to-peak %1 %2")
                 .arg(change(figures.p2p_before, figures.p2p_after, 1),
                      componentUnit(figures.rotations ? Component::EA : Component::EX));
  }
  if (std::isfinite(figures.fit_before_percent)) {
    parts << GapBars::tr("variation explained %1 %")
                 .arg(change(figures.fit_before_percent, figures.fit_after_percent, 0));
  }
  return parts;
}

}  // namespace

GapBars::GapBars(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  setAccessibleName(tr("rms before, after and noise floor"));
  setToolTip(
      tr("rms: of the residuals of all observations. Peak-to-peak: the largest of the residual of one series. "
         "Variation explained: 100 % is perfect, 0 % no better than a constant for each series."));
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] { update(); });
}

void GapBars::set(const DiscrepancyGap& gap, bool holdout, const GapFigures& fitted, const GapFigures& held_out) {
  groups_.clear();
  const auto add = [this](const QString& title, double before, double after, const QStringList& more) {
    Group group{title, {}, more};
    if (std::isfinite(before)) group.bars.push_back({tr("before"), before, 0});
    if (std::isfinite(after)) group.bars.push_back({tr("after"), after, 1});
    if (!group.bars.empty()) groups_.push_back(std::move(group));
  };
  add(tr("Fitted observations, rms"), gap.rms_before_um, gap.rms_after_um, figuresText(fitted));
  const bool known = gap.heldout_rms_before_um > 0.0;
  add(holdout ? tr("Held-out observations, rms") : tr("Blocks left out in turn, rms"),
      known ? gap.heldout_rms_before_um : std::nan(""), known ? gap.heldout_rms_after_um : std::nan(""),
      holdout ? figuresText(held_out) : QStringList());
  noise_ = gap.noise_um;
  QStringList words;
  for (const Group& group : groups_)
    words << group.title + QStringLiteral(": ") + group.more.join(QStringLiteral(", "));
  setAccessibleDescription(words.join(QStringLiteral("; ")));
  updateGeometry();
  update();
}

void GapBars::clear() {
  groups_.clear();
  updateGeometry();
  update();
}

QSize GapBars::sizeHint() const {
  int height = foot_height;
  for (const Group& group : groups_) {
    height += title_height + bar_step * static_cast<int>(group.bars.size()) + group_gap;
    height += more_height * static_cast<int>(group.more.size());
  }
  return {240, groups_.empty() ? 24 : height};
}

void GapBars::draw(QPainter& painter, const QRect& area) const {
  const Theme& t = theme();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(textFont(sizes::font_secondary));
  double largest = noise_;
  for (const Group& group : groups_) {
    for (const Bar& bar : group.bars) largest = std::max(largest, bar.value);
  }
  if (groups_.empty() || !(largest > 0.0)) return;
  const int room = area.width() - name_width - value_width;
  const int left = area.left() + name_width;
  int y = area.top();
  const double floor_x = left + noise_ / largest * room;
  for (const Group& group : groups_) {
    painter.setPen(t.text);
    painter.drawText(QRect(area.left(), y, area.width(), title_height), Qt::AlignLeft | Qt::AlignVCenter, group.title);
    y += title_height;
    const int bars_from = y - 4;
    for (const Bar& bar : group.bars) {
      painter.setPen(t.text_secondary);
      painter.drawText(QRect(area.left(), y, name_width - 8, bar_height), Qt::AlignLeft | Qt::AlignVCenter, bar.name);
      const double width = std::max(1.0, bar.value / largest * room);
      painter.setPen(Qt::NoPen);
      painter.setBrush(t.series[bar.kind == 0 ? 1 : 0]);
      painter.drawRoundedRect(QRectF(left, y, width, bar_height), 2, 2);
      painter.setPen(t.text);
      painter.drawText(QRectF(left + width + 6, y, area.right() - left - width, bar_height),
                       Qt::AlignLeft | Qt::AlignVCenter, onScreen(sizeText(bar.value, QStringLiteral("um"))));
      y += bar_step;
    }
    painter.setPen(QPen(t.text, 1.2, Qt::DashLine));
    painter.drawLine(QPointF(floor_x, bars_from), QPointF(floor_x, y - 4));
    painter.setPen(t.text_secondary);
    for (const QString& line : group.more) {
      painter.drawText(QRect(area.left(), y - 4, area.width(), more_height), Qt::AlignLeft | Qt::AlignVCenter,
                       onScreen(line));
      y += more_height;
    }
    y += group_gap;
  }
  const QString text = onScreen(tr("noise floor %1").arg(sizeText(noise_, QStringLiteral("um"))));
  const double text_width = painter.fontMetrics().horizontalAdvance(text);
  const double x = std::clamp(floor_x - text_width / 2, static_cast<double>(area.left()),
                              std::max<double>(area.left(), area.right() - text_width));
  painter.setPen(t.text_secondary);
  painter.drawText(QRectF(x, y - group_gap, text_width + 2, foot_height), Qt::AlignLeft | Qt::AlignVCenter, text);
}

void GapBars::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  draw(painter, rect());
}

void GapBars::exportTo(const QString& file) const {
  const QSize size(std::max(width(), 360), sizeHint().height() + 16);
  const QRect area = QRect(QPoint(0, 0), size).adjusted(8, 8, -8, -8);
  bool written = false;
  if (file.endsWith(QLatin1String(".svg"), Qt::CaseInsensitive)) {
    QSvgGenerator generator;
    generator.setFileName(file);
    generator.setSize(size);
    generator.setViewBox(QRect(QPoint(0, 0), size));
    QPainter painter;
    written = painter.begin(&generator);
    if (written) {
      painter.fillRect(QRect(QPoint(0, 0), size), theme().surface);
      draw(painter, area);
    }
  } else {
    QImage picture(size * 2, QImage::Format_RGB32);
    picture.setDevicePixelRatio(2);
    picture.fill(theme().surface);
    {
      QPainter painter(&picture);
      draw(painter, area);
    }
    written = picture.save(file);
  }
  if (!written) throw InputError({file.toStdString(), ""}, "the picture could not be written.");
}

}  // namespace spindrift::gui
