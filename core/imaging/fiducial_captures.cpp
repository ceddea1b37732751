// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/fiducial_captures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/base/csv.h"
#include "core/base/inside_folder.h"

namespace spindrift {
namespace {

constexpr std::array<std::pair<std::string_view, CaptureRole>, 4> roles{{{"rotation", CaptureRole::Rotation},
                                                                         {"x_axis", CaptureRole::XAxis},
                                                                         {"y_axis", CaptureRole::YAxis},
                                                                         {"focus", CaptureRole::Focus}}};

std::vector<std::string> distinct(const std::vector<FiducialCapture>& captures, std::string FiducialCapture::*member) {
  std::vector<std::string> names;
  for (const FiducialCapture& c : captures) {
    if (std::find(names.begin(), names.end(), c.*member) == names.end()) names.push_back(c.*member);
  }
  return names;
}

/// Images along one axis that by the list move along the other one: two columns are swapped, or the roles.
void requireMovementAlongTheAxis(const FiducialCaptureList& list, const std::vector<SourcePlace>& places) {
  std::map<std::tuple<std::string, std::string, CaptureRole>, std::vector<std::size_t>> sets;
  for (std::size_t i = 0; i < list.captures.size(); ++i) {
    const FiducialCapture& c = list.captures[i];
    if (c.role == CaptureRole::XAxis || c.role == CaptureRole::YAxis) sets[{c.state, c.fiducial, c.role}].push_back(i);
  }
  for (const auto& [key, members] : sets) {
    const auto& [state, fiducial, role] = key;
    const Eigen::Vector3d& from = list.captures[members.front()].position_mm;
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (const std::size_t i : members) moved = moved.cwiseMax((list.captures[i].position_mm - from).cwiseAbs());
    const int own = role == CaptureRole::XAxis ? 0 : 1;
    constexpr double clear = 10.0;
    constexpr double telling_mm = 0.01;
    if (!(moved(1 - own) > telling_mm && moved(1 - own) > clear * moved(own))) continue;
    throw InputError(
        places[members.back()],
        fmt::format("the images {} of {} in state {} move by {:.4g} mm along {} and by {:.4g} mm along "
                    "{}; allowed: a movement along {} (are two columns or the roles swapped?).",
                    toString(role), fiducial, state, moved(1 - own), "XY"[1 - own], moved(own), "XY"[own], "XY"[own]));
  }
}

}  // namespace

std::string_view toString(CaptureRole role) noexcept {
  return roles[static_cast<std::size_t>(role)].first;
}

std::optional<CaptureRole> captureRole(std::string_view name) noexcept {
  for (const auto& [text, role] : roles) {
    if (text == name) return role;
  }
  return std::nullopt;
}

std::vector<std::string> FiducialCaptureList::states() const {
  return distinct(captures, &FiducialCapture::state);
}
std::vector<std::string> FiducialCaptureList::fiducials() const {
  return distinct(captures, &FiducialCapture::fiducial);
}

FiducialCaptureList readFiducialCaptures(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file);
  FiducialCaptureList list;
  list.file = file;
  const std::size_t time = table.column("time_s");
  const std::size_t state = table.column("state");
  const std::size_t fiducial = table.column("fiducial");
  const std::size_t role = table.column("role");
  const std::size_t index = table.column("index");
  const std::array<std::size_t, 3> position{table.column("x_mm"), table.column("y_mm"), table.column("z_mm")};
  const std::size_t spindle = table.column("spindle_deg");
  const std::size_t image = table.column("image");
  InsideFolder folder(std::filesystem::absolute(file).parent_path().parent_path());
  std::map<std::string, double> last_time;
  std::map<std::tuple<std::string, std::string, CaptureRole, int>, std::size_t> seen;
  std::vector<SourcePlace> places;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    FiducialCapture c;
    c.time_s = table.number(row, time);
    c.state = table.requiredText(row, state);
    c.fiducial = table.requiredText(row, fiducial);
    const auto known =
        std::find_if(roles.begin(), roles.end(), [&](const auto& r) { return r.first == table.text(row, role); });
    if (known == roles.end()) {
      throw InputError(table.place(row, role), fmt::format("role \"{}\" is not known; allowed: rotation, x_axis, "
                                                           "y_axis or focus.",
                                                           table.text(row, role)));
    }
    c.role = known->second;
    const double number = table.number(row, index);
    if (number != std::floor(number) || std::abs(number) > 1e6) {
      throw InputError(table.place(row, index),
                       fmt::format("index {} is not allowed; allowed: a whole number.", table.text(row, index)));
    }
    c.index = static_cast<int>(number);
    for (int axis = 0; axis < 3; ++axis) {
      c.position_mm[axis] = table.number(row, position[static_cast<std::size_t>(axis)]);
    }
    c.spindle_deg = table.number(row, spindle);
    c.image = table.requiredText(row, image);
    (void)folder.path(c.image, table.place(row, image));
    const auto [last, first] = last_time.try_emplace(c.fiducial, c.time_s);
    if (!first && c.time_s < last->second) {
      throw InputError(
          table.place(row, time),
          fmt::format("time of fiducial {} runs backwards from {} s to {} s; allowed: rows of a fiducial in "
                      "order of time.",
                      c.fiducial, last->second, c.time_s));
    }
    last->second = c.time_s;
    const auto [same, unique] = seen.try_emplace({c.state, c.fiducial, c.role, c.index}, row);
    if (!unique) {
      throw InputError(table.place(row),
                       fmt::format("duplicate {} {} of fiducial {} in state {}, first in {}; allowed: one row each.",
                                   toString(c.role), c.index, c.fiducial, c.state, table.place(same->second).words()));
    }
    list.captures.push_back(std::move(c));
    places.push_back(table.place(row));
  }
  requireMovementAlongTheAxis(list, places);
  if (list.captures.empty()) throw InputError({file, ""}, "lists no image; allowed: at least one row.");
  return list;
}

}  // namespace spindrift
