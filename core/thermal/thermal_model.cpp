// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/thermal_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/math/distributions.h"

namespace spindrift {

double ThermalInput::transformed(double u) const noexcept {
  const double v = u / scale;
  return power == 1.0 ? v : std::copysign(std::pow(std::abs(v), power), v);
}

LagStep lagStep(double dt_s, double tau_s, bool hold) noexcept {
  if (tau_s <= 0.0) return {0.0, 0.0, 1.0};
  const double h = dt_s / tau_s;
  const double a = std::exp(-h);
  const double gone = -std::expm1(-h);  // 1 - a
  if (hold || h <= 0.0) return {a, gone, 0.0};
  // (1 - a) / h without cancellation for small h.
  const double mean = h < 1e-4 ? 1.0 - h / 2.0 + h * h / 6.0 : gone / h;
  return {a, mean - a, 1.0 - mean};
}

std::vector<double> lagFiltered(std::span<const double> time_s, std::span<const double> u, double tau_s, bool hold) {
  SPINDRIFT_ASSERT(time_s.size() == u.size(), "time and input differ in length");
  std::vector<double> x(u.begin(), u.end());
  if (tau_s <= 0.0 || u.empty()) return x;
  double last_dt = -1.0;
  LagStep step;
  for (std::size_t i = 1; i < u.size(); ++i) {
    const double dt = time_s[i] - time_s[i - 1];
    if (dt != last_dt) step = lagStep(dt, tau_s, hold);
    last_dt = dt;
    x[i] = step.a * x[i - 1] + step.b0 * u[i - 1] + step.b1 * u[i];
  }
  return x;
}

std::vector<double> lagSensitivity(std::span<const double> time_s, std::span<const double> u, double tau_s, bool hold) {
  SPINDRIFT_ASSERT(time_s.size() == u.size(), "time and input differ in length");
  std::vector<double> s(u.size(), 0.0);
  if (tau_s <= 0.0 || u.empty()) return s;
  double last_dt = -1.0;
  LagStep step;
  LagStep slope;  // of its coefficients by ln tau
  double x = u.front();
  for (std::size_t i = 1; i < u.size(); ++i) {
    const double dt = time_s[i] - time_s[i - 1];
    if (dt != last_dt) {
      step = lagStep(dt, tau_s, hold);
      const double h = dt / tau_s;
      slope.a = h * step.a;
      if (hold) {
        slope.b0 = -slope.a;
        slope.b1 = 0.0;
      } else {
        // Of the mean (1 - a) / h; the difference of nearly equal numbers only for h that matter.
        const double of_mean = h < 1e-3 ? h / 2.0 - h * h / 3.0 : (-std::expm1(-h) - h * step.a) / h;
        slope.b0 = of_mean - slope.a;
        slope.b1 = -of_mean;
      }
    }
    last_dt = dt;
    s[i] = step.a * s[i - 1] + slope.a * x + slope.b0 * u[i - 1] + slope.b1 * u[i];
    x = step.a * x + step.b0 * u[i - 1] + step.b1 * u[i];
  }
  return s;
}

double ThermalOutput::coverageFactor(double probability) const {
  const double p = 0.5 + 0.5 * probability;
  return degrees_of_freedom > 0.0 ? studentQuantile(p, degrees_of_freedom) : normalQuantile(p);
}

const ThermalOutput* ThermalModel::findOutput(std::string_view name) const noexcept {
  for (const ThermalOutput& output : outputs)
    if (output.name == name) return &output;
  return nullptr;
}

Eigen::MatrixXd ThermalModel::features(const TimeSeries& series, std::size_t which) const {
  SPINDRIFT_ASSERT(which < outputs.size(), "no such output");
  const ThermalOutput& output = outputs[which];
  const auto count = static_cast<Eigen::Index>(series.time_s.size());
  const auto terms = static_cast<Eigen::Index>(output.terms.size());
  const bool with_tau = terms > 0 && output.covariance.rows() == 1 + 2 * terms;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count, 1 + (with_tau ? 2 : 1) * terms);
  out.col(0).setOnes();
  std::vector<std::vector<double>> transformed(inputs.size());
  for (std::size_t k = 0; k < output.terms.size(); ++k) {
    const LagTerm& term = output.terms[k];
    const ThermalInput& input = inputs[term.input];
    const bool hold = holdsUntilNextRow(input.kind);
    std::vector<double>& f = transformed[term.input];
    if (f.empty()) {
      f = bridged(series.time_s, series.at(input.name).values, hold);
      for (double& u : f) u = input.transformed(u);
    }
    const std::vector<double> x = lagFiltered(series.time_s, f, term.tau_s, hold);
    out.col(static_cast<Eigen::Index>(k + 1)) =
        Eigen::Map<const Eigen::VectorXd>(x.data(), count).array() - input.reference;
    if (!with_tau || term.tau_s <= 0.0) continue;
    const std::vector<double> slope = lagSensitivity(series.time_s, f, term.tau_s, hold);
    out.col(1 + terms + static_cast<Eigen::Index>(k)) =
        term.gain * Eigen::Map<const Eigen::VectorXd>(slope.data(), count);
  }
  return out;
}

