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
  const double v = acting(u) / scale;
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

namespace {

/// One lag on its way through the rows, and its derivative by ln tau where that is asked for.
class LagRun {
 public:
  LagRun(double tau_s, bool hold) : tau_s_(tau_s), hold_(hold) {}

  /// At rest at the first input.
  void start(double u) noexcept {
    x_ = u;
    s_ = 0.0;
  }
  void advance(double dt_s, double u0, double u1) noexcept {
    if (dt_s != last_dt_s_) prepare(dt_s);
    x_ = step_.a * x_ + step_.b0 * u0 + step_.b1 * u1;
  }
  void advanceWithSlope(double dt_s, double u0, double u1) noexcept {
    if (dt_s != last_dt_s_) prepare(dt_s);
    s_ = step_.a * s_ + slope_.a * x_ + slope_.b0 * u0 + slope_.b1 * u1;
    x_ = step_.a * x_ + step_.b0 * u0 + step_.b1 * u1;
  }
  [[nodiscard]] double value() const noexcept { return x_; }
  [[nodiscard]] double slope() const noexcept { return s_; }

 private:
  void prepare(double dt_s) noexcept {
    last_dt_s_ = dt_s;
    step_ = lagStep(dt_s, tau_s_, hold_);
    slope_ = {0.0, 0.0, 0.0};
    if (tau_s_ <= 0.0) return;
    const double h = dt_s / tau_s_;
    slope_.a = h * step_.a;
    if (hold_) {
      slope_.b0 = -slope_.a;
    } else {
      // Of the mean (1 - a) / h; the difference of nearly equal numbers only for h that matter.
      const double of_mean = h < 1e-3 ? h / 2.0 - h * h / 3.0 : (-std::expm1(-h) - h * step_.a) / h;
      slope_.b0 = of_mean - slope_.a;
      slope_.b1 = -of_mean;
    }
  }

  double tau_s_;
  bool hold_;
  double last_dt_s_ = -1.0;
  LagStep step_;
  LagStep slope_;  // of its coefficients by ln tau
  double x_ = 0.0;
  double s_ = 0.0;
};

constexpr Eigen::Index rows_at_a_time = 2048;

/// The rows of ThermalModel::features, some at a time from the first to the last, so that a day at ten rows a second
/// needs no matrix of all of them.
class FeatureRows {
 public:
  FeatureRows(const ThermalModel& model, std::size_t which, const TimeSeries& series)
      : time_s_(series.time_s), output_(model.outputs[which]) {
    const auto terms = static_cast<Eigen::Index>(output_.terms.size());
    with_tau_ = terms > 0 && output_.covariance.rows() == 1 + 2 * terms;
    bridged_.resize(model.inputs.size());
    std::vector<std::span<const double>> values(model.inputs.size());
    for (const LagTerm& term : output_.terms) {
      const auto i = static_cast<std::size_t>(term.input);
      const ThermalInput& input = model.inputs[i];
      const bool hold = holdsUntilNextRow(input.kind);
      if (values[i].empty()) {
        const std::vector<double>& raw = series.at(input.name).values;
        values[i] = raw;
        if (!std::all_of(raw.begin(), raw.end(), [](double v) { return std::isfinite(v); })) {
          bridged_[i] = bridged(series.time_s, raw, hold);
          values[i] = bridged_[i];
        }
      }
      columns_.push_back({&input, values[i], LagRun(term.tau_s, hold)});
    }
  }

  [[nodiscard]] Eigen::Index width() const noexcept {
    return 1 + (with_tau_ ? 2 : 1) * static_cast<Eigen::Index>(columns_.size());
  }

