// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/discrepancy_story.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/no_number.h"
#include "core/discrepancy/effect_model.h"
#include "core/math/distributions.h"
#include "core/math/known_values.h"
#include "core/workflows/discrepancy_sizes.h"
#include "core/workflows/stored_effect.h"

namespace spindrift {
namespace {

/// Constants and rms of one series from its rows with use `fit`.
/// `sigma`: of every reading, shift of its state included.
void finishSeries(DiscrepancySeries& s, const std::vector<double>& sigma, double gain_uncertainty, bool absolute) {
  double weights = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    if (s.held_out[i]) continue;
    const double w = 1.0 / (sigma[i] * sigma[i]);
    weights += w;
    sum += w * (s.value[i] - s.simulated[i]);
  }
  s.constant_before = absolute ? 0.0 : sum / weights;
  double before = 0.0;
  double after = 0.0;
  double variance = 0.0;
  double count = 0.0;
  double simulated = 0.0;
  double simulated_square = 0.0;
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    if (s.held_out[i]) continue;
    const double b = s.value[i] - s.simulated[i] - s.constant_before;
    before += b * b;
    variance += sigma[i] * sigma[i];
    simulated += s.simulated[i];
    simulated_square += s.simulated[i] * s.simulated[i];
    count += 1.0;
    if (s.completed.empty()) continue;
    const double a = s.value[i] - s.completed[i] - s.constant_after;
    after += a * a;
  }
  const double moved = std::max(0.0, simulated_square / count - simulated * simulated / (count * count));
  s.noise = std::hypot(std::sqrt(variance / count), gain_uncertainty * std::sqrt(moved));
  s.rms_before = std::sqrt(before / count);
  s.rms_after = s.completed.empty() ? no_number : std::sqrt(after / count);
  s.excess_before = beyondNoise(s.rms_before, s.noise);
  s.excess_after = beyondNoise(s.rms_after, s.noise);
}

/// Marks series that deviate more than noise allows. Noise that is correlated in time has fewer independent values.
void markSignificant(std::vector<DiscrepancySeries>& series, const DiscrepancyResult& search) {
  constexpr double level = 0.01;
  for (DiscrepancySeries& s : series) {
    const bool in_place = std::any_of(search.where.begin(), search.where.end(), [&](const DisagreementPlace& p) {
      // A condition or a part of the volume names every point in it, those that agree as well.
      return p.component == s.component && p.condition.empty() &&
             std::find(p.points.begin(), p.points.end(), s.point) != p.points.end();
    });
    const auto count = static_cast<double>(std::count(s.held_out.begin(), s.held_out.end(), false));
    const double span = s.time_s.back() - s.time_s.front();
    const double spacing = s.time_s.size() > 1 ? span / static_cast<double>(s.time_s.size() - 1) : 0.0;
    const NoiseEstimate* noise = search.noiseOf(s.component);
    const double neighbour = noise != nullptr && spacing > 0.0 && noise->correlation_time_s > 0.0
                                 ? noise->correlated_part * std::exp(-spacing / noise->correlation_time_s)
                                 : 0.0;
    const double independent = std::max(2.0, count * (1.0 - neighbour) / (1.0 + neighbour));
    const double statistic = s.rms_before * s.rms_before / (s.noise * s.noise) * independent;
    const double p = chiSquaredTail(statistic, independent - 1.0) * static_cast<double>(series.size());
    s.significant = in_place || p < level;
  }
}

/// Places of a series by the angle of the table; `angles` and `positions` are those of its readings.
void setPlaces(DiscrepancySeries& s, const std::vector<double>& angles, const std::vector<Eigen::Vector3d>& positions) {
  std::map<double, std::pair<Eigen::Vector3d, double>> sums;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    auto& [sum, count] = sums.try_emplace(angles[i], Eigen::Vector3d::Zero(), 0.0).first->second;
    sum += positions[i];
    count += 1.0;
  }
  for (const auto& [c_deg, sum] : sums) s.places.push_back({c_deg, sum.first / sum.second});
  if (s.places.size() < 2) return;
  for (const double angle : angles)
    s.place.push_back(static_cast<std::size_t>(std::distance(sums.begin(), sums.find(angle))));
}

