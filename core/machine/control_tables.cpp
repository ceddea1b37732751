// SPDX-License-Identifier: Apache-2.0
#include "core/machine/control_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

constexpr std::string_view axes = "XYZ";
constexpr double rounding_mm = 5e-7;  // of the six decimals of a table

std::size_t numberOf(const AxisComponentTable& table) {
  const std::size_t axis = axes.find(table.axis);
  SPINDRIFT_ASSERT(table.axis.size() == 1 && axis != std::string_view::npos, "a table of X, Y or Z");
  return axis;
}

/// Deviation of displacement `of` at a row, mm; what rounds to zero is zero (not -0).
double deviation_mm(const AxisComponentTable& table, std::size_t row, std::size_t of) {
  const double value = table.deviation[row][of] * mm_per_um;
  return std::abs(value) < rounding_mm ? 0.0 : value;
}

void requirePositions(const AxisComponentTable& table, std::size_t most) {
  const std::size_t count = table.position_mm.size();
  if (count < 2 || count > most) {
    throw InputError(fmt::format("{} positions are not allowed; allowed: 2 to {}.", count, most));
  }
}

bool movesSomething(const AxisComponentTable& table, std::size_t of) {
  for (std::size_t row = 0; row < table.position_mm.size(); ++row)
    if (deviation_mm(table, row, of) != 0.0) return true;
  return false;
}

std::string sagTable(const AxisComponentTable& table, std::size_t of, int index) {
  constexpr double most_mm = 1.0;  // MD32720 as delivered
  std::string text;
  for (std::size_t row = 0; row < table.position_mm.size(); ++row) {
    const double value = deviation_mm(table, row, of);
    if (!(std::abs(value) <= most_mm)) {
      throw InputError(fmt::format("E{}{} is {:.4g} mm at {:g} mm; allowed in a sag compensation: -1 to 1 mm.",
                                   axes[of], table.axis, value, table.position_mm[row]));
    }
    text += fmt::format("$AN_CEC[{},{}]={:.6f}\n", index, row, value);
  }
  const double first = table.position_mm.front();
  const double last = table.position_mm.back();
  return text + fmt::format(
                    "$AN_CEC_INPUT_AXIS[{0}]=({1}1)\n$AN_CEC_OUTPUT_AXIS[{0}]=({2}1)\n$AN_CEC_STEP[{0}]={3:.6f}\n"
                    "$AN_CEC_MIN[{0}]={4:.6f}\n$AN_CEC_MAX[{0}]={5:.6f}\n$AN_CEC_DIRECTION[{0}]=0\n"
                    "$AN_CEC_MULT_BY_TABLE[{0}]=0\n$AN_CEC_IS_MODULO[{0}]=0\n",
                    index, table.axis, axes[of], (last - first) / static_cast<double>(table.position_mm.size() - 1),
                    first, last);
}

/// "$AN_CEC_STEP[0]=50" -> name, what stands in brackets and what follows; false for a line that is no assignment.
bool assignment(std::string_view line, std::string& name, std::vector<std::string>& indices, std::string& value) {
  const std::size_t open = line.find('[');
  const std::size_t close = line.find(']');
  const std::size_t equals = line.find('=');
  if (line.empty() || line[0] != '$' || open == std::string_view::npos || close == std::string_view::npos ||
      equals == std::string_view::npos || open > close || close > equals)
    return false;
  name = std::string(line.substr(1, open - 1));
  indices = splitList(std::string(line.substr(open + 1, close - open - 1)));
  value = std::string(line.substr(equals + 1));
  return true;
}

double numberIn(const std::string& text, const SourcePlace& place) {
  double value = 0.0;
  if (!parseNumber(text, value)) throw InputError(place, fmt::format("\"{}\" is not a number.", text));
  return value;
}

int countIn(const std::string& text, const SourcePlace& place) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < 0)
    throw InputError(place, fmt::format("\"{}\" is not a number from 0 on.", text));
  return value;
}

