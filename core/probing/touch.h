// SPDX-License-Identifier: Apache-2.0
// Touches of a touch-trigger probe: captures/touches.csv (FORMATS.md).
//
// A touch is the machine position of the stylus centre when the probe triggered, mm in MCF, and the direction in which
// it approached the material (unit vector). A probe reads true position minus deviation.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/text.h"
#include "core/machine/machine_description.h"

namespace spindrift {

/// A table that counts on has turned no further than this; larger angles are no angles.
inline constexpr double most_turned_deg = 36000.0;

/// Table angles of places: a table that counts on has the same place with whole turns between, and touches of one place
/// have one angle, the first that was seen of it. Whole turns alone are 0.
class TableAngles {
 public:
  [[nodiscard]] double placeOf(double c_deg);

 private:
  std::map<long long, double> first_{{0, 0.0}};  ///< by what is left without whole turns, in 1e-6 deg
};

struct Touch {
  double time_s = 0.0;  ///< since the campaign start
  std::string cycle;    ///< "M0", "M1", ...
  std::string artefact;
  std::string feature;  ///< "H1", "B2"
  std::string stylus;
  double c_deg = 0.0;  ///< rotation of the table, right-handed about its axis
  int touch = 0;       ///< number within the feature
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d approach = Eigen::Vector3d::UnitX();  ///< unit, towards the material
  std::size_t line = 0;                                 ///< line of the file, 0 if not from a file

  /// "M3 H2 at 90 deg, touch 4 (line 118)".
  [[nodiscard]] std::string label() const;
  /// The same touch in any cycle: feature, stylus, table angle, number.
  using Key = std::tuple<std::string, std::string, double, int>;
  [[nodiscard]] Key key() const { return {feature, stylus, c_deg, touch}; }
  /// What exclusions call it: "touch/M3/bar/H2/p0/90/4".
  [[nodiscard]] std::string id() const;
};

struct TouchList {
  std::vector<Touch> touches;
  std::filesystem::path file;

  /// Reads and checks the list on its own: columns, finite numbers, approach vectors of length one, time that increases
  /// within an artefact, no touch twice. Angles are those of places (TableAngles), unless a cycle has a place at both.
  /// Throws InputError.
  [[nodiscard]] static TouchList read(const std::filesystem::path& file);
  /// The same from text; `name` stands for the file in messages.
  [[nodiscard]] static TouchList parse(std::string text, const std::filesystem::path& name);
  /// Checks against the machine: artefact, feature and stylus are known, positions can be millimetres inside the travel
  /// (readings in inches are named as such). Throws InputError.
  void checkAgainst(const MachineDescription& machine) const;
  /// Text of touches.csv.
  [[nodiscard]] std::string csv() const;

  /// Cycles in order of first appearance; the first one is the reference state.
  [[nodiscard]] std::vector<std::string> cycles() const;
  /// Artefacts in order of first appearance.
  [[nodiscard]] std::vector<std::string> artefacts() const;
};

/// "bar or tower": the ids of described artefacts or styli, for sentences about one that is not among them.
template <typename List>
[[nodiscard]] std::string allowedIds(const List& list) {
  std::vector<std::string> ids;
  for (const auto& item : list) ids.push_back(item.id);
  return ids.empty() ? std::string("none is described") : joinedList(ids, "or");
}

/// Features of an artefact in order: "H1", "H2", ... or the ids of its balls.
[[nodiscard]] std::vector<std::string> featureNames(const Artefact& artefact);

}  // namespace spindrift
