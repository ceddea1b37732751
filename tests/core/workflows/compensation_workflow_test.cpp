// SPDX-License-Identifier: GPL-3.0-or-later
// What a correction says of itself: uncertainty, what it does where nothing was fitted, what was not measured.
#include "core/workflows/compensation_workflow.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/workflows/fit_campaign.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Twelve fiducials on a table; the warm table sags by `sag_um` in its middle. F6 is held out if asked for.
Campaign campaignOf(double sag_um, bool hold_out, std::uint64_t seed) {
  Campaign campaign;
  for (const auto& [name, travel] : {std::pair<const char*, double>{"X", 300.0}, {"Y", 130.0}, {"Z", 200.0}}) {
    LinearAxis axis;
    axis.name = name;
    axis.travel_mm = {0.0, travel};
    campaign.machine.axes.push_back(axis);
  }
  NineVector truth;
  truth << -28, 25, 6, 40, 25, 50, 20, 100, -80;
  Random random(seed);
  ObservationSet set;
  for (int state = 0; state < 2; ++state) {
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d at(20.0 + 260.0 / 3.0 * (i % 4), 15.0 + 50.0 * (i / 4), 0.0);
      for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
        Observation o;
        o.time_s = 1000.0 * state;
        o.state = state == 0 ? "M0" : "M1";
        o.point = "F" + std::to_string(i + 1);
        o.position_mm = at;
        o.component = c;
        o.sigma = 0.3;
        const double u = (at.x() - 150.0) / 150.0;
        if (state == 1) {
          o.value = nineParameterRow(at, c).dot(truth) + (c == Component::EZ ? sag_um * (1.0 - u * u) : 0.0);
        }
        o.value += random.normal(0, 0.3);
        if (hold_out && o.point == "F6") o.use = ObservationUse::Holdout;
        set.rows.push_back(o);
      }
    }
  }
  campaign.observations = set;
  return campaign;
}

CompensationPlan planOf(const Campaign& campaign, CompensationSource source) {
  CompensationRequest request;
  request.source = source;
  request.positions = 4;
  JobContext job;
  return planCompensation(campaign, *campaign.observations, request, job);
}

TEST(CompensationPlan, OfARejectedModelCarriesTheLackOfFitAndOffersTheRicherOne) {
  const Campaign campaign = campaignOf(6.0, false, 1);
  const CompensationPlan nine = planOf(campaign, CompensationSource::NineParameters);
  EXPECT_GT(nine.lack_of_fit_um.z(), 1.0);
  EXPECT_GT(nine.rms_sigma_um, 0.6);
  for (const CompensationPoint& p : nine.points) {
    EXPECT_GT(p.sigma_um.z(), nine.lack_of_fit_um.z());
    EXPECT_LT(std::abs(*p.remains_um[2]), 4.0 * p.sigma_um.z());
  }
  EXPECT_THAT(nine.richer_model, HasSubstr("second order in EZ"));
  EXPECT_THAT(nine.warnings, Contains(HasSubstr("A richer model fits better")));
  EXPECT_EQ(nine.json()["richer_model"], nine.richer_model);
  EXPECT_EQ(nine.json()["lack_of_fit_um"].size(), 3U);

  const CompensationPlan richer = planOf(campaign, CompensationSource::HigherOrder);
  EXPECT_EQ(richer.richer_model, "");
  EXPECT_THAT(richer.model, HasSubstr("second order in EZ"));
  EXPECT_LT(richer.rms_after_um, 0.5 * nine.rms_after_um);
  EXPECT_LT(richer.rms_sigma_um, 0.5 * nine.rms_sigma_um);
  EXPECT_LT(*richer.rms_after_unseen_um, 0.5 * *nine.rms_after_unseen_um);
}

TEST(CompensationPlan, RepeatedReadingsOfAPointCountAsTheirMean) {
  Campaign campaign = campaignOf(0.0, false, 2);
  ObservationSet& set = campaign.observations.edit();
  const ObservationSet once = set;
  Random random(21);
  double mean_um = 0.0;
  double zero_um = 0.0;
  for (int repeat = 0; repeat < 4; ++repeat) {
    for (const Observation& o : once.rows) {
      if (repeat > 0) {
        set.rows.push_back(o);
        set.rows.back().time_s += 10.0 * repeat;
        set.rows.back().value += random.normal(0, 2.0);
      }
      const double value = repeat > 0 ? set.rows.back().value : o.value;
      if (o.point == "F1" && o.component == Component::EX) (o.state == "M1" ? mean_um : zero_um) += 0.25 * value;
    }
  }
  const CompensationPlan plan = planOf(campaign, CompensationSource::NineParameters);
  ASSERT_EQ(plan.points.size(), 12U);
  EXPECT_NEAR(*plan.points[0].measured_um[0], mean_um - zero_um, 1e-9);
  // Four readings minus four: each has half of the uncertainty of one.
  EXPECT_NEAR(plan.points[0].measured_sigma_um[0], std::sqrt(2.0) * 0.3 / 2.0, 1e-9);
}

