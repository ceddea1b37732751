// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/fit_campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/workflows/nine_parameter_maps.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

Campaign someCampaign(const std::vector<Eigen::Vector3d>& points) {
  Campaign campaign;
  for (const auto& [name, travel] : {std::pair<const char*, double>{"X", 300.0}, {"Y", 130.0}}) {
    LinearAxis axis;
    axis.name = name;
    axis.travel_mm = {0.0, travel};
    campaign.machine.axes.push_back(axis);
  }
  Random random(1);
  ObservationSet set;
  for (int state = 0; state < 2; ++state) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (state == 0) campaign.machine.points.push_back({"F" + std::to_string(i + 1), "fiducial", points[i]});
      for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
        NineVector truth;
        truth << -28, 25, 6, 40, 25, 50, 20, 100, -80;
        Observation o;
        o.time_s = 1000.0 * state;
        o.state = state == 0 ? "M0" : "M1";
        o.point = "F" + std::to_string(i + 1);
        o.position_mm = points[i];
        o.component = c;
        o.sigma = 0.3;
        o.value = (state == 0 ? 0.0 : nineParameterRow(points[i], c).dot(truth)) + random.normal(0, 0.3);
        set.rows.push_back(o);
      }
    }
  }
  campaign.observations = set;
  return campaign;
}

const std::vector<Eigen::Vector3d> five{{20, 15, 0}, {280, 15, 0}, {280, 115, 0}, {20, 115, 0}, {150, 65, 0}};

/// Two readings that share more than they have: the covariance is none.
TEST(FitWorkflow, ARejectedFitStatesNothing) {
  Campaign campaign = someCampaign(five);
  ObservationSet& set = campaign.observations.edit();
  const std::size_t half = set.rows.size() / 2;
  const std::vector<CovarianceEntry> too_large{{half, half + 3, 1.0}};
  set.setCovariances(too_large);
  const NineParameterFit fit = fitNineParameters(set, {.state = "M1"});
  ASSERT_EQ(fit.status, FitStatus::Rejected);
  const nlohmann::json json = toJson(fit);
  for (const auto& [name, parameter] : json.at("parameters").items()) {
    EXPECT_TRUE(parameter.at("value").is_null()) << name;
    EXPECT_TRUE(parameter.at("standard_uncertainty").is_null()) << name;
  }
  for (const char* key : {"condition_number", "chi2", "p_value", "rms_fit_um"})
    EXPECT_TRUE(json.at(key).is_null()) << key;
  EXPECT_TRUE(json.at("covariance").at(0).at(0).is_null());
  EXPECT_TRUE(json.at("lack_of_fit_um").at("EX").is_null());
  EXPECT_EQ(json.at("undetermined").size(), 9U);
  EXPECT_THAT(summaryOf(fit), HasSubstr("EX         not determined"));
  EXPECT_THAT(summaryOf(fit), ::testing::Not(HasSubstr("condition number")));
  EXPECT_FALSE(nineParameterMaps(campaign.machine, fit, {}, {}).has_value());
  const NineParameterComparison compared =
      compareNineParameters(set, {.state = "M1", .points = {"F1", "F2", "F3"}}, {.state = "M1"});
  EXPECT_THAT(summaryOf(compared), ::testing::Not(HasSubstr("agree")));
  EXPECT_THAT(summaryOf(compared), ::testing::Not(HasSubstr("equal")));
}

TEST(FitWorkflow, MapsThatAreShownAreThoseOfTheModel) {
  Campaign campaign = someCampaign(five);
  const NineParameterFit fit = fitNineParameters(*campaign.observations, {.state = "M1"});
  const auto maps = nineParameterMaps(campaign.machine, fit, {}, {});
  ASSERT_TRUE(maps.has_value());
  EXPECT_FALSE(maps->higher.has_value());
  EXPECT_FALSE(maps->difference.has_value());
  for (std::size_t k = 0; k < 3; ++k) {
    const ComponentMap& map = maps->nine[k];
    EXPECT_EQ(map.field.component, all_components[k]);
    EXPECT_EQ(map.field.markers.size(), five.size());
    const Field same = tableField(fit, fit.predictingModel(), map.field.grid, all_components[k]);
    EXPECT_EQ(map.field.value, same.value);
    EXPECT_EQ(map.field.sigma, same.sigma);
    EXPECT_EQ(map.largest_um, same.largestMagnitude());
  }
  campaign.machine.axes.pop_back();
  EXPECT_FALSE(nineParameterMaps(campaign.machine, fit, {}, {}).has_value()) << "no axis Y";
}