/// `model` holds the effects added alone; null: none were added.
std::vector<DiscrepancySeries> seriesOf(const DiscrepancyInput& input, const DiscrepancyResult& search,
                                        const DiscrepancyResult* model) {
  const auto& rows = input.observations.rows;
  std::vector<DiscrepancySeries> out;
  std::vector<std::vector<double>> sigmas;
  std::vector<std::vector<double>> angles;
  std::vector<std::vector<Eigen::Vector3d>> positions;
  std::map<std::pair<std::string, Component>, std::size_t> index;
  const std::vector<double> sigma = model != nullptr ? model->model->effectSigma(rows) : std::vector<double>();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = rows[i];
    // A series without any row to fit has no constant.
    if (o.use == ObservationUse::Exclude || !std::isfinite(search.simulated[i]) || !std::isfinite(search.constant[i])) {
      continue;
    }
    const auto [at, fresh] = index.try_emplace({o.point, o.component}, out.size());
    if (fresh) {
      out.emplace_back();
      sigmas.emplace_back();
      angles.emplace_back();
      positions.emplace_back();
      out.back().point = o.point;
      out.back().component = o.component;
    }
    DiscrepancySeries& s = out[at->second];
    angles[at->second].push_back(o.c_deg);
    positions[at->second].push_back(o.position_mm);
    s.position_mm += o.position_mm;
    s.time_s.push_back(o.time_s);
    s.value.push_back(o.value);
    s.simulated.push_back(search.simulated[i]);
    s.held_out.push_back(o.use == ObservationUse::Holdout);
    if (!search.effects.empty()) s.explained.push_back(search.effect_part[i] + search.constant[i]);
    sigmas[at->second].push_back(search.readingSigma(o.component, o.sigma));
    s.remaining.push_back(o.use == ObservationUse::Fit ? search.remaining[i] : no_number);
    if (model != nullptr) {
      s.completed.push_back(model->completed[i]);
      s.completed_sigma.push_back(std::hypot(sigma[i], input.simulation_gain_uncertainty * search.simulated[i]));
      s.constant_after = model->constant[i];
    }
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].position_mm /= static_cast<double>(out[k].value.size());
    setPlaces(out[k], angles[k], positions[k]);
    finishSeries(out[k], sigmas[k], input.simulation_gain_uncertainty, input.absolute);
    for (double& e : out[k].explained) e -= out[k].constant_before;
  }
  markSignificant(out, search);
  return out;
}

Component componentOf(const nlohmann::json& json) {
  const auto component = componentFromString(json.get<std::string>());
  if (!component) throw InputError("the stored discrepancy names a component that does not exist; search again.");
  return *component;
}

nlohmann::json outlierJson(const OutlyingObservation& o) {
  return {{"row", o.row + 1},
          {"time_s", jsonNumber(o.time_s)},
          {"state", o.state},
          {"point", o.point},
          {"component", std::string(toString(o.component))},
          {"value", jsonNumber(o.value)},
          {"deviation", jsonNumber(o.deviation)}};
}

OutlyingObservation outlierOf(const nlohmann::json& json) {
  return {json.at("row").get<std::size_t>() - 1, storedNumber(json, "time_s"),      json.at("state").get<std::string>(),
          json.at("point").get<std::string>(),   componentOf(json.at("component")), storedNumber(json, "value"),
          storedNumber(json, "deviation")};
}

nlohmann::json seriesJson(const DiscrepancySeries& s) {
  const auto numbers = [](const std::vector<double>& values) {
    nlohmann::json out = nlohmann::json::array();
    for (const double v : values) out.push_back(jsonNumber(v));
    return out;
  };
  nlohmann::json places = nlohmann::json::array();
  for (const TablePlace& p : s.places)
    places.push_back({p.c_deg, p.position_mm.x(), p.position_mm.y(), p.position_mm.z()});
  return {{"point", s.point},
          {"component", std::string(toString(s.component))},
          {"position_mm", {s.position_mm.x(), s.position_mm.y(), s.position_mm.z()}},
          {"places", places},
          {"place", s.place},
          {"time_s", s.time_s},
          {"value", s.value},
          {"simulated", s.simulated},
          {"completed", numbers(s.completed)},
          {"completed_sigma", numbers(s.completed_sigma)},
          {"explained", numbers(s.explained)},
          {"remaining", numbers(s.remaining)},
          {"held_out", s.held_out},
          {"constants", {jsonNumber(s.constant_before), jsonNumber(s.constant_after)}},
          {"noise", jsonNumber(s.noise)},
          {"significant", s.significant},
          {"rms", {jsonNumber(s.rms_before), jsonNumber(s.rms_after)}}};
}

