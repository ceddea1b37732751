// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/plain_methods.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/drivers.h"

namespace spindrift::study {
namespace {

struct Candidate {
  std::string id;
  Eigen::MatrixXd columns;  // centred per series, divided by sigma
  int parameters = 0;
};

struct Library {
  Eigen::VectorXd y;
  std::vector<Candidate> candidates;
};

/// Parameters of a variant on a small grid: one lag for all its inputs, onsets over the whole campaign.
std::vector<std::vector<double>> parameterGrid(const EffectVariant& variant, double from_s, double to_s) {
  std::vector<std::vector<double>> grid;
  const std::vector<std::string> names = parameterNames(variant);
  if (names.empty()) return {{}};
  const bool has_onset = std::find(names.begin(), names.end(), "onset_s") != names.end();
  for (const double lag : {400.0, 1000.0, 2500.0, 6300.0}) {
    if (has_onset && names.size() == 1 && lag > 400.0) break;  // a step has no lag
    for (int k = 0; k < (has_onset ? 16 : 1); ++k) {
      for (const double part : {0.15, 0.3}) {
        const bool has_length = std::find(names.begin(), names.end(), "length_s") != names.end();
        if (!has_length && part > 0.2) break;
        std::vector<double> values;
        for (const std::string& name : names) {
          if (name == "onset_s") {
            values.push_back(from_s + (k + 0.5) / 16.0 * (to_s - from_s));
          } else if (name == "length_s") {
            values.push_back(part * (to_s - from_s));
          } else {
            values.push_back(lag);
          }
        }
        grid.push_back(values);
      }
    }
  }
  return grid;
}

Library makeLibrary(const DiscrepancyInput& input) {
  Library library;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) {
    if (input.observations.rows[i].use == ObservationUse::Fit && std::isfinite(input.predicted[i])) used.push_back(i);
  }
  std::map<std::pair<std::string, Component>, std::vector<Eigen::Index>> series;
  std::map<double, Eigen::Index> times;
  CatalogueContext context;
  std::set<std::string> points;
  std::set<double> angles;
  std::map<int, std::set<double>> approach;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const Observation& row = input.observations.rows[used[k]];
    series[{row.point, row.component}].push_back(static_cast<Eigen::Index>(k));
    times[row.time_s] = 0;
    points.insert(row.point);
    angles.insert(row.c_deg);
    for (int axis = 0; axis < 3; ++axis) approach[axis].insert(row.approach[axis]);
  }
  std::vector<double> node;
  for (auto& [time, index] : times) {
    index = static_cast<Eigen::Index>(node.size());
    node.push_back(time);
  }
  const DriverTable drivers(input.machine, input.log ? &*input.log : nullptr);
  context.machine = &input.machine;
  context.drivers = &drivers;
  context.points.assign(points.begin(), points.end());
  for (int axis = 0; axis < 3; ++axis) {
    if (approach[axis].size() > 1) context.varying_approach.insert(axis_letters[axis]);
  }
  context.c_varies = angles.size() > 1;
  const std::vector<Effect> catalogue = effectCatalogue(context);

  const auto n = static_cast<Eigen::Index>(used.size());
  const auto centre = [&](Eigen::MatrixXd& m) {
    for (const auto& [key, rows] : series) {
      for (Eigen::Index c = 0; c < m.cols(); ++c) {
        double mean = 0.0;
        for (const Eigen::Index row : rows) mean += m(row, c);
        mean /= static_cast<double>(rows.size());
        for (const Eigen::Index row : rows) m(row, c) -= mean;
      }
    }
    for (Eigen::Index row = 0; row < n; ++row) {
      m.row(row) /= input.observations.rows[used[static_cast<std::size_t>(row)]].sigma;
    }
  };
  Eigen::MatrixXd residual(n, 1);
  std::vector<Eigen::Index> node_of(used.size());
  std::vector<DeviationQuery> places;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const Observation& row = input.observations.rows[used[k]];
    residual(static_cast<Eigen::Index>(k), 0) = row.value - input.predicted[used[k]];
    node_of[k] = times.at(row.time_s);
    places.push_back(DeviationQuery::of(row));
  }
  centre(residual);
  library.y = residual.col(0);

  for (const Effect& effect : catalogue) {
    const auto shapes = static_cast<Eigen::Index>(effect.shape.size());
    Eigen::MatrixXd shape(n, shapes);
    for (Eigen::Index row = 0; row < n; ++row) {
      const auto k = static_cast<std::size_t>(row);
      for (Eigen::Index c = 0; c < shapes; ++c) {
        shape(row, c) =
            effect.shape[static_cast<std::size_t>(c)].value(places[k], input.observations.rows[used[k]].component);
      }
    }
    for (const EffectVariant& variant : effect.variants) {
      for (const std::vector<double>& parameters : parameterGrid(variant, node.front(), node.back())) {
        const Eigen::MatrixXd q = inputResponses(drivers, variant, parameters, node);
        Candidate candidate;
        candidate.id = effect.id;
        candidate.parameters = static_cast<int>(parameters.size());
        candidate.columns.resize(n, q.cols() * shapes);
        for (Eigen::Index row = 0; row < n; ++row) {
          for (Eigen::Index i = 0; i < q.cols(); ++i) {
            candidate.columns.row(row).segment(i * shapes, shapes) =
                q(node_of[static_cast<std::size_t>(row)], i) * shape.row(row);
          }
        }
        centre(candidate.columns);
        if (candidate.columns.squaredNorm() > 1e-12) library.candidates.push_back(std::move(candidate));
      }
    }
  }
  return library;
}

