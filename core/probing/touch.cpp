// SPDX-License-Identifier: Apache-2.0
#include "core/probing/touch.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

std::vector<std::string> distinct(const std::vector<Touch>& touches, std::string Touch::*member) {
  std::vector<std::string> names;
  std::unordered_set<std::string> seen;
  for (const Touch& t : touches) {
    if (seen.insert(t.*member).second) names.push_back(t.*member);
  }
  return names;
}

/// How far balls lie from their certificate after the best turn and shift, mm rms: right-handed, and as in a mirror.
struct Handedness {
  double turned_mm = 0.0;
  double mirrored_mm = 0.0;
};
/// What the best turn and shift leave, rms (Umeyama 1991), mm.
double rmsWhereTurned(const Eigen::Matrix3Xd& certified_mm, const Eigen::Matrix3Xd& found_mm) {
  const Eigen::Isometry3d turn(Eigen::umeyama(certified_mm, found_mm, false));
  return std::sqrt((turn * certified_mm - found_mm).squaredNorm() / static_cast<double>(found_mm.cols()));
}
/// Balls in one plane fit equally well either way.
Handedness handednessOf(const std::vector<Eigen::Vector3d>& certified_mm,
                        const std::vector<Eigen::Vector3d>& found_mm) {
  const auto columns = [](const std::vector<Eigen::Vector3d>& points) {
    return Eigen::Matrix3Xd(
        Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, static_cast<Eigen::Index>(points.size())));
  };
  if (found_mm.empty()) return {};
  const Eigen::Matrix3Xd certified = columns(certified_mm);
  const Eigen::Matrix3Xd found = columns(found_mm);
  return {rmsWhereTurned(certified, found), rmsWhereTurned(-certified, found)};
}

}  // namespace

double TableAngles::placeOf(double c_deg) {
  constexpr double parts = 1e6;
  const long long half = std::llround(180.0 * parts);
  long long left = std::llround(std::remainder(c_deg, 360.0) * parts);
  if (left == -half) left = half;
  return first_.try_emplace(left, c_deg).first->second;
}

std::string Touch::label() const {
  std::string text = fmt::format("{} {}/{} {} at {} deg, touch {}", cycle, artefact, feature, stylus, c_deg, touch);
  if (line > 0) text += fmt::format(" (line {})", line);
  return text;
}

std::string Touch::id() const {
  return fmt::format("touch/{}/{}/{}/{}/{:g}/{}", cycle, artefact, feature, stylus, c_deg, touch);
}

std::vector<std::string> featureNames(const Artefact& artefact) {
  std::vector<std::string> names;
  if (artefact.kind == "hole_bar") {
    for (std::size_t i = 0; i < artefact.nominal_positions_mm.size(); ++i) names.push_back(fmt::format("H{}", i + 1));
  } else {
    for (const ArtefactBall& ball : artefact.balls) names.push_back(ball.id);
  }
  return names;
}

TouchList TouchList::read(const std::filesystem::path& file) {
  return parse(readFile(file), file);
}

