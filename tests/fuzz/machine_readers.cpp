// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "core/base/csv.h"
#include "core/base/json_reader.h"
#include "core/machine/campaign.h"
#include "core/machine/machine_description.h"
#include "core/machine/observation.h"
#include "core/machine/operating_log.h"
#include "core/machine/simulation_table.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

void csv(std::string_view bytes) {
  const CsvTable table = CsvTable::parse(std::string(bytes), "table.csv");
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    for (std::size_t column = 0; column < table.columnNames().size(); ++column) {
      // What is written is read back, with blanks for what breaks a line.
      std::string text(table.text(row, column));
      std::replace(text.begin(), text.end(), '\r', ' ');
      const std::string again = csvField(text);
      const CsvTable back = CsvTable::parse("a,b\n" + again + ",1\n", "back.csv");
      SPINDRIFT_ASSERT(back.rowCount() == 1 && back.text(0, 0) == text, "a field is read back");
    }
  }
  if (table.rowCount() > 0) (void)table.number(0, 0);
}

void walk(const JsonNode& node) {
  if (node.value().is_object()) {
    for (const auto& [key, member] : node.members()) walk(member);
  } else if (node.value().is_array()) {
    for (const JsonNode& item : node.items()) walk(item);
  } else if (node.value().is_number()) {
    (void)node.number();
  }
}

void json(std::string_view bytes) {
  const JsonNode root = JsonNode::parse(bytes, "document.json");
  walk(root);
  if (!root.value().is_object()) root.reject("an object");
}

void campaign(std::string_view bytes) {
  (void)scratchFile("campaign/machine.json", smallMachine());
  const Campaign read = Campaign::read(scratchFile("campaign/campaign.json", bytes).parent_path());
  for (const std::string& file : {read.simulation, read.effects.string(), read.simulator.string()}) {
    if (!file.empty()) (void)read.path(file);
  }
}

void machine(std::string_view bytes) {
  const MachineDescription read = MachineDescription::parse(JsonNode::parse(bytes, "machine.json"), "machine.json");
  (void)read.findPoint("F1");
}

void log(std::string_view bytes) {
  const OperatingLog read = OperatingLog::read(scratchFile("log.csv", bytes));
  for (const std::string& name : read.names()) (void)read.at(name, read.time_s().front() + 1.0);
}

void observations(std::string_view bytes) {
  const ObservationSet read = ObservationSet::parse(std::string(bytes), "observations.csv");
  // What is written is read back.
  const ObservationSet back = ObservationSet::parse(read.csv(), "back.csv");
  SPINDRIFT_ASSERT(back.rows.size() == read.rows.size(), "every row is written");
}

void covariance(std::string_view bytes) {
  const std::filesystem::path file = scratchFile("covariance/observations.csv",
                                                 "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,"
                                                 "instrument,use\n0,M0,F1,1,2,3,0,EX,0,1,microscope,fit\n"
                                                 "60,M1,F1,1,2,3,0,EX,5,1,microscope,fit\n");
  (void)scratchFile("covariance/observations.cov.csv", bytes);
  (void)ObservationSet::read(file);
}

void simulation(std::string_view bytes) {
  const SimulationTable table = SimulationTable::read(scratchFile("simulation.csv", bytes));
  const double middle_s = 0.5 * (table.firstTime_s() + table.lastTime_s());
  for (const Component component : all_components) {
    (void)table.at(middle_s, "F1", {1.0, 2.0, 3.0}, component);
  }
}

constexpr Reader readers[] = {{"csv", csv},
                              {"json", json},
                              {"campaign", campaign},
                              {"machine", machine},
                              {"log", log},
                              {"observations", observations},
                              {"covariance", covariance},
                              {"simulation", simulation}};

}  // namespace

std::span<const Reader> machineReaders() {
  return readers;
}

}  // namespace spindrift::testing