TEST(CompensationPlan, ItsGridIsExtrapolatedBeyondTheHullOfWhatWasFitted) {
  Campaign campaign = campaignOf(0.0, false, 2);
  // A triangle, and a point that only judges in the corner that it leaves open.
  for (Observation& o : campaign.observations.edit().rows) {
    if (o.position_mm.x() / 300.0 + o.position_mm.y() / 130.0 > 1.0) o.use = ObservationUse::Exclude;
    if (o.point == "F12") o.use = ObservationUse::Holdout;
  }
  const CompensationPlan plan = planOf(campaign, CompensationSource::NineParameters);
  const auto grid = std::find_if(plan.files.begin(), plan.files.end(),
                                 [](const CompensationFile& f) { return f.name == "compensation_grid.csv"; });
  ASSERT_NE(grid, plan.files.end());
  EXPECT_THAT(grid->content, ::testing::ContainsRegex("\n100,43\\.3[0-9]*,0,[^\n]*,0\n"));
  EXPECT_THAT(grid->content, ::testing::ContainsRegex("\n200,86\\.6[0-9]*,0,[^\n]*,1\n"));
}

TEST(CompensationPlan, OfAGoodModelIsAsCertainAsItsParameters) {
  const Campaign campaign = campaignOf(0.0, false, 2);
  const CompensationPlan nine = planOf(campaign, CompensationSource::NineParameters);
  EXPECT_TRUE(nine.lack_of_fit_um.isZero());
  EXPECT_LT(nine.rms_sigma_um, 0.4);
  EXPECT_TRUE(nine.json()["richer_model"].is_null());
  const CompensationPlan asked = planOf(campaign, CompensationSource::HigherOrder);
  EXPECT_THAT(asked.warnings, Contains(HasSubstr("A model of higher order is not supported")));
}

TEST(CompensationPlan, StatesWhatItDoesOnValuesThatTrainedNothing) {
  const CompensationPlan held = planOf(campaignOf(6.0, true, 3), CompensationSource::NineParameters);
  EXPECT_EQ(held.unseen, "at F6, held out");
  // In the middle the sag is about 2 um above what a plane takes of it.
  EXPECT_GT(*held.rms_after_unseen_um, 0.8);
  EXPECT_GT(*held.rms_before_unseen_um, 10.0);
  const CompensationPlan all = planOf(campaignOf(6.0, false, 3), CompensationSource::NineParameters);
  EXPECT_EQ(all.unseen, "at every point, predicted without it");
  EXPECT_GT(*all.rms_after_unseen_um, all.rms_after_um) << "fitted values flatter";
  EXPECT_THAT(all.summary(), HasSubstr("on data not used for fitting"));
  EXPECT_TRUE(all.json()["unseen"]["rms_after_um"].is_number());
}

TEST(CompensationPlan, SaysWhenItDoesMoreHarmThanGood) {
  EXPECT_EQ(planOf(campaignOf(6.0, true, 3), CompensationSource::NineParameters).harm(), "");
  // Nothing but noise: what is fitted to it makes every point that was left out worse.
  Campaign cold = campaignOf(0.0, false, 4);
  Random random(5);
  for (Observation& o : cold.observations.edit().rows) o.value = random.normal(0, 0.3);
  const CompensationPlan plan = planOf(cold, CompensationSource::NineParameters);
  ASSERT_GT(*plan.rms_after_unseen_um, *plan.rms_before_unseen_um);
  EXPECT_THAT(plan.harm(), HasSubstr("must not be used"));
  EXPECT_THAT(plan.summary(), HasSubstr("must not be used"));
  EXPECT_EQ(plan.json()["good_enough"], false);
}

TEST(CompensationPlan, NamesTheFileThatCannotBeCompensated) {
  Campaign campaign = campaignOf(0.0, false, 6);
  ObservationSet& set = campaign.observations.edit();
  set.file = "observations.csv";
  const std::string kept = set.rows.front().point;
  std::erase_if(set.rows, [&](const Observation& o) { return o.point != kept; });
  CompensationRequest request;
  JobContext job;
  EXPECT_THAT(testing::refusal([&] { (void)planCompensation(campaign, *campaign.observations, request, job); }),
              HasSubstr("observations.csv: state "));
}

