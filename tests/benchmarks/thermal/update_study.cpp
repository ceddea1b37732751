// SPDX-License-Identifier: GPL-3.0-or-later
// P2 on the virtual machine: a tall machine whose spindle heats its column, so that the displacement of the nose (EY,
// the way the column leans) per kelvin of the front bearing depends on the height of the spindle. A model
// (two poles if the data tell them apart) is found at the lowest height; the verification runs (other heights, another
// speed, moving) are linked as in P2 Fig. 6. Fit and p2p without and with updates at 30 ... 180 min (P2 Fig. 9), by the
// gain of the paper, by the bounded gain, by the Kalman filter on gain and offset, and by the same that knows the
// height from the log; then fit and p2p against the height. `update_study FILE.svg` writes the diagram.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/machine/machine_description.h"
#include "core/math/statistics.h"
#include "core/reporting/plot_picture.h"
#include "core/simulation/virtual_machine.h"
#include "core/thermal/measurement_update.h"
#include "core/thermal/output_error.h"

namespace {

using namespace spindrift;

constexpr double period_s = 60.0;
constexpr double idle_s = 600.0;
constexpr double highest_mm = 1200.0;

MachineDescription tallMachine() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"tall machining centre",
    "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,1250]},{"name":"Y","travel_mm":[0,1000]},
    {"name":"Z","travel_mm":[0,1200]}],"spindle":{"axis":"Z","max_rpm":6000},"column":{"base_mm":-400},
    "table":{"centre_mm":[625,500]},"points":[]})",
                      "tall.json"),
      "tall.json");
}

/// One heating phase: temperature of the front bearing (K above the start) and displacement (um).
struct Phase {
  std::vector<double> temperature_K;
  std::vector<double> displacement_um;
  std::vector<double> height_mm;
};

Phase heatingPhase(double rpm, double from_mm, double to_mm, double hours, std::uint64_t seed) {
  const MachineDescription machine = tallMachine();
  ProgrammeSegment idle;
  idle.position_mm = {600.0, 500.0, from_mm};
  ProgrammeSegment busy = idle;
  busy.from_s = idle_s;
  busy.spindle_rpm = rpm;
  EnvironmentOptions room;
  room.weather_K = 0.3;
  room.day_amplitude_K = 0.5;
  const double duration = hours * 3600.0;
  const VirtualMachine plant(machine, Programme({idle, busy}), Environment(room, duration, seed), PlantParameters{},
                             duration, seed);
  const PlantEffectSettings causes = {{"spindle.drift.y", {true, 8.0, "", {}}},
                                      {"column.bending.a", {true, 1.2, "", {}}}};
  const std::vector<int> bearing = volumesAt(plant.thermal().bodies, "front bearing", {});
  Random random(seed);
  Phase out;
  std::vector<PlantQuery> queries;
  for (double t = 0.0; t <= duration; t += period_s) {
    // Moving: up and down in steps, a full way in three hours.
    const double way = std::abs(std::remainder(t / 10800.0, 2.0));
    const double height = from_mm + (to_mm - from_mm) * std::round(6.0 * way) / 6.0;
    out.height_mm.push_back(height);
    queries.push_back({.time_s = t, .position_mm = {600.0, 500.0, height}});
    out.temperature_K.push_back(plant.temperature_degC(bearing, t) - plant.temperature_degC(bearing, 0.0) +
                                random.normal(0.0, 0.05));
  }
  for (const SmallError& e : plant.deviations(causes, queries))
    out.displacement_um.push_back(um_per_mm * e.translation_mm.y() + random.normal(0.0, 0.3));
  return out;
}

OutputErrorResult identify(const Phase& p) {
  std::vector<double> time;
  for (std::size_t k = 0; k < p.temperature_K.size(); ++k) time.push_back(period_s * static_cast<double>(k));
  OutputErrorResult two = fitOutputError(time, p.displacement_um, {{p.temperature_K, 2, false}});
  if (two.status == FitStatus::Converged) return two;
  return fitOutputError(time, p.displacement_um,
                        {{p.temperature_K, 1, false}});  // the data do not tell two poles apart
}

