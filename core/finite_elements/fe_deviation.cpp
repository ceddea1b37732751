// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/fe_deviation.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/geometry/small_error.h"

namespace spindrift {
namespace {

/// Nodes of one selection with what turns their displacements into displacement and rotation.
struct Body {
  std::vector<NodeId> nodes;
  std::vector<Eigen::Vector3d> arm_mm;  ///< from their mean, MCF; empty where places are not known
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();
  bool turns = false;  ///< the nodes determine a rotation
  Eigen::Vector3d mean_mm = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> lever_mm;  ///< from the mean to `at_mm`
};

/// One row of observe.csv.
struct Weight {
  NodeId node = 0;
  int dof = 0;
  double weight = 0.0;
};

double lengthFactor(const std::string& unit) {
  return unit == "m" ? 1000.0 : 1.0;
}

std::string fileName(const std::filesystem::path& file) {
  return file.filename().string();
}

class Import {
 public:
  Import(const FeMap& map, const FeReaderFactory& open, JobContext& job) : map_(map), job_(job) {
    map_.validate();
    if (map_.result.empty()) {
      throw InputError({map_.file, map_.file.empty() ? "" : "$"},
                       "names no result; allowed: \"result\": \"mech.frd\", or the file on the command line.");
    }
    to_mm_ = lengthFactor(map_.unit_of_displacement);
    length_to_mm_ = lengthFactor(map_.unit_of_length.empty() ? map_.unit_of_displacement : map_.unit_of_length);
    reader_ = open(map_.result);
    job_.report(0.0, "reading the mesh");
    mesh_ = reader_->mesh();
    if (!map_.mesh.empty()) {
      const FeMesh given = readAbaqusMesh(map_.mesh);
      compareMeshes(given);
      mesh_.complete(given);
    }
  }

  FeDeviation run() {
    FeDeviation out;
    out.by_place = map_.each_table_node.has_value();
    std::set<NodeId> wanted;
    if (!map_.observe.empty()) {
      readObserve(wanted);
    } else {
      readPoints(wanted);
    }
    out.nodes = wanted.size();
    job_.report(0.1, "reading displacements");
    std::vector<FeState> states = reader_->states(wanted);
    job_.throwIfCancelled();
    job_.report(0.8, "tool minus table");
    out.states = states.size();
    const std::vector<double> times = timesOf(states, out.notes);
    checkNodes(states, wanted);
    if (map_.first_state_s) {
      // Before any load: no displacement.
      appendState(*map_.first_state_s, FeState(), true, out);
    }
    for (std::size_t k = 0; k < states.size(); ++k) appendState(times[k], states[k], false, out);
    std::stable_sort(out.rows.begin(), out.rows.end(),
                     [](const SimulationRow& a, const SimulationRow& b) { return a.time_s < b.time_s; });
    out.first_s = out.rows.front().time_s;
    out.last_s = out.rows.back().time_s;
    for (const SimulationRow& row : out.rows) {
      out.largest_deviation = std::max(out.largest_deviation, std::abs(row.predicted));
    }
    checkSizes(states, out);
    out.notes.insert(out.notes.end(), notes_.begin(), notes_.end());
    return out;
  }

 private:
  [[nodiscard]] SourcePlace mapPlace() const { return {map_.file, ""}; }

  [[nodiscard]] Eigen::Vector3d placeOf(NodeId id) const {
    const auto found = mesh_.nodes.find(id);
    if (found == mesh_.nodes.end()) {
      throw InputError(
          mapPlace(),
          fmt::format("the place of node {} is not known from {}; add the mesh that it comes from (\"mesh\" "
                      "or --mesh).",
                      id, fileName(map_.result)));
    }
    return map_.mcf_from_mesh * (found->second * length_to_mm_);
  }

