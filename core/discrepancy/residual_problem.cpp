// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/residual_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

using PlaceKey = std::tuple<double, double, double, double, double, double, double, double, double, double>;

PlaceKey placeKey(const Observation& o) {
  return {o.position_mm.x(),    o.position_mm.y(),   o.position_mm.z(), o.c_deg,
          o.approach.x(),       o.approach.y(),      o.approach.z(),    o.tool_offset_mm.x(),
          o.tool_offset_mm.y(), o.tool_offset_mm.z()};
}

/// Points of one place each, more than this, may be merged with their neighbours.
constexpr std::size_t many_points = 48;
/// Units there may be for each that there might be of merged points, where only readings that follow each other in time
/// can be merged: they are less alike than neighbours are.
constexpr std::size_t units_in_time = 3;

/// Splits points at the median of the longest side until no group has more than `size`; returns the group of each.
void splitPoints(const std::vector<Eigen::Vector3d>& at, std::vector<std::size_t> members, std::size_t size,
                 int& groups, std::vector<int>& group_of) {
  if (members.size() <= size) {
    for (const std::size_t m : members) group_of[m] = groups;
    ++groups;
    return;
  }
  Eigen::Vector3d low = at[members.front()];
  Eigen::Vector3d high = low;
  for (const std::size_t m : members) {
    low = low.cwiseMin(at[m]);
    high = high.cwiseMax(at[m]);
  }
  Index side = 0;
  (high - low).maxCoeff(&side);
  const auto middle = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
  std::nth_element(members.begin(), middle, members.end(), [&](std::size_t a, std::size_t b) {
    return std::make_pair(at[a][side], a) < std::make_pair(at[b][side], b);
  });
  splitPoints(at, {members.begin(), middle}, size, groups, group_of);
  splitPoints(at, {middle, members.end()}, size, groups, group_of);
}

}  // namespace

namespace {

/// Readings of one point in one component: epoch and deviation from its neighbours.
using PointCourse = std::vector<std::pair<int, double>>;

/// Largest |difference of the means before and after| over all onsets, in standard uncertainties.
double largestStep(PointCourse course, double sigma) {
  std::sort(course.begin(), course.end());
  double total = 0.0;
  for (const auto& [epoch_index, value] : course) total += value;
  const auto n = static_cast<double>(course.size());
  double largest = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < course.size(); ++i) {
    sum += course[i].second;
    const double k = static_cast<double>(i + 1);
    if (k < 2.0 || n - k < 2.0) continue;
    largest =
        std::max(largest, std::abs(sum / k - (total - sum) / (n - k)) / (sigma * std::sqrt(1.0 / k + 1.0 / (n - k))));
  }
  return largest;
}

}  // namespace

