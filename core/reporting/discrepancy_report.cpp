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

bool anyHeldOut(const std::vector<DiscrepancyReportRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const DiscrepancyReportRow& row) { return row.held_out; });
}

/// rms, peak-to-peak and fit of the rows that were fitted and of those held out.
void addGap(HtmlDocument& document, const DiscrepancyReportData& data) {
  const std::string none = "\u2013";
  const auto text = [&](double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : none;
  };
  std::vector<std::vector<std::string>> table;
  const auto addRms = [&](const char* what, double before, double after) {
    table.push_back({what, text(before, 2), text(after, 2), text(data.gap.noise_um, 2)});
  };
  const auto addFigures = [&](const char* what, bool held_out) {
    GapFigures figures = gapFigures(data.rows, held_out);
    if (!std::isfinite(data.gap.rms_after_um)) figures.p2p_after = figures.fit_after_percent = std::nan("");
    if (std::isfinite(figures.p2p_before)) {
      table.push_back(
          {fmt::format("largest peak-to-peak of one series, {} / {}", what, figures.rotations ? "urad" : "um"),
           text(figures.p2p_before, 1), text(figures.p2p_after, 1), none});
    }
    if (std::isfinite(figures.fit_before_percent)) {
      table.push_back({fmt::format("fit, {} / %", what), text(figures.fit_before_percent, 0),
                       text(figures.fit_after_percent, 0), none});
    }
  };
  const bool held_out = anyHeldOut(data.rows);
  addRms("rms of the rows that were fitted / um", data.gap.rms_before_um, data.gap.rms_after_um);
  addFigures("rows fitted", false);
  addRms(held_out ? "rms of the rows held out / um" : "rms of blocks of rows left out in turn / um",
         data.gap.heldout_rms_before_um, data.gap.heldout_rms_after_um);
  if (held_out) addFigures("rows held out", true);
  document.table({"", "before", "after", "noise"}, table,
                 "The gap between measured and simulated; nobody can go below the noise");
}

void addSteps(HtmlDocument& document, const DiscrepancyReportData& data) {
  if (data.steps.empty()) return;
  std::vector<std::vector<std::string>> rows;
  for (const DiscrepancyStep& step : data.steps) {
    std::string decision = "added";
    if (!step.accepted) {
      decision = withEffectTitles("not added: " + step.reason);
    } else if (takenOutAgain(step, data.effects)) {
      decision = data.verdict == DiscrepancyVerdict::Unknown
                     ? "added, then taken out again: with it too something is left that no effect explains"
                     : "added, then taken out again";
    }
    rows.push_back({withEffectTitles(step.id), fmt::format("{:.0f}", step.delta_bic), decision});
  }
  document.table({"Effect", "Gain in BIC", "Decision"}, rows, "What was tried, in this order");
}

void addEffect(HtmlDocument& document, const FoundEffect& effect, bool user_adds, bool held_out) {
  document.subsection(effectHeading(effect.id) + (!user_adds      ? ""
                                                  : effect.forced ? " (added to the model)"
                                                                  : " (proposed)"));
  document.paragraph(effect.physics);
  document.paragraph(fmt::format(
      "Driven by {}. Probability that {} {:.2f}; gain in BIC {:.0f}; rms on {} {:.2f} um before, {:.2f} um "
      "after.",
      driversInWords(effect.drivers), effect.rivals.empty() ? "the name is right" : "it or one of its rivals is right",
      effect.confidence, effect.delta_bic, held_out ? "held-out data" : "blocks left out in turn",
      effect.heldout_rms_before_um, effect.heldout_rms_after_um));
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
  struct Sum {
    double weight = 0.0;
    double value = 0.0;
  };
  std::map<std::pair<std::string, Component>, Sum> sums;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(result.simulated[i]) || rows[i].use != ObservationUse::Fit) continue;
    const double weight = 1.0 / (rows[i].sigma * rows[i].sigma);
    Sum& sum = sums[{rows[i].point, rows[i].component}];
    sum.weight += weight;
    sum.value += weight * (rows[i].value - result.simulated[i]);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = rows[i];
    if (o.use == ObservationUse::Exclude) continue;
    const double none = std::nan("");
    DiscrepancyReportRow row{
        o.time_s, o.point, o.component, o.position_mm, o.sigma, none, none, o.use == ObservationUse::Holdout, o.value};
    if (const auto sum = sums.find({o.point, o.component}); sum != sums.end() && std::isfinite(result.simulated[i])) {
      row.before = o.value - result.simulated[i] - sum->second.value / sum->second.weight;
      if (std::isfinite(result.constant[i])) row.after = o.value - result.completed[i] - result.constant[i];
    }
    data.rows.push_back(std::move(row));
  }
  return data;
}

GapFigures gapFigures(const std::vector<DiscrepancyReportRow>& rows, bool held_out) {
  struct Course {
    std::vector<const DiscrepancyReportRow*> rows;
    double measured = 0.0;
  };
  const auto counts = [held_out](const DiscrepancyReportRow& row) {
    return row.held_out == held_out && std::isfinite(row.before);
  };
  const double none = std::nan("");
  GapFigures figures{true, none, none, none, none};
  for (const DiscrepancyReportRow& row : rows) {
    if (counts(row) && !isRotation(row.component)) figures.rotations = false;
  }
  std::map<std::pair<std::string, Component>, Course> courses;
  for (const DiscrepancyReportRow& row : rows) {
    if (!counts(row) || isRotation(row.component) != figures.rotations) continue;
    Course& course = courses[{row.point, row.component}];
    course.rows.push_back(&row);
    course.measured += row.measured;
  }
  double moved = 0.0;
  for (const auto& [key, course] : courses) {
    for (const DiscrepancyReportRow* row : course.rows) {
      const double d = row->measured - course.measured / static_cast<double>(course.rows.size());
      moved += d * d;
    }
  }
  const auto look = [&](double DiscrepancyReportRow::*residual, double& p2p) {
    double left = 0.0;
    for (const auto& [key, course] : courses) {
      double low = none;
      double high = none;
      for (const DiscrepancyReportRow* row : course.rows) {
        const double r = row->*residual;
        left += r * r;
        low = std::fmin(low, r);
        high = std::fmax(high, r);
      }
      p2p = std::fmax(p2p, high - low);
    }
    return moved > 0.0 ? 100.0 * (1.0 - std::sqrt(left / moved)) : none;
  };
  figures.fit_before_percent = look(&DiscrepancyReportRow::before, figures.p2p_before);
  figures.fit_after_percent = look(&DiscrepancyReportRow::after, figures.p2p_after);
  return figures;
}

bool takenOutAgain(const DiscrepancyStep& step, const std::vector<FoundEffect>& effects) {
  return step.accepted &&
         std::none_of(effects.begin(), effects.end(), [&](const FoundEffect& e) { return e.id == step.id; });
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
  addGap(document, result);
  const bool held_out = anyHeldOut(result.rows);
  for (const FoundEffect& effect : result.effects) addEffect(document, effect, result.user_adds, held_out);
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
  addSteps(document, result);
  for (const std::string& warning : result.warnings) document.paragraph(withEffectTitles("Note: " + warning));
  document.paragraph(
      "rms: root mean square of what is left, each series about its own constant, which is fitted anew with every "
      "model. Fit: 100 % is perfect, 0 % no better than a constant for each series. BIC: Bayesian information "
      "criterion; a gain above 10 is strong evidence for the effect. Held out: rows that took no part in the choice.");
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
