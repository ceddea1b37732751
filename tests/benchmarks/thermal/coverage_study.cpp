// SPDX-License-Identifier: GPL-3.0-or-later
// How often the truth lies inside the stated 95 % intervals of identified models: coefficients, static gain, time
// constants and step response of known ARX and output-error systems under white and coloured noise; and the bias of ARX
// under noise at the output, of which output error is free; and how often those of `response` hold what is measured,
// what is true and the true step response. `coverage_study [RUNS]`, default 1000. `coverage_study RUNS --seed FIRST`
// gives what RUNS runs from this one on say, as JSON: an item of a batch
// ("work":"command","run":["coverage_study","1","--seed","{seed}"]). `coverage_study --gather FILE` reads what `batch
// status BATCH --results FILE` wrote and prints the table: that of one study with the same runs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/math/statistics.h"
#include "core/thermal/arx.h"
#include "core/thermal/output_error.h"
#include "tests/support/response_run.h"
#include "tests/support/step_response_sigma.h"

namespace {

using namespace spindrift;

/// First run; where counts go in place of the table, and the answers they come from in place of runs.
std::uint64_t first_run = 0;
nlohmann::json* counted = nullptr;
std::vector<nlohmann::json> answers;

struct Count {
  std::string name;
  std::size_t inside = 0;
  std::size_t total = 0;
  void add(double estimate, double truth, double sigma, double factor = 1.96) {
    inside += std::abs(estimate - truth) <= factor * sigma ? 1U : 0U;
    ++total;
  }
};

using Sums = std::vector<std::pair<const char*, double*>>;

/// Prints the counts of all runs, of this process or of the answers, and completes the sums; false if both were handed
/// on as JSON.
bool print(const char* system, std::vector<Count> counts, const Sums& sums) {
  if (counted != nullptr) {
    for (const Count& c : counts) (*counted)[system][c.name] = {{"inside", c.inside}, {"total", c.total}};
    for (const auto& [name, sum] : sums) (*counted)[system]["sums"][name] = *sum;
    return false;
  }
  for (const nlohmann::json& answer : answers) {
    const nlohmann::json& said = answer.at(system);
    for (Count& c : counts) {
      c.inside += said.at(c.name).at("inside").get<std::size_t>();
      c.total += said.at(c.name).at("total").get<std::size_t>();
    }
    for (const auto& [name, sum] : sums) *sum += said.at("sums").at(name).get<double>();
  }
  std::printf("%s\n", system);
  for (const Count& c : counts) {
    if (c.total == 0) {
      std::printf("  %-26s none: no real poles were found\n", c.name.c_str());
      continue;
    }
    const RateInterval rate = wilsonInterval(c.inside, c.total, 1.96);
    std::printf("  %-26s %5.1f %% inside (95 %% stated; rate known to %.1f ... %.1f)\n", c.name.c_str(),
                100.0 * static_cast<double>(c.inside) / static_cast<double>(c.total), 100.0 * rate.low,
                100.0 * rate.high);
  }
  return true;
}

std::vector<double> steps(Random& random, int samples, int hold) {
  std::vector<double> u;
  double level = 0.0;
  for (int k = 0; k < samples; ++k) {
    if (k % hold == 0) level = random.uniform(0.0, 2.0);
    u.push_back(level);
  }
  return u;
}

/// y = (0.3 q^-1 - 0.1 q^-2) / (1 - 1.4 q^-1 + 0.45 q^-2) u with noise in the equation (white or AR(1)) or at the
/// output.
struct ArxSystem {
  double rho = 0.0;
  bool at_output = false;
  double sigma = 0.05;
};

ArxModel arxTruth() {
  ArxModel m;
  m.period_s = 10.0;
  m.order = {2, {2}, {1}};
  m.a = Eigen::Vector2d(-1.4, 0.45);
  m.b = {Eigen::Vector2d(0.3, -0.1)};
  return m;
}

void arx(const char* name, const ArxSystem& system, int runs) {
  const ArxModel truth = arxTruth();
  const std::array<std::size_t, 5> at = {1, 5, 12, 30, 80};
  const std::vector<double> step = truth.stepResponse(0, 100);
  std::vector<Count> counts(4);
  counts[0].name = "coefficients";
  counts[1].name = "static gain";
  counts[2].name = "time constants";
  counts[3].name = "step response";
  double gain_sum = 0.0;
  for (int run = 0; run < runs; ++run) {
    Random random(7000 + first_run + static_cast<std::uint64_t>(run));
    const auto u = steps(random, 800, 20);
    std::vector<double> y(u.size(), 0.0);
    double e = 0.0;
    for (std::size_t k = 2; k < u.size(); ++k) {
      e = system.rho * e + random.normal(0.0, system.sigma * std::sqrt(1.0 - system.rho * system.rho));
      y[k] = 1.4 * y[k - 1] - 0.45 * y[k - 2] + 0.3 * u[k - 1] - 0.1 * u[k - 2] + (system.at_output ? 0.0 : e);
    }
    if (system.at_output)
      for (double& v : y) v += random.normal(0.0, system.sigma);
    const ArxModel m = fitArx(y, {u}, truth.order, truth.period_s);
    for (int i = 0; i < 2; ++i) {
      counts[0].add(m.a[i], truth.a[i], std::sqrt(m.covariance(i, i)));
      counts[0].add(m.b[0][i], truth.b[0][i], std::sqrt(m.covariance(2 + i, 2 + i)));
    }
    const auto [gain, sigma] = m.staticGain(0);
    gain_sum += gain;
    counts[1].add(gain, 4.0, sigma);
    const auto taus = m.timeConstants();
    if (taus.size() == 2) {
      counts[2].add(taus[0].value_s, -10.0 / std::log(0.9), taus[0].sigma_s);
      counts[2].add(taus[1].value_s, -10.0 / std::log(0.5), taus[1].sigma_s);
    }
    const std::vector<double> estimated = m.stepResponse(0, 100);
    const std::vector<double> sigmas = stepResponseSigma(m, 0, 100);
    for (const std::size_t k : at) counts[3].add(estimated[k], step[k], sigmas[k]);
  }
  double all = runs;
  if (!print(name, counts, {{"gain", &gain_sum}, {"runs", &all}})) return;
  std::printf("  mean static gain %.4f, truth 4\n", gain_sum / all);
}

struct OutputErrorSystem {
  double a1 = 0.0;  ///< autoregression of the noise at the output
  double a2 = 0.0;
  bool second_input = false;
  int samples = 1200;  ///< at 30 s
};

/// Gains -20 and 5 at 3600 s and 600 s (and a second input, 3 at 1500 s). The fit is told nothing of the noise.
void outputError(const char* name, const OutputErrorSystem& system, int runs) {
  const auto [a1, a2, second_input, samples] = system;
  const std::array<double, 4> at_s = {300.0, 1200.0, 3600.0, 14400.0};
  std::vector<Count> counts(4);
  counts[0].name = "gains";
  counts[1].name = "static gain";
  counts[2].name = "time constants";
  counts[3].name = "step response";
  double gain_sum = 0.0;
  double factor_sum = 0.0;
  double converged = 0.0;
  for (int run = 0; run < runs; ++run) {
    Random random(9000 + first_run + static_cast<std::uint64_t>(run));
    const auto u = steps(random, samples, 150);
    const auto w = steps(random, samples, 90);
    std::vector<double> time;
    for (int k = 0; k < samples; ++k) time.push_back(30.0 * k);
    const auto slow = lagFiltered(time, u, 3600.0, true);
    const auto fast = lagFiltered(time, u, 600.0, true);
    const auto other = lagFiltered(time, w, 1500.0, true);
    std::vector<double> y;
    double v1 = 0.0;
    double v2 = 0.0;
    // Driving noise for a stationary standard deviation of 0.2.
    const double part = std::sqrt((1.0 + a2) * ((1.0 - a2) * (1.0 - a2) - a1 * a1) / (1.0 - a2));
    for (int k = -200; k < samples; ++k) {
      const double v = a1 * v1 + a2 * v2 + random.normal(0.0, 0.2 * part);
      v2 = v1;
      v1 = v;
      if (k < 0) continue;
      const auto i = static_cast<std::size_t>(k);
      y.push_back(4.0 - 20.0 * slow[i] + 5.0 * fast[i] + (second_input ? 3.0 * other[i] : 0.0) + v);
    }
    OutputErrorOptions options;
    options.starts = 2;
    std::vector<OutputErrorInput> inputs = {{u, 2, true}};
    if (second_input) inputs.push_back({w, 1, true});
    const OutputErrorResult r = fitOutputError(time, y, inputs, options);
    if (r.status != FitStatus::Converged) continue;
    converged += 1.0;
    const double factor = r.coverageFactor();
    factor_sum += factor;
    const auto tau = [&](std::size_t input, std::size_t lag, double truth) {
      const double value = r.taus_s[input][lag];
      counts[2].add(std::log(value), std::log(truth), r.tauSigma_s(input, lag) / value, factor);
    };
    counts[0].add(r.gains[0][0], -20.0, r.gainSigma(0, 0), factor);
    counts[0].add(r.gains[0][1], 5.0, r.gainSigma(0, 1), factor);
    tau(0, 0, 3600.0);
    tau(0, 1, 600.0);
    const auto [gain, sigma] = r.staticGain(0);
    gain_sum += gain;
    counts[1].add(gain, -15.0, sigma, factor);
    if (second_input) {
      counts[0].add(r.gains[1][0], 3.0, r.gainSigma(1, 0), factor);
      tau(1, 0, 1500.0);
    }
    ThermalModel model;
    model.inputs = {{"u", SignalKind::Speed, 1.0, 1.0, 0.0, 0.0, 1.0}, {"w", SignalKind::Speed}};
    ThermalOutput output;
    for (std::size_t i = 0; i < r.gains.size(); ++i)
      for (std::size_t k = 0; k < r.gains[i].size(); ++k)
        output.terms.push_back({static_cast<int>(i), r.taus_s[i][k], r.gains[i][k]});
    output.covariance = r.covariance;
    model.outputs = {output};
    const StepResponse step = model.stepResponse(0, "u", 120);
    for (const double t : at_s) {
      std::size_t k = 0;
      while (k + 1 < step.time_s.size() && step.time_s[k] < t) ++k;
      const double s = step.time_s[k];
      const double truth = -20.0 * -std::expm1(-s / 3600.0) + 5.0 * -std::expm1(-s / 600.0);
      counts[3].add(step.value[k], truth, step.sigma[k], factor);
    }
  }
  double all = runs;
  if (!print(name, counts, {{"gain", &gain_sum}, {"factor", &factor_sum}, {"converged", &converged}, {"runs", &all}}))
    return;
  std::printf("  mean static gain %.4f, truth -15; %.0f of %.0f converged; mean coverage factor %.3f\n",
              gain_sum / converged, converged, all, factor_sum / converged);
}

/// Records of tests/support/response_run.h: `response` trained on the first 60 %, asked about the rest and about a
/// step.
void response(const char* name, const testing::ResponseRun& kind, int runs) {
  std::vector<Count> counts(3);
  counts[0].name = "measured values";
  counts[1].name = "true values";
  counts[2].name = "step response";
  double factor_sum = 0.0;
  for (int run = 0; run < runs; ++run) {
    const testing::ResponseRecord record =
        testing::responseRun(11000 + first_run + static_cast<std::uint64_t>(run), kind);
    const testing::ResponseCoverage coverage = testing::responseCoverage(record);
    factor_sum += coverage.calibration;
    const auto take = [](Count& count, const std::vector<char>& inside) {
      count.total += inside.size();
      count.inside += static_cast<std::size_t>(std::count(inside.begin(), inside.end(), char{1}));
    };
    take(counts[0], coverage.measured);
    take(counts[1], coverage.truth);
    take(counts[2], coverage.step);
  }
  double all = runs;
  if (!print(name, counts, {{"calibration", &factor_sum}, {"runs", &all}})) return;
  std::printf("  mean calibration of the covariance %.3f\n", factor_sum / all);
}

/// Answers of a batch, in the order of its items.
std::vector<nlohmann::json> read(const char* file) {
  std::vector<nlohmann::json> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const nlohmann::json j = nlohmann::json::parse(line);
    if (j.at("failed").get<bool>()) throw std::runtime_error(j.at("answer").at("error").get<std::string>());
    found.push_back(j.at("answer"));
  }
  if (found.empty()) throw std::runtime_error(std::string(file) + " holds no answers");
  return found;
}