TEST(CompensationPlan, TheLinesOfItsTablesPassWhereTheMachineCanGo) {
  const Campaign campaign = campaignOf(0.0, false, 6);
  CompensationRequest request;
  request.reference_mm = Eigen::Vector3d(10.0, 10.0, 5000.0);
  JobContext job;
  try {
    (void)planCompensation(campaign, *campaign.observations, request, job);
    ADD_FAILURE() << "tables for a height of five metres";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("Z 5000 mm lies outside the travel; allowed: 0 to 200 mm"));
  }
}

const CompensationFile* fileOf(const CompensationPlan& plan, const std::string& name) {
  const auto at =
      std::find_if(plan.files.begin(), plan.files.end(), [&](const CompensationFile& f) { return f.name == name; });
  return at == plan.files.end() ? nullptr : &*at;
}

/// What the tables leave of the deviation of EX, EY, EZ at places of the plane z = 0, mm: its largest change.
double leftBy(const std::vector<ControlTable>& tables, const ErrorModel& model) {
  Eigen::Vector3d least = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d most = -least;
  for (const double x : {0.0, 100.0, 200.0, 300.0}) {
    for (const double y : {0.0, 130.0 / 3.0, 130.0}) {
      DeviationQuery query;
      query.state = "M1";
      query.position_mm = {x, y, 0.0};
      Eigen::Vector3d left;
      for (int i = 0; i < 3; ++i) left[i] = 1e-3 * model.predict(query, static_cast<Component>(i)).value;
      for (const ControlTable& t : tables) left[t.axis - 'X'] += t.movementAt(t.base == 'X' ? x : y);
      least = least.cwiseMin(left);
      most = most.cwiseMax(left);
    }
  }
  return (most - least).maxCoeff();
}

// Nine parameters have no product of x and y: a table for each displacement over each axis takes all of them.
TEST(CompensationPlan, TablesOfAControlTogetherTakeAllDisplacements) {
  const Campaign campaign = campaignOf(0.0, false, 4);
  NineParameterOptions options;
  options.state = "M1";
  const NineParameterModel model = fitNineParameters(*campaign.observations, options).predictingModel();
  EXPECT_GT(leftBy({}, model), 0.02);
  CompensationRequest request;
  request.positions = 4;
  request.reference_mm = Eigen::Vector3d(150.0, 65.0, 0.0);
  request.fanuc_step = FanucStep::Negative;
  JobContext job;
  const CompensationPlan plan = planCompensation(campaign, *campaign.observations, request, job);
  std::vector<ControlTable> siemens;
  std::vector<ControlTable> heidenhain;
  std::vector<ControlTable> fanuc;
  for (const CompensationFile& f : plan.files) {
    if (f.name.rfind("siemens_", 0) == 0)
      for (const ControlTable& t : readSiemensTables(f.content, f.name)) siemens.push_back(t);
    if (f.name.rfind("heidenhain_", 0) == 0)
      for (const ControlTable& t : readHeidenhainTable(f.content, f.name)) heidenhain.push_back(t);
    if (f.name.rfind("fanuc_", 0) == 0) fanuc.push_back(readFanucPitchError(f.content, f.name));
  }
  EXPECT_EQ(siemens.size(), 6U);
  EXPECT_EQ(heidenhain.size(), 6U);
  EXPECT_LT(leftBy(siemens, model), 4e-6);
  EXPECT_LT(leftBy(heidenhain, model), 4e-6);
  ASSERT_EQ(fanuc.size(), 2U) << "X and Y; nothing was measured along Z";
  EXPECT_EQ(fanuc[1].axis, 'Y');
  EXPECT_EQ(plan.not_written, "");
  // The numbers of the axes do not meet.
  EXPECT_THAT(fileOf(plan, "fanuc_X_pitch.nc")->content, HasSubstr("(LAST 3 PARAMETER 3622)"));
  EXPECT_THAT(fileOf(plan, "fanuc_Y_pitch.nc")->content, HasSubstr("(FIRST 5 PARAMETER 3621)"));
}

TEST(CompensationPlan, WritesNoFanucDataBeforeTheirDirectionIsStated) {
  const CompensationPlan plan = planOf(campaignOf(0.0, false, 4), CompensationSource::NineParameters);
  EXPECT_EQ(fileOf(plan, "fanuc_X_pitch.nc"), nullptr);
  EXPECT_THAT(plan.summary(), HasSubstr("No pitch error data are written for Fanuc until it is stated"));
  EXPECT_THAT(plan.json()["not_written"].get<std::string>(), HasSubstr("with an indicator on the axis"));
}

