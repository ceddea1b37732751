// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/history_card.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/connect/unit_conversion.h"
#include "core/machine/operating_log.h"
#include "widgets/models/cells.h"
#include "widgets/plots/plot.h"
#include "widgets/services/connections_service.h"

namespace spindrift::gui {

HistoryCard::HistoryCard(QWidget* parent) : Card(tr("The last hour"), parent) {
  plot_ = new Plot;
  plot_->setEmptyText(tr("Values will appear here as they come"), tr("Press Live view or Record."));
  plot_->setMinimumHeight(150);
  body()->addWidget(plot_, 1);
}

void HistoryCard::show(const ConnectionsService& service, const std::string& chosen) {
  const LiveSnapshot& snapshot = service.snapshot();
  if (snapshot.columns.empty()) {
    if (!plot_->empty()) plot_->setContent({});
    return;
  }
  // The column that is chosen; without a choice all of the unit of the first, temperatures before anything else.
  std::vector<std::size_t> shown;
  const bool temperatures = std::any_of(snapshot.columns.begin(), snapshot.columns.end(),
                                        [](const LiveColumn& c) { return OperatingLog::isTemperature(c.column); });
  const std::string unit = temperatures ? "degC" : unitOfColumn(snapshot.columns.front().column);
  for (std::size_t c = 0; c < snapshot.columns.size() && shown.size() < theme().series.size(); ++c) {
    const std::string& name = snapshot.columns[c].column;
    if (chosen.empty() ? unitOfColumn(name) == unit : name == chosen) shown.push_back(c);
  }
  std::vector<std::vector<LivePoint>> histories;
  double span_s = 0.0;
  for (const std::size_t c : shown) {
    histories.push_back(service.history(c));
    if (!histories.back().empty()) span_s = std::max(span_s, snapshot.now_s - histories.back().front().time_s);
  }
  const TimeUnit time = timeUnit(std::min(span_s, LiveValues::history_s));
  std::vector<Series> series;
  QString y_title;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const LiveColumn& column = snapshot.columns[shown[i]];
    Series s;
    s.name = columnTitle(column.column);
    s.colour = static_cast<int>(series.size());
    s.style = OperatingLog::isTemperature(column.column) ? SeriesStyle::Line : SeriesStyle::Steps;
    for (const LivePoint& point : histories[i]) {
      // What held at the beginning of the hour began before it.
      s.x.push_back(std::max(point.time_s - snapshot.now_s, -LiveValues::history_s) / time.seconds);
      s.y.push_back(point.value);
    }
    // What is known holds until now.
    if (!s.x.empty() && column.known && !snapshot.isLost(column)) {
      s.x.push_back(0.0);
      s.y.push_back(s.y.back());
    }
    const bool any = std::any_of(s.y.begin(), s.y.end(), [](double v) { return std::isfinite(v); });
    if (!any) continue;
    const QString of = fromCore(unitOfColumn(column.column));
    y_title = OperatingLog::isTemperature(column.column)
                  ? tr("Temperature / °C")
                  : columnTitle(column.column) + (of.isEmpty() ? QString() : QStringLiteral(" / ") + of);
    series.push_back(std::move(s));
  }
  // A single curve has no legend.
  setTitle(series.size() == 1 ? tr("The last hour: %1").arg(series.front().name) : tr("The last hour"));
  plot_->setAxes(tr("Time from now / %1").arg(time.name), y_title);
  plot_->setContent(std::move(series));
}

}  // namespace spindrift::gui
