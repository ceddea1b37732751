// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/fe_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/base/inside_folder.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

FeNodes parseNodes(const JsonNode& node) {
  FeNodes out;
  int given = 0;
  if (const auto set = node.find("set")) {
    out.set = setName(set->name());
    ++given;
  }
  if (const auto nodes = node.find("nodes")) {
    for (const JsonNode& item : nodes->items()) {
      const int id = item.integer();
      if (id < 0) item.reject("the number of a node");
      out.nodes.push_back(id);
    }
    if (out.nodes.empty()) nodes->reject("a list with at least one node");
    ++given;
  }
  if (const auto place = node.find("nearest_to_mm")) {
    out.nearest_to_mm = place->vector3();
    if (const auto count = node.find("count")) {
      out.count = count->integer();
      if (out.count < 1) count->reject("at least 1");
    }
    ++given;
  }
  if (given != 1) node.reject("exactly one of \"set\", \"nodes\" and \"nearest_to_mm\"");
  if (const auto at = node.find("at_mm")) out.at_mm = at->vector3();
  return out;
}

RigidTransform parseTransform(const JsonNode& node) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  const std::vector<JsonNode> rows = node.items();
  if (rows.size() != 4) node.reject("four rows of four numbers");
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<double> row = rows[i].numbers();
    if (row.size() != 4) rows[i].reject("four numbers");
    for (std::size_t j = 0; j < 4; ++j) matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = row[j];
  }
  const Eigen::Matrix3d r = matrix.topLeftCorner<3, 3>();
  if ((r * r.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-6 || r.determinant() < 0.0) {
    node.reject("a proper rotation in the first three rows and columns, and mm in the last column");
  }
  return RigidTransform::fromMatrix(matrix);
}

Eigen::Vector3d placeOf(const std::vector<std::string>& fields, std::string_view text) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  bool whole = fields.size() >= 3;
  for (std::size_t i = 0; whole && i < 3; ++i) whole = parseNumber(fields[i], place[static_cast<Eigen::Index>(i)]);
  if (!whole) throw InputError(fmt::format("\"{}\" names no place; allowed: near:x,y,z in mm.", text));
  return place;
}

}  // namespace

FeNodes FeNodes::parse(std::string_view text) {
  FeNodes out;
  if (text.starts_with("nodes:")) {
    for (const std::string& field : splitList(text.substr(6))) {
      double id = 0.0;
      if (!parseNumber(field, id) || id < 0.0 || id > largest_node) {
        throw InputError(
            fmt::format("\"{}\" in \"{}\" is not the number of a node; allowed: nodes:1,2,3.", field, text));
      }
      out.nodes.push_back(static_cast<NodeId>(id));
    }
    if (out.nodes.empty()) throw InputError(fmt::format("\"{}\" names no node; allowed: nodes:1,2,3.", text));
    return out;
  }
  if (text.starts_with("near:")) {
    const std::vector<std::string> fields = splitList(text.substr(5));
    out.nearest_to_mm = placeOf(fields, text);
    if (fields.size() > 3) {
      double count = 0.0;
      if (!parseNumber(fields[3], count) || count < 1.0 || count > 1e9) {
        throw InputError(
            fmt::format("\"{}\" in \"{}\" is not a number of nodes; allowed: at least 1.", fields[3], text));
      }
      out.count = static_cast<int>(count);
    }
    return out;
  }
  if (text.starts_with("set:")) text.remove_prefix(4);
  out.set = setName(text);
  if (out.set.empty()) {
    throw InputError("no nodes are named; allowed: the name of a set, nodes:1,2,3 or near:x,y,z[,count].");
  }
  return out;
}

FeMap FeMap::read(const std::filesystem::path& file) {
  const JsonNode root = JsonNode::read(file);
  root.requireFormat(fe_map_format, 1);
  FeMap map;
  map.file = file;
  InsideFolder inside(file.parent_path());
  const auto path = [&](std::string_view key) -> std::filesystem::path {
    const auto node = root.find(key);
    return node ? inside.path(node->name(), node->place()) : std::filesystem::path();
  };
  map.result = path("result");
  map.mesh = path("mesh");
  map.observe = path("observe");
  if (const auto unit = root.find("unit_of_displacement")) map.unit_of_displacement = unit->oneOf({"mm", "m"});
  if (const auto unit = root.find("unit_of_length")) map.unit_of_length = unit->oneOf({"mm", "m"});
  if (const auto first = root.find("first_state_s")) map.first_state_s = first->number();
  if (const auto interval = root.find("state_interval_s")) map.state_interval_s = interval->positiveNumber();
  if (const auto transform = root.find("mcf_from_mesh")) map.mcf_from_mesh = parseTransform(*transform);
  map.displacement_array = root.stringOr("displacement", "");
  if (const auto components = root.find("components")) {
    map.components.clear();
    for (const JsonNode& item : components->items()) {
      const std::string name = item.oneOf({"EX", "EY", "EZ", "EA", "EB", "EC"});
      map.components.push_back(*componentFromString(name));
    }
    if (map.components.empty()) components->reject("a list with at least one of EX, EY, EZ, EA, EB, EC");
  }
  std::set<std::string> ids;
  if (const auto points = root.find("points")) {
    for (const JsonNode& item : points->items()) {
      FePoint point;
      point.point = item.at("point").name();
      if (!ids.insert(point.point).second) item.at("point").reject("each point once");
      point.tool = parseNodes(item.at("tool"));
      point.table = parseNodes(item.at("table"));
      map.points.push_back(std::move(point));
    }
  }
  if (const auto each = root.find("each_table_node")) {
    map.each_table_node = FePoint{"", parseNodes(each->at("tool")), parseNodes(each->at("table"))};
  }
  return map;
}

void FeMap::validate() const {
  const std::string place = file.empty() ? "" : "$";
  const auto refuse = [&](const std::string& sentence) { throw InputError({file, place}, sentence); };
  if (unit_of_displacement.empty()) {
    refuse(file.empty()
               ? "the unit of the displacements is not stated; add --unit mm or --unit m."
               : "the unit of the displacements is not stated; add \"unit_of_displacement\": \"mm\" or \"m\".");
  }
  for (const std::string& unit : {unit_of_displacement, unit_of_length}) {
    if (!unit.empty() && unit != "mm" && unit != "m") {
      refuse(fmt::format("unit \"{}\" is not known; allowed: mm or m.", unit));
    }
  }
  const int kinds = static_cast<int>(!points.empty()) + static_cast<int>(each_table_node.has_value()) +
                    static_cast<int>(!observe.empty());
  if (kinds != 1) {
    refuse(file.empty() ? "which nodes are tool and table is not said once; allowed: --tool and --table, or --observe, "
                          "or --map."
                        : "which nodes are tool and table is not said once; allowed: one of \"points\", "
                          "\"each_table_node\" and \"observe\".");
  }
  if (each_table_node && std::any_of(components.begin(), components.end(), [](Component c) { return isRotation(c); })) {
    refuse("the rotation of a single table node is not known; allowed with each_table_node: EX, EY and EZ.");
  }
}

}  // namespace spindrift