ThermalPrediction ThermalModel::predict(const TimeSeries& series, std::size_t which) const {
  SPINDRIFT_ASSERT(which < outputs.size(), "no such output");
  const ThermalOutput& output = outputs[which];
  const std::size_t count = series.time_s.size();
  ThermalPrediction prediction;
  prediction.value.resize(count);
  prediction.outside.assign(count, 0);
  std::set<std::string> reported;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool needed = std::any_of(output.terms.begin(), output.terms.end(),
                                    [&](const LagTerm& t) { return t.input == static_cast<int>(i); });
    if (!needed) continue;
    const Signal& signal = series.at(inputs[i].name);
    const std::vector<double> u = bridged(series.time_s, signal.values, holdsUntilNextRow(inputs[i].kind));
    const double margin = 0.02 * (inputs[i].train_max - inputs[i].train_min);
    double worst = 0.0;
    for (std::size_t r = 0; r < count; ++r) {
      const double beyond = std::max(u[r] - inputs[i].train_max, inputs[i].train_min - u[r]);
      if (beyond > margin) {
        prediction.outside[r] = 1;
        worst = std::max(worst, beyond);
      }
    }
    if (worst > 0.0 && reported.insert(inputs[i].name).second) {
      prediction.notes.push_back(fmt::format("{} leaves the range of training ({:.6g} ... {:.6g}) by up to {:.6g}.",
                                             inputs[i].name, inputs[i].train_min, inputs[i].train_max, worst));
    }
  }
  const Eigen::MatrixXd x = features(series, which);
  Eigen::VectorXd coefficients(static_cast<Eigen::Index>(output.terms.size() + 1));
  coefficients[0] = output.offset;
  for (std::size_t k = 0; k < output.terms.size(); ++k)
    coefficients[static_cast<Eigen::Index>(k + 1)] = output.terms[k].gain;
  Eigen::Map<Eigen::VectorXd>(prediction.value.data(), x.rows()) = x.leftCols(coefficients.size()) * coefficients;
  if (output.covariance.rows() == x.cols()) {
    prediction.sigma.resize(count);
    const Eigen::MatrixXd half = x * output.covariance;
    for (std::size_t r = 0; r < count; ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      const double variance = std::max(0.0, half.row(row).dot(x.row(row)));
      prediction.sigma[r] = output.uncertainty_factor * std::sqrt(variance + output.noise_sigma * output.noise_sigma);
    }
  }
  return prediction;
}