TEST(CompensationPlan, SaysWhatAControlCannotTake) {
  Campaign campaign = campaignOf(0.0, false, 4);
  for (Observation& o : campaign.observations.edit().rows)
    if (o.state == "M1" && o.component == Component::EX) o.value += 4.0 * o.position_mm.x();  // 1.2 mm over X
  CompensationRequest request;
  request.positions = 3;
  request.fanuc_step = FanucStep::Positive;
  JobContext job;
  const CompensationPlan plan = planCompensation(campaign, *campaign.observations, request, job);
  EXPECT_EQ(fileOf(plan, "fanuc_X_pitch.nc"), nullptr);
  EXPECT_NE(fileOf(plan, "fanuc_Y_pitch.nc"), nullptr);
  EXPECT_THAT(plan.warnings,
              Contains(HasSubstr("The file fanuc_X_pitch.nc is not written: the compensation of X changes by")));
  request.fanuc_unit_um = 0.0;
  EXPECT_THROW((void)planCompensation(campaign, *campaign.observations, request, job), InputError);
}

TEST(CompensationPlan, StatesNothingOfAnAxisThatWasNotMeasured) {
  const CompensationPlan plan = planOf(campaignOf(0.0, false, 4), CompensationSource::NineParameters);
  std::vector<std::string> names;
  for (const CompensationFile& f : plan.files) {
    names.push_back(f.name);
    if (f.name == "iso230_Z.csv") {
      EXPECT_THAT(f.content, HasSubstr("# nothing was measured along Z"));
    }
    if (f.name == "linuxcnc_X.comp") {
      EXPECT_THAT(f.convention, HasSubstr("Measured from 20 to 280 mm"));
    }
  }
  EXPECT_THAT(names, Contains("linuxcnc_X.comp"));
  EXPECT_THAT(names, Not(Contains("linuxcnc_Z.comp"))) << "a screw table is a statement, too";
  EXPECT_THAT(plan.warnings, Contains(HasSubstr("Nothing was measured along Z")));
}

TEST(Heatmap, OfARejectedModelCarriesTheLackOfFit) {
  const Campaign campaign = campaignOf(6.0, false, 1);
  HeatmapOptions options;
  options.component = Component::EZ;
  options.nx = options.ny = 5;
  const HeatmapResult map = heatmapOf(campaign, *campaign.observations, options);
  ASSERT_TRUE(map.determined);
  ASSERT_GT(map.fit.lack_of_fit_um.z(), 1.0);
  for (const double sigma : map.field.sigma) EXPECT_GT(sigma, map.fit.lack_of_fit_um.z());
}

TEST(CompensationPlan, WhatScattersAboutOneHeightIsNoExtentAlongZ) {
  Campaign campaign = campaignOf(0.0, false, 5);
  Random random(5);
  for (Observation& o : campaign.observations.edit().rows) o.position_mm.z() = -3.0 + 0.005 * random.uniform(-1.0, 1.0);
  const CompensationPlan plan = planOf(campaign, CompensationSource::NineParameters);
  EXPECT_THAT(plan.warnings, Contains(HasSubstr("Nothing was measured along Z")));
  for (const CompensationFile& f : plan.files) {
    EXPECT_NE(f.name, "linuxcnc_Z.comp");
    EXPECT_NE(f.name, "siemens_Z_eec.ini");
  }
}

/// Growth of the spindle in Z at four points, which the simulation lacks; X and Y were not measured. `jump_um`: so much
/// more in two states, which nothing in the log explains.
Campaign heightsOnly(const testing::TempFolder& folder, double jump_um = 0.0) {
  Campaign campaign = campaignOf(0.0, false, 6);
  std::vector<double> time_s, rpm;
  for (int k = 0; k <= 600; ++k) {
    time_s.push_back(30.0 * k);
    rpm.push_back(k >= 60 && k < 400 ? 4000.0 : 0.0);
  }
  campaign.log = OperatingLog(time_s);
  campaign.log.edit().setSignal("spindle_rpm", rpm);
  Random random(7);
  ObservationSet set;
  std::string simulated = "time_s,point,component,predicted\n";
  for (int state = 0; state < 20; ++state) {
    const double t = 900.0 * state;
    const double grown = t < 1800.0    ? 0.0
                         : t < 12000.0 ? 9.0 * (1.0 - std::exp(-(t - 1800.0) / 2400.0))
                                       : 9.0 * std::exp(-(t - 12000.0) / 2400.0);
    for (int i = 0; i < 4; ++i) {
      Observation o;
      o.time_s = t;
      o.state = "M" + std::to_string(state);
      o.point = "F" + std::to_string(i + 1);
      o.position_mm = {20.0 + 200.0 * (i % 2), 15.0 + 80.0 * (i / 2), 50.0 * i};
      o.component = Component::EZ;
      o.sigma = 0.3;
      o.value = grown + (state == 10 || state == 11 ? jump_um : 0.0) + random.normal(0, 0.3);
      simulated += fmt::format("{},{},EZ,0\n", t, o.point);
      set.rows.push_back(o);
    }
  }
  campaign.observations = set;
  folder.write("simulation.csv", simulated);
  campaign.folder = folder.path();
  campaign.simulation = "simulation.csv";
  return campaign;
}

