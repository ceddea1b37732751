// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/simulator_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <set>
#include <system_error>

#include "core/base/atomic_file.h"
#include "core/base/inside_folder.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool isParameterName(std::string_view name) {
  if (name.empty() || !isLetter(name.front()) || name.back() == '.') return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '.'; });
}

SimulatorParameter parameterAt(const JsonNode& node) {
  SimulatorParameter p;
  const JsonNode name = node.at("name");
  p.name = name.name();
  if (!isParameterName(p.name) || p.name.starts_with("sensor.") || p.name.starts_with("simulation.")) {
    name.reject("a letter and then letters, digits, _ and ., not beginning with \"sensor.\" or \"simulation.\"");
  }
  p.min = node.at("min").number();
  p.max = node.at("max").number();
  if (p.min > p.max) node.at("min").reject(fmt::format("a number up to \"max\", which is {}", exactNumber(p.max)));
  const JsonNode value = node.at("value");
  p.value = value.number();
  if (p.value < p.min || p.value > p.max) {
    value.reject(
        fmt::format("a number from \"min\" {} to \"max\" {} of {}", exactNumber(p.min), exactNumber(p.max), p.name));
  }
  p.standard_uncertainty = node.at("standard_uncertainty").nonNegativeNumber();
  p.unit = node.stringOr("unit", "");
  p.what = node.stringOr("what", p.name);
  if (const auto effects = node.find("effects")) {
    std::set<std::string> once;
    for (const JsonNode& item : effects->items()) {
      p.effects.push_back(item.name());
      if (!once.insert(p.effects.back()).second) item.reject("each effect once");
    }
  }
  return p;
}

SimulatorKind kindAt(const JsonNode& node) {
  const std::string word = node.oneOf({"scenario", "command", "calculix", "sensitivities"});
  return word == "scenario"   ? SimulatorKind::Scenario
         : word == "command"  ? SimulatorKind::Command
         : word == "calculix" ? SimulatorKind::Calculix
                              : SimulatorKind::Sensitivities;
}

/// The first folder on the way to `folder` that is not there; empty if all are.
fs::path firstMissing(const fs::path& folder) {
  fs::path missing;
  std::error_code ignored;
  for (fs::path at = fs::absolute(folder); !fs::exists(at, ignored) && at.has_relative_path(); at = at.parent_path()) {
    missing = at;
  }
  return missing;
}

}  // namespace

