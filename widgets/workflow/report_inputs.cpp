// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/workflow/report_inputs.h"

#include "widgets/models/session_model.h"
#include "widgets/workflow/simulator_choice.h"

namespace spindrift::gui {

nlohmann::json reportedInputs(const SessionModel& session) {
  nlohmann::json results = nlohmann::json::array();
  for (const char* kind :
       {"check-jogs", "check-repeatability", "thermal", "compensation", "log-compensation", "verify"}) {
    const StoredResult* result = session.latest(kind);
    results.push_back(result == nullptr ? 0 : result->id);
  }
  // What was put into the simulation belongs to the simulator at hand.
  const StoredResult* simulation = session.latest(simulation_result);
  results.push_back(simulation == nullptr ? nlohmann::json(0)
                                          : nlohmann::json{simulation->id, currentSimulator(session)});
  return {{"warm", session.warmStatement().value_or(nlohmann::json())},
          {"fit", session.campaignSetting("nine-parameter", nlohmann::json::object())},
          {"results", results}};
}

}  // namespace spindrift::gui