TouchList TouchList::parse(std::string text, const std::filesystem::path& file) {
  const CsvTable table = CsvTable::parse(std::move(text), file);
  TouchList list;
  list.file = file;
  const std::size_t time = table.column("time_s");
  const std::size_t cycle = table.column("cycle");
  const std::size_t artefact = table.column("artefact");
  const std::size_t feature = table.column("feature");
  const std::size_t stylus = table.column("stylus");
  const std::size_t c_deg = table.column("c_deg");
  const std::size_t touch = table.column("touch");
  const std::size_t position[] = {table.column("x_mm"), table.column("y_mm"), table.column("z_mm")};
  const std::size_t normal[] = {table.column("nx"), table.column("ny"), table.column("nz")};
  if (table.rowCount() == 0) throw InputError({file, ""}, "holds no touches; allowed: at least one row.");
  std::map<std::string, double, std::less<>> last_time;
  std::unordered_set<std::string> keys;
  const auto isNew = [&](const Touch& t) {
    return keys.insert(fmt::format("{}|{}|{}|{}|{}|{}", t.cycle, t.artefact, t.feature, t.stylus, t.c_deg, t.touch))
        .second;
  };
  TableAngles angles;
  list.touches.reserve(table.rowCount());
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    Touch t;
    t.time_s = table.number(row, time);
    t.cycle = table.requiredText(row, cycle);
    t.artefact = table.requiredText(row, artefact);
    t.feature = table.requiredText(row, feature);
    t.stylus = table.requiredText(row, stylus);
    t.c_deg = table.number(row, c_deg);
    if (std::abs(t.c_deg) > most_turned_deg) {
      throw InputError(table.place(row, c_deg),
                       fmt::format("a table angle of {:g}° is not allowed; allowed: {:g} to {:g}°.", t.c_deg,
                                   -most_turned_deg, most_turned_deg));
    }
    const double number = table.number(row, touch);
    if (number < 0.0 || number > 1e6 || number != std::floor(number)) {
      throw InputError(table.place(row, touch),
                       fmt::format("touch number {} is not allowed; allowed: 0, 1, 2, ...", table.text(row, touch)));
    }
    t.touch = static_cast<int>(number);
    for (int k = 0; k < 3; ++k) {
      t.position_mm(k) = table.number(row, position[k]);
      t.approach(k) = table.number(row, normal[k]);
    }
    const double length = t.approach.norm();
    if (length == 0.0) {
      throw InputError(table.place(row, normal[0]),
                       "approach direction (0, 0, 0) is not allowed; allowed: a unit vector towards the material.");
    }
    if (std::abs(length - 1.0) > 0.01) {
      throw InputError(table.place(row, normal[0]),
                       fmt::format("approach direction ({}, {}, {}) has length {:.4g}; allowed: a unit vector.",
                                   t.approach.x(), t.approach.y(), t.approach.z(), length));
    }
    t.approach /= length;
    const auto [last, first] = last_time.try_emplace(t.artefact, t.time_s);
    if (!first && t.time_s < last->second) {
      throw InputError(table.place(row, time),
                       fmt::format("time of artefact {} runs backwards from {} s to {} s; allowed: touches of an "
                                   "artefact in order of time.",
                                   t.artefact, last->second, t.time_s));
    }
    if (!first && t.time_s == last->second) {
      throw InputError(
          table.place(row, time),
          fmt::format("duplicate time {} s of artefact {}; allowed: one touch at a time.", t.time_s, t.artefact));
    }
    last->second = t.time_s;
    const double written_deg = std::exchange(t.c_deg, angles.placeOf(t.c_deg));
    const bool at_place = isNew(t);
    if (!at_place) t.c_deg = written_deg;
    if (!at_place && (t.c_deg == angles.placeOf(written_deg) || !isNew(t))) {
      throw InputError(
          table.place(row),
          fmt::format(
              "duplicate touch {} of {} with stylus {} at {}° in cycle {}; allowed: every touch of a cycle once.",
              t.touch, t.feature, t.stylus, printed(t.c_deg), t.cycle));
    }
    t.line = table.place(row).line;
    list.touches.push_back(std::move(t));
  }
  return list;
}

