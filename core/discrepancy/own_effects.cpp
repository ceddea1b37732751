// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/own_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>
#include <unordered_map>

#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/discrepancy/effect_titles.h"

namespace spindrift {
namespace {

constexpr std::string_view own_prefix = "log:";
/// Gains that one way of an effect may have: inputs times shape columns.
constexpr std::size_t most_gains = 16;

const std::vector<std::string>& variableNames() {
  static const std::vector<std::string> names{"x", "y", "z", "c", "dirx", "diry", "dirz"};
  return names;
}

/// Rethrows the complaint about a text with its place.
Expression expressionAt(const JsonNode& node) {
  const std::string text = node.string();
  try {
    return Expression(text, variableNames());
  } catch (const InputError& wrong) {
    throw InputError(node.place(), wrong.what());
  }
}

std::vector<std::vector<OwnDriver>> driversAt(const JsonNode& node) {
  std::vector<std::vector<OwnDriver>> out;
  for (const JsonNode& item : node.items()) {
    std::vector<OwnDriver> inputs;
    if (item.value().is_array()) {
      for (const JsonNode& input : item.items()) {
        const std::string text = input.name();
        for (const OwnDriver& other : inputs) {
          if (other.text == text) input.reject("each driver once among inputs that act together");
        }
        inputs.push_back({text, input.place()});
      }
      if (inputs.empty()) item.reject("at least one driver in a list of inputs that act together");
    } else {
      if (!item.value().is_string()) {
        item.reject(
            "the name of a column of log.csv, with a power such as \"spindle_rpm^1.5\", or a list of such names");
      }
      inputs.push_back({item.name(), item.place()});
    }
    out.push_back(std::move(inputs));
  }
  return out;
}

Dynamics dynamicsAt(const JsonNode& root, bool driven) {
  const auto node = root.find("dynamics");
  if (!node) return Dynamics::None;
  const std::string word = node->oneOf({"none", "lag", "step", "pulse"});
  if (word == "lag" && !driven)
    node->reject("\"lag\" with at least one driver, or \"none\", \"step\", \"pulse\" without");
  if ((word == "step" || word == "pulse") && driven) {
    node->reject("\"" + word + "\" without drivers (its time is unknown), or \"none\" or \"lag\" with them");
  }
  return word == "lag"     ? Dynamics::Lag
         : word == "step"  ? Dynamics::Step
         : word == "pulse" ? Dynamics::Pulse
                           : Dynamics::None;
}

std::optional<std::array<double, 2>> lagBoundsAt(const JsonNode& root) {
  const auto node = root.find("tau_s");
  if (!node) return std::nullopt;
  const std::vector<double> bounds = node->numbers();
  if (bounds.size() != 2) node->reject("two bounds in s, the smaller first, such as [60, 20000]");
  if (!(bounds[0] >= 0.0) || !(bounds[1] > bounds[0])) {
    node->reject("two bounds in s, not negative and the smaller first, such as [60, 20000]");
  }
  return std::array<double, 2>{bounds[0], bounds[1]};
}

std::string formulaOf(const std::vector<std::vector<OwnExpression>>& shape) {
  std::vector<std::string> columns;
  for (const auto& column : shape) {
    std::vector<std::string> parts;
    for (const OwnExpression& e : column) {
      parts.push_back(fmt::format("{} = g{} ({})", toString(e.component),
                                  shape.size() > 1 ? fmt::format("{}", columns.size() + 1) : "", e.value.text()));
    }
    columns.push_back(joinedList(parts, ","));
  }
  std::string out;
  for (const std::string& column : columns) out += (out.empty() ? "" : "; ") + column;
  return out;
}

/// Value of a column at one place: 0 in components that have no expression.
ShapeFunction shapeFunction(const std::vector<OwnExpression>& column) {
  std::array<std::optional<Expression>, 6> of;
  for (const OwnExpression& e : column) of[static_cast<std::size_t>(e.component)] = e.value;
  return [of](const DeviationQuery& q, Component c) {
    const auto& expression = of[static_cast<std::size_t>(c)];
    if (!expression) return 0.0;
    const std::array<double, 7> at{
        q.position_mm.x(), q.position_mm.y(), q.position_mm.z(), q.c_deg * std::numbers::pi / 180.0,
        q.approach.x(),    q.approach.y(),    q.approach.z()};
    return (*expression)(at);
  };
}

std::vector<OwnExpression> columnAt(const JsonNode& node) {
  std::vector<OwnExpression> out;
  for (const auto& [key, value] : node.members()) {
    const auto component = componentFromString(key);
    if (!component) continue;
    out.push_back({*component, expressionAt(value), value.place()});
  }
  if (out.empty()) node.reject("an expression for at least one of EX, EY, EZ, EA, EB, EC");
  return out;
}

OwnEffect effectAt(const JsonNode& node) {
  OwnEffect out;
  out.place = node.place();
  Effect& effect = out.effect;
  effect.own = true;
  effect.of_machine = false;
  effect.id = node.at("id").name();
  effect.title = node.stringOr("title", effect.id);
  effect.physics = node.stringOr("physics", "");
  if (const auto drivers = node.find("drivers")) out.drivers = driversAt(*drivers);
  out.dynamics = dynamicsAt(node, !out.drivers.empty());
  effect.tau_s = lagBoundsAt(node);
  if (const auto sign = node.find("sign")) {
    const double value = sign->number();
    if (value != -1.0 && value != 0.0 && value != 1.0) sign->reject("-1, 0 or 1");
    effect.sign = static_cast<int>(value);
  }
  const JsonNode shape = node.at("shape");
  for (const JsonNode& column : shape.items()) {
    out.shape.push_back(columnAt(column));
    effect.shape.push_back({column.at("gain_unit").name(), shapeFunction(out.shape.back())});
  }
  if (out.shape.empty()) shape.reject("a list with one entry for every gain, at least one");
  std::size_t inputs = 1;
  for (const auto& alternative : out.drivers) inputs = std::max(inputs, alternative.size());
  if (inputs * out.shape.size() > most_gains) {
    throw InputError(out.place, fmt::format("{} inputs with {} gains each are not allowed; allowed: at most {} gains "
                                            "at a time.",
                                            inputs, out.shape.size(), most_gains));
  }
  effect.formula = formulaOf(out.shape);
  if (const auto references = node.find("references")) {
    for (const JsonNode& item : references->items()) effect.references.push_back(item.string());
  }
  return out;
}

/// Column and power: "T_room_degC", "spindle_rpm^1.5".
std::pair<std::string, double> columnAndPower(const OwnDriver& driver, const OperatingLog& log) {
  if (log.has(driver.text)) return {driver.text, 1.0};
  const auto refuse = [&](std::string_view why) -> InputError {
    return {driver.place, fmt::format("\"{}\" {}; allowed: {}, each with a power such as \"^1.5\" if need be.",
                                      driver.text, why, joinedList(log.names(), "or"))};
  };
  const std::size_t caret = driver.text.rfind('^');
  if (caret == std::string::npos || !log.has(driver.text.substr(0, caret))) throw refuse("is not a column of log.csv");
  const std::string digits = driver.text.substr(caret + 1);
  double power = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(power) || power == 0.0) {
    throw refuse("has a power that is not a number other than zero");
  }
  return {driver.text.substr(0, caret), power};
}

/// The driver at the times of the table, which has a row more in every gap of the log.
Driver driverOf(const OwnDriver& own, const DriverTable& table, const OperatingLog& log,
                double reference_temperature_degC, bool absolute) {
  const auto [column, power] = columnAndPower(own, log);
  const std::vector<double>& logged = *log.signal(column);
  const bool temperature = OperatingLog::isTemperature(column);
  Driver driver;
  driver.name = ownDriverName(own.text);
  driver.unit = "";
  driver.linear = temperature;
  driver.settled = temperature && absolute;
  const double zero = !temperature ? 0.0 : absolute ? reference_temperature_degC : logged.front();
  const std::vector<double>& time_s = log.time_s();
  std::size_t row = 0;
  for (const double t : table.time_s()) {
    const bool exact = row < time_s.size() && time_s[row] == t;
    const double value = (exact ? logged[row] : log.at(column, t)) - zero;
    if (exact) ++row;
    const double raised = power == 1.0 ? value : std::pow(value, power);
    if (!std::isfinite(raised)) {
      throw InputError(own.place, fmt::format("\"{}\" has no value at {} s, where {} is {:g}; allowed: powers that "
                                              "every value of the column has.",
                                              own.text, t, column, value));
    }
    driver.values.push_back(raised);
  }
  return driver;
}

}  // namespace

