// SPDX-License-Identifier: GPL-3.0-or-later
// The model that `thermal identify` chooses beside a straight line, the lagged ridge regression, ARX and output error:
// error of the free run over the last 40 % of a record, trained on the rest, and how often the 95 % interval holds it.
// `choice_study [SEEDS [frame|spindle [FIRST]]]`: made records of a heated frame (tests/support/frame_run.h) or of a
// machine under changing speeds (tests/support/spindle_run.h), default 40 of the frame from seed 0.
// `choice_study LOG.csv OUTPUT [PART]`: one record, trained on this part of it (default 0.6).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/workflows/thermal_workflow.h"
#include "tests/support/frame_run.h"
#include "tests/support/spindle_run.h"

namespace {

using namespace spindrift;

struct Figures {
  std::map<std::string, double> rms;
  double inside = 0.0;  ///< part of the test rows within the 95 % interval
  double width = 0.0;   ///< rms of the stated standard uncertainty over the rms of the errors
  std::size_t inputs = 0;
  std::string winner;  ///< of the four
  double best = std::numeric_limits<double>::infinity();
};

Figures study(const TimeSeries& series, const std::string& output, double part) {
  Figures out;
  IdentifyRequest request;
  request.output = output;
  const double cut = part * series.time_s.back();
  request.train = {0.0, cut};
  request.test = {cut, 1e300};
  request.peers = true;
  const IdentifyResult chosen = identifyThermalModel(series, request, {});
  out.rms["chosen"] = chosen.test.rmse;
  for (const ModelComparison& plain : chosen.plain) {
    if (plain.name.starts_with("static")) out.rms["line"] = plain.test.rmse;
    if (plain.name.starts_with("ridge")) out.rms["ridge"] = plain.test.rmse;
  }
  double count = 0.0;
  for (std::size_t r = 0; r < chosen.time_s.size(); ++r) {
    if (chosen.time_s[r] < cut || !std::isfinite(chosen.measured[r]) || r >= chosen.sigma.size()) continue;
    count += 1.0;
    out.width += chosen.sigma[r] * chosen.sigma[r];
    out.inside += std::abs(chosen.measured[r] - chosen.predicted[r]) <= 1.96 * chosen.sigma[r] ? 1.0 : 0.0;
  }
  out.inside /= std::max(1.0, count);
  out.width = std::sqrt(out.width / std::max(1.0, count)) / chosen.test.rmse;
  out.inputs = chosen.inputs.size();
  for (const char* method : {"arx", "oe", "response"}) {
    request.method = method;
    try {
      out.rms[method] = identifyThermalModel(series, request, {}).test.rmse;
    } catch (const InputError&) {
      out.rms[method] = std::nan("");
    }
  }
  for (const char* rival : {"line", "ridge", "arx", "oe"})
    if (std::isfinite(out.rms[rival]) && out.rms[rival] < out.best) {
      out.best = out.rms[rival];
      out.winner = rival;
    }
  return out;
}

void print(const std::string& name, Figures& f) {
  std::printf(
      "%-14s chosen %8.2f  line %8.2f  ridge %8.2f  arx %8.2f  oe %8.2f  response %8.2f  ratio to best (%-5s) %5.2f  "
      "inside %3.0f %%  stated over actual %4.2f  inputs %zu\n",
      name.c_str(), f.rms["chosen"], f.rms["line"], f.rms["ridge"], f.rms["arx"], f.rms["oe"], f.rms["response"],
      f.winner.c_str(), f.rms["chosen"] / f.best, 100.0 * f.inside, f.width, f.inputs);
}

}  // namespace

int main(int argc, char** argv) {
  const bool spindle = argc > 2 && std::string(argv[2]) == "spindle";
  if (argc > 2 && !spindle && std::string(argv[2]) != "frame") {
    const TimeSeries series = readTimeSeries(argv[1]);
    Figures f = study(series, argv[2], argc > 3 ? std::atof(argv[3]) : 0.6);
    print(argv[2], f);
    return 0;
  }
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 40;
  const int first = argc > 3 ? std::atoi(argv[3]) : 0;
  double log_ratio = 0.0;
  double log_response = 0.0;
  double worst = 0.0;
  double inside = 0.0;
  double log_width = 0.0;
  int above = 0;
  std::map<std::string, int> missed;  ///< by who won
  for (int seed = first; seed < first + seeds; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    Figures f =
        study(spindle ? spindrift::testing::spindleRun(number) : spindrift::testing::frameRun(number), "z_um", 0.6);
    print("seed " + std::to_string(seed), f);
    const double ratio = f.rms["chosen"] / f.best;
    log_ratio += std::log(ratio) / seeds;
    log_response += std::log(f.rms["response"] / f.best) / seeds;
    worst = std::max(worst, ratio);
    above += ratio > 1.1 ? 1 : 0;
    if (ratio > 1.1) ++missed[f.winner];
    inside += f.inside / seeds;
    log_width += std::log(f.width) / seeds;
  }
  std::printf(
      "geometric mean of the ratio to the best of four %.3f (response alone %.3f), worst %.2f, above 1.1 in %d of %d; "
      "inside the 95 %% interval %.1f %%, stated over actual %.2f (geometric mean)\n",
      std::exp(log_ratio), std::exp(log_response), worst, above, seeds, 100.0 * inside, std::exp(log_width));
  for (const auto& [winner, count] : missed) std::printf("  of these %s won %d\n", winner.c_str(), count);
  return 0;
}