/// "(X1)" or "X1" -> X.
char axisIn(std::string_view text, const SourcePlace& place) {
  if (!text.empty() && text.front() == '(') text.remove_prefix(1);
  if (text.empty() || axes.find(text.front()) == std::string_view::npos)
    throw InputError(place, fmt::format("\"{}\" is not an axis; allowed: X, Y or Z.", text));
  return text.front();
}

/// One table of the control as its lines come in.
struct SiemensLines {
  char base = '\0';
  char axis = '\0';
  std::map<int, double> value_mm;
  double step_mm = 0.0;
  double min_mm = 0.0;
};

struct FanucLines {
  std::map<int, int> steps;
  char axis = '\0';
  int reference = -1;
  double interval_mm = 0.0;
  double unit_um = 0.0;
  int sign = 0;
};

/// "(AXIS X)" of a program's own comments: the value behind `key`.
bool commentValue(const std::string& line, std::string_view key, std::string& value) {
  const std::string start = fmt::format("({} ", key);
  if (line.rfind(start, 0) != 0) return false;
  value = line.substr(start.size(), line.find_first_of(" )", start.size()) - start.size());
  return true;
}

}  // namespace

double ControlTable::movementAt(double base_mm) const {
  SPINDRIFT_ASSERT(!position_mm.empty() && position_mm.size() == movement_mm.size(), "a table with positions");
  if (base_mm <= position_mm.front()) return movement_mm.front();
  if (base_mm >= position_mm.back()) return movement_mm.back();
  const auto after = std::upper_bound(position_mm.begin(), position_mm.end(), base_mm);
  const auto i = static_cast<std::size_t>(after - position_mm.begin());
  const double part = (base_mm - position_mm[i - 1]) / (position_mm[i] - position_mm[i - 1]);
  return movement_mm[i - 1] + part * (movement_mm[i] - movement_mm[i - 1]);
}

std::string siemensSagCompensation(const std::vector<AxisComponentTable>& tables,
                                   const std::optional<MeasuredBox>& measured) {
  constexpr std::size_t most_points = 200;  // of a table of an 828D, which cannot be extended (K3 03/2013, p. 264)
  std::string body;
  std::string relations;
  std::map<std::string, std::string> extents;  // of the base axes
  int index = 0;
  std::size_t points = 0;
  for (const AxisComponentTable& table : tables) {
    requirePositions(table, most_points);
    const std::array<bool, 6> known = knownErrors(table, measured);
    for (std::size_t of = 0; of < 3; ++of) {
      if (of == numberOf(table) || !known[of] || !movesSomething(table, of)) continue;
      body += sagTable(table, of, index);
      relations += fmt::format("{}[{}] {}=F({})", index == 0 ? "" : ", ", index, axes[of], table.axis);
      if (measured)
        extents[table.axis] =
            fmt::format("; {} {}\n", table.axis, measured->extentAlong(static_cast<int>(numberOf(table))));
      points = std::max(points, table.position_mm.size());
      ++index;
    }
  }
  if (index == 0) return {};
  std::string extent;
  for (const auto& [axis, line] : extents) extent += line;
  return fmt::format(
             "%_N_NC_CEC_INI\n"
             "; {}\n"
             "; value = deviation (actual minus commanded) in mm, zero at the reference position: a positive value "
             "moves\n"
             "; the compensation axis in the negative direction (SINUMERIK 840D sl, Extended Functions, K3, 5.4.3).\n"
             "; X1, Y1, Z1 are the names of the machine axes. MD18342 must be at least {} for each table; active with\n"
             "; MD32710 = 1 of the compensation axes and SD41300 = 1 of the tables. Values stand in place of those "
             "that\n"
             "; the control has. Check one of them with one move before the tables are used.\n"
             "{}CHANDATA(1)\n",
             relations, points, extent) +
         body + "M17\n";
}