StepResponse ThermalModel::stepResponse(std::size_t which, const std::string& input, std::size_t points) const {
  SPINDRIFT_ASSERT(which < outputs.size() && points >= 2, "no such output or no points");
  const ThermalOutput& output = outputs[which];
  StepResponse response;
  response.input = input;
  response.unit = output.unit;
  response.coverage_factor = output.coverageFactor();
  double longest = 0.0;
  double shortest = 1e300;
  for (const LagTerm& term : output.terms) {
    if (inputs[term.input].name != input || term.tau_s <= 0.0) continue;
    longest = std::max(longest, term.tau_s);
    shortest = std::min(shortest, term.tau_s);
  }
  if (longest <= 0.0) longest = shortest = 1.0;
  double from = 0.0;
  for (const ThermalInput& i : inputs) {
    if (i.name != input || !(i.kind == SignalKind::Speed || i.kind == SignalKind::Feed)) continue;
    response.step = std::max(std::abs(i.train_max), std::abs(i.train_min));
    if (response.step == 0.0) response.step = 1.0;
  }
  // Geometric spacing shows fast and slow parts alike.
  const double first = shortest / 10.0;
  const double ratio = std::pow(6.0 * longest / first, 1.0 / static_cast<double>(points - 1));
  const auto terms = static_cast<Eigen::Index>(output.terms.size());
  const bool with_tau = terms > 0 && output.covariance.rows() == 1 + 2 * terms;
  Eigen::VectorXd weights(1 + (with_tau ? 2 : 1) * terms);
  const auto evaluate = [&](double t, double& value, double& sigma) {
    weights.setZero();
    value = 0.0;
    for (std::size_t k = 0; k < output.terms.size(); ++k) {
      const LagTerm& term = output.terms[k];
      if (inputs[term.input].name != input) continue;
      const double size = inputs[term.input].transformed(from + response.step) - inputs[term.input].transformed(from);
      const double w = size * (term.tau_s > 0.0 ? -std::expm1(-t / term.tau_s) : 1.0);
      weights[static_cast<Eigen::Index>(k + 1)] = w;
      value += w * term.gain;
      if (with_tau && term.tau_s > 0.0) {
        const double part = t / term.tau_s;
        weights[1 + terms + static_cast<Eigen::Index>(k)] = -size * term.gain * part * std::exp(-part);
      }
    }
    sigma = output.covariance.rows() == weights.size()
                ? std::sqrt(std::max(0.0, weights.dot(output.covariance * weights)))
                : std::nan("");
  };
  for (std::size_t p = 0; p < points; ++p) {
    const double t = p == 0 ? 0.0 : first * std::pow(ratio, static_cast<double>(p));
    double value = 0.0;
    double sigma = 0.0;
    evaluate(t, value, sigma);
    response.time_s.push_back(t);
    response.value.push_back(value);
    response.sigma.push_back(sigma);
  }
  evaluate(1e6 * longest, response.final_value, response.final_sigma);
  response.time_to_63_percent_s = std::nan("");
  const double level = (1.0 - std::exp(-1.0)) * response.final_value;
  for (std::size_t p = points; p-- > 1;) {
    const double a = response.value[p - 1] - level;
    const double b = response.value[p] - level;
    if (a * b > 0.0 || a == b) continue;
    response.time_to_63_percent_s =
        response.time_s[p - 1] + a / (a - b) * (response.time_s[p] - response.time_s[p - 1]);
    break;
  }
  return response;
}

namespace {

nlohmann::json jsonOf(const ThermalVerdict& v) {
  return {{"good_enough", v.good_enough},
          {"test_s", {v.test_from_s, v.test_to_s}},
          {"test_rms", jsonNumber(v.test_rms)},
          {"reason", v.reason}};
}

ThermalVerdict verdictFrom(const JsonNode& node) {
  ThermalVerdict v;
  v.good_enough = node.at("good_enough").boolean();
  const std::vector<double> test = node.at("test_s").numbers();
  if (test.size() != 2) node.at("test_s").reject("two numbers, from and to");
  v.test_from_s = test[0];
  v.test_to_s = test[1];
  v.test_rms = node.numberOr("test_rms", 0.0);
  v.reason = node.stringOr("reason", "");
  return v;
}

}  // namespace

nlohmann::json ThermalModel::json() const {
  nlohmann::json out = {{"format", "spindrift-thermal-model"},   {"version", 1},         {"kind", kind},
                        {"train_s", {train_from_s, train_to_s}}, {"period_s", period_s}, {"source", source}};
  out["inputs"] = nlohmann::json::array();
  for (const ThermalInput& i : inputs) {
    out["inputs"].push_back({{"name", i.name},
                             {"kind", toString(i.kind)},
                             {"power", i.power},
                             {"scale", i.scale},
                             {"reference", i.reference},
                             {"train_range", {i.train_min, i.train_max}}});
  }
  out["outputs"] = nlohmann::json::array();
  for (const ThermalOutput& o : outputs) {
    nlohmann::json terms = nlohmann::json::array();
    for (std::size_t k = 0; k < o.terms.size(); ++k) {
      const LagTerm& t = o.terms[k];
      nlohmann::json term = {{"input", t.input}, {"tau_s", t.tau_s}, {"gain", t.gain}};
      const auto d = static_cast<Eigen::Index>(k + 1);
      if (o.covariance.rows() > d)
        term["standard_uncertainty"] = jsonNumber(std::sqrt(std::max(0.0, o.covariance(d, d))));
      terms.push_back(term);
    }
    nlohmann::json lower = nlohmann::json::array();
    for (Eigen::Index r = 0; r < o.covariance.rows(); ++r)
      for (Eigen::Index c = 0; c <= r; ++c) lower.push_back(jsonNumber(o.covariance(r, c)));
    out["outputs"].push_back({{"name", o.name},
                              {"unit", o.unit},
                              {"offset", o.offset},
                              {"terms", terms},
                              {"degrees_of_freedom", o.degrees_of_freedom},
                              {"noise_sigma", o.noise_sigma},
                              {"noise_tau_s", o.noise_tau_s},
                              {"uncertainty_factor", o.uncertainty_factor},
                              {"covariance_lower", lower}});
    if (o.verdict) out["outputs"].back()["verdict"] = jsonOf(*o.verdict);
  }
  return out;
}