DiscrepancySeries seriesOf(const nlohmann::json& json) {
  DiscrepancySeries s;
  s.point = json.at("point").get<std::string>();
  s.component = componentOf(json.at("component"));
  const auto number = [&](const char* key, std::size_t index) {
    const nlohmann::json& value = json.at(key).at(index);
    return value.is_number() ? value.get<double>() : no_number;
  };
  s.position_mm = {number("position_mm", 0), number("position_mm", 1), number("position_mm", 2)};
  if (json.contains("places")) {
    for (const nlohmann::json& p : json.at("places"))
      s.places.push_back(
          {p.at(0).get<double>(), {p.at(1).get<double>(), p.at(2).get<double>(), p.at(3).get<double>()}});
    s.place = json.at("place").get<std::vector<std::size_t>>();
  }
  s.time_s = storedNumbers(json.at("time_s"));
  s.value = storedNumbers(json.at("value"));
  s.simulated = storedNumbers(json.at("simulated"));
  s.completed = storedNumbers(json.at("completed"));
  // Stories of earlier versions do not hold it.
  s.completed_sigma = json.contains("completed_sigma") ? storedNumbers(json.at("completed_sigma"))
                                                       : std::vector<double>(s.completed.size(), no_number);
  s.explained = storedNumbers(json.at("explained"));
  if (json.contains("remaining")) s.remaining = storedNumbers(json.at("remaining"));
  s.held_out = json.at("held_out").get<std::vector<bool>>();
  s.constant_before = number("constants", 0);
  s.constant_after = number("constants", 1);
  s.noise = storedNumber(json, "noise");
  s.significant = json.at("significant").get<bool>();
  s.rms_before = number("rms", 0);
  s.rms_after = number("rms", 1);
  s.excess_before = beyondNoise(s.rms_before, s.noise);
  s.excess_after = beyondNoise(s.rms_after, s.noise);
  const std::size_t rows = s.time_s.size();
  bool whole = rows > 0 && s.value.size() == rows && s.simulated.size() == rows && s.held_out.size() == rows &&
               s.completed_sigma.size() == s.completed.size();
  for (const std::vector<double>* part : {&s.completed, &s.explained, &s.remaining})
    whole = whole && (part->empty() || part->size() == rows);
  whole = whole && (s.place.empty() || s.place.size() == rows) &&
          std::all_of(s.place.begin(), s.place.end(), [&](std::size_t at) { return at < s.places.size(); });
  if (!whole)
    throw InputError(fmt::format("the stored discrepancy holds lists of unequal length for {} of {}; search again.",
                                 toString(s.component), s.point));
  return s;
}

DiscrepancyVerdict verdictOf(const std::string& text) {
  for (const DiscrepancyVerdict v : {DiscrepancyVerdict::Named, DiscrepancyVerdict::Ambiguous,
                                     DiscrepancyVerdict::Unknown, DiscrepancyVerdict::None}) {
    if (toString(v) == text) return v;
  }
  throw InputError("the stored discrepancy has a verdict that does not exist; search again.");
}

void parsePlaces(const nlohmann::json& result, DiscrepancyStory& story) {
  for (const auto& p : result.at("where")) {
    DisagreementPlace place;
    place.component = componentOf(p.at("component"));
    place.points = p.at("points").get<std::vector<std::string>>();
    place.from_s = storedNumber(p, "from_s");
    place.to_s = storedNumber(p, "to_s");
    place.excess_um = storedNumber(p, "excess_um");
    place.p_value = storedNumber(p, "p_value");
    if (p.at("condition").is_string()) place.condition = p.at("condition").get<std::string>();
    story.where.push_back(std::move(place));
  }
}