std::vector<double> simulate(const OutputErrorResult& model, const Phase& p) {
  std::vector<double> time;
  for (std::size_t k = 0; k < p.temperature_K.size(); ++k) time.push_back(period_s * static_cast<double>(k));
  std::vector<double> y(time.size(), model.offset);
  for (std::size_t lag = 0; lag < model.gains[0].size(); ++lag) {
    const auto x = lagFiltered(time, p.temperature_K, model.taus_s[0][lag], false);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += model.gains[0][lag] * x[k];
  }
  return y;
}

/// Phases one after another, as in P2 Figs. 5 and 6.
struct Linked {
  std::vector<double> time;
  std::vector<double> measured;
  std::vector<double> simulated;
  std::vector<double> height;  ///< -1 ... 1, as the log knows it
  void add(const OutputErrorResult& model, const Phase& p) {
    const std::vector<double> s = simulate(model, p);
    for (std::size_t k = 0; k < s.size(); ++k) {
      time.push_back(period_s * static_cast<double>(time.size()));
      measured.push_back(p.displacement_um[k]);
      simulated.push_back(s[k]);
      height.push_back(2.0 * p.height_mm[k] / highest_mm - 1.0);
    }
  }
};

struct Method {
  const char* name;
  UpdateOptions options;
};

std::vector<Method> methods(const Linked& run, double model_rms) {
  UpdateOptions gain;
  gain.kind = UpdateKind::Gain;
  UpdateOptions bounded = gain;
  bounded.gain_bound = 3.0;
  bounded.smallest_simulated = 5.0;
  UpdateOptions kalman;
  kalman.kind = UpdateKind::Kalman;
  kalman.measurement_sigma = 0.3;
  kalman.offset_sigma = std::max(2.0, 2.0 * model_rms);
  UpdateOptions height = kalman;
  height.context = {run.height};
  return {{"gain (paper)", gain},
          {"gain, bounded", bounded},
          {"Kalman, gain and offset", kalman},
          {"Kalman, gain by height", height}};
}

const std::vector<double> intervals_s = {1800.0, 3600.0, 5400.0, 7200.0, 9000.0, 10800.0};

void addFigure9(const Linked& run, double model_rms, std::vector<StackedPlot>& plots) {
  StackedPlot fit{{},
                  {.title = "Verification: fit against the interval of the on-machine measurements",
                   .x_label = "interval / min",
                   .y_label = "fit / %",
                   .width_px = 860,
                   .height_px = 260}};
  StackedPlot p2p = fit;
  p2p.options.title = "Verification: p2p against the interval of the on-machine measurements";
  p2p.options.y_label = "p2p / um";
  fit.options.y_from = 0.0;
  fit.options.y_to = 100.0;
  p2p.options.y_from = 0.0;
  for (const Method& m : methods(run, model_rms)) {
    const auto sweep = sweepIntervals(run.time, run.measured, run.simulated, m.options, intervals_s);
    if (fit.series.empty()) {
      std::printf("  %-24s fit %6.1f %%, p2p %6.1f um, rms %5.2f um\n", "without update", sweep[0].fit_percent,
                  sweep[0].p2p, sweep[0].rms);
      fit.series.push_back({"without update", {30.0, 180.0}, {sweep[0].fit_percent, sweep[0].fit_percent}, {}, {}});
      p2p.series.push_back({"without update", {30.0, 180.0}, {sweep[0].p2p, sweep[0].p2p}, {}, {}});
      fit.series[0].style = p2p.series[0].style = SeriesStyle::Line;
    }
    PlotSeries a{m.name, {}, {}, {}, SeriesStyle::Line};
    PlotSeries b = a;
    std::printf("  %-24s", m.name);
    for (std::size_t k = 1; k < sweep.size(); ++k) {
      std::printf("  %3.0f min: %5.1f %% %5.1f um", sweep[k].interval_s / 60.0, sweep[k].fit_percent, sweep[k].p2p);
      a.x.push_back(sweep[k].interval_s / 60.0);
      a.y.push_back(sweep[k].fit_percent);
      b.x.push_back(sweep[k].interval_s / 60.0);
      b.y.push_back(sweep[k].p2p);
    }
    std::printf("\n");
    fit.series.push_back(std::move(a));
    p2p.series.push_back(std::move(b));
  }
  plots.push_back(std::move(fit));
  plots.push_back(std::move(p2p));
}

