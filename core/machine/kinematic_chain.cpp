// SPDX-License-Identifier: Apache-2.0
#include "core/machine/kinematic_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/base/text.h"

namespace spindrift {
namespace {

constexpr std::string_view allowed_chain =
    "a chain such as \"V [w-X'-Y'-b-Z-(C)-t]\": from w over b to t, axes X, Y, Z, A, B, C with an optional number, ' "
    "on "
    "those that carry the workpiece, the spindle in brackets";

}  // namespace

KinematicChain KinematicChain::parse(std::string_view text, const SourcePlace& place) {
  const auto reject = [&](const std::string& why) {
    throw InputError(place, fmt::format("chain \"{}\": {}; allowed: {}.", text, why, allowed_chain));
  };
  KinematicChain chain;
  chain.text_ = std::string(text);
  const std::size_t open = text.find('[');
  const std::size_t close = text.rfind(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) reject("no [ ... ]");
  chain.vertical_ = trimmed(text.substr(0, open)) != "H";
  const std::vector<std::string> parts = splitList(text.substr(open + 1, close - open - 1), '-');
  if (parts.size() < 3 || parts.front() != "w" || parts.back() != "t") reject("it does not run from w to t");
  bool before_bed = true;
  for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
    std::string part = parts[i];
    if (part == "b") {
      if (!before_bed) reject("the bed b appears twice");
      before_bed = false;
      continue;
    }
    ChainAxis axis;
    if (part.size() > 2 && part.front() == '(' && part.back() == ')') {
      axis.spindle = true;
      part = part.substr(1, part.size() - 2);
    }
    bool primed = false;
    if (part.ends_with('\'')) {
      primed = true;
      part.pop_back();
    }
    if (part.empty()) reject(fmt::format("\"{}\" is not an axis", parts[i]));
    const char letter = part.front();
    const std::size_t index = std::string_view("XYZABC").find(letter);
    if (index == std::string_view::npos ||
        !std::all_of(part.begin() + 1, part.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) {
      reject(fmt::format("\"{}\" is not an axis", parts[i]));
    }
    if (primed && !before_bed) reject(fmt::format("\"{}\" stands on the tool side", parts[i]));
    if (chain.find(part) != nullptr) reject(fmt::format("axis \"{}\" appears twice", part));
    axis.name = part;
    axis.rotary = index >= 3;
    axis.direction = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(index % 3));
    axis.carries_workpiece = before_bed;
    chain.axes_.push_back(axis);
  }
  if (before_bed) reject("the bed b is missing");
  return chain;
}

const ChainAxis* KinematicChain::find(std::string_view name) const noexcept {
  const auto found = std::find_if(axes_.begin(), axes_.end(), [&](const ChainAxis& a) { return a.name == name; });
  return found == axes_.end() ? nullptr : &*found;
}

bool KinematicChain::movesTool(std::string_view name) const noexcept {
  const ChainAxis* axis = find(name);
  return axis != nullptr && !axis->carries_workpiece;
}

SmallError KinematicChain::toolDeviation(
    const AxisPositions& positions, const AxisErrors& errors, const Eigen::Vector3d& tool_point_mm,
    const std::map<std::string, Eigen::Vector3d, std::less<>>& rotary_centres_mm) const {
  const auto motion = [&](const ChainAxis& axis) -> Eigen::Vector3d {
    if (axis.rotary) return Eigen::Vector3d::Zero();
    const auto found = positions.find(axis.name);
    return found == positions.end() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(found->second * axis.direction);
  };
  // The tool point in MCF: the bed's frame in which tool-side axes have moved the tool.
  Eigen::Vector3d tool = tool_point_mm;
  for (const ChainAxis& axis : axes_) {
    if (!axis.carries_workpiece) tool += motion(axis);
  }
  SmallError total;
  const auto add = [&](const ChainAxis& axis, const Eigen::Vector3d& carried_mm, double sign) {
    const auto error = errors.find(axis.name);
    if (error == errors.end()) return;
    Eigen::Vector3d origin = carried_mm;
    if (axis.rotary) {
      const auto centre = rotary_centres_mm.find(axis.name);
      if (centre != rotary_centres_mm.end()) origin += centre->second;
    }
    total += sign * error->second.at(tool - origin);
  };
  Eigen::Vector3d carried = Eigen::Vector3d::Zero();
  for (const ChainAxis& axis : axes_) {  // bed to tool
    if (axis.carries_workpiece) continue;
    carried += motion(axis);
    add(axis, carried, 1.0);
  }
  // Bed to workpiece. A workpiece axis commanded to +p moves the table by -p: positions are those of the tool relative
  // to the table.
  carried.setZero();
  for (auto axis = axes_.rbegin(); axis != axes_.rend(); ++axis) {
    if (!axis->carries_workpiece) continue;
    carried -= motion(*axis);
    add(*axis, carried, -1.0);
  }
  return total;
}

}  // namespace spindrift
