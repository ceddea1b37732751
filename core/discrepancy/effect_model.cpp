// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/inside_folder.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/discrepancy/own_effects.h"
#include "core/finite_elements/fe_simulation.h"

namespace spindrift {
namespace {

/// A base that is a table: interpolated in time, and in place where it is one by place.
class TableModel : public ErrorModel {
 public:
  explicit TableModel(SimulationTable table) : table_(std::move(table)) {}
  [[nodiscard]] std::string description() const override { return "a table of predictions"; }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override {
    return {table_.at(query.time_s, query.point, query.position_mm, component).value, 0.0};
  }

 private:
  SimulationTable table_;
};

Effect effectById(const std::vector<Effect>& catalogue, const std::string& id, const JsonNode& node) {
  for (const Effect& effect : catalogue) {
    if (effect.id == id) return effect;
  }
  node.reject("the id of an effect of the catalogue that this machine can have, or of the campaign's effects.json");
}

}  // namespace

std::vector<std::string> ModelEffect::gainNames(const DriverTable& drivers) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < variant.inputs.size(); ++i) {
    const Driver* driver = variant.inputs[i].driver.empty() ? nullptr : drivers.find(variant.inputs[i].driver);
    for (const ShapeColumn& column : effect.shape) {
      std::string name = "gain_" + column.gain_unit;
      if (driver != nullptr && !driver->unit.empty() && driver->unit != "on") name += "_per_" + driver->unit;
      if (variant.inputs[i].dynamics == Dynamics::Start) name += "_at_start";
      int twin = 1;
      std::string unique = name;
      while (std::find(names.begin(), names.end(), unique) != names.end()) unique = fmt::format("{}_{}", name, ++twin);
      names.push_back(unique);
    }
  }
  return names;
}

EffectModel::EffectModel(std::shared_ptr<const DriverTable> drivers, std::vector<ModelEffect> effects,
                         std::shared_ptr<const ErrorModel> base, std::string table)
    : drivers_(std::move(drivers)), effects_(std::move(effects)), base_(std::move(base)), table_(std::move(table)) {}

std::string EffectModel::description() const {
  if (effects_.empty()) return base_ ? base_->description() : "no effects";
  std::vector<std::string> names;
  for (const ModelEffect& e : effects_) names.push_back(e.effect.id);
  const std::string sum = "sum of the effects " + joinedList(names);
  return base_ ? sum + " on top of " + base_->description() : sum;
}