ResidualProblem::ResidualProblem(const DiscrepancyInput& input, const std::vector<std::size_t>& rows,
                                 std::size_t unit_limit) {
  free_constants = !input.absolute;
  const auto& all = input.observations.rows;
  observations_ = &all;
  // Points, and whether each stays at one place.
  std::map<std::string, std::size_t> point_index;
  std::vector<std::string> point_names;
  std::vector<std::size_t> row_point(rows.size());
  std::vector<PlaceKey> first_place;
  std::vector<std::size_t> first_row;
  bool places_stay = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = all[rows[i]];
    const auto [at, fresh] = point_index.try_emplace(o.point, point_names.size());
    if (fresh) {
      point_names.push_back(o.point);
      first_place.push_back(placeKey(o));
      first_row.push_back(rows[i]);
    } else if (places_stay && placeKey(o) != first_place[at->second]) {
      places_stay = false;
    }
    row_point[i] = at->second;
  }
  for (const std::size_t row : rows) node_time_s.push_back(all[row].time_s);
  std::sort(node_time_s.begin(), node_time_s.end());
  node_time_s.erase(std::unique(node_time_s.begin(), node_time_s.end()), node_time_s.end());
  const auto nodeOf = [&](double t) {
    return static_cast<int>(std::lower_bound(node_time_s.begin(), node_time_s.end(), t) - node_time_s.begin());
  };

  // Epochs: thermal states where they are named, else bins of time.
  std::map<std::string, int> states;
  for (const std::size_t row : rows) states.try_emplace(all[row].state, 0);
  const double span = node_time_s.empty() ? 0.0 : node_time_s.back() - node_time_s.front();
  epochs_are_states = states.size() >= 3 && states.size() <= 400;
  if (epochs_are_states) {
    std::map<std::string, std::pair<double, int>> state_time;
    for (const std::size_t row : rows) {
      auto& [sum, count] = state_time[all[row].state];
      sum += all[row].time_s;
      ++count;
    }
    std::vector<std::pair<double, std::string>> by_time;
    for (const auto& [name, sum] : state_time) by_time.emplace_back(sum.first / sum.second, name);
    std::sort(by_time.begin(), by_time.end());
    for (std::size_t i = 0; i < by_time.size(); ++i) states[by_time[i].second] = static_cast<int>(i);
    epoch_count = static_cast<int>(by_time.size());
  } else {
    epoch_count = static_cast<int>(std::clamp<std::size_t>(node_time_s.size(), 1, 96));
  }
  const auto epochOf = [&](const Observation& o) {
    if (epochs_are_states) return states[o.state];
    if (!(span > 0.0)) return 0;
    return std::min(epoch_count - 1, static_cast<int>((o.time_s - node_time_s.front()) / span * epoch_count));
  };

  // Neighbours that become one unit: points where places stay and states are named, else readings in time.
  const auto perUnit = [&](std::size_t limit) { return std::max<std::size_t>(1, (rows.size() + limit - 1) / limit); };
  const bool merge_points =
      perUnit(unit_limit) > 1 && places_stay && epochs_are_states && point_names.size() > many_points;
  const std::size_t bin = perUnit(merge_points ? unit_limit : units_in_time * unit_limit);
  // States that are merged are the same ones for all series: what shifts a state shifts all of its readings.
  if (!merge_points && epochs_are_states && bin > 1) {
    for (auto& [name, index] : states) index /= static_cast<int>(bin);
    epoch_count = (epoch_count - 1) / static_cast<int>(bin) + 1;
  }
  std::vector<int> group_of(point_names.size());
  if (merge_points) {
    std::vector<Eigen::Vector3d> at;
    for (const std::size_t row : first_row) at.push_back(all[row].position_mm);
    std::vector<std::size_t> members(point_names.size());
    std::iota(members.begin(), members.end(), 0);
    int groups = 0;
    splitPoints(at, members, bin, groups, group_of);
  } else {
    std::iota(group_of.begin(), group_of.end(), 0);
  }
  if (merge_points) {
    // A point that moves against its neighbours is no part of their mean.
    const int groups = 1 + *std::max_element(group_of.begin(), group_of.end());
    std::map<std::tuple<int, int, int>, std::pair<double, double>> mean;
    std::vector<double> level(point_names.size() * 6, 0.0);
    std::vector<double> count(level.size(), 0.0);
    const auto seriesOf = [&](std::size_t i) {
      return row_point[i] * 6 + static_cast<std::size_t>(all[rows[i]].component);
    };
    const auto residualOf = [&](std::size_t i) { return all[rows[i]].value - input.predicted[rows[i]]; };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      level[seriesOf(i)] += residualOf(i);
      count[seriesOf(i)] += 1.0;
    }
    for (std::size_t i = 0; i < level.size(); ++i) level[i] /= std::max(1.0, count[i]);
    const auto keyOf = [&](std::size_t i) {
      return std::make_tuple(group_of[row_point[i]], static_cast<int>(all[rows[i]].component), epochOf(all[rows[i]]));
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      auto& [sum, weight] = mean[keyOf(i)];
      sum += residualOf(i) - level[seriesOf(i)];
      weight += 1.0;
    }
    std::vector<PointCourse> course(level.size());
    std::vector<double> magnitudes;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& [sum, weight] = mean[keyOf(i)];
      const double apart = residualOf(i) - level[seriesOf(i)] - sum / weight;
      course[seriesOf(i)].emplace_back(epochOf(all[rows[i]]), apart / all[rows[i]].sigma);
      magnitudes.push_back(std::abs(apart) / all[rows[i]].sigma);
    }
    const double scale = std::max(1e-9, 1.4826 * median(magnitudes));
    constexpr double clear_step = 9.0;
    constexpr std::size_t most_alone = 24;
    std::vector<std::pair<double, std::size_t>> alone;
    for (std::size_t p = 0; p < point_names.size(); ++p) {
      double step = 0.0;
      for (std::size_t c = 0; c < 6; ++c) step = std::max(step, largestStep(course[p * 6 + c], scale));
      if (step > clear_step) alone.emplace_back(-step, p);
    }
    std::sort(alone.begin(), alone.end());
    if (alone.size() > most_alone) alone.resize(most_alone);
    int next = groups;
    for (const auto& [step, p] : alone) {
      group_of[p] = next++;
      own_points.push_back(point_names[p]);
    }
    // Groups that lost all their points are closed up.
    std::map<int, int> renumbered;
    for (int& g : group_of) g = renumbered.try_emplace(g, static_cast<int>(renumbered.size())).first->second;
  } else {
    own_points = point_names;
  }
  const int group_count = 1 + (group_of.empty() ? -1 : *std::max_element(group_of.begin(), group_of.end()));
  std::vector<std::vector<std::size_t>> group_points(static_cast<std::size_t>(group_count));
  for (std::size_t p = 0; p < group_of.size(); ++p) group_points[static_cast<std::size_t>(group_of[p])].push_back(p);

  // Of merged points the level of each is taken out first, so that a reading that is missing moves no mean.
  std::vector<double> level(merge_points ? point_names.size() * 6 : 0, 0.0);
  if (merge_points && free_constants) {
    std::vector<double> count(level.size(), 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t at = row_point[i] * 6 + static_cast<std::size_t>(all[rows[i]].component);
      level[at] += all[rows[i]].value - input.predicted[rows[i]];
      count[at] += 1.0;
    }
    for (std::size_t i = 0; i < level.size(); ++i) level[i] = count[i] > 0.0 ? level[i] / count[i] : 0.0;
  }

  const auto seriesKey = [&](std::size_t i) {
    return std::make_pair(static_cast<int>(all[rows[i]].component), group_of[row_point[i]]);
  };
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto first = seriesKey(a);
    const auto second = seriesKey(b);
    return first != second ? first < second : all[rows[a]].time_s < all[rows[b]].time_s;
  });

  std::vector<Index> unit_of_row(all.size(), -1);
  std::vector<double> values;
  std::vector<double> predictions;
  std::vector<double> sigmas;
  std::vector<double> reading_sigmas;
  node_begin_.push_back(0);
  struct Bin {
    double time = 0.0;
    std::vector<std::size_t> members;
  };
  std::size_t i = 0;
  while (i < order.size()) {
    const auto key = seriesKey(order[i]);
    std::size_t end = i;
    while (end < order.size() && seriesKey(order[end]) == key) ++end;
    std::vector<Bin> bins;
    if (merge_points) {
      std::map<int, std::vector<std::size_t>> by_epoch;
      for (std::size_t m = i; m < end; ++m) by_epoch[epochOf(all[rows[order[m]]])].push_back(order[m]);
      for (auto& [epoch_index, members] : by_epoch) bins.push_back({0.0, std::move(members)});
    } else {
      // Grouped by place and states, each group cut into bins of neighbours in time.
      std::map<std::pair<PlaceKey, int>, std::vector<std::size_t>> groups;
      for (std::size_t m = i; m < end; ++m) {
        const Observation& o = all[rows[order[m]]];
        groups[{placeKey(o), epochs_are_states ? epochOf(o) : 0}].push_back(order[m]);
      }
      for (const auto& [group, members] : groups) {
        for (std::size_t from = 0; from < members.size(); from += bin) {
          const std::size_t to = std::min(members.size(), from + bin);
          bins.push_back({0.0,
                          {members.begin() + static_cast<std::ptrdiff_t>(from),
                           members.begin() + static_cast<std::ptrdiff_t>(to)}});
        }
      }
    }
    for (Bin& b : bins) {
      for (const std::size_t m : b.members) b.time += all[rows[m]].time_s / static_cast<double>(b.members.size());
    }
    std::stable_sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.time < b.time; });
    series_begin.push_back(static_cast<Index>(values.size()));
    series_point.push_back(point_names[row_point[order[i]]]);
    members_.emplace_back();
    if (merge_points) {
      for (const std::size_t p : group_points[static_cast<std::size_t>(key.second)]) {
        members_.back().push_back(DeviationQuery::of(all[first_row[p]]));
      }
    }
    for (const Bin& b : bins) {
      double value = 0.0;
      double prediction = 0.0;
      double power = 0.0;
      const double count = static_cast<double>(b.members.size());
      std::vector<std::size_t> observations;
      std::map<int, int> nodes;  // how many readings were taken at each
      for (const std::size_t m : b.members) {
        const std::size_t row = rows[m];
        value += all[row].value - input.predicted[row];
        if (!level.empty()) value -= level[row_point[m] * 6 + static_cast<std::size_t>(all[row].component)];
        prediction += input.predicted[row];
        power += all[row].sigma * all[row].sigma;
        ++nodes[nodeOf(all[row].time_s)];
        unit_of_row[row] = static_cast<Index>(values.size());
        observations.push_back(row);
      }
      const Observation& o = all[rows[b.members.front()]];
      DeviationQuery query = DeviationQuery::of(o);
      query.time_s = b.time;
      place.push_back(std::move(query));
      component.push_back(o.component);
      series.push_back(static_cast<int>(series_begin.size()) - 1);
      time_s.push_back(b.time);
      epoch.push_back(epochOf(o));
      values.push_back(value / count);
      predictions.push_back(prediction / count);
      sigmas.push_back(std::sqrt(power) / count);
      reading_sigmas.push_back(std::sqrt(power / count));
      for (const auto& [node, readings] : nodes) node_weights_.push_back({node, readings / count});
      node_begin_.push_back(node_weights_.size());
      unit_rows.push_back(std::move(observations));
    }
    i = end;
  }
  series_begin.push_back(static_cast<Index>(values.size()));
  y = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
  simulated = Eigen::Map<Eigen::VectorXd>(predictions.data(), y.size());
  sigma = Eigen::Map<Eigen::VectorXd>(sigmas.data(), y.size());
  reading_sigma = Eigen::Map<Eigen::VectorXd>(reading_sigmas.data(), y.size());
  epoch_time_s.assign(static_cast<std::size_t>(epoch_count), 0.0);
  std::vector<int> counts(static_cast<std::size_t>(epoch_count), 0);
  for (std::size_t u = 0; u < epoch.size(); ++u) {
    epoch_time_s[static_cast<std::size_t>(epoch[u])] += time_s[u];
    ++counts[static_cast<std::size_t>(epoch[u])];
  }
  for (std::size_t e = 0; e < counts.size(); ++e) epoch_time_s[e] /= std::max(1, counts[e]);

  takeShared(input.observations.shared, unit_of_row);
  makeNeighbourhoods();
  makeDomains();
  makeCoupled();
  setNoise({});
}

