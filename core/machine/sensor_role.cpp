// SPDX-License-Identifier: Apache-2.0
#include "core/machine/sensor_role.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/machine/machine_description.h"

namespace spindrift {
namespace {

struct RoleName {
  SensorRole role;
  std::string_view name;
  std::string_view text;
};

constexpr std::array<RoleName, 23> role_names{{{SensorRole::SpindleBearing, "spindle_bearing", "spindle bearing"},
                                               {SensorRole::SpindleHousing, "spindle_housing", "spindle housing"},
                                               {SensorRole::ColumnFront, "column_front", "front of the column"},
                                               {SensorRole::ColumnRear, "column_rear", "rear of the column"},
                                               {SensorRole::ColumnLeft, "column_left", "left side of the column"},
                                               {SensorRole::ColumnRight, "column_right", "right side of the column"},
                                               {SensorRole::Column, "column", "column"},
                                               {SensorRole::Table, "table", "table"},
                                               {SensorRole::Bed, "bed", "bed"},
                                               {SensorRole::Crossbeam, "crossbeam", "cross beam"},
                                               {SensorRole::Scale, "scale", "a scale"},
                                               {SensorRole::ScaleX, "scale_x", "scale of X"},
                                               {SensorRole::ScaleY, "scale_y", "scale of Y"},
                                               {SensorRole::ScaleZ, "scale_z", "scale of Z"},
                                               {SensorRole::Screw, "screw", "a ball screw"},
                                               {SensorRole::ScrewX, "screw_x", "X ball screw"},
                                               {SensorRole::ScrewY, "screw_y", "Y ball screw"},
                                               {SensorRole::ScrewZ, "screw_z", "Z ball screw"},
                                               {SensorRole::Coolant, "coolant", "coolant"},
                                               {SensorRole::Room, "room", "room"},
                                               {SensorRole::Artefact, "artefact", "artefact"},
                                               {SensorRole::Instrument, "instrument", "instrument"},
                                               {SensorRole::Other, "other", "no part that an effect follows"}}};

/// What a word says.
enum class Word {
  Spindle,
  Bearing,  // of many parts
  Housing,  // of many parts
  Head,     // of many parts
  Air,      // of many things
  Column,
  Front,
  Rear,
  Left,
  Right,
  Table,
  Bed,
  Crossbeam,
  Scale,
  Screw,
  Coolant,
  Room,
  Artefact,
  Instrument,
  X,
  Y,
  Z,
  Plain,  // a position or a number of its own, which changes no role
  SpindleBearing,
  SpindleHousing
};

/// Words in small letters, umlauts written out. German compounds stand as they are written.
const std::map<std::string, Word, std::less<>>& vocabulary() {
  static const std::map<std::string, Word, std::less<>> words = [] {
    std::map<std::string, Word, std::less<>> w;
    const auto add = [&w](Word meaning, std::initializer_list<const char*> list) {
      for (const char* word : list) w.emplace(word, meaning);
    };
    add(Word::Spindle, {"spindle", "spindel", "hauptspindel", "motorspindel", "fraesspindel", "arbeitsspindel"});
    add(Word::SpindleBearing, {"spindellager", "spindellagerung", "hauptlager", "hauptspindellager"});
    add(Word::SpindleHousing, {"headstock", "spindelgehaeuse", "spindelstock", "spindelkasten", "spindelkopf",
                               "spindelhuelse", "spindeltraeger", "fraeskopf", "hauptspindelgehaeuse"});
    add(Word::Bearing, {"bearing", "bearings", "lager", "lagerung"});
    add(Word::Housing, {"housing", "gehaeuse"});
    add(Word::Head, {"head"});
    add(Word::Air, {"air", "luft"});
    add(Word::Column, {"column", "pillar", "upright", "staender", "maschinenstaender", "saeule"});
    add(Word::Front, {"front", "vorne", "vorn", "vorderseite", "vorderwand", "vordere", "vorderer", "frontseite"});
    add(Word::Rear, {"rear", "back", "hinten", "rueckseite", "rueckwand", "hinterseite", "hintere", "hinterer"});
    add(Word::Left, {"left", "links", "linke", "linker", "linkes"});
    add(Word::Right, {"right", "rechts", "rechte", "rechter", "rechtes"});
    add(Word::Table, {"table", "tabletop", "worktable", "pallet", "rotary", "tisch", "maschinentisch", "rundtisch",
                      "drehtisch", "aufspanntisch", "schwenktisch", "kreuztisch", "tischplatte", "palette"});
    add(Word::Bed, {"bed", "bett", "maschinenbett"});
    add(Word::Crossbeam, {"crossbeam", "crossrail", "beam", "gantry", "bridge", "querbalken", "quertraeger", "traverse",
                          "portal", "portalbalken", "bruecke"});
    add(Word::Scale, {"scale", "scales", "massstab", "glasmassstab", "linearmassstab", "laengenmassstab", "messstab",
                      "wegmesssystem", "laengenmesssystem"});
    add(Word::Screw, {"screw", "ballscrew", "leadscrew", "nut", "ballnut", "kugelgewindetrieb", "kgt", "gewindetrieb",
                      "kugelgewindespindel", "gewindespindel", "kugelrollspindel", "kugelumlaufspindel",
                      "vorschubspindel", "kugelgewindemutter", "spindelmutter", "mutter"});
    add(Word::Coolant, {"coolant", "kuehlmittel", "kuehlschmierstoff", "kuehlschmiermittel", "kss", "kuehlemulsion"});
    add(Word::Room,
        {"room",      "ambient",   "ambience",   "environment", "surroundings", "hall",         "shop",   "shopfloor",
         "workshop",  "lab",       "laboratory", "raum",        "messraum",     "umgebung",     "umwelt", "halle",
         "werkhalle", "werkstatt", "labor",      "raumluft",    "hallenluft",   "umgebungsluft"});
    add(Word::Artefact, {"artefact", "artifact", "ballbar", "ballplate", "artefakt", "pruefkoerper", "kugelplatte",
                         "lochplatte", "kugelstab"});
    add(Word::Instrument, {"instrument", "camera", "microscope", "profiler", "scanner", "kamera", "mikroskop",
                           "messtaster", "taster", "messgeraet", "messkopf"});
    add(Word::X, {"x", "xaxis", "xachse"});
    add(Word::Y, {"y", "yaxis", "yachse"});
    add(Word::Z, {"z", "zaxis", "zachse"});
    add(Word::Plain,
        {"t",       "temp",    "temperature", "temperatur", "deg",    "degc",    "c",      "celsius",   "grad",
         "sensor",  "fuehler", "probe",       "upper",      "lower",  "top",     "bottom", "middle",    "centre",
         "center",  "mid",     "up",          "down",       "inner",  "outer",   "inside", "outside",   "main",
         "machine", "axis",    "achse",       "far",        "near",   "side",    "seite",  "wall",      "wand",
         "oben",    "unten",   "mitte",       "innen",      "aussen", "haupt",   "pt",     "pt100",     "ntc",
         "tc",      "of",      "the",         "der",        "des",    "am",      "an",     "im",        "in",
         "on",      "ball",    "cross",       "linear",     "glass",  "cutting", "work",   "structure", "maschine"});
    return w;
  }();
  return words;
}

/// German endings that leave the role of the word before them: "tischtemperatur", "staendervorne".
std::vector<Word> meanings(const std::string& word) {
  const auto& words = vocabulary();
  if (const auto found = words.find(word); found != words.end()) return {found->second};
  static const std::array<std::string_view, 14> endings{"temperatur", "temp",       "vorne",     "vorn",  "hinten",
                                                        "links",      "rechts",     "oben",      "unten", "vorderseite",
                                                        "rueckseite", "vorderwand", "rueckwand", "mitte"};
  for (const std::string_view ending : endings) {
    if (!word.ends_with(ending) || word.size() <= ending.size() + 2) continue;
    std::string stem = word.substr(0, word.size() - ending.size());
    auto found = words.find(stem);
    // "umgebungstemperatur", "hallentemperatur"
    if (found == words.end() && (stem.back() == 's' || stem.back() == 'n')) {
      stem.pop_back();
      found = words.find(stem);
    }
    if (found != words.end()) return {found->second, words.find(ending)->second};
  }
  return {};
}

SensorRole axisRole(SensorRole none, int axis) {
  return axis < 0 ? none : static_cast<SensorRole>(static_cast<int>(none) + 1 + axis);
}

/// True if `wide` says less than `narrow` and nothing else.
bool narrows(SensorRole wide, SensorRole narrow) {
  const auto among = [](SensorRole role, std::initializer_list<SensorRole> list) {
    return std::find(list.begin(), list.end(), role) != list.end();
  };
  switch (wide) {
    case SensorRole::Column:
      return among(narrow,
                   {SensorRole::ColumnFront, SensorRole::ColumnRear, SensorRole::ColumnLeft, SensorRole::ColumnRight});
    case SensorRole::Scale:
      return among(narrow, {SensorRole::ScaleX, SensorRole::ScaleY, SensorRole::ScaleZ});
    case SensorRole::Screw:
      return among(narrow, {SensorRole::ScrewX, SensorRole::ScrewY, SensorRole::ScrewZ});
    default:
      return false;
  }
}

/// "spindle" alone says neither bearing nor housing; both drive the same effects.
bool bothSpindle(SensorRole a, SensorRole b) {
  const auto spindle = [](SensorRole r) { return r == SensorRole::SpindleBearing || r == SensorRole::SpindleHousing; };
  return spindle(a) && spindle(b);
}

/// The letters of a UTF-8 text, umlauts written out; everything that is no letter becomes a blank, and so does the
/// seam between a small letter and a capital.
std::string spelledOut(std::string_view text) {
  std::string out;
  bool small = false;  // the letter before was a small one
  const auto put = [&](std::string_view letters, bool capital) {
    if (capital && small) out += ' ';
    out += letters;
    small = !capital;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (c < 0x80) {
      if (std::isalpha(c) != 0) {
        const bool capital = std::isupper(c) != 0;
        // "XAxis", "TRoom": the last capital of several begins the word.
        const bool before_small = next < 0x80 && std::islower(static_cast<int>(next)) != 0;
        if (capital && !small && before_small && !out.empty() && out.back() != ' ') out += ' ';
        const auto lower = static_cast<char>(std::tolower(c));
        put(std::string_view(&lower, 1), capital);
      } else {
        out += ' ';
        small = false;
      }
      continue;
    }
    if (c == 0xC3) {
      switch (next) {
        case 0xA4:
          put("ae", false);
          break;
        case 0x84:
          put("ae", true);
          break;
        case 0xB6:
          put("oe", false);
          break;
        case 0x96:
          put("oe", true);
          break;
        case 0xBC:
          put("ue", false);
          break;
        case 0x9C:
          put("ue", true);
          break;
        case 0x9F:
          put("ss", false);
          break;
        default:
          put("?", !small);  // a letter of another language: part of the word, which no vocabulary holds
      }
      ++i;
      continue;
    }
    // A diaeresis that stands after its letter (decomposed Unicode).
    if (c == 0xCC && next == 0x88 && !out.empty() && std::string_view("aou").find(out.back()) != std::string::npos) {
      out += 'e';
      ++i;
      continue;
    }
    put("?", !small);
    while (i + 1 < text.size() && (static_cast<unsigned char>(text[i + 1]) & 0xC0U) == 0x80U) ++i;
  }
  return out;
}

}  // namespace

std::string_view toString(SensorRole role) noexcept {
  return role_names[static_cast<std::size_t>(role)].name;
}

std::string_view describe(SensorRole role) noexcept {
  return role_names[static_cast<std::size_t>(role)].text;
}

std::optional<SensorRole> sensorRoleFromString(std::string_view text) noexcept {
  for (const RoleName& r : role_names) {
    if (r.name == text) return r.role;
  }
  return std::nullopt;
}

const std::vector<std::string>& sensorRoleNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const RoleName& r : role_names) list.emplace_back(r.name);
    return list;
  }();
  return names;
}

