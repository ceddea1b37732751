// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/exercise.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/discrepancy/effect_listing.h"
#include "core/discrepancy/effect_titles.h"
#include "core/machine/driver_words.h"
#include "core/workflows/discrepancy_workflow.h"

namespace spindrift {
namespace {

constexpr const char* file_name = "exercise.json";
constexpr const char* format = "spindrift-exercise";
constexpr double effect_part = 0.6, detail_part = 0.2, alike_part = 0.5, wrong_part = 0.25, searched_part = 0.5;
constexpr int hint_marks = 10;
constexpr double nearly_as_well = 0.9;       ///< R^2 of a driver over that of the best
constexpr double simulation_error = 0.1;     ///< of the size, in its uncertainty
constexpr double common_shift = 0.6;         ///< of a state, in sigma (StudyConditions::common)
constexpr int largest_seed = 2'000'000'000;  ///< fits an integer of JSON readers

std::string driverText(const std::vector<std::string>& inputs) {
  std::string out;
  for (const std::string& input : inputs) out += (out.empty() ? "" : " + ") + input;
  return out;
}

std::vector<std::string> driverTexts(const Effect& effect) {
  std::vector<std::string> out;
  for (const std::vector<std::string>& inputs : driversOf(effect)) out.push_back(driverText(inputs));
  return out;
}

/// Rows of a signal of one cause, grouped by series: a constant of each is free.
struct ExerciseSignal {
  std::vector<const Observation*> rows;
  std::vector<std::size_t> series;
  std::size_t series_count = 0;
  Eigen::VectorXd values;

  void removeMeans(Eigen::Ref<Eigen::MatrixXd> columns) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(series_count), columns.cols());
    Eigen::VectorXd count = Eigen::VectorXd::Zero(sum.rows());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto s = static_cast<Eigen::Index>(series[i]);
      sum.row(s) += columns.row(static_cast<Eigen::Index>(i));
      count[s] += 1.0;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto s = static_cast<Eigen::Index>(series[i]);
      columns.row(static_cast<Eigen::Index>(i)) -= sum.row(s) / count[s];
    }
  }
};

/// Rows in which the truth is a number, of displacements and turns scaled by their sigma.
ExerciseSignal signalOf(const std::vector<Observation>& rows, const std::vector<double>& values) {
  ExerciseSignal out;
  std::map<std::pair<std::string, Component>, std::size_t> series;
  std::vector<double> kept;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Fit) continue;
    const auto [place, fresh] = series.try_emplace({rows[i].point, rows[i].component}, series.size());
    out.rows.push_back(&rows[i]);
    out.series.push_back(place->second);
    kept.push_back(values[i] / rows[i].sigma);
  }
  out.series_count = series.size();
  out.values = Eigen::Map<const Eigen::VectorXd>(kept.data(), static_cast<Eigen::Index>(kept.size()));
  out.removeMeans(out.values);
  return out;
}

/// Largest part of the signal that one way of driving the effect explains, over time constants.
double explained(const ExerciseSignal& signal, const Effect& effect, const EffectVariant& variant,
                 const DriverTable& drivers) {
  std::vector<double> times;
  for (const Observation* row : signal.rows) times.push_back(row->time_s);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const auto n = static_cast<Eigen::Index>(signal.rows.size());
  const auto shapes = static_cast<Eigen::Index>(effect.shape.size());
  Eigen::MatrixXd shape(n, shapes);
  std::vector<Eigen::Index> moment(signal.rows.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Observation& row = *signal.rows[static_cast<std::size_t>(i)];
    const DeviationQuery query = DeviationQuery::of(row);
    for (Eigen::Index k = 0; k < shapes; ++k)
      shape(i, k) = effect.shape[static_cast<std::size_t>(k)].value(query, row.component) / row.sigma;
    moment[static_cast<std::size_t>(i)] = std::lower_bound(times.begin(), times.end(), row.time_s) - times.begin();
  }
  const double whole = signal.values.squaredNorm();
  double best = 0.0;
  for (double tau_s = 0.0; tau_s < 60'000.0; tau_s = tau_s == 0.0 ? 120.0 : 1.6 * tau_s) {
    Eigen::MatrixXd columns(n, shapes * static_cast<Eigen::Index>(variant.inputs.size()));
    Eigen::Index at = 0;
    for (const EffectInput& input : variant.inputs) {
      const Driver* driver = drivers.find(input.driver);
      if (driver == nullptr) return 0.0;
      const Eigen::VectorXd q = drivers.response(*driver, tau_s, -1.0, times);
      for (Eigen::Index k = 0; k < shapes; ++k, ++at)
        for (Eigen::Index i = 0; i < n; ++i) columns(i, at) = shape(i, k) * q[moment[static_cast<std::size_t>(i)]];
    }
    signal.removeMeans(columns);
    const Eigen::VectorXd gains = columns.completeOrthogonalDecomposition().solve(signal.values);
    best = std::max(best, 1.0 - (signal.values - columns * gains).squaredNorm() / whole);
    if (variant.inputs.front().dynamics == Dynamics::None) break;
  }
  return best;
}