void ResidualProblem::takeShared(const SharedNoise& shared, const std::vector<Index>& unit_of_row) {
  if (shared.empty()) return;
  // A load below this part of the unit's sigma is own noise: it couples nothing that anybody could see.
  constexpr double negligible = 1e-4;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(size());
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(size());
  for (const SharedNoise::Factor& factor : shared.factors()) {
    std::set<Index> touched;
    for (const SharedNoise::Load& l : factor) {
      const Index u = l.row < unit_of_row.size() ? unit_of_row[l.row] : -1;
      if (u < 0) continue;
      sum[u] += l.load / static_cast<double>(unit_rows[static_cast<std::size_t>(u)].size());
      touched.insert(u);
    }
    UnitFactor loads;
    for (const Index u : touched) {
      variance[u] += sum[u] * sum[u];
      loads.push_back({u, sum[u]});
      sum[u] = 0.0;
    }
    if (!loads.empty()) shared_.push_back(std::move(loads));
  }
  for (Index u = 0; u < size(); ++u) {
    const std::vector<std::size_t>& rows = unit_rows[static_cast<std::size_t>(u)];
    if (std::none_of(rows.begin(), rows.end(), [&](std::size_t row) { return shared.variance(row) > 0.0; })) continue;
    double own = 0.0;
    for (const std::size_t row : rows) own += shared.ownVariance(row, (*observations_)[row].sigma);
    const double count = static_cast<double>(rows.size());
    sigma[u] = std::sqrt(std::max(1e-12, own / (count * count) + variance[u]));
  }
  for (UnitFactor& factor : shared_)
    std::erase_if(factor, [&](const UnitLoad& l) { return !(std::abs(l.load) > negligible * sigma[l.unit]); });
  std::erase_if(shared_, [](const UnitFactor& factor) { return factor.size() < 2; });
}