SensorRole scaleRole(int axis) noexcept {
  return axisRole(SensorRole::Scale, axis);
}

SensorRole screwRole(int axis) noexcept {
  return axisRole(SensorRole::Screw, axis);
}

std::vector<std::string> sensorWords(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : spelledOut(text) + " ") {
    if (c != ' ') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::move(word));
      word.clear();
    }
  }
  return words;
}

std::optional<SensorRole> readSensorRole(std::string_view text) {
  if (text.starts_with("T_")) text.remove_prefix(2);
  if (text.ends_with("_degC")) text.remove_suffix(5);
  const std::vector<std::string> words = sensorWords(text);
  std::set<Word> said;
  bool strange = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    // Two words that are one name.
    const std::string next = i + 1 < words.size() ? words[i + 1] : "";
    if ((words[i] == "cutting" && next == "fluid") || (words[i] == "kuehl" && next == "mittel")) {
      said.insert(Word::Coolant);
      ++i;
      continue;
    }
    if ((words[i] == "hole" || words[i] == "ball") && (next == "bar" || next == "plate")) {
      said.insert(Word::Artefact);
      ++i;
      continue;
    }
    if ((words[i] == "touch" || words[i] == "measuring") && next == "probe") {
      said.insert(Word::Instrument);
      ++i;
      continue;
    }
    if (words[i] == "linear" && (next == "encoder" || next == "encoders")) {
      said.insert(Word::Scale);
      ++i;
      continue;
    }
    const std::vector<Word> found = meanings(words[i]);
    if (found.empty()) strange = true;
    said.insert(found.begin(), found.end());
  }
  const auto has = [&](Word w) { return said.contains(w); };
  const int axes = static_cast<int>(has(Word::X)) + static_cast<int>(has(Word::Y)) + static_cast<int>(has(Word::Z));
  const int axis = axes != 1 ? -1 : has(Word::X) ? 0 : has(Word::Y) ? 1 : 2;
  // A fluid, a scale, a screw or an instrument at another part is itself and not that part.
  if (has(Word::Coolant)) return SensorRole::Coolant;
  if (has(Word::Scale)) return axisRole(SensorRole::Scale, axis);
  if (has(Word::Screw)) return axisRole(SensorRole::Screw, axis);
  if (has(Word::Instrument)) return SensorRole::Instrument;
  std::vector<SensorRole> parts;
  const bool bearing = has(Word::Bearing);
  if (has(Word::SpindleBearing)) parts.push_back(SensorRole::SpindleBearing);
  if (has(Word::SpindleHousing)) parts.push_back(SensorRole::SpindleHousing);
  if (has(Word::Spindle)) {
    parts.push_back(!bearing && (has(Word::Housing) || has(Word::Head)) ? SensorRole::SpindleHousing
                                                                        : SensorRole::SpindleBearing);
  }
  if (has(Word::Column)) {
    std::vector<SensorRole> sides;
    if (has(Word::Front)) sides.push_back(SensorRole::ColumnFront);
    if (has(Word::Rear)) sides.push_back(SensorRole::ColumnRear);
    if (has(Word::Left)) sides.push_back(SensorRole::ColumnLeft);
    if (has(Word::Right)) sides.push_back(SensorRole::ColumnRight);
    parts.push_back(sides.size() == 1 ? sides.front() : SensorRole::Column);
  }
  if (has(Word::Artefact)) {
    parts.push_back(SensorRole::Artefact);  // also where it lies on the table
  } else if (has(Word::Table)) {
    parts.push_back(SensorRole::Table);
  }
  if (has(Word::Bed)) parts.push_back(SensorRole::Bed);
  if (has(Word::Crossbeam)) parts.push_back(SensorRole::Crossbeam);
  if (has(Word::Room)) parts.push_back(SensorRole::Room);
  if (parts.size() == 2 && bothSpindle(parts[0], parts[1])) parts.pop_back();
  if (parts.size() == 1) return parts.front();
  if (parts.size() > 1 || strange || axes > 0) return std::nullopt;
  if (bearing && !has(Word::Air)) return SensorRole::SpindleBearing;
  if (has(Word::Housing) || has(Word::Head)) return SensorRole::SpindleHousing;
  if (has(Word::Air) && !bearing) return SensorRole::Room;
  return std::nullopt;
}

