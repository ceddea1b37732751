// SPDX-License-Identifier: GPL-3.0-or-later
// Joint fits of lags and onsets: what bends each other is found together, and bounds that hold are kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/effect_search.h"
#include "core/discrepancy/residual_problem.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using namespace small_plant;

/// A campaign in which nothing is hidden but what a test adds, and what is needed to fit it.
class EffectFit : public ::testing::Test {
 protected:
  explicit EffectFit(std::uint64_t seed = 3) : input_(campaign(Hidden::Nothing, seed)) {
    for (std::size_t i = 0; i < input_.observations.rows.size(); ++i) {
      input_.observations.rows[i].value = input_.predicted[i];
      if (input_.observations.rows[i].use == ObservationUse::Fit) rows_.push_back(i);
    }
    drivers_ = std::make_unique<DriverTable>(input_.machine, &*input_.log);
    CatalogueContext context;
    context.machine = &input_.machine;
    context.drivers = drivers_.get();
    catalogue_ = effectCatalogue(context);
  }

  [[nodiscard]] const Effect& effect(const std::string& id) const {
    return *std::find_if(catalogue_.begin(), catalogue_.end(), [&](const Effect& e) { return e.id == id; });
  }
  /// Adds what a term makes with this gain of its first shape column, um.
  void add(const ModelTerm& term, double gain) {
    const ResidualProblem empty(input_, rows_, 3000);
    const EffectSearch search(empty, *drivers_, catalogue_);
    for (const Effect& e : catalogue_) search.prepare(e);
    const Eigen::VectorXd moved = search.columns(term).col(0);
    for (Eigen::Index u = 0; u < moved.size(); ++u) added_um_.push_back({u, gain * moved[u]});
  }
  void fit() {
    problem_ = std::make_unique<ResidualProblem>(input_, rows_, 3000);
    for (const auto& [unit, um] : added_um_) problem_->y[unit] += um;
    Random random(11);
    for (Eigen::Index u = 0; u < problem_->size(); ++u) problem_->y[u] += random.normal(0.0, noise_um);
    problem_->setNuisances({});
    search_ = std::make_unique<EffectSearch>(*problem_, *drivers_, catalogue_);
    for (const Effect& e : catalogue_) search_->prepare(e);
  }

  static constexpr double noise_um = 0.05;
  DiscrepancyInput input_;
  std::vector<std::size_t> rows_;
  std::unique_ptr<DriverTable> drivers_;
  std::vector<Effect> catalogue_;
  std::vector<std::pair<Eigen::Index, double>> added_um_;
  std::unique_ptr<ResidualProblem> problem_;
  std::unique_ptr<EffectSearch> search_;
};

// The sum of a quick and a slow body under one heat: either lag moves the other, and one at a time crawls.
TEST_F(EffectFit, LagsThatBendEachOtherAreFoundTogether) {
  const Effect& drift = effect("spindle.drift.y");
  const auto through = [&](double tau_s) {
    return ModelTerm{&drift, {{{"spindle_rpm^1", Dynamics::Lag}}, false}, {tau_s}};
  };
  add(through(700.0), 0.5);
  add(through(2400.0), 0.8);
  fit();
  const JointFit truth = search_->solve({through(700.0), through(2400.0)});
  const JointFit found = search_->refine({through(1000.0), through(1600.0)}, 1);
  EXPECT_LE(found.chi2, truth.chi2) << found.terms[0].parameters[0] << " s and " << found.terms[1].parameters[0];
  EXPECT_NEAR(found.terms[0].parameters[0], 700.0, 70.0);
  EXPECT_NEAR(found.terms[1].parameters[0], 2400.0, 240.0);
}

// One state went wrong during a load that lasts: the load may not shrink to that state, which would be none.
TEST_F(EffectFit, WhatIsAllowedStaysAllowed) {
  const Effect& heat = effect("external_heat.z");
  const double interval_s = input_.observations.rows[18].time_s - input_.observations.rows[0].time_s;
  const double begin_s = 12.5 * interval_s;
  const auto load = [&](double from_s, double length_s) {
    return ModelTerm{&heat, {{{"", Dynamics::Pulse}}, false}, {from_s, length_s, 600.0}};
  };
  add(load(begin_s, 3.0 * interval_s), 1.0);
  add(load(begin_s, 1.0 * interval_s), 30.0);
  fit();
  const JointFit shrunk = search_->solve({load(begin_s, 1.0 * interval_s)});
  ASSERT_FALSE(search_->admissible(shrunk.terms[0], shrunk.gains[0])) << "or there is nothing to keep";
  int allowed = 0;
  for (double part = -1.0; part < 0.9; part += 0.4) {
    for (double length = 1.2; length < 5.0; length += 0.4) {
      const ModelTerm start = load(begin_s + part * interval_s, length * interval_s);
      const JointFit before = search_->solve({start});
      if (!search_->admissible(before.terms[0], before.gains[0])) continue;
      ++allowed;
      const JointFit found = search_->refine({start}, 2);
      EXPECT_TRUE(search_->admissible(found.terms[0], found.gains[0])) << part << " " << length;
      EXPECT_LE(found.chi2, before.chi2);
    }
  }
  EXPECT_GT(allowed, 20);
}

}  // namespace
}  // namespace spindrift