fs::path SimulatorFile::folder() const {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

std::string pathWithin(const JsonNode& node) {
  const std::string text = node.name();
  const fs::path path(text);
  const bool leaves =
      path.is_absolute() || std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  if (leaves || path.filename().empty() || path.filename() == ".") {
    node.reject("a path within the folder of the simulator, relative to it and without \"..\"");
  }
  return path.lexically_normal().generic_string();
}

std::string SimulatorFile::relativeFile(const JsonNode& node) const {
  std::string relative = pathWithin(node);
  std::error_code ignored;
  if (!fs::is_regular_file(InsideFolder(folder()).path(relative, node.place()), ignored)) {
    node.reject(fmt::format("a file in {}", fs::absolute(folder()).lexically_normal().string()));
  }
  return relative;
}

SimulatorFile openSimulatorFile(const fs::path& file) {
  std::string text = readFile(file);
  JsonNode root = JsonNode::parse(text, file);
  root.requireFormat("spindrift-simulator", 1);
  const SimulatorKind kind = kindAt(root.at("kind"));
  if (const auto history = root.find("history")) (void)history->items();
  SimulatorFile out{file, std::move(text), root, kind, {}};
  std::set<std::string> names;
  for (const JsonNode& item : root.at("parameters").items()) {
    out.parameters.push_back(parameterAt(item));
    if (!names.insert(out.parameters.back().name).second) item.at("name").reject("each parameter once");
  }
  return out;
}

ParameterValues completeValues(const Simulator& simulator, const ParameterValues& given) {
  ParameterValues out;
  for (const SimulatorParameter& p : simulator.parameters()) out[p.name] = p.value;
  for (const auto& [name, value] : given) {
    const SimulatorParameter* p = simulator.find(name);
    if (p == nullptr) {
      std::vector<std::string> names;
      for (const SimulatorParameter& one : simulator.parameters()) names.push_back(one.name);
      throw InputError({simulator.file(), ""},
                       fmt::format("has no parameter \"{}\"; allowed: {}.", name, joinedList(names, "or")));
    }
    if (!(value >= p->min && value <= p->max)) {
      throw InputError({simulator.file(), ""},
                       fmt::format("parameter {} cannot be {}; allowed: {} to {}{}{}.", p->name, exactNumber(value),
                                   exactNumber(p->min), exactNumber(p->max), p->unit.empty() ? "" : " ", p->unit));
    }
    out[p->name] = value;
  }
  return out;
}

std::string valuesText(const ParameterValues& given) {
  if (given.empty()) return "its own values";
  std::vector<std::string> parts;
  for (const auto& [name, value] : given) parts.push_back(fmt::format("{} = {:.6g}", name, value));
  return shortenedList(parts);
}

std::string placesOf(const ObservationSet& at) {
  std::string text;
  for (const Observation& o : at.rows) {
    text += fmt::format("{} {} {} {} {} {}", o.time_s, o.point, o.position_mm.x(), o.position_mm.y(), o.position_mm.z(),
                        o.c_deg);
    text += fmt::format(" {} {} {} {} {} {} {}\n", toString(o.component), o.approach.x(), o.approach.y(),
                        o.approach.z(), o.tool_offset_mm.x(), o.tool_offset_mm.y(), o.tool_offset_mm.z());
  }
  return text;
}

std::vector<JsonEdit> valueEdits(const SimulatorFile& file, const ParameterValues& values) {
  std::vector<JsonEdit> edits;
  for (std::size_t i = 0; i < file.parameters.size(); ++i) {
    const auto found = values.find(file.parameters[i].name);
    if (found == values.end() || found->second == file.parameters[i].value) continue;
    edits.push_back({{"parameters", fmt::format("{}", i), "value"}, found->second});
  }
  return edits;
}

void copyWithin(const fs::path& from, const fs::path& to, const std::string& relative) {
  std::error_code error;
  if (const fs::path target = (to / relative).parent_path(); !target.empty()) fs::create_directories(target, error);
  if (!error) fs::copy_file(from / relative, to / relative, error);
  if (error) {
    throw InputError({from / relative, ""},
                     fmt::format("cannot be copied to {}: {}.", (to / relative).string(), error.message()));
  }
}

void writeWholeFolder(const fs::path& folder, const std::function<void(const fs::path&)>& fill) {
  std::error_code error;
  const fs::path target = fs::absolute(folder).lexically_normal();
  if (fs::exists(target, error) && (!fs::is_directory(target, error) || !fs::is_empty(target, error))) {
    throw InputError({folder, ""}, "is not empty; allowed: a folder that does not exist yet, or an empty one.");
  }
  const fs::path destination = target.filename().empty() ? target.parent_path() : target;
  const fs::path parent = destination.parent_path();
  const fs::path made = firstMissing(parent);
  fs::path part;
  const auto undo = [&] {
    std::error_code ignored;
    if (!part.empty()) fs::remove_all(part, ignored);
    if (!made.empty()) fs::remove_all(made, ignored);
  };
  try {
    fs::create_directories(parent, error);
    std::string name = (parent / fmt::format(".{}.part-XXXXXX", destination.filename().string())).string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw InputError({folder, ""}, fmt::format("cannot be made: {}.", std::strerror(errno)));
    }
    part = name;
    fs::permissions(part,
                    fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                        fs::perms::others_exec,
                    error);
    fill(part);
    fs::remove(destination, error);  // an empty folder
    fs::rename(part, destination, error);
    if (error) throw InputError({folder, ""}, fmt::format("cannot be made: {}.", error.message()));
  } catch (...) {
    undo();
    throw;
  }
}

}  // namespace spindrift