/// Removes the directions of `basis` (orthonormal) from the columns, then makes what is left orthonormal.
Eigen::MatrixXd newDirections(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& basis) {
  Eigen::MatrixXd out(columns.rows(), 0);
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    Eigen::VectorXd v = columns.col(c);
    const double whole = v.norm();
    for (int pass = 0; pass < 2; ++pass) {
      if (basis.cols() > 0) v -= basis * (basis.transpose() * v);
      if (out.cols() > 0) v -= out * (out.transpose() * v);
    }
    if (!(v.norm() > 1e-4 * whole) || !(whole > 0.0)) continue;
    out.conservativeResize(Eigen::NoChange, out.cols() + 1);
    out.col(out.cols() - 1) = v.normalized();
  }
  return out;
}

}  // namespace

Answer forwardStepwiseBic(const DiscrepancyInput& input) {
  const Library library = makeLibrary(input);
  const auto n = static_cast<double>(library.y.size());
  Answer answer;
  answer.verdict = "none";
  Eigen::MatrixXd basis(library.y.size(), 0);
  Eigen::VectorXd residual = library.y;
  std::set<std::string> named;
  for (int step = 0; step < 5; ++step) {
    const double rss = residual.squaredNorm();
    double best_gain = 0.0;
    const Candidate* best = nullptr;
    Eigen::MatrixXd best_directions;
    for (const Candidate& candidate : library.candidates) {
      if (named.contains(candidate.id)) continue;
      const Eigen::MatrixXd directions = newDirections(candidate.columns, basis);
      if (directions.cols() == 0) continue;
      const double left = rss - (directions.transpose() * residual).squaredNorm();
      const double parameters = static_cast<double>(directions.cols()) + candidate.parameters;
      const double gain = n * std::log(rss / std::max(left, 1e-9)) - parameters * std::log(n);
      if (gain > best_gain) {
        best_gain = gain;
        best = &candidate;
        best_directions = directions;
      }
    }
    if (best == nullptr) break;
    named.insert(best->id);
    answer.effects.push_back({best->id, {}, 1.0});
    answer.verdict = "named";
    residual -= best_directions * (best_directions.transpose() * residual);
    basis.conservativeResize(Eigen::NoChange, basis.cols() + best_directions.cols());
    basis.rightCols(best_directions.cols()) = best_directions;
  }
  return answer;
}

Answer lassoBic(const DiscrepancyInput& input) {
  const Library library = makeLibrary(input);
  const Eigen::Index n = library.y.size();
  std::vector<const Candidate*> owner;
  Eigen::Index count = 0;
  for (const Candidate& candidate : library.candidates) count += candidate.columns.cols();
  Eigen::MatrixXd x(n, count);
  Eigen::Index column = 0;
  for (const Candidate& candidate : library.candidates) {
    for (Eigen::Index c = 0; c < candidate.columns.cols(); ++c) {
      const double norm = candidate.columns.col(c).norm();
      if (!(norm > 1e-9)) continue;
      x.col(column++) = candidate.columns.col(c) / norm;
      owner.push_back(&candidate);
    }
  }
  x.conservativeResize(Eigen::NoChange, column);
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(column);
  Eigen::VectorXd residual = library.y;
  Eigen::VectorXd best_beta = beta;
  const auto rows = static_cast<double>(n);
  double best_bic = rows * std::log(residual.squaredNorm());
  const double largest = (x.transpose() * library.y).cwiseAbs().maxCoeff();
  for (double lambda = 0.8 * largest; lambda > 0.02 * largest; lambda *= 0.75) {
    // Coordinate descent on the active set, which grows until no other column wants to come in.
    std::set<Eigen::Index> active;
    for (Eigen::Index j = 0; j < column; ++j) {
      if (beta[j] != 0.0) active.insert(j);
    }
    for (int round = 0; round < 8; ++round) {
      const Eigen::VectorXd pull = x.transpose() * residual;
      const std::size_t before = active.size();
      for (Eigen::Index j = 0; j < column; ++j) {
        if (std::abs(pull[j]) > lambda) active.insert(j);
      }
      for (int sweep = 0; sweep < 60; ++sweep) {
        double moved = 0.0;
        for (const Eigen::Index j : active) {
          const double z = x.col(j).dot(residual) + beta[j];
          const double next = std::copysign(std::max(0.0, std::abs(z) - lambda), z);
          if (next == beta[j]) continue;
          residual -= (next - beta[j]) * x.col(j);
          moved = std::max(moved, std::abs(next - beta[j]));
          beta[j] = next;
        }
        if (moved < 1e-4 * largest) break;
      }
      if (active.size() == before) break;
    }
    const auto kept = static_cast<double>((beta.array() != 0.0).count());
    const double bic = rows * std::log(residual.squaredNorm()) + kept * std::log(rows);
    if (bic < best_bic) {
      best_bic = bic;
      best_beta = beta;
    }
  }
  std::map<std::string, Eigen::VectorXd> part;
  for (Eigen::Index j = 0; j < column; ++j) {
    if (best_beta[j] == 0.0) continue;
    auto [entry, fresh] = part.try_emplace(owner[static_cast<std::size_t>(j)]->id, Eigen::VectorXd::Zero(n));
    entry->second += best_beta[j] * x.col(j);
  }
  double total = 0.0;
  for (const auto& [id, values] : part) total += values.squaredNorm();
  Answer answer;
  answer.verdict = "none";
  for (const auto& [id, values] : part) {
    if (values.squaredNorm() < 0.1 * total) continue;
    answer.effects.push_back({id, {}, 1.0});
    answer.verdict = "named";
  }
  return answer;
}

}  // namespace spindrift::study
