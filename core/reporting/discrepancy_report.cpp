// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/discrepancy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/discrepancy/effect_titles.h"
#include "core/discrepancy/percent_text.h"
#include "core/machine/driver_words.h"
#include "core/machine/interpolated_field.h"
#include "core/reporting/discrepancy_figures.h"
#include "core/reporting/heatmap_picture.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

constexpr std::size_t most_states_in_table = 48;
constexpr std::size_t most_outliers_in_table = 50;

void addPoints(Report& document, const std::vector<DiscrepancyReportRow>& rows) {
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
  ReportRow header{"Point"};
  for (const Component component : all_components) {
    if (std::none_of(cells.begin(), cells.end(), [&](const auto& cell) { return cell.first.second == component; })) {
      continue;
    }
    components.push_back(component);
    header.push_back(fmt::format("{} / {}", toString(component), printedUnitOf(component)));
  }
  std::vector<ReportRow> table;
  for (const std::string& point : points) {
    ReportRow row{point};
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

bool anyHeldOut(const std::vector<DiscrepancyReportRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const DiscrepancyReportRow& row) { return row.held_out; });
}

/// rms, peak-to-peak and fit of the rows that were fitted and of those held out.
void addGap(Report& document, const DiscrepancyReportData& data) {
  const std::string none = "\u2013";
  const auto text = [&](double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : none;
  };
  std::vector<ReportRow> table;
  const auto addRms = [&](const std::string& what, double before, double after) {
    table.push_back({what, text(before, 2), text(after, 2), text(data.gap.noise_um, 2)});
  };
  const auto addFigures = [&](const char* what, bool held_out) {
    GapFigures figures = gapFigures(data.rows, held_out);
    if (!std::isfinite(data.gap.rms_after_um)) figures.p2p_after = figures.fit_after_percent = std::nan("");
    if (std::isfinite(figures.p2p_before)) {
      table.push_back(
          {fmt::format("largest peak-to-peak of one series, {} / {}", what, figures.rotations ? "µrad" : "µm"),
           text(figures.p2p_before, 1), text(figures.p2p_after, 1), none});
    }
    if (std::isfinite(figures.fit_before_percent)) {
      table.push_back({fmt::format("fit, {} / %", what), text(figures.fit_before_percent, 0),
                       text(figures.fit_after_percent, 0), none});
    }
  };
  const bool held_out = anyHeldOut(data.rows);
  const std::string unit = data.gap.rotations ? " / µrad" : " / µm";
  addRms("rms of the rows that were fitted" + unit, data.gap.rms_before_um, data.gap.rms_after_um);
  addFigures("rows fitted", false);
  addRms((held_out ? "rms of the rows held out" : "rms of blocks of rows left out in turn") + unit,
         data.gap.heldout_rms_before_um, data.gap.heldout_rms_after_um);
  if (held_out) addFigures("rows held out", true);
  document.table({"", "before", "after", "noise"}, table,
                 "The gap between measured and simulated; the noise is the floor");
}

void addSteps(Report& document, const DiscrepancyReportData& data) {
  if (data.steps.empty()) return;
  std::vector<ReportRow> rows;
  for (const DiscrepancyStep& step : data.steps) {
    ReportText decision = "added";
    if (!step.accepted) {
      decision = withEffectTitles("not added: " + step.reason);
    } else if (takenOutAgain(step, data.effects)) {
      decision = data.verdict == DiscrepancyVerdict::Unknown
                     ? "added, then taken out again: with it too something remains that no effect explains"
                     : "added, then taken out again";
    }
    rows.push_back({withEffectTitles(step.id), fmt::format("{:.0f}", step.delta_bic), decision});
  }
  document.table({"Effect", "Gain in BIC", "Decision"}, rows, "What was tried, in this order");
}