std::vector<ControlTable> readSiemensTables(const std::string& text, const std::string& file) {
  std::map<std::string, SiemensLines> found;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const SourcePlace place = SourcePlace::atLine(file, ++number);
    std::string name, value;
    std::vector<std::string> indices;
    if (!assignment(line, name, indices, value)) continue;
    const bool own = name.rfind("AA_ENC_COMP", 0) == 0;  // [measuring system, (point,) axis]
    if (!own && name.rfind("AN_CEC", 0) != 0) continue;
    const bool is_value = name == "AN_CEC" || name == "AA_ENC_COMP";
    if (indices.size() != (is_value ? 1U : 0U) + (own ? 2U : 1U))
      throw InputError(place, fmt::format("${} has {} numbers in brackets.", name, indices.size()));
    SiemensLines& table = found[own ? indices.back() : indices.front()];
    if (own) table.base = table.axis = axisIn(indices.back(), place);
    const std::string what = name.substr(own ? 11 : 6);
    if (is_value) table.value_mm[countIn(indices[1], place)] = numberIn(value, place);
    if (what == "_STEP") table.step_mm = numberIn(value, place);
    if (what == "_MIN") table.min_mm = numberIn(value, place);
    if (what == "_INPUT_AXIS") table.base = axisIn(value, place);
    if (what == "_OUTPUT_AXIS") table.axis = axisIn(value, place);
  }
  std::vector<ControlTable> out;
  for (const auto& [index, lines_of] : found) {
    if (lines_of.base == '\0' || lines_of.axis == '\0' || !(lines_of.step_mm > 0.0) || lines_of.value_mm.empty())
      throw InputError({file, ""}, fmt::format("table {} lacks its axes, its values or their distance.", index));
    ControlTable table{lines_of.base, lines_of.axis, {}, {}};
    for (const auto& [point, value] : lines_of.value_mm) {
      table.position_mm.push_back(lines_of.min_mm + point * lines_of.step_mm);
      table.movement_mm.push_back(0.0 - value);
    }
    out.push_back(std::move(table));
  }
  return out;
}

std::string heidenhainCompensation(const AxisComponentTable& table, const std::optional<MeasuredBox>& measured) {
  requirePositions(table, 256);  // TNC 407/415/425, module 9095: a table has at most 256 entries
  const std::array<bool, 6> known = knownErrors(table, measured);
  const double distance_mm = table.position_mm[1] - table.position_mm[0];
  std::string header;
  std::vector<std::size_t> columns;
  for (std::size_t of = 0; of < 3; ++of) {
    if (!known[of] || !movesSomething(table, of)) continue;
    columns.push_back(of);
    header += fmt::format(",{}_mm", axes[of]);
    for (std::size_t row = 1; row < table.position_mm.size(); ++row) {
      const double step_mm = deviation_mm(table, row, of) - deviation_mm(table, row - 1, of);
      if (std::abs(step_mm) > distance_mm / 64.0) {
        throw InputError(
            fmt::format("E{}{} changes by {:.4g} mm from {:g} to {:g} mm; allowed from one point to the next: 1/64 of "
                        "their distance.",
                        axes[of], table.axis, step_mm, table.position_mm[row - 1], table.position_mm[row]));
      }
    }
  }
  if (columns.empty()) return {};
  std::string text = fmt::format(
      "# values of a compensation value table (.COM) over the position of {0}, to be entered in the control's table\n"
      "# editor and assigned to {0} in the .CMA: X = F({0}), Y = F({0}), Z = F({0})\n"
      "# value = error (actual minus commanded) in mm, zero at the first position: positive where the axis travels "
      "too\n"
      "# far (HEIDENHAIN Technical Manual TNC 407/415/425, 1.6.3 and 1.6.4). Check one value with one move before the\n"
      "# table is used; datum {1:g} mm, distance {2:g} mm, {3} points\n"
      "{4}AXISPOS_mm",
      table.axis, table.position_mm.front(), distance_mm, table.position_mm.size(),
      measured ? fmt::format("# {} {}\n", table.axis, measured->extentAlong(static_cast<int>(numberOf(table)))) : "");
  text += header + '\n';
  for (std::size_t row = 0; row < table.position_mm.size(); ++row) {
    text += fmt::format("{:.6f}", table.position_mm[row]);
    for (const std::size_t of : columns)
      text += fmt::format(",{:.6f}", 0.0 + deviation_mm(table, row, of) - deviation_mm(table, 0, of));
    text += '\n';
  }
  return text;
}

