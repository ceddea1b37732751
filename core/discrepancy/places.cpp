// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/discrepancy/discrepancy_search.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

using Eigen::Index;

struct Group {
  Component component = Component::EX;
  double from_s = 0.0;
  double to_s = 0.0;
  int first_epoch = 0;
  int last_epoch = 0;
  std::string point;  // empty: all
  std::string condition;
  std::vector<Index> units;
  double p = 1.0;
};

}  // namespace

std::vector<DisagreementPlace> findPlaces(const ResidualProblem& problem, const DriverTable& drivers,
                                          const Eigen::VectorXd& z) {
  const int epochs = problem.epoch_count;
  const double dof_part = std::max(
      0.3, static_cast<double>(problem.degreesOfFreedom()) / std::max<double>(1.0, static_cast<double>(z.size())));
  std::vector<Group> groups;
  const auto add = [&](Component c, int first, int last, const std::string& point, const std::string& condition,
                       const std::function<bool(Index)>& in) {
    Group g;
    g.component = c;
    g.first_epoch = first;
    g.last_epoch = last;
    g.point = point;
    g.condition = condition;
    g.from_s = 1e300;
    g.to_s = -1e300;
    double sum = 0.0;
    for (Index u = 0; u < z.size(); ++u) {
      const auto i = static_cast<std::size_t>(u);
      if (problem.component[i] != c || problem.epoch[i] < first || problem.epoch[i] > last) continue;
      if (!point.empty() && problem.place[i].point != point) continue;
      if (in && !in(u)) continue;
      g.units.push_back(u);
      sum += z[u] * z[u];
      g.from_s = std::min(g.from_s, problem.time_s[i]);
      g.to_s = std::max(g.to_s, problem.time_s[i]);
    }
    if (g.units.size() < 4) return;
    g.p = chiSquaredTail(sum, std::max(1.0, static_cast<double>(g.units.size()) * dof_part));
    groups.push_back(std::move(g));
  };
  std::vector<std::string> points;
  for (const std::string& p : problem.series_point) {
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
  std::vector<std::pair<std::string, Eigen::VectorXd>> switches;
  for (const auto& [name, text] : {std::pair<const char*, const char*>{"spindle_rpm^1", "spindle turning"},
                                   {"coolant", "coolant on"},
                                   {"feed_x", "X moving"},
                                   {"feed_y", "Y moving"},
                                   {"feed_z", "Z moving"}}) {
    if (const Driver* d = drivers.find(name)) {
      switches.emplace_back(text, problem.toUnits(drivers.response(*d, 0.0, -1.0, problem.node_time_s)));
    }
  }
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (const DeviationQuery& q : problem.place) {
    low = low.cwiseMin(q.position_mm);
    high = high.cwiseMax(q.position_mm);
  }
  for (const Component c : all_components) {
    for (int parts = 1; parts <= std::min(8, epochs); parts *= 2) {
      for (int k = 0; k < parts; ++k) add(c, k * epochs / parts, (k + 1) * epochs / parts - 1, "", "", nullptr);
    }
    for (const std::string& p : points) add(c, 0, epochs - 1, p, "", nullptr);
    for (const auto& [text, on] : switches) {
      add(c, 0, epochs - 1, "", text, [&on](Index u) { return on[u] > 0.0; });
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (!(high[axis] - low[axis] > 1.0)) continue;
      const double middle = 0.5 * (low[axis] + high[axis]);
      add(c, 0, epochs - 1, "", fmt::format("{} above {:.0f} mm", axis_letters[axis], middle),
          [&problem, axis, middle](Index u) {
            return problem.place[static_cast<std::size_t>(u)].position_mm[axis] > middle;
          });
    }
  }
  const auto count = static_cast<double>(groups.size());
  std::vector<DisagreementPlace> out;
  const auto place = [&](const Group& g) {
    DisagreementPlace d;
    d.component = g.component;
    d.from_s = g.from_s;
    d.to_s = g.to_s;
    d.condition = g.condition;
    d.p_value = std::min(1.0, g.p * count);
    double excess = 0.0;
    for (const Index u : g.units) {
      const double s = problem.sigma[u] * problem.noise.scale;
      excess += (z[u] * z[u] - dof_part) * s * s;
    }
    d.excess_um = std::sqrt(std::max(0.0, excess / static_cast<double>(g.units.size())));
    return d;
  };
  for (const Component c : all_components) {
    // The span of time in which it is clearest, with the points that deviate in it.
    const Group* best = nullptr;
    double best_excess = 0.0;
    for (const Group& g : groups) {
      if (g.component != c || !g.point.empty() || !g.condition.empty() || g.p * count > 0.01) continue;
      const double excess = place(g).excess_um;
      if (best == nullptr || excess > 1.25 * best_excess) {
        best = &g;
        best_excess = excess;
      }
    }
    std::vector<std::string> deviating;
    for (const Group& g : groups) {
      if (g.component == c && !g.point.empty() && g.p * count < 0.01) deviating.push_back(g.point);
    }
    if (best != nullptr) {
      DisagreementPlace d = place(*best);
      d.points = deviating.empty() ? points : deviating;
      out.push_back(std::move(d));
    } else if (!deviating.empty()) {
      for (const Group& g : groups) {
        if (g.component != c || g.point.empty() || g.p * count > 0.01) continue;
        DisagreementPlace d = place(g);
        d.points = {g.point};
        out.push_back(std::move(d));
      }
    }
    const Group* condition = nullptr;
    double condition_excess = best_excess * 1.15;
    for (const Group& g : groups) {
      if (g.component != c || g.condition.empty() || g.p * count > 0.01) continue;
      const double excess = place(g).excess_um;
      if (excess > condition_excess) {
        condition = &g;
        condition_excess = excess;
      }
    }
    if (condition != nullptr) {
      DisagreementPlace d = place(*condition);
      d.points = deviating.empty() ? points : deviating;
      out.push_back(std::move(d));
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const DisagreementPlace& a, const DisagreementPlace& b) { return a.p_value < b.p_value; });
  return out;
}

}  // namespace spindrift