std::vector<std::string> acceptedDrivers(const ExerciseSignal& signal, const Effect& effect,
                                         const DriverTable& drivers) {
  std::map<std::string, double> quality;
  double best = 0.0;
  for (const EffectVariant& variant : effect.variants) {
    std::vector<std::string> inputs;
    for (const EffectInput& input : variant.inputs)
      if (!input.driver.empty()) inputs.emplace_back(driverAsWritten(input.driver));
    if (inputs.empty() || inputs.size() != variant.inputs.size()) continue;
    double& of_this = quality[driverText(inputs)];
    of_this = std::max(of_this, explained(signal, effect, variant, drivers));
    best = std::max(best, of_this);
  }
  std::vector<std::string> out;
  for (const auto& [driver, part] : quality)
    if (best > 0.0 && part >= nearly_as_well * best) out.push_back(driver);
  return out;
}

/// The units of the components that an effect changes where something is observed.
std::vector<std::string> sizeUnits(const Effect& effect, const std::vector<Observation>& rows) {
  std::set<std::string> out;
  for (const Observation& row : rows) {
    std::string unit(unitOf(row.component));
    if (out.contains(unit)) continue;
    const DeviationQuery query = DeviationQuery::of(row);
    if (std::any_of(effect.shape.begin(), effect.shape.end(),
                    [&](const ShapeColumn& column) { return column.value(query, row.component) != 0.0; }))
      out.insert(std::move(unit));
  }
  return {out.begin(), out.end()};
}

/// The largest change as displacement and as rotation; first that which is larger in units of its sigma.
void measureSizes(const std::vector<Observation>& rows, const std::vector<double>& values, const StudyCase& made,
                  HiddenEffect& hidden) {
  struct Span {
    double low = INFINITY, high = -INFINITY, sigma = 1.0;
  };
  std::map<std::pair<std::string, Component>, Span> spans;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Span& span = spans[{rows[i].point, rows[i].component}];
    span.low = std::min(span.low, values[i]);
    span.high = std::max(span.high, values[i]);
    span.sigma = rows[i].sigma;
  }
  std::array<double, 2> most{};  // of displacement, of rotation
  std::array<EffectSize, 2> sizes{EffectSize{Component::EX}, EffectSize{Component::EA}};
  for (const auto& [series, span] : spans) {
    const std::size_t kind = isRotation(series.second) ? 1 : 0;
    const double relative = (span.high - span.low) / span.sigma;
    if (relative <= most[kind]) continue;
    most[kind] = relative;
    sizes[kind].component = series.second;
    sizes[kind].value = span.high - span.low;
  }
  for (const std::size_t kind : {0U, 1U}) {
    double sigma = kind == 1 ? made.scenario.instrument.sigma_urad : made.scenario.instrument.sigma_um;
    if (made.conditions.common) sigma *= std::sqrt(1.0 + common_shift * common_shift);
    sizes[kind].uncertainty = std::sqrt(2.0 * sigma * sigma + std::pow(simulation_error * sizes[kind].value, 2));
  }
  const std::size_t first = most[1] > most[0] ? 1 : 0;
  hidden.sizes = {sizes[first]};
  const EffectSize& other = sizes[1 - first];
  if (other.value > 2.0 * other.uncertainty) hidden.sizes.push_back(other);
}

}  // namespace

std::string_view toString(ExerciseLevel level) noexcept {
  switch (level) {
    case ExerciseLevel::Easy:
      return "easy";
    case ExerciseLevel::Medium:
      return "medium";
    case ExerciseLevel::Hard:
      return "hard";
  }
  return "easy";
}

