// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/report_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/base/count_text.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/units.h"
#include "core/imaging/fiducial_captures.h"
#include "core/machine/driver_words.h"
#include "core/probing/touch.h"
#include "core/reporting/contact_sheet.h"
#include "core/reporting/plot_picture.h"
#include "core/scanning/scan_picture.h"
#include "core/workflows/compensated_data.h"
#include "core/workflows/instrument_checks.h"
#include "core/workflows/log_campaign.h"
#include "core/workflows/thermal_tests.h"

namespace spindrift {
namespace {

constexpr std::size_t most_thumbnails = 24;

double numberOf(const nlohmann::json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number() ? at->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string textOf(const nlohmann::json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_string() ? at->get<std::string>() : std::string();
}

std::string numberText(double value, std::string_view unit, int decimals) {
  if (!std::isfinite(value)) return "not determined";
  const std::string number = tickText(value, std::pow(10.0, -decimals));
  return unit.empty() ? number : number + ' ' + printedUnit(unit);
}

/// Every n-th of the items, so that at most `most` are left, the first among them.
template <class T>
std::vector<T> spread(const std::vector<T>& items, std::size_t most) {
  if (items.size() <= most) return items;
  std::vector<T> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(items[i * items.size() / most]);
  return out;
}

/// Pictures on a sheet; what has none is named in one sentence. `files` in the order of the thumbnails.
void addSheet(Report& document, const std::vector<Thumbnail>& thumbnails, const std::vector<std::string>& files,
              const std::string& caption) {
  std::vector<Thumbnail> there;
  std::vector<std::string> gone;
  for (std::size_t i = 0; i < thumbnails.size(); ++i) {
    if (thumbnails[i].jpeg.empty()) {
      gone.push_back(files[i]);
    } else {
      there.push_back(thumbnails[i]);
    }
  }
  if (!there.empty()) document.figure(contactSheet(there), caption);
  if (gone.empty()) return;
  constexpr std::size_t most_named = 3;
  const std::size_t count = gone.size();
  if (count > most_named) {
    gone.resize(most_named);
    gone.push_back(fmt::format("{} more", count - most_named));
  }
  document.callout(CalloutKind::Attention, fmt::format("{} of {} left out, because missing or not readable: {}.", count,
                                                       countOf(thumbnails.size(), "picture"), joinedList(gone)));
}

/// What an image was taken for.
std::string roleTitle(const std::string& role) {
  if (role == "x_axis") return "along X";
  if (role == "y_axis") return "along Y";
  return words(role);
}

void addImages(Report& document, const Campaign& campaign, const std::filesystem::path& list, const JobContext& job) {
  const FiducialCaptureList captures = readFiducialCaptures(list);
  std::vector<ReportRow> rows;
  std::vector<FiducialCapture> first;
  for (const std::string& state : captures.states()) {
    std::map<std::string, std::size_t> by_role;
    std::set<std::string> fiducials;
    std::size_t excluded = 0;
    double from = 1e300, to = -1e300;
    for (const FiducialCapture& c : captures.captures) {
      if (c.state != state) continue;
      if (fiducials.insert(c.fiducial).second) first.push_back(c);
      ++by_role[std::string(toString(c.role))];
      if (campaign.excluded_captures.contains(c.image)) ++excluded;
      from = std::min(from, c.time_s);
      to = std::max(to, c.time_s);
    }
    std::string roles;
    for (const auto& [role, count] : by_role)
      roles += fmt::format("{}{} {}", roles.empty() ? "" : ", ", count, roleTitle(role));
    rows.push_back({state, std::to_string(fiducials.size()), roles, std::to_string(excluded),
                    fmt::format("{:.2f} to {:.2f}", from / seconds_per_hour, to / seconds_per_hour)});
  }
  document.table({"State", "Fiducials", "Images", "Taken out", "Time / h"}, rows, "Images of fiducials");
  std::vector<Thumbnail> thumbnails;
  std::vector<std::string> files;
  for (const FiducialCapture& c : spread(first, most_thumbnails)) {
    files.push_back(c.image);
    job.throwIfCancelled();
    thumbnails.push_back({imageThumbnail(campaign.path(c.image)), fmt::format("{} {}", c.state, c.fiducial),
                          std::filesystem::path(c.image).filename().string()});
  }
  addSheet(document, thumbnails, files,
           first.size() > thumbnails.size()
               ? fmt::format("The first image of {} of {} fiducials and states", thumbnails.size(), first.size())
               : std::string("The first image of every fiducial and state"));
}

/// Range of a count: "60" or "58 to 60".
std::string countText(std::size_t from, std::size_t to) {
  return from == to ? std::to_string(from) : fmt::format("{} to {}", from, to);
}

void addTouches(Report& document, const std::filesystem::path& list) {
  const TouchList touches = TouchList::read(list);
  struct Artefact {
    std::map<std::string, std::size_t> cycles;
    std::set<std::string> features;
    PlotSeries first{{}, {}, {}, {}, SeriesStyle::Points};
    std::string first_cycle;
    double from = 1e300, to = -1e300;
  };
  std::map<std::string, Artefact> artefacts;
  for (const Touch& t : touches.touches) {
    Artefact& a = artefacts[t.artefact];
    if (a.cycles.empty()) a.first_cycle = t.cycle;
    ++a.cycles[t.cycle];
    a.features.insert(t.feature);
    a.from = std::min(a.from, t.time_s);
    a.to = std::max(a.to, t.time_s);
    if (t.cycle != a.first_cycle) continue;
    a.first.x.push_back(t.position_mm.x());
    a.first.y.push_back(t.position_mm.y());
  }
  std::vector<ReportRow> rows;
  std::vector<PlotSeries> seen;
  for (auto& [name, a] : artefacts) {
    std::size_t least = touches.touches.size(), most = 0;
    for (const auto& [cycle, count] : a.cycles) {
      least = std::min(least, count);
      most = std::max(most, count);
    }
    rows.push_back({name, std::to_string(a.cycles.size()), countText(least, most), std::to_string(a.features.size()),
                    fmt::format("{:.2f} to {:.2f}", a.from / seconds_per_hour, a.to / seconds_per_hour)});
    a.first.name = fmt::format("{} {}", name, a.first_cycle);
    seen.push_back(std::move(a.first));
  }
  document.table({"Artefact", "Cycles", "Touches a cycle", "Features", "Time / h"}, rows, "Measuring cycles");
  PlotOptions options;
  options.x_label = "X / mm";
  options.y_label = "Y / mm";
  options.width_px = 600;
  options.height_px = 340;
  options.equal_scale = true;
  document.figure(plotPicture(seen, options), "Where the touches of the first cycle are, machine coordinates");
}

void addScans(Report& document, const Campaign& campaign, const JobContext& job) {
  const std::vector<ScanCapture> scans = readScanList(campaign);
  std::map<std::string, std::size_t> counts;
  std::vector<ScanCapture> first;
  for (const ScanCapture& s : scans)
    if (counts[s.artefact]++ == 0) first.push_back(s);
  std::vector<ReportRow> rows;
  std::vector<Thumbnail> thumbnails;
  std::vector<std::string> files;
  for (const ScanCapture& s : first)
    rows.push_back({s.artefact, fmt::format("{:g}", s.y_mm), std::to_string(counts[s.artefact])});
  document.table({"Artefact", "Position / mm", "Scans"}, rows, "Scans");
  const std::string model = campaign.machine.profiler ? campaign.machine.profiler->scan_model : "rigid";
  for (const ScanCapture& s : spread(first, 12)) {
    job.throwIfCancelled();
    Thumbnail t{{}, s.artefact + " " + s.cycle, {}};
    files.push_back(s.cloud);
    try {
      const ScanPicture picture = pictureOfScan(campaign, s.cloud, {}, ScanColouring::Height,
                                                scanModelFromString(model), job, ScanPart::AsUsed);
      t.jpeg = cloudThumbnail(*picture.xyz_mm, *picture.scalar, picture.low, picture.high);
      t.comment = fmt::format("z {:.2f} to {:.2f} mm", picture.low, picture.high);
    } catch (const InputError&) {
      t.jpeg.clear();
    }
    thumbnails.push_back(std::move(t));
  }
  addSheet(document, thumbnails, files, "The first scan of every artefact from above, coloured by height");
}

void addCheck(std::vector<ReportRow>& rows, const char* name, const nlohmann::json& check, const StoredResults& stored,
              const char* kind) {
  if (!check.is_object()) return;
  const bool passed = check.value("passed", check.value("settled", false));
  const bool decided = check.value("status", std::string("converged")) == toString(FitStatus::Converged);
  std::string reason = textOf(check, "reason");
  if (reason.empty() && textOf(check, "by") == "operator") reason = "stated by the operator, not measured";
  if (const auto changed = stored.changed.find(kind); changed != stored.changed.end())
    reason = fmt::format("outdated, changed since: {}. {}", changed->second, reason);
  rows.push_back({name, passed ? "passed" : decided ? "not passed" : "not decided", reason});
}

/// What a model over time predicts; empty where the result does not say it.
SignalTitle outputOf(const nlohmann::json& thermal) {
  const nlohmann::json model = thermal.value("model", nlohmann::json::object());
  const nlohmann::json outputs = model.is_object() ? model.value("outputs", nlohmann::json::array()) : nlohmann::json();
  if (!outputs.is_array() || outputs.empty()) return {};
  return signalTitle(textOf(outputs.front(), "name"));
}

void addStepResponses(Report& document, const nlohmann::json& responses) {
  std::vector<ReportRow> rows;
  for (const nlohmann::json& r : responses) {
    const SignalTitle title = signalTitle(textOf(r, "input"));
    rows.push_back(
        {title.name, fmt::format("{:g} {}", numberOf(r, "step"), title.unit == "°C" ? "K" : title.unit),
         withUncertainty(numberOf(r, "final_value"), numberOf(r, "final_standard_uncertainty"), textOf(r, "unit")),
         spanOfTime(numberOf(r, "time_to_63_percent_s"))});
  }
  if (!rows.empty()) {
    document.table({"Input", "Step", "End value of the response", "63 % after"}, rows,
                   "Step responses of the model, end value ± one standard uncertainty");
  }
}

}  // namespace

void addPlan(Report& document, const nlohmann::json& plan_json, const Campaign& campaign) {
  if (!plan_json.is_object()) return;
  const MeasurementPlan plan = MeasurementPlan::parse(JsonNode::parse(plan_json.dump(), "the plan of the session"));
  if (plan.empty()) return;
  const std::set<std::string> done = capturedItems(plan, campaign);
  document.section("Measurement plan");
  std::vector<ReportRow> rows;
  std::size_t missing = 0;
  for (const PlannedState& state : plan.states) {
    std::size_t planned = 0, captured = 0;
    for (const PlannedItem& item : plan.items) {
      if (item.state != state.name) continue;
      ++planned;
      if (done.contains(item.id)) ++captured;
    }
    missing += planned - captured;
    rows.push_back({state.name + (state.what.empty() ? "" : ", " + state.what),
                    fmt::format("{:.2f}", state.due_s / seconds_per_hour), std::to_string(planned),
                    std::to_string(captured)});
  }
  document.table({"State", "Due / h", "Planned", "Captured"}, rows, "Planned and captured items per thermal state");
  if (missing > 0)
    document.callout(CalloutKind::Attention,
                     fmt::format("Not captured: {} of {}.", missing, countOf(plan.items.size(), "planned item")));
}

void addCaptures(Report& document, const Campaign& campaign, const JobContext& job) {
  const auto images = campaign.captureList("fiducials.csv");
  const auto touches = campaign.captureList("touches.csv");
  const auto scans = campaign.captureList("scans.csv");
  if (!images && !touches && !scans) return;
  document.section("Captures");
  if (images) addImages(document, campaign, *images, job);
  if (touches) addTouches(document, *touches);
  if (scans) addScans(document, campaign, job);
}

void addOutdated(Report& document, const StoredResults& stored, const std::string& kind) {
  if (const auto changed = stored.changed.find(kind); changed != stored.changed.end())
    document.callout(CalloutKind::Attention,
                     fmt::format("Outdated. Changed since the calculation: {}.", changed->second));
}

void addInstrumentState(Report& document, const StoredResults& stored, bool has_observations) {
  std::vector<ReportRow> rows;
  addCheck(rows, "Warm-up, measured", stored.warm_up, stored, "check-warm-up");
  addCheck(rows, "Warm-up, stated", stored.warm_statement, stored, "");
  addCheck(rows, "Jogs", stored.jogs, stored, "check-jogs");
  addCheck(rows, "Cold repeatability", stored.repeatability, stored, "check-repeatability");
  const bool judged = stored.warm_up.is_object() && textOf(stored.warm_up, "status") == toString(FitStatus::Converged);
  const bool unchecked = has_observations && !judged && !stored.warm_statement.is_object();
  if (rows.empty() && !unchecked) return;
  document.section("State of the instrument");
  if (unchecked) document.callout(CalloutKind::Attention, "Warm-up: " + warmUpNotChecked());
  if (judged && !stored.warm_up.value("settled", false)) {
    if (const std::string cause = textOf(stored.warm_up, "cause_reason"); !cause.empty())
      document.callout(CalloutKind::Attention, "Warm-up: " + cause);
  }
  if (!rows.empty()) document.table({"Check", "Verdict", "Reason"}, rows);
}

void addThermalModel(Report& document, const StoredResults& stored) {
  const nlohmann::json& thermal = stored.thermal;
  if (!thermal.is_object() || !thermal.contains("train")) return;
  document.section("Model over time");
  addOutdated(document, stored, "thermal");
  std::vector<std::string> inputs;
  for (const nlohmann::json& in : thermal.value("inputs", nlohmann::json::array()))
    inputs.push_back(signalTitle(in.get<std::string>()).name);
  const SignalTitle output = outputOf(thermal);
  const std::string& unit = output.unit;
  document.paragraph(fmt::format("{}Inputs: {}. Quality in free run, without looking at the measured output.",
                                 output.name.empty() ? "" : "Output: " + output.name + ". ", joinedList(inputs)));
  std::vector<ReportRow> rows;
  const auto add = [&](const std::string& name, const nlohmann::json& train, const nlohmann::json& test) {
    rows.push_back({name, numberText(numberOf(train, "rmse"), "", 2), numberText(numberOf(test, "rmse"), "", 2),
                    numberText(numberOf(test, "fit_percent"), "%", 1), numberText(numberOf(test, "p2p"), "", 2)});
  };
  add("this model", thermal["train"], thermal["test"]);
  for (const nlohmann::json& p : thermal.value("plain_models", nlohmann::json::array()))
    add(textOf(p, "name"), p.at("train"), p.at("test"));
  document.table(
      {"Model", "rms in training", "rms in the test", "Fit in the test", "Peak to peak in the test"}, rows,
      fmt::format("Quality of the model and of plain ones{}; fit: 100 % is perfect, 0 % no better than the mean",
                  unit.empty() ? "" : ", in " + unit));
  addStepResponses(document, thermal.value("step_response", nlohmann::json::array()));
  if (!thermal.value("good_enough", true))
    document.callout(CalloutKind::Attention,
                     "In the test range the model is no better than a plain one: do not use it for compensation.");
}

void addStandardTest(Report& document, const nlohmann::json& test, const Drawing& diagram,
                     const StoredResults& stored) {
  const nlohmann::json components = test.value("components", nlohmann::json::array());
  if (components.empty()) return;
  const bool spindle = textOf(test, "test") == "spindle";
  document.section(spindle ? "ISO 230-3: thermal distortion caused by the rotating spindle"
                           : "ISO 230-3: environmental temperature variation error");
  addOutdated(document, stored, "iso-230-3");
  std::vector<ReportRow> rows;
  for (const nlohmann::json& c : components) {
    const std::string name = signalTitle(textOf(c, "name")).name;
    const std::string unit = textOf(c, "unit");
    const auto known = [&](const char* value, const char* sigma, const std::string& in) {
      return std::isfinite(numberOf(c, value)) ? withUncertainty(numberOf(c, value), numberOf(c, sigma), in)
                                               : std::string("not determined");
    };
    if (spindle) {
      rows.push_back({name, known("first_hour", "first_hour_standard_uncertainty", unit),
                      known("first_hour_range", "first_hour_range_standard_uncertainty", unit),
                      known("at_end", "standard_uncertainty", unit), known("range", "range_standard_uncertainty", unit),
                      numberText(numberOf(c, "time_to_fraction_s") / 60.0, "min", 0)});
    } else {
      rows.push_back({name, known("range", "range_standard_uncertainty", unit),
                      known("range_per_K", "range_per_K_standard_uncertainty", unit + "/K"),
                      known("slope_per_K", "slope_standard_uncertainty", unit + "/K")});
    }
  }
  if (spindle) {
    document.paragraph(fmt::format("The spindle ran from {:.2f} h to {:.2f} h; changes are relative to its start.",
                                   numberOf(test, "start_s") / seconds_per_hour,
                                   numberOf(test, "stop_s") / seconds_per_hour));
    document.table({"Component", "After 60 min", "Range in 60 min", "At the end", "Range",
                    fmt::format("{:.0f} % of the end after", 100.0 * numberOf(test, "fraction"))},
                   rows, "Parameters of the rotating spindle test");
  } else {
    document.paragraph(fmt::format("Over {:.1f} h, ambient temperature range {:.2f} K.",
                                   numberOf(test, "duration_s") / seconds_per_hour,
                                   numberOf(test, "temperature_range_K")));
    document.table({"Component", "Range", "Range per K", "Slope on the ambient temperature"}, rows,
                   "Parameters of the ETVE test");
  }
  document.figure(diagram, "Readings of the test over time");
  for (const nlohmann::json& note : test.value("notes", nlohmann::json::array()))
    document.paragraph(note.get<std::string>());
}

/// What remains where nothing was fitted: "2.10 µm (before 24.30 µm), at F6, held out".
std::string unseenText(const nlohmann::json& plan) {
  const nlohmann::json unseen = plan.value("unseen", nlohmann::json());
  if (!unseen.is_object()) return "not known";
  const std::string what = textOf(unseen, "what");
  if (!unseen.value("rms_after_um", nlohmann::json()).is_number()) return what;
  return fmt::format("{} (before {}), {}", numberText(numberOf(unseen, "rms_after_um"), "um", 2),
                     numberText(numberOf(unseen, "rms_before_um"), "um", 2), what);
}

void addCompensation(Report& document, const StoredResults& stored) {
  const nlohmann::json& plan = stored.compensation;
  if (!plan.is_object() || !plan.contains("points")) return;
  document.section("Compensation");
  addOutdated(document, stored, "compensation");
  if (!plan.value("good_enough", true)) document.callout(CalloutKind::Bad, textOf(plan, "message"));
  document.paragraph(fmt::format("{}, relative to {}. Compensation = −deviation: what is added to the command.",
                                 textOf(plan, "model"), textOf(plan, "reference")));
  document.facts(
      {{"State", textOf(plan, "state")},
       {"rms of the measured deviations before", numberText(numberOf(plan, "rms_before_um"), "um", 2)},
       {"rms expected with the correction", numberText(numberOf(plan, "rms_after_um"), "um", 2)},
       {"The same on data not used for fitting", unseenText(plan)},
       {"Standard uncertainty of the correction", numberText(numberOf(plan, "standard_uncertainty_um"), "um", 2)},
       {"Largest correction", numberText(numberOf(plan, "largest_correction_um"), "um", 2)}});
  std::vector<ReportRow> rows;
  for (const nlohmann::json& p : plan["points"]) {
    ReportRow row{textOf(p, "point")};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = [&](const char* key) {
        const nlohmann::json& v = p.at(key).at(i);
        return v.is_number() ? v.get<double>() : std::numeric_limits<double>::quiet_NaN();
      };
      row.push_back(withUncertainty(value("correction_um"), value("standard_uncertainty_um"), ""));
      row.push_back(std::isfinite(value("remains_um")) ? tickText(value("remains_um"), 0.01) : std::string("–"));
    }
    rows.push_back(std::move(row));
  }
  document.table({"Point", "X / µm", "remains", "Y / µm", "remains", "Z / µm", "remains"}, spread(rows, 40),
                 rows.size() > 40 ? fmt::format("Corrections at 40 of {} points", rows.size())
                                  : std::string("Correction at each measured point and what would remain of the "
                                                "measured deviation"));
  if (const std::string limit = textOf(plan, "limitation"); !limit.empty()) document.callout(CalloutKind::Note, limit);
  for (const nlohmann::json& w : plan.value("warnings", nlohmann::json::array()))
    document.callout(CalloutKind::Attention, w.get<std::string>());
  std::vector<ReportRow> files;
  for (const nlohmann::json& f : plan.value("files", nlohmann::json::array()))
    files.push_back({textOf(f, "name"), textOf(f, "convention")});
  if (!files.empty()) document.table({"File", "Sign and reference"}, files, "Tables for the control");
}

void addLogCompensation(Report& document, const StoredResults& stored) {
  const nlohmann::json& run = stored.log_compensation;
  if (!run.is_object() || !run.contains("outputs")) return;
  document.section("Compensation over the log");
  addOutdated(document, stored, "log-compensation");
  document.paragraph(fmt::format(
      "The control's compensator, run over the log in {:.0f} cycles of {:g} s: {:.0f} on held inputs, {:.0f} "
      "in fall-back. Compensation = −predicted deviation, added to the command.",
      numberOf(run, "steps"), numberOf(run, "cycle_s"), numberOf(run, "holding_steps"),
      numberOf(run, "fallback_steps")));
  std::vector<ReportRow> rows;
  for (const nlohmann::json& o : run["outputs"]) {
    const SignalTitle title = signalTitle(textOf(o, "name"));
    // Rows that trained the model flatter it.
    const nlohmann::json unseen = o.value("unseen", nlohmann::json::object());
    const bool known = unseen.value("reduction_percent", nlohmann::json()).is_number();
    const nlohmann::json& shown = known ? unseen : o;
    rows.push_back({title.unit.empty() ? title.name : title.name + " / " + title.unit, known ? "unseen" : "all",
                    numberText(numberOf(shown, "rms_before"), "", 2), numberText(numberOf(shown, "rms_after"), "", 2),
                    numberText(numberOf(shown, "reduction_percent"), "%", 0),
                    numberText(numberOf(o, "largest_compensation"), "", 1)});
  }
  document.table({"Output", "Rows", "rms before", "rms after", "Reduction", "Largest compensation"}, rows,
                 "What the compensation leaves of the measured deviations; a reduction is positive where it helps");
  if (const std::string unseen = textOf(run, "unseen"); !unseen.empty()) document.paragraph("Unseen: " + unseen + ".");
  for (const nlohmann::json& w : run.value("warnings", nlohmann::json::array()))
    document.callout(CalloutKind::Attention, w.get<std::string>());
}

void addVerification(Report& document, const StoredResults& stored) {
  const nlohmann::json& result = stored.verification;
  if (!result.is_object() || !result.contains("components")) return;
  document.section("Verification");
  addOutdated(document, stored, "verify");
  const std::string verdict = textOf(result, "verdict");
  document.callout(verdict == "met"       ? CalloutKind::Good
                   : verdict == "not met" ? CalloutKind::Bad
                                          : CalloutKind::Attention,
                   textOf(result, "reason"));
  const char* by = textOf(result, "criterion") == "rms" ? "rms" : "largest";
  const bool of_rotations = result.contains("goal_urad") && result["goal_urad"].is_number();
  document.paragraph(
      of_rotations ? fmt::format("Goals {:g} µm and {:g} µrad, judged by the {} of the changes from the first state; "
                                 "decision rule of ISO 14253-1.",
                                 numberOf(result, "goal_um"), numberOf(result, "goal_urad"), by)
                   : fmt::format("Goal {:g} µm, judged by the {} of the changes from the first state; decision rule of "
                                 "ISO 14253-1.",
                                 numberOf(result, "goal_um"), by));
  std::vector<ReportRow> rows;
  for (const nlohmann::json& c : result["components"]) {
    const auto cell = [&](const char* side, const char* figure, const char* sigma) {
      return withUncertainty(numberOf(c.at(side), figure), numberOf(c.at(side), sigma), textOf(c, "unit"));
    };
    rows.push_back({textOf(c, "component"), cell("before", "rms", "rms_standard_uncertainty"),
                    cell("after", "rms", "rms_standard_uncertainty"),
                    cell("before", "largest", "largest_standard_uncertainty"),
                    cell("after", "largest", "largest_standard_uncertainty"), textOf(c, "verdict")});
  }
  document.table({"Component", "rms before", "rms after", "Largest before", "Largest after", "Goal"}, rows,
                 "The same plan before and after compensating");
  for (const nlohmann::json& note : result.value("notes", nlohmann::json::array()))
    document.paragraph(note.get<std::string>());
}

}  // namespace spindrift
