// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/discrepancy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/discrepancy/effect_titles.h"
#include "core/machine/interpolated_field.h"
#include "core/reporting/heatmap_picture.h"
#include "core/reporting/report_wording.h"
#include "core/reporting/svg_plot.h"

namespace spindrift {
namespace {

constexpr double seconds_per_hour = 3600.0;

void addTimeCourses(HtmlDocument& document, const std::vector<DiscrepancyReportRow>& rows) {
  for (const Component component : all_components) {
    PlotSeries before{"measured minus simulation", {}, {}, {}, SeriesStyle::Points};
    PlotSeries after{"measured minus completed model", {}, {}, {}, SeriesStyle::Points};
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
    if (before.x.empty()) continue;
    PlotOptions options{.title = std::string(toString(component)),
                        .x_label = "time / h",
                        .y_label = fmt::format("{} / {}", toString(component), unitOf(component)),
                        .width_px = 860,
                        .height_px = 240};
    if (std::isfinite(holdout_from)) options.ranges.push_back({holdout_from, last, "held out"});
    document.figure(svgPlot({before, after}, options),
                    fmt::format("{} of all points over time, before and after", toString(component)));
  }
}

void addPoints(HtmlDocument& document, const std::vector<DiscrepancyReportRow>& rows) {
  struct Cell {
    double count = 0.0;
    double before = 0.0;
    double after = 0.0;
  };
  std::map<std::pair<std::string, Component>, Cell> cells;
  std::vector<std::string> points;
  for (const DiscrepancyReportRow& row : rows) {
    if (std::find(points.begin(), points.end(), row.point) == points.end()) points.push_back(row.point);
    // As in the window: what was held out only proves, and has figures of its own.
    if (row.held_out || !std::isfinite(row.before) || !std::isfinite(row.after)) continue;
    Cell& cell = cells[{row.point, row.component}];
    cell.count += 1.0;
    cell.before += row.before * row.before;
    cell.after += row.after * row.after;
  }
  std::vector<Component> components;
  std::vector<std::string> header{"Point"};
  for (const Component component : all_components) {
    if (std::none_of(cells.begin(), cells.end(), [&](const auto& cell) { return cell.first.second == component; })) {
      continue;
    }
    components.push_back(component);
    header.push_back(fmt::format("{} / {}", toString(component), unitOf(component)));
  }
  std::vector<std::vector<std::string>> table;
  for (const std::string& point : points) {
    std::vector<std::string> row{point};
    for (const Component component : components) {
      const auto cell = cells.find({point, component});
      row.push_back(cell == cells.end()
                        ? ""
                        : fmt::format("{:.2f} \u2192 {:.2f}", std::sqrt(cell->second.before / cell->second.count),
                                      std::sqrt(cell->second.after / cell->second.count)));
    }
    table.push_back(std::move(row));
  }
  document.table(header, table, "rms of the rows that were fitted, per point and component, before \u2192 after");
}

void addMaps(HtmlDocument& document, const DiscrepancyReportData& data, const FieldGrid& table) {
  double time_s = 0.0;
  const auto maps = discrepancyMaps(data, table, time_s);
  if (!maps) return;
  const double limit = roundLimit((*maps)[0].largestMagnitude());
  const std::string name(toString((*maps)[0].component));
  std::vector<std::string> pictures;
  for (std::size_t side = 0; side < 2; ++side) {
    HeatmapPictureOptions options;
    options.width_px = 480;
    options.title = fmt::format("{} {}", name, side == 0 ? "before" : "after");
    options.subtitle = side == 0 ? "measured minus simulation" : "measured minus completed model";
    options.limit = limit;
    options.legend = false;
    pictures.push_back(heatmapSvg((*maps)[side], options));
  }
  document.figure(svgGrid(pictures, 2),
                  fmt::format("{} over the table at {:.2f} h, where the gap is largest, before and after on one scale; "
                              "between the points interpolated; {}",
                              name, time_s / seconds_per_hour, heatmap_legend));
}

void addEffect(HtmlDocument& document, const FoundEffect& effect, bool user_adds) {
  document.subsection(effectHeading(effect.id) + (!user_adds      ? ""
                                                  : effect.forced ? " (added to the model)"
                                                                  : " (proposed)"));
  document.paragraph(effect.physics);
  document.paragraph(
      fmt::format("Driven by {}. Probability that the name is right {:.2f}; gain in BIC {:.0f}; rms on "
                  "held-out data {:.2f} um before, {:.2f} um after.",
                  driversInWords(effect.drivers), effect.confidence, effect.delta_bic, effect.heldout_rms_before_um,
                  effect.heldout_rms_after_um));
  if (!effect.rivals.empty()) {
    document.verdict("attention", withEffectTitles(fmt::format("These data cannot tell it from {}.",
                                                               joinedList(effect.rivals, "or"))));
  }
  std::vector<std::vector<std::string>> rows;
  for (const FittedParameter& p : effect.parameters) {
    rows.push_back(
        {parameterTitle(p.name) + ' ' + smallPrint(p.name), withUncertainty(p.value, p.standard_uncertainty, "")});
  }
  document.table({"Parameter", "Value ± standard uncertainty"}, rows, "Parameters of the " + effectTitle(effect.id));
}

const char* verdictKind(DiscrepancyVerdict verdict) {
  switch (verdict) {
    case DiscrepancyVerdict::Named:
    case DiscrepancyVerdict::None:
      return "good";
    case DiscrepancyVerdict::Ambiguous:
      return "attention";
    case DiscrepancyVerdict::Unknown:
      return "bad";
  }
  return "note";
}

}  // namespace

DiscrepancyReportData discrepancyReportData(const DiscrepancyInput& input, const DiscrepancyResult& result) {
  DiscrepancyReportData data;
  data.verdict = result.verdict;
  data.message = result.message;
  data.effects = result.effects;
  data.gap = result.gap;
  data.where = result.where;
  data.suggestion = result.suggestion;
  data.leftover = result.leftover;
  data.steps = result.steps;
  data.warnings = result.warnings;
  const auto& rows = input.observations.rows;
  std::map<std::pair<std::string, Component>, std::pair<double, double>> means;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(result.simulated[i])) continue;
    auto& [sum, count] = means[{rows[i].point, rows[i].component}];
    sum += rows[i].value - result.simulated[i];
    count += 1.0;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = rows[i];
    DiscrepancyReportRow row{o.time_s, o.point,      o.component,  o.position_mm,
                             o.sigma,  std::nan(""), std::nan(""), o.use == ObservationUse::Holdout};
    if (std::isfinite(result.simulated[i])) {
      const auto& [sum, count] = means[{o.point, o.component}];
      row.before = o.value - result.simulated[i] - sum / count;
      if (std::isfinite(result.constant[i])) row.after = o.value - result.completed[i] - result.constant[i];
    }
    data.rows.push_back(std::move(row));
  }
  return data;
}

