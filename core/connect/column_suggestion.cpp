// SPDX-License-Identifier: Apache-2.0
#include "core/connect/column_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/connect/unit_conversion.h"
#include "core/machine/sensor_role.h"

namespace spindrift {
namespace {

/// Letters and digits; everything else becomes one low line.
std::string cleaned(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 128 && std::isalnum(u) != 0) {
      out += c;
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The last part of a topic, a path or a chain of components.
std::string lastPart(const std::string& text) {
  const std::size_t cut = text.find_last_of("/#.");
  return std::string(trimmed(cut == std::string::npos ? text : text.substr(cut + 1)));
}

std::string nameOf(const DataItem& item) {
  std::string name = cleaned(item.name.empty() ? lastPart(item.address) : item.name);
  if (name.empty()) name = cleaned(item.address);
  if (name.empty()) name = "item";
  return name;
}

/// 'x', 'y' or 'z' where the component or the name says which axis it is.
std::optional<char> axisOf(const DataItem& item) {
  for (const std::string& text : {lastPart(item.component), item.name, lastPart(item.address)}) {
    const std::string word = lower(cleaned(text));
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string letter(1, axis);
      if (word == letter || word.starts_with(letter + "_") || word.ends_with("_" + letter) || word == letter + "pos" ||
          word == letter + "act" || word == letter + "feed" || word == letter + "frt")
        return axis;
    }
  }
  return std::nullopt;
}

bool isTemperatureItem(const DataItem& item) {
  if (conversionInto("T_a_degC", item.unit) && isKnownUnit(item.unit)) return true;
  if (isKnownUnit(item.unit) || item.category == "condition") return false;
  const std::string words = lower(item.type + " " + nameOf(item));
  return words.find("temp") != std::string::npos || nameOf(item).starts_with("T_");
}

/// The name of a temperature without what the column's name says anyway.
std::string temperatureName(std::string name) {
  if (name.starts_with("T_")) name.erase(0, 2);
  if (name.ends_with("_degC")) name.erase(name.size() - 5);
  // "Tspindle", "T2".
  const auto second = static_cast<unsigned char>(name.size() > 1 ? name[1] : ' ');
  if (name[0] == 'T' && (std::islower(second) != 0 || std::isdigit(second) != 0) && !lower(name).starts_with("temp") &&
      !lower(name).starts_with("table") && !lower(name).starts_with("tool"))
    name.erase(0, 1);
  return name;
}

std::string columnOf(const DataItem& item) {
  const std::string name = nameOf(item);
  const auto is = [&](const char* column) {
    return isKnownUnit(item.unit) && conversionInto(column, item.unit).has_value();
  };
  const std::string type = lower(item.type);
  if (isTemperatureItem(item)) return fmt::format("T_{}_degC", temperatureName(name));
  if (is("a_rpm")) return "spindle_rpm";
  if (!isKnownUnit(item.unit) && lower(name).find("spindle") != std::string::npos &&
      (type.find("speed") != std::string::npos || type.find("velocity") != std::string::npos ||
       lower(name).find("speed") != std::string::npos || lower(name).find("rpm") != std::string::npos))
    return "spindle_rpm";
  const std::optional<char> axis = axisOf(item);
  if (is("a_mm_min")) return axis ? fmt::format("feed_{}_mm_min", *axis) : name + "_mm_min";
  if (is("a_mm"))
    return axis && type.find("position") != std::string::npos ? fmt::format("pos_{}_mm", *axis) : name + "_mm";
  for (const char* unit : {"W", "A", "percent", "deg"}) {
    if (!unitOfColumn(name).empty()) break;
    if (is((std::string("a_") + unit).c_str())) return name + "_" + unit;
  }
  return name;
}

}  // namespace

nlohmann::json suggestColumn(const DataItem& item, const std::string& source, const std::set<std::string>& taken) {
  const std::string wanted = columnOf(item);
  const std::string unit = unitOfColumn(wanted);
  std::string column = wanted;
  for (int number = 2; taken.contains(column) || column == "time_s"; ++number) {
    const std::string stem = unit.empty() ? wanted : wanted.substr(0, wanted.size() - unit.size() - 1);
    column = stem + fmt::format("_{}", number) + (unit.empty() ? "" : "_" + unit);
  }
  nlohmann::json out = {{"column", column}, {"source", source}, {"item", item.address}};
  if (column.starts_with("T_") && column.ends_with("_degC")) {
    const auto role = readSensorRole(column);
    if (role && *role != SensorRole::Other) out["role"] = std::string(toString(*role));
  }
  const std::string type = lower(item.type);
  if (type == "execution") {
    out["values"] = {{"ACTIVE", 1}};
    out["otherwise"] = 0;
  } else if (item.category == "condition") {
    out["values"] = {{"Normal", 0}, {"Warning", 1}, {"Fault", 2}};
  } else if (item.example == "true" || item.example == "false") {
    out["values"] = {{"true", 1}, {"false", 0}};
  } else if (item.example == "ON" || item.example == "OFF") {
    out["values"] = {{"ON", 1}, {"OFF", 0}};
  } else if (item.category == "event") {
    double number = 0.0;
    if (!item.example.empty() && item.example != "UNAVAILABLE" && !parseNumber(item.example, number))
      out["values"] = {{printable(item.example), 1}};
    out["otherwise"] = 0;
  }
  return out;
}

}  // namespace spindrift