std::string ownDriverName(std::string_view text) {
  return std::string(own_prefix) + std::string(text);
}

std::string_view driverAsWritten(std::string_view name) {
  return name.starts_with(own_prefix) ? name.substr(own_prefix.size()) : name;
}

std::shared_ptr<const OwnEffects> OwnEffects::read(const std::filesystem::path& file) {
  return parseNode(JsonNode::read(file), file);
}

std::shared_ptr<const OwnEffects> OwnEffects::parse(std::string_view text, const std::filesystem::path& name) {
  return parseNode(JsonNode::parse(text, name), name);
}

std::shared_ptr<const OwnEffects> OwnEffects::parseNode(const JsonNode& root, const std::filesystem::path& file) {
  root.requireFormat("spindrift-effects", 1);
  auto out = std::make_shared<OwnEffects>();
  out->file_ = file;
  out->built_in_ = root.booleanOr("built_in", true);
  std::set<std::string> ids;
  const std::vector<JsonNode> nodes = root.at("effects").items();
  for (const JsonNode& node : nodes) {
    OwnEffect effect = effectAt(node);
    const std::string& id = effect.effect.id;
    if (!ids.insert(id).second) node.at("id").reject("each id once");
    if (out->built_in_ && effectTitleOf(id)) {
      node.at("id").reject("an id that no effect of the catalogue has, or \"built_in\": false");
    }
    out->effects_.push_back(std::move(effect));
  }
  for (std::size_t e = 0; e < nodes.size(); ++e) {
    const auto contains = nodes[e].find("contains");
    if (!contains) continue;
    for (const JsonNode& item : contains->items()) {
      const std::string id = item.name();
      if (id == out->effects_[e].effect.id || (!ids.contains(id) && !(out->built_in_ && effectTitleOf(id)))) {
        item.reject("the id of another effect of this file" +
                    std::string(out->built_in_ ? " or of the catalogue" : ""));
      }
      out->effects_[e].effect.contains.push_back(id);
    }
  }
  if (out->effects_.empty() && !out->built_in_) {
    root.at("effects").reject("at least one effect, or \"built_in\": true");
  }
  return out;
}

