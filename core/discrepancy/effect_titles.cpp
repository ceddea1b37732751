// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_titles.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace spindrift {
namespace {

struct Entry {
  std::string_view stem;     ///< id without its last part, or the whole id
  std::string_view pattern;  ///< %1: the last part
};

// In the order of the catalogue.
constexpr std::array<Entry, 32> entries{{
    {"spindle.growth.z", "growth of the spindle along Z"},
    {"spindle.centrifugal.z", "shortening of the spindle by its speed along Z"},
    {"spindle.drift", "drift of the spindle along %1"},
    {"head.tilt", "tilt of the head about %1"},
    {"column.bending.a", "bending of the column towards Y"},
    {"column.bending.b", "bending of the column towards X"},
    {"column.expansion.z", "expansion of the column along Z"},
    {"ball_screw.expansion", "thermal expansion of the %1 ball screw"},
    {"ball_screw.nonuniform", "uneven expansion of the %1 ball screw"},
    {"scale.expansion", "expansion of the %1 scale"},
    {"table.expansion.xy", "expansion of the table"},
    {"frame.rotation", "rotation of the frame about %1"},
    {"squareness.drift.c0y", "drift of the squareness of Y to X"},
    {"crossbeam.sag.z", "sag of the crossbeam"},
    {"ambient.drift", "drift with the room temperature along %1"},
    {"instrument.warm_up", "warm-up of the instrument along %1"},
    {"fixture.slip", "slip of point %1 in its fixture"},
    {"periodic.pitch", "periodic error of the %1 ball screw"},
    {"backlash", "backlash of %1"},
    {"coolant.shock", "shock by the coolant along %1"},
    {"external_heat.a", "heat from outside that bends the column towards Y"},
    {"external_heat.b", "heat from outside that bends the column towards X"},
    {"external_heat.z", "heat from outside that acts along Z"},
    {"heat_source.position", "spindle heat that depends on the position of %1"},
    {"rotary.drift.x0c", "drift of the rotary table along X"},
    {"rotary.drift.y0c", "drift of the rotary table along Y"},
    {"rotary.drift.z0t", "drift of the rotary table along Z"},
    {"rotary.tilt.a0c", "tilt of the rotary table about X"},
    {"rotary.tilt.b0c", "tilt of the rotary table about Y"},
    {"rotary.tilt.c0c", "rotation of the rotary table about Z"},
    {"rotary.expansion.r0t", "radial growth of the rotary table"},
    {"artefact.expansion", "expansion of the artefact"},
}};

constexpr std::string_view slip = "fixture.slip";

/// Rotations a, b, c are about X, Y, Z; axes are written as capitals.
std::string subjectOf(std::string_view last) {
  if (last.size() == 1 && last[0] >= 'a' && last[0] <= 'c') return std::string(1, "XYZ"[last[0] - 'a']);
  std::string text(last);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

}  // namespace

std::optional<EffectTitle> effectTitleOf(std::string_view id) {
  const std::size_t dot = id.rfind('.');
  const std::string_view stem = dot == std::string_view::npos ? id : id.substr(0, dot);
  for (const Entry& entry : entries) {
    if (id == entry.stem) return EffectTitle{entry.pattern, {}};
    // The id of a point may hold dots of its own.
    if (entry.stem == slip && id.starts_with("fixture.slip."))
      return EffectTitle{entry.pattern, std::string(id.substr(slip.size() + 1))};
    if (dot == std::string_view::npos || stem != entry.stem) continue;
    return EffectTitle{entry.pattern, subjectOf(id.substr(dot + 1))};
  }
  return std::nullopt;
}

std::string effectTitle(std::string_view id) {
  const auto title = effectTitleOf(id);
  if (!title) return std::string(id);
  std::string text(title->pattern);
  const std::size_t at = text.find("%1");
  if (at != std::string::npos) text.replace(at, 2, title->subject);
  return text;
}

}  // namespace spindrift
