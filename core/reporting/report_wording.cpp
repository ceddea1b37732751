// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/report_wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/discrepancy/effect_titles.h"

namespace spindrift {
namespace {

bool inWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

std::vector<std::string> partsOf(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    parts.emplace_back(text.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

std::string joinedWords(const std::vector<std::string>& parts, std::string_view between = " ") {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? std::string() : std::string(between)) + part;
  return text;
}

/// A unit as it stands in names of parameters and drivers; empty for another word.
std::string_view unitInName(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 16> units{{{"um", "µm"},
                                                                                 {"urad", "µrad"},
                                                                                 {"m", "m"},
                                                                                 {"m2", "m²"},
                                                                                 {"mm", "mm"},
                                                                                 {"K", "K"},
                                                                                 {"s", "s"},
                                                                                 {"h", "h"},
                                                                                 {"min", "min"},
                                                                                 {"rpm", "rpm"},
                                                                                 {"krpm", "(1000 rpm)"},
                                                                                 {"krpm1.5", "(1000 rpm)^1.5"},
                                                                                 {"krpm2", "(1000 rpm)²"},
                                                                                 {"W", "W"},
                                                                                 {"percent", "%"},
                                                                                 {"degC", "°C"}}};
  for (const auto& [name, printed] : units)
    if (word == name) return printed;
  return {};
}

std::string capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string axisOf(std::string_view letter) {
  return capital(std::string(letter));
}

}  // namespace

std::string printedUnitOf(Component component) {
  return printedUnit(unitOf(component));
}

ReportText withEffectTitles(std::string_view text) {
  const auto inId = [](char c) { return inWord(c) || c == '.' || c == '-'; };
  ReportText out;
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    if (!inId(text[i])) {
      plain += text[i++];
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && inId(text[end])) ++end;
    std::size_t id_end = end;
    while (id_end > i && (text[id_end - 1] == '.' || text[id_end - 1] == '-')) --id_end;  // of the sentence
    const std::string_view id = text.substr(i, id_end - i);
    if (id.find('.') != std::string_view::npos && effectTitleOf(id)) {
      out = out + ReportText(plain + effectTitle(id) + ' ') + ReportText::smallPrint(id);
      plain.clear();
    } else {
      plain += id;
    }
    plain += text.substr(id_end, end - id_end);
    i = end;
  }
  return out + ReportText(plain);
}

ReportText effectHeading(std::string_view id, std::string_view own_title) {
  const bool own = !own_title.empty() && own_title != id;
  if (!own && !effectTitleOf(id)) return id;
  return capital(own ? std::string(own_title) : effectTitle(id)) + ' ' + ReportText::smallPrint(id);
}

std::string parameterTitle(std::string_view name) {
  std::vector<std::string> title, above, below;
  bool per = false;
  constexpr std::string_view feed = "_per_m_per_min";
  const std::string_view whole = name;
  if (name.ends_with(feed)) {
    below.emplace_back("(m/min)");
    name.remove_suffix(feed.size());
  }
  for (const std::string& part : partsOf(name, '_')) {
    const std::string_view unit = title.empty() ? std::string_view() : unitInName(part);
    if (part == "per") {
      per = true;
    } else if (!unit.empty() && per) {
      below.emplace_back(unit);
    } else if (!unit.empty()) {
      above.emplace_back(unit);
    } else {
      title.push_back(part == "tau" ? "time constant" : part);
    }
  }
  std::string text = joinedWords(title);
  if (above.empty() && below.empty()) return words(whole);
  text += " / " + (above.empty() ? std::string("1") : joinedWords(above));
  if (below.size() == 1) text += "/" + below.front();
  if (below.size() > 1) text += "/(" + joinedWords(below) + ")";
  return text;
}

std::string titleWithUnit(const std::string& name) {
  for (const auto& [ending, unit] : {std::pair{"_um_per_m", "µm/m"}, {"_urad", "µrad"}, {"_um", "µm"}, {"_mm", "mm"}}) {
    if (name.ends_with(ending)) return fmt::format("{} / {}", name.substr(0, name.rfind(ending)), unit);
  }
  return name;
}

SignalTitle signalTitle(std::string_view column) {
  const auto without = [&](std::string_view begin, std::string_view end) {
    return column.substr(begin.size(), column.size() - begin.size() - end.size());
  };
  const auto is = [&](std::string_view begin, std::string_view end) {
    return column.size() > begin.size() + end.size() && column.starts_with(begin) && column.ends_with(end);
  };
  if (column == "spindle_rpm") return {"spindle speed", "rpm"};
  if (column == "instrument_on_assumed") return {"instrument on (assumed)", ""};
  if (is("feed_", "_mm_min")) return {"feed " + axisOf(without("feed_", "_mm_min")), "mm/min"};
  if (is("pos_", "_mm")) return {"position " + axisOf(without("pos_", "_mm")), "mm"};
  if (is("speed_", "_rpm")) return {"speed " + axisOf(without("speed_", "_rpm")), "rpm"};
  if (is("T_", "_degC")) return {words(without("T_", "_degC")), "°C"};
  for (const auto& [ending, unit] : {std::pair<std::string_view, std::string_view>{"_um_per_m", "µm/m"},
                                     {"_urad", "µrad"},
                                     {"_um", "µm"},
                                     {"_degC", "°C"}}) {
    if (is("", ending)) return {words(without("", ending)), std::string(unit)};
  }
  return {words(column), ""};
}

std::string driversInWords(std::string_view drivers) {
  std::string out;
  for (std::size_t i = 0; i < drivers.size();) {
    const std::size_t end = std::min(drivers.find_first_of(" *()", i), drivers.size());
    const std::string_view word = drivers.substr(i, end - i);
    const std::size_t power = std::min(word.find('^'), word.size());
    const std::string_view name = word.substr(0, power);
    double seconds = 0.0;
    if (parseNumber(word, seconds) && drivers.substr(end).starts_with(" s")) {
      out += spanOfTime(seconds);
      i = end + 2;
      continue;
    }
    if (name.starts_with("feed_") && name.size() == 6) {
      out += "feed " + axisOf(name.substr(5));
    } else if (name.starts_with("pos_") && name.size() == 5) {
      out += "position " + axisOf(name.substr(4));
    } else if (name.starts_with("speed_") && name.size() == 7) {
      out += "speed " + axisOf(name.substr(6));
    } else if (name.starts_with("T_") && name.ends_with("_degC")) {
      out += "temperature of " + signalTitle(name).name;
    } else if (name == "column_difference") {
      out += "temperature difference of the column, front minus rear";
    } else if (name == "column_side_difference") {
      out += "temperature difference of the column, left minus right";
    } else {
      out += signalTitle(name).name;
    }
    const std::string_view exponent = word.substr(power);
    if (exponent == "^2") out += "²";
    if (!exponent.empty() && exponent != "^1" && exponent != "^2") out += exponent;
    if (end < drivers.size()) out += drivers[end] == '*' ? std::string(" × ") : std::string(1, drivers[end]);
    i = end + 1;
  }
  return out;
}

std::string spanOfTime(double seconds) {
  if (!std::isfinite(seconds)) return "not determined";
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string utcInWords(std::string_view utc) {
  if (utc.size() != 20 || utc[10] != 'T' || utc[19] != 'Z') return std::string(utc);
  return fmt::format("{} {} UTC", utc.substr(0, 10), utc.substr(11, 5));
}

std::string words(std::string_view key) {
  std::string text(key);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace spindrift
