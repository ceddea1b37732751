// SPDX-License-Identifier: GPL-3.0-or-later
// ARX beside GNU Octave's arx (package control) in one run, on the same data; and the time of one step of the
// compensator, also of the largest one. What it does with bad inputs is the matter of
// tests/core/thermal/compensator_soak.cpp. Octave runs as a child process if it is installed; it times itself inside,
// so its start does not count.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/arx.h"
#include "core/thermal/compensator.h"
#include "core/thermal/thermal_model.h"

namespace {

using Clock = std::chrono::steady_clock;

struct Case {
  int inputs;
  int order;
};

double milliseconds(Clock::time_point from) {
  return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
}

void compareArx(const Case& c, const std::filesystem::path& folder) {
  spindrift::Random random(42);
  const std::size_t n = 36000;
  std::vector<std::vector<double>> u(static_cast<std::size_t>(c.inputs), std::vector<double>(n));
  for (auto& signal : u) {
    double level = 0.0;
    for (double& v : signal) {
      if (random.uniform() < 0.01) level = random.normal();
      v = level + 0.05 * random.normal();
    }
  }
  std::vector<double> y(n, 0.0);
  for (std::size_t k = 2; k < n; ++k) {
    y[k] = 1.7 * y[k - 1] - 0.72 * y[k - 2] + 0.05 * random.normal();
    for (int i = 0; i < c.inputs; ++i)
      y[k] += (0.1 + 0.02 * i) * u[static_cast<std::size_t>(i)][k - 1] - 0.05 * u[static_cast<std::size_t>(i)][k - 2];
  }
  spindrift::ArxOrder order{c.order, std::vector<int>(static_cast<std::size_t>(c.inputs), c.order),
                            std::vector<int>(static_cast<std::size_t>(c.inputs), 1)};
  std::vector<std::span<const double>> spans(u.begin(), u.end());
  spindrift::ArxModel model;
  double own = 1e300;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const auto start = Clock::now();
    model = spindrift::fitArx(y, spans, order, 1.0);
    own = std::min(own, milliseconds(start));
  }
  std::printf("ARX %d input(s) %d/%d, %zu samples: %.3f ms\n", c.inputs, c.order, c.order, n, own);
  if (std::system("command -v octave-cli > /dev/null 2>&1") != 0) {
    std::printf("  octave is not installed, no comparison\n");
    return;
  }
  {
    std::ofstream data(folder / "data.bin", std::ios::binary);
    data.write(reinterpret_cast<const char*>(y.data()), static_cast<std::streamsize>(n * sizeof(double)));
    for (const auto& signal : u)
      data.write(reinterpret_cast<const char*>(signal.data()), static_cast<std::streamsize>(n * sizeof(double)));
    std::ofstream script(folder / "run.m");
    script << "pkg load control\nf = fopen('" << (folder / "data.bin").string() << "'); d = fread(f, [" << n << ", "
           << c.inputs + 1 << "], 'double'); fclose(f);\ns = iddata(d(:,1), d(:,2:end), 1); best = inf;\n"
           << "for r = 1:7; t = tic; m = arx(s, 'na', " << c.order << ", 'nb', " << c.order
           << "); best = min(best, toc(t)); end\n"
           << "[num, den] = tfdata(m, 'vector');\nif !iscell(num) num = {num}; den = {den}; end\n"
           << "f = fopen('" << (folder / "result.txt").string() << "', 'w'); fprintf(f, '%.17g\\n', best * 1e3);\n"
           << "fprintf(f, '%.17g\\n', den{1}(2:end)); for i = 1:" << c.inputs
           << "; v = num{i}; fprintf(f, '%.17g\\n', v(end-" << c.order - 1 << ":end)); end; fclose(f);\n";
  }
  const std::string command = "octave-cli --no-gui -q \"" + (folder / "run.m").string() + "\" 2> /dev/null";
  if (std::system(command.c_str()) != 0) std::printf("  octave ended with an error\n");
  std::ifstream result(folder / "result.txt");
  double octave = 0.0;
  if (!(result >> octave)) {
    std::printf("  octave gave no result\n");
    return;
  }
  double worst = 0.0;
  double value = 0.0;
  for (int j = 0; j < c.order && result >> value; ++j) worst = std::max(worst, std::abs(value - model.a[j]));
  for (int i = 0; i < c.inputs; ++i)
    for (int j = 0; j < c.order && result >> value; ++j)
      worst = std::max(worst, std::abs(value - model.b[static_cast<std::size_t>(i)][j]));
  std::printf("  octave arx: %.3f ms; ratio %.1f; largest difference of a coefficient %.2g\n", octave, octave / own,
              worst);
}