void ThermalModel::write(const std::filesystem::path& file) const {
  for (const ThermalOutput& o : outputs) {
    if (o.terms.empty())
      throw InputError(fmt::format(
          "the model of {} is not written: it has no equivalent in lags (complex, negative or double poles), and a "
          "constant in its place would be run; use the method response or oe, or let the method be chosen.",
          o.name));
  }
  writeFileAtomically(file, json().dump() + "\n");
}

ThermalModel ThermalModel::read(const std::filesystem::path& file) {
  const JsonNode root = JsonNode::read(file);
  // The result of `thermal identify` and an error model may carry the thermal model as a member.
  if (const auto member = root.find("thermal_model")) return parse(*member);
  if (!root.has("format")) {
    if (const auto member = root.find("model")) return parse(*member);
  }
  return parse(root);
}

ThermalModel ThermalModel::parse(const JsonNode& root) {
  root.requireFormat("spindrift-thermal-model", 1);
  ThermalModel model;
  model.kind = root.at("kind").name();
  const std::vector<double> train = root.at("train_s").numbers();
  if (train.size() != 2) root.at("train_s").reject("two numbers, from and to");
  model.train_from_s = train[0];
  model.train_to_s = train[1];
  model.period_s = root.numberOr("period_s", 0.0);
  model.source = root.stringOr("source", "");
  static const std::map<std::string, SignalKind> kinds = {{"temperature", SignalKind::Temperature},
                                                          {"speed", SignalKind::Speed},
                                                          {"feed", SignalKind::Feed},
                                                          {"switch", SignalKind::Switch},
                                                          {"position", SignalKind::Position},
                                                          {"displacement", SignalKind::Displacement},
                                                          {"other", SignalKind::Other}};
  for (const JsonNode& node : root.at("inputs").items()) {
    ThermalInput input;
    input.name = node.at("name").name();
    input.kind = kinds.at(
        node.at("kind").oneOf({"temperature", "speed", "feed", "switch", "position", "displacement", "other"}));
    input.power = node.at("power").positiveNumber();
    input.scale = node.at("scale").positiveNumber();
    input.reference = node.at("reference").number();
    const std::vector<double> range = node.at("train_range").numbers();
    if (range.size() != 2 || range[0] > range[1]) node.at("train_range").reject("two numbers in ascending order");
    input.train_min = range[0];
    input.train_max = range[1];
    model.inputs.push_back(input);
  }
  for (const JsonNode& node : root.at("outputs").items()) {
    ThermalOutput output;
    output.name = node.at("name").name();
    output.unit = node.stringOr("unit", "um");
    output.offset = node.at("offset").number();
    for (const JsonNode& t : node.at("terms").items()) {
      LagTerm term;
      term.input = t.at("input").integer();
      if (term.input < 0 || term.input >= static_cast<int>(model.inputs.size()))
        t.at("input").reject("the number of an input, from 0");
      term.tau_s = t.at("tau_s").nonNegativeNumber();
      term.gain = t.at("gain").number();
      output.terms.push_back(term);
    }
    output.degrees_of_freedom = node.numberOr("degrees_of_freedom", 0.0);
    output.noise_sigma = node.numberOr("noise_sigma", 0.0);
    output.noise_tau_s = node.numberOr("noise_tau_s", 0.0);
    output.uncertainty_factor = node.numberOr("uncertainty_factor", 1.0);
    if (const auto verdict = node.find("verdict")) output.verdict = verdictFrom(*verdict);
    if (const auto lower = node.find("covariance_lower")) {
      const std::vector<double> values = lower->numbers();
      auto n = static_cast<Eigen::Index>(output.terms.size() + 1);
      if (!values.empty()) {
        const auto found = static_cast<Eigen::Index>(values.size());
        if (found != n * (n + 1) / 2) n += static_cast<Eigen::Index>(output.terms.size());
        if (found != n * (n + 1) / 2)
          lower->reject("the lower triangle of a square matrix of 1 + terms or 1 + 2 terms rows");
        output.covariance.resize(n, n);
        std::size_t k = 0;
        for (Eigen::Index r = 0; r < n; ++r)
          for (Eigen::Index c = 0; c <= r; ++c) output.covariance(r, c) = output.covariance(c, r) = values[k++];
      }
    }
    model.outputs.push_back(std::move(output));
  }
  if (model.outputs.empty()) root.at("outputs").reject("at least one output");
  return model;
}

}  // namespace spindrift
