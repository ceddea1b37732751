// SPDX-License-Identifier: Apache-2.0
#include "core/machine/observation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/machine/observation_plausibility.h"

namespace spindrift {
namespace {

std::filesystem::path covarianceFile(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + ".cov.csv");
}

std::vector<double> sigmasOf(const std::vector<Observation>& rows) {
  std::vector<double> sigmas;
  for (const Observation& row : rows) sigmas.push_back(row.sigma);
  return sigmas;
}

std::vector<std::string> distinct(const std::vector<Observation>& rows, std::string Observation::*member) {
  std::vector<std::string> names;
  std::unordered_set<std::string> seen;
  for (const Observation& row : rows) {
    if (seen.insert(row.*member).second) names.push_back(row.*member);
  }
  return names;
}

ObservationUse parseUse(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string_view text = table.text(row, column);
  if (text.empty() || text == "fit") return ObservationUse::Fit;
  if (text == "holdout") return ObservationUse::Holdout;
  if (text == "exclude") return ObservationUse::Exclude;
  throw InputError(table.place(row, column),
                   fmt::format("use \"{}\" is not known; allowed: fit, holdout or exclude.", text));
}

}  // namespace

std::string_view toString(ObservationUse use) noexcept {
  switch (use) {
    case ObservationUse::Fit:
      return "fit";
    case ObservationUse::Holdout:
      return "holdout";
    case ObservationUse::Exclude:
      return "exclude";
  }
  return "fit";
}

ObservationSet ObservationSet::parse(std::string text, const std::filesystem::path& name) {
  return fromTable(CsvTable::parse(std::move(text), name));
}

ObservationSet ObservationSet::fromTable(const CsvTable& table) {
  ObservationSet set;
  set.file = table.file();
  const std::size_t time = table.column("time_s");
  const std::size_t state = table.column("state");
  const std::size_t point = table.column("point");
  const std::array<std::size_t, 3> position{table.column("x_mm"), table.column("y_mm"), table.column("z_mm")};
  const std::size_t component = table.column("component");
  const std::size_t value = table.column("value");
  const std::size_t sigma = table.column("sigma");
  const auto optionalColumn = [&](std::string_view name) {
    return table.hasColumn(name) ? std::optional(table.column(name)) : std::nullopt;
  };
  const auto c_deg = optionalColumn("c_deg");
  const auto instrument = optionalColumn("instrument");
  const auto use = optionalColumn("use");
  const std::array<std::optional<std::size_t>, 3> approach{optionalColumn("dir_x"), optionalColumn("dir_y"),
                                                           optionalColumn("dir_z")};
  const std::array<std::optional<std::size_t>, 3> tool{optionalColumn("tool_x_mm"), optionalColumn("tool_y_mm"),
                                                       optionalColumn("tool_z_mm")};
  std::unordered_map<std::string, double> last_time;
  std::unordered_set<std::string> keys;
  set.rows.reserve(table.rowCount());
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    Observation o;
    o.time_s = table.number(row, time);
    o.state = std::string(table.text(row, state));
    o.point = table.requiredText(row, point);
    for (int axis = 0; axis < 3; ++axis) o.position_mm[axis] = table.number(row, position[axis]);
    const auto parsed = componentFromString(table.text(row, component));
    if (!parsed) {
      throw InputError(table.place(row, component), fmt::format("component \"{}\" is not known; allowed: EX, EY, EZ, "
                                                                "EA, EB or EC.",
                                                                table.text(row, component)));
    }
    o.component = *parsed;
    o.value = table.number(row, value);
    o.sigma = table.number(row, sigma);
    if (!(o.sigma > 0.0)) {
      throw InputError(table.place(row, sigma),
                       fmt::format("sigma {} is not allowed; allowed: a standard uncertainty greater than zero, in {}.",
                                   table.text(row, sigma), printedUnit(unitOf(o.component))));
    }
    if (c_deg && !table.empty(row, *c_deg)) o.c_deg = table.number(row, *c_deg);
    if (instrument) o.instrument = std::string(table.text(row, *instrument));
    if (use) o.use = parseUse(table, row, *use);
    for (int axis = 0; axis < 3; ++axis) {
      if (approach[axis] && !table.empty(row, *approach[axis])) {
        o.approach[axis] = table.number(row, *approach[axis]);
        if (o.approach[axis] != -1.0 && o.approach[axis] != 0.0 && o.approach[axis] != 1.0) {
          throw InputError(
              table.place(row, *approach[axis]),
              fmt::format("direction {} is not allowed; allowed: -1, 0 or +1.", table.text(row, *approach[axis])));
        }
      }
      if (tool[axis] && !table.empty(row, *tool[axis])) o.tool_offset_mm[axis] = table.number(row, *tool[axis]);
    }
    const auto [last, first_of_point] = last_time.try_emplace(o.point, o.time_s);
    if (!first_of_point && o.time_s < last->second) {
      throw InputError(
          table.place(row, time),
          fmt::format("time of point {} runs backwards from {} s to {} s; allowed: rows of a point in order "
                      "of time.",
                      o.point, last->second, o.time_s));
    }
    last->second = o.time_s;
    std::string key =
        fmt::format("{}|{}|{}|{}|{}", o.time_s, o.state, o.point, static_cast<int>(o.component), o.instrument);
    key += fmt::format("|{},{},{},{}|{},{},{}|{},{},{}", o.position_mm.x(), o.position_mm.y(), o.position_mm.z(),
                       o.c_deg, o.approach.x(), o.approach.y(), o.approach.z(), o.tool_offset_mm.x(),
                       o.tool_offset_mm.y(), o.tool_offset_mm.z());
    if (!keys.insert(std::move(key)).second) {
      throw InputError(table.place(row),
                       fmt::format("duplicate {} of point {} at {} s; allowed: one row per observation.",
                                   toString(o.component), o.point, o.time_s));
    }
    set.rows.push_back(std::move(o));
  }
  for (const ImplausibleReading& reading : implausibleReadings(set))
    throw InputError(table.place(reading.rows.front(), value), reading.sentence);
  return set;
}

