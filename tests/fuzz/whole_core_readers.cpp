// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/json_reader.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/own_effects.h"
#include "core/machine/machine_description.h"
#include "core/session/session.h"
#include "core/simulation/scenario.h"
#include "core/workflows/incoming.h"
#include "core/workflows/measurement_plan.h"
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

constexpr Reader readers[] = {
    {"error_model", errorModel}, {"scenario", scenario}, {"effects", effects}, {"plan", plan}, {"journal", journal}};

}  // namespace

std::span<const Reader> wholeCoreReaders() {
  return readers;
}

}  // namespace spindrift::testing