void ResidualProblem::makeNeighbourhoods() {
  neighbourhood = series;
  neighbourhood_count = seriesCount();
  constexpr Index few_readings = 3;
  const bool merged = std::any_of(members_.begin(), members_.end(), [](const auto& points) { return !points.empty(); });
  const bool wandering = !free_constants && size() < few_readings * seriesCount();
  if (!merged && !wandering) return;
  constexpr std::size_t most_neighbourhoods = 12;
  // Series of merged points stay whole, readings at places of their own stand for themselves.
  const auto itemOf = [&](std::size_t unit) { return merged ? static_cast<std::size_t>(series[unit]) : unit; };
  std::vector<Eigen::Vector3d> at(merged ? static_cast<std::size_t>(seriesCount()) : place.size());
  std::array<std::vector<std::size_t>, 6> members;
  for (std::size_t u = 0; u < place.size(); ++u) {
    at[itemOf(u)] = place[u].position_mm;
    std::vector<std::size_t>& of_component = members[static_cast<std::size_t>(component[u])];
    if (of_component.empty() || of_component.back() != itemOf(u)) of_component.push_back(itemOf(u));
  }
  neighbourhood_count = 0;
  std::vector<int> of_item(at.size(), 0);
  for (const std::vector<std::size_t>& of_component : members) {
    if (of_component.empty()) continue;
    const std::size_t each = (of_component.size() + most_neighbourhoods - 1) / most_neighbourhoods;
    splitPoints(at, of_component, merged ? each : std::max<std::size_t>(each, 4), neighbourhood_count, of_item);
  }
  for (std::size_t u = 0; u < place.size(); ++u) neighbourhood[u] = of_item[itemOf(u)];
}

Eigen::VectorXd ResidualProblem::toUnits(const Eigen::VectorXd& at_nodes) const {
  Eigen::VectorXd out(size());
  for (Index u = 0; u < size(); ++u) {
    const std::size_t from = node_begin_[static_cast<std::size_t>(u)];
    const std::size_t to = node_begin_[static_cast<std::size_t>(u) + 1];
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += node_weights_[k].weight * at_nodes[node_weights_[k].node];
    out[u] = sum;
  }
  return out;
}

Eigen::MatrixXd ResidualProblem::shapeAtUnits(const Effect& effect) const {
  const auto columns = static_cast<Index>(effect.shape.size());
  Eigen::MatrixXd s(size(), columns);
  if (effect.over_time) {
    for (Index u = 0; u < size(); ++u) {
      const std::vector<std::size_t>& rows = unit_rows[static_cast<std::size_t>(u)];
      for (Index k = 0; k < columns; ++k) {
        double sum = 0.0;
        for (const std::size_t row : rows) {
          const Observation& o = (*observations_)[row];
          sum += effect.shape[static_cast<std::size_t>(k)].value(DeviationQuery::of(o), o.component);
        }
        s(u, k) = sum / static_cast<double>(rows.size());
      }
    }
    return s;
  }
  for (int i = 0; i < seriesCount(); ++i) {
    const Index from = series_begin[static_cast<std::size_t>(i)];
    const Index to = series_begin[static_cast<std::size_t>(i) + 1];
    const auto& members = members_[static_cast<std::size_t>(i)];
    const Component c = component[static_cast<std::size_t>(from)];
    for (Index k = 0; k < columns; ++k) {
      const ShapeFunction& value = effect.shape[static_cast<std::size_t>(k)].value;
      if (!members.empty()) {
        double sum = 0.0;
        for (const DeviationQuery& q : members) sum += value(q, c);
        s.col(k).segment(from, to - from).setConstant(sum / static_cast<double>(members.size()));
      } else {
        for (Index u = from; u < to; ++u) s(u, k) = value(place[static_cast<std::size_t>(u)], c);
      }
    }
  }
  return s;
}

void ResidualProblem::makeDomains() {
  // One domain for each component; noise that components share joins all that lies between them.
  std::set<int> joined;
  for (const UnitFactor& factor : shared_) {
    // Units are ordered by component.
    const int first = static_cast<int>(component[static_cast<std::size_t>(factor.front().unit)]);
    const int last = static_cast<int>(component[static_cast<std::size_t>(factor.back().unit)]);
    for (int k = first; k < last; ++k) joined.insert(k);
  }
  domains_.clear();
  for (Index u = 0; u < size(); ++u) {
    const auto c = component[static_cast<std::size_t>(u)];
    const bool first = u == 0 || c != component[static_cast<std::size_t>(u - 1)];
    if (first) {
      bool join = u > 0;
      if (join) {
        const int before = static_cast<int>(component[static_cast<std::size_t>(u - 1)]);
        for (int k = before; k < static_cast<int>(c); ++k) join = join && joined.contains(k);
      }
      if (!join) domains_.push_back({u, 0});
    }
    ++domains_.back().count;
  }
}