ObservationSet ObservationSet::read(const std::filesystem::path& file) {
  ObservationSet set = fromTable(CsvTable::read(file));
  const std::filesystem::path covariance_file = covarianceFile(file);
  if (std::filesystem::exists(covariance_file)) {
    const CsvTable entries = CsvTable::read(covariance_file);
    const std::array<std::size_t, 2> index{entries.column("row"), entries.column("column")};
    const std::size_t number = entries.column("covariance");
    std::vector<CovarianceEntry> stated;
    std::map<std::pair<std::size_t, std::size_t>, std::pair<double, std::size_t>> known;  // value and its entry
    for (std::size_t i = 0; i < entries.rowCount(); ++i) {
      std::array<std::size_t, 2> rc{};
      for (int k = 0; k < 2; ++k) {
        const double n = entries.number(i, index[k]);
        if (n < 1.0 || n > static_cast<double>(set.rows.size()) ||
            n != static_cast<double>(static_cast<std::size_t>(n))) {
          throw InputError(entries.place(i, index[k]),
                           fmt::format("row number {} is not allowed; allowed: 1 to {} (rows of {}).",
                                       entries.text(i, index[k]), set.rows.size(), file.filename().string()));
        }
        rc[k] = static_cast<std::size_t>(n) - 1;
      }
      const double covariance = entries.number(i, number);
      if (rc[0] == rc[1] && !(covariance > 0.0)) {
        throw InputError(entries.place(i, number),
                         fmt::format("variance {} of row {} is not allowed; allowed: greater than zero.",
                                     entries.text(i, number), entries.text(i, index[0])));
      }
      // One pair may be given as (r, c) and as (c, r), not as two values.
      const auto [before, fresh] = known.try_emplace(std::minmax(rc[0], rc[1]), covariance, i);
      if (!fresh && before->second.first != covariance) {
        throw InputError(entries.place(i, number),
                         fmt::format("covariance {} of rows {} and {} is not allowed: entry {} gives {}; allowed: one "
                                     "value for a pair.",
                                     entries.text(i, number), entries.text(i, index[0]), entries.text(i, index[1]),
                                     before->second.second + 1, entries.text(before->second.second, number)));
      }
      stated.push_back({rc[0], rc[1], covariance});
    }
    // Variances may stand anywhere in the file: correlations are judged when all are known.
    const auto variance = [&](std::size_t row) {
      const auto own = known.find({row, row});
      return own == known.end() ? set.rows[row].sigma * set.rows[row].sigma : own->second.first;
    };
    for (const auto& [pair, entry] : known) {
      constexpr double rounding = 1e-6;
      const double most = std::sqrt(variance(pair.first) * variance(pair.second));
      if (pair.first == pair.second || std::abs(entry.first) <= (1.0 + rounding) * most) continue;
      throw InputError(entries.place(entry.second, number),
                       fmt::format("covariance {} of rows {} and {} is not allowed; allowed: -{:.6g} to {:.6g}, the "
                                   "product of their standard uncertainties.",
                                   entries.text(entry.second, number), pair.first + 1, pair.second + 1, most, most));
    }
    set.setCovariances(stated);
  }
  return set;
}