ExerciseLevel exerciseLevelFromString(std::string_view name) {
  for (const ExerciseLevel level : {ExerciseLevel::Easy, ExerciseLevel::Medium, ExerciseLevel::Hard})
    if (name == toString(level)) return level;
  throw InputError(fmt::format("level \"{}\" is not known; allowed: easy, medium or hard.", name));
}

std::optional<Exercise> Exercise::of(const std::filesystem::path& campaign) {
  const std::filesystem::path file = campaign / file_name;
  if (!std::filesystem::exists(file)) return std::nullopt;
  const JsonNode root = JsonNode::read(file);
  (void)root.at("format").oneOf({format});
  if (const int version = root.at("version").integer(); version != 1)
    throw InputError(root.at("version").place(), fmt::format("version {} is not known; allowed: 1.", version));
  Exercise out;
  const int seed = root.at("seed").integer();
  if (seed < 0) throw InputError(root.at("seed").place(), fmt::format("{} is negative; allowed: 0 and more.", seed));
  out.seed = static_cast<std::uint64_t>(seed);
  out.level = exerciseLevelFromString(root.at("level").oneOf({"easy", "medium", "hard"}));
  return out;
}

StudyCase exerciseCase(const Exercise& exercise) {
  if (exercise.seed > largest_seed)
    throw InputError(fmt::format("seed {} is not allowed; allowed: 0 to {}.", exercise.seed, largest_seed));
  // The study's own seeds begin at 1: others, so that nobody finds these among its results.
  const std::uint64_t seed = 0x7e4c0000ULL + exercise.seed;
  Random random(seed * 3 + static_cast<std::uint64_t>(exercise.level));
  StudyOptions options;
  options.turn = random.index(1000);
  switch (exercise.level) {
    case ExerciseLevel::Easy:
      options.kind = StudyKind::One;
      options.strength = 10.0;
      break;
    case ExerciseLevel::Medium:
      options.kind = StudyKind::Two;
      options.strength = 6.0;
      options.conditions.common = true;
      break;
    case ExerciseLevel::Hard:
      options.kind = StudyKind::Three;
      options.strength = 4.0;
      options.conditions = StudyConditions::together();
      break;
  }
  return studyCase(options, seed);
}

void writeExercise(const Exercise& exercise, const std::filesystem::path& folder, JobContext& job) {
  JobContext simulating = job.part(0.0, 0.7);
  StudyCampaign made = simulateStudy(exerciseCase(exercise), simulating);
  made.campaign.campaign.name = fmt::format("exercise {}, {}", exercise.seed, toString(exercise.level));
  JobContext writing = job.part(0.7, 1.0);
  writeCampaign(made.campaign, folder, writing);
  const nlohmann::json json{
      {"format", format}, {"version", 1}, {"seed", exercise.seed}, {"level", toString(exercise.level)}};
  writeFileAtomically(folder / file_name, json.dump(1) + "\n");
}

ExerciseKey exerciseKey(const Exercise& exercise, JobContext& job) {
  const StudyCase made = exerciseCase(exercise);
  const StudyCampaign study = simulateStudy(made, job);
  const Campaign& campaign = study.campaign.campaign;
  const std::vector<Observation>& rows = campaign.observations->rows;
  const DriverTable drivers(campaign.machine, campaign.log ? &*campaign.log : nullptr);
  const EffectsAnswer known = listEffects(campaign, nullptr, nullptr);
  ExerciseKey key;
  key.exercise = exercise;
  for (const Effect& effect : known.effects) key.units[effect.id] = sizeUnits(effect, rows);
  for (const std::string& id : made.hidden) {
    HiddenEffect hidden;
    hidden.id = id;
    const std::vector<double>& values = study.campaign.truth.signals.at(id);
    measureSizes(rows, values, made, hidden);
    for (const Effect& effect : known.effects) {
      if (std::find(effect.contains.begin(), effect.contains.end(), id) != effect.contains.end())
        hidden.alike.push_back(effect.id);
      if (effect.id != id) continue;
      hidden.alike.insert(hidden.alike.end(), effect.contains.begin(), effect.contains.end());
      hidden.drivers = acceptedDrivers(signalOf(rows, values), effect, drivers);
    }
    key.hidden.push_back(std::move(hidden));
  }
  return key;
}

