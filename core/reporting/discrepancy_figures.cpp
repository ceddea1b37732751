// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/discrepancy_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/units.h"
#include "core/machine/interpolated_field.h"
#include "core/reporting/heatmap_picture.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

/// Residuals of a component over time before and after; nothing where it was not measured.
std::optional<StackedPlot> timeHistory(const std::vector<DiscrepancyReportRow>& rows, Component component,
                                       std::string_view completed) {
  PlotSeries before{"measured minus simulation", {}, {}, {}, SeriesStyle::Points};
  PlotSeries after{fmt::format("measured minus {}", completed), {}, {}, {}, SeriesStyle::Points};
  after.marker = PlotMarker::Square;
  double holdout_from = std::nan("");
  double last = 0.0;
  for (const DiscrepancyReportRow& row : rows) {
    if (row.component != component || !std::isfinite(row.before)) continue;
    const double hours = row.time_s / seconds_per_hour;
    before.x.push_back(hours);
    before.y.push_back(row.before);
    after.x.push_back(hours);
    after.y.push_back(row.after);
    last = std::max(last, hours);
    if (row.held_out && !(holdout_from <= hours)) holdout_from = hours;
  }
  if (before.x.empty()) return std::nullopt;
  PlotOptions options{.title = std::string(toString(component)),
                      .y_label = fmt::format("{} / {}", toString(component), printedUnitOf(component)),
                      .width_px = 860,
                      .height_px = 190};
  if (std::isfinite(holdout_from)) options.ranges.push_back({holdout_from, last, "held out"});
  return StackedPlot{{std::move(before), std::move(after)}, std::move(options)};
}

}  // namespace

std::optional<DiscrepancyMaps> discrepancyMaps(const std::vector<DiscrepancyReportRow>& data, FieldGrid table) {
  // The readings of a component with the table at one angle in order of time; a moment ends where a point comes a
  // second time.
  std::vector<std::vector<const DiscrepancyReportRow*>> moments;
  std::map<std::pair<Component, double>, std::vector<const DiscrepancyReportRow*>> readings;
  for (const DiscrepancyReportRow& row : data)
    if (std::isfinite(row.before) && std::isfinite(row.after)) readings[{row.component, row.c_deg}].push_back(&row);
  std::set<double> angles;
  for (const auto& [at, rows] : readings) angles.insert(at.second);
  for (auto& [at, rows] : readings) {
    std::stable_sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) { return a->time_s < b->time_s; });
    std::set<std::string> seen;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == 0 || !seen.insert(rows[i]->point).second) {
        seen = {rows[i]->point};
        moments.emplace_back();
      }
      moments.back().push_back(rows[i]);
    }
  }
  const std::vector<const DiscrepancyReportRow*>* worst = nullptr;
  double largest = 0.0;
  for (const auto& moment : moments) {
    double sum = 0.0;
    for (const DiscrepancyReportRow* row : moment) sum += row->before * row->before / (row->sigma * row->sigma);
    sum /= static_cast<double>(moment.size());
    if (moment.size() < 3 || sum <= largest) continue;
    largest = sum;
    worst = &moment;
  }
  if (worst == nullptr) return std::nullopt;
  const Component component = worst->front()->component;
  std::array<std::vector<ScatteredValue>, 2> values;
  std::array<std::vector<Field::Marker>, 2> markers;
  double z_mm = 0.0;
  for (const DiscrepancyReportRow* row : *worst) {
    z_mm += row->position_mm.z();
    for (std::size_t side = 0; side < 2; ++side) {
      const double value = side == 0 ? row->before : row->after;
      values[side].push_back({row->position_mm, value, row->sigma});
      markers[side].push_back({row->point, row->position_mm, value, row->sigma, !row->held_out});
    }
  }
  if (!spreadsOverPlane(values[0])) return std::nullopt;
  table.z_mm = z_mm / static_cast<double>(values[0].size());
  DiscrepancyMaps maps{{fieldBetween(component, values[0], table), fieldBetween(component, values[1], table)},
                       worst->front()->time_s,
                       angles.size() > 1 ? std::optional(worst->front()->c_deg) : std::nullopt};
  for (std::size_t side = 0; side < 2; ++side) maps.fields[side].markers = std::move(markers[side]);
  return maps;
}

void addTimeHistories(Report& document, const std::vector<DiscrepancyReportRow>& rows, std::string_view completed) {
  for (const bool angles : {false, true}) {
    std::vector<StackedPlot> plots;
    for (const Component component : all_components) {
      if (isRotation(component) != angles) continue;
      if (auto plot = timeHistory(rows, component, completed)) plots.push_back(std::move(*plot));
    }
    if (plots.empty()) continue;
    plots.back().options.x_label = "time / h";
    plots.back().options.height_px += 30;
    document.figure(plotStack(plots), angles ? "Rotations of all points over time, before and after"
                                             : "Displacements of all points over time, before and after");
  }
}

void addDiscrepancyMaps(Report& document, const std::vector<DiscrepancyReportRow>& rows, const FieldGrid& table,
                        std::string_view completed) {
  const auto maps = discrepancyMaps(rows, table);
  if (!maps) return;
  const double limit = roundLimit(maps->fields[0].largestMagnitude());
  const std::string name(toString(maps->fields[0].component));
  std::vector<Drawing> pictures;
  for (std::size_t side = 0; side < 2; ++side) {
    HeatmapPictureOptions options;
    options.width_px = 480;
    options.title = fmt::format("{} {}", name, side == 0 ? "before" : "after");
    options.subtitle = side == 0 ? "measured minus simulation" : fmt::format("measured minus {}", completed);
    options.limit = limit;
    options.legend = false;
    pictures.push_back(heatmapPicture(maps->fields[side], options));
  }
  document.figure(drawingGrid(pictures, 2),
                  fmt::format("{} over the table at {:.2f} h, where the gap is largest, before and after on one scale; "
                              "between the points interpolated; {}",
                              maps->c_deg ? fmt::format("{}, table at {:g}°", name, *maps->c_deg) : name,
                              maps->time_s / seconds_per_hour, heatmap_legend));
}

}  // namespace spindrift