  /// The same node at two places: sets of another mesh would name the wrong nodes.
  void compareMeshes(const FeMesh& given) const {
    double size = 0.0;
    for (const auto& [id, place] : mesh_.nodes) size = std::max(size, place.norm());
    for (const auto& [id, place] : mesh_.nodes) {
      const auto other = given.nodes.find(id);
      if (other == given.nodes.end() || (other->second - place).norm() <= 1e-4 * size) continue;
      throw InputError(
          {map_.mesh, ""},
          fmt::format("has node {} at ({:.6g}, {:.6g}, {:.6g}), {} at ({:.6g}, {:.6g}, {:.6g}); allowed: the "
                      "mesh of this result, in the same unit.",
                      id, other->second.x(), other->second.y(), other->second.z(), fileName(map_.result), place.x(),
                      place.y(), place.z()));
    }
  }

  [[nodiscard]] std::vector<NodeId> nodesOf(const FeNodes& which) {
    if (!which.set.empty()) {
      const auto found = mesh_.sets.find(which.set);
      if (found == mesh_.sets.end()) {
        std::vector<std::string> names;
        for (const auto& [name, list] : mesh_.sets) names.push_back(name);
        throw InputError(
            mapPlace(),
            names.empty()
                ? fmt::format("there is no set of nodes \"{}\", nor any other, in {}; add the mesh with its "
                              "sets (\"mesh\" or --mesh), or list nodes.",
                              which.set, fileName(map_.result))
                : fmt::format("there is no set of nodes \"{}\"; allowed: {}.", which.set, joinedList(names, "or")));
      }
      if (found->second.empty()) {
        throw InputError(mapPlace(), fmt::format("the set \"{}\" holds no node; allowed: at least one.", which.set));
      }
      std::set<NodeId> once(found->second.begin(), found->second.end());
      return {once.begin(), once.end()};
    }
    if (!which.nodes.empty()) {
      std::set<NodeId> once(which.nodes.begin(), which.nodes.end());
      for (const NodeId id : once) {
        if (!mesh_.nodes.empty() && !mesh_.nodes.contains(id)) {
          throw InputError(mapPlace(), fmt::format("there is no node {} in {}; allowed: the {} nodes that it has.", id,
                                                   fileName(map_.result), mesh_.nodes.size()));
        }
      }
      return {once.begin(), once.end()};
    }
    return nearest(*which.nearest_to_mm, which.count);
  }

  [[nodiscard]] std::vector<NodeId> nearest(const Eigen::Vector3d& place_mm, int count) {
    if (mesh_.nodes.empty()) {
      throw InputError(mapPlace(), fmt::format("{} knows no places of nodes; add the mesh (\"mesh\" or --mesh).",
                                               fileName(map_.result)));
    }
    std::vector<std::pair<double, NodeId>> order;
    order.reserve(mesh_.nodes.size());
    for (const auto& [id, place] : mesh_.nodes) order.emplace_back((placeOf(id) - place_mm).norm(), id);
    const auto wanted =
        static_cast<std::ptrdiff_t>(std::min<std::size_t>(order.size(), static_cast<std::size_t>(count)));
    std::partial_sort(order.begin(), order.begin() + wanted, order.end());
    std::vector<NodeId> out;
    for (std::ptrdiff_t i = 0; i < wanted; ++i) out.push_back(order[static_cast<std::size_t>(i)].second);
    const double distance = order.front().first;
    if (distance > 0.02 * extent_mm()) {
      notes_.push_back(fmt::format("The node nearest to ({:.6g}, {:.6g}, {:.6g}) mm is {}, {:.3g} mm away.",
                                   place_mm.x(), place_mm.y(), place_mm.z(), order.front().second, distance));
    }
    return out;
  }

  [[nodiscard]] double extent_mm() const {
    if (mesh_.nodes.empty()) return 0.0;
    Eigen::Vector3d low = mesh_.nodes.begin()->second;
    Eigen::Vector3d high = low;
    for (const auto& [id, place] : mesh_.nodes) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    return (high - low).norm() * length_to_mm_;
  }

