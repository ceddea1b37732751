// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/discrepancy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/reporting/svg_plot.h"

namespace spindrift {
namespace {

constexpr double seconds_per_hour = 3600.0;

/// Measured minus simulation, and minus the completed model, each relative to the constant of its series.
struct Residuals {
  double before = 0.0;
  double after = 0.0;
};

/// One entry per row; NaN where there is no simulation or the series was not fitted.
std::vector<Residuals> residualsOf(const DiscrepancyInput& input, const DiscrepancyResult& result) {
  const auto& rows = input.observations.rows;
  std::map<std::pair<std::string, Component>, std::pair<double, double>> means;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(result.simulated[i])) continue;
    auto& [sum, count] = means[{rows[i].point, rows[i].component}];
    sum += rows[i].value - result.simulated[i];
    count += 1.0;
  }
  std::vector<Residuals> residuals(rows.size(), {std::nan(""), std::nan("")});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(result.simulated[i])) continue;
    const auto& [sum, count] = means[{rows[i].point, rows[i].component}];
    residuals[i].before = rows[i].value - result.simulated[i] - sum / count;
    if (std::isfinite(result.constant[i])) {
      residuals[i].after = rows[i].value - result.completed[i] - result.constant[i];
    }
  }
  return residuals;
}

void addTimeCourses(HtmlDocument& document, const DiscrepancyInput& input, const std::vector<Residuals>& residuals) {
  const auto& rows = input.observations.rows;
  for (const Component component : all_components) {
    PlotSeries before{"measured minus simulation", {}, {}, {}, SeriesStyle::Points};
    PlotSeries after{"measured minus completed model", {}, {}, {}, SeriesStyle::Points};
    double holdout_from = std::nan("");
    double last = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].component != component || !std::isfinite(residuals[i].before)) continue;
      const double hours = rows[i].time_s / seconds_per_hour;
      before.x.push_back(hours);
      before.y.push_back(residuals[i].before);
      after.x.push_back(hours);
      after.y.push_back(residuals[i].after);
      last = std::max(last, hours);
      if (rows[i].use == ObservationUse::Holdout && !(holdout_from <= hours)) holdout_from = hours;
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

void addPoints(HtmlDocument& document, const DiscrepancyInput& input, const std::vector<Residuals>& residuals) {
  struct Cell {
    double count = 0.0;
    double before = 0.0;
    double after = 0.0;
  };
  std::map<std::pair<std::string, Component>, Cell> cells;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!std::isfinite(residuals[i].before) || !std::isfinite(residuals[i].after)) continue;
    Cell& cell = cells[{input.observations.rows[i].point, input.observations.rows[i].component}];
    cell.count += 1.0;
    cell.before += residuals[i].before * residuals[i].before;
    cell.after += residuals[i].after * residuals[i].after;
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
  for (const std::string& point : input.observations.points()) {
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
  document.table(header, table, "rms per point and component, before \u2192 after");
}

void addEffect(HtmlDocument& document, const FoundEffect& effect) {
  document.subsection(effect.id);
  document.paragraph(effect.physics);
  document.paragraph(fmt::format(
      "Driven by {}. Confidence {:.2f}, gain in BIC {:.0f}; on held-out data {:.2f} um before, "
      "{:.2f} um after.",
      effect.drivers, effect.confidence, effect.delta_bic, effect.heldout_rms_before_um, effect.heldout_rms_after_um));
  if (!effect.rivals.empty()) {
    document.verdict("attention", fmt::format("These data cannot tell it from {}.", joinedList(effect.rivals, "or")));
  }
  std::vector<std::vector<std::string>> rows;
  for (const FittedParameter& p : effect.parameters) {
    rows.push_back({p.name, withUncertainty(p.value, p.standard_uncertainty, "")});
  }
  document.table({"Parameter", "Value"}, rows, "Parameters of " + effect.id);
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

void addDiscrepancyStory(HtmlDocument& document, const DiscrepancyInput& input, const DiscrepancyResult& result) {
  document.verdict(verdictKind(result.verdict), fmt::format("{}: {}", toString(result.verdict), result.message));
  document.table({"", "before", "after", "noise"},
                 {{"rms of the rows that were fitted / um", fmt::format("{:.2f}", result.gap.rms_before_um),
                   fmt::format("{:.2f}", result.gap.rms_after_um), fmt::format("{:.2f}", result.gap.noise_um)},
                  {"rms of the rows held out / um", fmt::format("{:.2f}", result.gap.heldout_rms_before_um),
                   fmt::format("{:.2f}", result.gap.heldout_rms_after_um), fmt::format("{:.2f}", result.gap.noise_um)}},
                 "The gap between measured and simulated; nobody can go below the noise");
  for (const FoundEffect& effect : result.effects) addEffect(document, effect);
  if (!result.leftover.empty()) document.verdict("bad", fmt::format("Left over: {}.", result.leftover));
  if (result.suggestion) {
    const MeasurementSuggestion& next = *result.suggestion;
    document.subsection("Measure next");
    document.paragraph(fmt::format(
        "To tell {}: measure {} at {} times of the programme; {}. Expected gain in BIC {:.0f}.", next.separates,
        joinedList(next.points), next.times_s.size(), next.conditions, next.expected_delta_bic));
  }
  if (!result.where.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const DisagreementPlace& place : result.where) {
      rows.push_back({std::string(toString(place.component)), joinedList(place.points),
                      fmt::format("{:.1f} to {:.1f}", place.from_s / seconds_per_hour, place.to_s / seconds_per_hour),
                      place.condition, fmt::format("{:.2f} {}", place.excess_um, unitOf(place.component)),
                      place.p_value < 1e-12 ? std::string("< 1e-12") : fmt::format("{:.1e}", place.p_value)});
    }
    document.table({"Component", "Points", "Time / h", "Condition", "Beyond the noise", "p"}, rows,
                   "Where measured and simulated disagree; p holds for all places looked at together");
  }
  const std::vector<Residuals> residuals = residualsOf(input, result);
  addTimeCourses(document, input, residuals);
  addPoints(document, input, residuals);
  if (!result.steps.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const DiscrepancyStep& step : result.steps) {
      rows.push_back({step.id, fmt::format("{:.0f}", step.delta_bic),
                      step.accepted ? std::string("added") : "not added: " + step.reason});
    }
    document.table({"Effect", "Gain in BIC", "Decision"}, rows, "What was tried, in this order");
  }
  for (const std::string& warning : result.warnings) document.paragraph("Note: " + warning);
}

std::string discrepancyReport(const std::string& campaign, const DiscrepancyInput& input,
                              const DiscrepancyResult& result) {
  HtmlDocument document(fmt::format("Discrepancy: {}", campaign),
                        "where measured and simulated disagree, which effect is missing, what its addition gains");
  addDiscrepancyStory(document, input, result);
  return document.html();
}

}  // namespace spindrift