void TouchList::checkAgainst(const MachineDescription& machine) const {
  const auto place = [&](const Touch& t, const char* column) {
    return SourcePlace::atLine(file, t.line, t.line > 0 ? fmt::format("column {}", column) : std::string());
  };
  double largest = 0.0;
  double smallest_travel = 0.0;
  for (const LinearAxis& axis : machine.axes) {
    smallest_travel = std::max(smallest_travel, std::abs(axis.travel_mm[1] - axis.travel_mm[0]));
  }
  for (const Touch& t : touches) {
    const Artefact* artefact = machine.findArtefact(t.artefact);
    if (artefact == nullptr) {
      throw InputError(place(t, "artefact"), fmt::format("artefact \"{}\" is not in the machine file; allowed: {}.",
                                                         t.artefact, allowedIds(machine.artefacts)));
    }
    if (machine.findStylus(t.stylus) == nullptr) {
      throw InputError(place(t, "stylus"),
                       fmt::format("stylus \"{}\" is not in the machine file, so its radius is unknown; allowed: {}.",
                                   t.stylus, allowedIds(machine.styli)));
    }
    const std::vector<std::string> names = featureNames(*artefact);
    if (std::find(names.begin(), names.end(), t.feature) == names.end()) {
      throw InputError(place(t, "feature"), fmt::format("feature \"{}\" is not on artefact {}; allowed: {}.", t.feature,
                                                        t.artefact, joinedList(names, "or")));
    }
    largest = std::max(largest, t.position_mm.cwiseAbs().maxCoeff());
  }
  if (smallest_travel > 0.0 && largest > 10.0 * smallest_travel && largest < 2000.0 * smallest_travel) {
    throw InputError({file, ""},
                     fmt::format("positions reach {:.6g} although the longest travel is {:.6g} mm; allowed: "
                                 "millimetres (are these micrometres?).",
                                 largest, smallest_travel));
  }
  // Distances between features tell millimetres from inches whatever the zero point is.
  std::vector<double> ratios;
  std::string mirrored;
  for (const std::string& id : artefacts()) {
    const Artefact& artefact = *machine.findArtefact(id);
    const std::vector<std::string> names = featureNames(artefact);
    std::map<std::string, std::pair<Eigen::Vector3d, int>> centres;
    const Touch* first = nullptr;
    for (const Touch& t : touches) {
      if (t.artefact != id) continue;
      if (first == nullptr) first = &t;
      if (t.cycle != first->cycle || t.c_deg != first->c_deg || t.stylus != first->stylus) continue;
      auto& [sum, count] = centres.try_emplace(t.feature, Eigen::Vector3d::Zero(), 0).first->second;
      sum += t.position_mm;
      ++count;
    }
    const auto nominal = [&](const std::string& name) -> Eigen::Vector3d {
      const auto index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
      if (artefact.kind == "balls") return artefact.balls[index].certified_mm;
      return artefact.nominal_positions_mm[index] * artefact.direction_at_c0;
    };
    for (auto a = centres.begin(); a != centres.end(); ++a) {
      for (auto b = std::next(a); b != centres.end(); ++b) {
        const double expected = (nominal(a->first) - nominal(b->first)).norm();
        const double measured = (a->second.first / a->second.second - b->second.first / b->second.second).norm();
        if (expected > 0.0) ratios.push_back(measured / expected);
      }
    }
    if (artefact.kind != "balls") continue;
    std::vector<Eigen::Vector3d> certified;
    std::vector<Eigen::Vector3d> found;
    for (const auto& [name, sum] : centres) {
      certified.push_back(nominal(name));
      found.emplace_back(sum.first / sum.second);
    }
    const Handedness hand = handednessOf(certified, found);
    constexpr double clear = 10.0;  // a knocked or swapped ball fits neither way
    if (found.size() >= 4 && hand.turned_mm > 1.0 && clear * hand.mirrored_mm < hand.turned_mm) {
      mirrored = fmt::format(
          "the balls of {} lie as in a mirror: {:.3g} mm from the certificate, {:.3g} mm from its mirror image, so two "
          "columns are swapped or one has the wrong sign; allowed: x_mm, y_mm and z_mm of a right-handed system, as "
          "certified_mm in the machine file.",
          id, hand.turned_mm, hand.mirrored_mm);
    }
  }
  if (!ratios.empty()) {
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    const double ratio = ratios[ratios.size() / 2];
    const auto times = [&](double factor) { return std::abs(ratio / factor - 1.0) < 0.1; };
    constexpr double mm_per_metre = 1e3;
    if (times(1.0 / mm_per_inch)) {
      throw InputError({file, ""},
                       "distances between features are 25.4 times too small, so positions look like inches; allowed: "
                       "millimetres.");
    }
    if (times(mm_per_inch)) {
      throw InputError({file, ""},
                       "distances between features are 25.4 times too large: the machine file looks like inches; "
                       "allowed: millimetres in both files.");
    }
    if (times(1.0 / mm_per_metre)) {
      throw InputError({file, ""},
                       "distances between features are 1000 times too small, so positions look like metres; allowed: "
                       "millimetres.");
    }
    if (times(mm_per_metre)) {
      throw InputError({file, ""},
                       "distances between features are 1000 times too large: the machine file looks like metres; "
                       "allowed: millimetres in both files.");
    }
  }
  if (!mirrored.empty()) throw InputError({file, ""}, mirrored);
}

std::string TouchList::csv() const {
  std::string text = "time_s,cycle,artefact,feature,stylus,c_deg,touch,x_mm,y_mm,z_mm,nx,ny,nz\n";
  for (const Touch& t : touches) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", exactNumber(t.time_s), csvField(t.cycle),
                        csvField(t.artefact), csvField(t.feature), csvField(t.stylus), exactNumber(t.c_deg), t.touch,
                        exactNumber(t.position_mm.x()), exactNumber(t.position_mm.y()), exactNumber(t.position_mm.z()),
                        exactNumber(t.approach.x()), exactNumber(t.approach.y()), exactNumber(t.approach.z()));
  }
  return text;
}

std::vector<std::string> TouchList::cycles() const {
  return distinct(touches, &Touch::cycle);
}
std::vector<std::string> TouchList::artefacts() const {
  return distinct(touches, &Touch::artefact);
}

}  // namespace spindrift