TEST(FitWorkflow, JsonHoldsWhatTheContractNames) {
  const Campaign campaign = someCampaign(five);
  const auto j = toJson(fitNineParameters(*campaign.observations, {.state = "M1", .points = {"F1", "F2", "F3", "F4"}}));
  for (const char* name : {"EX_um", "EY_um", "EZ_um", "EA_urad", "EB_urad", "EC_urad", "EC0Y_urad", "alpha_X_um_per_m",
                           "alpha_Y_um_per_m"}) {
    ASSERT_TRUE(j["parameters"].contains(name)) << name;
    EXPECT_TRUE(j["parameters"][name]["value"].is_number());
    EXPECT_GT(j["parameters"][name]["standard_uncertainty"].get<double>(), 0.0);
  }
  EXPECT_NEAR(j["parameters"]["EX_um"]["value"].get<double>(), -28.0, 2.5);
  ASSERT_EQ(j["residuals"].size(), 15u);
  EXPECT_EQ(j["residuals"][12]["point"], "F5");
  EXPECT_EQ(j["residuals"][12]["used"], false);
  EXPECT_TRUE(j["residuals"][12]["residual_um"].is_number());
  EXPECT_TRUE(j["rms_fit_um"].is_number());
  EXPECT_TRUE(j["rms_validation_um"].is_number());
  EXPECT_GT(j["condition_number"].get<double>(), 1.0);
}

TEST(FitWorkflow, DegenerateFitGivesNullAndNeverInfinity) {
  const Campaign campaign = someCampaign({{20, 65, 0}, {150, 65, 0}, {280, 65, 0}});
  const auto j = toJson(fitNineParameters(*campaign.observations));
  EXPECT_EQ(j["status"], "degenerate");
  EXPECT_TRUE(j["parameters"]["EX_um"]["value"].is_null());
  EXPECT_TRUE(j["parameters"]["EC_urad"]["value"].is_number());
  EXPECT_EQ(j.dump().find("inf"), std::string::npos);
  const HeatmapResult map = heatmapOf(campaign, *campaign.observations, {});
  EXPECT_FALSE(map.determined);
  EXPECT_THAT(map.message, HasSubstr("EX cannot be mapped"));
}

TEST(FitWorkflow, HeatmapCoversTheTableAndMarksWhatIsExtrapolated) {
  const Campaign campaign = someCampaign(five);
  HeatmapOptions options;
  options.nx = 31;
  options.ny = 14;
  const HeatmapResult map = heatmapOf(campaign, *campaign.observations, options);
  ASSERT_TRUE(map.determined);
  EXPECT_EQ(map.field.value.size(), 31u * 14u);
  EXPECT_TRUE(map.field.extrapolated[0]);
  EXPECT_FALSE(map.field.extrapolated[map.field.grid.index(15, 7)]);
  EXPECT_GT(map.field.sigma[0], map.field.sigma[map.field.grid.index(15, 7)]);
  EXPECT_EQ(map.field.markers.size(), 5u);
  options.nx = 1;
  EXPECT_THROW((void)heatmapOf(campaign, *campaign.observations, options), InputError);
}

TEST(FitWorkflow, PlacementAmongFiducialsOrOnALattice) {
  const Campaign campaign = someCampaign(five);
  PlacementRequest request;
  const PlacementAnswer corners = placeFiducials(campaign.machine, request, {});
  EXPECT_EQ(corners.result.chosen, (std::vector<std::size_t>{0, 1, 2, 3}));
  request.lattice_nx = 6;
  request.lattice_ny = 4;
  request.fixed = {"F5"};
  const PlacementAnswer lattice = placeFiducials(campaign.machine, request, {});
  EXPECT_EQ(lattice.ids.size(), 25u);
  EXPECT_EQ(lattice.result.chosen.front(), 0u);
  EXPECT_THAT(lattice.summary(), HasSubstr("F5"));
  request.fixed = {"F77"};
  EXPECT_THROW((void)placeFiducials(campaign.machine, request, {}), InputError);
}

}  // namespace
}  // namespace spindrift