std::vector<ControlTable> readHeidenhainTable(const std::string& text, const std::string& file) {
  const std::string over = "over the position of ";
  const std::size_t at = text.find(over);
  const SourcePlace first = SourcePlace::atLine(file, 1);
  if (at == std::string::npos) throw InputError(first, "does not say over which axis its values are.");
  const char base = axisIn(std::string_view(text).substr(at + over.size(), 1), first);
  const CsvTable csv = CsvTable::parse(text, file);
  const std::vector<double> position_mm = csv.numbers("AXISPOS_mm");
  std::vector<ControlTable> out;
  for (const std::string& name : csv.columnNames()) {
    if (name == "AXISPOS_mm") continue;
    ControlTable table{base, axisIn(name, first), position_mm, {}};
    for (const double error_mm : csv.numbers(name)) table.movement_mm.push_back(0.0 - error_mm);
    out.push_back(std::move(table));
  }
  return out;
}

FanucPoints FanucPoints::over(const LinearAxis& axis, int count, int first_number) {
  SPINDRIFT_ASSERT(count >= 2, "a table has two positions or more");
  FanucPoints points;
  // A whole number of micrometres, so that the parameter can hold it.
  points.interval_mm = std::ceil((axis.travel_mm[1] - axis.travel_mm[0]) / (count - 1) * um_per_mm - 1e-6) * mm_per_um;
  const int low = std::min(0, static_cast<int>(std::floor(axis.travel_mm[0] / points.interval_mm + 1e-9)));
  const int high = std::max(0, static_cast<int>(std::ceil(axis.travel_mm[1] / points.interval_mm - 1e-9)));
  points.reference = first_number - low;
  points.first = points.reference + low + 1;
  points.last = points.reference + high;
  return points;
}

std::vector<double> FanucPoints::position_mm() const {
  std::vector<double> out;
  for (int number = first - 1; number <= last; ++number) out.push_back((number - reference) * interval_mm);
  return out;
}