  /// The next rows of `out`, as many as it has; `first` is the number of the first of them.
  void next(Eigen::Index first, Eigen::Ref<Eigen::MatrixXd> out) {
    const auto terms = static_cast<Eigen::Index>(columns_.size());
    out.col(0).setOnes();
    std::vector<double> f(static_cast<std::size_t>(out.rows()) + 1);
    const ThermalInput* known = nullptr;
    for (Eigen::Index k = 0; k < terms; ++k) {
      Column& column = columns_[static_cast<std::size_t>(k)];
      const LagTerm& term = output_.terms[static_cast<std::size_t>(k)];
      if (column.input != known) {  // f[0] is the row before
        for (std::size_t r = 0; r < f.size(); ++r) {
          const auto row = static_cast<std::size_t>(first) + r;
          f[r] = row == 0 ? column.input->transformed(column.values[0])
                          : column.input->transformed(column.values[row - 1]);
        }
        known = column.input;
      }
      const bool slopes = with_tau_ && term.tau_s > 0.0;
      if (with_tau_) out.col(1 + terms + k).setZero();
      for (Eigen::Index r = 0; r < out.rows(); ++r) {
        const Eigen::Index row = first + r;
        const auto at = static_cast<std::size_t>(r);
        if (term.tau_s <= 0.0) {
          out(r, k + 1) = f[at + 1] - column.input->reference;
          continue;
        }
        if (row == 0) {
          column.lag.start(f[1]);
        } else {
          const double dt_s = time_s_[static_cast<std::size_t>(row)] - time_s_[static_cast<std::size_t>(row) - 1];
          if (slopes) {
            column.lag.advanceWithSlope(dt_s, f[at], f[at + 1]);
          } else {
            column.lag.advance(dt_s, f[at], f[at + 1]);
          }
        }
        out(r, k + 1) = column.lag.value() - column.input->reference;
        if (slopes) out(r, 1 + terms + k) = term.gain * column.lag.slope();
      }
    }
  }

 private:
  struct Column {
    const ThermalInput* input = nullptr;
    std::span<const double> values;
    LagRun lag;
  };
  std::span<const double> time_s_;
  const ThermalOutput& output_;
  bool with_tau_ = false;
  std::vector<std::vector<double>> bridged_;
  std::vector<Column> columns_;
};

}  // namespace

std::vector<double> lagFiltered(std::span<const double> time_s, std::span<const double> u, double tau_s, bool hold) {
  SPINDRIFT_ASSERT(time_s.size() == u.size(), "time and input differ in length");
  std::vector<double> x(u.begin(), u.end());
  if (tau_s <= 0.0 || u.empty()) return x;
  LagRun lag(tau_s, hold);
  lag.start(u.front());
  for (std::size_t i = 1; i < u.size(); ++i) {
    lag.advance(time_s[i] - time_s[i - 1], u[i - 1], u[i]);
    x[i] = lag.value();
  }
  return x;
}

