// SPDX-License-Identifier: Apache-2.0
#include "core/plant/plant_overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/base/count_text.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/utc_time.h"
#include "core/math/statistics.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report.h"

namespace spindrift {
namespace {

constexpr double day_s = 86'400.0;

std::string number(double value) {
  return exactNumber(value);
}

nlohmann::json timeOrNull(double time_s) {
  return time_s > 0.0 ? nlohmann::json(utcText(time_s)) : nlohmann::json();
}

}  // namespace

std::string MachineState::dueSentence() const {
  if (every_days <= 0.0) return machine.campaigns == 0 ? "never measured" : "no interval known";
  const std::string every =
      fmt::format("every {:g} days{}", std::round(10.0 * every_days) / 10.0, every_is_said ? "" : " so far");
  if (machine.campaigns == 0) return "never measured, " + every;
  if (overdue_days > 0.0)
    return fmt::format("due for {}, {}", countOf(static_cast<long>(std::ceil(overdue_days)), "day"), every);
  return fmt::format("due on {}, {}", utcDay(due_s), every);
}

std::vector<MachineState> plantOverview(PlantStore& store, double now_s) {
  std::vector<MachineState> states;
  std::map<std::string, std::vector<double>> starts = store.starts();
  for (const PlantMachine& machine : store.machines()) {
    MachineState s;
    s.machine = machine;
    s.every_is_said = machine.every_days > 0.0;
    s.every_days = machine.every_days;
    const std::vector<double>& times = starts[machine.name];
    if (!s.every_is_said && times.size() >= 3) {
      std::vector<double> gaps;
      for (std::size_t i = 1; i < times.size(); ++i) gaps.push_back((times[i] - times[i - 1]) / day_s);
      s.every_days = median(gaps);
    }
    if (s.every_days > 0.0 && machine.campaigns > 0) {
      s.due_s = machine.last_s + s.every_days * day_s;
      s.overdue_days = (now_s - s.due_s) / day_s;
    } else if (s.every_is_said) {
      s.overdue_days = 1e-9;
    }
    states.push_back(std::move(s));
  }
  // Overdue ones by how long in their own intervals; the others by when they are due; those without an interval last.
  std::stable_sort(states.begin(), states.end(), [](const MachineState& a, const MachineState& b) {
    const auto urgency = [](const MachineState& s) {
      return s.every_days > 0.0 ? s.overdue_days / s.every_days : -1e9;
    };
    return urgency(a) > urgency(b);
  });
  return states;
}

nlohmann::json toJson(const MachineState& s) {
  return {{"name", s.machine.name},
          {"campaigns", s.machine.campaigns},
          {"first_utc", timeOrNull(s.machine.first_s)},
          {"last_utc", timeOrNull(s.machine.last_s)},
          {"last_verdict", s.machine.last_verdict.empty() ? nlohmann::json() : nlohmann::json(s.machine.last_verdict)},
          {"every_days", s.every_days > 0.0 ? nlohmann::json(s.every_days) : nlohmann::json()},
          {"every_is_said", s.every_is_said},
          {"due_utc", timeOrNull(s.due_s)},
          {"overdue_days", s.every_days > 0.0 ? jsonNumber(std::max(0.0, s.overdue_days)) : nlohmann::json()}};
}

MachineTrend machineTrend(PlantStore& store, const std::string& machine, const std::string& parameter,
                          const std::string& state, const ChartOptions& options) {
  MachineTrend trend;
  trend.machine = machine;
  std::vector<std::string> names;
  for (const TrendName& n : store.trendNames(machine)) {
    const std::string full = n.kind + "/" + n.name;
    names.push_back(full);
    if (parameter != full && parameter != n.name) continue;
    if (!trend.kind.empty())
      throw InputError(fmt::format("{} is a parameter of several kinds of results of {}; allowed: {}/{} or {}.",
                                   parameter, machine, trend.kind, trend.name, full));
    trend.kind = n.kind;
    trend.name = n.name;
  }
  if (trend.kind.empty())
    throw InputError(fmt::format("{} has no parameter \"{}\"; allowed: {}.", machine, parameter,
                                 names.empty() ? "none yet, none of its results has any" : shortenedList(names)));
  trend.events = store.events(machine);
  trend.chart = controlChart(store.trend(machine, trend.kind, trend.name, state), trend.events, trend.name, options);
  return trend;
}

nlohmann::json MachineTrend::json() const {
  nlohmann::json out = chart.json();
  out["machine"] = machine;
  out["kind"] = kind;
  out["parameter"] = name;
  out["events"] = nlohmann::json::array();
  for (const MachineEvent& e : events)
    out["events"].push_back(
        {{"time_utc", utcText(e.time_s)}, {"kind", e.kind}, {"note", e.note}, {"author", e.author}});
  return out;
}

std::string MachineTrend::summary() const {
  std::string text = fmt::format("{}: {} of {}, {}\n", machine, name, kind, countOf(chart.points.size(), "value"));
  if (!chart.points.empty()) {
    const ChartPoint& last = chart.points.back();
    text +=
        fmt::format("last: {} on {}\n", withUncertainty(last.point.value, last.point.standard_uncertainty, chart.unit),
                    utcDay(last.point.time_s));
    if (chart.limits)
      text += fmt::format("limits {:.4g} to {:.4g} {}: {}\n", last.lower, last.upper, printedUnit(chart.unit),
                          chart.inControl() ? "inside"
                          : last.outside    ? "outside"
                                            : "inside, but the moving average (EWMA) is outside of its own");
  }
  for (const NamedChange& c : chart.changes) text += c.sentence(chart.unit) + "\n";
  if (chart.changes.empty() && chart.notes.empty()) text += "no change that is more than chance\n";
  for (const std::string& note : chart.notes) text += note + "\n";
  return text;
}

std::string MachineTrend::csv() const {
  std::string out =
      "time_utc,campaign,value,standard_uncertainty,centre,lower,upper,ewma,ewma_lower,ewma_upper,outside,"
      "ewma_outside\n";
  for (const ChartPoint& p : chart.points) {
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", utcText(p.point.time_s),
                       csvField(p.point.campaign_name), number(p.point.value), number(p.point.standard_uncertainty),
                       number(p.centre), number(p.lower), number(p.upper), number(p.ewma), number(p.ewma_lower),
                       number(p.ewma_upper), p.outside ? 1 : 0, p.ewma_outside ? 1 : 0);
  }
  return out;
}