std::optional<std::array<Field, 2>> discrepancyMaps(const DiscrepancyReportData& data, FieldGrid table,
                                                    double& time_s) {
  // The readings of a component in order of time; a moment ends where a point comes a second time.
  std::vector<std::vector<const DiscrepancyReportRow*>> moments;
  for (const Component component : all_components) {
    std::vector<const DiscrepancyReportRow*> rows;
    for (const DiscrepancyReportRow& row : data.rows)
      if (row.component == component && std::isfinite(row.before) && std::isfinite(row.after)) rows.push_back(&row);
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
  time_s = worst->front()->time_s;
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
  std::array<Field, 2> fields{fieldBetween(component, values[0], table), fieldBetween(component, values[1], table)};
  for (std::size_t side = 0; side < 2; ++side) fields[side].markers = std::move(markers[side]);
  return fields;
}

void addDiscrepancyStory(HtmlDocument& document, const DiscrepancyReportData& result,
                         const std::optional<FieldGrid>& table) {
  document.verdict(verdictKind(result.verdict), discrepancyHeadline(result));
  const auto text = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.2f}", value) : std::string("\u2013");
  };
  document.table({"", "before", "after", "noise"},
                 {{"rms of the rows that were fitted / um", text(result.gap.rms_before_um),
                   text(result.gap.rms_after_um), text(result.gap.noise_um)},
                  {"rms of the rows held out / um", text(result.gap.heldout_rms_before_um),
                   text(result.gap.heldout_rms_after_um), text(result.gap.noise_um)}},
                 "The gap between measured and simulated; nobody can go below the noise");
  for (const FoundEffect& effect : result.effects) addEffect(document, effect, result.user_adds);
  if (!result.leftover.empty())
    document.verdict("bad", withEffectTitles(fmt::format("Left over: {}.", result.leftover)));
  if (result.suggestion) {
    const MeasurementSuggestion& next = *result.suggestion;
    document.subsection("Measure next");
    document.paragraph(withEffectTitles(fmt::format(
        "To tell {}: measure {} at {} times of the programme; {}. Expected gain in BIC {:.0f}.", next.separates,
        joinedList(next.points), next.times_s.size(), next.conditions, next.expected_delta_bic)));
  }
  if (!result.where.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const DisagreementPlace& place : result.where) {
      rows.push_back({std::string(toString(place.component)), joinedList(place.points),
                      fmt::format("{:.1f} to {:.1f}", place.from_s / seconds_per_hour, place.to_s / seconds_per_hour),
                      place.condition, fmt::format("{:.2f} {}", place.excess_um, unitOf(place.component)),
                      probabilityInWords(place.p_value)});
    }
    document.table({"Component", "Points", "Time / h", "Condition", "Beyond the noise", "p"}, rows,
                   "Where measured and simulated disagree; p: probability of so much by chance, for all places looked "
                   "at together");
  }
  if (table && !result.effects.empty()) addMaps(document, result, *table);
  addTimeCourses(document, result.rows);
  addPoints(document, result.rows);
  if (!result.steps.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const DiscrepancyStep& step : result.steps) {
      rows.push_back({withEffectTitles(step.id), fmt::format("{:.0f}", step.delta_bic),
                      step.accepted ? std::string("added") : withEffectTitles("not added: " + step.reason)});
    }
    document.table({"Effect", "Gain in BIC", "Decision"}, rows, "What was tried, in this order");
  }
  for (const std::string& warning : result.warnings) document.paragraph(withEffectTitles("Note: " + warning));
  document.paragraph(
      "rms: root mean square of what is left, each series about its own constant. BIC: Bayesian information criterion; "
      "a gain above 10 is strong evidence for the effect. Held out: rows that took no part in the choice.");
}

std::string discrepancyHeadline(const DiscrepancyReportData& data) {
  return withEffectTitles(data.message);
}

std::string discrepancyReport(const std::string& campaign, const DiscrepancyReportData& data,
                              const std::optional<FieldGrid>& table) {
  HtmlDocument document(fmt::format("Discrepancy: {}", campaign),
                        "where measured and simulated disagree, which effect is missing, what its addition gains");
  addDiscrepancyStory(document, data, table);
  return document.html();
}

}  // namespace spindrift