std::vector<double> lagSensitivity(std::span<const double> time_s, std::span<const double> u, double tau_s, bool hold) {
  SPINDRIFT_ASSERT(time_s.size() == u.size(), "time and input differ in length");
  std::vector<double> s(u.size(), 0.0);
  if (tau_s <= 0.0 || u.empty()) return s;
  LagRun lag(tau_s, hold);
  lag.start(u.front());
  for (std::size_t i = 1; i < u.size(); ++i) {
    lag.advanceWithSlope(time_s[i] - time_s[i - 1], u[i - 1], u[i]);
    s[i] = lag.slope();
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
  FeatureRows rows(*this, which, series);
  const auto count = static_cast<Eigen::Index>(series.time_s.size());
  Eigen::MatrixXd out(count, rows.width());
  if (count > 0) rows.next(0, out);
  return out;
}

std::vector<char> ThermalModel::outsideTraining(const TimeSeries& series, std::size_t which) const {
  SPINDRIFT_ASSERT(which < outputs.size(), "no such output");
  const ThermalOutput& output = outputs[which];
  return outsideTraining(output.pattern ? output.pattern->novelty(series) : std::vector<double>(), series, which,
                         nullptr);
}

std::vector<char> ThermalModel::outsideTraining(const std::vector<double>& novelty, const TimeSeries& series,
                                                std::size_t which, std::vector<std::string>* notes) const {
  const std::size_t count = series.time_s.size();
  const bool jointly = novelty.size() == count;
  std::vector<char> outside(count, 0);
  std::size_t marked = 0;
  for (std::size_t r = 0; r < novelty.size(); ++r) {
    outside[r] = novelty[r] > 1.0 ? 1 : 0;
    marked += static_cast<std::size_t>(outside[r]);
  }
  if (marked > 0 && notes != nullptr) {
    const auto furthest = std::max_element(novelty.begin(), novelty.end());
    notes->push_back(
        fmt::format("in {} of {} rows the combination of inputs is outside that of the training (by a factor of up to "
                    "{:.1f}); the interval is wider there.",
                    marked, count, *furthest));
    const std::vector<std::string> apart =
        outputs[which].pattern->apart(series, static_cast<std::size_t>(furthest - novelty.begin()));
    if (!apart.empty()) {
      notes->push_back(
          fmt::format("{} and {} are collinear in the training and separate here: their effects cannot be "
                      "distinguished from the training; vary one without the other there.",
                      apart[0], apart[1]));
    }
  }
  if (jointly && notes == nullptr) return outside;
  std::set<std::string> reported;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::vector<LagTerm>& terms = outputs[which].terms;
    if (std::none_of(terms.begin(), terms.end(), [&](const LagTerm& t) { return t.input == static_cast<int>(i); }))
      continue;
    const Signal& signal = series.at(inputs[i].name);
    const std::vector<double> u = bridged(series.time_s, signal.values, holdsUntilNextRow(inputs[i].kind));
    const double margin = 0.02 * (inputs[i].train_max - inputs[i].train_min);
    double worst = 0.0;
    for (std::size_t r = 0; r < count; ++r) {
      const double acting = inputs[i].acting(u[r]);
      const double beyond = std::max(acting - inputs[i].train_max, inputs[i].train_min - acting);
      if (beyond <= margin) continue;
      if (!jointly) outside[r] = 1;
      worst = std::max(worst, beyond);
    }
    if (worst > 0.0 && notes != nullptr && reported.insert(inputs[i].name).second) {
      notes->push_back(fmt::format("{} leaves the range of training ({:.6g} ... {:.6g}) by up to {:.6g}.",
                                   inputs[i].name, inputs[i].train_min, inputs[i].train_max, worst));
    }
  }
  return outside;
}

void ThermalModel::learnPattern(const TimeSeries& series, std::size_t which, double from_s, double to_s) {
  SPINDRIFT_ASSERT(which < outputs.size(), "no such output");
  std::vector<std::string> names;
  for (const LagTerm& term : outputs[which].terms) names.push_back(inputs[static_cast<std::size_t>(term.input)].name);
  outputs[which].pattern.reset();
  TrainingPattern pattern = trainingPattern(series, names, from_s, to_s);
  if (!pattern.inputs.empty()) outputs[which].pattern = std::move(pattern);
}

