// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/simulation_views.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/workflows/fit_campaign.h"
#include "widgets/common/parts.h"
#include "widgets/common/table_angle.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

SimulationHistory::SimulationHistory(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* card = new Card(tr("Measured, simulation before and after"));
  series_ = new QComboBox;
  series_->setAccessibleName(tr("Series shown over time"));
  series_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  card->addToTitle(series_);
  plot_ = new Plot;
  plot_->setEmptyText(tr("Measured and simulated over time"),
                      tr("Put something into the simulation: its runs before and after appear here."));
  card->body()->addWidget(plot_, 1);
  column->addWidget(card, 1);
  connect(series_, &QComboBox::activated, this, [this](int) { draw(); });
  connect(plot_, &Plot::hovered, this, &SimulationHistory::hovered);
}

void SimulationHistory::show(const std::vector<DiscrepancyReportRow>& rows) {
  rows_ = rows;
  gaps_ = seriesGaps(rows_);
  series_->clear();
  for (const SeriesGap& gap : gaps_)
    series_->addItem(onScreen(tr("%1 of %2: rms %3 → %4")
                                  .arg(componentName(gap.component), QString::fromStdString(gap.point),
                                       sizeText(gap.before, {}), sizeText(gap.after, componentUnit(gap.component)))));
  draw();
}

void SimulationHistory::draw() {
  const int chosen = series_->currentIndex();
  series_->setVisible(chosen >= 0);
  if (chosen < 0) {
    plot_->setContent({});
    return;
  }
  const auto& [point, component, size_before, size_after] = gaps_[static_cast<std::size_t>(chosen)];
  std::vector<const DiscrepancyReportRow*> rows;
  for (const DiscrepancyReportRow& r : rows_) {
    if (r.point == point && r.component == component && std::isfinite(r.before) && std::isfinite(r.after))
      rows.push_back(&r);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) { return a->time_s < b->time_s; });
  const TimeUnit unit = timeUnit(rows.back()->time_s);
  Series measured{tr("measured"), {}, {}, {}, SeriesStyle::Points, 1};
  Series before{tr("simulation before"), {}, {}, {}, SeriesStyle::Dashed, 2};
  Series after{tr("simulation after"), {}, {}, {}, SeriesStyle::Line, 0};
  double held_from = std::nan("");
  double held_to = 0.0;
  for (const DiscrepancyReportRow* r : rows) {
    const double t = r->time_s / unit.seconds;
    for (Series* s : {&measured, &before, &after}) s->x.push_back(t);
    measured.y.push_back(r->measured);
    measured.sigma.push_back(r->sigma);
    before.y.push_back(r->measured - r->before);
    after.y.push_back(r->measured - r->after);
    if (!r->held_out) continue;
    if (std::isnan(held_from)) held_from = t;
    held_to = t;
  }
  std::vector<Span> spans;
  if (!std::isnan(held_from)) spans.push_back({held_from, held_to, tr("held out"), Tone::Accent});
  plot_->setAxes(tr("Time / %1").arg(unit.name),
                 QStringLiteral("%1 / %2").arg(componentName(component), componentUnit(component)));
  plot_->setContent({before, after, measured}, spans);
}

SimulationMaps::SimulationMaps(QWidget* parent) : QWidget(parent) {
  auto* line = new QHBoxLayout(this);
  line->setContentsMargins(0, 0, 0, 0);
  line->setSpacing(12);
  for (std::size_t i = 0; i < 2; ++i) {
    cards_[i] = new Card(i == 0 ? tr("Before") : tr("After"));
    views_[i] = new View3D;
    views_[i]->setMachineVisible(false);
    views_[i]->setToolSideVisible(false);
    cards_[i]->body()->addWidget(views_[i], 1);
    line->addWidget(cards_[i], 1);
    connect(views_[i], &View3D::hovered, this, &SimulationMaps::hovered);
  }
  views_[0]->link(views_[1]);
}

void SimulationMaps::show(const std::shared_ptr<const SimulationStory>& story, const MachineDescription& machine) {
  shown_ = false;
  for (View3D* view : views_) view->clear();
  sayWhyEmpty(tr("Calculating the map."));
  for (std::size_t i = 0; i < 2; ++i) cards_[i]->setTitle(i == 0 ? tr("Before") : tr("After"));
  work_.ask([this, story, machine]() -> std::function<void()> {
    const std::optional<FieldGrid> table = mapTable(machine, 0.0, report_map_nodes);
    auto maps = table ? discrepancyMaps(story->rows, *table) : std::nullopt;
    if (!maps)
      return [this] { sayWhyEmpty(tr("The points of no moment span a plane: there is no map over the table.")); };
    const double last_s = std::max(maps->time_s, story->rows.back().time_s);
    return [this, maps = std::move(*maps), machine, last_s] { draw(maps, machine, last_s); };
  });
}

void SimulationMaps::sayWhyEmpty(const QString& why) {
  for (View3D* view : views_) view->setEmptyText(tr("Measured minus simulation"), why);
}

void SimulationMaps::draw(const DiscrepancyMaps& maps, const MachineDescription& machine, double last_s) {
  shown_ = true;
  const Component component = maps.fields[0].component;
  const TimeUnit unit = timeUnit(last_s);
  const QString when = tr("%1 %2").arg(decimalText(maps.time_s / unit.seconds, 'f', 2)).arg(unit.name);
  const ColourScale scale =
      ColourScale::symmetric(maps.fields[0].largestMagnitude(), componentName(component), componentUnit(component));
  for (std::size_t i = 0; i < 2; ++i) {
    const Field& field = maps.fields[i];
    cards_[i]->setTitle((i == 0 ? tr("Before: largest %1") : tr("After: largest %1"))
                            .arg(sizeText(field.largestMagnitude(), componentUnit(component))));
    views_[i]->setMachine(machine);
    views_[i]->setColourScale(scale);
    views_[i]->setCaption(tr("%1, measured − simulation at %2")
                              .arg(componentName(component), maps.c_deg ? withTableAngle(when, *maps.c_deg) : when));
    std::vector<ViewPoint> points;
    for (const Field::Marker& marker : field.markers) {
      ViewPoint p;
      p.id = p.label = QString::fromStdString(marker.point);
      p.position_mm = marker.position_mm;
      p.value = marker.value;
      points.push_back(std::move(p));
    }
    views_[i]->setPoints(std::move(points));
    views_[i]->setField(std::make_shared<const Field>(field), FieldStyle{});
  }
}

std::vector<Exportable> SimulationMaps::exportables() {
  if (!shown_) return {};
  return {exportableOf(tr("Initial simulation over the table"), views_[0]),
          exportableOf(tr("Updated simulation over the table"), views_[1])};
}

}  // namespace spindrift::gui