  [[nodiscard]] Body bodyOf(const FeNodes& which, const std::string& what, bool needs_rotation) {
    Body body;
    body.nodes = nodesOf(which);
    needs_rotation = needs_rotation || which.at_mm.has_value();
    const bool placed =
        std::all_of(body.nodes.begin(), body.nodes.end(), [&](NodeId id) { return mesh_.nodes.contains(id); });
    if (!placed) {
      if (needs_rotation)
        (void)placeOf(
            *std::find_if(body.nodes.begin(), body.nodes.end(), [&](NodeId id) { return !mesh_.nodes.contains(id); }));
      return body;
    }
    for (const NodeId id : body.nodes) body.mean_mm += placeOf(id) / static_cast<double>(body.nodes.size());
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (const NodeId id : body.nodes) {
      const Eigen::Vector3d arm = placeOf(id) - body.mean_mm;
      body.arm_mm.push_back(arm);
      inertia += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(inertia);
    body.turns = spread.eigenvalues()[0] > 1e-6 * spread.eigenvalues()[2] && spread.eigenvalues()[2] > 0.0;
    if (body.turns) body.inverse_inertia = inertia.inverse();
    if (needs_rotation && !body.turns) {
      throw InputError(
          mapPlace(),
          fmt::format(
              "the {} nodes of {} lie on one line, so that their rotation is not known; allowed: at least three "
              "that do not.",
              body.nodes.size(), what));
    }
    if (which.at_mm) body.lever_mm = *which.at_mm - body.mean_mm;
    return body;
  }

  void readPoints(std::set<NodeId>& wanted) {
    const bool rotations =
        std::any_of(map_.components.begin(), map_.components.end(), [](Component c) { return isRotation(c); });
    if (map_.each_table_node) {
      tools_.push_back(bodyOf(map_.each_table_node->tool, "the tool", false));
      std::size_t doubled = 0;
      std::set<std::tuple<long long, long long, long long>> places;
      for (const NodeId id : nodesOf(map_.each_table_node->table)) {
        Body node;
        node.nodes = {id};
        node.mean_mm = placeOf(id);
        const auto rounded = [&](int axis) { return std::llround(node.mean_mm[axis] * 1e4); };
        if (!places.emplace(rounded(0), rounded(1), rounded(2)).second) {
          ++doubled;
          continue;
        }
        tables_.push_back(std::move(node));
      }
      if (doubled > 0) {
        notes_.push_back(fmt::format("{} nodes of the table lie where another one lies and are left out.", doubled));
      }
    }
    for (const FePoint& point : map_.points) {
      tools_.push_back(bodyOf(point.tool, "the tool at point " + point.point, rotations));
      tables_.push_back(bodyOf(point.table, "the table at point " + point.point, rotations));
      std::vector<NodeId> both;
      std::set_intersection(tools_.back().nodes.begin(), tools_.back().nodes.end(), tables_.back().nodes.begin(),
                            tables_.back().nodes.end(), std::back_inserter(both));
      if (!both.empty()) {
        throw InputError(mapPlace(), fmt::format("node {} is tool and table of point {}; allowed: one of the two.",
                                                 both.front(), point.point));
      }
    }
    for (const std::vector<Body>* bodies : {&tools_, &tables_}) {
      for (const Body& body : *bodies) wanted.insert(body.nodes.begin(), body.nodes.end());
    }
  }

  void readObserve(std::set<NodeId>& wanted) {
    const CsvTable table = CsvTable::read(map_.observe);
    const std::size_t point = table.column("point");
    const std::size_t component = table.column("component");
    const std::size_t node = table.column("node");
    const std::size_t dof = table.column("dof");
    const std::size_t weight = table.column("weight");
    for (std::size_t i = 0; i < table.rowCount(); ++i) {
      const auto parsed = componentFromString(table.text(i, component));
      if (!parsed) {
        throw InputError(
            table.place(i, component),
            fmt::format("component \"{}\" is not known; allowed: EX, EY, EZ, EA, EB or EC.", table.text(i, component)));
      }
      const double direction = table.number(i, dof);
      if (direction != 1.0 && direction != 2.0 && direction != 3.0) {
        throw InputError(table.place(i, dof), fmt::format("dof {} is not allowed; allowed: 1, 2 or 3.", direction));
      }
      const double id = table.number(i, node);
      if (id < 1.0 || id > largest_node || id != std::floor(id)) {
        throw InputError(
            table.place(i, node),
            fmt::format("\"{}\" is no number of a node; allowed: a whole number from 1.", table.text(i, node)));
      }
      if (!mesh_.nodes.empty() && !mesh_.nodes.contains(static_cast<NodeId>(id))) {
        throw InputError(table.place(i, node), fmt::format("there is no node {} in {}; allowed: the {} nodes it has.",
                                                           id, fileName(map_.result), mesh_.nodes.size()));
      }
      weights_[{table.requiredText(i, point), *parsed}].push_back(
          {static_cast<NodeId>(id), static_cast<int>(direction) - 1, table.number(i, weight)});
      wanted.insert(static_cast<NodeId>(id));
    }
    if (weights_.empty()) throw InputError({map_.observe, ""}, "holds no row; allowed: at least one.");
  }

  /// Seconds of every state.
  [[nodiscard]] std::vector<double> timesOf(const std::vector<FeState>& states, std::vector<std::string>& notes) const {
    std::vector<double> times;
    if (map_.state_interval_s) {
      for (std::size_t k = 0; k < states.size(); ++k) {
        times.push_back(map_.first_state_s.value_or(0.0) + static_cast<double>(k + 1) * *map_.state_interval_s);
      }
      return times;
    }
    bool steps = states.size() > 1;
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double t = states[k].time;
      if (!times.empty() && !(t > times.back())) {
        throw InputError({map_.result, ""},
                         fmt::format("the time of its states does not rise, {} after {}; allowed: rising times, or "
                                     "\"state_interval_s\" (--interval) for states at equal distances.",
                                     t, times.back()));
      }
      steps = steps && std::abs(t - static_cast<double>(k + 1)) < 1e-6;
      times.push_back(t);
    }
    if (steps) {
      notes.push_back(fmt::format(
          "The times of the {} states are 1, 2, ... {}: these look like numbers of steps, and are taken for "
          "seconds; \"first_state_s\" and \"state_interval_s\" (--first, --interval) give the true ones.",
          states.size(), states.size()));
    }
    if (map_.first_state_s && !(*map_.first_state_s < times.front())) {
      throw InputError(mapPlace(), fmt::format("first_state_s {} is not before the first state of {} at {} s; allowed: "
                                               "an earlier time, or none.",
                                               *map_.first_state_s, fileName(map_.result), times.front()));
    }
    return times;
  }