ModelState modelState(PlantStore& store, const std::string& machine, const ChartOptions& options) {
  ModelState state;
  state.model = store.newestModel(machine);
  if (!state.model) return state;
  const double since_s = state.model->time_s;
  const std::vector<MachineEvent> events = store.events(machine);
  for (const MachineEvent& e : events) {
    if (e.time_s > since_s && changesMachine(e.kind))
      state.reasons.push_back(fmt::format("{} was entered for {}, after the model's campaign {}", eventWords(e.kind),
                                          utcDay(e.time_s), state.model->campaign_name));
  }
  for (const TrendName& n : store.trendNames(machine)) {
    if (n.kind == state.model->kind && n.kind != "evaluate") continue;  // what the model itself was made from
    const ControlChart chart = controlChart(store.trend(machine, n.kind, n.name), events, n.name, options);
    for (const NamedChange& c : chart.changes) {
      if (c.kind != ChangeKind::SingleValue && c.to_s > since_s)
        state.reasons.push_back(fmt::format("{}: {}", n.name, c.sentence(chart.unit)));
    }
  }
  for (const PlantListing& c : store.campaigns(machine)) {
    if (c.start_s <= since_s) continue;
    if (c.verdict == "named" || c.verdict == "unknown" || c.verdict == "ambiguous" || c.verdict == "not_met")
      state.reasons.push_back(
          fmt::format("campaign {} of {} has the verdict \"{}\"", c.name, utcDay(c.start_s), c.verdict));
  }
  return state;
}

CampaignComparison compareCampaigns(PlantStore& store, const std::vector<std::int64_t>& campaigns) {
  if (campaigns.size() < 2) throw InputError("One campaign cannot be compared; allowed: two or more.");
  CampaignComparison out;
  for (const std::int64_t id : campaigns) out.campaigns.push_back(store.campaign(id));
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> places;
  for (std::size_t c = 0; c < out.campaigns.size(); ++c) {
    // Of several results of a kind the newest, as in trends.
    std::map<std::string, const PlantResult*> newest;
    for (const PlantResult& r : out.campaigns[c].results) newest[r.kind] = &r;
    for (const auto& [kind, result] : newest) {
      for (const PlantParameter& p : result->parameters) {
        const auto [at, added] = places.try_emplace({kind, p.state, p.name}, out.rows.size());
        if (added)
          out.rows.push_back(
              {kind, p.state, p.name, std::vector<std::optional<CampaignComparison::Entry>>(campaigns.size()), 0.0});
        out.rows[at->second].entries[c] = CampaignComparison::Entry{p.value, p.standard_uncertainty};
      }
    }
  }
  for (CampaignComparison::ComparedRow& row : out.rows) {
    const auto first =
        std::find_if(row.entries.begin(), row.entries.end(), [](const auto& e) { return e.has_value(); });
    for (auto e = std::next(first); e != row.entries.end(); ++e) {
      if (!e->has_value()) continue;
      const double u = std::hypot((*first)->standard_uncertainty, (*e)->standard_uncertainty);
      if (u > 0.0) row.largest = std::max(row.largest, std::abs((*e)->value - (*first)->value) / u);
    }
  }
  return out;
}

