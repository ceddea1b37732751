// SPDX-License-Identifier: Apache-2.0
#include "core/probing/printed_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/line_pattern.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

const std::set<std::string, std::less<>>& knownPlaces() {
  static const std::set<std::string, std::less<>> places{
      "feature", "stylus", "artefact", "cycle", "c_deg", "touch", "x", "y", "z", "nx", "ny", "nz", "time", "skip"};
  return places;
}

}  // namespace

PrintedText readPrintedText(std::string_view text, const std::filesystem::path& name, const JsonNode& pattern,
                            const MachineDescription& machine) {
  pattern.requireFormat("spindrift-printed-text", 1);
  const LinePattern touch_line(pattern.at("touch_line"), knownPlaces());
  const std::optional<LinePattern> cycle_line =
      pattern.has("cycle_line") ? std::optional(LinePattern(pattern.at("cycle_line"), knownPlaces())) : std::nullopt;
  const std::string prefix = pattern.stringOr("cycle_prefix", "");
  const std::string artefact = pattern.stringOr("artefact", "");
  const std::string only_stylus = pattern.stringOr("stylus", "");
  const bool reference = pattern.has("position") &&
                         pattern.at("position").oneOf({"stylus_centre", "spindle_reference"}) == "spindle_reference";
  const double mm_per_unit = pattern.has("mm_per_unit") ? pattern.at("mm_per_unit").positiveNumber() : 1.0;
  const double s_per_unit = pattern.has("s_per_unit") ? pattern.at("s_per_unit").positiveNumber() : 1.0;
  const double interval = pattern.has("touch_interval_s") ? pattern.at("touch_interval_s").positiveNumber() : 3.0;
  const double cycle_interval = pattern.has("cycle_interval_s") ? pattern.at("cycle_interval_s").positiveNumber() : 0.0;
  const double c_sign = pattern.numberOr("c_sign", 1.0);
  const bool decimal_comma = pattern.booleanOr("decimal_comma", false);
  std::map<std::string, std::map<std::string, std::string>> translations;
  if (const auto values = pattern.find("values")) {
    for (const auto& [place, table] : values->members()) {
      for (const auto& [from, to] : table.members()) translations[place][from] = to.name();
    }
  }
  const auto translated = [&](const std::string& place, const std::string& value) {
    const auto table = translations.find(place);
    if (table == translations.end()) return value;
    const auto direct = table->second.find(value);
    if (direct != table->second.end()) return direct->second;
    double number = 0.0;  // "1." and "001" mean 1
    if (parseNumber(value, number)) {
      const auto plain = table->second.find(exactNumber(number));
      if (plain != table->second.end()) return plain->second;
    }
    return value;
  };

  PrintedText result;
  result.touches.file = name;
  std::string cycle = prefix + "0";
  bool cycle_seen = false;
  int cycles = 0;
  double clock = 0.0;
  double cycle_start = 0.0;
  std::optional<double> first_time;
  std::map<std::string, int> numbered;
  std::size_t line_number = 0;
  std::size_t begin = 0;
  while (begin < text.size()) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) end = text.size();
    const std::string_view line = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (line.empty()) continue;
    const auto place = [&](const std::string& what) { return SourcePlace::atLine(name, line_number, what); };
    if (cycle_line) {
      if (const auto values = cycle_line->match(line)) {
        std::string label = values->contains("cycle") ? values->at("cycle") : std::to_string(cycles);
        double number = 0.0;
        if (parseNumber(label, number)) label = exactNumber(number);
        cycle = prefix + label;
        if (cycle_seen || cycles > 0) cycle_start += cycle_interval;
        if (cycle_interval > 0.0) clock = std::max(clock, cycle_start);
        ++cycles;
        cycle_seen = true;
        numbered.clear();
        continue;
      }
    }
    const auto values = touch_line.match(line);
    if (!values) {
      ++result.ignored_lines;
      continue;
    }
    const auto number = [&](const char* what, double otherwise) {
      const auto found = values->find(what);
      if (found == values->end()) return otherwise;
      std::string value = found->second;
      if (decimal_comma) std::replace(value.begin(), value.end(), ',', '.');
      if (value.starts_with('+')) value.erase(0, 1);
      if (value.ends_with('.')) value += '0';
      double parsed = 0.0;
      if (!parseNumber(value, parsed)) {
        throw InputError(place(what),
                         fmt::format("\"{}\" is not a number; allowed: a number such as -12.345.", found->second));
      }
      return parsed;
    };
    const auto word = [&](const char* what, const std::string& otherwise) {
      const auto found = values->find(what);
      return found == values->end() ? otherwise : translated(what, found->second);
    };
    Touch t;
    t.line = line_number;
    if (values->contains("cycle")) {
      t.cycle = prefix + values->at("cycle");
    } else {
      t.cycle = cycle;
    }
    t.artefact = word("artefact", artefact);
    t.feature = word("feature", "");
    t.stylus =
        word("stylus", only_stylus.empty() && machine.styli.size() == 1 ? machine.styli.front().id : only_stylus);
    if (t.artefact.empty() || t.feature.empty() || t.stylus.empty()) {
      throw InputError(place("touch"),
                       "the line does not say artefact, feature and stylus; allowed: places in "
                       "touch_line, or \"artefact\" and \"stylus\" in the template.");
    }
    t.c_deg = c_sign * number("c_deg", 0.0);
    if (t.c_deg == 0.0) t.c_deg = 0.0;
    t.position_mm = Eigen::Vector3d(number("x", std::nan("")), number("y", std::nan("")), number("z", std::nan("")));
    if (!t.position_mm.allFinite()) {
      throw InputError(pattern.at("touch_line").place(),
                       "lacks one of {x}, {y}, {z}; allowed: a pattern with all three.");
    }
    t.position_mm *= mm_per_unit;
    t.approach = Eigen::Vector3d(number("nx", 0.0), number("ny", 0.0), number("nz", 0.0));
    const double length = t.approach.norm();
    if (length < 0.5) {
      throw InputError(place("approach"),
                       "the direction of approach is missing or zero; allowed: a unit vector in {nx}, "
                       "{ny}, {nz}.");
    }
    t.approach /= length;
    const int count = numbered[fmt::format("{}|{}|{}", t.feature, t.stylus, t.c_deg)]++;
    const double touch = number("touch", count);
    if (touch < 0.0 || touch > 1e6 || touch != std::floor(touch)) {
      throw InputError(place("touch"), fmt::format("touch number {} is not allowed; allowed: 0, 1, 2, ...", touch));
    }
    t.touch = static_cast<int>(touch);
    if (values->contains("time")) {
      const double time = number("time", 0.0) * s_per_unit;
      if (!first_time) first_time = time;
      t.time_s = time - *first_time;
    } else {
      t.time_s = clock;
      clock += interval;
    }
    if (reference) {
      const Stylus* stylus = machine.findStylus(t.stylus);
      if (stylus == nullptr) {
        throw InputError(place("stylus"), fmt::format("stylus \"{}\" is not in the machine file.", t.stylus));
      }
      t.position_mm += stylus->offset_mm;
    }
    result.touches.touches.push_back(std::move(t));
  }
  if (result.touches.touches.empty()) {
    throw InputError(
        {name, ""},
        fmt::format(
            "no line matches the pattern \"{}\"; allowed: text printed by the measuring program, or another template.",
            pattern.at("touch_line").string()));
  }
  return result;
}

}  // namespace spindrift