ThermalPrediction ThermalModel::predict(const TimeSeries& series, std::size_t which) const {
  SPINDRIFT_ASSERT(which < outputs.size(), "no such output");
  const ThermalOutput& output = outputs[which];
  const std::size_t count = series.time_s.size();
  ThermalPrediction prediction;
  prediction.value.resize(count);
  std::vector<double> novelty;
  if (output.pattern) novelty = output.pattern->novelty(series);
  prediction.outside = outsideTraining(novelty, series, which, &prediction.notes);
  Eigen::VectorXd coefficients(static_cast<Eigen::Index>(output.terms.size() + 1));
  coefficients[0] = output.offset;
  for (std::size_t k = 0; k < output.terms.size(); ++k)
    coefficients[static_cast<Eigen::Index>(k + 1)] = output.terms[k].gain;
  FeatureRows rows(*this, which, series);
  const bool uncertain = output.covariance.rows() == rows.width();
  if (uncertain) prediction.sigma.resize(count);
  const auto all = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd x(std::min(rows_at_a_time, all), rows.width());
  for (Eigen::Index first = 0; first < all; first += rows_at_a_time) {
    const Eigen::Index now = std::min(rows_at_a_time, all - first);
    rows.next(first, x.topRows(now));
    const auto part = x.topRows(now);
    Eigen::Map<Eigen::VectorXd>(prediction.value.data() + first, now) =
        part.leftCols(coefficients.size()) * coefficients;
    if (!uncertain) continue;
    const Eigen::VectorXd variance = (part * output.covariance).cwiseProduct(part).rowwise().sum();
    for (Eigen::Index r = 0; r < now; ++r) {
      const auto row = static_cast<std::size_t>(first + r);
      const double noise = output.noise_sigma * (novelty.empty() ? 1.0 : std::max(1.0, novelty[row]));
      prediction.sigma[row] = output.uncertainty_factor * std::sqrt(std::max(0.0, variance[r]) + noise * noise);
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
    if (i.name != input || !isDriven(i.kind)) continue;
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

nlohmann::json rowsOf(const Eigen::MatrixXd& m) {
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index r = 0; r < m.rows(); ++r)
    for (Eigen::Index c = 0; c < m.cols(); ++c) rows.push_back(jsonNumber(m(r, c)));
  return rows;
}

nlohmann::json jsonOf(const TrainingPattern& p) {
  return {{"inputs", p.inputs},
          {"lag_s", p.lag_s},
          {"mean", std::vector<double>(p.mean.begin(), p.mean.end())},
          {"directions", rowsOf(p.directions)},
          {"seen", rowsOf(p.seen)},
          {"reach", p.reach}};
}

TrainingPattern patternFrom(const JsonNode& node) {
  TrainingPattern p;
  for (const JsonNode& name : node.at("inputs").items()) p.inputs.push_back(name.name());
  p.lag_s = node.at("lag_s").nonNegativeNumber();
  p.reach = node.at("reach").positiveNumber();
  const std::vector<double> mean = node.at("mean").numbers();
  const std::vector<double> directions = node.at("directions").numbers();
  const std::vector<double> seen = node.at("seen").numbers();
  const std::size_t width = 2 * p.inputs.size();
  if (p.inputs.empty()) node.at("inputs").reject("at least one column");
  if (mean.size() != width) node.at("mean").reject("two numbers for every input");
  if (directions.size() != width * width) node.at("directions").reject("a square matrix of two rows for every input");
  if (seen.empty() || seen.size() % width != 0) node.at("seen").reject("rows of two numbers for every input");
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(width);
  p.mean = Eigen::Map<const Eigen::VectorXd>(mean.data(), n);
  p.directions = Eigen::Map<const Rows>(directions.data(), n, n);
  p.seen = Eigen::Map<const Rows>(seen.data(), static_cast<Eigen::Index>(seen.size()) / n, n);
  return p;
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
    if (o.pattern) out["outputs"].back()["training_pattern"] = jsonOf(*o.pattern);
  }
  return out;
}

void ThermalModel::write(const std::filesystem::path& file) const {
  for (const ThermalOutput& o : outputs) {
    if (o.terms.empty())
      throw InputError(
          fmt::format("the model of {} is not written: it has no equivalent in first-order time constants (complex, "
                      "negative or double poles), and a constant in its place would be run; use the method response or "
                      "oe, or let the method be chosen.",
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
    const auto same = [&](const ThermalOutput& other) { return other.name == output.name; };
    if (std::any_of(model.outputs.begin(), model.outputs.end(), same)) node.at("name").reject("every output once");
    output.unit = node.at("unit").string();  // "": of a column without one
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
    if (const auto factor = node.find("uncertainty_factor")) output.uncertainty_factor = factor->positiveNumber();
    if (const auto verdict = node.find("verdict")) output.verdict = verdictFrom(*verdict);
    if (const auto pattern = node.find("training_pattern")) output.pattern = patternFrom(*pattern);
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
        if (!(output.covariance.diagonal().minCoeff() >= 0.0)) lower->reject("a diagonal of variances, none negative");
      }
    }
    model.outputs.push_back(std::move(output));
  }
  if (model.outputs.empty()) root.at("outputs").reject("at least one output");
  return model;
}

}  // namespace spindrift