namespace {

/// Of a non-linear parameter, for its derivative.
double stepOf(double parameter) {
  return std::max(1e-3 * std::abs(parameter), 1e-3);
}

/// Responses at some times, and with each parameter moved by its step: times x inputs.
std::vector<Eigen::MatrixXd> movedResponses(const DriverTable& drivers, const ModelEffect& e,
                                            std::span<const double> times) {
  std::vector<Eigen::MatrixXd> out{inputResponses(drivers, e.variant, e.parameters, times)};
  for (std::size_t p = 0; p < e.parameters.size(); ++p) {
    std::vector<double> moved = e.parameters;
    moved[p] += stepOf(moved[p]);
    out.push_back(inputResponses(drivers, e.variant, moved, times));
  }
  return out;
}

/// d value / d (gains, parameters) at one place: `q(i)` of the inputs as they are, `moved(p, i)` with one moved.
template <typename Moved>
Eigen::VectorXd gradientAt(const ModelEffect& e, const Eigen::VectorXd& shape, const Eigen::VectorXd& q,
                           const Moved& moved) {
  const Eigen::Index k = shape.size();
  Eigen::VectorXd gradient(q.size() * k + static_cast<Eigen::Index>(e.parameters.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) gradient.segment(i * k, k) = shape * q[i];
  for (std::size_t p = 0; p < e.parameters.size(); ++p) {
    double change = 0.0;
    for (Eigen::Index i = 0; i < q.size(); ++i) change += (moved(p, i) - q[i]) * shape.dot(e.gains.segment(i * k, k));
    gradient[q.size() * k + static_cast<Eigen::Index>(p)] = change / stepOf(e.parameters[p]);
  }
  return gradient;
}

Eigen::VectorXd shapeAt(const ModelEffect& e, const DeviationQuery& query, Component component) {
  Eigen::VectorXd shape(static_cast<Eigen::Index>(e.effect.shape.size()));
  for (Eigen::Index c = 0; c < shape.size(); ++c)
    shape[c] = e.effect.shape[static_cast<std::size_t>(c)].value(query, component);
  return shape;
}

double varianceOf(const ModelEffect& e, const Eigen::VectorXd& gradient) {
  return e.covariance.rows() == gradient.size() ? std::max(0.0, gradient.dot(e.covariance * gradient)) : 0.0;
}

std::vector<double> distinctTimes(std::span<const Observation> rows) {
  std::vector<double> times;
  times.reserve(rows.size());
  for (const Observation& o : rows) times.push_back(o.time_s);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

std::shared_ptr<const std::vector<EffectModel::Responses>> EffectModel::responsesAt(double time_s) const {
  const std::scoped_lock lock(mutex_);
  if (kept_ != nullptr && kept_time_s_ == time_s) return kept_;
  auto all = std::make_shared<std::vector<Responses>>();
  const double time[1] = {time_s};
  for (const ModelEffect& e : effects_) {
    const std::vector<Eigen::MatrixXd> q = movedResponses(*drivers_, e, time);
    Responses r{q[0].row(0).transpose(), {}};
    for (std::size_t p = 1; p < q.size(); ++p) r.moved.emplace_back(q[p].row(0).transpose());
    all->push_back(std::move(r));
  }
  kept_time_s_ = time_s;
  return kept_ = std::move(all);
}

PredictedComponent EffectModel::predict(const DeviationQuery& query, Component component) const {
  PredictedComponent out;
  if (base_) out = base_->predict(query, component);
  double variance = out.sigma * out.sigma;
  const auto responses = responsesAt(query.time_s);
  for (std::size_t n = 0; n < effects_.size(); ++n) {
    const ModelEffect& e = effects_[n];
    const Eigen::VectorXd shape = shapeAt(e, query, component);
    if (shape.isZero(0.0)) continue;
    const Responses& r = (*responses)[n];
    const Eigen::VectorXd gradient =
        gradientAt(e, shape, r.inputs, [&](std::size_t p, Eigen::Index i) { return r.moved[p][i]; });
    out.value += gradient.head(e.gains.size()).dot(e.gains);
    variance += varianceOf(e, gradient);
  }
  out.sigma = std::sqrt(variance);
  return out;
}

PredictedComponent EffectModel::predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                              Component component) const {
  PredictedComponent out;
  if (base_) out = base_->predictChange(query, reference, component);
  double variance = out.sigma * out.sigma;
  const auto at_query = responsesAt(query.time_s);
  const auto at_reference = responsesAt(reference.time_s);
  for (std::size_t n = 0; n < effects_.size(); ++n) {
    const ModelEffect& e = effects_[n];
    const auto gradient = [&](const DeviationQuery& where, const Responses& r) {
      return gradientAt(e, shapeAt(e, where, component), r.inputs,
                        [&](std::size_t p, Eigen::Index i) { return r.moved[p][i]; });
    };
    const Eigen::VectorXd change = gradient(query, (*at_query)[n]) - gradient(reference, (*at_reference)[n]);
    out.value += change.head(e.gains.size()).dot(e.gains);
    variance += varianceOf(e, change);
  }
  out.sigma = std::sqrt(variance);
  return out;
}

std::vector<double> EffectModel::effectSigma(std::span<const Observation> rows) const {
  const std::vector<double> times = distinctTimes(rows);
  std::vector<double> variance(rows.size(), 0.0);
  for (const ModelEffect& e : effects_) {
    const std::vector<Eigen::MatrixXd> q = movedResponses(*drivers_, e, times);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Eigen::VectorXd shape = shapeAt(e, DeviationQuery::of(rows[r]), rows[r].component);
      if (shape.isZero(0.0)) continue;
      const auto at = std::lower_bound(times.begin(), times.end(), rows[r].time_s) - times.begin();
      const Eigen::VectorXd gradient = gradientAt(e, shape, q[0].row(at).transpose(),
                                                  [&](std::size_t p, Eigen::Index i) { return q[p + 1](at, i); });
      variance[r] += varianceOf(e, gradient);
    }
  }
  for (double& v : variance) v = std::sqrt(v);
  return variance;
}

std::vector<double> EffectModel::contribution(const DriverTable& drivers, const ModelEffect& effect,
                                              std::span<const Observation> rows) {
  const std::vector<double> times = distinctTimes(rows);
  const Eigen::MatrixXd q = inputResponses(drivers, effect.variant, effect.parameters, times);
  const auto k = static_cast<Eigen::Index>(effect.effect.shape.size());
  std::vector<double> out(rows.size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto at = std::lower_bound(times.begin(), times.end(), rows[r].time_s) - times.begin();
    const DeviationQuery query = DeviationQuery::of(rows[r]);
    for (Eigen::Index c = 0; c < k; ++c) {
      const double shape = effect.effect.shape[static_cast<std::size_t>(c)].value(query, rows[r].component);
      if (shape == 0.0) continue;
      for (Eigen::Index i = 0; i < q.cols(); ++i) out[r] += shape * q(at, i) * effect.gains[i * k + c];
    }
  }
  return out;
}

nlohmann::json EffectModel::json() const {
  nlohmann::json effects = nlohmann::json::array();
  for (const ModelEffect& e : effects_) {
    if (e.effect.over_time) continue;  // a parameter of the simulation stands in the simulation
    nlohmann::json parameters = nlohmann::json::object();
    nlohmann::json uncertainty = nlohmann::json::object();
    const auto gains = e.gainNames(*drivers_);
    for (std::size_t g = 0; g < gains.size(); ++g) {
      parameters[gains[g]] = jsonNumber(e.gains[static_cast<Eigen::Index>(g)]);
      uncertainty[gains[g]] = jsonNumber(e.gain_uncertainty[static_cast<Eigen::Index>(g)]);
    }
    const auto names = parameterNames(e.variant);
    for (std::size_t p = 0; p < names.size(); ++p) {
      parameters[names[p]] = jsonNumber(e.parameters[p]);
      uncertainty[names[p]] = jsonNumber(e.parameter_uncertainty[p]);
    }
    nlohmann::json inputs = nlohmann::json::array();
    for (const EffectInput& input : e.variant.inputs) {
      inputs.push_back({{"driver", input.driver}, {"dynamics", std::string(toString(input.dynamics))}});
    }
    effects.push_back({{"id", e.effect.id},
                       {"parameters", parameters},
                       {"standard_uncertainty", uncertainty},
                       {"inputs", inputs},
                       {"shared_lag", e.variant.shared_lag},
                       {"source", e.source}});
  }
  nlohmann::json out{{"format", "spindrift-error-model"}, {"version", 1}, {"effects", effects}};
  if (!table_.empty()) out["table"] = table_;
  return out;
}

namespace {

/// Names in `parameters` that are those of gains, lags, onsets and lengths.
std::vector<std::string> namesGiven(const JsonNode& parameters) {
  std::vector<std::string> names;
  for (const auto& [name, value] : parameters.members()) {
    for (const char* kind : {"gain_", "tau", "onset", "length"}) {
      if (!name.starts_with(kind)) continue;
      names.push_back(name);
      break;
    }
  }
  return names;
}

/// Of an effect that was written by hand, without its inputs: the way in which it is driven whose names are those that
/// are given, the one with the fewest gains that are not; of several the first.
EffectVariant variantGiven(ModelEffect e, const JsonNode& parameters, const DriverTable& drivers) {
  const std::vector<std::string> given = namesGiven(parameters);
  const auto isGiven = [&](const std::string& name) {
    return std::find(given.begin(), given.end(), name) != given.end();
  };
  const EffectVariant* best = nullptr;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  std::vector<std::string> ways;
  std::size_t closest = 0;  // how many of the names the way that is told has
  for (const EffectVariant& variant : e.effect.variants) {
    e.variant = variant;
    const std::vector<std::string> gains = e.gainNames(drivers);
    const std::vector<std::string> lags = parameterNames(variant);
    std::vector<std::string> all = gains;
    all.insert(all.end(), lags.begin(), lags.end());
    const auto known = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), isGiven));
    if (known >= closest || ways.empty()) {
      if (known > closest) ways.clear();
      closest = known;
      const std::string way = joinedList(all);
      if (ways.size() < 3 && std::find(ways.begin(), ways.end(), way) == ways.end()) ways.push_back(way);
    }
    const auto gains_given = static_cast<std::size_t>(std::count_if(gains.begin(), gains.end(), isGiven));
    const bool fits = known == given.size() && gains_given > 0 && std::all_of(lags.begin(), lags.end(), isGiven);
    if (!fits || gains.size() - gains_given >= fewest) continue;
    fewest = gains.size() - gains_given;
    best = &variant;
  }
  if (best == nullptr) {
    throw InputError(
        parameters.place(),
        fmt::format("the parameters {} are not those of one way in which the signals in log.csv drive {}; allowed: {}.",
                    given.empty() ? std::string("(none)") : joinedList(given), e.effect.id,
                    ways.empty() ? std::string("an effect that something in the log drives") : joinedList(ways, "or")));
  }
  return *best;
}

}  // namespace