std::string ObservationSet::csv() const {
  const bool with_approach =
      std::any_of(rows.begin(), rows.end(), [](const Observation& o) { return !o.approach.isZero(0.0); });
  const bool with_tool =
      std::any_of(rows.begin(), rows.end(), [](const Observation& o) { return !o.tool_offset_mm.isZero(0.0); });
  std::string text = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use";
  if (with_approach) text += ",dir_x,dir_y,dir_z";
  if (with_tool) text += ",tool_x_mm,tool_y_mm,tool_z_mm";
  text += '\n';
  for (const Observation& o : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", exactNumber(o.time_s), csvField(o.state),
                        csvField(o.point), exactNumber(o.position_mm.x()), exactNumber(o.position_mm.y()),
                        exactNumber(o.position_mm.z()), exactNumber(o.c_deg), toString(o.component),
                        exactNumber(o.value), exactNumber(o.sigma), csvField(o.instrument), toString(o.use));
    const auto three = [&](const Eigen::Vector3d& v) {
      text += fmt::format(",{},{},{}", exactNumber(v.x()), exactNumber(v.y()), exactNumber(v.z()));
    };
    if (with_approach) three(o.approach);
    if (with_tool) three(o.tool_offset_mm);
    text += '\n';
  }
  return text;
}

void ObservationSet::write(const std::filesystem::path& target) const {
  const std::vector<CovarianceEntry> covariances = shared.covariances(sigmasOf(rows));
  if (!covariances.empty()) {
    std::string text = "row,column,covariance\n";
    for (const CovarianceEntry& entry : covariances) {
      text += fmt::format("{},{},{}\n", entry.row + 1, entry.column + 1, entry.covariance);
    }
    writeFileAtomically(covarianceFile(target), text);
  } else if (std::filesystem::is_regular_file(covarianceFile(target))) {
    // A covariance left over from an earlier evaluation would belong to other rows.
    std::filesystem::remove(covarianceFile(target));
  }
  writeFileAtomically(target, csv());
}

void ObservationSet::setCovariances(const std::vector<CovarianceEntry>& entries) {
  CovarianceSplit split = splitCovariance(sigmasOf(rows), entries);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].sigma = split.sigma[i];
  shared.clear();
  for (NoiseFactor& factor : split.factors) shared.addFactor(std::move(factor));
}

void ObservationSet::append(const ObservationSet& other) {
  shared.append(other.shared, rows.size());
  rows.insert(rows.end(), other.rows.begin(), other.rows.end());
}

std::vector<std::string> ObservationSet::states() const {
  return distinct(rows, &Observation::state);
}
std::vector<std::string> ObservationSet::points() const {
  return distinct(rows, &Observation::point);
}

}  // namespace spindrift
