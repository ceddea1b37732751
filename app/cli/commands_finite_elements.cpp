// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/commands_finite_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/finite_elements/fe_deviation.h"

namespace spindrift::cli {
namespace {

struct MapArguments {
  std::string result;
  std::string map;
  std::string out;
  std::string unit;
  std::string length_unit;
  std::string mesh;
  std::string observe;
  std::string array;
  std::vector<std::string> tools;
  std::vector<std::string> tables;
  std::string components;
  double first_s = 0.0;
  double interval_s = 0.0;
  bool has_first = false;
  bool each_table_node = false;
};

/// "P1=TOP" -> P1, TOP; without a point: empty, TOP.
std::pair<std::string, std::string> pointAndNodes(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return {"", text};
  return {std::string(trimmed(text.substr(0, equals))), text.substr(equals + 1)};
}

void takeNodes(const MapArguments& arguments, FeMap& map) {
  if (arguments.tools.empty() && arguments.tables.empty()) return;
  if (arguments.tools.empty() || arguments.tables.empty()) {
    throw InputError("only one of tool and table is named; allowed: --tool and --table.");
  }
  map.points.clear();
  map.each_table_node.reset();
  if (arguments.each_table_node) {
    if (arguments.tools.size() != 1 || arguments.tables.size() != 1) {
      throw InputError(
          "several tools or tables are named; allowed with --each-table-node: one --tool and one --table.");
    }
    map.each_table_node = FePoint{"", FeNodes::parse(pointAndNodes(arguments.tools[0]).second),
                                  FeNodes::parse(pointAndNodes(arguments.tables[0]).second)};
    return;
  }
  const auto find = [](const std::vector<std::string>& list, const std::string& point) -> std::string {
    std::string common;
    for (const std::string& item : list) {
      const auto [id, nodes] = pointAndNodes(item);
      if (id == point) return nodes;
      if (id.empty()) common = nodes;
    }
    return common;
  };
  std::vector<std::string> points;
  for (const std::vector<std::string>* list : {&arguments.tools, &arguments.tables}) {
    for (const std::string& item : *list) {
      const std::string id = pointAndNodes(item).first;
      if (!id.empty() && std::find(points.begin(), points.end(), id) == points.end()) points.push_back(id);
    }
  }
  if (points.empty()) {
    throw InputError("it is not said which point the tool stands at; allowed: --tool P1=NODES, or --each-table-node.");
  }
  for (const std::string& point : points) {
    const std::string tool = find(arguments.tools, point);
    const std::string table = find(arguments.tables, point);
    if (tool.empty() || table.empty()) {
      throw InputError(fmt::format("point {} has no {}; allowed: --{} {}=NODES, or --{} NODES for all points.", point,
                                   tool.empty() ? "tool" : "table", tool.empty() ? "tool" : "table", point,
                                   tool.empty() ? "tool" : "table"));
    }
    map.points.push_back({point, FeNodes::parse(tool), FeNodes::parse(table)});
  }
}

FeMap mapOf(const MapArguments& arguments) {
  FeMap map;
  if (!arguments.map.empty()) map = FeMap::read(arguments.map);
  if (!arguments.result.empty()) map.result = arguments.result;
  if (!arguments.unit.empty()) map.unit_of_displacement = arguments.unit;
  if (!arguments.length_unit.empty()) map.unit_of_length = arguments.length_unit;
  if (!arguments.mesh.empty()) map.mesh = arguments.mesh;
  if (!arguments.array.empty()) map.displacement_array = arguments.array;
  if (!arguments.observe.empty()) {
    map.observe = arguments.observe;
    map.points.clear();
    map.each_table_node.reset();
  }
  if (arguments.has_first) map.first_state_s = arguments.first_s;
  if (arguments.interval_s > 0.0) map.state_interval_s = arguments.interval_s;
  if (!arguments.components.empty()) {
    map.components.clear();
    for (const std::string& name : splitList(arguments.components)) {
      const auto component = componentFromString(name);
      if (!component) {
        throw InputError(fmt::format("component \"{}\" is not known; allowed: EX, EY, EZ, EA, EB or EC.", name));
      }
      map.components.push_back(*component);
    }
  }
  if (!arguments.tools.empty() || !arguments.tables.empty()) {
    if (!arguments.observe.empty())
      throw InputError("--observe and --tool or --table are given; allowed: one of them.");
    map.observe.clear();
  }
  takeNodes(arguments, map);
  return map;
}

CommandResult import(const MapArguments& arguments, const ReaderOfMap& open, JobContext& job) {
  const FeMap map = mapOf(arguments);
  const FeDeviation fe = feDeviation(
      map, [&](const std::filesystem::path& file) { return open(file, map); }, job);
  writeFileAtomically(arguments.out, simulationCsv(fe.rows, fe.by_place));
  CommandResult result;
  result.json = {{"simulation", arguments.out},
                 {"result", map.result.string()},
                 {"rows", fe.rows.size()},
                 {"states", fe.states},
                 {"nodes", fe.nodes},
                 {"first_s", jsonNumber(fe.first_s)},
                 {"last_s", jsonNumber(fe.last_s)},
                 {"largest_displacement_um", jsonNumber(fe.largest_displacement_um)},
                 {"largest_deviation", jsonNumber(fe.largest_deviation)},
                 {"plausible", fe.plausible}};
  result.summary = fmt::format(
      "{}: {} rows of {} states ({:g} s to {:g} s) from {} nodes; largest displacement {:.4g} µm, largest deviation of "
      "the "
      "tool relative to the table {:.4g} µm or µrad",
      arguments.out, fe.rows.size(), fe.states, printed(fe.first_s), printed(fe.last_s), fe.nodes,
      printed(fe.largest_displacement_um), printed(fe.largest_deviation));
  if (!fe.plausible) {
    result.exit_status = NotGoodEnough;
    result.warnings = fe.notes;
  }
  return noted(std::move(result), fe.notes);
}

}  // namespace

void addFiniteElementCommands(CLI::App& app, CommandLine& line, const ReaderOfMap& open) {
  CLI::App* group = app.add_subcommand("simulation", "Results of other simulation programs");
  group->require_subcommand(1);
  auto arguments = std::make_shared<MapArguments>();
  CLI::App* command =
      addCommand(*group, line, "import",
                 "Write simulation.csv from displacements of finite elements: tool minus table, in machine coordinates",
                 [arguments, open](JobContext& job) { return import(*arguments, open, job); });
  command->add_option("RESULT", arguments->result,
                      "CalculiX .frd (ASCII) or .dat, VTK .vtu or .pvd (read by the program spindrift-fe); may be "
                      "named in the map");
  command->add_option("--out", arguments->out, "simulation.csv to write")->required()->type_name("FILE");
  command
      ->add_option("--map", arguments->map,
                   "fe.json: unit, nodes of tool and table, times, frame; options take precedence")
      ->type_name("FILE");
  command->add_option("--unit", arguments->unit, "Unit of the displacements, mm or m")->type_name("UNIT");
  command->add_option("--unit-of-length", arguments->length_unit, "Unit of the coordinates, if different")
      ->type_name("UNIT");
  command->add_option("--mesh", arguments->mesh, "Mesh with node sets (.inp of CalculiX or Abaqus)")->type_name("FILE");
  command
      ->add_option(
          "--tool", arguments->tools,
          "Nodes of the tool at a point, P1=NODES (repeatable); NODES: a set, nodes:1,2,3 or near:x,y,z[,count]")
      ->type_name("[POINT=]NODES");
  command->add_option("--table", arguments->tables, "Nodes of the table, for all points or P1=NODES (repeatable)")
      ->type_name("[POINT=]NODES");
  command->add_flag("--each-table-node", arguments->each_table_node,
                    "Tool minus every node of the table, by place (x_mm,y_mm,z_mm in place of point)");
  command->add_option("--observe", arguments->observe, "Weights of nodes (point,component,node,dof,weight)")
      ->type_name("FILE");
  command->add_option("--components", arguments->components, "Of EX,EY,EZ,EA,EB,EC; the first three if not given")
      ->type_name("LIST");
  command->add_option("--first", arguments->first_s, "Time of the undeformed state in s")
      ->type_name("S")
      ->each([arguments](const std::string&) { arguments->has_first = true; });
  command
      ->add_option("--interval", arguments->interval_s,
                   "Time between states in s, the first one interval after --first; default: the times in the result")
      ->type_name("S")
      ->check(positiveNumber());
  command->add_option("--displacement", arguments->array, "Name of the array of displacements in a VTK file")
      ->type_name("NAME");
}

}  // namespace spindrift::cli
