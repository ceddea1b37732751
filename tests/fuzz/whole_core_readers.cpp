// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/connect/connections.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/own_effects.h"
#include "core/machine/machine_description.h"
#include "core/plant/publish.h"
#include "core/probing/cycle_studies.h"
#include "core/session/session.h"
#include "core/simulation/scenario.h"
#include "core/tasks/campaign_state.h"
#include "core/workflows/clock_offsets.h"
#include "core/workflows/closed_loop.h"
#include "core/workflows/discrepancy_story.h"
#include "core/workflows/exercise.h"
#include "core/workflows/incoming.h"
#include "core/workflows/loop_models.h"
#include "core/workflows/loop_state.h"
#include "core/workflows/measurement_plan.h"
#include "core/workflows/simulation_story.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

void errorModel(std::string_view bytes) {
  static const MachineDescription machine =
      MachineDescription::parse(JsonNode::parse(smallMachine(), "machine.json"), "machine.json");
  (void)EffectModel::read(scratchFile("model/model.json", bytes), machine, nullptr, {"F1", "F2"});
}

void scenario(std::string_view bytes) {
  (void)Scenario::parse(JsonNode::parse(bytes, "scenario.json"), "scenario.json");
}

void effects(std::string_view bytes) {
  (void)OwnEffects::parse(bytes, "effects.json");
}

void plan(std::string_view bytes) {
  const MeasurementPlan read = MeasurementPlan::parse(JsonNode::parse(bytes, "plan.json"));
  (void)MeasurementPlan::parse(JsonNode::parse(read.json().dump(), "back.json"));
}

/// What a session remembers of arrivals.
void journal(std::string_view bytes) {
  static Session session = [] {
    const std::filesystem::path made = scratchFile("journal/new", "").parent_path() / "session";
    std::filesystem::remove_all(made);
    Session fresh = Session::create(made);
    (void)fresh.newCampaign("cell", "2026-01-31T08:00:00Z",
                            R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
                               "axes":[{"name":"X","travel_mm":[0,300]}]})");
    return fresh;
  }();
  session.setArrival(1, "a.png", JsonNode::parse(bytes, "journal.json").value());
  for (const IncomingItem& item : incomingJournal(session, 1)) (void)item.json();
}

void connections(std::string_view bytes) {
  const Connections read = Connections::parse(JsonNode::parse(bytes, "connections.json"));
  for (std::size_t i = 0; i < read.sources.size(); ++i) (void)read.itemsOf(static_cast<std::uint32_t>(i));
}

/// A plan without a simulation beside the machine of all readers.
LoopPlan loopPlanOf(std::string_view bytes) {
  (void)scratchFile("loop/machine.json", smallMachine());
  return LoopPlan::parse(JsonNode::parse(bytes, "plan.json"), scratchFile("loop/plan.json", ""));
}

void loopPlan(std::string_view bytes) {
  const LoopPlan read = loopPlanOf(bytes);
  const std::string program = measuringProgram(read);
  SPINDRIFT_ASSERT(std::count(program.begin(), program.end(), '\n') == static_cast<long>(6 + 7 * read.touches.size()),
                   "no name adds a block");
}

/// What a loop goes on with after its program has ended.
void loopState(std::string_view bytes) {
  static const LoopPlan plan = loopPlanOf(R"({"format":"spindrift-loop-plan","version":1,"machine":"machine.json",
"control":{"kind":"linuxcnc","folder":"control"},"temperatures":["T_column_degC"],"touches":[{"point":"F1",
"component":"EZ","before_mm":[1,2,5],"target_mm":[1,2,2]}],"programme":[{"from_s":0,"spindle_rpm":1000}],
"reference_mm":[1,2,3],"safe_z_mm":50,"duration_s":3600})");
  const LoopState state = LoopState::read(scratchFile("loop/loop-state.json", bytes), plan);
  LoopModels models(plan, [](const std::string&) {});
  const std::filesystem::path log =
      scratchFile("loop/log.csv", "time_s,spindle_rpm,T_column_degC\n0,0,20\n60,1000,21\n");
  models.restore(JsonNode::parse(state.models.dump(), "loop-state.json"), log, log.parent_path(), state.time_s);
}

void exercise(std::string_view bytes) {
  (void)Exercise::of(scratchFile("exercise/exercise.json", bytes).parent_path());
}

/// Of five cycles, one every ten minutes.
void referenceRecord(std::string_view bytes) {
  static const CycleEvaluation evaluation = [] {
    CycleEvaluation made;
    made.names = {"EXX_um_per_m"};
    for (int k = 0; k < 5; ++k) {
      made.cycle_time_s.push_back(600.0 * k);
      made.parameters.push_back({CycleParameter{3.0 * k, 0.5}});
    }
    return made;
  }();
  (void)compareWithReference(evaluation, "EXX_um_per_m", scratchFile("reference.csv", bytes));
}

// --- what a session keeps of results

StoredResult storedResult(const char* kind, std::string_view bytes) {
  StoredResult result;
  result.kind = kind;
  result.payload = JsonNode::parse(bytes, "payload").value();
  return result;
}

void storedEvaluation(std::string_view bytes) {
  const StoredResult result = storedResult("evaluate", bytes);
  (void)plantResult(result);
  (void)evaluationFrom(result);
}

void storedDiscrepancy(std::string_view bytes) {
  const StoredResult result = storedResult("discrepancy", bytes);
  (void)plantResult(result);
  const DiscrepancyStory story = DiscrepancyStory::parse(result.payload);
  (void)story.reportData();
  (void)DiscrepancyStory::parse(story.json());
}

void storedSimulation(std::string_view bytes) {
  const SimulationStory story = SimulationStory::parse(storedResult("simulation", bytes).payload);
  (void)SimulationStory::parse(story.json());
}

void storedClocks(std::string_view bytes) {
  (void)clockOffsetsFrom(storedResult("", bytes).payload);
}

/// What another plant's queue brings.
void plantCampaign(std::string_view bytes) {
  (void)PlantCampaign::parse(storedResult("", bytes).payload, "campaign.json");
}

constexpr Reader readers[] = {{"error_model", errorModel},
                              {"scenario", scenario},
                              {"effects", effects},
                              {"plan", plan},
                              {"journal", journal},
                              {"connections", connections},
                              {"loop_plan", loopPlan},
                              {"loop_state", loopState},
                              {"exercise", exercise},
                              {"reference_record", referenceRecord},
                              {"stored_evaluation", storedEvaluation},
                              {"stored_discrepancy", storedDiscrepancy},
                              {"stored_simulation", storedSimulation},
                              {"stored_clocks", storedClocks},
                              {"plant_campaign", plantCampaign}};

}  // namespace

std::span<const Reader> wholeCoreReaders() {
  return readers;
}

}  // namespace spindrift::testing