std::shared_ptr<const EffectModel> EffectModel::read(const std::filesystem::path& file,
                                                     const MachineDescription& machine, const OperatingLog* log,
                                                     const std::vector<std::string>& points, const OwnEffects* own,
                                                     bool absolute) {
  const JsonNode root = JsonNode::read(file);
  root.requireFormat("spindrift-error-model", 1);
  auto drivers = std::make_shared<DriverTable>(machine, log);
  CatalogueContext context;
  context.machine = &machine;
  context.drivers = drivers.get();
  context.points = points;
  context.point_count = points.size();
  context.varying_approach = {"x", "y", "z"};
  context.c_varies = true;
  context.position_varies = true;
  std::vector<Effect> catalogue = effectCatalogue(context);
  if (own != nullptr) {
    for (Effect& effect : own->bind(*drivers, log, machine.reference_temperature_degC, absolute)) {
      catalogue.push_back(std::move(effect));
    }
  }
  std::vector<ModelEffect> effects;
  for (const JsonNode& node : root.at("effects").items()) {
    ModelEffect e;
    e.effect = effectById(catalogue, node.at("id").name(), node.at("id"));
    const JsonNode parameters = node.at("parameters");
    if (const auto inputs = node.find("inputs")) {
      for (const JsonNode& input : inputs->items()) {
        EffectInput parsed;
        parsed.driver = input.stringOr("driver", "");
        const std::string dynamics =
            input.at("dynamics").oneOf({"none", "lag", "asymmetric_lag", "step", "pulse", "start"});
        for (const Dynamics d : {Dynamics::None, Dynamics::Lag, Dynamics::AsymmetricLag, Dynamics::Step,
                                 Dynamics::Pulse, Dynamics::Start}) {
          if (toString(d) == dynamics) parsed.dynamics = d;
        }
        if (!parsed.driver.empty() && !drivers->has(parsed.driver)) {
          input.at("driver").reject("a driver that log.csv holds");
        }
        if (parsed.driver.empty() && (parsed.dynamics == Dynamics::Lag || parsed.dynamics == Dynamics::AsymmetricLag)) {
          input.reject("a time constant together with its driver");
        }
        e.variant.inputs.push_back(parsed);
      }
      if (e.variant.inputs.empty()) inputs->reject("at least one input");
      e.variant.shared_lag = node.booleanOr("shared_lag", false);
    } else {
      e.variant = variantGiven(e, parameters, *drivers);
    }
    const auto gains = e.gainNames(*drivers);
    e.gains.resize(static_cast<Eigen::Index>(gains.size()));
    e.gain_uncertainty = Eigen::VectorXd::Zero(e.gains.size());
    const auto uncertainty = node.find("standard_uncertainty");
    const auto uncertaintyOf = [&](const std::string& name) {
      return uncertainty && uncertainty->has(name) ? uncertainty->at(name).nonNegativeNumber() : 0.0;
    };
    for (std::size_t g = 0; g < gains.size(); ++g) {
      // One beside others that is not written is zero: a constant, the part of another input.
      const auto given = parameters.find(gains[g]);
      e.gains[static_cast<Eigen::Index>(g)] = given ? given->number() : 0.0;
      e.gain_uncertainty[static_cast<Eigen::Index>(g)] = uncertaintyOf(gains[g]);
    }
    for (const std::string& name : parameterNames(e.variant)) {
      const bool lag = name.starts_with("tau");
      e.parameters.push_back(lag ? parameters.at(name).nonNegativeNumber() : parameters.at(name).number());
      e.parameter_uncertainty.push_back(uncertaintyOf(name));
    }
    Eigen::VectorXd sd(e.gains.size() + static_cast<Eigen::Index>(e.parameters.size()));
    sd.head(e.gains.size()) = e.gain_uncertainty;
    for (std::size_t p = 0; p < e.parameters.size(); ++p) {
      sd[e.gains.size() + static_cast<Eigen::Index>(p)] = e.parameter_uncertainty[p];
    }
    e.covariance = sd.array().square().matrix().asDiagonal();
    e.source = node.stringOr("source", "");
    effects.push_back(std::move(e));
  }
  std::shared_ptr<const ErrorModel> base;
  const std::string table = root.stringOr("table", "");
  if (!table.empty()) {
    std::vector<std::string> told_before;  // when the table was compared with observations
    base = std::make_shared<TableModel>(
        readSimulation(InsideFolder(file.parent_path()).path(table, root.at("table").place()), told_before));
  }
  return std::make_shared<EffectModel>(drivers, std::move(effects), base, table);
}

}  // namespace spindrift