void addEffect(Report& document, const FoundEffect& effect, bool user_adds, bool held_out, const char* unit) {
  document.subsection(effectHeading(effect.id, effect.title) + (!user_adds      ? ""
                                                                : effect.forced ? " (added to the model)"
                                                                                : " (proposed)"));
  document.paragraph(effect.physics);
  document.paragraph(fmt::format("Driven by {}.", driversInWords(effect.drivers)));
  document.paragraph(
      effect.rivals.empty()
          ? fmt::format("Probability that the name is right: {}.", percentText(effect.confidence))
          : fmt::format("Probability that it or one of its rivals is right: {}.", percentText(effect.confidence)));
  document.paragraph(
      held_out ? fmt::format("Gain in BIC {:.0f}; rms on held-out data {:.2f} {} before, {:.2f} {} after.",
                             effect.delta_bic, effect.heldout_rms_before_um, unit, effect.heldout_rms_after_um, unit)
               : fmt::format("Gain in BIC {:.0f}; rms on blocks left out in turn {:.2f} {} before, {:.2f} {} after.",
                             effect.delta_bic, effect.heldout_rms_before_um, unit, effect.heldout_rms_after_um, unit));
  if (!effect.rivals.empty()) {
    document.callout(CalloutKind::Attention, withEffectTitles(fmt::format("These data cannot distinguish it from {}.",
                                                                          joinedList(effect.rivals, "or"))));
  }
  std::vector<ReportRow> rows;
  for (const FittedParameter& p : effect.parameters) {
    rows.push_back({parameterTitle(p.name) + ' ' + ReportText::smallPrint(p.name),
                    withUncertainty(p.value, p.standard_uncertainty, "")});
  }
  document.table({"Parameter", "Value ± standard uncertainty"}, rows,
                 "Parameters of the " + (effect.title.empty() ? effectTitle(effect.id) : effect.title));
}

void addCandidates(Report& document, const DiscrepancyReportData& data) {
  if (data.candidates.empty()) return;
  std::vector<ReportRow> rows;
  for (const EffectCandidate& candidate : data.candidates) {
    const char* answer = "";
    switch (candidateRole(candidate.id, data.effects)) {
      case CandidateRole::Named:
        answer = "named";
        break;
      case CandidateRole::Rival:
        answer = "rival of what is named";
        break;
      case CandidateRole::Container:
        answer = "holds what is named as a special case";
        break;
      case CandidateRole::None:
        if (candidate.rejected) answer = "rejected by hand";
        break;
    }
    rows.push_back({withEffectTitles(candidate.id), percentText(statedProbability(candidate, data.effects)), answer});
  }
  document.table(
      {"Effect", "Probability", "Answer"}, rows,
      "The most probable effects: of what is named its confidence, of the others the probability that each is "
      "among what is missing, before rivals and the remainder are weighed");
}

/// One figure for displacements and one for rotations, and a table of the states.
void addShifts(Report& document, const std::vector<StateShift>& shifts) {
  if (shifts.empty()) return;
  for (const bool rotations : {false, true}) {
    std::vector<PlotSeries> series;
    for (const Component component : all_components) {
      if (isRotation(component) != rotations) continue;
      PlotSeries s{std::string(toString(component)), {}, {}, {}, SeriesStyle::Points};
      s.dress(componentLook(component));
      for (const StateShift& shift : shifts) {
        if (shift.component != component) continue;
        s.x.push_back(shift.time_s / seconds_per_hour);
        s.y.push_back(shift.shift_um);
        s.sigma.push_back(shift.standard_uncertainty);
      }
      if (!s.x.empty()) series.push_back(std::move(s));
    }
    if (series.empty()) continue;
    const PlotOptions options{.title = "Common shift",
                              .x_label = "time / h",
                              .y_label = rotations ? "shift / µrad" : "shift / µm",
                              .width_px = 860,
                              .height_px = 220};
    document.figure(plotPicture(series, options),
                    "Common shift of all points of a state (re-referencing, refocus), with its standard uncertainty");
  }
  std::vector<Component> components;
  ReportRow header{"State", "Time / h"};
  for (const Component component : all_components) {
    if (std::none_of(shifts.begin(), shifts.end(), [&](const auto& s) { return s.component == component; })) continue;
    components.push_back(component);
    header.push_back(fmt::format("{} / {}", toString(component), printedUnitOf(component)));
  }
  std::map<std::pair<double, std::string>, std::map<Component, const StateShift*>> states;
  for (const StateShift& s : shifts) states[{s.time_s, s.state}][s.component] = &s;
  if (states.size() > most_states_in_table) return;
  std::vector<ReportRow> rows;
  for (const auto& [key, of_state] : states) {
    ReportRow row{key.second, fmt::format("{:.2f}", key.first / seconds_per_hour)};
    for (const Component component : components) {
      const auto found = of_state.find(component);
      row.push_back(found == of_state.end()
                        ? ""
                        : withUncertainty(found->second->shift_um, found->second->standard_uncertainty, ""));
    }
    rows.push_back(std::move(row));
  }
  document.table(header, rows, "Common shift of every state ± standard uncertainty");
}

