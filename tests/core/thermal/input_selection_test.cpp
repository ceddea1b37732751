// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/input_selection.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/thermal/input_projection.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {
namespace {

/// Ten sensors driven by their own heat; the output follows two of them.
TimeSeries record(std::uint64_t seed) {
  Random random(seed);
  TimeSeries s;
  for (int k = 0; k < 1500; ++k) s.time_s.push_back(60.0 * k);
  std::vector<std::vector<double>> t;
  for (int i = 0; i < 10; ++i) {
    std::vector<double> u;
    double level = 0.0;
    for (std::size_t k = 0; k < s.time_s.size(); ++k) {
      if (random.uniform() < 0.01) level = random.normal(0.0, 3.0);
      u.push_back(level);
    }
    t.push_back(lagFiltered(s.time_s, u, 1200.0, true));
    for (double& v : t.back()) v += 22.0 + random.normal(0.0, 0.02);
    s.signals.push_back({fmt::format("T_{}_degC", i), SignalKind::Temperature, t.back()});
  }
  const auto slow = lagFiltered(s.time_s, t[3], 5000.0, false);
  std::vector<double> y(s.time_s.size());
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = 4.0 * slow[k] - 2.0 * t[7][k] + random.normal(0.0, 0.2);
  s.signals.push_back({"ez_um", SignalKind::Displacement, y});
  return s;
}

std::vector<std::string> sensors() {
  std::vector<std::string> names;
  for (int i = 0; i < 10; ++i) names.push_back(fmt::format("T_{}_degC", i));
  return names;
}

TEST(InputSelection, FindsTheInputsThatMatterAndGivesReasons) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const TimeSeries s = record(seed);
    const SelectionResult r = selectByGroupLasso(s, "ez_um", sensors(), 0.0, 1e9, {}, {});
    EXPECT_NE(std::find(r.kept.begin(), r.kept.end(), "T_3_degC"), r.kept.end()) << r.method;
    EXPECT_NE(std::find(r.kept.begin(), r.kept.end(), "T_7_degC"), r.kept.end()) << r.method;
    EXPECT_LE(r.kept.size(), 5U) << r.method;
    EXPECT_LT(r.held_out_rms, 0.3);
    // What matters is chosen more often under resampling than what does not.
    double needed = 0.0;
    double others = 0.0;
    for (const SelectedInput& in : r.inputs) {
      EXPECT_FALSE(in.reason.empty());
      const bool matters = in.name == "T_3_degC" || in.name == "T_7_degC";
      (matters ? needed : others) += in.frequency / (matters ? 2.0 : 8.0);
    }
    EXPECT_GT(needed, 2.0 * others) << r.method;
  }
}

/// Two sensors that move together in training and part afterwards, a third that says little: what the two tell is the
/// same on few inputs as on all, in the rows of training and where these did not lead.
TEST(InputProjection, KeptInputsGoOnTellingWhatTheyToldOutsideTheRangeOfTraining) {
  Random random(6);
  TimeSeries s;
  Signal a{"T_a_degC", SignalKind::Temperature, {}};
  Signal b{"T_b_degC", SignalKind::Temperature, {}};
  Signal c{"T_c_degC", SignalKind::Temperature, {}};
  for (int k = 0; k < 900; ++k) {
    s.time_s.push_back(60.0 * k);
    const double wave = 4.0 * std::sin(k / 50.0);
    a.values.push_back(25.0 + wave + random.normal(0.0, 0.02));
    b.values.push_back(25.0 + (k < 600 ? wave : -2.0 * wave) + random.normal(0.0, 0.02));
    c.values.push_back(25.0 + std::sin(k / 17.0) + random.normal(0.0, 0.02));
  }
  s.signals = {a, b, c};
  ThermalModel model;
  for (const Signal& signal : s.signals) model.inputs.push_back({signal.name, signal.kind, 1.0, 1.0, 25.0, 15.0, 35.0});
  ThermalOutput output;
  output.name = "ez_um";
  output.unit = "um";
  output.terms = {{0, 0.0, 3.0}, {1, 0.0, -1.0}, {2, 0.0, 0.1}};
  model.outputs.push_back(output);
  const ThermalModel few = projectModel(s, model, {"T_a_degC", "T_b_degC"}, 0.0, 36000.0, ProjectionOptions()).model;
  ASSERT_EQ(few.inputs.size(), 2U);
  const std::vector<double> whole = model.predict(s, 0).value;
  const std::vector<double> projected = few.predict(s, 0).value;
  double inside = 0.0;
  double outside = 0.0;
  for (std::size_t k = 0; k < whole.size(); ++k)
    (k < 600 ? inside : outside) = std::max(k < 600 ? inside : outside, std::abs(projected[k] - whole[k]));
  EXPECT_LT(inside, 0.3) << "a tenth of what the third sensor moves by, and its noise";
  EXPECT_LT(outside, 1.0) << "of 20 um";
}

TEST(InputSelection, ConstantInputsAreNamed) {
  TimeSeries s = record(4);
  s.signals.push_back({"T_still_degC", SignalKind::Temperature, std::vector<double>(s.time_s.size(), 20.0)});
  const SelectionResult r = selectByGroupLasso(s, "ez_um", {"T_3_degC", "T_still_degC"}, 0.0, 1e9, {}, {});
  EXPECT_EQ(r.inputs.back().name, "T_still_degC");
  EXPECT_EQ(r.inputs.back().reason.find("constant"), 0U);
  EXPECT_THROW(static_cast<void>(selectByGroupLasso(s, "ez_um", {"T_still_degC"}, 0.0, 1e9, {}, {})), InputError);
}

TEST(InputSelection, SensorsFallIntoThreeGroups) {
  Random random(5);
  TimeSeries s;
  std::vector<std::string> names;
  for (int k = 0; k < 300; ++k) s.time_s.push_back(60.0 * k);
  for (int i = 0; i < 13; ++i) {
    const double change = i < 3 ? 20.0 : i < 8 ? 6.0 : 0.8;
    const double tau = i < 3 ? 1500.0 : i < 8 ? 4000.0 : 9000.0;
    std::vector<double> v;
    for (const double t : s.time_s)
      v.push_back(21.0 + change * (1.0 + 0.02 * i) * -std::expm1(-t / tau) + random.normal(0.0, 0.02));
    names.push_back(fmt::format("T_{}_degC", i));
    s.signals.push_back({names.back(), SignalKind::Temperature, v});
  }
  for (const int count : {3, 0}) {
    const auto clusters = clusterSensors(s, names, count);
    ASSERT_EQ(clusters.size(), 3U);
    EXPECT_EQ(clusters[0].names.size(), 3U);
    EXPECT_EQ(clusters[1].names.size(), 5U);
    EXPECT_EQ(clusters[2].names.size(), 5U);
    EXPECT_GT(clusters[0].mean_change, clusters[1].mean_change);
    EXPECT_FALSE(clusters[2].representative.empty());
  }
}

}  // namespace
}  // namespace spindrift