std::string fanucPitchError(const AxisComponentTable& table, const FanucPoints& points, FanucStep step,
                            double detection_unit_um, const std::optional<MeasuredBox>& measured) {
  constexpr int most_numbers = 1023;
  const std::size_t axis = numberOf(table);
  if (!(detection_unit_um > 0.0) || !std::isfinite(detection_unit_um)) {
    throw InputError(fmt::format("a detection unit of {:g} µm is not allowed; allowed: above 0.", detection_unit_um));
  }
  if (points.first < 0 || points.last > most_numbers) {
    throw InputError(fmt::format("points {} to {} of {} are not allowed; allowed: 0 to 1023.", points.first,
                                 points.last, table.axis));
  }
  const std::vector<double> ends_mm = points.position_mm();
  SPINDRIFT_ASSERT(table.position_mm.size() == ends_mm.size(), "the deviation at the ends of all sections");
  const double sign = step == FanucStep::Positive ? -1.0 : 1.0;
  const auto units = [&](std::size_t row) {
    return std::lround(sign * table.deviation[row][axis] / detection_unit_um);
  };
  std::string data;
  long largest = 0;
  for (std::size_t row = 1; row < ends_mm.size(); ++row) {
    const long value = units(row) - units(row - 1);
    if (value < -128 || value > 127) {
      throw InputError(
          fmt::format("the compensation of {} changes by {} detection units from {:g} to {:g} mm; allowed in pitch "
                      "error data: -128 to 127.",
                      table.axis, value, ends_mm[row - 1], ends_mm[row]));
    }
    largest = std::max(largest, std::abs(value));
    data += fmt::format("N{} R{}\n", 10000 + points.first + static_cast<int>(row) - 1, value);
  }
  std::string extent;  // controls read capitals and no semicolon, which ends a block
  if (measured) {
    extent = fmt::format("({} MEASURED FROM {:g} TO {:g} MM, BEYOND THAT EXTRAPOLATED)\n", table.axis,
                         measured->low_mm[static_cast<Eigen::Index>(axis)],
                         measured->high_mm[static_cast<Eigen::Index>(axis)]);
  }
  return fmt::format(
             "%\n"
             "O{0}(PITCH ERROR DATA OF {1})\n"
             "(AXIS {1})\n"
             "(REFERENCE {2} PARAMETER 3620)\n"
             "(FIRST {3} PARAMETER 3621)\n"
             "(LAST {4} PARAMETER 3622)\n"
             "(MAGNIFICATION 1 PARAMETER 3623)\n"
             "(INTERVAL {5} MM PARAMETER 3624)\n"
             "(UNIT {6} MICROMETRES, DETECTION UNIT)\n"
             "(STEP {7} IS THE DIRECTION A POSITIVE VALUE MOVES THE AXIS, AS TRIED ON THIS MACHINE)\n"
             "(STEPS FROM ONE POINT TO THE NEXT, LARGEST {8}: SOME CONTROLS TAKE -7 TO 7 ONLY)\n"
             "(THESE VALUES STAND IN PLACE OF THOSE IN THE CONTROL. SAVE THOSE FIRST, AND ADD THEM WHERE THEY ARE TO "
             "HOLD)\n"
             "{9}G10 L50\n",
             8911 + axis, table.axis, points.reference, points.first, points.last, points.interval_mm,
             detection_unit_um, step == FanucStep::Positive ? "PLUS" : "MINUS", largest, extent) +
         data + "G11\nM30\n%\n";
}

ControlTable readFanucPitchError(const std::string& text, const std::string& file) {
  FanucLines found;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const SourcePlace place = SourcePlace::atLine(file, ++number);
    std::string value;
    if (commentValue(line, "AXIS", value)) found.axis = axisIn(value, place);
    if (commentValue(line, "REFERENCE", value)) found.reference = countIn(value, place);
    if (commentValue(line, "INTERVAL", value)) found.interval_mm = numberIn(value, place);
    if (commentValue(line, "UNIT", value)) found.unit_um = numberIn(value, place);
    if (commentValue(line, "STEP", value)) found.sign = value == "PLUS" ? 1 : value == "MINUS" ? -1 : 0;
    const std::size_t data = line.find(" R");
    if (line.empty() || line[0] != 'N' || data == std::string::npos) continue;
    const int point = countIn(line.substr(1, data - 1), place) - 10000;
    const double steps = numberIn(line.substr(data + 2), place);
    if (steps != std::round(steps) || steps < -128.0 || steps > 127.0)
      throw InputError(place, fmt::format("{} is not allowed; allowed: -128 to 127.", line.substr(data + 2)));
    found.steps[point] = static_cast<int>(steps);
  }
  if (found.axis == '\0' || found.reference < 0 || !(found.interval_mm > 0.0) || !(found.unit_um > 0.0) ||
      found.sign == 0 || found.steps.empty()) {
    throw InputError({file, ""}, "lacks its axis, its values or what its head says of them.");
  }
  // What is put out between the reference position and a point; there it is nothing.
  ControlTable table{found.axis, found.axis, {}, {}};
  const auto put_out = [&](int until) {
    int sum = 0;
    for (const auto& [point, steps] : found.steps) {
      if (point > found.reference && point <= until) sum += steps;
      if (point <= found.reference && point > until) sum -= steps;
    }
    return sum * found.sign * found.unit_um * mm_per_um;
  };
  for (int end = found.steps.begin()->first - 1; end <= found.steps.rbegin()->first; ++end) {
    table.position_mm.push_back((end - found.reference) * found.interval_mm);
    table.movement_mm.push_back(put_out(end));
  }
  return table;
}

}  // namespace spindrift