/// The constants of the series take up half of what the model lacks, and what remains would look half as large as it
/// is.
TEST(CompensationPlan, WhatTheAddedEffectsDoNotDescribeIsInTheUncertainty) {
  CompensationRequest request;
  request.source = CompensationSource::CompletedModel;
  request.added = {"spindle.growth.z"};
  request.state = "M10";
  request.positions = 3;
  JobContext job;
  const testing::TempFolder whole_folder, lacking_folder;
  const Campaign whole = heightsOnly(whole_folder);
  const CompensationPlan right = planCompensation(whole, *whole.observations, request, job);
  EXPECT_LT(right.rms_after_um, 0.8);
  EXPECT_LT(right.rms_sigma_um, 0.8);
  const Campaign lacking = heightsOnly(lacking_folder, -6.0);
  const CompensationPlan wrong = planCompensation(lacking, *lacking.observations, request, job);
  for (const CompensationPoint& p : wrong.points) {
    double change = 0.0;
    for (const Observation& o : lacking.observations->rows) {
      if (o.point != p.point) continue;
      if (o.state == "M10") change += o.value;
      if (o.state == "M0") change -= o.value;
    }
    ASSERT_TRUE(p.measured_um[2]);
    EXPECT_NEAR(*p.measured_um[2], change, 1.5) << p.point << " since the first state, not about a constant";
  }
  EXPECT_GT(wrong.rms_after_um, 1.5);
  EXPECT_GT(wrong.rms_sigma_um, 0.7 * wrong.rms_after_um);
  EXPECT_GT(wrong.lack_of_fit_um.z(), 1.0);
}

TEST(CompensationPlan, StatesNothingOfADisplacementThatWasNotMeasured) {
  const testing::TempFolder folder;
  const Campaign campaign = heightsOnly(folder);
  CompensationRequest request;
  request.source = CompensationSource::CompletedModel;
  request.added = {"spindle.growth.z"};
  request.state = "M10";
  request.positions = 3;
  JobContext job;
  const CompensationPlan plan = planCompensation(campaign, *campaign.observations, request, job);
  ASSERT_EQ(plan.points.size(), 4U);
  EXPECT_LT(plan.points.front().correction_um.z(), -5.0);
  EXPECT_TRUE(std::isnan(plan.points.front().correction_um.x())) << "0 would say that X needs none";
  EXPECT_TRUE(std::isnan(plan.points.front().sigma_um.y()));
  EXPECT_GT(plan.largest_um, 5.0);
  EXPECT_TRUE(plan.json()["points"][0]["correction_um"][0].is_null());
  EXPECT_THAT(plan.warnings, Contains(HasSubstr("EX was not measured")));
  std::vector<std::string> names;
  for (const CompensationFile& f : plan.files) {
    names.push_back(f.name);
    if (f.name == "compensation_points.csv") {
      EXPECT_THAT(f.content, HasSubstr("\nF1,20,15,0,,,-"));
    }
    if (f.name == "compensation_grid.csv") {
      EXPECT_THAT(f.content, HasSubstr("\n0,0,0,,,-"));
    }
    if (f.name == "iso230_X.csv") {
      EXPECT_THAT(f.content, HasSubstr("# not measured, so that nothing is stated of it: EX, EY"));
      // The spindle that grows has the same EZ everywhere: nothing tells how it changes along X.
      EXPECT_THAT(f.content, HasSubstr("# not in the model, so that nothing is stated of it: EZX, EAX, EBX, ECX"));
      EXPECT_THAT(f.content, HasSubstr("\n150,,,,,,,,,,,,,0\n"));
    }
  }
  EXPECT_THAT(names, Not(Contains("linuxcnc_X.comp"))) << "a table of zeros says that the axis is right";
  EXPECT_THAT(names, Contains("linuxcnc_Z.comp"));
}

}  // namespace
}  // namespace spindrift