void addOutliers(Report& document, std::vector<OutlyingObservation> outliers) {
  if (outliers.empty()) return;
  const std::size_t all = outliers.size();
  std::string caption =
      "Outlying readings: they were given little weight; deviation in standard deviations of the noise";
  if (all > most_outliers_in_table) {
    std::stable_sort(outliers.begin(), outliers.end(),
                     [](const auto& a, const auto& b) { return std::abs(a.deviation) > std::abs(b.deviation); });
    outliers.resize(most_outliers_in_table);
    caption += fmt::format(" (the {} largest of {})", most_outliers_in_table, all);
  }
  std::vector<ReportRow> rows;
  for (const OutlyingObservation& o : outliers) {
    rows.push_back({fmt::format("{}", o.row + 1), o.state, o.point, std::string(toString(o.component)),
                    fmt::format("{:.2f}", o.time_s / seconds_per_hour),
                    fmt::format("{} {}", tickText(o.value, 0.01), printedUnitOf(o.component)),
                    tickText(o.deviation, 0.1)});
  }
  document.table({"Row", "State", "Point", "Component", "Time / h", "Value", "Deviation"}, rows, caption);
}

void addNoise(Report& document, const DiscrepancyReportData& data) {
  if (data.noise.empty()) return;
  document.subsection("What was taken as noise");
  const std::string none = "\u2013";
  std::vector<ReportRow> rows;
  for (const NoiseEstimate& n : data.noise) {
    const std::string correlated = n.correlated_part > 0.0 ? fmt::format("{:.0f} % over {}", 100.0 * n.correlated_part,
                                                                         spanOfTime(n.correlation_time_s))
                                                           : none;
    rows.push_back({std::string(toString(n.component)), withUncertainty(n.scale, n.scale_uncertainty, ""),
                    n.common_um > 0.0 ? fmt::format("{:.2f} {}", n.common_um, printedUnitOf(n.component)) : none,
                    correlated});
  }
  document.table({"Component", "Noise scale", "Common shift", "Correlated in time"}, rows,
                 "Noise found in the data. Noise scale: actual over stated standard uncertainty of a reading; common "
                 "shift: its standard deviation from state to state");
  std::string text = data.tail_dof > 0.0
                         ? fmt::format("Tails: Student t with {:.0f} degrees of freedom. ", data.tail_dof)
                         : std::string("Tails: normal distribution. ");
  if (data.clock_offset_uncertainty_s > 0.0) {
    text += fmt::format("The clock of the log is {} {} that of the observations.",
                        withUncertainty(std::abs(data.clock_offset_s), data.clock_offset_uncertainty_s, "s"),
                        data.clock_offset_s >= 0.0 ? "ahead of" : "behind");
  } else {
    text += "These data show no offset between the clocks of log and observations.";
  }
  if (data.outliers.empty()) text += " No reading is an outlier.";
  document.paragraph(text);
  addShifts(document, data.shifts);
  addOutliers(document, data.outliers);
}