MeasurementSuggestion parseSuggestion(const nlohmann::json& json) {
  MeasurementSuggestion s;
  s.points = json.at("points").get<std::vector<std::string>>();
  s.times_s = storedNumbers(json.at("times_s"));
  s.conditions = json.at("conditions").get<std::string>();
  s.separates = json.at("separates").get<std::string>();
  s.expected_delta_bic = storedNumber(json, "expected_delta_bic");
  // Stories of older versions have no programme.
  if (!json.contains("programme")) return s;
  s.c_deg = storedNumbers(json.at("c_deg"));
  for (const auto& p : json.at("programme")) {
    ProgrammeStep step;
    step.from_s = storedNumber(p, "from_s");
    step.to_s = storedNumber(p, "to_s");
    step.action = p.at("action").get<std::string>();
    step.as_logged = p.at("as_logged").get<bool>();
    step.spindle_rpm = storedNumber(p, "spindle_rpm");
    step.c_rpm = storedNumber(p, "speed_c_rpm");
    step.coolant = p.at("coolant").get<bool>();
    for (std::size_t a = 0; a < 3; ++a) {
      step.feed_mm_min[a] = p.at("feed_mm_min").at(a).get<double>();
      step.position_mm[a] = p.at("position_mm").at(a).get<double>();
    }
    s.programme.push_back(std::move(step));
  }
  s.restart_instrument = json.at("restart_instrument").get<bool>();
  s.expected_information_nats = storedNumber(json, "expected_information_nats");
  s.present_entropy_nats = storedNumber(json, "present_entropy_nats");
  s.probability_alone_now = storedNumber(json, "probability_alone_now");
  s.probability_alone_expected = storedNumber(json, "probability_alone_expected");
  return s;
}

void parseRest(const nlohmann::json& result, DiscrepancyStory& story) {
  story.verdict = verdictOf(result.at("verdict").get<std::string>());
  story.decided = result.at("decided").get<bool>();
  story.message = result.at("message").get<std::string>();
  parsePlaces(result, story);
  if (const auto& s = result.at("suggestion"); s.is_object()) {
    story.suggestion = parseSuggestion(s);
  }
  if (result.at("leftover").is_string()) story.leftover = result.at("leftover").get<std::string>();
  for (const auto& s : result.at("steps")) {
    story.steps.push_back({s.at("id").get<std::string>(), s.at("accepted").get<bool>(), storedNumber(s, "delta_bic"),
                           storedNumber(s, "delta_chi2"), s.at("reason").get<std::string>()});
  }
  story.warnings = result.at("warnings").get<std::vector<std::string>>();
  for (const auto& [name, n] : result.at("noise").items()) {
    story.noise.push_back({componentOf(name), storedNumber(n, "scale"), storedNumber(n, "scale_uncertainty"),
                           storedNumber(n, "common_um"), storedNumber(n, "correlated_part"),
                           storedNumber(n, "correlation_time_s"),
                           n.contains("drift_um") ? storedNumber(n, "drift_um") : 0.0,
                           n.contains("drift_um") ? storedNumber(n, "drift_correlation_time_s") : 0.0});
  }
  for (const auto& s : result.at("state_shifts")) {
    story.shifts.push_back({s.at("state").get<std::string>(), componentOf(s.at("component")), storedNumber(s, "time_s"),
                            storedNumber(s, "shift_um"), storedNumber(s, "standard_uncertainty")});
  }
  for (const auto& c : result.at("candidates")) {
    story.candidates.push_back(
        {c.at("id").get<std::string>(), storedNumber(c, "probability"), c.value("rejected", false)});
  }
  for (const auto& [name, r] : result.at("remainder").items()) {
    story.remainder.push_back({componentOf(name), storedNumber(r, "rms_um"), storedNumber(r, "evidence")});
  }
  // The keys of an object are in the order of the alphabet.
  const auto by_component = [](const auto& a, const auto& b) { return a.component < b.component; };
  std::sort(story.noise.begin(), story.noise.end(), by_component);
  std::sort(story.remainder.begin(), story.remainder.end(), by_component);
  if (result.at("tail_dof").is_number()) story.tail_dof = storedNumber(result, "tail_dof");
  story.clock_offset_s = storedNumber(result, "clock_offset_s");
  if (result.at("clock_offset_uncertainty_s").is_number()) {
    story.clock_offset_uncertainty_s = storedNumber(result, "clock_offset_uncertainty_s");
  }
}

}  // namespace

