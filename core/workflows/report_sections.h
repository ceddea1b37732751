// SPDX-License-Identifier: Apache-2.0
// Parts of a campaign report beside what core/reporting writes: plan, captures with thumbnails, state of the
// instrument, models over time, ISO 230-3 parameters, compensation and its verification. Each takes what a page or a
// command worked out and computes nothing that is not said here. Units as in FORMATS.md.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/reporting/report.h"
#include "core/workflows/measurement_plan.h"
#include "core/workflows/thermal_tests.h"

namespace spindrift {

/// Results that a session keeps of a campaign, as their workflows wrote them; null where there is none. A command
/// without a session leaves them null.
struct StoredResults {
  nlohmann::json plan;            ///< MeasurementPlan::json
  nlohmann::json warm_up;         ///< CheckResult::json
  nlohmann::json warm_statement;  ///< {"settled":true,"by":"operator"}
  nlohmann::json jogs;            ///< {"passed","reason"}
  nlohmann::json repeatability;   ///< {"passed","reason"}
  nlohmann::json fit;             ///< of touches (cyclesJson) or scans: told in place of the one under usual options
  nlohmann::json thermal;         ///< IdentifyResult::json
  nlohmann::json standard_test;   ///< StandardTest::json
  nlohmann::json compensation;    ///< CompensationPlan::json
  /// CompensateResult::json: the control's compensator run over the log.
  nlohmann::json log_compensation;
  nlohmann::json verification;  ///< VerifyResult::json
  nlohmann::json simulation;    ///< SimulationStory::json: what was put into the simulation itself
  /// What has changed since a result was made, by its kind in the session ("thermal", "check-jogs"): "1 exclusion more,
  /// the options". Those that hold are not in it.
  std::map<std::string, std::string> changed;
};

/// Says that what is told of a stored result does not hold any more; nothing where it does.
void addOutdated(Report& document, const StoredResults& stored, const std::string& kind);

/// States with what was to be captured and what was. Nothing without a plan.
void addPlan(Report& document, const nlohmann::json& plan, const Campaign& campaign);

/// Numbers of captures per state, and a sheet of thumbnails: the first image of every fiducial and state, and every
/// artefact's first scan seen from above; 24 pictures at most, spread over the states. Nothing without captures.
void addCaptures(Report& document, const Campaign& campaign, const JobContext& job);

/// Warm-up, jogs, cold repeatability; where there are observations it is said what it means if nobody knows whether the
/// instrument was warm.
void addInstrumentState(Report& document, const StoredResults& stored, bool has_observations);

/// The model over time: inputs, quality in free run, time constants. Nothing without a model.
void addThermalModel(Report& document, const StoredResults& stored);

/// A test of ISO 230-3 (StandardTest::json) and its readings over time. Nothing where there are no parameters.
void addStandardTest(Report& document, const nlohmann::json& test, const Drawing& diagram, const StoredResults& stored);

/// What a control would be commanded, and what is expected to remain.
void addCompensation(Report& document, const StoredResults& stored);

/// What the control's compensator would have achieved over the log. Nothing without such a run.
void addLogCompensation(Report& document, const StoredResults& stored);

/// Before and after, judged against the goal.
void addVerification(Report& document, const StoredResults& stored);

}  // namespace spindrift
