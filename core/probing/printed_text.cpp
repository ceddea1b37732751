// SPDX-License-Identifier: Apache-2.0
#include "core/probing/printed_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/text.h"

namespace spindrift {
namespace {

const std::set<std::string, std::less<>>& knownPlaces() {
  static const std::set<std::string, std::less<>> places{
      "feature", "stylus", "artefact", "cycle", "c_deg", "touch", "x", "y", "z", "nx", "ny", "nz", "time", "skip"};
  return places;
}

JsonNode touchLineOf(const JsonNode& pattern) {
  pattern.requireFormat("spindrift-printed-text", 1);
  return pattern.at("touch_line");
}

}  // namespace

PrintedTextReader::PrintedTextReader(std::filesystem::path name, const JsonNode& pattern,
                                     const MachineDescription& machine)
    : name_(std::move(name)), touch_line_(touchLineOf(pattern), knownPlaces()) {
  for (const char* axis : {"x", "y", "z"}) {
    if (!touch_line_.has(axis))
      throw InputError(pattern.at("touch_line").place(),
                       "lacks one of {x}, {y}, {z}; allowed: a pattern with all three.");
  }
  if (pattern.has("cycle_line")) cycle_line_.emplace(pattern.at("cycle_line"), knownPlaces());
  prefix_ = pattern.stringOr("cycle_prefix", "");
  artefact_ = pattern.stringOr("artefact", "");
  stylus_ = pattern.stringOr("stylus", "");
  styli_ = machine.styli;
  if (stylus_.empty() && styli_.size() == 1) stylus_ = styli_.front().id;
  reference_ = pattern.has("position") &&
               pattern.at("position").oneOf({"stylus_centre", "spindle_reference"}) == "spindle_reference";
  const auto positive = [&](const char* key, double otherwise) {
    return pattern.has(key) ? pattern.at(key).positiveNumber() : otherwise;
  };
  mm_per_unit_ = positive("mm_per_unit", 1.0);
  s_per_unit_ = positive("s_per_unit", 1.0);
  interval_s_ = positive("touch_interval_s", 3.0);
  cycle_interval_s_ = positive("cycle_interval_s", 0.0);
  c_sign_ = pattern.numberOr("c_sign", 1.0);
  if (std::abs(c_sign_) != 1.0) pattern.at("c_sign").reject("1, or -1 if the table is counted the other way round");
  decimal_comma_ = pattern.booleanOr("decimal_comma", false);
  day_of_month_ = pattern.has("clock") && pattern.at("clock").oneOf({"running", "day_of_month"}) == "day_of_month";
  const std::string line = pattern.at("touch_line").string();
  touch_begin_ = trimmed(std::string_view(line).substr(0, line.find('{')));
  if (const auto values = pattern.find("values")) {
    for (const auto& [place, table] : values->members()) {
      for (const auto& [from, to] : table.members()) translations_[place][from] = to.name();
    }
  }
  cycle_ = prefix_ + "0";
}

SourcePlace PrintedTextReader::place(const std::string& what) const {
  return SourcePlace::atLine(name_, line_, what);
}

std::string PrintedTextReader::translated(const std::string& place, const std::string& value) const {
  const auto table = translations_.find(place);
  if (table == translations_.end()) return value;
  const auto direct = table->second.find(value);
  if (direct != table->second.end()) return direct->second;
  double number = 0.0;  // "1." and "001" mean 1
  if (parseNumber(value, number)) {
    const auto plain = table->second.find(exactNumber(number));
    if (plain != table->second.end()) return plain->second;
  }
  return value;
}

std::string PrintedTextReader::word(const Values& values, const char* what, const std::string& otherwise) const {
  const auto found = values.find(what);
  return found == values.end() ? otherwise : translated(what, found->second);
}

double PrintedTextReader::number(const Values& values, const char* what, double otherwise) const {
  const auto found = values.find(what);
  if (found == values.end()) return otherwise;
  std::string value = found->second;
  if (decimal_comma_) std::replace(value.begin(), value.end(), ',', '.');
  if (value.starts_with('+')) value.erase(0, 1);
  if (value.ends_with('.')) value += '0';
  double parsed = 0.0;
  if (!parseNumber(value, parsed)) {
    throw InputError(place(what),
                     fmt::format("\"{}\" is not a number; allowed: a number such as -12.345.", found->second));
  }
  return parsed;
}

std::string PrintedTextReader::cycleName(std::string label) const {
  double number = 0.0;  // "1." and "001" mean 1
  if (parseNumber(label, number)) label = exactNumber(number);
  return prefix_ + label;
}

void PrintedTextReader::beginCycle(const Values& values) {
  const auto named = values.find("cycle");
  cycle_ = cycleName(named != values.end() ? named->second : std::to_string(cycles_));
  if (cycles_ > 0) cycle_start_s_ += cycle_interval_s_;
  if (cycle_interval_s_ > 0.0) clock_s_ = std::max(clock_s_, cycle_start_s_);
  ++cycles_;
  numbered_.clear();
}

/// What the reader remembers changes only when nothing can fail any more.
Touch PrintedTextReader::touchOf(const Values& values) {
  Touch t;
  t.line = line_;
  const auto named = values.find("cycle");
  t.cycle = named != values.end() ? cycleName(named->second) : cycle_;
  t.artefact = word(values, "artefact", artefact_);
  t.feature = word(values, "feature", "");
  t.stylus = word(values, "stylus", stylus_);
  if (t.artefact.empty() || t.feature.empty() || t.stylus.empty()) {
    throw InputError(place("touch"),
                     "the line does not say artefact, feature and stylus; allowed: places in "
                     "touch_line, or \"artefact\" and \"stylus\" in the template.");
  }
  t.c_deg = c_sign_ * number(values, "c_deg", 0.0);
  if (t.c_deg == 0.0) t.c_deg = 0.0;
  if (std::abs(t.c_deg) > most_turned_deg) {
    throw InputError(place("{c_deg}"), fmt::format("a table angle of {:g}° is not allowed; allowed: {:g} to {:g}°.",
                                                   t.c_deg, -most_turned_deg, most_turned_deg));
  }
  t.position_mm =
      mm_per_unit_ * Eigen::Vector3d(number(values, "x", 0.0), number(values, "y", 0.0), number(values, "z", 0.0));
  t.approach = Eigen::Vector3d(number(values, "nx", 0.0), number(values, "ny", 0.0), number(values, "nz", 0.0));
  const double length = t.approach.norm();
  if (length < 0.5) {
    throw InputError(place("approach"),
                     "the direction of approach is missing or zero; allowed: a unit vector in {nx}, "
                     "{ny}, {nz}.");
  }
  t.approach /= length;
  const std::string of = fmt::format("{}|{}|{}", t.feature, t.stylus, t.c_deg);
  const auto counted = numbered_.find(of);
  const int count = counted == numbered_.end() ? 0 : counted->second;
  const double touch = number(values, "touch", count);
  if (touch < 0.0 || touch > 1e6 || touch != std::floor(touch)) {
    throw InputError(place("touch"), fmt::format("touch number {} is not allowed; allowed: 0, 1, 2, ...", touch));
  }
  t.touch = static_cast<int>(touch);
  std::optional<double> time;
  if (values.contains("time")) time = number(values, "time", 0.0) * s_per_unit_;
  if (reference_) {
    const auto stylus = std::find_if(styli_.begin(), styli_.end(), [&](const Stylus& s) { return s.id == t.stylus; });
    if (stylus == styli_.end()) {
      throw InputError(place("stylus"), fmt::format("stylus \"{}\" is not in the machine file.", t.stylus));
    }
    t.position_mm += stylus->offset_mm;
  }
  numbered_[of] = count + 1;
  if (time) {
    constexpr double day_s = 86400.0;
    constexpr double shortest_month_s = 28.0 * day_s;
    if (day_of_month_ && first_time_s_ && *time < printed_s_ - (shortest_month_s - day_s))
      months_before_s_ += day_s * std::floor(printed_s_ / day_s);
    printed_s_ = *time;
    *time += months_before_s_;
    if (!first_time_s_) first_time_s_ = time;
    t.time_s = *time - *first_time_s_;
  } else {
    t.time_s = clock_s_;
    clock_s_ += interval_s_;
  }
  return t;
}

std::optional<Touch> PrintedTextReader::read(std::string_view whole) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8, at the begin of a file
  if (line_ == 0 && whole.starts_with(mark)) whole.remove_prefix(mark.size());
  const std::string_view line = trimmed(whole);
  ++line_;
  if (line.empty()) return std::nullopt;
  if (cycle_line_) {
    if (const auto values = cycle_line_->match(line)) {
      beginCycle(*values);
      return std::nullopt;
    }
  }
  if (const auto values = touch_line_.match(line)) return touchOf(*values);
  ++ignored_lines_;
  if (!touch_begin_.empty() && line.starts_with(touch_begin_) && ++cut_lines_ == 1) first_cut_line_ = line_;
  return std::nullopt;
}

PrintedText readPrintedText(std::string_view text, const std::filesystem::path& name, const JsonNode& pattern,
                            const MachineDescription& machine) {
  PrintedTextReader reader(name, pattern, machine);
  PrintedText result;
  result.touches.file = name;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (auto touch = reader.read(text.substr(begin, end - begin))) result.touches.touches.push_back(std::move(*touch));
    begin = end + 1;
  }
  result.ignored_lines = reader.ignoredLines();
  result.cut_lines = reader.cutLines();
  result.first_cut_line = reader.firstCutLine();
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