int study(int argc, char** argv) {
  int runs = 1000;
  nlohmann::json answer;
  if (argc > 2 && std::strcmp(argv[1], "--gather") == 0) {
    answers = read(argv[2]);
    runs = 0;
  } else if (argc > 1) {
    runs = std::stoi(argv[1]);
  }
  if (argc > 3 && std::strcmp(argv[2], "--seed") == 0) {
    first_run = std::stoull(argv[3]);
    counted = &answer;
  }
  arx("ARX, white noise in the equation", {0.0, false, 0.05}, runs);
  arx("ARX, coloured noise in the equation (AR(1), 0.6)", {0.6, false, 0.05}, runs);
  arx("ARX, white noise at the output (biased: not its model)", {0.0, true, 0.2}, runs);
  outputError("output error, white noise at the output", {}, runs);
  outputError("output error, AR(1) noise 0.9", {0.9}, runs);
  outputError("output error, AR(1) noise 0.9, 900 samples", {0.9, 0.0, false, 900}, runs);
  outputError("output error, AR(1) noise 0.9, 4000 samples", {0.9, 0.0, false, 4000}, runs);
  outputError("output error, AR(2) noise 1.5, -0.6", {1.5, -0.6}, runs);
  outputError("output error, two inputs, AR(1) noise 0.8", {0.8, 0.0, true}, runs);
  response("response, speed alone, white noise", {false, 0.3, 0.0}, runs);
  response("response, speed and three sensors, white noise", {true, 0.3, 0.0}, runs);
  response("response, speed and three sensors, drifting zero", {true, 0.2, 0.6}, runs);
  if (counted != nullptr) std::printf("%s\n", answer.dump().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return study(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "coverage_study: %s\n", e.what());
    return 3;
  }
}