nlohmann::json CampaignComparison::json() const {
  nlohmann::json out = {{"campaigns", nlohmann::json::array()}, {"parameters", nlohmann::json::array()}};
  for (const PlantCampaign& c : campaigns)
    out["campaigns"].push_back({{"machine", c.machine}, {"name", c.name}, {"start_utc", utcText(c.start_s)}});
  for (const ComparedRow& row : rows) {
    nlohmann::json values = nlohmann::json::array();
    for (const auto& e : row.entries) {
      values.push_back(e ? nlohmann::json({{"value", jsonNumber(e->value)},
                                           {"standard_uncertainty", jsonNumber(e->standard_uncertainty)}})
                         : nlohmann::json());
    }
    out["parameters"].push_back({{"kind", row.kind},
                                 {"state", row.state},
                                 {"parameter", row.name},
                                 {"values", values},
                                 {"largest_difference_in_sigma", jsonNumber(row.largest)}});
  }
  return out;
}

std::string CampaignComparison::summary() const {
  std::string text;
  for (std::size_t c = 0; c < campaigns.size(); ++c)
    text +=
        fmt::format("{}: {} of {}, {}\n", c + 1, campaigns[c].name, campaigns[c].machine, utcDay(campaigns[c].start_s));
  for (const ComparedRow& row : rows) {
    text += fmt::format("{:<28} {:<8}", row.kind + "/" + row.name, row.state);
    for (const auto& e : row.entries)
      text += fmt::format(" {:>20}", e ? withUncertainty(e->value, e->standard_uncertainty, "") : "-");
    if (row.largest > 0.0) text += fmt::format("  {:.1f} sigma", row.largest);
    text += "\n";
  }
  return text;
}

MachineReport machineReport(PlantStore& store, const std::string& machine, double now_s) {
  ReportNames names;
  names.within.push_back(machine);
  Report document(machine, "Machine of the plant, as of " + utcDay(now_s));
  for (const MachineState& s : plantOverview(store, now_s)) {
    if (s.machine.name != machine) continue;
    document.section("State");
    document.facts({{"Campaigns", std::to_string(s.machine.campaigns)},
                    {"Last measured", s.machine.last_s > 0.0 ? utcDay(s.machine.last_s) : "never"},
                    {"Last verdict", s.machine.last_verdict.empty() ? "none" : s.machine.last_verdict},
                    {"Next", s.dueSentence()}});
  }
  (void)store.machine(machine);
  const ModelState model = modelState(store, machine, {});
  if (model.model) {
    names.within.push_back(model.model->campaign_name);
    document.callout(model.reasons.empty() ? CalloutKind::Good : CalloutKind::Attention,
                     model.reasons.empty()
                         ? fmt::format("The model of campaign {} ({}) holds.", model.model->campaign_name,
                                       utcDay(model.model->time_s))
                         : fmt::format("The model of campaign {} ({}) no longer holds: {}.", model.model->campaign_name,
                                       utcDay(model.model->time_s), model.reasons.front()));
  }
  const std::vector<MachineEvent> events = store.events(machine);
  if (!events.empty()) {
    document.section("Events");
    std::vector<ReportRow> rows;
    for (const MachineEvent& e : events) {
      rows.push_back({utcDay(e.time_s), e.kind, e.note, e.author});
      names.whole.insert(names.whole.end(), {e.note, e.author});
    }
    document.table({"Date", "What", "Note", "Entered by"}, rows);
  }
  document.section("Trends");
  for (const TrendName& n : store.trendNames(machine)) {
    const MachineTrend trend = machineTrend(store, machine, n.kind + "/" + n.name, {}, {});
    if (trend.chart.points.size() < 2) continue;
    PlotSeries measured{n.name, {}, {}, {}, SeriesStyle::Points};
    PlotSeries lower{"control limits", {}, {}, {}, SeriesStyle::Step};
    PlotSeries upper{"", {}, {}, {}, SeriesStyle::Step};
    lower.colour = upper.colour = "#8a8a8a";
    const double first_s = trend.chart.points.front().point.time_s;
    for (const ChartPoint& p : trend.chart.points) {
      const double t = (p.point.time_s - first_s) / day_s;
      measured.x.push_back(t);
      measured.y.push_back(p.point.value);
      measured.sigma.push_back(p.point.standard_uncertainty);
      if (p.lower == p.upper) continue;
      lower.x.push_back(t);
      lower.y.push_back(p.lower);
      upper.x.push_back(t);
      upper.y.push_back(p.upper);
    }
    PlotOptions options;
    options.title = n.name + " (" + n.kind + ")";
    options.x_label = "time since " + utcDay(first_s) + " / d";
    options.y_label = n.name + " / " + (trend.chart.unit.empty() ? "1" : printedUnit(trend.chart.unit));
    std::string caption;
    for (const NamedChange& c : trend.chart.changes)
      caption += (caption.empty() ? "" : "; ") + c.sentence(trend.chart.unit);
    if (caption.empty()) caption = "No change that is more than chance";
    document.figure(plotPicture({measured, lower, upper}, options), caption + ".");
  }
  return {std::move(document), std::move(names)};
}

}  // namespace spindrift