TablePlace DiscrepancySeries::placeOf(std::size_t i) const {
  if (places.empty()) return {0.0, position_mm};
  return places[place.empty() ? 0 : place[i]];
}

double DiscrepancySeries::remainingRms() const {
  return rootMeanSquareOfKnown(remaining);
}

std::optional<std::size_t> DiscrepancySeries::largestRemaining() const {
  std::optional<std::size_t> at;
  for (std::size_t i = 0; i < remaining.size(); ++i)
    if (std::isfinite(remaining[i]) && (!at || std::abs(remaining[i]) > std::abs(remaining[*at]))) at = i;
  return at;
}

const FoundEffect* DiscrepancyStory::nextProposal() const {
  const auto found = std::find_if(effects.begin(), effects.end(), [](const FoundEffect& e) { return !e.forced; });
  return found == effects.end() ? nullptr : &*found;
}

const DiscrepancySeries* DiscrepancyStory::find(const std::string& point, Component component) const {
  const auto found = std::find_if(series.begin(), series.end(), [&](const DiscrepancySeries& s) {
    return s.point == point && s.component == component;
  });
  return found == series.end() ? nullptr : &*found;
}

double DiscrepancyStory::largestRms(bool rotations) const {
  double largest = 0.0;
  for (const DiscrepancySeries& s : series) {
    if (isRotation(s.component) != rotations) continue;
    largest = std::max({largest, s.rms_before, s.noise});
    if (std::isfinite(s.rms_after)) largest = std::max(largest, s.rms_after);
  }
  return largest;
}

std::array<GapFigures, 2> DiscrepancyStory::movements() const {
  const std::vector<DiscrepancyReportRow> rows = reportData().rows;
  std::array<GapFigures, 2> figures{gapFigures(rows, false), gapFigures(rows, true)};
  if (added.empty())
    for (GapFigures& f : figures) f.p2p_after = f.fit_after_percent = std::nan("");
  return figures;
}

DiscrepancyReportData DiscrepancyStory::reportData() const {
  DiscrepancyReportData data;
  data.verdict = verdict;
  data.message = message;
  data.effects = effects;
  data.user_adds = true;
  data.gap = added.empty() && proposed ? *proposed : gap;
  data.where = where;
  data.suggestion = suggestion;
  data.leftover = leftover;
  data.steps = steps;
  data.warnings = warnings;
  data.candidates = candidates;
  data.noise = noise;
  data.shifts = shifts;
  data.outliers = outliers;
  data.remainder = remainder;
  data.tail_dof = tail_dof;
  data.clock_offset_s = clock_offset_s;
  data.clock_offset_uncertainty_s = clock_offset_uncertainty_s;
  for (const DiscrepancySeries& s : series) {
    for (std::size_t i = 0; i < s.time_s.size(); ++i) {
      const TablePlace at = s.placeOf(i);
      DiscrepancyReportRow row{s.time_s[i], s.point, s.component,   at.position_mm, s.noise,
                               0.0,         0.0,     s.held_out[i], s.value[i]};
      row.c_deg = at.c_deg;
      row.before = s.value[i] - s.simulated[i] - s.constant_before;
      row.after = !s.completed.empty()   ? s.value[i] - s.completed[i] - s.constant_after
                  : !s.explained.empty() ? row.before - s.explained[i]
                                         : row.before;
      if (!s.remaining.empty()) row.remaining = s.remaining[i];
      data.rows.push_back(std::move(row));
    }
  }
  return data;
}