namespace {

/// What name and place tell; `sensor`: as stated in machine.json, null if it is not there.
SensorReading readByName(const TemperatureSensor* sensor, const std::string& column) {
  SensorReading reading;
  reading.column = column;
  reading.from = "name";
  const std::optional<SensorRole> by_name = readSensorRole(column);
  const std::optional<SensorRole> by_place = sensor == nullptr ? std::nullopt : readSensorRole(sensor->place);
  if (!by_name) {
    reading.role = by_place.value_or(SensorRole::Other);
    return reading;
  }
  reading.role = *by_name;
  if (!by_place || *by_place == *by_name || narrows(*by_place, *by_name)) return reading;
  if (narrows(*by_name, *by_place) || bothSpindle(*by_name, *by_place)) {
    reading.role = *by_place;
    return reading;
  }
  // "front bearing" is of a spindle only where no other part is named.
  const std::vector<std::string> words = sensorWords(sensor->place);
  const bool weak = std::none_of(words.begin(), words.end(), [](const std::string& w) {
    const std::vector<Word> m = meanings(w);
    return !m.empty() && m.front() != Word::Bearing && m.front() != Word::Housing && m.front() != Word::Head &&
           m.front() != Word::Air && m.front() != Word::Plain && m.front() != Word::Front && m.front() != Word::Rear;
  });
  if (!weak) {
    reading.note = fmt::format(
        "The sensor {} is taken for {} by its name, though its place \"{}\" says {}; a \"role\" in machine.json would "
        "decide.",
        column, describe(*by_name), sensor->place, describe(*by_place));
  }
  return reading;
}

}  // namespace

SensorReading readSensor(const std::vector<TemperatureSensor>& stated, const std::string& column) {
  const auto sensor =
      std::find_if(stated.begin(), stated.end(), [&](const TemperatureSensor& s) { return s.name == column; });
  if (sensor != stated.end() && sensor->role) return {column, *sensor->role, "machine.json", ""};
  SensorReading reading = readByName(sensor == stated.end() ? nullptr : &*sensor, column);
  if (sensor != stated.end() && !sensor->unread_role.empty()) {
    reading.note = fmt::format(
        "The role \"{}\" of the sensor {} in machine.json is none of those that are known ({}): it is taken for {} by "
        "its name or place.",
        sensor->unread_role, column, joinedList(sensorRoleNames()), describe(reading.role));
  }
  return reading;
}

std::string readFromNames(const std::vector<SensorReading>& readings) {
  std::string text;
  for (const SensorReading& r : readings) {
    if (r.from != "name") continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", r.column, toString(r.role));
  }
  return text;
}

}  // namespace spindrift