  void checkNodes(const std::vector<FeState>& states, const std::set<NodeId>& wanted) const {
    for (std::size_t k = 0; k < states.size(); ++k) {
      for (const NodeId id : wanted) {
        const auto found = states[k].displacement.find(id);
        if (found == states[k].displacement.end()) {
          std::vector<std::string> names;
          for (const auto& [name, list] : mesh_.sets) names.push_back(name);
          throw InputError(
              {map_.result, ""},
              fmt::format("has no displacement of node {} in state {} (time {}); allowed: results of all nodes "
                          "that are used{}.",
                          id, k + 1, states[k].time, names.empty() ? "" : "; the sets known are " + joinedList(names)));
        }
        if (!found->second.allFinite()) {
          throw InputError(
              {map_.result, ""},
              fmt::format("the displacement of node {} in state {} is not a finite number; allowed: numbers.", id,
                          k + 1));
        }
      }
    }
  }

  [[nodiscard]] Eigen::Vector3d displacement_mm(const FeState& state, NodeId id) const {
    return map_.mcf_from_mesh.rotation() * (state.displacement.at(id) * to_mm_);
  }

  /// Displacement and small rotation of a body, mm and rad.
  [[nodiscard]] SmallError motionOf(const Body& body, const FeState& state) const {
    SmallError motion;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
      const Eigen::Vector3d u = displacement_mm(state, body.nodes[i]);
      motion.translation_mm += u / static_cast<double>(body.nodes.size());
      if (body.turns) moment += body.arm_mm[i].cross(u);
    }
    if (body.turns) motion.rotation_rad = body.inverse_inertia * moment;
    if (body.lever_mm) motion.translation_mm += motion.rotation_rad.cross(*body.lever_mm);
    return motion;
  }