void ResidualProblem::makeCoupled() {
  coupled_.clear();
  wide_.resize(size(), 0);
  wide_variance_ = Eigen::VectorXd::Zero(size());
  // Factors that many series share are few, and taken as such, if enough own noise stands behind them.
  constexpr std::size_t many_series = 12;
  constexpr std::size_t most_wide = 48;
  constexpr double least_own = 1e-4;
  Eigen::VectorXd own = sigma.cwiseAbs2();
  for (const UnitFactor& factor : shared_)
    for (const UnitLoad& l : factor) own[l.unit] -= l.load * l.load;
  const auto seriesOf = [&](const UnitLoad& l) { return series[static_cast<std::size_t>(l.unit)]; };
  std::vector<const UnitFactor*> wide;
  std::vector<const UnitFactor*> narrow;
  for (const UnitFactor& factor : shared_) {
    std::set<int> touched;
    for (const UnitLoad& l : factor) touched.insert(seriesOf(l));
    const bool behind = std::all_of(factor.begin(), factor.end(), [&](const UnitLoad& l) {
      return own[l.unit] > least_own * sigma[l.unit] * sigma[l.unit];
    });
    (touched.size() > many_series && behind ? wide : narrow).push_back(&factor);
  }
  if (wide.size() > most_wide) {
    narrow.insert(narrow.end(), wide.begin(), wide.end());
    wide.clear();
  }
  wide_ = Eigen::MatrixXd::Zero(size(), static_cast<Index>(wide.size()));
  for (std::size_t k = 0; k < wide.size(); ++k)
    for (const UnitLoad& l : *wide[k]) wide_(l.unit, static_cast<Index>(k)) = l.load;
  wide_variance_ = wide_.rowwise().squaredNorm();
  // Series that the others couple.
  std::vector<int> root(static_cast<std::size_t>(seriesCount()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int s) {
    while (root[static_cast<std::size_t>(s)] != s) s = root[static_cast<std::size_t>(s)];
    return s;
  };
  for (const UnitFactor* factor : narrow) {
    for (const UnitLoad& l : *factor) {
      const int a = find(seriesOf(factor->front()));
      const int b = find(seriesOf(l));
      root[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::map<int, std::vector<const UnitFactor*>> factors;
  for (const UnitFactor* factor : narrow) factors[find(seriesOf(factor->front()))].push_back(factor);
  std::map<int, std::vector<Index>> units;
  for (Index u = 0; u < size(); ++u) {
    const int r = find(series[static_cast<std::size_t>(u)]);
    if (factors.contains(r)) units[r].push_back(u);
  }
  std::vector<Index> at(static_cast<std::size_t>(size()), -1);
  for (auto& [r, members] : units) {
    const auto m = static_cast<Index>(members.size());
    for (Index i = 0; i < m; ++i) at[static_cast<std::size_t>(members[static_cast<std::size_t>(i)])] = i;
    // In slices: there may be as many factors as units.
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(m, m);
    constexpr std::size_t slice = 64;
    const std::vector<const UnitFactor*>& all = factors[r];
    for (std::size_t from = 0; from < all.size(); from += slice) {
      const std::size_t to = std::min(all.size(), from + slice);
      Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(m, static_cast<Index>(to - from));
      for (std::size_t k = from; k < to; ++k)
        for (const UnitLoad& l : *all[k])
          loads(at[static_cast<std::size_t>(l.unit)], static_cast<Index>(k - from)) = l.load;
      covariance.selfadjointView<Eigen::Lower>().rankUpdate(loads);
    }
    covariance.triangularView<Eigen::StrictlyUpper>() = covariance.transpose();
    coupled_.push_back({std::move(members), std::move(covariance)});
  }
}

double ResidualProblem::slowPart(Index unit) const {
  const ComponentNoise& n = noise.of(component[static_cast<std::size_t>(unit)]);
  return n.correlation_time_s > 0.0 ? n.correlated_part : 0.0;
}

void ResidualProblem::makeBlocks() {
  blocks_.assign(domains_.size(), {});
  diagonal_whitener_.resize(size());
  const auto weightOf = [&](Index u) { return noise.weight.size() == 0 ? 1.0 : noise.weight[u]; };
  // Without the factors of many series, which stand beside the blocks.
  const auto varianceOf = [&](Index u) {
    const double a = slowPart(u);
    const double scale = noise.of(component[static_cast<std::size_t>(u)]).scale;
    return ownSigma(u) * ownSigma(u) * (a + (1.0 - a) / weightOf(u)) - scale * scale * (1.0 - a) * wide_variance_[u];
  };
  for (Index u = 0; u < size(); ++u) {
    diagonal_whitener_[u] =
        wide_variance_[u] > 0.0 ? 1.0 / std::sqrt(varianceOf(u)) : std::sqrt(weightOf(u)) / ownSigma(u);
  }
  // Blocks: series that are coupled, and those whose noise follows itself.
  std::vector<std::pair<std::vector<Index>, const Eigen::MatrixXd*>> members;
  std::vector<bool> taken(static_cast<std::size_t>(seriesCount()), false);
  for (const Coupled& c : coupled_) {
    members.emplace_back(c.units, &c.covariance);
    for (const Index u : c.units) taken[static_cast<std::size_t>(series[static_cast<std::size_t>(u)])] = true;
  }
  for (std::size_t s = 0; s < taken.size(); ++s) {
    if (taken[s] || !(slowPart(series_begin[s]) > 0.0)) continue;
    members.emplace_back(std::vector<Index>(), nullptr);
    for (Index u = series_begin[s]; u < series_begin[s + 1]; ++u) members.back().first.push_back(u);
  }
  for (auto& [units, shared] : members) {
    const auto m = static_cast<Index>(units.size());
    Eigen::VectorXd load_scale(m);
    for (Index i = 0; i < m; ++i) {
      const Index u = units[static_cast<std::size_t>(i)];
      load_scale[i] = noise.of(component[static_cast<std::size_t>(u)]).scale * std::sqrt(1.0 - slowPart(u));
    }
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(m, m);
    if (shared != nullptr) c = load_scale.asDiagonal() * *shared * load_scale.asDiagonal();
    for (Index i = 0; i < m; ++i) {
      const Index u = units[static_cast<std::size_t>(i)];
      const ComponentNoise& n = noise.of(component[static_cast<std::size_t>(u)]);
      c(i, i) = varianceOf(u);
      const double a = slowPart(u);
      if (!(a > 0.0)) continue;
      const double si = ownSigma(u);
      for (Index j = i - 1; j >= 0; --j) {
        const Index v = units[static_cast<std::size_t>(j)];
        if (series[static_cast<std::size_t>(v)] != series[static_cast<std::size_t>(u)]) break;
        const double dt = std::abs(time_s[static_cast<std::size_t>(u)] - time_s[static_cast<std::size_t>(v)]);
        c(i, j) += si * ownSigma(v) * a * std::exp(-dt / n.correlation_time_s);
        c(j, i) = c(i, j);
      }
    }
    // Positive semidefinite as it is made; without any own noise it may be singular.
    Eigen::LLT<Eigen::MatrixXd> llt(c);
    double raised = 1e-9;
    while (llt.info() != Eigen::Success && raised < 10.0) {
      Eigen::MatrixXd with = c;
      with.diagonal() *= 1.0 + raised;
      llt.compute(with);
      raised *= 10.0;
    }
    Block block{std::move(units), llt.matrixL().solve(Eigen::MatrixXd::Identity(m, m))};
    for (std::size_t d = 0; d < domains_.size(); ++d) {
      if (block.units.front() >= domains_[d].from && block.units.front() < domains_[d].from + domains_[d].count) {
        blocks_[d].push_back(std::move(block));
        break;
      }
    }
  }
}

void ResidualProblem::takeDrift(const NoiseModel& drifts, const ShiftColumns& shifts, Eigen::MatrixXd& factor) const {
  for (auto from = shifts.begin(); from != shifts.end();) {
    const int c = from->first.first;
    const auto to = shifts.lower_bound({c + 1, 0});
    const ComponentNoise& n = drifts.component[static_cast<std::size_t>(c)];
    if (n.drift_part > 0.0) {
      std::vector<double> times_s;
      std::vector<Index> columns;
      for (auto at = from; at != to; ++at) {
        times_s.push_back(epoch_time_s[static_cast<std::size_t>(at->first.second)]);
        columns.push_back(at->second);
      }
      factor(columns, columns) = shiftFactor(times_s, n.drift_part, n.drift_time_s);
    }
    from = to;
  }
}

void ResidualProblem::LowRank::takeOutOf(Eigen::Ref<Eigen::MatrixXd> x) const {
  if (columns.cols() == 0) return;
  const Eigen::MatrixXd dots = columns.transpose() * x;
  const Eigen::MatrixXd part = weight * dots;
  x.noalias() -= columns * part;
}

ResidualProblem::LowRank ResidualProblem::shiftsOf(std::size_t d, const NoiseModel& drifts) const {
  const Domain& domain = domains_[d];
  ShiftColumns shifts;
  for (Index u = domain.from; u < domain.from + domain.count; ++u) {
    const Component c = component[static_cast<std::size_t>(u)];
    if (!(noise.of(c).common > 0.0)) continue;
    shifts.try_emplace({static_cast<int>(c), epoch[static_cast<std::size_t>(u)]}, static_cast<Index>(shifts.size()));
  }
  std::vector<Index> factors;
  for (Index k = 0; k < wide_.cols(); ++k)
    if (!wide_.col(k).segment(domain.from, domain.count).isZero(0.0)) factors.push_back(k);
  if (shifts.empty() && factors.empty()) return {};
  const auto shift_count = static_cast<Index>(shifts.size());
  Eigen::MatrixXd z = Eigen::MatrixXd::Zero(domain.count, shift_count + static_cast<Index>(factors.size()));
  for (Index u = domain.from; u < domain.from + domain.count; ++u) {
    const Component c = component[static_cast<std::size_t>(u)];
    const auto at = shifts.find({static_cast<int>(c), epoch[static_cast<std::size_t>(u)]});
    if (at != shifts.end()) z(u - domain.from, at->second) = drifts.of(c).common;
    const double load_scale = noise.of(c).scale * std::sqrt(1.0 - slowPart(u));
    for (std::size_t k = 0; k < factors.size(); ++k)
      z(u - domain.from, shift_count + static_cast<Index>(k)) = load_scale * wide_(u, factors[k]);
  }
  whitenOwn(d, z);
  Eigen::MatrixXd factor = Eigen::MatrixXd::Identity(z.cols(), z.cols());
  takeDrift(drifts, shifts, factor);
  LowRank out;
  out.columns = z.sparseView();
  // z factor = U sqrt(lambda) V'; (1 + lambda)^(-1/2) along U.
  const Eigen::MatrixXd gram(Eigen::SparseMatrix<double>(out.columns.transpose() * out.columns));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(factor.transpose() * gram * factor);
  const Eigen::MatrixXd turned = factor * eigen.eigenvectors();
  Eigen::VectorXd part(z.cols());
  for (Index k = 0; k < z.cols(); ++k) {
    const double lambda = eigen.eigenvalues()[k];
    part[k] = lambda > 1e-9 ? (1.0 - 1.0 / std::sqrt(1.0 + lambda)) / lambda : 0.0;
  }
  out.weight = turned * part.asDiagonal() * turned.transpose();
  return out;
}

void ResidualProblem::setNoise(const NoiseModel& model) {
  noise = model;
  makeBlocks();
  const NoiseModel drifts = asInstrumentsDrift(*this, noise);
  domain_noise_.assign(domains_.size(), {});
  for (std::size_t d = 0; d < domains_.size(); ++d) {
    const Domain& domain = domains_[d];
    DomainNoise& n = domain_noise_[d];
    n.shifts = shiftsOf(d, drifts);
    n.shifts_and_constants = n.shifts;
    if (!free_constants) continue;
    std::vector<std::pair<Index, Index>> ranges;
    for (int s = 0; s < seriesCount(); ++s) {
      const Index from = series_begin[static_cast<std::size_t>(s)];
      if (from < domain.from || from >= domain.from + domain.count) continue;
      ranges.emplace_back(from - domain.from, series_begin[static_cast<std::size_t>(s) + 1] - from);
    }
    const auto count = static_cast<Index>(ranges.size());
    Eigen::MatrixXd ones = Eigen::MatrixXd::Zero(domain.count, count);
    for (std::size_t s = 0; s < ranges.size(); ++s) {
      ones.col(static_cast<Index>(s)).segment(ranges[s].first, ranges[s].second).setOnes();
    }
    whitenOwn(d, ones);
    ones.colwise().normalize();
    n.constant_count = count;
    // B = (Z, ones): shifts leave H = 1 - Z M Z', the constants become H ones = B K, and without them stays
    // (1 - B K N (B K)') H = 1 - B G B' with N = ((B K)' B K)^-1.
    const Index shifts = n.shifts.columns.cols();
    Eigen::SparseMatrix<double>& all = n.shifts_and_constants.columns;
    Eigen::MatrixXd dense(domain.count, shifts + count);
    if (shifts > 0) dense.leftCols(shifts) = n.shifts.columns;
    dense.rightCols(count) = ones;
    all = dense.sparseView();
    const Eigen::MatrixXd gram(Eigen::SparseMatrix<double>(all.transpose() * all));
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(shifts + count, count);
    k.bottomRows(count).setIdentity();
    k.topRows(shifts) = -n.shifts.weight * gram.topRightCorner(shifts, count);
    const Eigen::MatrixXd of_constants = k.transpose() * gram;
    const Eigen::MatrixXd inverse = (of_constants * k).ldlt().solve(Eigen::MatrixXd::Identity(count, count));
    Eigen::MatrixXd& weight = n.shifts_and_constants.weight;
    Eigen::MatrixXd left = k.transpose();
    left.leftCols(shifts) -= of_constants.leftCols(shifts) * n.shifts.weight;
    weight = k * (inverse * left);
    weight.topLeftCorner(shifts, shifts) += n.shifts.weight;
  }
  setNuisances(nuisances_);
}

void ResidualProblem::whitenOwn(std::size_t d, Eigen::Ref<Eigen::MatrixXd> rows) const {
  const Domain& domain = domains_[d];
  // Blocks first from the raw rows; everything else is diagonal.
  std::vector<Eigen::MatrixXd> block_rows;
  for (const Block& b : blocks_[d]) {
    Eigen::MatrixXd part(static_cast<Index>(b.units.size()), rows.cols());
    for (Index i = 0; i < part.rows(); ++i) part.row(i) = rows.row(b.units[static_cast<std::size_t>(i)] - domain.from);
    block_rows.emplace_back(b.whitener.triangularView<Eigen::Lower>() * part);
  }
  rows.array().colwise() *= diagonal_whitener_.segment(domain.from, domain.count).array();
  for (std::size_t k = 0; k < block_rows.size(); ++k) {
    const Block& b = blocks_[d][k];
    for (Index i = 0; i < block_rows[k].rows(); ++i) {
      rows.row(b.units[static_cast<std::size_t>(i)] - domain.from) = block_rows[k].row(i);
    }
  }
}

void ResidualProblem::whitenDomain(std::size_t d, Eigen::Ref<Eigen::MatrixXd> rows) const {
  whitenOwn(d, rows);
  domain_noise_[d].shifts.takeOutOf(rows);
}

Eigen::MatrixXd ResidualProblem::withoutConstants(std::size_t d, const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd out = columns;
  if (out.cols() == 0) return out;
  whitenOwn(d, out);
  domain_noise_[d].shifts_and_constants.takeOutOf(out);
  return out;
}

Eigen::VectorXd ResidualProblem::centred(Eigen::VectorXd values) const {
  for (int s = 0; s < seriesCount() && free_constants; ++s) {
    const Index from = series_begin[static_cast<std::size_t>(s)];
    const Index count = series_begin[static_cast<std::size_t>(s) + 1] - from;
    values.segment(from, count).array() -= values.segment(from, count).mean();
  }
  return values;
}

Eigen::MatrixXd ResidualProblem::whitened(const Eigen::MatrixXd& columns) const {
  if (columns.cols() == 0) return columns;  // Eigen's triangular product reads the first element of nothing
  Eigen::MatrixXd out = columns;
  for (std::size_t d = 0; d < domains_.size(); ++d) {
    whitenDomain(d, out.middleRows(domains_[d].from, domains_[d].count));
  }
  return out;
}

void ResidualProblem::setNuisances(const std::vector<NuisanceColumn>& columns) {
  nuisances_ = columns;
  const Index n = size();
  prior_rows_ =
      std::count_if(columns.begin(), columns.end(), [](const NuisanceColumn& c) { return c.prior_sigma > 0.0; });
  Eigen::MatrixXd raw(n, static_cast<Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) raw.col(static_cast<Index>(c)) = columns[c].values;
  Eigen::MatrixXd augmented = freeOfConstants(raw);
  Eigen::VectorXd before = whitened(raw).colwise().norm();
  Index prior = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!(columns[c].prior_sigma > 0.0)) continue;
    augmented(n + prior++, static_cast<Index>(c)) = 1.0 / columns[c].prior_sigma;
    before[static_cast<Index>(c)] += 1.0 / columns[c].prior_sigma;
  }
  // Gram-Schmidt, twice, dropping what depends on the columns before it. Free columns come first, so that the
  // determinant is of what the others have beside them; then those of one domain, which stay in it.
  const auto rank = [&](Index c) {
    const auto domains = std::count_if(domains_.begin(), domains_.end(), [&](const Domain& d) {
      return !augmented.col(c).segment(d.from, d.count).isZero(0.0);
    });
    return std::pair(columns[static_cast<std::size_t>(c)].prior_sigma > 0.0, domains > 1);
  };
  std::vector<Index> order(columns.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return rank(a) < rank(b); });
  Eigen::MatrixXd basis(augmented.rows(), augmented.cols());
  Index used = 0;
  nuisance_log_det_ = 0.0;
  for (const Index c : order) {
    Eigen::VectorXd v = augmented.col(c);
    for (int pass = 0; pass < 2; ++pass) {
      v.noalias() -= basis.leftCols(used) * (basis.leftCols(used).transpose() * v);
    }
    const double norm = v.norm();
    if (!(norm > 1e-7 * before[c]) || !(norm > 0.0)) continue;
    basis.col(used++) = v / norm;
    const double prior_sigma = columns[static_cast<std::size_t>(c)].prior_sigma;
    if (prior_sigma > 0.0) nuisance_log_det_ += 2.0 * std::log(norm * prior_sigma);
  }
  q_ = basis.leftCols(used);
  q_parts_ = partsOf(q_);
  projected_y_ = projected(y);
}

std::vector<ResidualProblem::BasisPart> ResidualProblem::partsOf(const Eigen::MatrixXd& basis) const {
  std::vector<BasisPart> parts(domains_.size());
  for (std::size_t d = 0; d < domains_.size(); ++d) {
    const auto rows = basis.middleRows(domains_[d].from, domains_[d].count);
    for (Index c = 0; c < basis.cols(); ++c) {
      if (!rows.col(c).isZero(0.0)) parts[d].columns.push_back(c);
    }
    parts[d].rows = rows(Eigen::all, parts[d].columns);
  }
  return parts;
}

Eigen::MatrixXd ResidualProblem::freeOfConstants(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size() + prior_rows_, columns.cols());
  if (columns.cols() == 0) return out;
  for (std::size_t d = 0; d < domains_.size(); ++d) {
    const Domain& domain = domains_[d];
    const auto rows = columns.middleRows(domain.from, domain.count);
    if (rows.isZero(0.0)) continue;
    out.middleRows(domain.from, domain.count) = withoutConstants(d, rows);
  }
  return out;
}