spindrift::ThermalModel largeModel() {
  spindrift::ThermalModel model;
  for (int i = 0; i < 8; ++i) {
    model.inputs.push_back(
        {"T_" + std::to_string(i) + "_degC", spindrift::SignalKind::Temperature, 1.0, 1.0, 22.0, 15.0, 45.0});
  }
  for (int o = 0; o < 6; ++o) {
    spindrift::ThermalOutput output;
    output.name = "output" + std::to_string(o);
    output.unit = "um";
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k)
        output.terms.push_back({i, 200.0 * std::pow(4.0, k) * (1.0 + 0.01 * o), 0.3 - 0.02 * i});
    model.outputs.push_back(output);
  }
  return model;
}

void timeCompensator() {
  const spindrift::ThermalModel model = largeModel();
  spindrift::Compensator compensator;
  const std::string problem = compensator.load(model, 0.01);
  if (!problem.empty()) {
    std::printf("%s\n", problem.c_str());
    std::exit(1);
  }
  double inputs[8];
  double outputs[6];
  for (int i = 0; i < 8; ++i) inputs[i] = 22.0 + i;
  double best = 1e300;
  double sum = 0.0;
  for (int repeat = 0; repeat < 3000; ++repeat) {
    const auto start = Clock::now();
    for (int k = 0; k < 500; ++k) {
      inputs[k & 7] += (k & 8) != 0 ? 1e-4 : -1e-4;
      compensator.step(inputs, nullptr, outputs);
      sum += outputs[0];
    }
    best = std::min(best, milliseconds(start) * 2000.0);
  }
  std::printf("compensator, 6 outputs, 8 inputs of order 3 (144 lags): %.0f ns per step (checksum %.3g)\n", best, sum);
}

/// All that a compensator takes: 8 outputs, 32 signals with three powers each, 1024 lags.
spindrift::ThermalModel largestModel() {
  spindrift::ThermalModel model;
  for (int i = 0; i < spindrift::Compensator::maximum_inputs; ++i)
    for (const double power : {1.0, 1.5, 1.3})
      model.inputs.push_back(
          {"speed_" + std::to_string(i), spindrift::SignalKind::Speed, power, 4000.0, 0.0, 0.0, 4000.0});
  const auto inputs = static_cast<int>(model.inputs.size());
  constexpr int lags = spindrift::Compensator::maximum_lags / spindrift::Compensator::maximum_outputs;
  for (int o = 0; o < spindrift::Compensator::maximum_outputs; ++o) {
    spindrift::ThermalOutput output;
    output.name = "output" + std::to_string(o);
    output.unit = "um";
    // Each output in an order of its own, so that none takes over the sorted inputs of the one before.
    for (int k = 0; k < lags; ++k)
      output.terms.push_back({(k * (o % 2 == 0 ? 1 : 5) + o) % inputs, 100.0 * (1.0 + k), 0.05});
    model.outputs.push_back(output);
  }
  return model;
}

/// The time of single steps of the largest model, inputs that stand still for long, fail and come back. Steps that
/// another process interrupted are in the last figures.
void timeLargest(long steps) {
  spindrift::Compensator compensator;
  const std::string problem = compensator.load(largestModel(), 0.01);
  if (!problem.empty()) {
    std::printf("%s\n", problem.c_str());
    std::exit(1);
  }
  spindrift::Random random(19);
  std::vector<double> inputs(spindrift::Compensator::maximum_inputs, 0.0);
  const std::vector<double> ages(inputs.size(), 0.0);
  double outputs[spindrift::Compensator::maximum_outputs];
  std::vector<long> within_10ns(100'000, 0);  // steps by their duration
  long long slowest = 0;
  for (long k = 0; k < steps; ++k) {
    if (k % 1000 == 0) {
      for (double& input : inputs) input = random.index(3) == 0 ? 0.0 : random.uniform(0.0, 4000.0);
      if (random.index(5) == 0) inputs[random.index(inputs.size())] = std::nan("");
    }
    const auto start = Clock::now();
    (void)compensator.step(inputs.data(), ages.data(), outputs);
    const long long ns = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
    ++within_10ns[static_cast<std::size_t>(std::min<long long>(ns / 10, std::ssize(within_10ns) - 1))];
    slowest = std::max(slowest, ns);
  }
  const auto quantile = [&](double part) {
    long count = 0;
    std::size_t at = 0;
    while (at + 1 < within_10ns.size() &&
           static_cast<double>(count += within_10ns[at]) < part * static_cast<double>(steps))
      ++at;
    return 10 * (at + 1);
  };
  std::printf(
      "compensator, 8 outputs, 32 signals, 1024 lags (the largest model), %ld steps: a step, with the clock, takes up "
      "to "
      "%zu ns (median), %zu ns (99.9 %%), %zu ns (99.9999 %%), %lld ns (slowest, with interruptions)\n",
      steps, quantile(0.5), quantile(0.999), quantile(0.999999), slowest);
}

}  // namespace

/// thermal_speed [STEPS with the largest model, 1e7]
int main(int count, char** arguments) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "spindrift-thermal-speed";
  std::filesystem::create_directories(folder);
  compareArx({1, 2}, folder);
  compareArx({11, 4}, folder);
  timeCompensator();
  timeLargest(count > 1 ? std::stol(arguments[1]) : 10'000'000L);
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return 0;
}