  void appendState(double time_s, const FeState& state, bool zero, FeDeviation& out) {
    const auto add = [&](const std::string& point, const Eigen::Vector3d& place, Component component, double value) {
      out.rows.push_back({time_s, point, place, component, value});
    };
    for (const auto& [key, list] : weights_) {
      double sum = 0.0;
      for (const Weight& w : list) {
        if (!zero) sum += w.weight * state.displacement.at(w.node)[w.dof] * to_mm_;
      }
      add(key.first, Eigen::Vector3d::Zero(), key.second, um_per_mm * sum);
    }
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      const Body& tool = tools_[out.by_place ? 0 : i];
      const SmallError deviation = zero ? SmallError() : motionOf(tool, state) - motionOf(tables_[i], state);
      for (const Component c : map_.components) {
        add(out.by_place ? "" : map_.points[i].point, tables_[i].mean_mm, c, valueOf(deviation, c));
      }
    }
  }

  /// Sizes that no machine has: a unit that is not the one stated.
  void checkSizes(const std::vector<FeState>& states, FeDeviation& out) const {
    double largest_mm = 0.0;
    for (const FeState& state : states) {
      for (const auto& [id, u] : state.displacement) largest_mm = std::max(largest_mm, u.norm() * to_mm_);
    }
    out.largest_displacement_um = largest_mm * um_per_mm;
    const auto doubt = [&](const std::string& sentence) {
      out.notes.push_back(sentence);
      out.plausible = false;
    };
    const double extent = extent_mm();
    const std::string length_unit = map_.unit_of_length.empty() ? map_.unit_of_displacement : map_.unit_of_length;
    if (extent > 0.0 && extent < 20.0) {
      doubt(
          fmt::format("The mesh is {:.3g} mm large if its unit is {}, which is implausible for a machine: is it in {}?",
                      extent, length_unit, length_unit == "mm" ? "m" : "another unit"));
    } else if (extent > 50'000.0) {
      doubt(
          fmt::format("The mesh is {:.3g} m large if its unit is {}, which is implausible for a machine: is it in {}?",
                      extent * 1e-3, length_unit, length_unit == "m" ? "mm" : "another unit"));
    }
    // Heat moves machines by some micrometres to some hundred; strains of heat are below a per cent.
    if (largest_mm > 0.0 && largest_mm < 1e-3) {
      doubt(fmt::format(
          "The largest displacement is {:.3g} µm if its unit is {}, which is implausibly small: is it in {}?",
          out.largest_displacement_um, map_.unit_of_displacement,
          map_.unit_of_displacement == "mm" ? "m" : "another unit"));
    } else if (largest_mm > 5.0 || (extent > 0.0 && largest_mm > 0.01 * extent)) {
      doubt(fmt::format(
          "The largest displacement is {:.3g} mm if its unit is {}, which is implausibly large: is it in {}?",
          largest_mm, map_.unit_of_displacement, map_.unit_of_displacement == "m" ? "mm" : "um"));
    } else if (largest_mm == 0.0) {
      doubt("All displacements are zero: the result holds no load, or only its first state.");
    }
  }

  const FeMap& map_;
  JobContext& job_;
  std::unique_ptr<FeResultReader> reader_;
  FeMesh mesh_;
  double to_mm_ = 1.0;
  double length_to_mm_ = 1.0;
  std::vector<Body> tools_;
  std::vector<Body> tables_;
  std::map<std::pair<std::string, Component>, std::vector<Weight>> weights_;
  std::vector<std::string> notes_;
};

}  // namespace

FeDeviation feDeviation(const FeMap& map, const FeReaderFactory& open, JobContext& job) {
  return Import(map, open, job).run();
}

}  // namespace spindrift