Eigen::MatrixXd ResidualProblem::projected(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd out = freeOfConstants(columns);
  if (q_.cols() == 0 || out.cols() == 0) return out;
  Eigen::MatrixXd dots = Eigen::MatrixXd::Zero(q_.cols(), out.cols());
  for (std::size_t d = 0; d < domains_.size(); ++d) {
    if (q_parts_[d].columns.empty()) continue;
    dots(q_parts_[d].columns, Eigen::all) +=
        q_parts_[d].rows.transpose() * out.middleRows(domains_[d].from, domains_[d].count);
  }
  for (std::size_t d = 0; d < domains_.size(); ++d) {
    if (q_parts_[d].columns.empty()) continue;
    out.middleRows(domains_[d].from, domains_[d].count).noalias() -=
        q_parts_[d].rows * Eigen::MatrixXd(dots(q_parts_[d].columns, Eigen::all));
  }
  // The priors' rows are zero in what comes in.
  if (prior_rows_ > 0) out.bottomRows(prior_rows_).noalias() -= q_.bottomRows(prior_rows_) * dots;
  return out;
}

ResidualProblem::NuisancePart ResidualProblem::nuisancePart(const Eigen::VectorXd& values) const {
  const auto count = static_cast<Index>(nuisances_.size());
  if (count == 0) return {Eigen::VectorXd::Zero(size()), 0.0, {}, {}};
  Eigen::MatrixXd raw(size(), count + 1);
  Eigen::VectorXd precision(count);
  for (Index c = 0; c < count; ++c) {
    const NuisanceColumn& column = nuisances_[static_cast<std::size_t>(c)];
    raw.col(c) = column.values;
    precision[c] = column.prior_sigma > 0.0 ? 1.0 / (column.prior_sigma * column.prior_sigma) : 1e-9;
  }
  raw.col(count) = values;
  Eigen::MatrixXd x(size(), count + 1);
  for (std::size_t d = 0; d < domains_.size(); ++d) {
    x.middleRows(domains_[d].from, domains_[d].count) =
        withoutConstants(d, raw.middleRows(domains_[d].from, domains_[d].count));
  }
  Eigen::MatrixXd gram = x.leftCols(count).transpose() * x.leftCols(count);
  gram.diagonal() += precision;
  const Eigen::MatrixXd inverse = gram.ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::VectorXd b = inverse * (x.leftCols(count).transpose() * x.col(count));
  NuisancePart out{raw.leftCols(count) * b, b.cwiseAbs2().dot(precision), {}, {}};
  for (Index c = 0; c < count; ++c) {
    out.coefficients.push_back(b[c]);
    out.variances.push_back(inverse(c, c));
  }
  return out;
}

int ResidualProblem::degreesOfFreedom() const noexcept {
  Index free = size() + prior_rows_ - q_.cols();
  for (const DomainNoise& n : domain_noise_) free -= n.constant_count;
  return static_cast<int>(free);
}

}  // namespace spindrift
