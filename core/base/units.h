// SPDX-License-Identifier: Apache-2.0
// Units. Inside the program: mm, rad, s, degC. In files and on screen: um, urad, um/m.
// A bare number carries its unit in its name (`_mm`, `_um`, `_urad`, `_degC`); these constants convert.
#pragma once

#include <numbers>

namespace spindrift {

inline constexpr double um_per_mm = 1e3;
inline constexpr double mm_per_um = 1e-3;
inline constexpr double urad_per_rad = 1e6;
inline constexpr double rad_per_urad = 1e-6;
inline constexpr double rad_per_deg = std::numbers::pi / 180.0;
inline constexpr double deg_per_rad = 180.0 / std::numbers::pi;
/// A dimensionless strain times this is um/m.
inline constexpr double um_per_m_per_unit = 1e6;
inline constexpr double seconds_per_hour = 3600.0;
inline constexpr double mm_per_inch = 25.4;

}  // namespace spindrift
