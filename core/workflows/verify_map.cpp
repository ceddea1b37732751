// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/verify_map.h"

#include <cmath>
#include <map>
#include <set>

#include "core/machine/interpolated_field.h"
#include "core/workflows/fit_campaign.h"

namespace spindrift {
namespace {

constexpr int verify_map_nodes = 40;

std::optional<Field> mapOf(const std::vector<Field::Marker>& points, const MachineDescription& machine,
                           Component component) {
  std::vector<ScatteredValue> values;
  double z = 0.0;
  for (const Field::Marker& p : points) {
    if (!(p.sigma > 0.0)) continue;
    values.push_back({p.position_mm, p.value, p.sigma});
    z += p.position_mm.z();
  }
  if (!spreadsOverPlane(values)) return std::nullopt;
  const auto grid = mapTable(machine, z / static_cast<double>(values.size()), verify_map_nodes);
  return grid ? std::optional(fieldBetween(component, values, *grid)) : std::nullopt;
}

}  // namespace

std::vector<VerifyPose> posesOf(const VerifyResult& result) {
  std::vector<std::string> states;
  std::map<std::string, std::set<double>> angles;
  for (const VerifyPoint& p : result.points) {
    if (!angles.contains(p.state)) states.push_back(p.state);
    angles[p.state].insert(p.c_deg);
  }
  std::vector<VerifyPose> poses;
  for (const std::string& state : states)
    for (const double c_deg : angles.at(state)) poses.push_back({state, c_deg});
  return poses;
}

std::vector<double> anglesOf(const VerifyResult& result) {
  std::set<double> angles;
  for (const VerifyPoint& p : result.points) angles.insert(p.c_deg);
  return {angles.begin(), angles.end()};
}

VerifyPose worstPose(const VerifyResult& result, Component component) {
  VerifyPose pose;
  double worst = -1.0;
  for (const VerifyPoint& p : result.points) {
    if (p.component != component || std::abs(p.after) <= worst) continue;
    worst = std::abs(p.after);
    pose = {p.state, p.c_deg};
  }
  return pose;
}

VerifyMap verifyMap(const VerifyResult& result, const MachineDescription& machine, Component component,
                    const std::optional<VerifyPose>& pose) {
  VerifyMap map;
  map.component = component;
  map.pose = pose ? *pose : worstPose(result, component);
  for (const VerifyPoint& p : result.points) {
    if (p.component != component || VerifyPose{p.state, p.c_deg} != map.pose) continue;
    map.points[0].push_back({p.point, p.position_mm, p.before, p.before_sigma, true});
    map.points[1].push_back({p.point, p.position_mm, p.after, p.after_sigma, true});
  }
  for (std::size_t side = 0; side < 2; ++side) map.fields[side] = mapOf(map.points[side], machine, component);
  return map;
}

}  // namespace spindrift