nlohmann::json DiscrepancyStory::json() const {
  nlohmann::json found = nlohmann::json::array();
  for (const FoundEffect& e : effects) found.push_back(storedEffect(e));
  nlohmann::json lines = nlohmann::json::array();
  for (const DiscrepancySeries& s : series) lines.push_back(seriesJson(s));
  nlohmann::json outlying = nlohmann::json::array();
  for (const OutlyingObservation& o : outliers) outlying.push_back(outlierJson(o));
  return {{"format", "spindrift-discrepancy-story"},
          {"version", 1},
          {"added", added},
          {"effects", found},
          {"gap", storedGap(gap)},
          {"proposed", proposed ? storedGap(*proposed) : nlohmann::json()},
          {"has_holdout", has_holdout},
          {"outliers", outlying},
          {"series", lines},
          {"result", result}};
}

DiscrepancyStory DiscrepancyStory::parse(const nlohmann::json& json) {
  try {
    if (json.at("format") != "spindrift-discrepancy-story" || json.at("version") != 1) {
      throw InputError("the stored discrepancy is of another version; search again.");
    }
    DiscrepancyStory story;
    story.result = json.at("result");
    // Searches of earlier versions knew neither candidates nor shifts; their verdicts meant something else.
    if (!story.result.contains("candidates")) {
      throw InputError("the stored discrepancy is of an earlier version; search again.");
    }
    parseRest(story.result, story);
    story.added = json.at("added").get<std::vector<std::string>>();
    for (const auto& e : json.at("effects")) story.effects.push_back(effectOfStored(e));
    story.gap = gapOfStored(json.at("gap"));
    if (json.at("proposed").is_object()) story.proposed = gapOfStored(json.at("proposed"));
    story.has_holdout = json.at("has_holdout").get<bool>();
    // Stories of earlier versions do not hold them.
    if (json.contains("outliers")) {
      for (const auto& o : json.at("outliers")) story.outliers.push_back(outlierOf(o));
    }
    for (const auto& s : json.at("series")) story.series.push_back(seriesOf(s));
    return story;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(fmt::format("the stored discrepancy cannot be read ({}); search again.", e.what()));
  }
}

DiscrepancyStory tellDiscrepancy(const Campaign& campaign, ObservationSet observations,
                                 const DiscrepancyOptions& options, JobContext& job) {
  JobContext searching = job.part(0.0, 0.75);
  const DiscrepancyRun run = searchDiscrepancy(campaign, std::move(observations), options, searching);
  const DiscrepancyResult& found = run.result;
  DiscrepancyStory story;
  story.verdict = found.verdict;
  story.decided = found.decided;
  story.message = found.message;
  story.effects = found.effects;
  story.where = found.where;
  story.suggestion = found.suggestion;
  story.leftover = found.leftover;
  story.steps = found.steps;
  story.warnings = found.warnings;
  story.candidates = found.candidates;
  story.noise = found.noise;
  story.shifts = found.shifts;
  story.outliers = outlyingObservations(run.input.observations, found.outliers);
  story.remainder = found.remainder;
  story.tail_dof = found.tail_dof;
  story.clock_offset_s = found.clock_offset_s;
  story.clock_offset_uncertainty_s = found.clock_offset_uncertainty_s;
  story.result = found.json();
  const auto& rows = run.input.observations.rows;
  story.has_holdout =
      std::any_of(rows.begin(), rows.end(), [](const Observation& o) { return o.use == ObservationUse::Holdout; });
  for (const FoundEffect& e : found.effects) {
    if (e.forced) story.added.push_back(e.id);
  }
  const bool proposes = story.added.size() < found.effects.size();
  DiscrepancyResult alone;
  const DiscrepancyResult* model = story.added.empty() ? nullptr : &found;
  if (model != nullptr && proposes) {
    DiscrepancyOptions only = options;
    only.max_effects = 0;
    only.suggest = false;
    JobContext fitting = job.part(0.75, 1.0);
    alone = findDiscrepancy(run.input, only, fitting);
    model = &alone;
  }
  story.gap = model != nullptr ? model->gap : found.gap;
  if (model == nullptr) {
    story.gap.rms_after_um = no_number;
    story.gap.heldout_rms_after_um = no_number;
  }
  if (proposes) story.proposed = found.gap;
  story.series = seriesOf(run.input, found, model);
  job.report(1.0, "done");
  return story;
}

}  // namespace spindrift
