// SPDX-License-Identifier: Apache-2.0
// Which part of the machine a temperature sensor tells of. `"role"` of machine.json says it, by its name or in words
// ("spindle", "Tisch"); without it, or where its words tell nothing, the name of the column, T_<name>_degC, is read,
// and what the name leaves open is read from `"place"`.
//
// Names are read by whole words in English and German: a text is split at '_', '-', blanks, signs, digits and where a
// small letter meets a capital; umlauts are read as ae, oe, ue. A word counts only as it stands in the vocabulary
// (sensor_role.cpp), alone or with a German ending of position or temperature ("Tischtemperatur", "Staendervorne"), so
// that neither "T_broom_degC" nor "T_tablet_degC" has a role. Words that are used of many parts (bearing, housing,
// head, air) count only where nothing but positions stands beside them. Words that contradict each other give `other`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

enum class SensorRole {
  SpindleBearing,
  SpindleHousing,
  ColumnFront,
  ColumnRear,
  ColumnLeft,
  ColumnRight,
  Column,
  Table,
  Bed,
  Crossbeam,
  Scale,  ///< of an axis that nothing tells
  ScaleX,
  ScaleY,
  ScaleZ,
  Screw,  ///< of an axis that nothing tells
  ScrewX,
  ScrewY,
  ScrewZ,
  Coolant,
  Room,
  Artefact,
  Instrument,
  Other
};

/// As in machine.json: "spindle_bearing", ..., "other".
[[nodiscard]] std::string_view toString(SensorRole role) noexcept;
[[nodiscard]] std::optional<SensorRole> sensorRoleFromString(std::string_view text) noexcept;
/// All of them, in the order of the enumeration.
[[nodiscard]] const std::vector<std::string>& sensorRoleNames();
/// "front of the column", for people.
[[nodiscard]] std::string_view describe(SensorRole role) noexcept;
/// The role of the scale or screw of axis 0, 1, 2.
[[nodiscard]] SensorRole scaleRole(int axis) noexcept;
[[nodiscard]] SensorRole screwRole(int axis) noexcept;

/// The role that a text tells; nothing if it tells none, or several that contradict each other.
[[nodiscard]] std::optional<SensorRole> readSensorRole(std::string_view text);
/// The words of a text as they are looked up: "T_StänderVorne2_degC" -> t, staender, vorne, deg, c.
[[nodiscard]] std::vector<std::string> sensorWords(std::string_view text);

struct TemperatureSensor;

/// What a column of the log is taken for, and why.
struct SensorReading {
  std::string column;  ///< "T_room_degC"
  SensorRole role = SensorRole::Other;
  std::string from;  ///< "machine.json": stated there; "name": read from the name or the place, to be confirmed
  std::string note;  ///< a sentence where name and place contradict each other, or a role cannot be read; else empty
};

/// The reading of every column of temperatures, with what machine.json says of it.
[[nodiscard]] SensorReading readSensor(const std::vector<TemperatureSensor>& stated, const std::string& column);
/// "T_room_degC room, T_1_degC other": those that were read from names; empty if there are none.
[[nodiscard]] std::string readFromNames(const std::vector<SensorReading>& readings);

}  // namespace spindrift