/// What remains of each component, and its time history beside what is named.
void addRemainder(Report& document, const DiscrepancyReportData& data) {
  if (data.remainder.empty()) return;
  std::vector<ReportRow> rows;
  for (const ComponentRemainder& r : data.remainder) {
    rows.push_back({std::string(toString(r.component)), fmt::format("{:.2f} {}", r.rms_um, printedUnitOf(r.component)),
                    fmt::format("{:.0f}", r.evidence),
                    r.evidence >= clear_evidence ? "there beside the noise" : "may be noise"});
  }
  document.table({"Component", "rms", "Evidence", "It is"}, rows,
                 "The remainder: what is smooth in time and space and neither effect nor noise; evidence: 2 ln of the "
                 "odds that it is more than noise, clear from 10 on");
  for (const ComponentRemainder& r : data.remainder) {
    if (r.evidence < clear_evidence) continue;
    PlotSeries effects{"effects", {}, {}, {}, SeriesStyle::Points};
    PlotSeries remaining{"remainder", {}, {}, {}, SeriesStyle::Points};
    remaining.marker = PlotMarker::Triangle;
    for (const DiscrepancyReportRow& row : data.rows) {
      if (row.component != r.component || !std::isfinite(row.remaining)) continue;
      if (std::isfinite(row.before - row.after)) {
        effects.x.push_back(row.time_s / seconds_per_hour);
        effects.y.push_back(row.before - row.after);
      }
      remaining.x.push_back(row.time_s / seconds_per_hour);
      remaining.y.push_back(row.remaining);
    }
    if (remaining.x.empty()) continue;
    std::vector<PlotSeries> series;
    if (!data.effects.empty()) series.push_back(std::move(effects));
    series.push_back(std::move(remaining));
    const PlotOptions options{.title = fmt::format("Remainder of {}", toString(r.component)),
                              .x_label = "time / h",
                              .y_label = fmt::format("{} / {}", toString(r.component), printedUnitOf(r.component)),
                              .width_px = 860,
                              .height_px = 220};
    document.figure(plotPicture(series, options),
                    fmt::format("What remains in {} at all points over time{}", toString(r.component),
                                data.effects.empty() ? "" : ", beside what the effects explain"));
  }
}