bool OwnEffects::anyLag() const {
  return std::any_of(effects_.begin(), effects_.end(), [](const OwnEffect& e) { return e.dynamics == Dynamics::Lag; });
}

const OwnEffect* OwnEffects::find(std::string_view id) const {
  const auto found =
      std::find_if(effects_.begin(), effects_.end(), [&](const OwnEffect& e) { return e.effect.id == id; });
  return found == effects_.end() ? nullptr : &*found;
}

std::vector<Effect> OwnEffects::bind(DriverTable& drivers, const OperatingLog* log, double reference_temperature_degC,
                                     bool absolute) const {
  std::vector<Effect> out;
  std::set<std::string> known;
  for (const OwnEffect& own : effects_) {
    Effect effect = own.effect;
    if (own.drivers.empty()) effect.variants.push_back({{{"", own.dynamics}}, false});
    for (const std::vector<OwnDriver>& alternative : own.drivers) {
      EffectVariant variant;
      bool alive = true;
      for (const OwnDriver& driver : alternative) {
        if (log == nullptr || log->empty()) {
          throw InputError(driver.place,
                           fmt::format("\"{}\" needs a log.csv, which the campaign does not have; allowed: "
                                       "effects without drivers.",
                                       driver.text));
        }
        const std::string name = ownDriverName(driver.text);
        if (known.insert(name).second) {
          drivers.addOwn(driverOf(driver, drivers, *log, reference_temperature_degC, absolute));
        }
        alive = alive && drivers.has(name);
        variant.inputs.push_back({name, own.dynamics});
      }
      variant.shared_lag = variant.inputs.size() > 1;
      if (alive) effect.variants.push_back(std::move(variant));
    }
    out.push_back(std::move(effect));
  }
  return out;
}

void OwnEffects::check(std::vector<Effect>& effects, const std::vector<Observation>& rows,
                       std::vector<std::string>& warnings) const {
  std::vector<std::string> zero;
  std::vector<std::string> undriven;
  for (const OwnEffect& own : effects_) {
    bool seen = false;
    for (const Observation& o : rows) {
      if (o.use == ObservationUse::Exclude) continue;
      const DeviationQuery query = DeviationQuery::of(o);
      for (std::size_t k = 0; k < own.shape.size(); ++k) {
        const double value = own.effect.shape[k].value(query, o.component);
        if (!std::isfinite(value)) {
          const auto wrong = std::find_if(own.shape[k].begin(), own.shape[k].end(),
                                          [&](const OwnExpression& e) { return e.component == o.component; });
          throw InputError(
              wrong->place,
              fmt::format("expression \"{}\" of {} is {} at point {} (x {:g} mm, y {:g} mm, z {:g} mm, c "
                          "{:g}°); allowed: expressions that are finite at every point observed.",
                          wrong->value.text(), toString(o.component), std::isnan(value) ? "not a number" : "infinite",
                          o.point, printed(o.position_mm.x()), printed(o.position_mm.y()), printed(o.position_mm.z()),
                          printed(o.c_deg)));
        }
        // What is left of a zero by rounding, as sin(pi), is none.
        if (std::abs(value) > 1e-12 && o.use == ObservationUse::Fit) seen = true;
      }
    }
    const std::string& id = own.effect.id;
    const auto bound = std::find_if(effects.begin(), effects.end(), [&](const Effect& e) { return e.id == id; });
    if (bound == effects.end()) continue;
    if (!seen) {
      zero.push_back(id);
      effects.erase(bound);
    } else if (bound->variants.empty()) {
      undriven.push_back(id);
    }
  }
  if (!zero.empty()) {
    warnings.push_back(
        fmt::format("Left out, because the shape is zero at every point observed: {}.", joinedList(zero)));
  }
  if (!undriven.empty()) {
    warnings.push_back(
        fmt::format("Cannot be tried, because the drivers never leave zero in this log: {}.", joinedList(undriven)));
  }
}

}  // namespace spindrift