std::vector<ExerciseChoice> exerciseChoices(const std::filesystem::path& campaign) {
  const Campaign read = Campaign::read(campaign);
  const std::vector<Observation> rows = read.observations ? read.observations->rows : std::vector<Observation>{};
  std::vector<ExerciseChoice> out;
  for (const Effect& effect : listEffects(read, nullptr, nullptr).effects)
    out.push_back({effect.id, titleOf(effect), effect.id.substr(0, effect.id.find('.')), driverTexts(effect),
                   sizeUnits(effect, rows)});
  std::stable_sort(out.begin(), out.end(),
                   [](const ExerciseChoice& a, const ExerciseChoice& b) { return a.family < b.family; });
  return out;
}

AnsweredEffect AnsweredEffect::parse(const std::string& text) {
  std::vector<std::string> parts(1);  // the driver between two colons may be empty
  for (const char c : text) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  for (std::string& part : parts) part = std::string(trimmed(part));
  AnsweredEffect out;
  const auto reject = [&](const char* why) {
    throw InputError(fmt::format(
        "answer \"{}\" {}; allowed: EFFECT[:DRIVER[:SIZE]], for example column.bending.a:column_difference:12um.", text,
        why));
  };
  if (parts[0].empty()) reject("names no effect");
  if (parts.size() > 3) reject("has more than three parts");
  out.id = parts[0];
  if (parts.size() > 1) out.driver = parts[1];
  if (parts.size() > 2 && !parts[2].empty()) {
    NamedSize size;
    std::string_view number = parts[2];
    for (const auto& [ending, unit] :
         {std::pair<std::string_view, const char*>{"urad", "urad"}, {"µrad", "urad"}, {"um", "um"}, {"µm", "um"}}) {
      if (!number.ends_with(ending)) continue;
      number.remove_suffix(ending.size());
      size.unit = unit;
      break;
    }
    while (number.ends_with(' ')) number.remove_suffix(1);
    if (size.unit.empty()) reject("has a size without the unit µm or µrad");
    if (!parseNumber(number, size.value) || !(size.value >= 0.0)) reject("has a size that is not a number from 0 on");
    out.size = std::move(size);
  }
  return out;
}

ExerciseScore scoreExercise(const ExerciseKey& key, const ExerciseAnswer& answer) {
  if (answer.hints < 0 || answer.hints > exercise_hints)
    throw InputError(fmt::format("{} hints; allowed: 0 to {}.", answer.hints, exercise_hints));
  std::set<std::string> seen;
  for (const AnsweredEffect& named : answer.named) {
    if (!seen.insert(named.id).second) throw InputError(fmt::format("\"{}\" is named twice; allowed: once.", named.id));
    const auto units = key.units.find(named.id);
    if (named.size && units != key.units.end() &&
        std::find(units->second.begin(), units->second.end(), named.size->unit) == units->second.end())
      throw InputError(fmt::format("\"{}\" is given a size in {}; allowed: {}.", named.id,
                                   printedUnit(named.size->unit),
                                   units->second.empty() ? "none" : printedUnit(joinedList(units->second, "or"))));
  }
  ExerciseScore score;
  score.answer = answer;
  const double share = 100.0 / static_cast<double>(std::max<std::size_t>(key.hidden.size(), 1));
  std::set<std::string> counted;
  for (const HiddenEffect& hidden : key.hidden) {
    ExerciseScore::Line line;
    line.hidden = hidden;
    for (const AnsweredEffect& named : answer.named) {
      if (named.id != hidden.id) continue;
      counted.insert(named.id);
      line.named = named.id;
      line.exact = true;
      line.driver_right = hidden.drivers.empty() ||
                          std::find(hidden.drivers.begin(), hidden.drivers.end(), named.driver) != hidden.drivers.end();
      line.size_named = named.size;
      line.size_right = named.size && named.size->unit == unitOf(line.size().component) &&
                        std::abs(named.size->value - line.size().value) <= 2.0 * line.size().uncertainty;
      line.marks =
          share * (effect_part + (line.driver_right ? detail_part : 0.0) + (line.size_right ? detail_part : 0.0));
    }
    score.lines.push_back(std::move(line));
  }
  // What is left may count half for what nobody named.
  for (ExerciseScore::Line& line : score.lines) {
    for (const AnsweredEffect& named : answer.named) {
      const auto& alike = line.hidden.alike;
      if (!line.named.empty() || counted.contains(named.id) ||
          std::find(alike.begin(), alike.end(), named.id) == alike.end())
        continue;
      counted.insert(named.id);
      line.named = named.id;
      line.marks = share * effect_part * alike_part;
    }
  }
  double total = 0.0;
  for (const ExerciseScore::Line& line : score.lines) total += line.marks;
  for (const AnsweredEffect& named : answer.named) {
    if (counted.contains(named.id)) continue;
    score.wrong.push_back(named.id);
    total -= share * wrong_part;
  }
  total -= hint_marks * answer.hints;
  if (answer.searched_before) total *= searched_part;
  score.total = static_cast<int>(std::lround(std::clamp(total, 0.0, 100.0)));
  return score;
}