CalloutKind calloutOf(DiscrepancyVerdict verdict) {
  switch (verdict) {
    case DiscrepancyVerdict::Named:
    case DiscrepancyVerdict::None:
      return CalloutKind::Good;
    case DiscrepancyVerdict::Ambiguous:
      return CalloutKind::Attention;
    case DiscrepancyVerdict::Unknown:
      return CalloutKind::Bad;
  }
  return CalloutKind::Note;
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
  data.candidates = result.candidates;
  data.noise = result.noise;
  data.shifts = result.shifts;
  data.outliers = outlyingObservations(input.observations, result.outliers);
  data.remainder = result.remainder;
  data.tail_dof = result.tail_dof;
  data.clock_offset_s = result.clock_offset_s;
  data.clock_offset_uncertainty_s = result.clock_offset_uncertainty_s;
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
    row.c_deg = o.c_deg;
    const auto sum = sums.find({o.point, o.component});
    if ((sum != sums.end() || input.absolute) && std::isfinite(result.simulated[i])) {
      row.before = o.value - result.simulated[i] - (input.absolute ? 0.0 : sum->second.value / sum->second.weight);
      if (std::isfinite(result.constant[i])) row.after = o.value - result.completed[i] - result.constant[i];
      if (!row.held_out && i < result.remaining.size()) row.remaining = result.remaining[i];
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
  // Without any such row there is none of its values, in the unit of the others.
  const bool any = std::any_of(rows.begin(), rows.end(), counts);
  for (const DiscrepancyReportRow& row : rows) {
    if ((counts(row) || !any) && !isRotation(row.component)) figures.rotations = false;
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

std::vector<OutlyingObservation> outlyingObservations(const ObservationSet& observations,
                                                      const std::vector<OutlyingReading>& outliers) {
  std::vector<OutlyingObservation> out;
  for (const OutlyingReading& reading : outliers) {
    const Observation& o = observations.rows.at(reading.row);
    out.push_back({reading.row, o.time_s, o.state, o.point, o.component, o.value, reading.deviation});
  }
  return out;
}

CandidateRole candidateRole(const std::string& id, const std::vector<FoundEffect>& effects) {
  const auto holds = [&](const std::vector<std::string>& ids) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  CandidateRole role = CandidateRole::None;
  for (const FoundEffect& e : effects) {
    if (e.id == id) return CandidateRole::Named;
    if (holds(e.rivals)) role = CandidateRole::Rival;
    if (holds(e.containers) && role == CandidateRole::None) role = CandidateRole::Container;
  }
  return role;
}

double statedProbability(const EffectCandidate& candidate, const std::vector<FoundEffect>& effects) {
  const auto named =
      std::find_if(effects.begin(), effects.end(), [&](const FoundEffect& e) { return e.id == candidate.id; });
  return named == effects.end() ? candidate.probability : named->confidence;
}

bool takenOutAgain(const DiscrepancyStep& step, const std::vector<FoundEffect>& effects) {
  return step.accepted &&
         std::none_of(effects.begin(), effects.end(), [&](const FoundEffect& e) { return e.id == step.id; });
}

void addDiscrepancyStory(Report& document, const DiscrepancyReportData& result, const std::optional<FieldGrid>& table) {
  document.callout(calloutOf(result.verdict), discrepancyHeadline(result));
  addGap(document, result);
  const bool held_out = anyHeldOut(result.rows);
  for (const FoundEffect& effect : result.effects)
    addEffect(document, effect, result.user_adds, held_out, result.gap.rotations ? "µrad" : "µm");
  addCandidates(document, result);
  if (!result.leftover.empty()) {
    document.callout(result.effects.empty() ? CalloutKind::Bad : CalloutKind::Attention,
                     withEffectTitles(fmt::format("Remainder: {}.", result.leftover)));
  }
  addRemainder(document, result);
  if (result.suggestion) {
    const MeasurementSuggestion& next = *result.suggestion;
    document.subsection("Measure next");
    document.paragraph(withEffectTitles(fmt::format("To distinguish {}: {}.", next.separates, next.conditions)));
    std::vector<ReportRow> steps;
    for (const ProgrammeStep& step : next.programme) {
      steps.push_back(
          {fmt::format("{:.2f} to {:.2f}", step.from_s / seconds_per_hour, step.to_s / seconds_per_hour), step.action});
    }
    if (!steps.empty()) {
      document.table({"Time / h", "Program"}, steps, "What the machine does, from its start after a night at rest");
      document.paragraph(
          fmt::format("Expected information gain {:.2f} of {:.2f} nat; probability of a unique result afterwards "
                      "{:.2f}, probability of the leading explanation now {:.2f}.",
                      next.expected_information_nats, next.present_entropy_nats, next.probability_alone_expected,
                      next.probability_alone_now));
    }
  }
  if (!result.where.empty()) {
    std::vector<ReportRow> rows;
    for (const DisagreementPlace& place : result.where) {
      rows.push_back({std::string(toString(place.component)), shortenedList(place.points, 12),
                      fmt::format("{:.1f} to {:.1f}", place.from_s / seconds_per_hour, place.to_s / seconds_per_hour),
                      place.condition, fmt::format("{:.2f} {}", place.excess_um, printedUnitOf(place.component)),
                      probabilityText(place.p_value)});
    }
    document.table({"Component", "Points", "Time / h", "Condition", "Beyond the noise", "p"}, rows,
                   "Where measured and simulated disagree; p: probability of so much by chance, for all places looked "
                   "at together");
  }
  addNoise(document, result);
  if (table && !result.effects.empty()) addDiscrepancyMaps(document, result.rows, *table, "completed model");
  addTimeHistories(document, result.rows, "completed model");
  addPoints(document, result.rows);
  addSteps(document, result);
  for (const std::string& warning : result.warnings) document.paragraph(withEffectTitles("Note: " + warning));
  document.paragraph(
      "rms: root mean square of the residual, each series about its own constant, which is fitted anew with every "
      "model. Fit: 100 % is perfect, 0 % no better than a constant for each series. BIC: Bayesian information "
      "criterion; a gain above 10 is strong evidence for the effect. Held out: rows that took no part in the choice.");
}

ReportText discrepancyHeadline(const DiscrepancyReportData& data) {
  return withEffectTitles(data.message);
}

Report discrepancyDocument(const std::string& campaign, const DiscrepancyReportData& data,
                           const std::optional<FieldGrid>& table) {
  Report document(fmt::format("Discrepancy: {}", campaign),
                  "where measured and simulated disagree, which effect is missing, what its addition gains");
  addDiscrepancyStory(document, data, table);
  return document;
}

}  // namespace spindrift
