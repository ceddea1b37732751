// SPDX-License-Identifier: Apache-2.0
#include "core/connect/unit_conversion.h"

#include <array>
#include <cctype>
#include <numbers>

namespace spindrift {
namespace {

enum class Dimension { Temperature, Length, Angle, Rotation, Speed, Ratio, Power, Current, Time };

/// base = scale * value + offset, with the bases degC, mm, rad, rpm, mm/min, 1, W, A, s.
struct Unit {
  std::string_view name;
  Dimension dimension;
  double scale;
  double offset = 0.0;
};

constexpr double pi = std::numbers::pi;

/// MTConnect's words, and those of people; compared without regard to capitals.
constexpr std::array units{Unit{"celsius", Dimension::Temperature, 1.0},
                           Unit{"degc", Dimension::Temperature, 1.0},
                           Unit{"°c", Dimension::Temperature, 1.0},
                           Unit{"cel", Dimension::Temperature, 1.0},
                           Unit{"c", Dimension::Temperature, 1.0},
                           Unit{"f", Dimension::Temperature, 5.0 / 9.0, -160.0 / 9.0},
                           Unit{"degree_celsius", Dimension::Temperature, 1.0},
                           Unit{"fahrenheit", Dimension::Temperature, 5.0 / 9.0, -160.0 / 9.0},
                           Unit{"degree_fahrenheit", Dimension::Temperature, 5.0 / 9.0, -160.0 / 9.0},
                           Unit{"degf", Dimension::Temperature, 5.0 / 9.0, -160.0 / 9.0},
                           Unit{"°f", Dimension::Temperature, 5.0 / 9.0, -160.0 / 9.0},
                           Unit{"kelvin", Dimension::Temperature, 1.0, -273.15},
                           Unit{"k", Dimension::Temperature, 1.0, -273.15},
                           Unit{"millimeter", Dimension::Length, 1.0},
                           Unit{"mm", Dimension::Length, 1.0},
                           Unit{"micrometer", Dimension::Length, 1e-3},
                           Unit{"micron", Dimension::Length, 1e-3},
                           Unit{"µm", Dimension::Length, 1e-3},
                           Unit{"um", Dimension::Length, 1e-3},
                           Unit{"nanometer", Dimension::Length, 1e-6},
                           Unit{"nm", Dimension::Length, 1e-6},
                           Unit{"meter", Dimension::Length, 1e3},
                           Unit{"m", Dimension::Length, 1e3},
                           Unit{"inch", Dimension::Length, 25.4},
                           Unit{"foot", Dimension::Length, 304.8},
                           Unit{"in", Dimension::Length, 25.4},
                           Unit{"radian", Dimension::Angle, 1.0},
                           Unit{"rad", Dimension::Angle, 1.0},
                           Unit{"urad", Dimension::Angle, 1e-6},
                           Unit{"mrad", Dimension::Angle, 1e-3},
                           Unit{"degree", Dimension::Angle, pi / 180.0},
                           Unit{"deg", Dimension::Angle, pi / 180.0},
                           Unit{"revolution/minute", Dimension::Rotation, 1.0},
                           Unit{"rpm", Dimension::Rotation, 1.0},
                           Unit{"1/min", Dimension::Rotation, 1.0},
                           Unit{"r/min", Dimension::Rotation, 1.0},
                           Unit{"rev/min", Dimension::Rotation, 1.0},
                           Unit{"1/s", Dimension::Rotation, 60.0},
                           Unit{"revolution/second", Dimension::Rotation, 60.0},
                           Unit{"degree/second", Dimension::Rotation, 1.0 / 6.0},
                           Unit{"millimeter/second", Dimension::Speed, 60.0},
                           Unit{"mm/s", Dimension::Speed, 60.0},
                           Unit{"millimeter/minute", Dimension::Speed, 1.0},
                           Unit{"mm/min", Dimension::Speed, 1.0},
                           Unit{"mm_min", Dimension::Speed, 1.0},
                           Unit{"m/min", Dimension::Speed, 1e3},
                           Unit{"m_min", Dimension::Speed, 1e3},
                           Unit{"m/s", Dimension::Speed, 6e4},
                           Unit{"inch/minute", Dimension::Speed, 25.4},
                           Unit{"foot/minute", Dimension::Speed, 304.8},
                           Unit{"feet/minute", Dimension::Speed, 304.8},
                           Unit{"inch/second", Dimension::Speed, 1524.0},
                           Unit{"percent", Dimension::Ratio, 0.01},
                           Unit{"%", Dimension::Ratio, 0.01},
                           Unit{"watt", Dimension::Power, 1.0},
                           Unit{"w", Dimension::Power, 1.0},
                           Unit{"kilowatt", Dimension::Power, 1e3},
                           Unit{"kw", Dimension::Power, 1e3},
                           Unit{"ampere", Dimension::Current, 1.0},
                           Unit{"a", Dimension::Current, 1.0},
                           Unit{"second", Dimension::Time, 1.0},
                           Unit{"s", Dimension::Time, 1.0}};

const Unit* find(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower.ends_with("_3d")) lower.erase(lower.size() - 3);
  for (const Unit& unit : units) {
    if (unit.name == lower) return &unit;
  }
  return nullptr;
}

}  // namespace

std::string unitOfColumn(std::string_view column) {
  for (const std::string_view unit : {"mm_min", "m_min", "degC", "degF", "K", "urad", "mrad", "rpm", "mm", "um", "nm",
                                      "deg", "percent", "kW", "W", "A"}) {
    if (column.size() > unit.size() + 1 && column.ends_with(unit) && column[column.size() - unit.size() - 1] == '_')
      return std::string(unit);
  }
  return {};
}

bool isKnownUnit(std::string_view unit) {
  return find(unit) != nullptr;
}

std::optional<UnitConversion> conversionInto(std::string_view column, std::string_view unit) {
  const Unit* from = find(unit);
  const Unit* to = find(unitOfColumn(column));
  if (unit.empty() || to == nullptr) return UnitConversion{};
  if (from == nullptr || from->dimension != to->dimension) return std::nullopt;
  return UnitConversion{from->scale / to->scale, (from->offset - to->offset) / to->scale};
}

}  // namespace spindrift