void addHeights(const OutputErrorResult& model, double model_rms, std::vector<StackedPlot>& plots) {
  StackedPlot fit{{},
                  {.title = "Fit against the height of the spindle (4000 rpm, updates every 60 min)",
                   .x_label = "height of the spindle / mm",
                   .y_label = "fit / %",
                   .width_px = 860,
                   .height_px = 260}};
  StackedPlot p2p = fit;
  p2p.options.title = "p2p against the height of the spindle (4000 rpm, updates every 60 min)";
  p2p.options.y_label = "p2p / um";
  p2p.options.y_from = 0.0;
  const std::vector<Method> names = methods({}, model_rms);
  fit.series.push_back({"without update", {}, {}, {}, SeriesStyle::Line});
  for (const Method& m : names) fit.series.push_back({m.name, {}, {}, {}, SeriesStyle::Line});
  p2p.series = fit.series;
  for (double height = 0.0; height <= highest_mm; height += 200.0) {
    Linked run;
    run.add(model, heatingPhase(4000.0, height, height, 8.0, 100 + static_cast<std::uint64_t>(height)));
    const std::vector<Method> all = methods(run, model_rms);
    std::printf("  %6.0f mm", height);
    for (std::size_t m = 0; m < all.size(); ++m) {
      const auto sweep = sweepIntervals(run.time, run.measured, run.simulated, all[m].options, {3600.0});
      for (std::size_t k = m == 0 ? 0 : 1; k < 2; ++k) {
        const std::size_t s = k == 0 ? 0 : m + 1;
        std::printf("  %s %6.1f %% %5.1f um%s", fit.series[s].name.c_str(), sweep[k].fit_percent, sweep[k].p2p,
                    s == all.size() ? "\n" : ";");
        fit.series[s].x.push_back(height);
        fit.series[s].y.push_back(sweep[k].fit_percent);
        p2p.series[s].x.push_back(height);
        p2p.series[s].y.push_back(sweep[k].p2p);
      }
    }
  }
  plots.push_back(std::move(fit));
  plots.push_back(std::move(p2p));
}

}  // namespace

int main(int argc, char** argv) {
  // P2 Table 1: number, speed and height.
  const Phase calibration = heatingPhase(4000.0, 0.0, 0.0, 8.0, 1);
  const OutputErrorResult model = identify(calibration);
  if (model.status != FitStatus::Converged) {
    std::printf("identification failed: %s\n", model.message.c_str());
    return 1;
  }
  Linked trained;
  trained.add(model, calibration);
  std::vector<double> left;
  for (std::size_t k = 0; k < trained.time.size(); ++k) left.push_back(trained.measured[k] - trained.simulated[k]);
  const auto [gain, sigma] = model.staticGain(0);
  std::printf("calibration at height 0: fit %.1f %%, p2p %.1f um, gain %.2f +- %.2f um/K (paper: 89 %%, 16.6 um)\n",
              fitPercent(trained.measured, trained.simulated), peakToPeak(left), gain, sigma);
  Linked run;
  run.add(model, heatingPhase(2000.0, 600.0, 600.0, 7.9, 2));
  run.add(model, heatingPhase(4000.0, 1200.0, 1200.0, 7.9, 3));
  run.add(model, heatingPhase(4000.0, 600.0, 600.0, 7.9, 4));
  run.add(model, heatingPhase(4000.0, 0.0, 1200.0, 12.0, 5));
  std::printf(
      "verification, four runs linked (paper: 41.5 %%, 64 um without; 92 ... 56 %%, 43 ... 70 um with gain):\n");
  std::vector<StackedPlot> plots;
  const double model_rms = rootMeanSquare(left);
  addFigure9(run, model_rms, plots);
  std::printf("against the height, updates every 60 min:\n");
  addHeights(model, model_rms, plots);
  StackedPlot series{
      {{"measured", {}, run.measured, {}, SeriesStyle::Line}, {"simulated", {}, run.simulated, {}, SeriesStyle::Line}},
      {.title = "Verification runs, linked",
       .x_label = "time / h",
       .y_label = "displacement / um",
       .width_px = 860,
       .height_px = 260}};
  for (const double t : run.time) series.series[0].x.push_back(t / 3600.0);
  series.series[1].x = series.series[0].x;
  plots.insert(plots.begin(), std::move(series));
  if (argc > 1) writeFileAtomically(argv[1], svgOf(plotStack(plots)));
  return 0;
}
