// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tasks/campaign_state.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/core/tasks/tasks_support.h"

namespace spindrift {
namespace {

CampaignEvaluation evaluation() {
  CampaignEvaluation out;
  for (int k = 0; k < 4; ++k) {
    Observation o;
    o.time_s = 60.0 * k;
    o.state = "M" + std::to_string(k);
    o.point = "F1";
    o.sigma = 0.5;
    out.observations.rows.push_back(o);
  }
  out.observations.shared.addFactor({{0, 0.1}, {2, -0.2}, {3, 1.0 / 3.0}});
  out.observations.shared.addFactor({{1, 0.25}, {2, 0.125}});
  return out;
}

TEST(CampaignState, EvaluationsAreStoredWithTheFactorsOfTheirNoise) {
  const CampaignEvaluation before = evaluation();
  StoredResult stored;
  stored.payload = nlohmann::json::parse(payloadOf(before).dump());
  const ObservationSet after = evaluationFrom(stored).observations;
  ASSERT_EQ(after.shared.factors().size(), 2U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(after.rows[i].sigma, 0.5);
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_EQ(after.shared.covariance(i, j), before.observations.shared.covariance(i, j));
  }
}

/// A result that somebody else wrote, or that was damaged: it is outdated, and everything else of the session is there.
TEST(CampaignState, ResultsThatCannotBeReadAreOutdated) {
  for (const char* payload : {"\"x\"", "[1]", R"({"json":[],"summary":1})"}) {
    SCOPED_TRACE(payload);
    testing::TaskSession s;
    s.run("evaluate", nlohmann::json::parse(payload));
    s.run("report", {{"file", nlohmann::json::array()}});
    EXPECT_EQ(s.status("evaluate").state, TaskState::Outdated);
    for (const StepId step : all_steps) EXPECT_FALSE(s.step(step).sentence.empty());
    EXPECT_EQ(s.step(StepId::Report).state, StepState::Outdated);
    const CampaignState state = CampaignState::read(s.session_, s.id_);
    const TaskLedger nothing_runs;
    const TaskGraph graph = state.tasks(s.session_, nothing_runs);
    EXPECT_EQ(state.evaluation(graph), nullptr);
    EXPECT_FALSE(graph.status("evaluate").current);
  }
}

TEST(CampaignState, AnEvaluationOfOneInstrumentComesBackAsItWasWorkedOut) {
  CampaignEvaluation before = evaluation();
  InstrumentEvaluation instrument;
  instrument.instrument = "microscope";
  instrument.rejected = {{"captures/images/0.jpg", "blurred"}};
  instrument.warnings = {"one image could not be used.", {"beta is not known.", WarningKind::CalibrationLimit}};
  instrument.details = {{"pixel_um", 1.5}};
  instrument.good_enough = false;
  before.instruments = {instrument};
  before.good_enough = false;
  StoredResult stored;
  stored.payload = payloadOf(before);
  const auto after = asWorkedOut(evaluationFrom(stored));
  ASSERT_TRUE(after.has_value());
  ASSERT_EQ(after->instruments.size(), 1U);
  EXPECT_EQ(after->json(), before.json());
  EXPECT_EQ(after->instruments[0].instrument, "microscope");
  EXPECT_EQ(after->instruments[0].rejected[0].reason, "blurred");
  EXPECT_EQ(after->instruments[0].warnings, instrument.warnings);
  EXPECT_EQ(after->observations.rows.size(), 4U);
  EXPECT_FALSE(after->good_enough);
}

TEST(CampaignState, EvaluationsOfSeveralInstrumentsComeBackEachByItself) {
  CampaignEvaluation before = evaluation();
  InstrumentEvaluation microscope;
  microscope.instrument = "microscope";
  microscope.rejected = {{"captures/images/0.jpg", "blurred"}};
  microscope.details = {{"pixel_um", 1.5}};
  InstrumentEvaluation probe;
  probe.instrument = "touch_probe";
  probe.warnings = {{"beta is not known.", WarningKind::CalibrationLimit}, "two touches of H1 are missing."};
  probe.details = {{"cycles", {{{"cycle", "C1"}}}}};
  probe.summary = "six cycles\n";
  probe.good_enough = false;
  before.instruments = {microscope, probe};
  before.good_enough = false;
  StoredResult stored;
  stored.payload = nlohmann::json::parse(payloadOf(before).dump());
  const auto after = asWorkedOut(evaluationFrom(stored));
  ASSERT_TRUE(after.has_value());
  ASSERT_EQ(after->instruments.size(), 2U);
  EXPECT_EQ(after->json(), before.json());
  EXPECT_EQ(after->instruments[0].rejected[0].capture, "captures/images/0.jpg");
  EXPECT_TRUE(after->instruments[0].good_enough);
  EXPECT_EQ(after->instruments[1].instrument, "touch_probe");
  EXPECT_EQ(after->instruments[1].warnings, probe.warnings);
  EXPECT_EQ(after->instruments[1].details, probe.details);
  EXPECT_EQ(after->instruments[1].summary, probe.summary);
  EXPECT_FALSE(after->instruments[1].good_enough);
  EXPECT_EQ(after->observations.rows.size(), 4U);
  EXPECT_EQ(evaluationFrom(stored).warnings, probe.warnings);
  stored.payload.erase("warning_kinds");
  EXPECT_EQ(evaluationFrom(stored).warnings[0].kind, WarningKind::Finding) << "earlier versions did not say what it is";
  stored.payload.erase("instruments");
  EXPECT_FALSE(asWorkedOut(evaluationFrom(stored)).has_value()) << "earlier versions did not say what is whose";
}

TEST(CampaignState, CopiesOfACampaignShareItsReadingsUntilOneIsEdited) {
  Campaign campaign;
  campaign.observations = evaluation().observations;
  Campaign copy = campaign;
  EXPECT_EQ(copy.observations.get(), campaign.observations.get());
  const double before_s = campaign.observations->rows[0].time_s;
  copy.observations.edit().rows[0].time_s += 1.0;
  EXPECT_EQ(campaign.observations->rows[0].time_s, before_s);
  EXPECT_EQ(copy.observations->rows[0].time_s, before_s + 1.0);
  const ObservationSet* own = copy.observations.get();
  copy.observations.edit().rows[0].time_s += 1.0;
  EXPECT_EQ(copy.observations.get(), own) << "nobody shares it any more";
}

TEST(CampaignState, ObservationsToFitAreMarkedOnceForAllAndNothingIsCopiedWhereNothingIsMarked) {
  Campaign campaign;
  campaign.observations = evaluation().observations;
  const auto shared = std::make_shared<const Campaign>(campaign);
  EXPECT_EQ(ObservationsToFit(std::make_shared<const Campaign>(), nullptr, {}, {}), nullptr);
  const ObservationsToFit all(shared, nullptr, {}, {});
  EXPECT_EQ(all.get(), shared->observations.get());
  const Observation& o = campaign.observations->rows[1];
  const std::string item = o.state + "/" + o.point + "/" + std::string(toString(o.component));
  const ObservationsToFit marked(shared, nullptr, {{item, "disturbed"}}, {});
  const ObservationsToFit given_on = marked;
  EXPECT_EQ(given_on, marked);
  EXPECT_FALSE(marked == all);
  EXPECT_EQ(given_on->rows[1].use, ObservationUse::Exclude);
  EXPECT_EQ(given_on.get(), marked.get());
  EXPECT_EQ(campaign.observations->rows[1].use, ObservationUse::Fit);
}

TEST(CampaignState, EvaluationsOfEarlierVersionsHoldCovariancesOfPairs) {
  StoredResult stored;
  stored.payload = payloadOf(evaluation());
  stored.payload.erase("shared_noise");
  stored.payload["covariance"] = {{0, 2, 0.1}, {1, 3, -0.05}};
  const ObservationSet set = evaluationFrom(stored).observations;
  EXPECT_NEAR(set.shared.covariance(0, 2), 0.1, 1e-15);
  EXPECT_NEAR(set.shared.covariance(1, 3), -0.05, 1e-15);
  EXPECT_EQ(set.shared.covariance(0, 1), 0.0);
  EXPECT_EQ(set.rows[0].sigma, 0.5);
}

TEST(CampaignState, NoiseOfRowsThatAreNotThereIsRefused) {
  const auto sentence = [](const char* key, const nlohmann::json& value) -> std::string {
    StoredResult stored;
    stored.payload = payloadOf(evaluation());
    stored.payload.erase("shared_noise");
    stored.payload[key] = value;
    try {
      (void)evaluationFrom(stored);
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  };
  using nlohmann::json;
  EXPECT_EQ(sentence("shared_noise", json::parse("[[[3, 0.1]]]")), "taken");
  EXPECT_EQ(sentence("shared_noise", json::parse("[[[4, 0.1]]]")),
            "stored observations, $.shared_noise: 4 is not allowed; allowed: a row from 0 to 3.");
  EXPECT_EQ(sentence("shared_noise", json::parse("[[[1000000000000, 0.1]]]")),
            "stored observations, $.shared_noise: 1000000000000 is not allowed; allowed: a row from 0 to 3.");
  EXPECT_EQ(sentence("shared_noise", json::parse("[[[-1, 0.1]]]")),
            "stored observations, $.shared_noise: -1 is not allowed; allowed: a row from 0 to 3.");
  EXPECT_EQ(sentence("shared_noise", json::parse("[[[0]]]")),
            "stored observations, $.shared_noise: [0] is not allowed; allowed: a list of at least 2 entries.");
  EXPECT_EQ(sentence("shared_noise", json::parse("[[[0, null]]]")),
            "stored observations, $.shared_noise: null is not allowed; allowed: a finite number.");
  EXPECT_EQ(sentence("shared_noise", "all"),
            "stored observations, $.shared_noise: \"all\" is not allowed; allowed: a list.");
  EXPECT_EQ(sentence("covariance", json::parse("[[0, 4, 0.1]]")),
            "stored observations, $.covariance: 4 is not allowed; allowed: a row from 0 to 3.");
}

}  // namespace
}  // namespace spindrift