const EffectSize& ExerciseScore::Line::size() const {
  for (const EffectSize& size : hidden.sizes)
    if (size_named && size_named->unit == unitOf(size.component)) return size;
  return hidden.sizes.front();
}

bool ExerciseScore::allNamed() const {
  return std::all_of(lines.begin(), lines.end(), [](const Line& line) { return line.exact; });
}

nlohmann::json ExerciseScore::json() const {
  nlohmann::json effects = nlohmann::json::array();
  for (const Line& line : lines) {
    effects.push_back({{"id", line.hidden.id},
                       {"named", line.named.empty() ? nlohmann::json() : nlohmann::json(line.named)},
                       {"exact", line.exact},
                       {"drivers", line.hidden.drivers},
                       {"driver_right", line.driver_right},
                       {"component", toString(line.size().component)},
                       {"size", line.size().value},
                       {"size_uncertainty", line.size().uncertainty},
                       {"size_named", line.size_named ? nlohmann::json(line.size_named->value) : nlohmann::json()},
                       {"size_named_unit", line.size_named ? nlohmann::json(line.size_named->unit) : nlohmann::json()},
                       {"size_right", line.size_right},
                       {"unit", unitOf(line.size().component)},
                       {"marks", line.marks}});
  }
  return {{"score", total},
          {"effects", effects},
          {"wrong", wrong},
          {"hints_used", answer.hints},
          {"searched_before", answer.searched_before}};
}

std::string ExerciseScore::text() const {
  std::string out;
  for (const Line& line : lines) {
    out +=
        fmt::format("{}: {}", effectTitle(line.hidden.id),
                    line.exact           ? "named"
                    : line.named.empty() ? "not named"
                                         : fmt::format("{} named, which is nested with it", effectTitle(line.named)));
    if (line.exact) {
      if (!line.hidden.drivers.empty())
        out += line.driver_right ? "; driver right"
                                 : fmt::format("; driver: {}", driversInWords(joinedList(line.hidden.drivers, "or")));
      out += fmt::format("; size {:.1f} ± {:.1f} {} in {}", line.size().value, line.size().uncertainty,
                         printedUnit(unitOf(line.size().component)), toString(line.size().component));
      if (line.size_named)
        out += fmt::format(", {:g} {} given: {}", line.size_named->value, printedUnit(line.size_named->unit),
                           line.size_right ? "right" : "off");
    }
    out += "\n";
  }
  for (const std::string& id : wrong) out += fmt::format("{}: not there\n", effectTitle(id));
  return out + fmt::format("score {} of 100\n", total);
}

std::vector<std::string> exerciseHint(const ExerciseKey& key, int number) {
  if (number < 1 || number > exercise_hints)
    throw InputError(fmt::format("hint {}; allowed: 1 to {}.", number, exercise_hints));
  std::set<std::string> out;
  for (const HiddenEffect& hidden : key.hidden) {
    if (number == 1) out.emplace(toString(hidden.sizes.front().component));
    if (number == 2) out.insert(hidden.drivers.empty() ? "none" : hidden.drivers.front());
    if (number == 3) out.insert(hidden.id.substr(0, hidden.id.find('.')));
  }
  return {out.begin(), out.end()};
}

std::string exerciseHintText(const ExerciseKey& key, int number) {
  const std::string names = joinedList(exerciseHint(key, number));
  if (number == 1) return fmt::format("What is missing is largest in {}.", names);
  if (number == 2)
    return names == "none" ? "Nothing in the log drives it."
                           : fmt::format("It is driven by: {}.", driversInWords(names));
  std::string families = names;
  std::replace(families.begin(), families.end(), '_', ' ');
  return fmt::format("It belongs to: {}.", families);
}

}  // namespace spindrift
